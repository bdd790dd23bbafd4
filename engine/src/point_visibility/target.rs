//! Whether a prism or a roof is hidden: its highest slope, against the horizon.

use std::ops::ControlFlow;

use glam::{DVec2, DVec3};

use super::projection::{Edge, Facing, Side, Span};
use super::{ROUNDINGS, SLOPE_MARGIN};

/// What is seen of a prism from outside its plan: its corners anticlockwise and relative to the eye,
/// and how far its top is above the eye.
///
/// Gives `visit` the lines that bound its highest slopes from above, side by side, until it breaks.
/// A top above the eye is highest where it is nearest; one below, where it is farthest. Breaks at
/// once where no bound is known.
pub fn outline_slopes(
    corners: &[DVec2],
    top: f64,
    mut visit: impl FnMut(&Span) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let is_above = top >= 0.0;
    let top = if is_above {
        top * (1.0 + SLOPE_MARGIN)
    } else {
        top * (1.0 - SLOPE_MARGIN)
    };
    let deciding = if is_above {
        Facing::Right
    } else {
        Facing::Left
    };
    let mut from = corners[corners.len() - 1];
    for &to in corners {
        let edge = Edge::new(from, to);
        from = to;
        match edge.facing() {
            Facing::EdgeOn => visit(&level(&edge, top, is_above)?)?,
            facing if facing == deciding => {
                let mut is_bounded = false;
                for (span, ..) in edge.spans() {
                    visit(&span.scaled(top))?;
                    is_bounded = true;
                }
                if !is_bounded {
                    return ControlFlow::Break(());
                }
            }
            _ => {}
        }
    }
    ControlFlow::Continue(())
}

/// The lines of the slopes of a straight edge, relative to the eye, side by side, until `visit`
/// breaks; bounds from above. Breaks at once where no bound is known.
///
/// Over an edge both `1 / w` and `z / w` are linear in the place: the edge is where `normal · p = 1`
/// in plan, and its height there is `heights · p`.
pub fn edge_slopes(
    from: DVec3,
    to: DVec3,
    mut visit: impl FnMut(&Span) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let edge = Edge::new(from.truncate(), to.truncate());
    let lifted = |z: f64| z + z.abs() * SLOPE_MARGIN;
    let (low, high) = (lifted(from.z), lifted(to.z));
    if edge.facing() == Facing::EdgeOn {
        let top = low.max(high);
        return visit(&level(&edge, top, top >= 0.0)?);
    }
    let [heights, slack] = edge.heights(low, high);
    let slack = ROUNDINGS * slack.max_element();
    let mut is_bounded = false;
    for (span, ..) in edge.spans() {
        let (at_zero, rise) = span.side.frame(heights);
        visit(&Span {
            at_zero: at_zero + slack,
            rise,
            ..span
        })?;
        is_bounded = true;
    }
    if is_bounded {
        ControlFlow::Continue(())
    } else {
        ControlFlow::Break(())
    }
}

/// A level line that bounds the slopes of an edge that is seen edge on.
fn level(edge: &Edge, top: f64, is_above: bool) -> ControlFlow<(), Span> {
    let [from, to] = edge.ends();
    let side = Side::leaving(from);
    let ((depth, _), (other_depth, _)) = (side.frame(from), side.frame(to));
    let (place, other_place) = (side.place(from), side.place(to));
    let is_known =
        depth > 0.0 && other_depth > 0.0 && place.abs() <= 1.0 && other_place.abs() <= 1.0;
    if !is_known {
        return ControlFlow::Break(());
    }
    let nearest = depth.min(other_depth);
    let farthest = depth.max(other_depth);
    ControlFlow::Continue(Span {
        side,
        from: place.min(other_place),
        to: place.max(other_place),
        at_zero: top / if is_above { nearest } else { farthest },
        rise: 0.0,
    })
}
