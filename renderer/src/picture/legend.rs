//! The legend: title, what was asked, and how many features there are of each colour.

use super::palette::{self, Rgb};
use super::shapes::{draw_eye, fill_rect, fill_round, outline_round};
use super::text::{Style, Weight};
use super::{PictureScene, Status};
use tiny_skia::Pixmap;

/// What a row of the legend shows beside its label.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Swatch {
    Patch { fill: Rgb, alpha: f32, edge: Rgb },
    Eye,
}

/// A line of a legend.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Row {
    swatch: Swatch,
    label: &'static str,
    count: Option<usize>,
}

/// What a kind of picture shows, beside the features.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shows {
    /// The colour of streets.
    pub street: Rgb,
    pub rectangles: bool,
    /// The observer and the field of view.
    pub observer: bool,
    /// Columns inside transparent features, instead of an answer.
    pub columns: bool,
}

/// A legend laid out for a width.
pub(crate) struct Legend {
    title: Vec<String>,
    subtitle: Vec<String>,
    attribution: Vec<String>,
    rows: Vec<Row>,
    unit: f32,
    width: f32,
}

/// Sizes of the type and the distances between, in units.
const TITLE: f32 = 21.0;
const TITLE_LINE: f32 = 26.0;
const SUBTITLE: f32 = 13.0;
const SUBTITLE_LINE: f32 = 18.0;
const ROW: f32 = 14.0;
const ROW_LINE: f32 = 24.0;
const SMALL: f32 = 11.0;
const SMALL_LINE: f32 = 15.0;
const GAP: f32 = 12.0;
const SWATCH: f32 = 14.0;

impl Legend {
    /// `unit` is the size of a typographic point in pixels, `width` what the legend may take.
    pub(crate) fn new(scene: &PictureScene, rows: Vec<Row>, unit: f32, width: f32) -> Self {
        let title = style(TITLE * unit, Weight::Bold, palette::INK);
        let subtitle = style(SUBTITLE * unit, Weight::Regular, palette::FADED_INK);
        let small = style(SMALL * unit, Weight::Regular, palette::FADED_INK);
        Self {
            title: title.wrap(&scene.title, width),
            subtitle: subtitle.wrap(&scene.subtitle, width),
            attribution: small.wrap(&scene.attribution, width),
            rows,
            unit,
            width,
        }
    }

    /// Height in pixels, without the attribution.
    pub(crate) fn height(&self) -> f32 {
        let lines = TITLE_LINE * self.title.len() as f32
            + SUBTITLE_LINE * self.subtitle.len() as f32
            + ROW_LINE * self.rows.len() as f32;
        (lines + 2.5 * GAP) * self.unit
    }

    /// Width and height of the attribution in pixels; nothing when there is none.
    pub(crate) fn attribution_size(&self) -> Option<[f32; 2]> {
        let small = style(SMALL * self.unit, Weight::Regular, palette::FADED_INK);
        let width = self
            .attribution
            .iter()
            .map(|line| small.width(line))
            .reduce(f32::max)?;
        Some([width, self.attribution_height()])
    }

    /// Height of the attribution in pixels.
    pub(crate) fn attribution_height(&self) -> f32 {
        SMALL_LINE * self.unit * self.attribution.len() as f32
    }

    /// Draws all but the attribution from a top left corner.
    pub(crate) fn draw(&self, pixmap: &mut Pixmap, x: f32, top: f32) {
        let unit = self.unit;
        let mut y = top;
        let title = style(TITLE * unit, Weight::Bold, palette::INK);
        for line in &self.title {
            title.draw(pixmap, line, x, y + TITLE * unit);
            y += TITLE_LINE * unit;
        }
        y += GAP / 2.0 * unit;
        let subtitle = style(SUBTITLE * unit, Weight::Regular, palette::FADED_INK);
        for line in &self.subtitle {
            subtitle.draw(pixmap, line, x, y + SUBTITLE * unit);
            y += SUBTITLE_LINE * unit;
        }
        y += GAP * unit;
        fill_rect(
            pixmap,
            [x, y],
            [self.width, unit.max(1.0)],
            palette::RULE,
            1.0,
        );
        y += GAP * unit;
        for row in &self.rows {
            self.draw_row(pixmap, row, x, y);
            y += ROW_LINE * unit;
        }
    }

    /// Draws the attribution from a top left corner.
    pub(crate) fn draw_attribution(&self, pixmap: &mut Pixmap, x: f32, top: f32) {
        let small = style(SMALL * self.unit, Weight::Regular, palette::FADED_INK);
        for (line, text) in self.attribution.iter().enumerate() {
            let y = top + (SMALL_LINE * line as f32 + SMALL) * self.unit;
            small.draw(pixmap, text, x, y);
        }
    }

    fn draw_row(&self, pixmap: &mut Pixmap, row: &Row, x: f32, y: f32) {
        let unit = self.unit;
        let side = SWATCH * unit;
        let top = y + (ROW_LINE * unit - side) / 2.0;
        match row.swatch {
            Swatch::Patch { fill, alpha, edge } => {
                fill_round(pixmap, [x, top], [side, side], 3.0 * unit, fill, alpha);
                outline_round(pixmap, [x, top], [side, side], 3.0 * unit, edge, unit);
            }
            Swatch::Eye => draw_eye(pixmap, [x + side / 2.0, top + side / 2.0], 0.75 * unit),
        }
        let baseline = y + ROW_LINE * unit / 2.0 + ROW * unit * 0.36;
        let label = style(ROW * unit, Weight::Regular, palette::INK);
        label.draw(pixmap, row.label, x + side + 10.0 * unit, baseline);
        if let Some(count) = row.count {
            let number = style(ROW * unit, Weight::Bold, palette::INK);
            number.draw_right(pixmap, &grouped(count), x + self.width, baseline);
        }
    }
}

/// What the picture shows, and nothing that it does not show.
pub(crate) fn rows(scene: &PictureScene, shows: Shows) -> Vec<Row> {
    let mut rows = if shows.columns {
        column_rows(scene)
    } else {
        answer_rows(scene)
    };
    let mut mark = |swatch, label, count| {
        rows.push(Row {
            swatch,
            label,
            count,
        })
    };
    let patch = |fill, alpha, edge| Swatch::Patch { fill, alpha, edge };
    if shows.rectangles && !scene.rectangles.is_empty() {
        let swatch = patch(
            palette::RECTANGLE,
            palette::RECTANGLE_ALPHA,
            palette::RECTANGLE,
        );
        mark(swatch, "Occlusion volumes", Some(scene.rectangles.len()));
    }
    if !scene.streets.is_empty() {
        mark(
            patch(shows.street, 1.0, palette::STREET_EDGE),
            "Streets",
            None,
        );
    }
    if shows.observer && scene.observer.is_some() {
        let alpha = palette::FIELD_OF_VIEW_ALPHA;
        let swatch = patch(palette::FIELD_OF_VIEW, alpha, palette::FIELD_OF_VIEW_EDGE);
        mark(swatch, "Field of view", None);
        mark(Swatch::Eye, "Observer", None);
    }
    rows
}

/// The features by status: always the visible ones, others where there are any.
fn answer_rows(scene: &PictureScene) -> Vec<Row> {
    let row = |status| {
        counted(
            palette::fill(status),
            1.0,
            label(status),
            scene.count(status),
        )
    };
    Status::ALL
        .into_iter()
        .map(|status| (status, row(status)))
        .filter(|(status, row)| *status == Status::Visible || row.count > Some(0))
        .map(|(_, row)| row)
        .collect()
}

/// The features as glass, and the columns in them: always the grounded ones, others where there are
/// any.
fn column_rows(scene: &PictureScene) -> Vec<Row> {
    let column = |grounded, label| {
        let count = scene.count_columns(grounded);
        counted(palette::column(grounded), 1.0, label, count)
    };
    let glass = counted(
        palette::GLASS,
        palette::GLASS_ALPHA,
        "Building, transparent",
        scene.features.len(),
    );
    let mut rows = vec![glass, column(true, "Solid column, grounded")];
    let raised = column(false, "Solid column, not grounded");
    rows.extend((raised.count > Some(0)).then_some(raised));
    rows
}

/// A row with the number of what has this colour.
pub(crate) fn counted(fill: Rgb, alpha: f32, label: &'static str, count: usize) -> Row {
    let swatch = Swatch::Patch {
        fill,
        alpha,
        edge: palette::outline(fill),
    };
    Row {
        swatch,
        label,
        count: Some(count),
    }
}

/// A row for what has this colour, however much of it there is.
pub(crate) fn uncounted(fill: Rgb, label: &'static str) -> Row {
    Row {
        count: None,
        ..counted(fill, 1.0, label, 0)
    }
}

fn label(status: Status) -> &'static str {
    match status {
        Status::Visible => "Visible",
        Status::Hidden => "Hidden",
        Status::OverEstimated => "Over-estimated",
        Status::Outside => "Outside the field of view",
    }
}

fn style(size: f32, weight: Weight, color: Rgb) -> Style {
    Style {
        size,
        weight,
        color,
    }
}

/// A number with a comma between thousands.
pub(crate) fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{Area, Observer, PictureColumn, PictureFeature};

    const ALL: Shows = Shows {
        street: palette::STREET,
        rectangles: true,
        observer: true,
        columns: false,
    };

    #[test]
    fn numbers_are_grouped() {
        let cases = [
            (0, "0"),
            (999, "999"),
            (1115, "1,115"),
            (1234567, "1,234,567"),
        ];
        cases
            .iter()
            .for_each(|&(number, text)| assert_eq!(grouped(number), text));
    }

    #[test]
    fn rows_tell_what_is_there() {
        let mut scene = PictureScene::default();
        let labels = |scene: &PictureScene| -> Vec<_> {
            rows(scene, ALL)
                .iter()
                .map(|row| (row.label, row.count))
                .collect()
        };
        assert_eq!(labels(&scene), [("Visible", Some(0))]);
        scene.features.push(PictureFeature {
            status: Status::Hidden,
            triangles: vec![],
            columns: vec![],
        });
        scene.rectangles.push(([0.0; 2], [1.0; 2]));
        scene.observer = Some(Observer {
            eye: [0.0; 3],
            heading: 0.0,
            angle: 60.0,
            range: 9.0,
        });
        assert_eq!(
            labels(&scene),
            [
                ("Visible", Some(0)),
                ("Hidden", Some(1)),
                ("Occlusion volumes", Some(1)),
                ("Field of view", None),
                ("Observer", None),
            ]
        );
    }

    #[test]
    fn rows_of_columns_tell_nothing_of_an_answer() {
        let column = |grounded| PictureColumn {
            footprint: Area::default(),
            bottom: 0.0,
            top: 3.0,
            grounded,
        };
        let shows = Shows {
            columns: true,
            ..ALL
        };
        let mut scene = PictureScene::default();
        assert_eq!(rows(&scene, shows).len(), 2);
        scene.features.push(PictureFeature {
            status: Status::Visible,
            triangles: vec![],
            columns: vec![column(true), column(false), column(true)],
        });
        let counts: Vec<_> = rows(&scene, shows).iter().map(|row| row.count).collect();
        assert_eq!(counts, [Some(1), Some(2), Some(1)]);
    }

    #[test]
    fn height_follows_the_lines() {
        let mut scene = PictureScene {
            title: "Delft".into(),
            ..Default::default()
        };
        let height =
            |scene: &PictureScene| Legend::new(scene, rows(scene, ALL), 1.0, 200.0).height();
        let low = height(&scene);
        scene.subtitle = "an observer in the market square looks to the west".into();
        assert!(height(&scene) > low);
    }
}
