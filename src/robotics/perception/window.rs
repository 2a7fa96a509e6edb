//! A part of a picture.

use nalgebra::Point3;

use super::camera::Camera;

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Window {
    /// Its first column and row.
    pub(super) first: [usize; 2],
    /// The column and row after its last ones.
    pub(super) end: [usize; 2],
}

impl Window {
    /// All pixels of a camera.
    pub(crate) fn whole(camera: &Camera) -> Self {
        Self {
            first: [0, 0],
            end: [camera.width, camera.height],
        }
    }

    /// One pixel; none if the camera does not have it.
    pub(crate) fn pixel(camera: &Camera, [column, row]: [f64; 2]) -> Option<Self> {
        let is_inside = (0.0..camera.width as f64).contains(&column)
            && (0.0..camera.height as f64).contains(&row);
        // Both are within the picture, so that the casts are exact.
        let first = [column as usize, row as usize];
        let end = first.map(|i| i + 1);
        is_inside.then_some(Self { first, end })
    }

    /// The pixels in which the points (m, map frame), and what is between them, may be seen.
    pub(crate) fn around(camera: &Camera, points: impl Iterator<Item = Point3<f64>>) -> Self {
        let whole = Self::whole(camera);
        let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points {
            let is_cut = camera.pose.inverse_transform_point(&point).z < camera.near;
            let Some(pixel) = camera.pixel_of(&point).filter(|_| !is_cut) else {
                return whole;
            };
            for i in 0..2 {
                least[i] = least[i].min(pixel[i]);
                most[i] = most[i].max(pixel[i]);
            }
        }
        // The casts saturate at 0; what is rounded is within a pixel.
        let first = [0, 1].map(|i| ((least[i] - 1.0) as usize).min(whole.end[i]));
        let end = [0, 1].map(|i| ((most[i] + 2.0) as usize).clamp(first[i], whole.end[i]));
        Self { first, end }
    }

    /// The pixels that both have; none, somewhere in this one, if there are no such pixels.
    pub(super) fn common_with(&self, other: &Self) -> Self {
        let within = |axis: usize, at: usize| at.clamp(self.first[axis], self.end[axis]);
        Self {
            first: [0, 1].map(|axis| within(axis, other.first[axis])),
            end: [0, 1].map(|axis| within(axis, other.end[axis])),
        }
    }

    /// Its pixels, row by row, as columns and rows.
    pub(super) fn places(&self) -> impl Iterator<Item = [usize; 2]> + use<> {
        let [columns, rows] = [0, 1].map(|i| self.first[i]..self.end[i]);
        rows.flat_map(move |row| columns.clone().map(move |column| [column, row]))
    }

    pub(super) fn width(&self) -> usize {
        self.end[0] - self.first[0]
    }

    pub(super) fn pixels(&self) -> usize {
        self.width() * (self.end[1] - self.first[1])
    }

    /// The place of a pixel among those of the window, row by row.
    pub(super) fn place(&self, [column, row]: [usize; 2]) -> Option<usize> {
        let [columns, rows] = [0, 1].map(|i| self.first[i]..self.end[i]);
        let is_inside = columns.contains(&column) && rows.contains(&row);
        is_inside.then(|| self.at([column, row]))
    }

    /// The place of a pixel of the window among its pixels, row by row.
    pub(super) fn at(&self, [column, row]: [usize; 2]) -> usize {
        (row - self.first[1]) * self.width() + column - self.first[0]
    }
}
