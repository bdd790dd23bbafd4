//! The item buffer: which feature each pixel around the eye sees.

use crate::cube_map::{CubeMap, Face, Seen, Tally};
use crate::device::Renderer;
use crate::error::{Error, Result};
use crate::pyramid::{ItemVertex, Pyramids};
use crate::readback::Readback;
use crate::scene_mesh::{SceneMesh, is_drawable};
use crate::target::{DEPTH_FORMAT, Target, reversed_depth};

/// Forward distance of the near plane in metres. What is nearer is not drawn, so it has to be well
/// below the 1 mm within which an eye counts as inside a solid. It costs no precision: reversed
/// depth in f32 is relative to the distance, and triangles that span the eye are clipped in f64.
const ITEM_NEAR: f64 = 1e-4;

/// Corners sent to the device in one go (24 MiB): bounds its memory, whatever the scene.
const CORNERS_A_DRAW: usize = 3 << 19;

const ID_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;

/// Draws the ids around one eye after another over one scene, reusing its memory.
///
/// What an item buffer can miss:
/// - it samples pixel centres: features, and gaps between features, smaller than a pixel (2/n of
///   the distance along a face's axis, n the resolution) may fall between them. So an id that is
///   seen is evidence, an id that is not seen is none: aim rays at what was not seen;
/// - hardware snaps projected corners to a grid (1/256 pixel on most, lavapipe among them), so an
///   id may be seen up to that much outside its silhouette: recast a disputed pixel exactly;
/// - depth is f32, with an error of some 1e-7 x distance / (smallest forward distance of the same
///   triangle) relative to the distance: of two surfaces closer together than that, either may be
///   seen. Of surfaces at exactly the same depth, the first in the mesh is seen;
/// - what is within 0.1 mm of the eye along a face's axis is not drawn.
pub struct ItemBuffer<'a> {
    renderer: &'a Renderer,
    scene: &'a SceneMesh,
    pyramids: Pyramids,
    pipeline: wgpu::RenderPipeline,
    corners: wgpu::Buffer,
    capacity: usize,
    ids: Target,
    depth: Target,
    readbacks: [Readback; 2],
    resolution: u32,
}

impl Renderer {
    /// Prepares to draw the ids of `scene` around eyes, `resolution` squared pixels a face.
    ///
    /// # Errors
    /// [`Error::Mesh`] when the mesh contradicts itself, [`Error::Resolution`], [`Error::Gpu`].
    pub fn item_buffer<'a>(
        &'a self,
        scene: &'a SceneMesh,
        resolution: u32,
    ) -> Result<ItemBuffer<'a>> {
        scene.check()?;
        self.check_resolution(resolution)?;
        let size = [resolution, resolution];
        let readback = || Readback::new(self, size, 4);
        // A clipped triangle can become five, but few are clipped: larger lots are drawn in turns.
        let capacity = (3 * scene.triangles.len() + 96).min(CORNERS_A_DRAW);
        let item_buffer = ItemBuffer {
            renderer: self,
            scene,
            pyramids: Pyramids::default(),
            pipeline: pipeline(&self.device),
            corners: corner_buffer(&self.device, capacity),
            capacity,
            ids: Target::new(self, size, ID_FORMAT),
            depth: Target::new(self, size, DEPTH_FORMAT),
            readbacks: [readback(), readback()],
            resolution,
        };
        self.check_failure()?;
        Ok(item_buffer)
    }

    /// The ids around one eye. For many eyes over one scene keep a [`Renderer::item_buffer`].
    ///
    /// # Errors
    /// Those of [`Renderer::item_buffer`], and [`Error::Eye`].
    pub fn cube_map(&self, scene: &SceneMesh, eye: [f64; 3], resolution: u32) -> Result<CubeMap> {
        self.item_buffer(scene, resolution)?.cube_map(eye)
    }
}

impl ItemBuffer<'_> {
    /// All six faces around `eye`: 24 bytes x resolution squared.
    ///
    /// # Errors
    /// [`Error::Eye`], [`Error::Gpu`].
    pub fn cube_map(&mut self, eye: [f64; 3]) -> Result<CubeMap> {
        let resolution = self.resolution;
        let pixels = resolution as usize * resolution as usize;
        let mut faces = Vec::from(Face::ALL.map(|_| Vec::with_capacity(pixels)));
        self.draw(eye, |face, _, row| {
            faces[face as usize].extend_from_slice(row)
        })?;
        Ok(CubeMap::new(resolution, faces))
    }

    /// Every id seen from `eye`, without keeping the faces.
    ///
    /// # Errors
    /// [`Error::Eye`], [`Error::Gpu`].
    pub fn seen(&mut self, eye: [f64; 3]) -> Result<Seen> {
        let mut tally = Tally::default();
        self.draw(eye, |face, y, row| tally.row(face, y, row))?;
        Ok(tally.finish())
    }

    /// Draws face after face and hands over their rows; while one is drawn, the one before is read.
    fn draw(&mut self, eye: [f64; 3], mut row: impl FnMut(Face, u32, &[u32])) -> Result<()> {
        if !is_drawable(&eye) {
            return Err(Error::Eye(eye));
        }
        self.pyramids.look_from(self.scene, eye);
        let mut before = None;
        for (face, slot) in Face::ALL.into_iter().zip([0, 1].into_iter().cycle()) {
            let drawn = self.draw_face(eye, face, slot);
            if let Some((face, slot, submission)) = before.replace((face, slot, drawn)) {
                self.read(face, slot, submission, &mut row)?;
            }
        }
        let (face, slot, submission) = before.expect("a cube has faces");
        self.read(face, slot, submission, &mut row)
    }

    /// Draws one face and starts its way back.
    fn draw_face(&mut self, eye: [f64; 3], face: Face, slot: usize) -> wgpu::SubmissionIndex {
        let vertices = self.pyramids.vertices(self.scene, eye, face);
        let (queue, device) = (&self.renderer.queue, &self.renderer.device);
        let mut first = true;
        let mut rest = vertices;
        loop {
            let (chunk, later) = rest.split_at(rest.len().min(self.capacity));
            queue.write_buffer(&self.corners, 0, bytemuck::cast_slice(chunk));
            let mut encoder = device.create_command_encoder(&Default::default());
            {
                let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                    label: Some("items"),
                    color_attachments: &[Some(self.ids.color(first))],
                    depth_stencil_attachment: Some(self.depth.depth(first)),
                    ..Default::default()
                });
                pass.set_pipeline(&self.pipeline);
                pass.set_vertex_buffer(0, self.corners.slice(..));
                pass.draw(0..chunk.len() as u32, 0..1);
            }
            if later.is_empty() {
                return self.readbacks[slot].submit(self.renderer, encoder, &self.ids);
            }
            queue.submit([encoder.finish()]);
            (first, rest) = (false, later);
        }
    }

    fn read(
        &self,
        face: Face,
        slot: usize,
        submission: wgpu::SubmissionIndex,
        row: &mut impl FnMut(Face, u32, &[u32]),
    ) -> Result<()> {
        self.readbacks[slot].rows(self.renderer, submission, |y, bytes| {
            row(face, y, bytemuck::cast_slice(bytes));
        })
    }
}

fn corner_buffer(device: &wgpu::Device, capacity: usize) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("corners"),
        size: (capacity * size_of::<ItemVertex>()) as u64,
        usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn pipeline(device: &wgpu::Device) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::include_wgsl!("shaders/item.wgsl"));
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("items"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("corner"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &[("near", ITEM_NEAR)],
                ..Default::default()
            },
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: size_of::<ItemVertex>() as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Uint32],
            })],
        },
        // No culling: a wall hides from both sides.
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(reversed_depth()),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("item"),
            compilation_options: Default::default(),
            targets: &[Some(ID_FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
