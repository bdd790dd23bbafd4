//! Textures to draw into.

use crate::device::Renderer;

/// Depth is f32 and reversed: 1 at the near plane, 0 at infinity, where floats are densest.
pub(crate) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Nearest surface wins; of equally near ones, the first drawn.
pub(crate) fn reversed_depth() -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH_FORMAT,
        depth_write_enabled: Some(true),
        depth_compare: Some(wgpu::CompareFunction::Greater),
        stencil: Default::default(),
        bias: Default::default(),
    }
}

/// One texture to draw into, and to read from afterwards.
pub(crate) struct Target {
    pub texture: wgpu::Texture,
    pub view: wgpu::TextureView,
}

impl Target {
    /// A target of `[width, height]` pixels.
    pub(crate) fn new(renderer: &Renderer, size: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let [width, height] = size;
        let then_read = match format {
            DEPTH_FORMAT => wgpu::TextureUsages::TEXTURE_BINDING,
            _ => wgpu::TextureUsages::COPY_SRC,
        };
        let texture = renderer.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("target"),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | then_read,
            view_formats: &[],
        });
        let view = texture.create_view(&Default::default());
        Self { texture, view }
    }

    /// As a colour attachment, cleared to zeros or kept.
    pub(crate) fn color(&self, clear: bool) -> wgpu::RenderPassColorAttachment<'_> {
        wgpu::RenderPassColorAttachment {
            view: &self.view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: match clear {
                    true => wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    false => wgpu::LoadOp::Load,
                },
                store: wgpu::StoreOp::Store,
            },
        }
    }

    /// As a depth attachment, cleared to infinitely far or kept.
    pub(crate) fn depth(&self, clear: bool) -> wgpu::RenderPassDepthStencilAttachment<'_> {
        wgpu::RenderPassDepthStencilAttachment {
            view: &self.view,
            depth_ops: Some(wgpu::Operations {
                load: match clear {
                    true => wgpu::LoadOp::Clear(0.0),
                    false => wgpu::LoadOp::Load,
                },
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        }
    }
}
