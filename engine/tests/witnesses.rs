//! Witnesses against exact rays of other code.

use std::sync::Arc;

use engine::{
    Box3d, CellQuery, CellScene, CellSolver, CellTile, SolidColumn, Sought, Surface, SurfaceTile,
    Surfaces, Tile, TileFeature, TriangleMesh, Witness, extruded, witness,
};
use geo::{Rect, coord};
use glam::DVec3;
use oracle::{RayCaster, Sight};
use proptest::prelude::*;

/// Houses on a grid of a metre, so that many touch, or are one in another.
fn houses() -> impl Strategy<Value = Vec<Box3d>> {
    let house = (0..24_i32, 0..24_i32, 1..6_i32, 1..6_i32, 1..9_i32).prop_map(|(x, y, w, d, h)| {
        let min = DVec3::new(f64::from(x), f64::from(y), 0.0);
        Box3d::new(
            min,
            min + DVec3::new(f64::from(w), f64::from(d), f64::from(h)),
        )
    });
    prop::collection::vec(house, 1..20)
}

/// Small coordinates, and those of a national frame.
fn origins() -> impl Strategy<Value = DVec3> {
    prop_oneof![
        Just(DVec3::ZERO),
        Just(DVec3::new(85_000.1, 447_000.7, 12.3))
    ]
}

struct City {
    boxes: Vec<Box3d>,
    meshes: Vec<TriangleMesh>,
}

impl City {
    fn new(boxes: &[Box3d], origin: DVec3) -> Self {
        let boxes: Vec<Box3d> = boxes
            .iter()
            .map(|b| Box3d::new(b.min + origin, b.max + origin))
            .collect();
        let mesh = |b: &Box3d| {
            extruded(&footprint(b), b.min.z, b.max.z)
                .expect("a box")
                .mesh
        };
        Self {
            meshes: boxes.iter().map(mesh).collect(),
            boxes,
        }
    }

    /// In tiles of so many features.
    fn surfaces(&self, size: usize) -> Surfaces {
        let surfaces: Vec<Surface> = (0..)
            .zip(&self.meshes)
            .map(|(id, mesh)| Surface {
                id,
                triangles: mesh.corners().collect(),
            })
            .collect();
        let tile = |part: &[Surface]| Arc::new(SurfaceTile::new(part.iter().cloned()));
        Surfaces::new(surfaces.chunks(size).map(tile).collect())
    }

    fn caster(&self) -> RayCaster {
        let numbered = (0..).zip(&self.meshes);
        let triangles: Vec<_> = numbered
            .flat_map(|(id, mesh)| mesh.corners().map(move |t| (id, t.map(|c| c.to_array()))))
            .collect();
        RayCaster::new(&triangles).expect("finite corners")
    }

    fn scene(&self) -> CellScene {
        let features: Vec<TileFeature> = (0..)
            .zip(&self.boxes)
            .map(|(id, b)| TileFeature {
                id,
                envelope: *b,
                outline: Vec::new(),
                roof: None,
                columns: vec![SolidColumn {
                    footprint: footprint(b),
                    bottom: b.min.z,
                    top: b.max.z,
                    grounded: true,
                }],
            })
            .collect();
        CellScene::new(vec![Arc::new(CellTile::new(Tile::new(&features)))])
    }
}

fn footprint(b: &Box3d) -> geo::Polygon<f64> {
    Rect::new(
        coord! { x: b.min.x, y: b.min.y },
        coord! { x: b.max.x, y: b.max.y },
    )
    .to_polygon()
}

fn everywhere() -> Box3d {
    Box3d::new(DVec3::splat(-1e9), DVec3::splat(1e9))
}

fn holds(caster: &RayCaster, witness: &Witness, id: u32) -> bool {
    let (eye, end) = (witness.eye.to_array(), witness.end.to_array());
    caster.is_clear(eye, end, Some(id)) == Sight::Clear
        && matches!(caster.is_clear(eye, end, None), Sight::Blocked { .. })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn each_witness_holds_and_tiles_make_no_difference(
        boxes in houses(),
        origin in origins(),
        place in (-4.0..32.0_f64, -4.0..32.0_f64, 0.5..12.0_f64),
        whole in any::<bool>(),
    ) {
        let city = City::new(&boxes, origin);
        let place = DVec3::from(place);
        // On the grid eyes are in the planes of walls, on edges and on corners.
        let eye = origin + if whole { place.round() } else { place };
        let (together, apart, caster) = (city.surfaces(64), city.surfaces(1), city.caster());
        let within = everywhere();
        for (id, number) in (0..boxes.len() as i64).zip(0_u32..) {
            let sought = Sought { feature: id, within: &within, tops: 16, anywhere: 4 };
            let found = together.witness(eye, &sought);
            prop_assert_eq!(found, apart.witness(eye, &sought));
            if let Some(found) = found {
                prop_assert_eq!(found.eye, eye);
                prop_assert!(holds(&caster, &found, number), "{:?} of {}", found, id);
            }
        }
    }

    #[test]
    fn what_a_cell_proves_is_found_again(boxes in houses(), origin in origins()) {
        let city = City::new(&boxes, origin);
        let (scene, surfaces) = (city.scene(), city.surfaces(8));
        let low = origin + DVec3::new(-6.0, 4.0, 1.5);
        let query = CellQuery {
            bounds: Box3d::new(low, low + DVec3::new(4.0, 4.0, 0.5)),
            range: 30.0,
            precision: 0.5,
        };
        let mut solver = CellSolver::default();
        let visible = solver.solve(&scene, &query, &|_| true, &|| false).expect("not cancelled");
        let proven = solver
            .prove(&scene, &surfaces, &query, &visible, &|_| true, &|| false)
            .expect("not cancelled");
        let caster = city.caster();
        for (sighting, proof) in visible.iter().zip(&proven) {
            let id = scene.feature(sighting.feature).0;
            let again = witness(&surfaces, &query, id, &|eye| !scene.holds(eye));
            if let Some(proof) = proof {
                prop_assert!(query.bounds.contains_point(proof.eye));
                prop_assert!(holds(&caster, proof, id as u32));
                let again = again.expect("it was found before");
                prop_assert!(holds(&caster, &again, id as u32));
            }
        }
    }
}

#[test]
fn slits_are_looked_through_and_what_is_hidden_has_no_witness() {
    // Two walls with a slit of a centimetre, a house behind it, and one behind a wall.
    let boxes = [
        ([0.0, 0.0, 0.0], [20.0, 1.0, 9.0]),
        ([20.01, 0.0, 0.0], [40.0, 1.0, 9.0]),
        ([18.0, 4.0, 0.0], [22.0, 8.0, 3.0]),
        ([2.0, 4.0, 0.0], [6.0, 8.0, 3.0]),
    ];
    let boxes = boxes.map(|(min, max)| Box3d::new(min.into(), max.into()));
    let city = City::new(&boxes, DVec3::ZERO);
    let surfaces = city.surfaces(2);
    let within = everywhere();
    let found = |feature| {
        let sought = Sought {
            feature,
            within: &within,
            tops: 24,
            anywhere: 8,
        };
        surfaces.witness(DVec3::new(20.005, -20.0, 1.7), &sought)
    };
    assert!(found(0).is_some() && found(1).is_some() && found(2).is_some());
    assert_eq!(found(3), None);
    // No line leaves what is known, and an unknown feature has none.
    let near = Box3d::new(DVec3::new(0.0, -30.0, 0.0), DVec3::new(40.0, 3.0, 30.0));
    let sought = Sought {
        feature: 2,
        within: &near,
        tops: 24,
        anywhere: 8,
    };
    assert_eq!(
        surfaces.witness(DVec3::new(20.005, -20.0, 1.7), &sought),
        None
    );
    assert_eq!(found(9), None);
}
