//! A finished picture.

use std::io::{self, Write};

/// A picture in eight-bit sRGB.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    width: usize,
    height: usize,
    /// Red, green and blue of every pixel, row by row from the top.
    bytes: Vec<u8>,
}

impl Image {
    /// A black picture.
    pub(super) fn black(width: usize, height: usize) -> Self {
        let bytes = vec![0; width * height * 3];
        Self {
            width,
            height,
            bytes,
        }
    }

    /// Pixels per row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Red, green and blue of every pixel, row by row from the top.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    pub(super) fn bytes_mut(&mut self) -> &mut [u8] {
        &mut self.bytes
    }

    /// Red, green and blue of a pixel; `None` outside of the picture.
    pub fn pixel(&self, column: usize, row: usize) -> Option<[u8; 3]> {
        if column >= self.width {
            return None;
        }
        let first = (row * self.width + column) * 3;
        let bytes = self.bytes.get(first..first + 3)?;
        Some([bytes[0], bytes[1], bytes[2]])
    }

    /// Writes the picture as a PNG file, the same bytes for the same picture.
    pub fn write_png(&self, to: impl Write) -> io::Result<()> {
        let size = |length: usize| u32::try_from(length).map_err(io::Error::other);
        let mut encoder = png::Encoder::new(to, size(self.width)?, size(self.height)?);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_compression(png::Compression::Balanced);
        encoder.set_filter(png::Filter::Adaptive);
        let mut writer = encoder.write_header().map_err(io::Error::from)?;
        writer
            .write_image_data(&self.bytes)
            .and_then(|()| writer.finish())
            .map_err(io::Error::from)
    }
}
