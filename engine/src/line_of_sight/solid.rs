//! Where a sight line enters the interior of a solid.

use glam::DVec3;

use super::contact::{Contact, Passage};
use super::exact::{Rational, Vector, rational};
use super::neighbourhood::{arcs, places};
use super::sight_line::SightLine;
use super::winding::{ExactPlace, winding};

/// The share of the way at which the line first comes into the interior of the solid that closed,
/// outward triangles bound, by its contacts with them: to where the surface winds all round once or
/// more. A solid that has the beginning in its interior does not count before the line has been
/// outside.
pub fn entry(line: &SightLine, triangles: &[[DVec3; 3]], contacts: &[Contact]) -> Option<Rational> {
    let starts_on_surface = contacts.iter().any(|c| c.holds(&Rational::ZERO));
    // What starts outside has been outside after its first piece.
    let mut holds_eye =
        !starts_on_surface || is_all_round(triangles, contacts, &Rational::ZERO, &line.origin);
    // How often the surface winds around the piece before, where that is known.
    let mut around = (!starts_on_surface).then(|| winding(triangles, &line.from));
    for (number, piece) in cuts(contacts).windows(2).enumerate() {
        let (from, to) = (&piece[0], &piece[1]);
        let share = middle(from, to);
        let point = || line.exact_point(&share);
        if runs_along(contacts, &share) {
            around = None;
            if !holds_eye && is_all_round(triangles, contacts, &share, &point()) {
                return Some(from.clone());
            }
            continue;
        }
        let change = if number == 0 {
            Some(0)
        } else {
            change(contacts, from)
        };
        let known = around.zip(change).map(|(around, change)| around + change);
        let here = known.unwrap_or_else(|| winding(triangles, &ExactPlace::new(&point(), [])));
        around = Some(here);
        if here <= 0 {
            holds_eye = false;
        } else if !holds_eye {
            return Some(from.clone());
        }
    }
    None
}

/// Whether the surface winds once or more around everything next to a point on it, so that the point
/// is inside all the same: on a wall within.
fn is_all_round(
    triangles: &[[DVec3; 3]],
    contacts: &[Contact],
    share: &Rational,
    point: &Vector,
) -> bool {
    let arcs = arcs(contacts.iter().filter(|c| c.holds(share)), point);
    let places = places(&arcs);
    // Whatever is next to the point is next to a part of an arc.
    arcs.iter().all(|arc| {
        arc.on(&places).windows(2).all(|part| {
            let [from, to] = [part[0], part[1]].map(|place| &places[place]);
            let between: Vector = std::array::from_fn(|axis| &from[axis] + &to[axis]);
            let behind = arc.normal.each_ref().map(|component| -component);
            [arc.normal.clone(), behind].into_iter().all(|side| {
                winding(triangles, &ExactPlace::new(point, [between.clone(), side])) > 0
            })
        })
    })
}

/// The shares, ascending, between which contacts neither begin nor end; the first is 0, the last 1.
fn cuts(contacts: &[Contact]) -> Vec<Rational> {
    let ends = contacts.iter().flat_map(|c| [&c.first, &c.last]);
    let mut cuts: Vec<Rational> = ends
        .filter(|share| **share > Rational::ZERO && **share < Rational::ONE)
        .cloned()
        .chain([Rational::ZERO, Rational::ONE])
        .collect();
    cuts.sort_unstable();
    cuts.dedup();
    cuts
}

/// Whether the line runs in a triangle at a share that is no cut.
fn runs_along(contacts: &[Contact], share: &Rational) -> bool {
    contacts.iter().any(|contact| contact.holds(share))
}

/// How much more often the surface winds around the line after a cut than before, where it does
/// nothing there but pass through triangles.
fn change(contacts: &[Contact], cut: &Rational) -> Option<i64> {
    contacts
        .iter()
        .filter(|contact| contact.holds(cut))
        .map(|contact| {
            contact.passage.map(|passage| match passage {
                Passage::Inward => 1,
                Passage::Outward => -1,
            })
        })
        .sum()
}

fn middle(a: &Rational, b: &Rational) -> Rational {
    (a + b) * rational(0.5)
}
