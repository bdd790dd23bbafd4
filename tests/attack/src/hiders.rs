//! What hides a target, in random scenes: nothing else is needed, none of it can be left out, and the
//! target cannot be seen past it.

use engine::{Hider, PointQuery, PointSolver, PointTarget, TargetShape, TileFeature};
use fastrand::Rng;
use oracle::{JudgedFeature, LeftOut, PointJudge};

use crate::observer::random_eye;
use crate::tiling::Tiling;
use crate::trial::Trial;

/// Scenes, and eyes in each.
const SCENES: u64 = 400;
const EYES: usize = 4;

/// Vertical planes to aim in.
const PLANES: usize = 24;

fn hiders(
    solver: &mut PointSolver,
    tiling: &mut Tiling,
    query: &PointQuery,
    target: &TileFeature,
) -> Option<Vec<Hider>> {
    let shape = match query.prisms {
        true if !target.outline.is_empty() => TargetShape::Prism(&target.outline),
        _ => TargetShape::Envelope,
    };
    let target = PointTarget {
        id: target.id,
        envelope: target.envelope,
        shape,
    };
    let Ok(hiders) = solver.hidden_by(query.eye, &target, tiling);
    hiders
}

/// Whether the solver leaves a target out where only some features are.
fn is_hidden(
    solver: &mut PointSolver,
    query: &PointQuery,
    features: &[TileFeature],
    target: &TileFeature,
    hiders: &[&Hider],
) -> bool {
    let ids = hiders.iter().map(|hider| hider.id);
    let all: Vec<TileFeature> = ids
        .chain([target.id])
        .map(|id| features[usize::try_from(id).expect("a position")].clone())
        .collect();
    !Tiling::single(&all)
        .answer(solver, query)
        .contains(&target.id)
}

#[test]
fn hiders_hide_alone_and_none_can_be_left_out() {
    let mut solver = PointSolver::default();
    let mut rng = Rng::with_seed(5);
    let (mut hidden, mut several) = (0, 0);
    for number in 0..SCENES {
        let trial = Trial::new(5, number);
        let mut tiling = Tiling::random(&mut rng, &trial.features);
        for _ in 0..EYES {
            let eye = random_eye(&mut rng, &trial.scene);
            let query = PointQuery {
                eye: eye.into(),
                range: f64::INFINITY,
                prisms: rng.bool(),
                wedge: None,
            };
            let visible = tiling.answer(&mut solver, &query);
            for target in &trial.features {
                let found = hiders(&mut solver, &mut tiling, &query, target);
                let place = format!("scene {number}, {query:?}, feature {}", target.id);
                assert_eq!(found.is_none(), visible.contains(&target.id), "{place}");
                let Some(found) = found else {
                    continue;
                };
                hidden += 1;
                several += usize::from(found.len() > 1);
                assert!(found.iter().all(|hider| hider.id != target.id), "{place}");
                let mut check = |hiders: &[&Hider]| {
                    is_hidden(&mut solver, &query, &trial.features, target, hiders)
                };
                let all: Vec<&Hider> = found.iter().collect();
                assert!(check(&all), "{place}: {found:?}");
                for at in 0..all.len() {
                    let mut fewer = all.clone();
                    fewer.remove(at);
                    assert!(!check(&fewer), "{place}: {found:?} without {at}");
                }
                judge(&mut rng, &trial, &query, target, &found);
            }
        }
    }
    assert!(hidden > 5000 && several > 500, "{hidden} {several}");
}

/// No point of the target can be seen where only the hiders are.
fn judge(rng: &mut Rng, trial: &Trial, query: &PointQuery, target: &TileFeature, found: &[Hider]) {
    let ids = found.iter().map(|hider| hider.id).chain([target.id]);
    let judged: Vec<JudgedFeature> = ids
        .map(|id| trial.judged[usize::try_from(id).expect("a position")].clone())
        .collect();
    let left_out = LeftOut {
        feature: found.len(),
        prism: query.prisms,
        range: query.range,
    };
    let search = PointJudge::new(&judged, query.eye.to_array()).search(&left_out, PLANES, rng);
    assert_eq!(search.witness, None, "{query:?}, {target:?}, {found:?}");
}
