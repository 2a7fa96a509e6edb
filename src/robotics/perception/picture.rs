//! A z-buffer that holds the visible body of each pixel.

use nalgebra::Point3;

use super::camera::Camera;
use super::mesh::Mesh;
use super::raster;
use super::window::Window;
use crate::world::PartKey;
use spatial::Pose;

/// What a camera sees: for every pixel, or those of a window, the nearest body and its distance.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    camera: Camera,
    window: Window,
    keys: Vec<Option<PartKey>>,
    /// Inverse of the depth (1/m), 0 where nothing is seen.
    inverse_depth: Vec<f64>,
}

impl Picture {
    /// An empty picture.
    pub fn new(camera: Camera) -> Self {
        Self::of_window(camera, Window::whole(&camera))
    }

    /// An empty picture of which only a window is drawn.
    pub(crate) fn of_window(camera: Camera, window: Window) -> Self {
        let pixels = window.pixels();
        Self {
            camera,
            window,
            keys: vec![None; pixels],
            inverse_depth: vec![0.0; pixels],
        }
    }

    /// The camera that took the picture.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The pixels that it holds.
    pub(crate) fn window(&self) -> Window {
        self.window
    }

    /// The body at every pixel of the window, row by row from the top.
    pub fn keys(&self) -> &[Option<PartKey>] {
        &self.keys
    }

    /// Distance (m along the camera's z) of what the pixel shows; `None` if it shows nothing or
    /// lies outside the window.
    pub fn depth(&self, column: usize, row: usize) -> Option<f64> {
        let inverse = *self.inverse_depth.get(self.window.place([column, row])?)?;
        (inverse > 0.0).then(|| 1.0 / inverse)
    }

    /// Whether a ball around the origin of a pose (map frame), with a radius (m), may be seen in the
    /// window.
    pub(crate) fn may_show(&self, pose: &Pose, radius: f64) -> bool {
        let camera = &self.camera;
        let origin = Point3::from(pose.translation.vector);
        let c = camera.pose.inverse_transform_point(&origin).coords;
        if c.z < camera.near - radius || c.z > camera.far + radius {
            return false;
        }
        let f = camera.focal_length();
        // How far the ball is beyond the planes through the focal point and the window's borders.
        let beyond = |axis: usize, size: usize| {
            let [first, end] = [self.window.first, self.window.end]
                .map(|at| (at[axis] as f64 - size as f64 / 2.0) / f);
            let along = c[axis];
            let before = (first * c.z - along) / libm::hypot(first, 1.0);
            let after = (along - end * c.z) / libm::hypot(end, 1.0);
            before.max(after)
        };
        beyond(0, camera.width) <= radius && beyond(1, camera.height) <= radius
    }

    /// The body at every pixel of a window that lies within this one's, row by row from the top.
    pub(super) fn keys_in(&self, window: Window) -> impl Iterator<Item = Option<PartKey>> {
        let key = |pixel| self.keys.get(self.window.place(pixel)?).copied().flatten();
        window.places().map(key)
    }

    /// Number of pixels that show the body.
    pub fn count(&self, key: PartKey) -> usize {
        self.keys.iter().filter(|k| **k == Some(key)).count()
    }

    /// Draws a surface at the pose (map frame). Surfaces may be drawn in any order.
    pub fn draw(&mut self, key: PartKey, pose: &Pose, mesh: &Mesh) {
        let Self {
            camera,
            window,
            keys,
            inverse_depth,
        } = self;
        let farthest = 1.0 / camera.far;
        raster::each_row(camera, window, pose, mesh, |facet, row, columns| {
            let [_, nearest] = facet.bounds();
            let first = window.at([columns.start, row]);
            for (column, place) in columns.zip(first..) {
                // What is nearer already needs no exact comparison.
                if nearest <= inverse_depth[place] {
                    continue;
                }
                let inverse = facet.inverse_depth(column, row);
                if inverse > inverse_depth[place] && inverse >= farthest {
                    inverse_depth[place] = inverse;
                    keys[place] = Some(key);
                }
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use rand_pcg::Pcg64;
    use rand_pcg::rand_core::{Rng, SeedableRng};

    use super::*;
    use spatial::{Shape, pose};

    const NEAR: PartKey = PartKey::Object(1);
    const FAR: PartKey = PartKey::Object(2);

    fn cube(size: f64) -> Mesh {
        Mesh::of(&Shape::Box { size: [size; 3] })
    }

    #[test]
    fn a_cube_covers_as_many_pixels_as_its_face_at_its_distance() {
        let mut picture = Picture::new(Camera::of_head(Pose::identity()));
        picture.draw(NEAR, &Pose::translation(0.0, 0.0, 2.5), &cube(1.0));
        // The front face is 2 m away: 214.45 / 2 pixels wide.
        let side = picture.camera().focal_length() / 2.0;
        let count = picture.count(NEAR) as f64;
        assert!((count - side * side).abs() < 2.5 * side, "{count}");
        assert!((picture.depth(160, 100).unwrap() - 2.0).abs() < 1e-9);
    }

    #[test]
    fn the_nearer_body_is_seen_whatever_is_drawn_first() {
        let camera = Camera::of_head(Pose::identity());
        let mut one = Picture::new(camera);
        one.draw(NEAR, &Pose::translation(0.0, 0.0, 2.0), &cube(0.5));
        one.draw(FAR, &Pose::translation(0.0, 0.0, 4.0), &cube(2.0));
        let mut two = Picture::new(camera);
        two.draw(FAR, &Pose::translation(0.0, 0.0, 4.0), &cube(2.0));
        two.draw(NEAR, &Pose::translation(0.0, 0.0, 2.0), &cube(0.5));
        assert_eq!(one, two);
        assert!(one.count(NEAR) > 0 && one.count(FAR) > one.count(NEAR));
    }

    /// Balls, cubes and boards at random, some around or behind the camera.
    fn scene() -> Vec<(PartKey, Pose, Shape)> {
        let mut random = Pcg64::seed_from_u64(5);
        let mut number = |low: f64, high: f64| {
            low + (high - low) * f64::from(random.next_u32()) / f64::from(u32::MAX)
        };
        let things = 0..60;
        things
            .map(|i| {
                let at = [number(-3.0, 3.0), number(-3.0, 3.0), number(-2.0, 6.0)];
                let turn = [0.0; 3].map(|_: f64| number(-3.0, 3.0));
                let size = [0.0; 3].map(|_: f64| number(0.02, 1.5));
                let shape = match i % 3 {
                    0 => Shape::Box { size },
                    1 => Shape::Sphere {
                        radius: size[0] / 2.0,
                    },
                    _ => Shape::Cylinder {
                        radius: size[0] / 2.0,
                        length: size[1],
                    },
                };
                (PartKey::Object(i), pose::from_xyz_rpy(at, turn), shape)
            })
            .collect()
    }

    fn draw(mut picture: Picture, culls: bool) -> Picture {
        for (key, pose, shape) in scene() {
            if !culls || picture.may_show(&pose, shape.bounding_radius()) {
                picture.draw(key, &pose, &Mesh::of(&shape));
            }
        }
        picture
    }

    #[test]
    fn a_window_shows_what_the_whole_picture_shows_there() {
        let camera = Camera::of_head(Pose::translation(0.1, 0.2, -1.0));
        let whole = draw(Picture::new(camera), false);
        assert!(
            whole == draw(Picture::new(camera), true),
            "something was left out"
        );
        for (first, end) in [
            ([0, 0], [60, 200]),
            ([100, 60], [240, 61]),
            ([200, 120], [320, 200]),
        ] {
            let window = Window { first, end };
            let part = draw(Picture::of_window(camera, window), true);
            let mut seen = 0;
            for (row, column) in
                (first[1]..end[1]).flat_map(|r| (first[0]..end[0]).map(move |c| (r, c)))
            {
                assert_eq!(part.depth(column, row), whole.depth(column, row));
                let place = window.place([column, row]).unwrap();
                assert_eq!(part.keys[place], whole.keys[row * 320 + column]);
                seen += usize::from(part.keys[place].is_some());
            }
            assert!(seen > 0);
            assert_eq!(part.depth(end[0], first[1]), None);
        }
    }

    #[test]
    fn a_body_is_within_the_window_around_its_corners() {
        let camera = Camera::of_head(Pose::translation(0.0, 0.0, -1.0));
        for (key, pose, shape) in scene() {
            let mesh = Mesh::of(&shape);
            let mut whole = Picture::new(camera);
            whole.draw(key, &pose, &mesh);
            let window = Window::around(&camera, mesh.corners.iter().map(|p| pose * p));
            let mut part = Picture::of_window(camera, window);
            part.draw(key, &pose, &mesh);
            assert_eq!(part.count(key), whole.count(key));
            let common = Window::whole(&camera).common_with(&window);
            assert!(whole.keys_in(common).eq(part.keys.iter().copied()));
        }
    }

    #[test]
    fn windows_have_the_pixels_in_common_that_both_have() {
        let windows = [
            ([0, 0], [60, 200]),
            ([100, 60], [240, 61]),
            ([50, 30], [130, 100]),
            ([7, 7], [7, 9]),
        ];
        let windows = windows.map(|(first, end)| Window { first, end });
        for (one, other) in windows
            .iter()
            .flat_map(|w| windows.iter().map(move |v| (w, v)))
        {
            let both = one.places().filter(|pixel| other.place(*pixel).is_some());
            assert!(
                one.common_with(other).places().eq(both),
                "{one:?} {other:?}"
            );
        }
    }

    #[test]
    fn a_body_around_the_camera_is_not_seen() {
        let mut picture = Picture::new(Camera::of_head(Pose::identity()));
        picture.draw(NEAR, &Pose::identity(), &cube(0.5));
        assert_eq!(picture.count(NEAR), 0);
    }

    #[test]
    fn what_reaches_behind_the_camera_is_cut_at_the_near_plane() {
        let mut picture = Picture::new(Camera::of_head(Pose::identity()));
        let board = Mesh::of(&Shape::Box {
            size: [4.0, 0.1, 4.0],
        });
        picture.draw(NEAR, &Pose::translation(0.0, 0.5, 0.0), &board);
        // The top of the board, 0.45 m below the camera, ends 2 m ahead.
        let row = (100.0 + picture.camera().focal_length() * 0.45 / 2.0).ceil() as usize;
        assert_eq!(picture.depth(160, row - 2), None);
        assert!((picture.depth(160, 199).unwrap() - 0.45 * 214.45 / 99.5).abs() < 0.01);
    }
}
