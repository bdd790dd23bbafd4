//! Solids to try, and the check of a column against its mesh.

use engine::{ColumnOptions, SolidColumn, SolidColumns, TriangleMesh, solid_columns, triangulate};
use geo::Area;
use glam::{DVec2, DVec3};

pub type Triangles = Vec<[DVec3; 3]>;

/// Far from the origin, as in national grids.
pub const FAR: DVec3 = DVec3::new(85_000.0, 447_000.0, 0.0);

/// As many columns as it takes.
pub const ALL: ColumnOptions = ColumnOptions {
    share: 1.0,
    most: 1000,
    least_gain: 0.0,
};

/// How far samples are moved into their column, metres.
pub const NUDGE: f64 = 1e-4;

/// A prism over a plan with holes; the outer ring turns anticlockwise, the others clockwise. Its
/// top is at `top(place)`.
pub fn prism(rings: &[&[[f64; 2]]], bottom: f64, top: impl Fn(DVec2) -> f64) -> Triangles {
    let places: Vec<Vec<DVec3>> = rings
        .iter()
        .map(|ring| ring.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect())
        .collect();
    let all = places.concat();
    let low = |p: DVec3| p.truncate().extend(bottom);
    let high = |p: DVec3| p.truncate().extend(top(p.truncate()));
    let mut surface = Vec::new();
    for triangle in triangulate(&places).expect("a polygon") {
        let [a, b, c] = triangle.map(|i| all[i]);
        surface.push([high(a), high(b), high(c)]);
        surface.push([low(a), low(c), low(b)]);
    }
    for ring in &places {
        for (i, &a) in ring.iter().enumerate() {
            let b = ring[(i + 1) % ring.len()];
            surface.push([low(a), low(b), high(b)]);
            surface.push([low(a), high(b), high(a)]);
        }
    }
    surface
}

pub fn rectangle(min: [f64; 2], max: [f64; 2]) -> [[f64; 2]; 4] {
    [min, [max[0], min[1]], max, [min[0], max[1]]]
}

pub fn boxed(min: [f64; 3], max: [f64; 3]) -> Triangles {
    let plan = rectangle([min[0], min[1]], [max[0], max[1]]);
    prism(&[&plan], min[2], |_| max[2])
}

/// A gabled house on the origin, its ridge along x.
pub fn gabled(length: f64, width: f64, eaves: f64, ridge: f64) -> Triangles {
    let half = width / 2.0;
    let plan = [
        [0.0, 0.0],
        [length, 0.0],
        [length, half],
        [length, width],
        [0.0, width],
        [0.0, half],
    ];
    let slopes = [[0, 1, 2, 5], [5, 2, 3, 4]].map(|slope| slope.map(|i: usize| plan[i]).to_vec());
    roofed(&slopes, |p| if p.y == half { ridge } else { eaves })
}

/// A house from 0 up under the slopes of its roof, without walls between them.
pub fn roofed(slopes: &[Vec<[f64; 2]>], top: impl Fn(DVec2) -> f64) -> Triangles {
    let solids = slopes.iter().map(|slope| prism(&[slope], 0.0, &top));
    let is_wall = |t: &[DVec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]).z == 0.0;
    let mut surface: Triangles = solids.flatten().filter(|t| !is_wall(t)).collect();
    let edges = || {
        let slopes = slopes.iter();
        slopes.flat_map(|slope| (0..slope.len()).map(|i| (slope[i], slope[(i + 1) % slope.len()])))
    };
    for (a, b) in edges().filter(|&(a, b)| edges().all(|edge| edge != (b, a))) {
        let [a, b] = [a, b].map(DVec2::from_array);
        surface.push([a.extend(0.0), b.extend(0.0), b.extend(top(b))]);
        surface.push([a.extend(0.0), b.extend(top(b)), a.extend(top(a))]);
    }
    surface
}

pub fn flipped(triangles: Triangles) -> Triangles {
    triangles.into_iter().map(|[a, b, c]| [a, c, b]).collect()
}

pub fn moved(triangles: Triangles, place: impl Fn(DVec3) -> DVec3) -> Triangles {
    triangles.into_iter().map(|t| t.map(&place)).collect()
}

/// Coordinates as delivered: whole millimetres.
pub fn delivered(point: DVec3) -> DVec3 {
    (point * 1000.0).round() / 1000.0
}

pub fn mesh(triangles: &Triangles) -> TriangleMesh {
    TriangleMesh::from_triangles(triangles.iter().copied())
}

pub fn search(triangles: &Triangles, options: &ColumnOptions) -> SolidColumns {
    let mesh = mesh(triangles);
    let found = solid_columns(&mesh, options).expect("solid");
    for column in &found.columns {
        if let Some(point) = outside(column, &mesh) {
            panic!("{point} outside: {} {column:?}", mesh.winding_number(point));
        }
        assert!(column.footprint.unsigned_area() > 0.0);
    }
    assert!(found.columns.len() <= options.most);
    assert!(
        found.share > 0.0 && found.share <= 1.0 + 1e-9,
        "{}",
        found.share
    );
    found
}

/// A point of the column around which the mesh does not wind: next to the corners and the middles
/// of edges of the triangles of its footprint, at the bottom, the top and between.
pub fn outside(column: &SolidColumn, mesh: &TriangleMesh) -> Option<DVec3> {
    let ring = |line: &geo::LineString| {
        let open = &line.0[..line.0.len() - 1];
        open.iter()
            .map(|c| DVec3::new(c.x, c.y, 0.0))
            .collect::<Vec<_>>()
    };
    let footprint = &column.footprint;
    let rings: Vec<_> = std::iter::once(footprint.exterior())
        .chain(footprint.interiors())
        .map(ring)
        .collect();
    let corners = rings.concat();
    // At shares of the height and the triangle where no wall or floor within the solid is.
    let height = |share: f64| column.bottom + share * (column.top - column.bottom);
    let heights = [column.bottom + NUDGE, height(0.487), column.top - NUDGE];
    for triangle in triangulate(&rings).expect("a valid footprint") {
        let [a, b, c] = triangle.map(|i| corners[i]);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        // Nothing narrower holds points of double precision.
        if (b - a).cross(c - a).length() < 1e-6 * longest {
            continue;
        }
        let centre = a * 0.31 + b * 0.322 + c * 0.368;
        for place in [a, b, c, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, centre] {
            let inward = (centre - place).clamp_length_max(NUDGE);
            for height in heights {
                let point = (place + inward).truncate().extend(height);
                if mesh.winding_number(point).round() < 1.0 {
                    return Some(point);
                }
            }
        }
    }
    None
}
