//! Colours. The three of the answer follow Okabe and Ito, "Color universal design" (2008): bluish
//! green, vermilion and blue stay apart for colour-blind readers.

use super::Status;
use tiny_skia::Color;

/// An opaque sRGB colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Rgb(pub u8, pub u8, pub u8);

pub(crate) const PAPER: Rgb = Rgb(248, 246, 241);
pub(crate) const STREET: Rgb = Rgb(225, 228, 231);
pub(crate) const STREET_EDGE: Rgb = Rgb(199, 204, 209);
pub(crate) const GROUND: Rgb = Rgb(240, 236, 227);
pub(crate) const STREET_ON_GROUND: Rgb = Rgb(196, 200, 205);
pub(crate) const HORIZON: Rgb = Rgb(226, 235, 242);
pub(crate) const ZENITH: Rgb = Rgb(134, 178, 216);
pub(crate) const INK: Rgb = Rgb(38, 42, 46);
pub(crate) const FADED_INK: Rgb = Rgb(104, 109, 114);
pub(crate) const RULE: Rgb = Rgb(217, 214, 207);
pub(crate) const FIELD_OF_VIEW: Rgb = Rgb(240, 185, 60);
pub(crate) const FIELD_OF_VIEW_EDGE: Rgb = Rgb(196, 138, 20);
pub(crate) const RECTANGLE: Rgb = Rgb(122, 92, 168);
pub(crate) const WHITE: Rgb = Rgb(255, 255, 255);

/// The surface of a building that is looked into, and how much of it is seen.
pub(crate) const GLASS: Rgb = Rgb(178, 218, 250);
pub(crate) const GLASS_EDGE: Rgb = Rgb(244, 250, 255);
pub(crate) const GLASS_ALPHA: f32 = 0.2;

/// On maps of view cells: all features but the one that is asked for, and that one.
pub(crate) const MUTED: Rgb = Rgb(198, 196, 192);
pub(crate) const SUBJECT: Rgb = Rgb(213, 94, 0);

/// View cells from which a feature is seen, may be seen, and is not seen: darker is surer.
pub(crate) const PROVEN: Rgb = Rgb(20, 98, 160);
pub(crate) const POSSIBLE: Rgb = Rgb(128, 186, 226);
pub(crate) const UNSEEN: Rgb = Rgb(233, 236, 238);

/// How strongly occlusion volumes tint what they cover.
pub(crate) const RECTANGLE_ALPHA: f32 = 0.22;

/// How strongly the field of view tints what it covers.
pub(crate) const FIELD_OF_VIEW_ALPHA: f32 = 0.26;

/// The colour of a feature.
pub(crate) const fn fill(status: Status) -> Rgb {
    match status {
        Status::Visible => Rgb(43, 164, 125),
        Status::Hidden => Rgb(214, 92, 62),
        Status::OverEstimated => Rgb(58, 116, 190),
        Status::Outside => Rgb(216, 211, 201),
    }
}

/// The colour of a column: orange and reddish purple of the same set.
pub(crate) const fn column(grounded: bool) -> Rgb {
    match grounded {
        true => Rgb(230, 159, 0),
        false => Rgb(176, 86, 140),
    }
}

/// The colour of an outline: the same, darker.
pub(crate) fn outline(Rgb(r, g, b): Rgb) -> Rgb {
    let darker = |channel: u8| (f32::from(channel) * 0.72) as u8;
    Rgb(darker(r), darker(g), darker(b))
}

impl Rgb {
    /// With an alpha of 0 to 1.
    pub(crate) fn alpha(self, alpha: f32) -> Color {
        let Rgb(r, g, b) = self;
        Color::from_rgba8(r, g, b, (alpha.clamp(0.0, 1.0) * 255.0).round() as u8)
    }

    /// As a solid or translucent paint.
    pub(crate) fn paint(self, alpha: f32) -> tiny_skia::Paint<'static> {
        let mut paint = tiny_skia::Paint {
            anti_alias: true,
            ..Default::default()
        };
        paint.set_color(self.alpha(alpha));
        paint
    }
}
