//! The pixels that would show a body if it were alone.

use super::camera::Camera;
use super::mesh::Mesh;
use super::raster;
use super::window::Window;
use spatial::Pose;

/// Whether each pixel of a window shows a body, where nothing hides it.
pub(super) struct Silhouette {
    window: Window,
    shows: Vec<bool>,
}

impl Silhouette {
    /// That of a body of some surfaces, each at its pose (map frame).
    pub(super) fn of(camera: &Camera, window: Window, surfaces: &[(Pose, Mesh)]) -> Self {
        let mut shows = vec![false; window.pixels()];
        let farthest = 1.0 / camera.far;
        for (pose, mesh) in surfaces {
            raster::each_row(camera, &window, pose, mesh, |facet, row, columns| {
                let is_near = facet.bounds()[0] >= farthest;
                let first = window.at([columns.start, row]);
                for (column, shown) in columns.clone().zip(&mut shows[first..]) {
                    *shown |= is_near || facet.inverse_depth(column, row) >= farthest;
                }
            });
        }
        Self { window, shows }
    }

    /// The pixels of which it is told.
    pub(super) fn window(&self) -> Window {
        self.window
    }

    /// For each of these pixels, row by row, whether it shows the body.
    pub(super) fn shows(&self) -> &[bool] {
        &self.shows
    }

    /// How many pixels show the body.
    pub(super) fn count(&self) -> usize {
        self.shows.iter().filter(|shows| **shows).count()
    }
}
