//! What hides: the solid columns of the features, inside features of glass.

use super::ground::{open, triangulate};
use super::legend::Shows;
use super::perspective::{SHOWS, draw_card, shrink};
use super::surface::{self, SurfaceVertex, linear, normal, relative, stand};
use super::{Image, PictureColumn, PictureScene, View, ground, palette};
use crate::device::Renderer;
use crate::error::Result;
use crate::scene_mesh::is_drawable;

impl Renderer {
    /// Draws the columns of the features as a camera sees them, and the features as glass before
    /// them. Columns are inside their features, so that no glass is ever behind its columns.
    ///
    /// # Errors
    /// As [`Renderer::perspective`].
    pub fn columns(&self, scene: &PictureScene, view: &View) -> Result<Image> {
        let size = self.sampled_size(view)?;
        let axes = view.axes()?;
        let height = surface::ground_height(scene);
        let flat = ground::ground(scene, view.eye, height, false);
        let upright = columns(scene, view.eye, height);
        let solid = self.render(view, &axes, [&flat, &upright], size)?;
        let upright = surface::features(scene, view.eye, height, |_| palette::GLASS);
        let glass = self.render(view, &axes, [&[], &upright], size)?;
        let mut pixmap = shrink(&solid, Some(&glass), size)?;
        let shows = Shows {
            columns: true,
            ..SHOWS
        };
        draw_card(&mut pixmap, scene, shows);
        Ok(Image::from_pixmap(pixmap))
    }
}

/// The faces of all columns, standing on the ground. The walls of a feature are one surface, since
/// walls of nested columns lie in one plane; each top is a surface of its own, with a border.
fn columns(scene: &PictureScene, eye: [f64; 3], ground: f64) -> Vec<SurfaceVertex> {
    let mut vertices = Vec::new();
    let mut tops = (1..).skip(scene.features.len());
    for (walls, feature) in (1..).zip(&scene.features) {
        for (column, top) in feature.columns.iter().zip(&mut tops) {
            let color = linear(palette::column(column.grounded), 1.0);
            for (surface, triangle) in faces(column, ground, walls, top) {
                let Some(normal) = normal(&triangle) else {
                    continue;
                };
                vertices.extend(triangle.map(|corner| SurfaceVertex {
                    position: relative(corner, eye),
                    normal,
                    color,
                    surface,
                }));
            }
        }
    }
    vertices
}

/// The triangles of a column, each with its surface: the bottom is one with the walls. Nothing of a
/// column that cannot be drawn.
fn faces(column: &PictureColumn, ground: f64, walls: u32, top: u32) -> Vec<(u32, [[f64; 3]; 3])> {
    let (low, high) = (column.bottom, column.top);
    let footprint = &column.footprint;
    let rings = || std::iter::once(&footprint.exterior).chain(&footprint.holes);
    let can_draw = |&[x, y]: &[f64; 2]| is_drawable(&[x, y, low]) && is_drawable(&[x, y, high]);
    if !rings().flatten().all(can_draw) {
        return Vec::new();
    }
    let foot = if column.grounded { low } else { f64::MAX };
    let at = |[x, y]: [f64; 2], z: f64| stand([x, y, z], foot, ground);
    let triangles = triangulate(footprint);
    let flats = triangles
        .as_chunks()
        .0
        .iter()
        .flat_map(|triangle: &[_; 3]| {
            [(walls, low), (top, high)].map(|(surface, z)| (surface, triangle.map(|p| at(p, z))))
        });
    let edges = rings().flat_map(|ring| {
        let ring = open(ring);
        ring.iter().zip(ring.iter().cycle().skip(1))
    });
    let sides = edges.flat_map(|(&a, &b)| {
        let [a, b, c, d] = [at(a, low), at(b, low), at(b, high), at(a, high)];
        [(walls, [a, b, c]), (walls, [a, c, d])]
    });
    flats.chain(sides).collect()
}
