//! [`Extruded`], a closed solid over a footprint.

use super::frame::Frame;
use super::{Footprint, Rings, Roof};

/// Least height of a solid, metres: below, it could not be told from a surface.
const MIN_HEIGHT: f64 = 0.01;

/// Most vertices of a footprint that gets a roof: facets are found by comparing each with each.
const MAX_ROOFED_VERTICES: usize = 200;

/// The surfaces of a closed solid, all oriented outwards, positions shared bit for bit.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Extruded {
    /// The underside.
    pub(crate) bottom: Rings,
    /// The walls, a surface for each edge of the footprint.
    pub(crate) walls: Vec<Rings>,
    /// The roof.
    pub(crate) roofs: Vec<Rings>,
    /// Whether the roof is one level surface.
    pub(crate) is_flat: bool,
}

/// How high a solid reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Top {
    /// With the roof.
    Ridge(f64),
    /// Without the roof.
    Eaves(f64),
}

/// A roof over a footprint.
pub(super) struct RoofSurfaces {
    /// For each edge of each ring of the footprint the positions above it, from its start to
    /// before its end.
    pub(super) rims: Vec<Vec<Vec<[f64; 3]>>>,
    /// The surfaces, each looking up.
    pub(super) faces: Vec<Rings>,
}

impl Extruded {
    /// The solid between two heights, with a roof or a flat top; and whether the roof had to be
    /// left out since the footprint does not fit it. Or why there is none.
    pub(crate) fn new(
        footprint: &Footprint,
        bottom: f64,
        top: Top,
        roof: Option<&Roof>,
    ) -> Result<(Self, bool), &'static str> {
        let flat_top = match top {
            Top::Ridge(z) | Top::Eaves(z) => z,
        };
        if flat_top - bottom < MIN_HEIGHT {
            return Err("the top is not above the bottom");
        }
        let flat = || Self::under(footprint, bottom, flat_surfaces(footprint, flat_top), true);
        let Some(roof) = roof else {
            return Ok((flat(), false));
        };
        let roofed = roof_over(footprint, bottom, top, roof)
            .map(|surfaces| Self::under(footprint, bottom, surfaces, false))
            .filter(Self::is_closed);
        Ok(match roofed {
            Some(solid) => (solid, false),
            None => (flat(), true),
        })
    }

    /// Bottom and walls to a roof.
    fn under(footprint: &Footprint, bottom: f64, roof: RoofSurfaces, is_flat: bool) -> Self {
        let mut underside = footprint.at(bottom);
        underside.iter_mut().for_each(|ring| ring.reverse());
        let mut walls = Vec::new();
        for (ring, rim) in footprint.rings().iter().zip(&roof.rims) {
            let ends = ring.iter().skip(1).chain(ring.first());
            let next_rims = rim.iter().skip(1).chain(rim.first());
            for (((a, b), above), next) in ring.iter().zip(ends).zip(rim).zip(next_rims) {
                let mut wall = vec![[a[0], a[1], bottom], [b[0], b[1], bottom]];
                wall.extend(next.first());
                wall.extend(above.iter().rev());
                wall.dedup();
                if wall.first() == wall.last() {
                    wall.pop();
                }
                if wall.len() >= 3 {
                    walls.push(vec![wall]);
                }
            }
        }
        Self {
            bottom: underside,
            walls,
            roofs: roof.faces,
            is_flat,
        }
    }

    /// Whether each edge is met from the other side as often.
    pub(crate) fn is_closed(&self) -> bool {
        let mut edges: Vec<([[u64; 3]; 2], bool)> = Vec::new();
        let faces = self.walls.iter().chain(&self.roofs).chain([&self.bottom]);
        for ring in faces.flatten() {
            for (a, b) in ring.iter().zip(ring.iter().skip(1).chain(ring.first())) {
                let (a, b) = (a.map(f64::to_bits), b.map(f64::to_bits));
                edges.push(([a.min(b), a.max(b)], a < b));
            }
        }
        edges.sort_unstable();
        edges
            .chunk_by(|one, other| one.0 == other.0)
            .all(|edge| 2 * edge.iter().filter(|(_, forward)| *forward).count() == edge.len())
    }
}

/// A level top.
fn flat_surfaces(footprint: &Footprint, z: f64) -> RoofSurfaces {
    let rings = footprint.at(z);
    let rim = |ring: &Vec<[f64; 3]>| ring.iter().map(|position| vec![*position]).collect();
    RoofSurfaces {
        rims: rings.iter().map(rim).collect(),
        faces: vec![rings],
    }
}

/// A roof, never lower than the bottom.
fn roof_over(footprint: &Footprint, bottom: f64, top: Top, roof: &Roof) -> Option<RoofSurfaces> {
    if footprint.vertices() > MAX_ROOFED_VERTICES {
        return None;
    }
    let frame = Frame::of(footprint)?;
    let rise = roof.rise(&frame);
    let (eaves, rise) = match top {
        Top::Eaves(eaves) => (eaves, rise),
        Top::Ridge(ridge) => {
            let most = match roof.rise {
                super::Rise::Unsaid => (ridge - bottom) / 2.0,
                _ => ridge - bottom,
            };
            let rise = rise.min(most);
            // Where the roof reaches down to the bottom, both have the same bits.
            let eaves = if rise == ridge - bottom {
                bottom
            } else {
                ridge - rise
            };
            (eaves, rise)
        }
    };
    if !(rise >= MIN_HEIGHT && eaves >= bottom && rise <= super::MAX_HEIGHT) {
        return None;
    }
    roof.surfaces(footprint, &frame, eaves, rise)
}
