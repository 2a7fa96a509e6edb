//! Where light comes from, and what blocks it.

use nalgebra::Vector3;

use super::facet::Facet;
use super::raster::Patch;

/// A distant light, with a shadow map: for each cell of a grid across the light's direction,
/// the height of the surface that it lights.
pub(crate) struct Lamp {
    /// Unit vector towards the light.
    pub(crate) towards: Vector3<f64>,
    across: Vector3<f64>,
    up: Vector3<f64>,
    /// Origin of the grid (m along `across` and `up`).
    origin: [f64; 2],
    /// Cells per metre.
    scale: f64,
    size: usize,
    /// Height (m along `towards`) of the lit surface; the least value where there is none.
    heights: Vec<f32>,
}

impl Lamp {
    /// A light from the direction `towards` (not zero) on the triangles; its grid has `size`
    /// rows and columns.
    pub(crate) fn new(towards: Vector3<f64>, size: usize, facets: &[Facet]) -> Self {
        let towards = towards.normalize();
        let aside = if towards.z.abs() < 0.9 {
            Vector3::z()
        } else {
            Vector3::y()
        };
        let across = aside.cross(&towards).normalize();
        let up = towards.cross(&across);
        let mut bounds = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        for point in facets.iter().flat_map(|f| &f.points) {
            for (bound, axis) in bounds.iter_mut().zip([&across, &up]) {
                let place = point.dot(axis);
                *bound = [bound[0].min(place), bound[1].max(place)];
            }
        }
        let extent = bounds.iter().fold(0.0, |e: f64, b| e.max(b[1] - b[0]));
        // Without triangles, or if they all coincide in a point, any scale will do.
        let scale = if extent > 0.0 && extent.is_finite() {
            (size as f64 - 4.0) / extent
        } else {
            1.0
        };
        let mut lamp = Self {
            towards,
            across,
            up,
            origin: bounds.map(|b| b[0] - 2.0 / scale),
            scale,
            size,
            heights: vec![f32::MIN; size * size],
        };
        facets.iter().for_each(|facet| lamp.draw(facet));
        lamp
    }

    fn place(&self, point: &Vector3<f64>) -> [f64; 3] {
        [
            (point.dot(&self.across) - self.origin[0]) * self.scale,
            (point.dot(&self.up) - self.origin[1]) * self.scale,
            point.dot(&self.towards),
        ]
    }

    fn draw(&mut self, facet: &Facet) {
        if facet.outward.dot(&self.towards) <= 0.0 {
            return;
        }
        let corners = facet.points.map(|p| self.place(&p));
        let Some(patch) = Patch::new(corners, self.size, self.size) else {
            return;
        };
        for row in patch.rows().clone() {
            let columns = patch.columns(row, self.size);
            if columns.is_empty() {
                continue;
            }
            let (start, slope) = patch.nearness(columns.start, row);
            // Rows and columns were clipped to the grid by the patch.
            let heights = &mut self.heights[row * self.size..][columns];
            for (i, height) in heights.iter_mut().enumerate() {
                *height = height.max(start + slope * i as f32);
            }
        }
    }

    /// Distance (m) between cells of the grid.
    pub(crate) fn grain(&self) -> f64 {
        1.0 / self.scale
    }

    /// Share (0..1) of the light that reaches the neighbourhood of the point (m, map frame) on
    /// a surface with the unit normal, averaged over `COUNT` - 1 cells of the grid and a
    /// fraction of another one.
    pub(crate) fn reaches<const COUNT: usize>(
        &self,
        point: &Vector3<f64>,
        normal: &Vector3<f64>,
    ) -> f32 {
        let width = (COUNT - 1) as f64;
        // Far enough off the surface that a slanting one does not shade itself.
        let cosine = self.towards.dot(normal) as f32;
        let sine = f64::from((1.0 - cosine * cosine).max(0.0).sqrt());
        let lift = (0.3 + (0.7 * width + 0.7) * sine) / self.scale;
        let [x, y, height] = self.place(&(point + normal * lift));
        let (x, y) = (x - width / 2.0, y - width / 2.0);
        let last = (self.size - COUNT) as f64;
        if !(x >= 0.0 && y >= 0.0 && x < last && y < last) {
            return 1.0;
        }
        let (column, row) = (x as usize, y as usize);
        let weights = |place: f64, first: usize| {
            let share = (place - first as f64) as f32;
            let mut weights = [1.0; COUNT];
            weights[0] = 1.0 - share;
            weights[COUNT - 1] = share;
            weights
        };
        let (across, down) = (weights(x, column), weights(y, row));
        let height = height as f32;
        let mut sum = 0.0;
        for (j, down) in down.into_iter().enumerate() {
            // Both ends of the neighbourhood are inside the grid, as computed above.
            let heights = &self.heights[(row + j) * self.size + column..][..COUNT];
            let mut lit = 0.0;
            for (there, weight) in heights.iter().zip(across) {
                lit += if *there <= height { weight } else { 0.0 };
            }
            sum += lit * down;
        }
        sum / ((COUNT - 1) * (COUNT - 1)) as f32
    }
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
        let lamp = Lamp::new(Vector3::z(), 200, &facets);
        let light = |x: f64, z: f64| lamp.reaches::<4>(&Vector3::new(x, 0.0, z), &Vector3::z());
        assert_eq!(light(0.0, 0.01), 0.0);
        assert_eq!(light(0.0, 0.51), 1.0);
        assert_eq!(light(0.7, 0.01), 1.0);
        assert!((0.1..0.9).contains(&light(0.5, 0.01)));
        assert_eq!(light(9.0, 0.0), 1.0);
    }
}
