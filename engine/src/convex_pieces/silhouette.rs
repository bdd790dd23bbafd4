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

    /// Mean area of what no single one of the others shows as well, square metres.
    fn gain(&self, others: &[Self]) -> f64 {
        let outside = |i: usize| {
            let own = self.0[i];
            let shared = others.iter().map(|other| area(common(own, other.0[i])));
            area(own) - shared.fold(0.0, f64::max)
        };
        (0..DIRECTIONS).map(outside).sum::<f64>() / DIRECTIONS as f64
    }
}

/// The prisms that show the most that no other one shows, the largest gain first.
pub fn most_useful(prisms: Vec<ConvexPrism>, options: &ConvexPieceOptions) -> Vec<ConvexPrism> {
    let mut waiting: Vec<(Silhouette, ConvexPrism)> = prisms
        .into_iter()
        .map(|prism| (Silhouette::new(&prism), prism))
        .collect();
    let mut shown: Vec<Silhouette> = Vec::new();
    let mut chosen = Vec::new();
    let mut least = 0.0;
    while chosen.len() < options.most {
        let gains = waiting
            .iter()
            .map(|(silhouette, _)| silhouette.gain(&shown));
        let Some((best, gain)) = gains.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) else {
            break;
        };
        if chosen.is_empty() {
            least = options.least_share * gain;
        }
        if gain <= least {
            break;
        }
        let (silhouette, prism) = waiting.swap_remove(best);
        shown.push(silhouette);
        chosen.push(prism);
    }
    chosen
}

fn common([min, max]: Rectangle, [other_min, other_max]: Rectangle) -> Rectangle {
    let min = min.max(other_min);
    [min, max.min(other_max).max(min)]
}

fn area([min, max]: Rectangle) -> f64 {
    (max - min).element_product()
}
