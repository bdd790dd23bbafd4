//! Polygons with holes as single rings, since faces of VRML97 have no holes: each hole is joined to
//! what is around it by an edge that is passed in both directions, so that all edges still pair.

/// A position on the grid that files are written on.
pub(super) type GridPoint = [i64; 3];

/// The two axes of a projection along which a polygon is not an edge.
#[derive(Clone, Copy)]
struct Projection {
    axes: [usize; 2],
    /// Whether the outer ring runs clockwise.
    clockwise: bool,
}

/// One ring for an outer ring and its holes.
pub(super) fn bridged(mut outer: Vec<GridPoint>, holes: Vec<Vec<GridPoint>>) -> Vec<GridPoint> {
    let projection = Projection::of(&outer);
    let start = |hole: &Vec<GridPoint>| (0..hole.len()).min_by_key(|i| projection.flat(hole[*i]));
    let mut holes: Vec<_> = holes
        .into_iter()
        .filter_map(|hole| start(&hole).map(|start| (hole[start], hole)))
        .collect();
    // From the left to the right, so that no hole to come is to the left of a bridge's start.
    holes.sort_by_key(|(start, _)| projection.flat(*start));
    for (_, mut hole) in holes {
        if projection.area(&hole) > 0 {
            hole.reverse();
        }
        let start = start(&hole).unwrap_or(0);
        let end = bridge_end(&outer, hole[start], projection);
        hole.rotate_left(start);
        hole.push(hole[0]);
        hole.push(outer[end]);
        outer.splice(end + 1..end + 1, hole);
    }
    outer
}

/// Where a bridge from a hole's leftmost point ends: at the nearest corner that is not to its right
/// and that it sees. Rings that cross each other may have none; then the nearest corner has to do.
fn bridge_end(outer: &[GridPoint], start: GridPoint, projection: Projection) -> usize {
    let from = projection.flat(start);
    let mut corners: Vec<_> = (0..outer.len()).collect();
    corners.sort_by_cached_key(|i| {
        let to = projection.flat(outer[*i]);
        (to > from, squared_distance(from, to))
    });
    let sees =
        |i: &usize| projection.is_inside(outer, *i, start) && projection.is_free(outer, *i, start);
    let seen = corners.iter().copied().find(sees);
    seen.or(corners.first().copied()).unwrap_or(0)
}

impl Projection {
    /// The projection that shows most of a ring.
    fn of(ring: &[GridPoint]) -> Self {
        let seen = |axes| Self {
            axes,
            clockwise: false,
        };
        let areas = [[0, 1], [1, 2], [2, 0]].map(|axes| (seen(axes).area(ring), axes));
        let largest = areas.into_iter().max_by_key(|(area, _)| area.abs());
        let (area, axes) = largest.unwrap_or((0, [0, 1]));
        Self {
            axes,
            clockwise: area < 0,
        }
    }

    fn flat(self, point: GridPoint) -> [i128; 2] {
        self.axes.map(|axis| i128::from(point[axis]))
    }

    /// Twice the area on the left of a ring, positive for the outer ring.
    fn area(self, ring: &[GridPoint]) -> i128 {
        let Some(&first) = ring.first() else {
            return 0;
        };
        let triangles = ring
            .windows(2)
            .map(|edge| self.turn(first, edge[0], edge[1]));
        triangles.sum()
    }

    /// Positive where the third point is on the inner side of the line through the others.
    fn turn(self, a: GridPoint, b: GridPoint, c: GridPoint) -> i128 {
        let [a, b, c] = [a, b, c].map(|point| self.flat(point));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if self.clockwise { -area } else { area }
    }

    /// Whether the way from a corner to a point begins inside the ring.
    fn is_inside(self, ring: &[GridPoint], corner: usize, point: GridPoint) -> bool {
        let count = ring.len();
        let (at, next) = (ring[corner], ring[(corner + 1) % count]);
        let before = ring[(corner + count - 1) % count];
        let after_next = self.turn(at, next, point);
        let after_before = self.turn(before, at, point);
        match self.turn(before, at, next) >= 0 {
            true => after_next >= 0 && after_before >= 0,
            false => after_next > 0 || after_before > 0,
        }
    }

    /// Whether no edge of the ring lies across the way from a corner to a point.
    fn is_free(self, ring: &[GridPoint], corner: usize, point: GridPoint) -> bool {
        let at = ring[corner];
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).all(|(&a, &b)| {
            let touches = [a, b].iter().any(|end| *end == at || *end == point);
            let sides = |p, q, r, s| self.turn(p, q, r).signum() * self.turn(p, q, s).signum();
            let apart = sides(at, point, a, b) > 0 || sides(a, b, at, point) > 0;
            let in_line = self.turn(at, point, a) == 0 && self.turn(at, point, b) == 0;
            touches || apart || in_line
        })
    }
}

fn squared_distance(a: [i128; 2], b: [i128; 2]) -> i128 {
    (a[0] - b[0]).pow(2) + (a[1] - b[1]).pow(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: i64, y: i64, size: i64) -> Vec<GridPoint> {
        let corners = [(x, y), (x + size, y), (x + size, y + size), (x, y + size)];
        corners.map(|(x, y)| [x, y, 7]).to_vec()
    }

    fn hole(x: i64, y: i64, size: i64) -> Vec<GridPoint> {
        square(x, y, size).into_iter().rev().collect()
    }

    /// Twice the area, and the edges that are not passed in both directions.
    fn summary(ring: &[GridPoint]) -> (i128, usize) {
        let edges: Vec<_> = ring.iter().zip(ring.iter().cycle().skip(1)).collect();
        let single = edges.iter().filter(|(a, b)| !edges.contains(&(b, a)));
        let flat = Projection {
            axes: [0, 1],
            clockwise: false,
        };
        (flat.area(ring), single.count())
    }

    #[test]
    fn holes_keep_their_edges_and_take_their_area() {
        let holes = vec![hole(60, 40, 10), hole(20, 45, 10), hole(40, 10, 10)];
        let outer = square(0, 0, 100);
        let ring = bridged(outer.clone(), holes.clone());
        assert_eq!(ring.len(), 4 + 3 * 6);
        assert_eq!(summary(&ring), (2 * (10_000 - 300), 16));
        let reversed = |ring: Vec<_>| ring.into_iter().rev().collect::<Vec<_>>();
        let holes = holes.into_iter().map(reversed).collect();
        assert_eq!(
            summary(&bridged(reversed(outer), holes)),
            (-2 * (10_000 - 300), 16)
        );
    }

    #[test]
    fn bridges_do_not_cross_the_outer_ring() {
        // The corner nearest to the hole lies behind a notch.
        let outer = [
            [0, 0],
            [100, 0],
            [100, 100],
            [0, 100],
            [0, 60],
            [49, 51],
            [49, 50],
            [0, 50],
        ];
        let outer: Vec<_> = outer.map(|[x, y]| [x, y, 0]).into();
        for hole in [hole(50, 60, 10), hole(50, 30, 10), hole(2, 80, 10)] {
            let ring = bridged(outer.clone(), vec![hole]);
            let end = ring
                .iter()
                .position(|point| ring.iter().filter(|p| *p == point).count() == 2);
            assert!(end.is_some());
            let (area, single) = summary(&ring);
            assert!(area > 0 && single == 12);
        }
    }

    #[test]
    fn what_is_no_polygon_still_gives_a_ring() {
        assert!(bridged(Vec::new(), Vec::new()).is_empty());
        assert_eq!(bridged(square(0, 0, 0), vec![Vec::new()]).len(), 4);
        assert_eq!(bridged(square(0, 0, 1), vec![hole(50, 50, 3)]).len(), 10);
    }
}
