//! Lines with a width as areas.

use geo::algorithm::buffer::{Buffer, BufferStyle, LineCap, LineJoin};
use geo::{LineString, MultiLineString, Polygon};

use super::footprint::{NO_AREA, line_string};
use super::sweep::{Edge, INTRICATE, each_pair};
use super::{Footprint, Plan};

/// Most vertices of a line.
const MAX_VERTICES: usize = 100_000;

/// Most edges of a line that lie within its width of an edge, in the mean: where a street of 10 m
/// is drawn metre by metre there are 20.
const MAX_NEIGHBOURS: usize = 50;

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

/// The areas within half a width of lines; or why there are none.
pub(crate) fn strips(
    lines: &[Vec<Plan>],
    width: f64,
    ends: Ends,
) -> Result<Vec<Footprint>, &'static str> {
    if lines.iter().map(Vec::len).sum::<usize>() > MAX_VERTICES {
        return Err("the line has more than 100000 vertices");
    }
    let Some(origin) = lines.iter().find_map(|line| line.first()).copied() else {
        return Err("the line has no length");
    };
    let local = |line: &Vec<Plan>| line_around(line, origin);
    let lines: Vec<LineString> = lines.iter().filter_map(local).collect();
    if lines.is_empty() {
        return Err("the line has no length");
    }
    refuse_intricate(&lines, width)?;
    let style = match ends {
        Ends::Round => BufferStyle::new(width / 2.0)
            .line_cap(LineCap::Round(ROUND))
            .line_join(LineJoin::Round(ROUND)),
        Ends::Square => BufferStyle::new(width / 2.0)
            .line_cap(LineCap::Butt)
            .line_join(LineJoin::Miter(SHARPEST_CORNER)),
    };
    let areas = MultiLineString::new(lines).buffer_with_style(style);
    let areas = areas.into_iter().map(|area| footprint(&area, origin));
    // Slivers between bends have no area, and are no loss.
    let areas = areas.filter(|area| *area != Err(NO_AREA));
    let areas: Vec<_> = areas.collect::<Result<_, _>>()?;
    match areas.is_empty() {
        true => Err(NO_AREA),
        false => Ok(areas),
    }
}

/// Refuses lines that run beside and across themselves so much that their area would take minutes.
fn refuse_intricate(lines: &[LineString], width: f64) -> Result<(), &'static str> {
    let plan = |line: &LineString| line.coords().map(|c| [c.x, c.y]).collect::<Vec<Plan>>();
    let plans: Vec<_> = lines.iter().map(plan).collect();
    let edges = plans.iter().flat_map(|line| Edge::between(line, 0));
    let edges: Vec<_> = edges.collect();
    let most = MAX_NEIGHBOURS * edges.len();
    let mut count = 0;
    each_pair(edges, width, &mut |_, _| {
        count += 1;
        if count > most { Err(INTRICATE) } else { Ok(()) }
    })
}

/// A line by offsets from an origin; a closed one overlaps itself by an edge, so that it has a bend
/// where it closes. None without a length.
fn line_around(line: &[Plan], origin: Plan) -> Option<LineString> {
    let mut line: Vec<Plan> = line
        .iter()
        .map(|[x, y]| [x - origin[0], y - origin[1]])
        .collect();
    line.dedup();
    if line.len() > 3 && line.first() == line.last() {
        line.push(line[1]);
    }
    (line.len() >= 2).then(|| line_string(&line))
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
        assert!((area(&[line.clone()], Ends::Square) - 20.0).abs() < 1e-4);
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
    fn a_line_without_length_is_refused() {
        let error = |lines: &[Vec<Plan>]| strips(lines, 2.0, Ends::Round).unwrap_err();
        assert_eq!(error(&[]), "the line has no length");
        assert_eq!(error(&[vec![[1.0, 1.0]; 5]]), "the line has no length");
    }
}
