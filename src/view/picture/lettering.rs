//! Short texts on pictures, in the typeface Noto Sans Mono.

use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

use super::image::{Image, Rgb};

/// The heights of lines for which there are letters; larger ones are multiples of these.
const SIZES: [RasterHeight; 4] = [
    RasterHeight::Size32,
    RasterHeight::Size24,
    RasterHeight::Size20,
    RasterHeight::Size16,
];

/// Shown in place of characters that the typeface lacks.
const UNKNOWN: char = '\u{FFFD}';

/// The plate behind a line.
const PLATE: Rgb = [24, 26, 30];

/// A line of text.
#[derive(Clone, Copy, Debug)]
pub struct Line<'a> {
    /// The text.
    pub text: &'a str,
    /// The greatest height (pixels) that the line may have; the least possible is 16.
    pub size: usize,
    pub color: Rgb,
}

impl Line<'_> {
    /// The letters to use, and how many pixels along a side stand for one of theirs.
    fn letters(&self) -> (RasterHeight, usize) {
        let fitting = SIZES.map(|size| (size, (self.size / size.val()).max(1)));
        let height = |(size, factor): &(RasterHeight, usize)| size.val() * factor;
        let fits = |letters: &&(RasterHeight, usize)| height(letters) <= self.size;
        // Of equal heights the last one counts: the largest letters come last.
        let found = fitting.iter().rev().filter(fits).max_by_key(|l| height(l));
        found.copied().unwrap_or((RasterHeight::Size16, 1))
    }

    /// Distance (pixels) from one letter to the next.
    pub fn advance(&self) -> usize {
        let (size, factor) = self.letters();
        get_raster_width(FontWeight::Regular, size) * factor
    }

    /// Width (pixels).
    pub fn width(&self) -> usize {
        self.text.chars().count() * self.advance()
    }

    /// Height (pixels).
    pub fn height(&self) -> usize {
        let (size, factor) = self.letters();
        size.val() * factor
    }

    /// Draws the line with its upper left corner at the pixel, clipped to the picture.
    pub fn draw(&self, image: &mut Image, column: usize, row: usize) {
        let (size, factor) = self.letters();
        for (place, letter) in self.text.chars().enumerate() {
            let raster = |c| get_raster(c, FontWeight::Regular, size);
            let Some(raster) = raster(letter).or_else(|| raster(UNKNOWN)) else {
                continue;
            };
            let left = column + place * self.advance();
            for (down, covers) in raster.rows().enumerate() {
                let dots = covers.iter().enumerate().filter(|(_, cover)| **cover > 0);
                for (across, cover) in dots {
                    let at = [left + across * factor, row + down * factor];
                    self.dot(image, at, factor, *cover);
                }
            }
        }
    }

    /// Mixes the colour into a square of pixels.
    fn dot(&self, image: &mut Image, [left, top]: [usize; 2], size: usize, cover: u8) {
        for row in top..top + size {
            for column in left..left + size {
                let Some(below) = image.pixel(column, row) else {
                    continue;
                };
                let mixed = [0, 1, 2].map(|i| {
                    let (cover, rest) = (u16::from(cover), u16::from(255 - cover));
                    // A mean of two bytes is a byte.
                    ((u16::from(self.color[i]) * cover + u16::from(below[i]) * rest) / 255) as u8
                });
                image.set(column, row, mixed);
            }
        }
    }

    /// Width of the plate's border (pixels).
    fn border(&self) -> usize {
        self.height() / 8
    }

    /// Width and height (pixels) of the plate of [`draw_on_plate`](Self::draw_on_plate).
    pub fn plate(&self) -> [usize; 2] {
        [self.width(), self.height()].map(|size| size + 2 * self.border())
    }

    /// Draws the line on a dark plate with the plate's upper left corner at the pixel, or moved
    /// to be inside the picture.
    pub(crate) fn draw_on_plate(&self, image: &mut Image, column: usize, row: usize) {
        let size = self.plate();
        let column = column.min(image.width().saturating_sub(size[0]));
        let row = row.min(image.height().saturating_sub(size[1]));
        image.fill([column, row], size, PLATE);
        self.draw(image, column + self.border(), row + self.border());
    }
}

#[cfg(test)]
mod tests {
    use crate::picture::lettering::*;

    fn line(text: &str, size: usize) -> Line<'_> {
        let color = [255; 3];
        Line { text, size, color }
    }

    /// Columns and rows that are at least half lit.
    fn lit(text: &str, size: usize) -> Vec<[usize; 2]> {
        let mut image = Image::filled(120, 80, [0; 3]);
        line(text, size).draw(&mut image, 1, 2);
        let places = (0..80).flat_map(|row| (0..120).map(move |column| [column, row]));
        places
            .filter(|[column, row]| image.pixel(*column, *row).unwrap()[0] > 127)
            .collect()
    }

    #[test]
    fn letters_stand_side_by_side_within_their_line() {
        let (one, two) = (lit("L", 20), lit("LL", 20));
        let advance = line("L", 20).advance();
        let second = one.iter().map(|[column, row]| [column + advance, *row]);
        let mut both: Vec<_> = one.iter().copied().chain(second).collect();
        both.sort_by_key(|[column, row]| [*row, *column]);
        assert_eq!(two, both);
        assert!(
            one.iter()
                .all(|[column, row]| *column <= advance && (2..22).contains(row))
        );
        assert_ne!(
            lit("l", 20),
            lit("L", 20),
            "capitals differ from small letters"
        );
    }

    #[test]
    fn heights_are_the_greatest_that_fit() {
        let heights = [1, 16, 23, 31, 40, 48, 70, 100].map(|size| line("a", size).height());
        assert_eq!(heights, [16, 16, 20, 24, 40, 48, 64, 100]);
        assert_eq!(line("abc", 16).width(), 3 * line("a", 16).width());
        assert_eq!(lit("I", 64).len(), 4 * lit("I", 32).len());
    }

    #[test]
    fn what_is_unknown_is_marked_and_what_does_not_fit_is_cut_off() {
        assert_eq!(lit("\u{4E16}", 16), lit("\u{FFFD}", 16));
        let mut image = Image::filled(8, 4, [0; 3]);
        line("long Ä text", 40).draw(&mut image, 6, 2);
        line("long Ä text", 40).draw_on_plate(&mut image, 100, 100);
        assert_eq!([image.width(), image.height()], [8, 4]);
    }
}
