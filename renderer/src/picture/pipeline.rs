//! The perspective's passes on the device.

use super::palette;
use super::sun::Sun;
use super::surface::{SurfaceVertex, linear};
use super::view::{Axes, View};
use crate::target::{DEPTH_FORMAT, Target, reversed_depth};
use bytemuck::{Pod, Zeroable};
use wgpu::util::DeviceExt;

pub(crate) const LIGHT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
pub(crate) const KEY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Uint;

/// Haze hides 63 % at this distance in metres, or at this multiple of the distance to the target.
const HAZE: f64 = 4000.0;
const HAZE_PER_DISTANCE: f64 = 9.0;

/// The shader's `Globals`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(crate) struct Globals {
    right: [f32; 4],
    up: [f32; 4],
    forward: [f32; 4],
    ray_right: [f32; 4],
    ray_up: [f32; 4],
    light_right: [f32; 4],
    light_up: [f32; 4],
    light_depth: [f32; 4],
    sun: [f32; 4],
    horizon: [f32; 4],
    zenith: [f32; 4],
}

impl Globals {
    pub(crate) fn new(view: &View, [right, up, forward]: &Axes, sun: &Sun) -> Self {
        let [across, upwards] = view.tangents();
        let scaled = |axis: &[f64; 3], by: f64| with(axis.map(|c| c * by), 0.0);
        let distance = (0..3)
            .map(|i| (view.target[i] - view.eye[i]).powi(2))
            .sum::<f64>()
            .sqrt();
        let haze = HAZE.max(HAZE_PER_DISTANCE * distance);
        let [r, g, b, _] = linear(palette::HORIZON, 1.0);
        Self {
            right: scaled(right, 1.0 / across),
            up: scaled(up, 1.0 / upwards),
            forward: scaled(forward, 1.0),
            ray_right: scaled(right, across),
            ray_up: scaled(up, upwards),
            light_right: sun.right.map(|c| c as f32),
            light_up: sun.up.map(|c| c as f32),
            light_depth: sun.depth.map(|c| c as f32),
            sun: with(sun.direction, sun.texel),
            horizon: [r, g, b, haze as f32],
            zenith: linear(palette::ZENITH, 1.0),
        }
    }
}

fn with([x, y, z]: [f64; 3], w: f64) -> [f32; 4] {
    [x, y, z, w].map(|c| c as f32)
}

/// All that the passes need, bound together.
pub(crate) struct Pipelines {
    pub globals: wgpu::BindGroup,
    pub sky: wgpu::RenderPipeline,
    pub ground: wgpu::RenderPipeline,
    pub features: wgpu::RenderPipeline,
    shadow: wgpu::RenderPipeline,
    shadow_globals: wgpu::BindGroup,
}

impl Pipelines {
    pub(crate) fn new(
        device: &wgpu::Device,
        globals: &Globals,
        shadow_map: &wgpu::TextureView,
    ) -> Self {
        let module =
            device.create_shader_module(wgpu::include_wgsl!("../shaders/perspective.wgsl"));
        let full = bind_layout(device, true);
        let plain = bind_layout(device, false);
        let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("globals"),
            contents: bytemuck::bytes_of(globals),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("shadows"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::LessEqual),
            ..Default::default()
        });
        let painted = wgpu::DepthStencilState {
            depth_write_enabled: Some(false),
            depth_compare: Some(wgpu::CompareFunction::Always),
            ..reversed_depth()
        };
        let build = Builder {
            device,
            module: &module,
            layout: &full,
        };
        Self {
            globals: bind(device, &full, &buffer, Some((shadow_map, &sampler))),
            sky: build.pipeline("sky_corner", Some("sky"), &[], painted.clone()),
            ground: build.pipeline("corner", Some("surface"), &ATTRIBUTES, painted),
            features: build.pipeline("corner", Some("surface"), &ATTRIBUTES, reversed_depth()),
            shadow: Builder {
                layout: &plain,
                ..build
            }
            .pipeline("shadow_corner", None, &ATTRIBUTES[..1], shadow_depth()),
            shadow_globals: bind(device, &plain, &buffer, None),
        }
    }

    /// Draws the distances from the sun.
    pub(crate) fn draw_shadows(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        map: &Target,
        vertices: &wgpu::Buffer,
        count: usize,
    ) {
        let mut depth = map.depth(true);
        depth.depth_ops = Some(wgpu::Operations {
            load: wgpu::LoadOp::Clear(1.0),
            store: wgpu::StoreOp::Store,
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadows"),
            depth_stencil_attachment: Some(depth),
            ..Default::default()
        });
        pass.set_bind_group(0, &self.shadow_globals, &[]);
        pass.set_pipeline(&self.shadow);
        pass.set_vertex_buffer(0, vertices.slice(..));
        pass.draw(0..count as u32, 0..1);
    }
}

const ATTRIBUTES: [wgpu::VertexAttribute; 4] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x4, 3 => Uint32];

/// The sun's depth is not reversed; the bias keeps surfaces from shading themselves.
fn shadow_depth() -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH_FORMAT,
        depth_write_enabled: Some(true),
        depth_compare: Some(wgpu::CompareFunction::Less),
        stencil: Default::default(),
        bias: wgpu::DepthBiasState {
            constant: 2,
            slope_scale: 1.5,
            clamp: 0.0,
        },
    }
}

fn bind_layout(device: &wgpu::Device, with_shadows: bool) -> wgpu::BindGroupLayout {
    let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty,
        count: None,
    };
    let entries = [
        entry(
            0,
            wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
        ),
        entry(
            1,
            wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Depth,
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
        ),
        entry(
            2,
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison),
        ),
    ];
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("globals"),
        entries: if with_shadows {
            &entries
        } else {
            &entries[..1]
        },
    })
}

fn bind(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    globals: &wgpu::Buffer,
    shadows: Option<(&wgpu::TextureView, &wgpu::Sampler)>,
) -> wgpu::BindGroup {
    let mut entries = vec![wgpu::BindGroupEntry {
        binding: 0,
        resource: globals.as_entire_binding(),
    }];
    if let Some((map, sampler)) = shadows {
        let map = wgpu::BindingResource::TextureView(map);
        entries.push(wgpu::BindGroupEntry {
            binding: 1,
            resource: map,
        });
        let sampler = wgpu::BindingResource::Sampler(sampler);
        entries.push(wgpu::BindGroupEntry {
            binding: 2,
            resource: sampler,
        });
    }
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("globals"),
        layout,
        entries: &entries,
    })
}

/// What the pipelines have in common.
#[derive(Clone, Copy)]
struct Builder<'a> {
    device: &'a wgpu::Device,
    module: &'a wgpu::ShaderModule,
    layout: &'a wgpu::BindGroupLayout,
}

impl Builder<'_> {
    fn pipeline(
        self,
        vertex: &str,
        fragment: Option<&str>,
        attributes: &[wgpu::VertexAttribute],
        depth: wgpu::DepthStencilState,
    ) -> wgpu::RenderPipeline {
        let layout = self
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(vertex),
                bind_group_layouts: &[Some(self.layout)],
                immediate_size: 0,
            });
        let vertices = [Some(wgpu::VertexBufferLayout {
            array_stride: size_of::<SurfaceVertex>() as u64,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes,
        })];
        let light = wgpu::ColorTargetState {
            format: LIGHT_FORMAT,
            blend: Some(wgpu::BlendState::ALPHA_BLENDING),
            write_mask: wgpu::ColorWrites::ALL,
        };
        let targets = [Some(light), Some(KEY_FORMAT.into())];
        self.device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(vertex),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: self.module,
                    entry_point: Some(vertex),
                    compilation_options: Default::default(),
                    buffers: if attributes.is_empty() {
                        &[]
                    } else {
                        &vertices
                    },
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: Some(depth),
                multisample: wgpu::MultisampleState::default(),
                fragment: fragment.map(|entry_point| wgpu::FragmentState {
                    module: self.module,
                    entry_point: Some(entry_point),
                    compilation_options: Default::default(),
                    targets: &targets,
                }),
                multiview_mask: None,
                cache: None,
            })
    }
}
