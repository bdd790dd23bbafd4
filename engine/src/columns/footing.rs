//! [`Footing`], where a column stands, and the proven prisms over it.

use std::collections::{HashMap, HashSet};

use geo::Polygon;
use glam::DVec2;

use super::certificate::Certificate;
use super::outline::{Corner, Outline};
use super::plan::Plan;
use crate::predicates::turn;
use crate::triangulate;

/// How far computed corners are pulled inward, metres: a thousand times their rounding at national
/// coordinates, and less than any survey resolves. Doubled while the proof fails.
const PULL: f64 = 4e-6;

/// Beyond this pull cells that are not proven are cut out instead, metres.
const MOST_PULL: f64 = 1e-3;

/// A prism narrower than this is dropped, metres: it hides nothing at any distance.
const LEAST_WIDTH: f64 = 0.02;

/// A proven column.
pub struct Prism {
    pub footprint: Polygon<f64>,
    pub area: f64,
    pub bottom: f64,
    pub top: f64,
}

/// A connected piece of a plan.
pub struct Footing<'a> {
    plan: &'a Plan,
    triangles: &'a [usize],
}

impl<'a> Footing<'a> {
    pub fn new(plan: &'a Plan, triangles: &'a [usize]) -> Self {
        Self { plan, triangles }
    }

    /// The prisms over nearly all of the footing that are proven: mostly one.
    pub fn prisms(&self, [bottom, top]: [f64; 2], certificate: &mut Certificate) -> Vec<Prism> {
        let around = self.triangles.iter().map(|&t| self.plan.triangles[t]);
        let Some(outline) = Outline::around(self.plan, around) else {
            return Vec::new();
        };
        let mut pull = PULL;
        let mut shrink = 0.0;
        while pull <= MOST_PULL {
            let (bottom, top) = (bottom + shrink, top - shrink);
            if let Some(outline) = outline.straightened() {
                let outline = outline.pulled(pull);
                if let Some(cells) = Cells::new(&outline, &[])
                    && cells.proven(bottom, top, certificate).iter().all(|is| *is)
                {
                    return prism(&outline, bottom, top).into_iter().collect();
                }
            }
            pull *= 2.0;
            shrink = pull;
        }
        eprintln!("FAILED");
        Vec::new()
    }
}

fn prism(outline: &Outline, bottom: f64, top: f64) -> Option<Prism> {
    (outline.width() >= LEAST_WIDTH).then(|| Prism {
        footprint: outline.polygon(),
        area: outline.area(),
        bottom,
        top,
    })
}

/// An outline as triangles.
struct Cells {
    corners: Vec<Corner>,
    triangles: Vec<[usize; 3]>,
}

impl Cells {
    /// `None` where the rings cross. Otherwise the triangles turn anticlockwise, exactly, and have
    /// the rings for boundary, so they cover the outline once.
    fn new(outline: &Outline, seams: &[[Corner; 2]]) -> Option<Self> {
        let seams = seams.iter().map(|seam| seam.to_vec());
        let rings: Vec<Vec<Corner>> = outline.rings.iter().cloned().chain(seams).collect();
        let places: Vec<_> = rings
            .iter()
            .map(|ring| ring.iter().map(|corner| corner.place.extend(0.0)).collect())
            .collect();
        let mut triangles = triangulate(&places).ok()?;
        let corners = rings.concat();
        let place = |i: usize| corners[i].place;
        let turns = |t: &[usize; 3]| turn(place(t[0]), place(t[1]), place(t[2]));
        if triangles.iter().any(|t| turns(t) < 0.0) {
            return None;
        }
        triangles.retain(|t| turns(t) > 0.0);
        Some(Self { corners, triangles })
    }

    /// Which cells are solid between the heights.
    fn proven(&self, bottom: f64, top: f64, certificate: &mut Certificate) -> Vec<bool> {
        let place = |i: usize| self.corners[i].place;
        self.triangles
            .iter()
            .map(|t| certificate.proves(t.map(place), bottom, top))
            .collect()
    }
}
