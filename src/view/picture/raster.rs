//! Which places of a grid a triangle covers, and how near it is there.
//!
//! Triangles that share an edge cover every place along it exactly once. The result for a row
//! does not depend on which other rows are filled.

use std::ops::Range;

/// Column, row, and a nearness that increases towards the eye and is linear in the picture.
pub(super) type Corner = [f64; 3];

/// An edge as the column where it crosses a row: `slope * row + base`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Line {
    slope: f64,
    base: f64,
}

impl Line {
    /// The same bits whichever end comes first.
    fn through(a: Corner, b: Corner) -> Self {
        let (low, high) = if a[1] < b[1] { (a, b) } else { (b, a) };
        let slope = (high[0] - low[0]) / (high[1] - low[1]);
        Self {
            slope,
            base: low[0] - slope * low[1],
        }
    }

    fn at(self, row: f64) -> f64 {
        self.slope * row + self.base
    }
}

/// A triangle that is ready to be filled row by row.
#[derive(Clone, Debug)]
pub(crate) struct Patch {
    rows: Range<usize>,
    left: [Line; 2],
    right: [Line; 2],
    /// Change of the nearness per column and per row, and its value at the grid's origin.
    nearness: [f64; 3],
}

impl Patch {
    /// The part of the triangle in a grid of this size; `None` if it covers no place.
    pub(super) fn new(corners: [Corner; 3], width: usize, height: usize) -> Option<Self> {
        let [a, mut b, mut c] = corners;
        let range = |axis: usize, end: usize| {
            let low = a[axis].min(b[axis]).min(c[axis]);
            let high = a[axis].max(b[axis]).max(c[axis]);
            first_place(low)..first_place(high).min(end)
        };
        let (rows, columns) = (range(1, height), range(0, width));
        if rows.is_empty() || columns.is_empty() {
            return None;
        }
        let mut area = twice_area(a, b, c);
        if area < 0.0 {
            (b, c) = (c, b);
            area = -area;
        }
        if area.is_nan() || area <= 0.0 {
            return None;
        }
        // Going round a triangle of positive area, the inside is to the left of edges that go
        // down the picture; horizontal edges limit only the rows.
        let mut lines = [[None; 2]; 2];
        for (from, to) in [(a, b), (b, c), (c, a)] {
            if from[1] != to[1] {
                let side = &mut lines[usize::from(to[1] > from[1])];
                let place = usize::from(side[0].is_some());
                side[place] = Some(Line::through(from, to));
            }
        }
        let pair = |[one, two]: [Option<Line>; 2]| one.map(|line| [line, two.unwrap_or(line)]);
        let slope = |axis: usize| {
            let other = 1 - axis;
            let sign = if axis == 0 { 1.0 } else { -1.0 };
            let (ab, ac) = (b[other] - a[other], c[other] - a[other]);
            sign * ((b[2] - a[2]) * ac - (c[2] - a[2]) * ab) / area
        };
        let (per_column, per_row) = (slope(0), slope(1));
        Some(Self {
            rows,
            left: pair(lines[0])?,
            right: pair(lines[1])?,
            nearness: [
                per_column,
                per_row,
                a[2] - per_column * a[0] - per_row * a[1],
            ],
        })
    }

    /// The rows that it may cover.
    pub(super) fn rows(&self) -> &Range<usize> {
        &self.rows
    }

    /// The columns below `width` that it covers in the row.
    pub(super) fn columns(&self, row: usize, width: usize) -> Range<usize> {
        let y = row as f64 + 0.5;
        let left = self.left[0].at(y).max(self.left[1].at(y));
        let right = self.right[0].at(y).min(self.right[1].at(y));
        first_place(left)..first_place(right).min(width)
    }

    /// Nearness at a place, and its change per column.
    pub(crate) fn nearness(&self, column: usize, row: usize) -> (f32, f32) {
        let [per_column, per_row, base] = self.nearness;
        let here = base + per_column * (column as f64 + 0.5) + per_row * (row as f64 + 0.5);
        (here as f32, per_column as f32)
    }
}

/// The first place whose centre, at a half, is not below `value`.
pub(super) fn first_place(value: f64) -> usize {
    let value = value - 0.5;
    // The cast saturates; grids are far smaller.
    let below = value as i32;
    let place = below.saturating_add(i32::from(f64::from(below) < value));
    usize::try_from(place).unwrap_or(0)
}

/// Twice the signed area of the triangle.
pub(crate) fn twice_area(a: Corner, b: Corner, c: Corner) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[cfg(test)]
mod tests {
    use crate::picture::raster::*;
    use proptest::prelude::*;

    fn cover(corners: [[f64; 2]; 3], count: &mut [u8; 400]) {
        let corners = corners.map(|[x, y]| [x, y, 1.0]);
        if let Some(patch) = Patch::new(corners, 20, 20) {
            for row in patch.rows().clone() {
                for column in patch.columns(row, 20) {
                    count[row * 20 + column] += 1;
                }
            }
        }
    }

    fn point() -> impl Strategy<Value = [f64; 2]> {
        [-10.0..30.0, -10.0..30.0]
    }

    proptest! {
        #[test]
        fn neighbours_leave_no_gap_and_do_not_overlap(inner in [1.0..19.0, 1.0..19.0]) {
            let square = [[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0]];
            let mut count = [0; 400];
            for i in 0..4 {
                cover([square[i], square[(i + 1) % 4], inner], &mut count);
            }
            prop_assert!(count.iter().all(|c| *c == 1));
        }

        #[test]
        fn the_direction_around_does_not_matter(a in point(), b in point(), c in point()) {
            let (mut one, mut two) = ([0; 400], [0; 400]);
            cover([a, b, c], &mut one);
            cover([b, a, c], &mut two);
            prop_assert_eq!(one, two);
        }

        #[test]
        fn nearness_is_linear(a in point(), b in point(), c in point()) {
            let lift = |[x, y]: [f64; 2]| [x, y, 2.0 * x - y + 5.0];
            if let Some(patch) = Patch::new([lift(a), lift(b), lift(c)], 20, 20) {
                prop_assume!(twice_area(lift(a), lift(b), lift(c)).abs() > 1.0);
                let (here, slope) = patch.nearness(3, 4);
                prop_assert!((here - 7.5).abs() < 1e-3 && (slope - 2.0).abs() < 1e-3);
            }
        }
    }
}
