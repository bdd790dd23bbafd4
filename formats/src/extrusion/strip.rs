//! Lines with a width as areas.

use geo::algorithm::buffer::{Buffer, BufferStyle, LineCap, LineJoin};
use geo::{LineString, Polygon};

use super::footprint::{NO_AREA, line_string};
use super::frame::minus;
use super::sweep::{Edge, INTRICATE, each_pair};
use super::{Footprint, Plan};

/// Most vertices of a line that is widened as a whole; a longer one is cut, since the effort grows
/// with the square. Few lines are as long.
const PIECE: usize = 500;

/// Most edges of a piece that lie within its width of an edge, in the mean: where a street of 10 m
/// is drawn metre by metre there are 20.
const MAX_NEIGHBOURS: usize = 30;

/// Why a line that stays in a point has no area.
const NO_LENGTH: &str = "the line has no length";

/// Largest angle between neighbours on a round end or bend, radians.
const ROUND: f64 = 0.5;

/// Sharpest angle whose corner is kept, radians; sharper ones are cut off.
const SHARPEST_CORNER: f64 = 0.6;

/// How lines end and bend.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ends {
    /// Round: streets, which meet where they end.
    Round,
    /// Cut off, with sharp corners: walls.
    Square,
}

/// The areas within half a width of lines, which may overlap; or why there are none.
pub(crate) fn strips(
    lines: &[Vec<Plan>],
    width: f64,
    ends: Ends,
) -> Result<Vec<Footprint>, &'static str> {
    let mut areas = Vec::new();
    for line in lines {
        let line = closed_over(line);
        for start in (0..line.len().saturating_sub(1)).step_by(PIECE - 1) {
            let piece = &line[start..line.len().min(start + PIECE)];
            refuse_intricate(piece, width)?;
            for area in widened(piece, width, ends) {
                match area {
                    // Slivers between bends have no area, and are no loss.
                    Err(NO_AREA) => (),
                    area => areas.push(area?),
                }
            }
        }
    }
    match areas.is_empty() {
        true => Err(NO_LENGTH),
        false => Ok(areas),
    }
}

/// A line without repeated positions; a closed one overlaps itself by an edge, so that it has a
/// bend where it closes.
fn closed_over(line: &[Plan]) -> Vec<Plan> {
    let mut line = line.to_vec();
    line.dedup();
    if line.len() > 3 && line.first() == line.last() {
        line.push(line[1]);
    }
    line
}

/// Refuses a line that runs beside and across itself so much that its area would take long.
fn refuse_intricate(line: &[Plan], width: f64) -> Result<(), &'static str> {
    let most = MAX_NEIGHBOURS * line.len();
    let mut count = 0;
    each_pair(Edge::between(line, 0).collect(), width, &mut |_, _| {
        count += 1;
        if count > most { Err(INTRICATE) } else { Ok(()) }
    })
}

/// The areas around a line of at least two vertices.
fn widened(line: &[Plan], width: f64, ends: Ends) -> Vec<Result<Footprint, &'static str>> {
    let style = match ends {
        Ends::Round => BufferStyle::new(width / 2.0)
            .line_cap(LineCap::Round(ROUND))
            .line_join(LineJoin::Round(ROUND)),
        Ends::Square => BufferStyle::new(width / 2.0)
            .line_cap(LineCap::Butt)
            .line_join(LineJoin::Miter(SHARPEST_CORNER)),
    };
    // By offsets from its start, so that coordinates keep their digits.
    let origin = line.first().copied().unwrap_or_default();
    let local: Vec<Plan> = line
        .iter()
        .map(|position| minus(*position, origin))
        .collect();
    let areas = line_string(&local).buffer_with_style(style);
    areas
        .into_iter()
        .map(|area| footprint(&area, origin))
        .collect()
}

fn footprint(area: &Polygon, origin: Plan) -> Result<Footprint, &'static str> {
    let ring = |ring: &LineString| {
        ring.coords()
            .map(|c| [c.x + origin[0], c.y + origin[1]])
            .collect()
    };
    Footprint::unchecked(
        ring(area.exterior()),
        area.interiors().iter().map(ring).collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(lines: &[Vec<Plan>], ends: Ends) -> f64 {
        strips(lines, 2.0, ends)
            .unwrap()
            .iter()
            .map(Footprint::area)
            .sum()
    }

    #[test]
    fn strips_have_their_width() {
        let line = vec![[385_000.0, 6_672_000.0], [385_010.0, 6_672_000.0]];
        assert!((area(std::slice::from_ref(&line), Ends::Square) - 20.0).abs() < 1e-4);
        let round = area(&[line], Ends::Round) - 20.0;
        assert!((2.8..3.15).contains(&round), "{round}");
    }

    #[test]
    fn a_closed_wall_has_a_court_and_four_corners() {
        let ring = vec![
            [0.0, 0.0],
            [10.0, 0.0],
            [10.0, 10.0],
            [0.0, 10.0],
            [0.0, 0.0],
        ];
        let strips = strips(&[ring], 2.0, Ends::Square).unwrap();
        assert_eq!(strips.len(), 1);
        assert_eq!(strips[0].rings().len(), 2);
        assert!((strips[0].area() - (144.0 - 64.0)).abs() < 1e-4);
    }

    #[test]
    fn a_long_line_is_widened_in_pieces() {
        let line: Vec<Plan> = (0..1500)
            .map(|i| [f64::from(i), f64::from(i % 7) / 10.0])
            .collect();
        let strips = strips(&[line], 10.0, Ends::Round).unwrap();
        assert_eq!(strips.len(), 4);
        let bounds = strips
            .iter()
            .flat_map(|strip| &strip.rings()[0])
            .map(|p| p[0]);
        let (low, high) = bounds.fold((0.0, 0.0), |(l, h): (f64, f64), x| (l.min(x), h.max(x)));
        assert!(
            (low + 5.0).abs() < 0.2 && (high - 1504.0).abs() < 0.2,
            "{low} {high}"
        );
    }

    #[test]
    fn a_scribble_is_refused() {
        let line = (0..400)
            .map(|i| f64::from(i) * 2.4)
            .map(|a| [a.cos() * 99.0, a.sin() * 99.0]);
        assert_eq!(strips(&[line.collect()], 1.0, Ends::Round), Err(INTRICATE));
    }

    #[test]
    fn a_line_without_length_is_refused() {
        let error = |lines: &[Vec<Plan>]| strips(lines, 2.0, Ends::Round).unwrap_err();
        assert_eq!(error(&[]), "the line has no length");
        assert_eq!(error(&[vec![[1.0, 1.0]; 5]]), "the line has no length");
    }
}
