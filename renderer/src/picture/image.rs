//! Finished pictures.

use crate::error::{Error, Result};
use std::path::Path;
use tiny_skia::Pixmap;

/// A picture: opaque sRGB pixels, from the top left.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    width: u32,
    height: u32,
    rgba: Vec<u8>,
}

impl Image {
    pub(crate) fn from_pixmap(pixmap: Pixmap) -> Self {
        let (width, height) = (pixmap.width(), pixmap.height());
        Self {
            width,
            height,
            rgba: pixmap.take_demultiplied(),
        }
    }

    /// Pixels across.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Pixels down.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Red, green, blue and alpha of a pixel; `None` outside the picture.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        let at = 4 * (y as usize * self.width as usize + x as usize);
        let inside = x < self.width && y < self.height;
        inside.then(|| std::array::from_fn(|channel| self.rgba[at + channel]))
    }

    /// The picture as a PNG file's bytes.
    ///
    /// # Errors
    /// [`Error::Png`].
    pub fn png(&self) -> Result<Vec<u8>> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.write_header()?.write_image_data(&self.rgba)?;
        Ok(bytes)
    }

    /// Writes the picture as a PNG file.
    ///
    /// # Errors
    /// [`Error::Png`], [`Error::Write`].
    pub fn write_png(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        let written = std::fs::write(path, self.png()?);
        written.map_err(|source| Error::Write {
            path: path.to_owned(),
            source,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn png_holds_the_pixels() {
        let mut pixmap = Pixmap::new(3, 2).unwrap();
        pixmap.fill(tiny_skia::Color::from_rgba8(10, 20, 30, 255));
        let image = Image::from_pixmap(pixmap);
        let bytes = image.png().unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes))
            .read_info()
            .unwrap();
        let mut decoded = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut decoded).unwrap();
        assert_eq!((info.width, info.height), (3, 2));
        assert_eq!(decoded, [10, 20, 30, 255].repeat(6));
        assert_eq!(image.pixel(2, 1), Some([10, 20, 30, 255]));
        assert_eq!(image.pixel(3, 1), None);
    }

    #[test]
    fn a_refused_path_is_quoted() {
        let image = Image::from_pixmap(Pixmap::new(1, 1).unwrap());
        let refusal = image.write_png("no/such/folder/picture.png").unwrap_err();
        assert!(refusal.to_string().contains("no/such/folder/picture.png"));
    }
}
