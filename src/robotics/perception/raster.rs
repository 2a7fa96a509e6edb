//! Which pixels show a triangle, and how far away it is there.

use std::ops::Range;

use nalgebra::{Point3, Vector3};

use super::camera::Camera;
use super::mesh::Mesh;
use super::window::Window;
use spatial::Pose;

/// A corner in the camera's frame.
type Corner = Vector3<f64>;

/// By which part an inverse depth between those of three corners may be beyond them by rounding.
const ROUNDING: f64 = 1e-9;

/// A triangle in the picture.
pub(super) struct Facet {
    /// Columns, rows and inverse depths (1/m) of the corners, all of which are linear in the picture.
    corners: [[f64; 3]; 3],
    area: f64,
}

impl Facet {
    /// The triangle with corners that lie beyond the near plane, in the camera's frame; none if it is seen
    /// from its edge.
    fn new(camera: &Camera, corners: [Corner; 3]) -> Option<Self> {
        let f = camera.focal_length();
        let centre = [camera.width as f64 / 2.0, camera.height as f64 / 2.0];
        let corners = corners.map(|p| {
            [
                centre[0] + f * p.x / p.z,
                centre[1] + f * p.y / p.z,
                1.0 / p.z,
            ]
        });
        let [a, b, c] = corners;
        let area = cross(a, b, c[0], c[1]);
        (area != 0.0).then_some(Self { corners, area })
    }

    /// The inverse of the depth (1/m) at the middle of a pixel.
    pub(super) fn inverse_depth(&self, column: usize, row: usize) -> f64 {
        let [a, b, c] = self.corners;
        let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
        let (at_a, at_b, at_c) = (cross(b, c, x, y), cross(c, a, x, y), cross(a, b, x, y));
        at_a / self.area * a[2] + at_b / self.area * b[2] + at_c / self.area * c[2]
    }

    /// The least and the greatest inverse depth (1/m) on the triangle, with room for rounding.
    pub(super) fn bounds(&self) -> [f64; 2] {
        let [a, b, c] = self.corners.map(|corner| corner[2]);
        let (least, most) = (a.min(b).min(c), a.max(b).max(c));
        [least * (1.0 - ROUNDING), most * (1.0 + ROUNDING)]
    }

    /// Rows of the window and the columns whose middles are in the triangle.
    fn each_row(&self, window: &Window, mut draw: impl FnMut(&Self, usize, Range<usize>)) {
        let [a, b, c] = self.corners;
        let range = |axis: usize| {
            let (lo, hi) = (
                a[axis].min(b[axis]).min(c[axis]),
                a[axis].max(b[axis]).max(c[axis]),
            );
            // Pixel centres are at halves; the casts saturate at the borders.
            let lowest = (lo - 0.5).ceil().max(0.0) as usize;
            let after = ((hi - 0.5).floor() + 1.0).max(0.0) as usize;
            lowest.max(window.first[axis])..after.min(window.end[axis])
        };
        let (columns, rows) = (range(0), range(1));
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        let edges = [(b, c), (c, a), (a, b)].map(|ends| Edge::new(ends, self.area));
        for row in rows {
            let mut inside = columns.clone();
            edges.iter().for_each(|edge| edge.clip(&mut inside, row));
            if !inside.is_empty() {
                draw(self, row, inside);
            }
        }
    }
}

/// An edge of a triangle.
struct Edge {
    from: [f64; 3],
    to: [f64; 3],
    /// The sign of the triangle's area.
    turn: f64,
    /// Columns per row along the edge.
    slope: f64,
    /// Whether the triangle lies on the side of the lower columns.
    ends_row: bool,
}

impl Edge {
    fn new((from, to): ([f64; 3], [f64; 3]), area: f64) -> Self {
        let turn = area.signum();
        let rows = to[1] - from[1];
        Self {
            from,
            to,
            turn,
            slope: (to[0] - from[0]) / rows,
            ends_row: rows * turn > 0.0,
        }
    }

    /// Whether the middle of a pixel is on the triangle's side.
    fn is_inside(&self, column: usize, row: usize) -> bool {
        let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
        cross(self.from, self.to, x, y) * self.turn >= 0.0
    }

    /// Keeps the columns of a row whose middles are on the triangle's side. On which side one is changes at
    /// most once along a row, also after rounding: the search begins where the edge should cross the row, and
    /// ends where it does.
    fn clip(&self, columns: &mut Range<usize>, row: usize) {
        let Range { start, end } = *columns;
        let crossing = self.from[0] + self.slope * (row as f64 + 0.5 - self.from[1]) - 0.5;
        // The cast saturates, and has a number for the crossing of a level edge, too.
        let mut first = (crossing as usize).clamp(start, end.max(start));
        let is_beyond = |column| self.is_inside(column, row) != self.ends_row;
        while first > start && is_beyond(first - 1) {
            first -= 1;
        }
        while first < end && !is_beyond(first) {
            first += 1;
        }
        if self.ends_row {
            columns.end = first;
        } else {
            columns.start = first;
        }
    }
}

/// Calls a function with each row of a window, and the columns in it, that shows a triangle of a surface at
/// a pose (map frame) from outside, beyond the near plane. What is beyond the far plane is left to the
/// function, but if the whole surface is.
pub(super) fn each_row(
    camera: &Camera,
    window: &Window,
    pose: &Pose,
    mesh: &Mesh,
    mut draw: impl FnMut(&Facet, usize, Range<usize>),
) {
    let to_camera = camera.pose.inverse() * pose;
    let corners: Vec<Corner> = mesh
        .corners
        .iter()
        .map(|p: &Point3<f64>| (to_camera * p).coords)
        .collect();
    if corners.iter().all(|c| c.z < camera.near) || corners.iter().all(|c| c.z > camera.far) {
        return;
    }
    for triangle in &mesh.triangles {
        // A mesh's triangles are indices into its own list of corners.
        let [a, b, c] = triangle.map(|i| corners[i as usize]);
        let outward = (b - a).cross(&(c - a));
        if outward.dot(&a) < 0.0 {
            for facet in clipped(camera, [a, b, c]).into_iter().flatten() {
                facet.each_row(window, &mut draw);
            }
        }
    }
}

/// The part of a triangle beyond the near plane: at most two triangles, since a plane clips one to at most
/// four corners.
fn clipped(camera: &Camera, corners: [Corner; 3]) -> [Option<Facet>; 2] {
    let near = camera.near;
    if corners.iter().all(|c| c.z >= near) {
        return [Facet::new(camera, corners), None];
    }
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
    let fan = |i: usize| {
        (i < count)
            .then(|| Facet::new(camera, [kept[0], kept[i - 1], kept[i]]))
            .flatten()
    };
    [fan(2), fan(3)]
}

/// Twice the signed area of the triangle of `a`, `b` and the point (x, y) in the picture.
fn cross(a: [f64; 3], b: [f64; 3], x: f64, y: f64) -> f64 {
    (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
}
