//! Samples on a surface, and what is seen of them past other features.

use oracle::{Aabb, RayCaster, SAMPLE_INSET, Sight, Triangle, solid_ground, surface_samples};

use crate::solids::box_mesh;

const NEAR: Aabb = Aabb {
    min: [85_000.0, 447_010.0, 0.0],
    max: [85_020.0, 447_020.0, 10.0],
};
const FAR: Aabb = Aabb {
    min: [85_005.0, 447_040.0, 0.0],
    max: [85_015.0, 447_050.0, 5.0],
};

fn surface(aabb: &Aabb) -> Vec<Triangle> {
    box_mesh(aabb).corners().unwrap()
}

fn caster(features: &[(u32, Vec<Triangle>)]) -> RayCaster {
    let tagged: Vec<(u32, Triangle)> = features
        .iter()
        .flat_map(|(id, part)| part.iter().map(move |t| (*id, *t)))
        .collect();
    RayCaster::new(&tagged).unwrap()
}

#[test]
fn samples_lie_on_the_surface() {
    for n in [0, 1, 7, 8, 64, 1000] {
        let samples = surface_samples(&surface(&FAR), n, 7);
        assert_eq!(samples.len(), n);
        for point in samples {
            let off = (0..3)
                .map(|axis| {
                    (point[axis] - FAR.min[axis])
                        .abs()
                        .min((point[axis] - FAR.max[axis]).abs())
                })
                .fold(f64::INFINITY, f64::min);
            let beyond = (0..3).any(|axis| {
                point[axis] < FAR.min[axis] - 1e-9 || point[axis] > FAR.max[axis] + 1e-9
            });
            assert!(off < 1e-9 && !beyond, "{point:?}");
        }
    }
}

#[test]
fn samples_are_stratified_and_reach_the_top() {
    let samples = surface_samples(&surface(&FAR), 256, 7);
    assert_eq!(samples, surface_samples(&surface(&FAR), 256, 7));
    assert_ne!(samples, surface_samples(&surface(&FAR), 256, 8));
    for axis in 0..3 {
        for side in [FAR.min[axis], FAR.max[axis]] {
            let on_face = samples
                .iter()
                .filter(|p| (p[axis] - side).abs() < 1e-9)
                .count();
            assert!(
                on_face >= 16,
                "{on_face} samples on a face of 12.5 to 25 % of the area"
            );
        }
    }
    for corner in FAR.corners().iter().filter(|corner| corner[2] == 5.0) {
        let near = samples.iter().any(|point| {
            let distance = (0..3)
                .map(|axis| (point[axis] - corner[axis]).powi(2))
                .sum::<f64>()
                .sqrt();
            (distance - SAMPLE_INSET).abs() < 1e-9
        });
        assert!(near, "no sample beside {corner:?}");
    }
}

#[test]
fn the_highest_vertices_come_first() {
    let floor = |i: u32| [0.0, 1.0, 2.0].map(|x| [f64::from(i) + x, x * x, 0.0]);
    let mut triangles: Vec<Triangle> = (0..50).map(floor).collect();
    triangles.push([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [3.0, 0.0, 90.0]]);
    let samples = surface_samples(&triangles, 8, 1);
    assert!(
        (samples[0][2] - 90.0).abs() <= SAMPLE_INSET,
        "{:?}",
        samples[0]
    );
}

#[test]
fn samples_of_poor_surfaces() {
    assert!(surface_samples(&[], 64, 1).is_empty());
    let missing = [[0.0, 0.0, f64::NAN], [1.0; 3], [2.0; 3]];
    assert!(surface_samples(&[missing], 64, 1).is_empty());
    let needle = [[0.0; 3], [4.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
    let samples = surface_samples(&[missing, needle, [[9.0; 3]; 3]], 64, 1);
    assert_eq!(samples.len(), 64);
    assert!(
        samples
            .iter()
            .all(|p| p[1] == 0.0 && p[2] == 0.0 || p.iter().all(|x| (x - 9.0).abs() < 1e-12))
    );
}

#[test]
fn rays_at_a_hidden_feature_are_all_stopped() {
    let caster = caster(&[(1, surface(&NEAR)), (2, surface(&FAR))]);
    let samples = surface_samples(&surface(&FAR), 64, 3);
    let eye = [85_010.0, 447_000.0, 1.7];
    for target in &samples {
        let sight = caster.is_clear(eye, *target, Some(2));
        assert_eq!(sight, Sight::Blocked { id: 1 });
    }
    // From a tower the roof shows.
    let tower = [85_010.0, 447_000.0, 40.0];
    assert!(
        samples
            .iter()
            .any(|target| caster.is_clear(tower, *target, Some(2)) == Sight::Clear)
    );
}

#[test]
fn a_grazed_wall_is_told_from_a_free_view() {
    let caster = caster(&[(1, surface(&NEAR))]);
    let past = |x: f64| caster.is_clear([x, 447_000.0, 1.7], [x, 447_040.0, 2.3], None);
    assert_eq!(past(85_020.0), Sight::Grazed { id: 1 });
    assert_eq!(past(85_020f64.next_up()), Sight::Clear);
    assert_eq!(past(85_020f64.next_down()), Sight::Blocked { id: 1 });
    let sight = caster.is_clear([85_010.0, 447_000.0, 1.7], [85_010.0, 447_010.0, 2.0], None);
    assert_eq!(sight, Sight::Clear, "up to the façade");
}

#[test]
fn first_hits_are_the_facade_and_the_ground() {
    let ground = solid_ground(&box_mesh(&NEAR), -30.0);
    let caster = caster(&[(1, surface(&NEAR)), (100, ground), (2, surface(&FAR))]);
    let eye = [85_010.0, 447_000.0, -3.0];
    let hit = caster.first_hit(eye, [0.0, 2.0, 0.0]).unwrap();
    assert_eq!((hit.ids, hit.distance), (vec![100], 10.0));
    let hit = caster.first_hit(eye, [0.0, 10.0, 4.0]).unwrap();
    assert_eq!(hit.ids, [1]);
    // At the foot both meet.
    let hit = caster.first_hit(eye, [0.0, 10.0, 3.0]).unwrap();
    assert_eq!(hit.ids, [1, 100]);
    assert_eq!(caster.first_hit(eye, [0.0, -1.0, 0.0]), None);
}

#[test]
fn a_caster_is_shared_between_threads() {
    let caster = caster(&[(1, surface(&NEAR)), (2, surface(&FAR))]);
    let seen = std::thread::scope(|scope| {
        let look = |x: f64| {
            let caster = &caster;
            scope.spawn(move || caster.is_clear([x, 447_000.0, 1.7], [x, 447_045.0, 4.0], None))
        };
        [85_010.0, 84_990.0]
            .map(look)
            .map(|thread| thread.join().unwrap())
    });
    assert!(matches!(seen[0], Sight::Blocked { .. }));
    assert_eq!(seen[1], Sight::Clear);
}
