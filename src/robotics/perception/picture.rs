//! A z-buffer that holds the visible body of each pixel.

use std::ops::Range;

use nalgebra::{Point3, Vector3};

use super::camera::Camera;
use super::mesh::Mesh;
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

/// A corner in the camera's frame.
type Corner = Vector3<f64>;

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
        let to_camera = self.camera.pose.inverse() * pose;
        let corners: Vec<Corner> = mesh
            .corners
            .iter()
            .map(|p: &Point3<f64>| (to_camera * p).coords)
            .collect();
        if corners.iter().all(|c| c.z < self.camera.near)
            || corners.iter().all(|c| c.z > self.camera.far)
        {
            return;
        }
        for triangle in &mesh.triangles {
            // A mesh's triangles are indices into its own list of corners.
            let [a, b, c] = triangle.map(|i| corners[i as usize]);
            let outward = (b - a).cross(&(c - a));
            if outward.dot(&a) < 0.0 {
                self.draw_clipped(key, [a, b, c]);
            }
        }
    }

    /// Draws the part of the triangle beyond the near plane.
    fn draw_clipped(&mut self, key: PartKey, corners: [Corner; 3]) {
        let near = self.camera.near;
        if corners.iter().all(|c| c.z >= near) {
            self.draw_triangle(key, corners);
            return;
        }
        // A plane clips a triangle to at most four corners.
        let mut kept = [Corner::zeros(); 4];
        let mut count = 0;
        let mut keep = |corner: Corner| {
            kept[count] = corner;
            count += 1;
        };
        for i in 0..3 {
            let (from, to) = (corners[i], corners[(i + 1) % 3]);
            if from.z >= near {
                keep(from);
            }
            if (from.z >= near) != (to.z >= near) {
                keep(from + (to - from) * ((near - from.z) / (to.z - from.z)));
            }
        }
        for i in 2..count {
            self.draw_triangle(key, [kept[0], kept[i - 1], kept[i]]);
        }
    }

    /// Draws a triangle that lies beyond the near plane.
    fn draw_triangle(&mut self, key: PartKey, corners: [Corner; 3]) {
        let (width, height) = (self.camera.width, self.camera.height);
        let f = self.camera.focal_length();
        let centre = [width as f64 / 2.0, height as f64 / 2.0];
        // Columns, rows and inverse depths, all of which are linear in the picture.
        let [a, b, c] = corners.map(|p| {
            [
                centre[0] + f * p.x / p.z,
                centre[1] + f * p.y / p.z,
                1.0 / p.z,
            ]
        });
        let area = cross(a, b, c[0], c[1]);
        if area == 0.0 {
            return;
        }
        let Window { first, end } = self.window;
        let range = |axis: usize| {
            let (lo, hi) = (
                a[axis].min(b[axis]).min(c[axis]),
                a[axis].max(b[axis]).max(c[axis]),
            );
            // Pixel centres are at halves; the casts saturate at the borders.
            let lowest = (lo - 0.5).ceil().max(0.0) as usize;
            let after = ((hi - 0.5).floor() + 1.0).max(0.0) as usize;
            lowest.max(first[axis])..after.min(end[axis])
        };
        let farthest = 1.0 / self.camera.far;
        let turn = area.signum();
        let columns = range(0);
        for row in range(1) {
            let y = row as f64 + 0.5;
            for column in inside([a, b, c], turn, columns.clone(), y) {
                let x = column as f64 + 0.5;
                let (at_a, at_b, at_c) = (cross(b, c, x, y), cross(c, a, x, y), cross(a, b, x, y));
                let inverse = at_a / area * a[2] + at_b / area * b[2] + at_c / area * c[2];
                // Rows and columns were clipped to the window above.
                let pixel = (row - first[1]) * (end[0] - first[0]) + column - first[0];
                if inverse > self.inverse_depth[pixel] && inverse >= farthest {
                    self.inverse_depth[pixel] = inverse;
                    self.keys[pixel] = Some(key);
                }
            }
        }
    }
}

/// The columns, of some, whose middles at a height `y` are in a triangle; `turn` is the sign of its area.
/// On which side of an edge a middle is changes at most once along a row, also after rounding, so each end
/// can be searched for.
fn inside(corners: [[f64; 3]; 3], turn: f64, columns: Range<usize>, y: f64) -> Range<usize> {
    let [a, b, c] = corners;
    let mut run = columns;
    for (from, to) in [(b, c), (c, a), (a, b)] {
        let is_inside = |column: usize| cross(from, to, column as f64 + 0.5, y) * turn >= 0.0;
        if (to[1] - from[1]) * turn > 0.0 {
            run.end = first_of(run.clone(), |column| !is_inside(column));
        } else {
            run.start = first_of(run.clone(), is_inside);
        }
    }
    run
}

/// The first of some columns from which on a condition holds; the end if it holds nowhere.
fn first_of(columns: Range<usize>, holds: impl Fn(usize) -> bool) -> usize {
    let Range { mut start, mut end } = columns;
    while start < end {
        let middle = start + (end - start) / 2;
        if holds(middle) {
            end = middle;
        } else {
            start = middle + 1;
        }
    }
    start
}

/// Twice the signed area of the triangle of `a`, `b` and the point (x, y) in the picture.
fn cross(a: [f64; 3], b: [f64; 3], x: f64, y: f64) -> f64 {
    (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
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
