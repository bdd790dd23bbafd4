//! [`City`], a generated city whose features are made as they are asked for.

use std::ops::Range;

use geo::Polygon;
use glam::I64Vec2;

use super::blocks::Blocks;
use super::cell::Cell;
use super::feature::CityFeature;
use super::paving::Paving;
use super::solid::Solid;
use super::streets::Streets;
use super::{hilbert, scattered, street};
use crate::Street;

/// Boxes in one part of a scattered city.
const BOXES_IN_PART: u32 = 32;

/// How a generated city is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CityLayout {
    /// Boxes of any size on both sides of one street: the city of the 2004 report.
    Scattered,
    /// A grid of blocks: closed perimeters around courtyards, free-standing buildings, squares.
    Blocks,
    /// Row houses along streets in all directions.
    Streets,
}

impl CityLayout {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Scattered, Self::Blocks, Self::Streets];

    /// What it is called.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Scattered => "scattered",
            Self::Blocks => "blocks",
            Self::Streets => "streets",
        }
    }
}

/// A city made from a seed. It is a sequence of parts that do not need each other: its cells along
/// Hilbert's curve, or some boxes of a scattered city. So features come in a space-filling order,
/// the extent grows with their number, and a smaller city is the beginning of a larger one.
#[derive(Clone, Copy, Debug)]
pub struct City {
    layout: CityLayout,
    features: usize,
    seed: u64,
}

/// The city of `features` buildings that a seed means.
#[must_use]
pub fn generated_city(layout: CityLayout, features: usize, seed: u64) -> City {
    City {
        layout,
        features,
        seed,
    }
}

impl City {
    /// Its features in order, one part of the city in memory at a time.
    pub fn features(&self) -> impl Iterator<Item = CityFeature> + use<> {
        self.features_of(0..u32::MAX)
    }

    /// The features of some of its parts, as many as the whole city has at the most.
    pub fn features_of(&self, parts: Range<u32>) -> impl Iterator<Item = CityFeature> + use<> {
        let Self { layout, seed, .. } = *self;
        parts
            .flat_map(move |part| part_of(layout, seed, part))
            .take(self.features)
    }

    /// Where observers can be: streets around every cell with a feature, and squares. They come in
    /// the order of the features, made one cell after the other.
    pub fn streets(&self) -> Box<dyn Iterator<Item = Street>> {
        let Self { seed, features, .. } = *self;
        match self.layout {
            CityLayout::Scattered => Box::new(std::iter::once(scattered::main_street())),
            CityLayout::Blocks => Box::new(streets_of(Blocks { seed }, features)),
            CityLayout::Streets => Box::new(streets_of(Streets::new(seed), features)),
        }
    }
}

/// The streets of the first cells that hold so many features; of one cell if there are none.
fn streets_of(plan: impl Plan, features: usize) -> impl Iterator<Item = Street> {
    let mut paving = Paving::default();
    let mut wanted = Some(features);
    let cells = (0..u32::MAX).map(hilbert::cell);
    let areas = cells.map_while(move |at| {
        let quarter = plan.quarter(at);
        wanted = match wanted?.saturating_sub(quarter.solids.len()) {
            0 => None,
            more => Some(more),
        };
        let mut areas = paving.around(at, |at| plan.cell(at));
        areas.extend(quarter.square);
        Some(areas)
    });
    areas.flatten().map(street)
}

fn part_of(layout: CityLayout, seed: u64, part: u32) -> Vec<CityFeature> {
    match layout {
        CityLayout::Scattered => scattered::boxes(seed, u64::from(part) * u64::from(BOXES_IN_PART))
            .take(BOXES_IN_PART as usize)
            .map(scattered::feature)
            .collect(),
        CityLayout::Blocks => features_at(&Blocks { seed }, part),
        CityLayout::Streets => features_at(&Streets::new(seed), part),
    }
}

fn features_at(plan: &impl Plan, part: u32) -> Vec<CityFeature> {
    let quarter = plan.quarter(hilbert::cell(part));
    quarter.solids.iter().map(Solid::feature).collect()
}

/// A street network without end, and what is built in it.
pub trait Plan {
    /// One cell of the network.
    fn cell(&self, at: I64Vec2) -> Cell;

    /// What there is inside a cell.
    fn quarter(&self, at: I64Vec2) -> Quarter;
}

/// What there is inside a cell of the street network.
#[derive(Default)]
pub struct Quarter {
    /// Its buildings.
    pub solids: Vec<Solid>,
    /// The whole cell, where it is a square; a building on it is a hole.
    pub square: Option<Polygon<f64>>,
}
