//! A pinhole camera.

use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};

use spatial::{Pose, trig};

/// A camera; its optical frame has z forward, x to the right of the picture and y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Pose of the optical frame in the map frame.
    pub pose: Pose,
    /// Width of the picture (pixels).
    pub width: usize,
    /// Height of the picture (pixels).
    pub height: usize,
    /// Vertical field of view (rad).
    pub vertical_fov: f64,
    /// Distance (m along z) before which nothing is seen.
    pub near: f64,
    /// Distance (m along z) beyond which nothing is seen.
    pub far: f64,
}

impl Camera {
    /// A camera of the robot, with its optical frame at the pose.
    pub fn new(camera: &crate::robot::description::Camera, pose: Pose) -> Self {
        Self {
            pose,
            width: camera.width,
            height: camera.height,
            vertical_fov: camera.vertical_view,
            near: camera.near,
            far: camera.far,
        }
    }

    /// The camera that CRAM's renderer simulates for the PR2.
    #[cfg(test)]
    pub fn of_head(pose: Pose) -> Self {
        let (width, height, near, far) = (320, 200, 0.1, 10.0);
        let vertical_fov = 50f64.to_radians();
        Self {
            pose,
            width,
            height,
            vertical_fov,
            near,
            far,
        }
    }

    /// Distance of the picture plane from the focal point (pixels).
    pub fn focal_length(&self) -> f64 {
        let (s, c) = trig::sin_cos(self.vertical_fov / 2.0);
        self.height as f64 / 2.0 * c / s
    }

    /// Horizontal field of view (rad).
    pub(crate) fn horizontal_fov(&self) -> f64 {
        2.0 * trig::atan2(self.width as f64 / 2.0, self.focal_length())
    }

    /// The pixel (column, row) that shows the point (m, map frame), possibly outside the
    /// picture; `None` for a point that is not in front of the camera.
    pub fn pixel_of(&self, point: &Point3<f64>) -> Option<[f64; 2]> {
        let p = self.pose.inverse_transform_point(point);
        let f = self.focal_length();
        (p.z > 0.0).then(|| {
            [
                self.width as f64 / 2.0 + f * p.x / p.z,
                self.height as f64 / 2.0 + f * p.y / p.z,
            ]
        })
    }

    /// The same camera at the same place, turned so that the point (m, map frame) is in the
    /// middle of the picture and the horizon is level.
    #[must_use]
    pub(crate) fn turned_to(&self, point: &Point3<f64>) -> Self {
        let origin = Point3::from(self.pose.translation.vector);
        let Some(forward) = (point - origin).try_normalize(1e-9) else {
            return *self;
        };
        // Straight up or down there is no horizon, so keep the camera's own x axis.
        let right = forward
            .cross(&Vector3::z())
            .try_normalize(1e-6)
            .unwrap_or_else(|| {
                let own = self.pose * Vector3::x();
                (own - forward * own.dot(&forward))
                    .try_normalize(1e-6)
                    .unwrap_or_else(Vector3::x)
            });
        let down = forward.cross(&right);
        let axes = Matrix3::from_columns(&[right, down, forward]);
        let rotation =
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
        Self {
            pose: Pose::from_parts(self.pose.translation, rotation),
            ..*self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_point_that_the_camera_is_turned_to_is_in_the_middle() {
        let camera = Camera::of_head(Pose::translation(1.0, 2.0, 1.5));
        for point in [[3.0, 2.5, 0.7], [1.0, 2.0, 0.0], [-4.0, 2.0, 1.5]] {
            let point = Point3::from(point);
            let [column, row] = camera.turned_to(&point).pixel_of(&point).unwrap();
            assert!((column - 160.0).abs() < 1e-6 && (row - 100.0).abs() < 1e-6);
        }
    }

    #[test]
    fn the_picture_is_73_degrees_wide() {
        let camera = Camera::of_head(Pose::identity());
        assert!((camera.horizontal_fov().to_degrees() - 73.45).abs() < 0.01);
    }
}
