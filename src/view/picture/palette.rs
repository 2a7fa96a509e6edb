//! A picture in few colours: which colours, and which of them each pixel gets.
//!
//! Colours are distinguished by five bits per channel; boxes of them are split where they are
//! widest until there are enough. The result depends only on the pictures.

use super::image::{Image, Rgb};

/// Bits per channel.
const BITS: u32 = 5;
const CELLS: usize = 1 << (3 * BITS);

/// A few colours that stand for many.
pub(crate) struct Palette {
    colors: Vec<Rgb>,
    /// For each cell of the colour cube, the index of its colour.
    nearest: Vec<u8>,
}

/// How often a cell occurs, and the sum of the colours seen in it.
#[derive(Clone, Copy, Default)]
struct Cell {
    count: u64,
    sum: [u64; 3],
}

impl Palette {
    /// At most `most` (1 to 256) colours for the pictures.
    pub(super) fn of<'a>(pictures: impl Iterator<Item = &'a Image>, most: usize) -> Self {
        let mut cells = vec![Cell::default(); CELLS];
        for picture in pictures {
            for pixel in picture.bytes().as_chunks().0 {
                // The cell is within the cube, see below.
                let cell = &mut cells[cell_of(*pixel)];
                cell.count += 1;
                for (sum, value) in cell.sum.iter_mut().zip(pixel) {
                    *sum += u64::from(*value);
                }
            }
        }
        let used: Vec<usize> = (0..CELLS).filter(|i| cells[*i].count > 0).collect();
        let boxes = boxes(&cells, used, most.clamp(1, 256));
        let mut nearest = vec![0; CELLS];
        let mut colors = Vec::with_capacity(boxes.len());
        for (place, members) in (0..=u8::MAX).zip(&boxes) {
            let mut all = Cell::default();
            for member in members {
                let cell = cells[*member];
                all.count += cell.count;
                for (sum, value) in all.sum.iter_mut().zip(cell.sum) {
                    *sum += value;
                }
                nearest[*member] = place;
            }
            let mean = |sum: u64| ((sum + all.count / 2) / all.count.max(1)) as u8;
            colors.push(all.sum.map(mean));
        }
        let mut palette = Self { colors, nearest };
        palette.assign_unseen(&cells);
        palette
    }

    /// Colours that occur in no picture get the nearest colour.
    fn assign_unseen(&mut self, cells: &[Cell]) {
        for (i, cell) in cells.iter().enumerate() {
            if cell.count > 0 {
                continue;
            }
            let middle = middle_of(i);
            let far = |color: &Rgb| -> i32 {
                let d = |axis: usize| i32::from(color[axis]) - middle[axis];
                (0..3).map(|axis| d(axis) * d(axis)).sum()
            };
            let found = (0..=u8::MAX)
                .zip(&self.colors)
                .min_by_key(|(_, color)| far(color));
            self.nearest[i] = found.map_or(0, |(place, _)| place);
        }
    }

    /// The colours.
    pub(super) fn colors(&self) -> &[Rgb] {
        &self.colors
    }

    /// The index of each pixel's colour, row by row.
    pub(super) fn places(&self, picture: &Image) -> Vec<u8> {
        let pixels = picture.bytes().as_chunks().0.iter();
        pixels.map(|pixel| self.nearest[cell_of(*pixel)]).collect()
    }
}

/// The cell of the colour cube; always below [`CELLS`].
fn cell_of(pixel: Rgb) -> usize {
    let part = |value: u8| usize::from(value >> (8 - BITS));
    part(pixel[0]) << (2 * BITS) | part(pixel[1]) << BITS | part(pixel[2])
}

/// The colour in the middle of a cell.
fn middle_of(cell: usize) -> [i32; 3] {
    let mask = (1 << BITS) - 1;
    // Five bits make a small number.
    let part = |shift: u32| ((cell >> shift & mask) as i32) * (1 << (8 - BITS)) + 4;
    [part(2 * BITS), part(BITS), part(0)]
}

/// The cells in at most `most` boxes.
fn boxes(cells: &[Cell], used: Vec<usize>, most: usize) -> Vec<Vec<usize>> {
    if used.is_empty() {
        return vec![used];
    }
    let mut boxes = vec![used];
    while boxes.len() < most {
        let spreads = boxes.iter().map(|members| spread(cells, members));
        let widest = spreads.enumerate().max_by(|(i, a), (j, b)| {
            // Of equal boxes, the first.
            a.0.total_cmp(&b.0).then(j.cmp(i))
        });
        let Some((place, (width, axis))) = widest else {
            break;
        };
        if width <= 0.0 {
            break;
        }
        let mut members = std::mem::take(&mut boxes[place]);
        members.sort_by_key(|cell| (middle_of(*cell)[axis], *cell));
        let total: u64 = members.iter().map(|cell| cells[*cell].count).sum();
        let mut below = 0;
        let half = members.iter().position(|cell| {
            below += cells[*cell].count;
            below * 2 >= total
        });
        let cut = (half.unwrap_or(0) + 1).min(members.len() - 1).max(1);
        let above = members.split_off(cut);
        boxes[place] = members;
        boxes.push(above);
    }
    boxes
}

/// How much the box needs to be split, and along which channel; zero for a single cell.
fn spread(cells: &[Cell], members: &[usize]) -> (f64, usize) {
    let mut widest = (0.0, 0);
    if members.len() < 2 {
        return widest;
    }
    let count: u64 = members.iter().map(|cell| cells[*cell].count).sum();
    for axis in 0..3 {
        let values = || members.iter().map(|cell| middle_of(*cell)[axis]);
        let width = values().max().unwrap_or(0) - values().min().unwrap_or(0);
        // Rare colours count, too: a small red thing must stay red.
        let need = f64::from(width) * f64::from(width) * (count as f64).sqrt();
        if need > widest.0 {
            widest = (need, axis);
        }
    }
    widest
}

#[cfg(test)]
mod tests {
    use crate::picture::palette::*;

    #[test]
    fn few_colours_are_kept_as_they_are() {
        let mut picture = Image::filled(10, 10, [200, 10, 10]);
        picture.fill([0, 0], [3, 3], [10, 10, 200]);
        let palette = Palette::of([&picture].into_iter(), 256);
        let mut colors = palette.colors().to_vec();
        colors.sort_unstable();
        assert_eq!(colors, [[10, 10, 200], [200, 10, 10]]);
        let places = palette.places(&picture);
        assert_eq!(palette.colors()[usize::from(places[0])], [10, 10, 200]);
        assert_eq!(palette.colors()[usize::from(places[99])], [200, 10, 10]);
    }

    #[test]
    fn many_colours_become_as_many_as_asked_for() {
        let mut picture = Image::filled(64, 64, [0; 3]);
        for i in 0..64 * 64usize {
            let value = |shift: usize| ((i >> shift) * 16 % 256) as u8;
            picture.set(i % 64, i / 64, [value(0), value(4), value(8)]);
        }
        let palette = Palette::of([&picture].into_iter(), 17);
        assert_eq!(palette.colors().len(), 17);
        assert!(palette.places(&picture).iter().all(|p| *p < 17));
    }
}
