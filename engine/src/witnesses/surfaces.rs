//! [`Surfaces`], all that a sight line may meet, and how witnesses are found among it.

use std::collections::HashMap;
use std::ops::ControlFlow;
use std::sync::Arc;

use glam::DVec3;

use super::aims::Aims;
use super::surface_tile::{Contact, Line, SurfaceTile};
use crate::Box3d;

/// A sight line ends so far behind where it is aimed, metres: it is to pass through the surface there.
const BEYOND: f64 = 1e-3;

/// A sight line that proves that a feature can be seen: the open segment crosses a triangle of its
/// surface and meets none of another feature, not even in a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Witness {
    /// Where one looks from, metres.
    pub eye: DVec3,
    /// Where the line ends, just behind the surface, metres.
    pub end: DVec3,
}

/// What is sought from an eye.
#[derive(Clone, Copy, Debug)]
pub struct Sought<'a> {
    /// The feature.
    pub feature: i64,
    /// Sight lines may not leave it: all surfaces that meet it are known, metres.
    pub within: &'a Box3d,
    /// How many places at the top are aimed at, at the most.
    pub tops: usize,
    /// How many others, below them: what is seen under a bridge.
    pub anywhere: usize,
}

/// The surfaces around view cells.
#[derive(Debug)]
pub struct Surfaces {
    tiles: Vec<Arc<SurfaceTile>>,
    bounds: Vec<Option<Box3d>>,
    /// The tile of each feature.
    places: HashMap<i64, usize>,
}

impl Surfaces {
    /// Those of some tiles; no feature is in two of them.
    #[must_use]
    pub fn new(tiles: Vec<Arc<SurfaceTile>>) -> Self {
        let places = tiles.iter().enumerate();
        let places = places.flat_map(|(at, tile)| tile.features().map(move |id| (id, at)));
        Self {
            places: places.collect(),
            bounds: tiles.iter().map(|tile| tile.bounds()).collect(),
            tiles,
        }
    }

    /// A witness that a feature can be seen from an eye, if one is found. The same one always, as long as the
    /// surfaces are the same, however they are divided into tiles.
    #[must_use]
    pub fn witness(&self, eye: DVec3, sought: &Sought<'_>) -> Option<Witness> {
        let tile = *self.places.get(&sought.feature)?;
        let own = self.tiles[tile].of(sought.feature);
        let mut aims = Aims::new(eye, own);
        for _ in 0..sought.tops {
            let Some(aim) = aims.next_top() else { break };
            let line = line_through(eye, aim);
            let in_the_way = self.obstacles(&line, sought.feature);
            if in_the_way.is_empty() {
                match proof(&line, own, sought) {
                    None => break,
                    witness => return witness,
                }
            }
            aims.close(aim, &in_the_way);
        }
        aims.anywhere(sought.anywhere)
            .map(|aim| line_through(eye, aim))
            .filter(|line| self.is_clear(line, sought.feature))
            .find_map(|line| proof(&line, own, sought))
    }

    /// The triangles of other features that a line meets.
    fn obstacles(&self, line: &Line, feature: i64) -> Vec<&[DVec3; 3]> {
        let mut met = Vec::new();
        for tile in self.near(line) {
            let _ = tile.obstacles(line, feature, |triangle| {
                met.push(triangle);
                ControlFlow::Continue(())
            });
        }
        met
    }

    /// Whether a line meets no other feature.
    fn is_clear(&self, line: &Line, feature: i64) -> bool {
        let stop = |_: &_| ControlFlow::Break(());
        self.near(line)
            .all(|tile| tile.obstacles(line, feature, stop).is_continue())
    }

    /// Tiles that a line may meet.
    fn near(&self, line: &Line) -> impl Iterator<Item = &SurfaceTile> {
        let tiles = self.tiles.iter().zip(&self.bounds);
        tiles.filter_map(|(tile, bounds)| {
            let is_near = bounds.is_some_and(|bounds| line.may_meet(&bounds));
            is_near.then_some(&**tile)
        })
    }
}

/// The line that passes through a place.
fn line_through(eye: DVec3, place: DVec3) -> Line {
    Line::new(eye, place + (place - eye).normalize_or_zero() * BEYOND)
}

/// What a line that meets nothing else proves of a surface.
fn proof(line: &Line, own: &[[DVec3; 3]], sought: &Sought<'_>) -> Option<Witness> {
    let crosses = |triangle| line.contact(triangle) == Some(Contact::Crossing);
    let is_proof = sought.within.contains_point(line.end) && own.iter().any(crosses);
    is_proof.then_some(Witness {
        eye: line.eye,
        end: line.end,
    })
}
