//! [`Trial`], the ways beside one another on cells of one size.

use std::collections::HashSet;
use std::time::Instant;

use engine::Box3d;
use indicatif::ProgressBar;

use super::points::Points;
use super::score::Score;
use super::way::Way;
use super::window::Window;
use crate::scene::Feature;

/// What came out for some cells.
pub struct Trial {
    /// Of each way.
    pub scores: Vec<Score>,
    /// What is missing from answers that claim to be complete.
    pub false_occlusions: Vec<String>,
    /// Of how many features points speak that the first way leaves out.
    pub by_points_alone: usize,
}

/// Has the ways answer for the cells in turn, so that what else the machine does hits all of them. `known` are the
/// features that are known to be visible from a cell, if any are.
pub fn run(
    window: &Window,
    cells: &[Box3d],
    ways: &mut [Box<dyn Way + '_>],
    known: &mut dyn FnMut(&Box3d) -> Option<HashSet<i64>>,
    bar: &ProgressBar,
) -> Trial {
    let mut points = Points::new(window);
    let mut trial = Trial {
        scores: ways.iter_mut().map(|way| prepared(way.as_mut())).collect(),
        false_occlusions: Vec::new(),
        by_points_alone: 0,
    };
    for cell in cells {
        let (seen, visible) = (points.union(cell), known(cell));
        for (at, (way, score)) in ways.iter_mut().zip(&mut trial.scores).enumerate() {
            let began = Instant::now();
            let held = way.answer(cell);
            score.times.push(began.elapsed().as_secs_f64() * 1e3);
            score.add(&held, &seen, visible.as_ref());
            if at == 0 {
                trial.by_points_alone += seen.difference(&held).count();
            }
            let missed = visible.iter().flatten().filter(|id| !held.contains(id));
            if way.is_complete() {
                let fault = |id| fault(way.name(), cell, &window.around.features, id);
                trial.false_occlusions.extend(missed.map(fault));
            }
        }
        bar.inc(1);
    }
    trial
}

/// A score without any cells.
fn prepared(way: &mut dyn Way) -> Score {
    let began = Instant::now();
    way.prepare();
    Score::new(way.name(), way.is_complete(), began.elapsed().as_secs_f64())
}

fn fault(way: &str, cell: &Box3d, features: &[Feature], id: &i64) -> String {
    let place = features.binary_search_by_key(id, |feature| feature.id);
    let feature = place.map_or(id.to_string(), |at| features[at].to_string());
    let Box3d { min, max } = cell;
    format!("\"{way}\" leaves out {feature}, which is seen from somewhere in {min} to {max}")
}
