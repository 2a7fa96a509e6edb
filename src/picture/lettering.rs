//! Short texts on pictures, in letters of five by seven dots.

use super::image::{Image, Rgb};

/// Width and height of a letter (dots), and the distance from one letter to the next.
const ACROSS: usize = 5;
const DOWN: usize = 7;
const ADVANCE: usize = 6;

/// Rows of dots from the top; the highest of the five bits is on the left.
#[rustfmt::skip]
const LETTERS: &[(char, [u8; DOWN])] = &[
    ('A', [0b01110, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001]),
    ('B', [0b11110, 0b10001, 0b10001, 0b11110, 0b10001, 0b10001, 0b11110]),
    ('C', [0b01110, 0b10001, 0b10000, 0b10000, 0b10000, 0b10001, 0b01110]),
    ('D', [0b11110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b11110]),
    ('E', [0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b11111]),
    ('F', [0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b10000]),
    ('G', [0b01110, 0b10001, 0b10000, 0b10111, 0b10001, 0b10001, 0b01111]),
    ('H', [0b10001, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001]),
    ('I', [0b01110, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110]),
    ('J', [0b00111, 0b00010, 0b00010, 0b00010, 0b00010, 0b10010, 0b01100]),
    ('K', [0b10001, 0b10010, 0b10100, 0b11000, 0b10100, 0b10010, 0b10001]),
    ('L', [0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b11111]),
    ('M', [0b10001, 0b11011, 0b10101, 0b10101, 0b10001, 0b10001, 0b10001]),
    ('N', [0b10001, 0b11001, 0b11001, 0b10101, 0b10011, 0b10011, 0b10001]),
    ('O', [0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110]),
    ('P', [0b11110, 0b10001, 0b10001, 0b11110, 0b10000, 0b10000, 0b10000]),
    ('Q', [0b01110, 0b10001, 0b10001, 0b10001, 0b10101, 0b10010, 0b01101]),
    ('R', [0b11110, 0b10001, 0b10001, 0b11110, 0b10100, 0b10010, 0b10001]),
    ('S', [0b01111, 0b10000, 0b10000, 0b01110, 0b00001, 0b00001, 0b11110]),
    ('T', [0b11111, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100]),
    ('U', [0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110]),
    ('V', [0b10001, 0b10001, 0b10001, 0b10001, 0b01010, 0b01010, 0b00100]),
    ('W', [0b10001, 0b10001, 0b10001, 0b10101, 0b10101, 0b11011, 0b10001]),
    ('X', [0b10001, 0b01010, 0b00100, 0b00100, 0b00100, 0b01010, 0b10001]),
    ('Y', [0b10001, 0b10001, 0b01010, 0b00100, 0b00100, 0b00100, 0b00100]),
    ('Z', [0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b10000, 0b11111]),
    ('0', [0b01110, 0b10001, 0b10011, 0b10101, 0b11001, 0b10001, 0b01110]),
    ('1', [0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110]),
    ('2', [0b01110, 0b10001, 0b00001, 0b00110, 0b01000, 0b10000, 0b11111]),
    ('3', [0b11110, 0b00001, 0b00001, 0b01110, 0b00001, 0b00001, 0b11110]),
    ('4', [0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010]),
    ('5', [0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110]),
    ('6', [0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110]),
    ('7', [0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b01000, 0b01000]),
    ('8', [0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110]),
    ('9', [0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100]),
    ('.', [0b00000, 0b00000, 0b00000, 0b00000, 0b00000, 0b01100, 0b01100]),
    (',', [0b00000, 0b00000, 0b00000, 0b00000, 0b01100, 0b00100, 0b01000]),
    (':', [0b00000, 0b01100, 0b01100, 0b00000, 0b01100, 0b01100, 0b00000]),
    ('-', [0b00000, 0b00000, 0b00000, 0b01110, 0b00000, 0b00000, 0b00000]),
    ('+', [0b00000, 0b00100, 0b00100, 0b11111, 0b00100, 0b00100, 0b00000]),
    ('=', [0b00000, 0b00000, 0b11111, 0b00000, 0b11111, 0b00000, 0b00000]),
    ('%', [0b11001, 0b11001, 0b00010, 0b00100, 0b01000, 0b10011, 0b10011]),
    ('/', [0b00001, 0b00001, 0b00010, 0b00100, 0b01000, 0b10000, 0b10000]),
    ('(', [0b00010, 0b00100, 0b01000, 0b01000, 0b01000, 0b00100, 0b00010]),
    (')', [0b01000, 0b00100, 0b00010, 0b00010, 0b00010, 0b00100, 0b01000]),
    ('_', [0b00000, 0b00000, 0b00000, 0b00000, 0b00000, 0b00000, 0b11111]),
    ('?', [0b01110, 0b10001, 0b00001, 0b00110, 0b00100, 0b00000, 0b00100]),
    ('!', [0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00000, 0b00100]),
    ('\'', [0b00100, 0b00100, 0b01000, 0b00000, 0b00000, 0b00000, 0b00000]),
    ('"', [0b01010, 0b01010, 0b01010, 0b00000, 0b00000, 0b00000, 0b00000]),
    ('#', [0b01010, 0b01010, 0b11111, 0b01010, 0b11111, 0b01010, 0b01010]),
    ('*', [0b00000, 0b10101, 0b01110, 0b11111, 0b01110, 0b10101, 0b00000]),
    ('<', [0b00010, 0b00100, 0b01000, 0b10000, 0b01000, 0b00100, 0b00010]),
    ('>', [0b01000, 0b00100, 0b00010, 0b00001, 0b00010, 0b00100, 0b01000]),
    (';', [0b00000, 0b01100, 0b01100, 0b00000, 0b01100, 0b00100, 0b01000]),
];

/// Drawn for characters that are not in the table.
const UNKNOWN: [u8; DOWN] = [
    0b11111, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b11111,
];

/// A line of text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line<'a> {
    /// The text; lower-case letters are drawn as capitals.
    pub(crate) text: &'a str,
    /// Pixels per dot.
    pub(crate) scale: usize,
    pub(crate) color: Rgb,
}

impl Line<'_> {
    /// Width (pixels) from the left edge of the first letter to the right edge of the last.
    pub(crate) fn width(&self) -> usize {
        let dots = self.text.chars().count() * ADVANCE;
        dots.saturating_sub(ADVANCE - ACROSS) * self.scale
    }

    /// Height (pixels) of the letters.
    pub(crate) fn height(&self) -> usize {
        DOWN * self.scale
    }

    /// Draws the line with its upper left corner at the pixel, clipped to the picture.
    pub(crate) fn draw(&self, image: &mut Image, column: usize, row: usize) {
        for (place, letter) in self.text.chars().enumerate() {
            let left = column + place * ADVANCE * self.scale;
            for (down, dots) in dots_of(letter).into_iter().enumerate() {
                let top = row + down * self.scale;
                for across in 0..ACROSS {
                    if dots >> (ACROSS - 1 - across) & 1 == 1 {
                        let at = [left + across * self.scale, top];
                        image.fill(at, [self.scale; 2], self.color);
                    }
                }
            }
        }
    }

    /// Draws the line on a dark plate that is two dots larger, with the plate's upper left
    /// corner at the pixel, or moved to be inside the picture.
    pub(crate) fn draw_on_plate(&self, image: &mut Image, column: usize, row: usize) {
        let border = 2 * self.scale;
        let size = [self.width() + 2 * border, self.height() + 2 * border];
        let column = column.min(image.width().saturating_sub(size[0]));
        let row = row.min(image.height().saturating_sub(size[1]));
        image.fill([column, row], size, [24, 26, 30]);
        self.draw(image, column + border, row + border);
    }
}

fn dots_of(letter: char) -> [u8; DOWN] {
    let letter = letter.to_ascii_uppercase();
    if letter.is_whitespace() {
        return [0; DOWN];
    }
    let known = LETTERS.iter().find(|(known, _)| *known == letter);
    known.map_or(UNKNOWN, |(_, dots)| *dots)
}

#[cfg(test)]
mod tests {
    use crate::picture::lettering::*;

    #[test]
    fn a_letter_is_drawn_where_it_is_asked_for() {
        let mut image = Image::filled(20, 10, [0; 3]);
        let line = Line {
            text: "tl",
            scale: 1,
            color: [255; 3],
        };
        line.draw(&mut image, 1, 1);
        let lit = |column, row| image.pixel(column, row) == Some([255; 3]);
        assert!((1..6).all(|column| lit(column, 1)) && (1..8).all(|row| lit(3, row)));
        assert!((1..8).all(|row| lit(7, row)) && (7..12).all(|column| lit(column, 7)));
        let count = image.bytes().iter().filter(|b| **b == 255).count() / 3;
        assert_eq!(count, 11 + 11);
        assert_eq!((line.width(), line.height()), (11, 7));
    }

    #[test]
    fn what_does_not_fit_is_cut_off() {
        let mut image = Image::filled(8, 4, [0; 3]);
        let line = Line {
            text: "LONG Ä TEXT",
            scale: 3,
            color: [255; 3],
        };
        line.draw(&mut image, 6, 2);
        line.draw_on_plate(&mut image, 100, 100);
        assert_eq!(image.width(), 8);
    }
}
