//! The perspective: the scene as a camera sees it, with sun, shadows and outlines.

use super::legend::{Legend, Shows, rows};
use super::palette::Rgb;
use super::pipeline::{Globals, KEY_FORMAT, LIGHT_FORMAT, Pipelines};
use super::shapes::{draw_eye, fill_round, stroke};
use super::sheet::unit;
use super::surface::{self, SurfaceVertex, from_linear, to_linear};
use super::view::Axes;
use super::{Image, PictureScene, View, ground, palette, sun};
use crate::device::Renderer;
use crate::error::{Error, Result};
use crate::readback::Readback;
use crate::target::{DEPTH_FORMAT, Target};
use tiny_skia::{PathBuilder, Pixmap};
use wgpu::util::DeviceExt;

/// Samples along each side of a pixel.
const SUPERSAMPLE: u32 = 2;

/// What a perspective's card tells, unless told otherwise.
pub(super) const SHOWS: Shows = Shows {
    street: palette::STREET_ON_GROUND,
    rectangles: false,
    observer: false,
    columns: false,
};

/// How dark outlines are: between features, and between the faces of one.
const BORDER: f32 = 0.5;
const CREASE: f32 = 0.22;

/// How much stronger the outlines of glass are: they are lines of a colour before others.
const GLASS_EDGE: f32 = 3.0;

/// Faces whose normals have a smaller cosine meet in a crease.
const CREASE_COSINE: f32 = 0.9;

/// What a camera sees.
#[derive(Default)]
pub(super) struct Layer {
    /// sRGB samples.
    samples: Vec<u8>,
    /// What surface each of them shows, and how it is turned.
    keys: Vec<[u32; 2]>,
}

impl Layer {
    /// The linear light of a sample.
    fn light(&self, sample: usize, table: &[f32]) -> [f32; 3] {
        std::array::from_fn(|channel| table[self.samples[4 * sample + channel] as usize])
    }

    /// What is left of the light behind where this is glass, which sky and ground are not.
    fn before(&self, behind: [f32; 3], sample: usize, table: &[f32]) -> [f32; 3] {
        match self.keys[sample][0] {
            0 => behind,
            _ => mix(behind, self.light(sample, table), palette::GLASS_ALPHA),
        }
    }
}

fn mix(a: [f32; 3], b: [f32; 3], share: f32) -> [f32; 3] {
    std::array::from_fn(|channel| a[channel] + share * (b[channel] - a[channel]))
}

impl Renderer {
    /// Draws the scene as a camera sees it, in the colours of the answer.
    ///
    /// The ground is flat, at a low one of the features' feet, and features stand on it.
    ///
    /// # Errors
    /// [`Error::View`] for a camera that sees nothing, [`Error::Resolution`], [`Error::Gpu`].
    pub fn perspective(&self, scene: &PictureScene, view: &View) -> Result<Image> {
        let size = self.sampled_size(view)?;
        let axes = view.axes()?;
        let height = surface::ground_height(scene);
        let own = scene
            .observer
            .is_some_and(|observer| observer.eye == view.eye);
        let flat = ground::ground(scene, view.eye, height, !own);
        let upright = surface::features(scene, view.eye, height, palette::fill);
        let layer = self.render(view, &axes, [&flat, &upright], size)?;
        let mut pixmap = shrink(&layer, None, size)?;
        if !own {
            mark_observer(&mut pixmap, scene, view, &axes, height);
        }
        let shows = Shows {
            observer: !own,
            ..SHOWS
        };
        draw_card(&mut pixmap, scene, shows);
        Ok(Image::from_pixmap(pixmap))
    }

    /// Samples across and down.
    pub(super) fn sampled_size(&self, view: &View) -> Result<[u32; 2]> {
        let size = [view.width, view.height].map(|side| side.saturating_mul(SUPERSAMPLE));
        size.into_iter()
            .try_for_each(|side| self.check_resolution(side))?;
        Ok(size)
    }

    /// Draws shadows, sky, ground and features.
    pub(super) fn render(
        &self,
        view: &View,
        axes: &Axes,
        [flat, upright]: [&[SurfaceVertex]; 2],
        size: [u32; 2],
    ) -> Result<Layer> {
        let sun = sun::Sun::over(upright, self.max_resolution());
        let shadows = Target::new(self, [sun.resolution; 2], DEPTH_FORMAT);
        let globals = Globals::new(view, axes, &sun);
        let pipelines = Pipelines::new(&self.device, &globals, &shadows.view);
        let light = Target::new(self, size, LIGHT_FORMAT);
        let keys = Target::new(self, size, KEY_FORMAT);
        let depth = Target::new(self, size, DEPTH_FORMAT);
        let [flat_buffer, upright_buffer] = [flat, upright].map(|v| self.vertex_buffer(v));
        let mut encoder = self.device.create_command_encoder(&Default::default());
        pipelines.draw_shadows(&mut encoder, &shadows, &upright_buffer, upright.len());
        {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("perspective"),
                color_attachments: &[Some(light.color(true)), Some(keys.color(true))],
                depth_stencil_attachment: Some(depth.depth(true)),
                ..Default::default()
            });
            pass.set_bind_group(0, &pipelines.globals, &[]);
            pass.set_pipeline(&pipelines.sky);
            pass.draw(0..3, 0..1);
            pass.set_pipeline(&pipelines.ground);
            pass.set_vertex_buffer(0, flat_buffer.slice(..));
            pass.draw(0..flat.len() as u32, 0..1);
            pass.set_pipeline(&pipelines.features);
            pass.set_vertex_buffer(0, upright_buffer.slice(..));
            pass.draw(0..upright.len() as u32, 0..1);
        }
        let light_back = Readback::new(self, size, 4);
        let keys_back = Readback::new(self, size, 8);
        let light_done = light_back.submit(self, encoder, &light);
        let second = self.device.create_command_encoder(&Default::default());
        let keys_done = keys_back.submit(self, second, &keys);
        let mut layer = Layer::default();
        light_back.rows(self, light_done, |_, row| {
            layer.samples.extend_from_slice(row)
        })?;
        keys_back.rows(self, keys_done, |_, row| {
            layer.keys.extend_from_slice(bytemuck::cast_slice(row));
        })?;
        Ok(layer)
    }

    /// Never empty, since an empty buffer cannot be bound.
    fn vertex_buffer(&self, vertices: &[SurfaceVertex]) -> wgpu::Buffer {
        let nothing = [SurfaceVertex::default()];
        let contents = if vertices.is_empty() {
            &nothing
        } else {
            vertices
        };
        self.device
            .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("surfaces"),
                contents: bytemuck::cast_slice(contents),
                usage: wgpu::BufferUsages::VERTEX,
            })
    }
}

/// Averages samples in linear light, darkened where surfaces meet, with glass before them or not.
pub(super) fn shrink(solid: &Layer, glass: Option<&Layer>, size: [u32; 2]) -> Result<Pixmap> {
    let table: Vec<f32> = (0..=u8::MAX).map(to_linear).collect();
    let Rgb(red, green, blue) = palette::GLASS_EDGE;
    let glass_edge = [red, green, blue].map(to_linear);
    let side = SUPERSAMPLE as usize;
    let [stride, height] = size.map(|samples| samples as usize);
    let mut pixmap = Pixmap::new(size[0] / SUPERSAMPLE, size[1] / SUPERSAMPLE)
        .ok_or_else(|| Error::View(format!("a picture of {size:?} samples")))?;
    let across = pixmap.width() as usize;
    for (at, pixel) in pixmap.data_mut().chunks_exact_mut(4).enumerate() {
        let corner = at / across * side * stride + at % across * side;
        let mut sum = [0.0; 3];
        for sample in (0..side * side).map(|i| corner + i / side * stride + i % side) {
            let shade = outline(&solid.keys, sample, [stride, height]);
            let mut light = mix(solid.light(sample, &table), [0.0; 3], shade);
            if let Some(glass) = glass {
                let edge = outline(&glass.keys, sample, [stride, height]);
                light = glass.before(light, sample, &table);
                light = mix(light, glass_edge, (GLASS_EDGE * edge).min(1.0));
            }
            for (total, light) in sum.iter_mut().zip(light) {
                *total += light;
            }
        }
        let mean = sum.map(|total| from_linear(total / (side * side) as f32));
        pixel.copy_from_slice(&[mean[0], mean[1], mean[2], u8::MAX]);
    }
    Ok(pixmap)
}

/// How much darker a sample is for its right and lower neighbours; less so far away.
fn outline(surfaces: &[[u32; 2]], at: usize, [width, height]: [usize; 2]) -> f32 {
    let (x, y) = (at % width, at / width);
    let [surface, packed] = surfaces[at];
    let mut darkest = 0.0_f32;
    for (is_inside, next) in [(x + 1 < width, at + 1), (y + 1 < height, at + width)] {
        if !is_inside || surfaces[next] == surfaces[at] {
            continue;
        }
        let [next_surface, next_packed] = surfaces[next];
        let clear = unpack(packed)[3].max(unpack(next_packed)[3]);
        let strength = if surface != next_surface {
            BORDER
        } else if cosine(unpack(packed), unpack(next_packed)) < CREASE_COSINE {
            CREASE
        } else {
            0.0
        };
        darkest = darkest.max(strength * clear * clear);
    }
    darkest
}

/// The four signed bytes that the shader packed.
fn unpack(packed: u32) -> [f32; 4] {
    packed
        .to_le_bytes()
        .map(|byte| f32::from(byte as i8) / 127.0)
}

fn cosine(a: [f32; 4], b: [f32; 4]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A pin where the observer stands.
fn mark_observer(pixmap: &mut Pixmap, scene: &PictureScene, view: &View, axes: &Axes, ground: f64) {
    let Some(observer) = &scene.observer else {
        return;
    };
    let unit = unit(view.width, view.height);
    let [x, y, z] = observer.eye;
    let foot = view.project(axes, [x, y, ground.min(z)]);
    let (Some(foot), false) = (foot, observer.eye == view.eye) else {
        return;
    };
    let head = [foot[0], foot[1] - PIN_HEIGHT * unit];
    let mut pole = PathBuilder::new();
    pole.move_to(foot[0], foot[1]);
    pole.line_to(head[0], head[1]);
    if let Some(pole) = pole.finish() {
        stroke(pixmap, &pole, palette::WHITE, 0.9, 4.5 * unit);
        stroke(pixmap, &pole, palette::INK, 1.0, 2.2 * unit);
    }
    draw_eye(pixmap, head, unit);
}

/// Height of the observer's pin in units.
const PIN_HEIGHT: f32 = 34.0;

/// The legend on a white card over the sky, and the attribution at the foot of the picture.
pub(super) fn draw_card(pixmap: &mut Pixmap, scene: &PictureScene, shows: Shows) {
    let unit = unit(pixmap.width(), pixmap.height());
    let (pad, edge) = (16.0 * unit, 18.0 * unit);
    let legend = Legend::new(scene, rows(scene, shows), unit, CARD_WIDTH * unit);
    let size = [CARD_WIDTH * unit + 2.0 * pad, legend.height() + 2.0 * pad];
    let under = [size[0] + 2.0 * unit, size[1] + 2.0 * unit];
    fill_round(
        pixmap,
        [edge - unit, edge],
        under,
        9.0 * unit,
        palette::INK,
        0.16,
    );
    fill_round(pixmap, [edge, edge], size, 8.0 * unit, palette::WHITE, 0.96);
    legend.draw(pixmap, edge + pad, edge + pad);
    if let Some([width, height]) = legend.attribution_size() {
        let gap = 6.0 * unit;
        let at = [edge, pixmap.height() as f32 - edge - height - gap];
        fill_round(
            pixmap,
            at,
            [width + 2.0 * gap, height + gap],
            4.0 * unit,
            palette::WHITE,
            0.85,
        );
        legend.draw_attribution(pixmap, at[0] + gap, at[1] + gap / 3.0);
    }
}

/// Width of the legend's text in units.
const CARD_WIDTH: f32 = 250.0;
