//! Text: one line at a time, in Noto Sans.

use super::palette::Rgb;
use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};
use std::sync::LazyLock;
use tiny_skia::{Pixmap, PremultipliedColorU8};

/// How heavy the letters are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Weight {
    Regular,
    Bold,
}

static REGULAR: LazyLock<FontRef<'static>> = LazyLock::new(|| bundled(ttf_noto_sans::REGULAR));
static BOLD: LazyLock<FontRef<'static>> = LazyLock::new(|| bundled(ttf_noto_sans::BOLD));

fn bundled(bytes: &'static [u8]) -> FontRef<'static> {
    FontRef::try_from_slice(bytes).expect("the bundled font is a font")
}

/// How text looks.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Style {
    /// Height of the em square in pixels.
    pub size: f32,
    pub weight: Weight,
    pub color: Rgb,
}

impl Style {
    fn font(self) -> &'static FontRef<'static> {
        match self.weight {
            Weight::Regular => &REGULAR,
            Weight::Bold => &BOLD,
        }
    }

    /// ab_glyph scales by ascent plus descent, typography by the em.
    fn scale(self) -> PxScale {
        let font = self.font();
        let em = font.units_per_em().unwrap_or(1000.0);
        PxScale::from(self.size * font.height_unscaled() / em)
    }

    /// Glyphs from the origin on, and the width of the line.
    fn lay_out(self, text: &str) -> (Vec<Glyph>, f32) {
        let font = self.font().as_scaled(self.scale());
        let mut glyphs: Vec<Glyph> = Vec::new();
        let mut x = 0.0;
        for character in text.chars() {
            let id = font.glyph_id(character);
            x += glyphs.last().map_or(0.0, |before| font.kern(before.id, id));
            glyphs.push(id.with_scale_and_position(self.scale(), point(x, 0.0)));
            x += font.h_advance(id);
        }
        (glyphs, x)
    }

    /// Width of a line in pixels.
    pub(crate) fn width(self, text: &str) -> f32 {
        self.lay_out(text).1
    }

    /// Breaks text at spaces into lines of at most `width` pixels. Line breaks in it are kept, and
    /// a word that is longer is left whole, and so is what no-break spaces hold together.
    pub(crate) fn wrap(self, text: &str, width: f32) -> Vec<String> {
        text.lines()
            .flat_map(|line| self.wrap_line(line, width))
            .collect()
    }

    fn wrap_line(self, text: &str, width: f32) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for word in text.split(' ').filter(|word| !word.is_empty()) {
            let longer = lines.last().map(|line| format!("{line} {word}"));
            match longer.filter(|line| self.width(line) <= width) {
                Some(line) => *lines.last_mut().expect("it was just read") = line,
                None => lines.push(word.to_owned()),
            }
        }
        lines
    }

    /// Draws a line with its baseline at `y`, from `x` to the right.
    pub(crate) fn draw(self, pixmap: &mut Pixmap, text: &str, x: f32, y: f32) {
        let font = self.font();
        for mut glyph in self.lay_out(text).0 {
            glyph.position.x += x;
            glyph.position.y += y;
            let Some(outline) = font.outline_glyph(glyph) else {
                continue;
            };
            let corner = outline.px_bounds().min;
            outline.draw(|dx, dy, coverage| {
                let at = [corner.x as i32 + dx as i32, corner.y as i32 + dy as i32];
                blend(pixmap, at, self.color, coverage);
            });
        }
    }

    /// The same, ending at `x`.
    pub(crate) fn draw_right(self, pixmap: &mut Pixmap, text: &str, x: f32, y: f32) {
        self.draw(pixmap, text, x - self.width(text), y);
    }
}

/// Mixes a colour into an opaque pixel.
fn blend(pixmap: &mut Pixmap, [x, y]: [i32; 2], Rgb(r, g, b): Rgb, coverage: f32) {
    let (width, height) = (pixmap.width() as i32, pixmap.height() as i32);
    if !(0..width).contains(&x) || !(0..height).contains(&y) {
        return;
    }
    let pixel = &mut pixmap.pixels_mut()[(y * width + x) as usize];
    let c = coverage.clamp(0.0, 1.0);
    let mix = |under: u8, over: u8| (f32::from(under) * (1.0 - c) + f32::from(over) * c) as u8;
    let mixed = PremultipliedColorU8::from_rgba(
        mix(pixel.red(), r),
        mix(pixel.green(), g),
        mix(pixel.blue(), b),
        u8::MAX,
    );
    *pixel = mixed.unwrap_or(*pixel);
}

#[cfg(test)]
mod tests {
    use super::*;

    const STYLE: Style = Style {
        size: 20.0,
        weight: Weight::Regular,
        color: Rgb(0, 0, 0),
    };

    #[test]
    fn wider_text_is_wider() {
        assert!(STYLE.width("occlusion") > STYLE.width("occ"));
        assert_eq!(STYLE.width(""), 0.0);
        assert!(
            Style {
                weight: Weight::Bold,
                ..STYLE
            }
            .width("n")
                > STYLE.width("n")
        );
    }

    #[test]
    fn lines_fit() {
        let lines = STYLE.wrap("what can be seen from here\nand from there", 100.0);
        assert!(lines.len() > 3 && lines.iter().all(|line| STYLE.width(line) <= 100.0));
        assert_eq!(lines.join(" "), "what can be seen from here and from there");
        assert_eq!(
            STYLE.wrap("unbreakable  500\u{a0}m", 1.0),
            ["unbreakable", "500\u{a0}m"]
        );
    }

    #[test]
    fn ink_lands_above_the_baseline_and_may_leave_the_picture() {
        let mut pixmap = Pixmap::new(40, 30).unwrap();
        pixmap.fill(tiny_skia::Color::WHITE);
        STYLE.draw(&mut pixmap, "HHHHHHHH", -8.0, 20.0);
        let dark = |y: u32| (0..40).any(|x| pixmap.pixel(x, y).unwrap().red() < 99);
        assert!(dark(10) && !dark(25) && !dark(2));
    }
}
