//! Lines of sight and first hits against the triangles of a whole scene.

use thiserror::Error;

use crate::aabb::{Aabb, Point};
use crate::bvh::{Bvh, Probe};
use crate::contact::{Line, Touch};
use crate::interval::Interval;
use crate::mesh::Triangle;
use crate::touch::{exact_ray_parameter, ray_parameter, segment_touch};

/// Largest coordinate, in metres and either sign, that a scene, an eye or a direction may have:
/// differences and products of such numbers do not overflow. No city comes near.
pub const MAX_COORDINATE: f64 = 1e100;

/// Relative width up to which the filter's interval of a distance is reported as it is: less than
/// a micrometre over any city, and wide enough that rationals are rarely needed.
const DISTANCE_ERROR: f64 = 1e-12;

/// A triangle that no ray can be cast at.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("triangle {triangle} of feature {id} has a coordinate that is not usable: {corners:?}")]
pub struct BadTriangle {
    /// The position of the triangle in the input.
    pub triangle: usize,
    /// The feature it belongs to.
    pub id: u32,
    /// Its corners as given.
    pub corners: Triangle,
}

/// The first thing that a ray meets.
#[derive(Clone, Debug, PartialEq)]
pub struct Hit {
    /// The features met at exactly this distance, ascending, each once. More than one is a tie, as
    /// on a wall that two houses share.
    pub ids: Vec<u32>,
    /// Distance from the eye in metres, good to 12 digits; the comparison behind it is exact.
    pub distance: f64,
    /// The position in the input of a triangle that is met there, one of the first id.
    pub triangle: usize,
}

/// What lies on the open segment between an eye and a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sight {
    /// No triangle of another feature meets the segment, not even in a point.
    Clear,
    /// Nothing is crossed, but a triangle of this feature is touched: at an edge, a vertex, or
    /// within its plane.
    Grazed {
        /// One of the features touched.
        id: u32,
    },
    /// The segment passes through the relative interior of a triangle of this feature.
    Blocked {
        /// One of the features in the way, not always the nearest.
        id: u32,
    },
    /// There is no segment: the ends are equal, not finite or beyond [`MAX_COORDINATE`].
    Undefined,
}

/// An exact ray caster over the triangles of a scene. It may be shared between threads.
#[derive(Clone, Debug)]
pub struct RayCaster {
    bvh: Bvh,
    /// In the order of the leaves.
    triangles: Vec<Tagged>,
}

#[derive(Clone, Copy, Debug)]
struct Tagged {
    corners: Triangle,
    id: u32,
}

/// A triangle that may be the first one met, by its place among the leaves.
struct Candidate {
    place: usize,
    parameter: Interval,
}

impl RayCaster {
    /// A caster over `triangles`, each with the id of its feature.
    ///
    /// # Errors
    /// The first triangle with a coordinate that is not finite or beyond [`MAX_COORDINATE`].
    pub fn new(triangles: &[(u32, Triangle)]) -> Result<Self, BadTriangle> {
        for (triangle, &(id, corners)) in triangles.iter().enumerate() {
            if !corners.iter().all(|&corner| is_usable(corner)) {
                return Err(BadTriangle {
                    triangle,
                    id,
                    corners,
                });
            }
        }
        let boxes: Vec<Aabb> = triangles
            .iter()
            .map(|(_, corners)| Aabb::around(corners))
            .collect();
        let bvh = Bvh::new(&boxes);
        let tagged = |&item: &u32| {
            let (id, corners) = triangles[item as usize];
            Tagged { corners, id }
        };
        let triangles = bvh.items().iter().map(tagged).collect();
        Ok(Self { bvh, triangles })
    }

    /// What the ray from `eye` in `direction` (of any length) meets first. The eye itself does not
    /// count: a triangle that it lies on is met only by a ray that runs within it, at distance 0.
    /// `None` if nothing is met, or if an argument is not finite, beyond [`MAX_COORDINATE`], or the
    /// direction is zero.
    #[must_use]
    pub fn first_hit(&self, eye: Point, direction: Point) -> Option<Hit> {
        if !is_usable(eye) || !is_usable(direction) || direction == [0.0; 3] {
            return None;
        }
        let line = Line::towards(eye, direction);
        let nearest = self.nearest(&line);
        let first = nearest
            .iter()
            .min_by_key(|candidate| self.triangles[candidate.place].id)?;
        let mut ids: Vec<u32> = nearest
            .iter()
            .map(|candidate| self.triangles[candidate.place].id)
            .collect();
        ids.sort_unstable();
        ids.dedup();
        let parameter = self.refined(&line, first);
        let triangle = self.bvh.items()[first.place] as usize;
        Some(Hit {
            ids,
            distance: parameter * length(direction),
            triangle,
        })
    }

    /// Whether anything but the feature `ignore` lies on the open segment from `eye` to `target`.
    #[must_use]
    pub fn is_clear(&self, eye: Point, target: Point, ignore: Option<u32>) -> Sight {
        if !is_usable(eye) || !is_usable(target) || eye == target {
            return Sight::Undefined;
        }
        let line = Line::through(eye, target);
        let probe = Probe::new(eye, line.direction);
        let mut sight = Sight::Clear;
        self.bvh.walk(&probe, 1.0, |places| {
            for Tagged { corners, id } in &self.triangles[places] {
                if ignore == Some(*id) {
                    continue;
                }
                match segment_touch(&line, target, corners) {
                    Some(Touch::Crossing) => {
                        sight = Sight::Blocked { id: *id };
                        return None;
                    }
                    Some(Touch::Grazing) => sight = Sight::Grazed { id: *id },
                    None => {}
                }
            }
            Some(1.0)
        });
        sight
    }

    /// All triangles that the ray meets at the least parameter.
    fn nearest(&self, line: &Line) -> Vec<Candidate> {
        let probe = Probe::new(line.origin, line.direction);
        let mut candidates: Vec<Candidate> = Vec::new();
        let mut limit = f64::INFINITY;
        self.bvh.walk(&probe, limit, |places| {
            for place in places {
                let Some(parameter) = ray_parameter(line, &self.triangles[place].corners) else {
                    continue;
                };
                if parameter.lo <= limit {
                    limit = limit.min(parameter.hi);
                    candidates.push(Candidate { place, parameter });
                }
            }
            Some(limit)
        });
        candidates.retain(|candidate| candidate.parameter.lo <= limit);
        if candidates.len() > 1 {
            self.exact_nearest(line, candidates)
        } else {
            candidates
        }
    }

    /// The parameter of a hit to within [`DISTANCE_ERROR`].
    fn refined(&self, line: &Line, hit: &Candidate) -> f64 {
        let Interval { lo, hi } = hit.parameter;
        if hi - lo <= DISTANCE_ERROR * lo {
            return 0.5 * lo + 0.5 * hi;
        }
        exact_ray_parameter(line, &self.triangles[hit.place].corners)
            .map_or(0.0, |parameter| parameter.to_f64().value())
    }

    /// The candidates at exactly the least parameter.
    fn exact_nearest(&self, line: &Line, candidates: Vec<Candidate>) -> Vec<Candidate> {
        let exact: Vec<_> = candidates
            .into_iter()
            .filter_map(|candidate| {
                let corners = &self.triangles[candidate.place].corners;
                Some((exact_ray_parameter(line, corners)?, candidate))
            })
            .collect();
        let least = exact.iter().map(|(parameter, _)| parameter).min().cloned();
        exact
            .into_iter()
            .filter(|(parameter, _)| Some(parameter) == least.as_ref())
            .map(|(_, candidate)| candidate)
            .collect()
    }
}

/// Whether all three coordinates are within [`MAX_COORDINATE`]; never with a NaN.
pub(crate) fn is_usable(point: Point) -> bool {
    point
        .iter()
        .all(|coordinate| coordinate.abs() <= MAX_COORDINATE)
}

fn length([x, y, z]: Point) -> f64 {
    x.hypot(y).hypot(z)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::contact::exact_contact;
    use crate::exact::Rational;
    use crate::scenes::{cases, points};

    const TRIANGLES: usize = 20;

    /// Triangles of ten features between an eye and a target, which lie in the same frame.
    fn scene() -> impl Strategy<Value = (Point, Point, Vec<(u32, Triangle)>)> {
        points::<{ 3 * TRIANGLES + 2 }>().prop_map(|points| {
            let corners = points[2..].chunks_exact(3);
            let triangles = corners
                .zip(0..)
                .map(|(c, i)| (i / 2, [c[0], c[1], c[2]]))
                .collect();
            (points[0], points[1], triangles)
        })
    }

    fn brute_sight(line: &Line, triangles: &[(u32, Triangle)], ignore: u32) -> (bool, bool) {
        let touches: Vec<Touch> = triangles
            .iter()
            .filter(|(id, _)| *id != ignore)
            .filter_map(|(_, corners)| exact_contact(line, corners))
            .filter(|contact| contact.last > Rational::ZERO && contact.first < Rational::ONE)
            .map(|contact| contact.touch)
            .collect();
        (
            touches.contains(&Touch::Crossing),
            touches.contains(&Touch::Grazing),
        )
    }

    proptest! {
        #![proptest_config(cases(1500))]
        #[test]
        fn sight_agrees_with_brute_force((eye, target, triangles) in scene(), ignore in 0..10u32) {
            prop_assume!(eye != target);
            let caster = RayCaster::new(&triangles).unwrap();
            let brute = brute_sight(&Line::through(eye, target), &triangles, ignore);
            match caster.is_clear(eye, target, Some(ignore)) {
                Sight::Clear => prop_assert_eq!(brute, (false, false)),
                Sight::Grazed { id } => {
                    prop_assert_eq!(brute, (false, true));
                    prop_assert!(id != ignore);
                }
                Sight::Blocked { id } => {
                    prop_assert!(brute.0);
                    prop_assert!(id != ignore);
                }
                Sight::Undefined => prop_assert!(false),
            }
        }

        #[test]
        fn first_hit_agrees_with_brute_force((eye, direction, triangles) in scene()) {
            prop_assume!(direction != [0.0; 3]);
            let line = Line::towards(eye, direction);
            let parameters: Vec<(Rational, u32)> = triangles
                .iter()
                .filter_map(|(id, c)| Some((exact_ray_parameter(&line, c)?, *id)))
                .collect();
            let hit = RayCaster::new(&triangles).unwrap().first_hit(eye, direction);
            let Some(least) = parameters.iter().map(|(t, _)| t).min() else {
                prop_assert_eq!(hit, None);
                return Ok(());
            };
            let mut ids: Vec<u32> =
                parameters.iter().filter(|(t, _)| t == least).map(|(_, id)| *id).collect();
            ids.dedup();
            let hit = hit.unwrap();
            let exact = least.to_f64().value() * length(direction);
            prop_assert!((hit.distance - exact).abs() <= 2.0 * DISTANCE_ERROR * exact);
            prop_assert_eq!(triangles[hit.triangle].0, ids[0]);
            prop_assert_eq!(hit.ids, ids);
        }
    }

    #[test]
    fn a_common_wall_is_a_tie() {
        let wall = [
            [85_000.0, 447_000.0, 0.0],
            [85_000.1, 447_010.3, 0.0],
            [85_000.0, 447_000.0, 9.7],
        ];
        let turned = [wall[2], wall[1], wall[0]];
        let behind = wall.map(|[x, y, z]: Point| [x.next_up(), y, z]);
        let caster = RayCaster::new(&[(7, wall), (3, turned), (1, behind)]).unwrap();
        let hit = caster
            .first_hit([84_990.0, 447_002.0, 1.6], [1.0, 0.01, 0.02])
            .unwrap();
        assert_eq!((hit.ids, hit.triangle), (vec![3, 7], 1));
    }

    #[test]
    fn a_difference_below_the_filter_is_no_tie() {
        let wall = |x: f64| [[x, -1.3, -1.1], [x, 2.7, -1.1], [x, 0.3, 3.9]];
        let walls = [
            (1, wall(10f64.next_up())),
            (2, wall(10.0)),
            (3, wall(10f64.next_up())),
        ];
        let caster = RayCaster::new(&walls).unwrap();
        let hit = caster.first_hit([0.0; 3], [0.7, 0.01, 0.02]).unwrap();
        assert_eq!((hit.ids, hit.triangle), (vec![2], 1));
    }

    #[test]
    fn an_empty_scene_hides_nothing() {
        let caster = RayCaster::new(&[]).unwrap();
        assert_eq!(caster.is_clear([0.0; 3], [1.0; 3], None), Sight::Clear);
        assert_eq!(caster.first_hit([0.0; 3], [1.0; 3]), None);
    }

    #[test]
    fn bad_input_is_refused() {
        let bad = [[0.0; 3], [1.0, f64::NAN, 0.0], [1.0; 3]];
        let error = RayCaster::new(&[(1, [[0.0; 3]; 3]), (9, bad)]).unwrap_err();
        assert_eq!((error.triangle, error.id), (1, 9));
        let caster = RayCaster::new(&[(1, [[0.0; 3], [1.0; 3], [2.0, 0.0, 0.0]])]).unwrap();
        assert_eq!(caster.is_clear([1.0; 3], [1.0; 3], None), Sight::Undefined);
        assert_eq!(
            caster.is_clear([f64::NAN; 3], [1.0; 3], None),
            Sight::Undefined
        );
        assert_eq!(caster.first_hit([0.0; 3], [0.0; 3]), None);
        assert_eq!(caster.first_hit([f64::INFINITY; 3], [1.0; 3]), None);
    }
}
