//! Where light comes from, and what blocks it.

use nalgebra::Vector3;

use super::facet::Facet;
use super::raster::{Corner, Patch};

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
    pub(crate) most: f64,
    /// The least distance between cells (m).
    pub(crate) least: f64,
    /// Whether only large bodies block the light.
    pub(crate) is_sky: bool,
}

/// Cells beyond what is seen, for the neighbourhoods of the outermost points.
const BORDER: f64 = 4.0;

/// What is seen is known from some of its points; others may be this share of its extent outside.
const BEYOND: f64 = 0.04;

impl Lamp {
    /// A light on the triangles, for a picture that shows these points (m, map frame).
    pub(crate) fn new(plan: LampPlan, facets: &[Facet], seen: &[Vector3<f32>]) -> Self {
        let towards = plan.towards.normalize();
        let aside = if towards.z.abs() < 0.9 {
            Vector3::z()
        } else {
            Vector3::y()
        };
        let across = aside.cross(&towards).normalize();
        let up = towards.cross(&across);
        let blocking = [&across, &up].map(|axis| {
            let points = facets.iter().flat_map(|facet| &facet.points);
            bounds(points.map(|point| point.dot(axis)))
        });
        let seen = [&across, &up].map(|axis| {
            let axis = axis.cast::<f32>();
            let [low, high] = bounds(seen.iter().map(|point| f64::from(point.dot(&axis))));
            let beyond = BEYOND * (high - low);
            [low - beyond, high + beyond]
        });
        let area = [0, 1].map(|i| {
            let [low, high] = [
                blocking[i][0].max(seen[i][0]),
                blocking[i][1].min(seen[i][1]),
            ];
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
        let place = |point: &Vector3<f64>| {
            [
                point.dot(&across) / grain - first[0],
                point.dot(&up) / grain - first[1],
                point.dot(&towards),
            ]
        };
        for facet in facets {
            if extent > 0.0 && facet.outward.dot(&towards) > 0.0 {
                lamp.draw(facet.points.map(|point| place(&point)));
            }
        }
        lamp
    }

    /// Draws a triangle, given by the columns, rows and heights of its corners.
    fn draw(&mut self, corners: [Corner; 3]) {
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
                *height = height.max(start + slope * i as f32);
            }
        }
    }

    /// Distance (m) between cells of the grid.
    pub(crate) fn grain(&self) -> f32 {
        self.grain
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
        // Far enough off the surface that a slanting one does not shade itself.
        let cosine = self.towards.dot(normal);
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let lift = (0.3 + (0.7 * width + 0.7) * sine) * self.grain;
        let lifted = point + normal * lift;
        let [x, y, height] = self
            .axes
            .map(|(factors, offset)| factors.dot(&lifted) + offset);
        let (x, y) = (x - width / 2.0, y - width / 2.0);
        let [right, bottom] = [self.columns, self.rows].map(|size| (size - COUNT) as f32);
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

    fn square(z: f64, half: f64) -> [Facet; 2] {
        let corner = |x: f64, y: f64| Vector3::new(x * half, y * half, z);
        let facet = |points| Facet::new(points, [Vector3::z(); 3], 0).unwrap();
        [
            facet([corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0)]),
            facet([corner(-1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]),
        ]
    }

    #[test]
    fn what_is_under_a_board_is_dark_and_what_is_beside_it_is_lit() {
        let facets = [square(0.0, 1.0), square(0.5, 0.5)].concat();
        let plan = LampPlan {
            towards: Vector3::z(),
            most: 200.0,
            least: 0.01,
            is_sky: false,
        };
        let seen = [[-1.0, -1.0], [1.0, 1.0]].map(|[x, y]| Vector3::new(x, y, 0.0));
        let lamp = Lamp::new(plan, &facets, &seen);
        let light = |x: f32, z: f32| lamp.reaches::<4>(&Vector3::new(x, 0.0, z), &Vector3::z());
        assert_eq!(light(0.0, 0.01), 0.0);
        assert_eq!(light(0.0, 0.51), 1.0);
        assert_eq!(light(0.7, 0.01), 1.0);
        assert!((0.1..0.9).contains(&light(0.5, 0.01)));
        assert_eq!(light(9.0, 0.0), 1.0);
        let nothing = Lamp::new(plan, &facets, &[]);
        assert_eq!(nothing.reaches::<4>(&Vector3::zeros(), &Vector3::z()), 1.0);
    }

    #[test]
    fn extents_are_rounded_up_to_few_values() {
        let rounded = [0.0, 1.0, 1.2, 1.6, 2.5, 3.5, 5.0, 9.0].map(round_extent);
        assert_eq!(rounded, [1.0, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 12.0]);
        assert!(round_extent(f64::INFINITY).is_finite());
    }
}
