//! Where light comes from, and what blocks it.

use std::ops::Range;

use nalgebra::Vector3;

use super::facet::Mesh;
use super::raster::{Corner, Patch, first_place, twice_area};

/// A distant light, with a shadow map: for each cell of a grid across the light's direction,
/// the height of the surface that it lights. The grid covers what is both seen and in shadow.
pub(crate) struct Lamp {
    /// Unit vector towards the light.
    pub(crate) towards: Vector3<f32>,
    /// What gives the column and the row (cells) of a point, and its height (m along `towards`):
    /// factors of its coordinates (m), and what is added.
    axes: [(Vector3<f32>, f32); 3],
    /// Distance between cells (m).
    grain: f32,
    columns: usize,
    rows: usize,
    /// Height (m along `towards`) of the lit surface; the least value where there is none.
    heights: Vec<f32>,
}

/// The direction and the resolution of a lamp.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LampPlan {
    /// Towards the light; not zero.
    pub(crate) towards: Vector3<f64>,
    /// The most cells along an edge of the grid.
    pub most: f64,
    /// The least distance between cells (m).
    pub least: f64,
    /// Whether only large bodies block the light.
    pub(crate) is_sky: bool,
}

/// Cells beyond what is seen, for the neighbourhoods of the outermost points.
const BORDER: f64 = 4.0;

/// The most cells that are looked at to find out whether the light is the same on them all.
const MAX_CELLS: usize = 10_000;

/// Cells about a triangle up to which they are looked at one by one.
const FEW: usize = 24;

/// What is seen is known from some of its points; others may be this share of its extent outside.
const BEYOND: f64 = 0.04;

impl Lamp {
    /// A light on the triangles, for a picture that shows these points (m, map frame).
    pub(crate) fn new(plan: LampPlan, blocking: Mesh<'_>, seen: &[Vector3<f32>]) -> Self {
        let towards = plan.towards.normalize();
        let aside = if towards.z.abs() < 0.9 {
            Vector3::z()
        } else {
            Vector3::y()
        };
        let across = aside.cross(&towards).normalize();
        let up = towards.cross(&across);
        let axes = [across, up, towards];
        // Indices of corners are among all corners, of which the first are others'.
        let corners = blocking.corners.get(blocking.first..).unwrap_or_default();
        let places: Vec<Corner> = corners
            .iter()
            .map(|corner| axes.map(|axis| corner.point.dot(&axis)))
            .collect();
        let area = [0, 1].map(|i| {
            let axis = axes[i].cast::<f32>();
            let [low, high] = bounds(seen.iter().map(|point| f64::from(point.dot(&axis))));
            let beyond = BEYOND * (high - low);
            let blocking = bounds(places.iter().map(|place| place[i]));
            let (low, high) = (
                blocking[0].max(low - beyond),
                blocking[1].min(high + beyond),
            );
            // Nothing, if no shadow is seen.
            if low < high { [low, high] } else { [0.0, 0.0] }
        });
        let extent = area
            .iter()
            .fold(0.0, |e: f64, [low, high]| e.max(high - low));
        let grain = (round_extent(extent) / plan.most).max(plan.least);
        // Cells are at multiples of their size, and there are few sizes: the shadows of what
        // stands still are the same in all pictures of a run.
        let first = area.map(|[low, _]| (low / grain).floor() - BORDER);
        let count = |axis: usize| {
            let [_, high] = area[axis];
            // At most some thousands, by the choice of the grain.
            ((high / grain).ceil() + BORDER - first[axis]) as usize
        };
        let single = |axis: Vector3<f64>, offset: f64| (axis.cast(), offset as f32);
        let mut lamp = Self {
            towards: towards.cast(),
            axes: [
                single(across / grain, -first[0]),
                single(up / grain, -first[1]),
                single(towards, 0.0),
            ],
            grain: grain as f32,
            columns: count(0),
            rows: count(1),
            heights: vec![f32::MIN; count(0) * count(1)],
        };
        if extent > 0.0 {
            let per_grain = 1.0 / grain;
            let place = |i: u32| {
                let [x, y, height] = *places.get(i as usize - blocking.first)?;
                Some([x * per_grain - first[0], y * per_grain - first[1], height])
            };
            for facet in blocking.facets {
                // All corners are there.
                if let [Some(a), Some(b), Some(c)] = facet.corners.map(place) {
                    lamp.draw([a, b, c]);
                }
            }
        }
        lamp
    }

    /// Draws a triangle that faces the light, given by the columns, rows and heights of its corners.
    fn draw(&mut self, corners: [Corner; 3]) {
        let [a, b, c] = corners;
        if twice_area(a, b, c) <= 0.0 {
            return;
        }
        let range = |i: usize, end: usize| covered([a[i], b[i], c[i]], end);
        let (columns, rows) = (range(0, self.columns), range(1, self.rows));
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        if columns.len() * rows.len() <= FEW {
            self.draw_small(corners, columns, rows);
            return;
        }
        let Some(patch) = Patch::new(corners, self.columns, self.rows) else {
            return;
        };
        for row in patch.rows().clone() {
            let columns = patch.columns(row, self.columns);
            if columns.is_empty() {
                continue;
            }
            let (start, slope) = patch.nearness(columns.start, row);
            // Rows and columns were clipped to the grid by the patch.
            let heights = &mut self.heights[row * self.columns..][columns];
            for (i, height) in heights.iter_mut().enumerate() {
                let here = start + slope * i as i32 as f32;
                *height = if here > *height { here } else { *height };
            }
        }
    }

    /// Draws a triangle of few cells, which are among these columns and rows. A cell on an edge belongs
    /// to both triangles there.
    fn draw_small(&mut self, corners: [Corner; 3], columns: Range<usize>, rows: Range<usize>) {
        let [a, b, c] = corners;
        // How far inside an edge a place is, times the edge's length: per column, per row, and at
        // the first cell.
        let (x, y) = (columns.start as f64 + 0.5, rows.start as f64 + 0.5);
        let inside = |from: Corner, to: Corner| {
            let (across, down) = (to[0] - from[0], to[1] - from[1]);
            let start = across * (y - from[1]) - down * (x - from[0]);
            [-down, across, start].map(|v| v as f32)
        };
        let edges = [inside(b, c), inside(c, a), inside(a, b)];
        let per_area = 1.0 / twice_area(a, b, c) as f32;
        let heights = [a, b, c].map(|corner| corner[2] as f32 * per_area);
        for (row, cells) in (0..rows.len() as i32).zip(rows) {
            let cells = &mut self.heights[cells * self.columns..][columns.clone()];
            for (column, cell) in (0..cells.len() as i32).zip(cells) {
                let [u, v, w] = edges.map(|[across, down, start]| {
                    start + across * column as f32 + down * row as f32
                });
                let here = u * heights[0] + v * heights[1] + w * heights[2];
                let is_inside = (u >= 0.0) & (v >= 0.0) & (w >= 0.0);
                *cell = if is_inside & (here > *cell) {
                    here
                } else {
                    *cell
                };
            }
        }
    }

    /// Distance (m) between cells of the grid.
    pub(crate) fn grain(&self) -> f32 {
        self.grain
    }

    /// How far (m) off a surface what is to be lit has to be so that a slanting one does not shade
    /// itself, for neighbourhoods of `COUNT` cells; given the cosine of the slant.
    fn lift<const COUNT: usize>(&self, cosine: f32) -> f32 {
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        (0.3 + 0.7 * COUNT as f32 * sine) * self.grain
    }

    /// Columns and rows before which neighbourhoods of `COUNT` cells begin that are in the grid.
    fn ends<const COUNT: usize>(&self) -> [f32; 2] {
        [self.columns, self.rows].map(|size| (size - COUNT) as f32)
    }

    /// Share (0..1) of the light that reaches the neighbourhood of the point (m, map frame) on
    /// a surface with the unit normal, averaged over `COUNT` - 1 cells of the grid and a
    /// fraction of another one.
    pub(crate) fn reaches<const COUNT: usize>(
        &self,
        point: &Vector3<f32>,
        normal: &Vector3<f32>,
    ) -> f32 {
        let width = (COUNT - 1) as f32;
        let lifted = point + normal * self.lift::<COUNT>(self.towards.dot(normal));
        let [x, y, height] = self
            .axes
            .map(|(factors, offset)| factors.dot(&lifted) + offset);
        let (x, y) = (x - width / 2.0, y - width / 2.0);
        let [right, bottom] = self.ends::<COUNT>();
        if !(x >= 0.0 && y >= 0.0 && x < right && y < bottom) {
            return 1.0;
        }
        let (column, row) = (x as usize, y as usize);
        let weights = |place: f32, first: usize| {
            let share = place - first as f32;
            let mut weights = [1.0; COUNT];
            weights[0] = 1.0 - share;
            weights[COUNT - 1] = share;
            weights
        };
        let (across, down) = (weights(x, column), weights(y, row));
        let mut sum = 0.0;
        for (j, down) in down.into_iter().enumerate() {
            // Both ends of the neighbourhood are inside the grid, as computed above.
            let heights = &self.heights[(row + j) * self.columns + column..][..COUNT];
            let mut lit = 0.0;
            for (there, weight) in heights.iter().zip(across) {
                lit += if *there <= height { weight } else { 0.0 };
            }
            sum += lit * down;
        }
        sum / (width * width)
    }

    /// What [`reaches`](Self::reaches) is on the whole flat piece of a surface with these corners
    /// (m, map frame) and this unit normal, if it is certain to be 0 everywhere, or 1.
    pub(crate) fn reaches_all<const COUNT: usize>(
        &self,
        corners: &[Vector3<f32>; 4],
        normal: &Vector3<f32>,
    ) -> Option<f32> {
        let cosine = self.towards.dot(normal);
        if cosine <= 0.0 {
            return Some(0.0);
        }
        let lift = normal * self.lift::<COUNT>(cosine);
        let places = self.axes.map(|(factors, offset)| {
            let offset = factors.dot(&lift) + offset;
            corners.map(|corner| factors.dot(&corner) + offset)
        });
        let range = |i: usize| {
            let [a, b, c, d] = places[i];
            let shift = if i < 2 { (COUNT - 1) as f32 / 2.0 } else { 0.0 };
            [
                a.min(b).min(c.min(d)) - shift,
                a.max(b).max(c.max(d)) - shift,
            ]
        };
        let [xs, ys, heights] = [range(0), range(1), range(2)];
        let [right, bottom] = self.ends::<COUNT>();
        if xs[1] < 0.0 || ys[1] < 0.0 || xs[0] >= right || ys[0] >= bottom {
            return Some(1.0);
        }
        if !(xs[0] >= 0.0 && ys[0] >= 0.0 && xs[1] < right && ys[1] < bottom) {
            return None;
        }
        let columns = xs[0] as usize..xs[1] as usize + COUNT;
        let rows = ys[0] as usize..ys[1] as usize + COUNT;
        if columns.len() * rows.len() > MAX_CELLS {
            return None;
        }
        // The height of the surface changes by this from one column, and row, to the next.
        let square = self.grain * self.grain / cosine;
        let [across, down] = [0, 1].map(|i| -self.axes[i].0.dot(normal) * square);
        // A cell belongs to neighbourhoods that begin up to so many cells before it.
        let slack = (across.abs() + down.abs()) * COUNT as f32 / 2.0;
        let [x, y, height] = places.map(|values| values[0]);
        let first = height + (columns.start as f32 + 0.5 - x) * across;
        let [low, high] = heights;
        let (mut some_dark, mut some_lit) = (0, 0);
        for row in rows {
            let start = first + (row as f32 + 0.5 - y) * down;
            // The cells are inside the grid, as computed above.
            let cells = &self.heights[row * self.columns..][columns.clone()];
            for (i, cell) in cells.iter().enumerate() {
                let here = start + i as i32 as f32 * across;
                some_dark |= i32::from((*cell > low) & (*cell > here - slack));
                some_lit |= i32::from((*cell <= high) & (*cell <= here + slack));
            }
            if some_dark & some_lit == 1 {
                return None;
            }
        }
        Some(if some_dark == 0 { 1.0 } else { 0.0 })
    }
}

/// The cells below `end` whose centres are between the least and the greatest of some places.
fn covered(places: [f64; 3], end: usize) -> Range<usize> {
    let [a, b, c] = places;
    first_place(a.min(b).min(c))..first_place(a.max(b).max(c)).min(end)
}

/// The least and the greatest of some numbers; the least is infinite if there are none.
fn bounds(numbers: impl Iterator<Item = f64>) -> [f64; 2] {
    numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], number| {
        [low.min(number), high.max(number)]
    })
}

/// The extent (m) or more: 1, 1.5, 2, 3, 4, 6, ….
fn round_extent(extent: f64) -> f64 {
    let (mut round, mut next) = (1.0, 1.5);
    // Nothing that a picture shows is larger.
    while round < extent.min(1e4) {
        (round, next) = (next, 2.0 * round);
    }
    round
}

#[cfg(test)]
mod tests {
    use crate::picture::lamp::*;

    use crate::picture::facet::{Corner, Facet};

    /// Horizontal squares at heights, with half their sizes (m).
    fn squares(all: [[f64; 2]; 2]) -> (Vec<Corner>, Vec<Facet>) {
        let corners = all.iter().flat_map(|[z, half]| {
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            corners.map(|[x, y]: [f64; 2]| Corner {
                point: Vector3::new(x * half, y * half, *z),
                normal: Vector3::z(),
            })
        });
        let facets = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
        let facet = |corners| Facet { corners, body: 0 };
        (corners.collect(), facets.map(facet).to_vec())
    }

    /// A lamp on a board half a metre above a larger one.
    fn lamp(towards: Vector3<f64>, seen: &[Vector3<f32>]) -> Lamp {
        let (corners, facets) = squares([[0.0, 1.0], [0.5, 0.5]]);
        let plan = LampPlan {
            towards,
            most: 200.0,
            least: 0.01,
            is_sky: false,
        };
        let boards = Mesh {
            corners: &corners,
            facets: &facets,
            first: 0,
        };
        Lamp::new(plan, boards, seen)
    }

    fn seen() -> [Vector3<f32>; 2] {
        [[-1.0, -1.0], [1.0, 1.0]].map(|[x, y]| Vector3::new(x, y, 0.0))
    }

    #[test]
    fn what_is_under_a_board_is_dark_and_what_is_beside_it_is_lit() {
        let above = lamp(Vector3::z(), &seen());
        let light = |x: f32, z: f32| above.reaches::<4>(&Vector3::new(x, 0.0, z), &Vector3::z());
        assert_eq!(light(0.0, 0.01), 0.0);
        assert_eq!(light(0.0, 0.51), 1.0);
        assert_eq!(light(0.7, 0.01), 1.0);
        assert!((0.1..0.9).contains(&light(0.5, 0.01)));
        assert_eq!(light(9.0, 0.0), 1.0);
        let nothing = lamp(Vector3::z(), &[]);
        assert_eq!(nothing.reaches::<4>(&Vector3::zeros(), &Vector3::z()), 1.0);
    }

    #[test]
    fn what_is_said_of_a_whole_piece_is_so_everywhere_on_it() {
        let aslant = lamp(Vector3::new(-0.5, 0.3, 1.0), &seen());
        let normal = Vector3::z();
        let mut counts = [0; 3];
        for i in 0..800usize {
            let place = |step: usize| (i / step % 20) as f32 / 10.0 - 1.0;
            let (x, y, z) = (place(1), place(20), if i < 400 { 0.0 } else { 0.5 });
            let at = |dx: f32, dy: f32| Vector3::new(x + dx, y + dy, z);
            let piece = [at(0.0, 0.0), at(0.1, 0.0), at(0.0, 0.1), at(0.1, 0.1)];
            let all = aslant.reaches_all::<4>(&piece, &normal);
            counts[all.map_or(2, |light| light as usize)] += 1;
            for (dx, dy) in [(0.0, 0.0), (0.05, 0.02), (0.1, 0.1), (0.03, 0.09)] {
                let here = aslant.reaches::<4>(&at(dx, dy), &normal);
                assert!(
                    all.is_none_or(|all| (all - here).abs() < 1e-5),
                    "{x} {y} {z}"
                );
            }
        }
        assert!(counts.iter().all(|count| *count > 10), "{counts:?}");
    }

    #[test]
    fn extents_are_rounded_up_to_few_values() {
        let rounded = [0.0, 1.0, 1.2, 1.6, 2.5, 3.5, 5.0, 9.0].map(round_extent);
        assert_eq!(rounded, [1.0, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 12.0]);
        assert!(round_extent(f64::INFINITY).is_finite());
    }
}
