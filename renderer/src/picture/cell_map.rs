//! Maps of view cells: how much may be seen from each, and from where one feature may be seen.

use super::color_scale::ColorScale;
use super::legend::{Row, counted, uncounted};
use super::palette::{self, Rgb};
use super::plan::PlanView;
use super::sheet::Sheet;
use super::{Image, PictureScene};
use crate::error::Result;
use tiny_skia::{IntRect, Transform};

/// A view cell from above, with what is told of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PictureCell<T> {
    /// Opposite corners, in metres.
    pub rectangle: ([f64; 2], [f64; 2]),
    /// What is told.
    pub told: T,
}

/// Whether one feature is seen from a view cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Sight {
    /// From nowhere in it.
    Hidden,
    /// From somewhere in it, as far as is known.
    Possible,
    /// From somewhere in it, as a witness shows.
    Proven,
}

impl Sight {
    /// All three, in the order of the legend.
    const ALL: [Sight; 3] = [Sight::Proven, Sight::Possible, Sight::Hidden];

    fn color(self) -> Rgb {
        match self {
            Sight::Hidden => palette::UNSEEN,
            Sight::Possible => palette::POSSIBLE,
            Sight::Proven => palette::PROVEN,
        }
    }

    fn label(self) -> &'static str {
        match self {
            Sight::Hidden => "Not seen from here",
            Sight::Possible => "May be seen from here",
            Sight::Proven => "Seen from here, proven",
        }
    }
}

/// Draws the scene from above with each view cell in the colour of a number, such as how many
/// features may be seen from it, under the features in grey; beside it a colour bar with this
/// caption. Where cells lie over one another, the greatest number is drawn.
///
/// # Errors
/// As [`super::plan`].
pub fn heat_map(
    scene: &PictureScene,
    cells: &[PictureCell<u64>],
    caption: &str,
    view: &PlanView,
) -> Result<Image> {
    let mut sheet = Sheet::new(scene, view)?;
    let cells = shown(&sheet, cells);
    let scale = ColorScale::over(cells.iter().map(|&(number, _)| number));
    let mut rows = draw_cells(&mut sheet, scene, &cells, |number| scale.color(number));
    draw_features(&mut sheet, scene, None);
    rows.insert(
        0,
        counted(palette::MUTED, 1.0, "Features", scene.features.len()),
    );
    let room = sheet.draw_side(scene, rows);
    scale.draw(&mut sheet.pixmap, caption, &room, sheet.unit);
    Ok(Image::from_pixmap(sheet.pixmap))
}

/// Draws the scene from above with each view cell in the colour of whether one feature, by its
/// position in the scene, is seen from it; that feature stands out, and all others are grey.
///
/// # Errors
/// As [`super::plan`].
pub fn sight_map(
    scene: &PictureScene,
    feature: usize,
    cells: &[PictureCell<Sight>],
    view: &PlanView,
) -> Result<Image> {
    let mut sheet = Sheet::new(scene, view)?;
    let shown = shown(&sheet, cells);
    let bare = draw_cells(&mut sheet, scene, &shown, Sight::color);
    draw_features(&mut sheet, scene, Some(feature));
    let mut rows = sight_rows(cells);
    rows.extend(bare);
    let others = scene.features.len().saturating_sub(1);
    rows.push(uncounted(palette::SUBJECT, "The feature"));
    rows.push(counted(palette::MUTED, 1.0, "Other features", others));
    sheet.draw_side(scene, rows);
    Ok(Image::from_pixmap(sheet.pixmap))
}

/// How many cells there are of each colour, where there are any.
fn sight_rows(cells: &[PictureCell<Sight>]) -> Vec<Row> {
    let count = |sight| cells.iter().filter(|cell| cell.told == sight).count();
    let rows = Sight::ALL.map(|sight| (sight, count(sight)));
    let rows = rows.iter().filter(|(_, count)| *count > 0);
    rows.map(|&(sight, count)| counted(sight.color(), 1.0, sight.label(), count))
        .collect()
}

/// The cells on the map, in the order of what is told of them: the greatest is drawn last.
fn shown<T: Copy + Ord>(sheet: &Sheet, cells: &[PictureCell<T>]) -> Vec<(T, IntRect)> {
    let place = |cell: &PictureCell<T>| Some((cell.told, sheet.map.rectangle(cell.rectangle)?));
    let mut shown: Vec<_> = cells.iter().filter_map(place).collect();
    shown.sort_by_key(|&(told, _)| told);
    shown
}

/// Draws cells on their streets. Returns a row for the streets that no cell covers, if there are any.
fn draw_cells<T: Copy>(
    sheet: &mut Sheet,
    scene: &PictureScene,
    cells: &[(T, IntRect)],
    color: impl Fn(T) -> Rgb,
) -> Vec<Row> {
    sheet.map.draw_streets(&mut sheet.pixmap, &scene.streets);
    for &(told, place) in cells {
        let paint = color(told).paint(1.0);
        sheet
            .pixmap
            .fill_rect(place.to_rect(), &paint, Transform::identity(), None);
    }
    let bare = uncounted(palette::STREET, "Streets without view cells");
    Vec::from_iter(shows(sheet, palette::STREET).then_some(bare))
}

/// Whether a pixel of the map has a colour.
fn shows(sheet: &Sheet, Rgb(r, g, b): Rgb) -> bool {
    let lines = sheet.pixmap.pixels().chunks(sheet.pixmap.width() as usize);
    let across = sheet.map.size[0] as usize;
    let mut pixels = lines.flat_map(|line| line.iter().take(across));
    pixels.any(|pixel| [pixel.red(), pixel.green(), pixel.blue()] == [r, g, b])
}

/// Draws all features in grey, and one that stands out over them.
fn draw_features(sheet: &mut Sheet, scene: &PictureScene, subject: Option<usize>) {
    let Sheet { pixmap, map, unit } = sheet;
    for feature in &scene.features {
        map.draw_feature(pixmap, feature, palette::MUTED, *unit);
    }
    if let Some(feature) = subject.and_then(|subject| scene.features.get(subject)) {
        map.draw_feature(pixmap, feature, palette::SUBJECT, *unit);
        map.draw_ring(pixmap, feature, palette::SUBJECT, *unit);
    }
}
