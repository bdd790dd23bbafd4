//! Which pieces are the most useful: by the silhouettes that they show from around.

use glam::DVec2;

use super::ConvexPieceOptions;
use crate::ConvexPrism;

/// Directions from which silhouettes are taken, evenly spread over half a turn.
const DIRECTIONS: usize = 8;

/// An upright rectangle: least and greatest corner.
type Rectangle = [DVec2; 2];

/// The rectangle that a prism shows from each direction.
#[derive(Clone, Copy)]
struct Silhouette([Rectangle; DIRECTIONS]);

impl Silhouette {
    fn new(prism: &ConvexPrism) -> Self {
        Self(std::array::from_fn(|i| {
            let angle = i as f64 / DIRECTIONS as f64 * std::f64::consts::PI;
            let across = DVec2::from_angle(angle);
            let [least, most] = prism
                .footprint()
                .iter()
                .map(|vertex| across.dot(*vertex))
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], at| {
                    [least.min(at), most.max(at)]
                });
            [
                DVec2::new(least, prism.bottom()),
                DVec2::new(most, prism.top()),
            ]
        }))
    }

    /// Mean area that is outside the others, square metres.
    fn gain(&self, others: &[Self]) -> f64 {
        let outside = |i: usize| {
            let covers: Vec<Rectangle> = others.iter().map(|other| other.0[i]).collect();
            uncovered(self.0[i], &covers)
        };
        (0..DIRECTIONS).map(outside).sum::<f64>() / DIRECTIONS as f64
    }
}

/// The prisms that together show the largest silhouette, the largest gain first.
pub fn most_useful(prisms: Vec<ConvexPrism>, options: &ConvexPieceOptions) -> Vec<ConvexPrism> {
    let mut waiting: Vec<(Silhouette, ConvexPrism)> = prisms
        .into_iter()
        .map(|prism| (Silhouette::new(&prism), prism))
        .collect();
    let mut shown: Vec<Silhouette> = Vec::new();
    let mut chosen = Vec::new();
    let mut total = 0.0;
    while chosen.len() < options.most {
        let gains = waiting
            .iter()
            .map(|(silhouette, _)| silhouette.gain(&shown));
        let Some((best, gain)) = gains.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) else {
            break;
        };
        total += gain;
        if gain <= options.least_share * total {
            break;
        }
        let (silhouette, prism) = waiting.swap_remove(best);
        shown.push(silhouette);
        chosen.push(prism);
    }
    chosen
}

/// The area of a rectangle outside all others.
fn uncovered([min, max]: Rectangle, others: &[Rectangle]) -> f64 {
    if min.cmpge(max).any() {
        return 0.0;
    }
    let Some((&[low, high], others)) = others.split_first() else {
        return (max - min).element_product();
    };
    // Left of the first one, right of it, and between the two below and above it.
    let [left, right] = [low.x, high.x].map(|x| x.clamp(min.x, max.x));
    let parts = [
        [min, DVec2::new(left, max.y)],
        [DVec2::new(right, min.y), max],
        [DVec2::new(left, min.y), DVec2::new(right, max.y.min(low.y))],
        [
            DVec2::new(left, min.y.max(high.y)),
            DVec2::new(right, max.y),
        ],
    ];
    parts.into_iter().map(|part| uncovered(part, others)).sum()
}
