//! A finished picture.

use std::io::{self, Write};

use super::palette::Palette;

/// Red, green and blue in 8-bit sRGB.
pub(crate) type Rgb = [u8; 3];

/// A picture in 8-bit sRGB.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    width: usize,
    height: usize,
    /// Red, green and blue of every pixel, row by row from the top.
    bytes: Vec<u8>,
}

impl Image {
    /// A black picture.
    pub(crate) fn black(width: usize, height: usize) -> Self {
        Self::filled(width, height, [0; 3])
    }

    /// A picture of one colour.
    pub fn filled(width: usize, height: usize, color: Rgb) -> Self {
        Self {
            width,
            height,
            bytes: color.repeat(width * height),
        }
    }

    /// Paints a rectangle, clipped to the picture.
    pub fn fill(&mut self, [left, top]: [usize; 2], size: [usize; 2], color: Rgb) {
        let right = left.saturating_add(size[0]).min(self.width);
        let bottom = top.saturating_add(size[1]).min(self.height);
        for row in top..bottom {
            let row = row * self.width;
            if left < right {
                // Clipped to the picture above.
                let bytes = &mut self.bytes[(row + left) * 3..(row + right) * 3];
                bytes.as_chunks_mut().0.fill(color);
            }
        }
    }

    /// Paints one pixel; does nothing outside the picture.
    pub fn set(&mut self, column: usize, row: usize, color: Rgb) {
        self.fill([column, row], [1; 2], color);
    }

    /// Copies a picture with its upper left corner at the pixel, clipped to this picture.
    pub fn paste(&mut self, other: &Self, left: usize, top: usize) {
        let columns = other.width.min(self.width.saturating_sub(left));
        let rows = other.height.min(self.height.saturating_sub(top));
        for row in 0..rows {
            let from = row * other.width * 3;
            let to = ((top + row) * self.width + left) * 3;
            // Rows and columns are within both pictures, as computed above.
            self.bytes[to..to + columns * 3]
                .copy_from_slice(&other.bytes[from..from + columns * 3]);
        }
    }

    /// Width (pixels).
    pub fn width(&self) -> usize {
        self.width
    }

    /// Height (pixels).
    pub fn height(&self) -> usize {
        self.height
    }

    /// Red, green and blue of every pixel, row by row from the top.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// As [`bytes`](Self::bytes), for painting.
    pub(crate) fn bytes_mut(&mut self) -> &mut [u8] {
        &mut self.bytes
    }

    /// Red, green and blue of a pixel; `None` outside the picture.
    pub fn pixel(&self, column: usize, row: usize) -> Option<Rgb> {
        if column >= self.width {
            return None;
        }
        let first = (row * self.width + column) * 3;
        let bytes = self.bytes.get(first..first + 3)?;
        Some([bytes[0], bytes[1], bytes[2]])
    }

    /// The picture encoded as a PNG file.
    pub fn to_png(&self) -> io::Result<Vec<u8>> {
        let mut png = Vec::new();
        self.write_png(&mut png)?;
        Ok(png)
    }

    /// Writes the picture as a PNG file; the same picture always gives the same bytes.
    pub fn write_png(&self, to: impl Write) -> io::Result<()> {
        let size = |length: usize| u32::try_from(length).map_err(io::Error::other);
        let mut encoder = png::Encoder::new(to, size(self.width)?, size(self.height)?);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_compression(png::Compression::Fast);
        encoder.set_filter(png::Filter::Adaptive);
        let mut writer = encoder.write_header().map_err(io::Error::from)?;
        writer
            .write_image_data(&self.bytes)
            .and_then(|()| writer.finish())
            .map_err(io::Error::from)
    }

    /// The picture encoded as a small PNG file of at most so many colours, 256 at most.
    pub fn to_small_png(&self, colors: usize) -> io::Result<Vec<u8>> {
        let size = |length: usize| u32::try_from(length).map_err(io::Error::other);
        let palette = Palette::of(std::iter::once(self), colors);
        let mut small = Vec::new();
        let mut encoder = png::Encoder::new(&mut small, size(self.width)?, size(self.height)?);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_palette(palette.colors().concat());
        encoder.set_compression(png::Compression::High);
        encoder.set_filter(png::Filter::NoFilter);
        let mut writer = encoder.write_header().map_err(io::Error::from)?;
        writer
            .write_image_data(&palette.places(self))
            .and_then(|()| writer.finish())
            .map_err(io::Error::from)?;
        Ok(small)
    }
}
