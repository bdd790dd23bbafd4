//! The directions in plan of fields of view: whatever a field of view holds lies in its wedge.

use engine::{Box3d, Camera, Frustum, PlanWedge, ViewCone, ViewSector};
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

/// Radians by which fields of view may err to "yes": their slack is on cosines.
const SLACK: f64 = 1e-5;

/// Directions that are nearer to the upright have none in plan that could be told.
const UPRIGHT: f64 = 1e-3;

/// Whether a direction is in a wedge, or all but.
fn holds(wedge: &PlanWedge, plan: DVec2) -> bool {
    let anticlockwise = |from: DVec2, to: DVec2| from.angle_to(to).rem_euclid(TAU);
    let (width, place) = (
        anticlockwise(wedge.right, wedge.left),
        anticlockwise(wedge.right, plan),
    );
    place <= width + SLACK || place >= TAU - SLACK
}

fn direction() -> impl Strategy<Value = DVec3> {
    (-1.0..1.0_f64, 0.0..TAU).prop_map(|(z, azimuth)| {
        let level = (1.0 - z * z).sqrt();
        DVec3::new(level * azimuth.cos(), level * azimuth.sin(), z)
    })
}

/// Of some directions, those that a field of view holds must be in its wedge.
fn check(
    wedge: Option<PlanWedge>,
    looks: &[DVec3],
    meets: impl Fn(&Box3d) -> bool,
) -> Result<(), TestCaseError> {
    let Some(wedge) = wedge else {
        return Ok(());
    };
    for &look in looks {
        let plan = look.truncate();
        let point = look * 50.0;
        if plan.length() > UPRIGHT && meets(&Box3d::new(point, point)) {
            prop_assert!(holds(&wedge, plan), "{look} is not in {wedge:?}");
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..Default::default() })]

    #[test]
    fn cones_and_sectors_lie_in_their_wedges(
        heading in -10.0..10.0,
        angle in 0.001..TAU,
        pitch in -PI / 2.0..PI / 2.0,
        looks in prop::collection::vec(direction(), 100),
    ) {
        let cone = ViewCone::new(DVec3::ZERO, heading, angle, 100.0, pitch);
        check(cone.plan_wedge(), &looks, |point| cone.meets(point))?;
        let sector = ViewSector::new(DVec3::ZERO, heading, angle, 100.0);
        check(sector.plan_wedge(), &looks, |point| sector.meets(point))?;
    }

    #[test]
    fn frusta_lie_in_their_wedges(
        (look, up) in (direction(), direction()),
        fov in 0.01..3.1,
        aspect in 0.1..10.0,
        shift in (-2.0..2.0, -2.0..2.0),
        // Shares of the image, its corners and edges among them.
        places in prop::collection::vec((-1.0..=1.0_f64, -1.0..=1.0_f64), 50),
        anywhere in prop::collection::vec(direction(), 50),
    ) {
        let camera = Camera {
            eye: DVec3::ZERO,
            direction: look,
            up,
            fov,
            aspect,
            near: 0.001,
            far: 1000.0,
            shift: shift.into(),
        };
        if let (Some(frustum), Some(rays)) = (Frustum::new(&camera), camera.rays()) {
            let across = |x: f64| if x.abs() > 0.9 { x.signum() } else { x };
            let looks: Vec<DVec3> = places
                .iter()
                .map(|&(x, y)| {
                    let (u, v) = (across(x) / 2.0 + 0.5, across(y) / 2.0 + 0.5);
                    let lower = rays[0].lerp(rays[1], u);
                    lower.lerp(rays[3].lerp(rays[2], u), v).normalize()
                })
                .collect();
            check(frustum.plan_wedge(), &looks, |_| true)?;
            check(frustum.plan_wedge(), &anywhere, |point| frustum.meets(point))?;
        }
    }

    #[test]
    fn a_level_wedge_is_as_wide_as_its_field_of_view(heading in 0.0..TAU, half in 0.01..1.5_f64) {
        let width = |wedge: Option<PlanWedge>| {
            let wedge = wedge.expect("less than a turn");
            wedge.right.angle_to(wedge.left)
        };
        let cone = ViewCone::new(DVec3::ZERO, heading, 2.0 * half, 100.0, 0.0);
        let sector = ViewSector::new(DVec3::ZERO, heading, 2.0 * half, 100.0);
        prop_assert!((width(cone.plan_wedge()) - 2.0 * half).abs() < SLACK);
        prop_assert!((width(sector.plan_wedge()) - 2.0 * half).abs() < SLACK);
    }
}
