//! Triangles as a camera sees them.

use nalgebra::{Matrix3, Vector3};

use super::facet::Facet;
use super::raster::{Corner, Patch, twice_area};
use crate::perception::camera::Camera;

/// Samples per pixel, along rows and columns.
pub(crate) const SAMPLES: usize = 2;

/// A triangle, or the part of it in front of the camera, in the grid of samples.
pub(crate) struct Seen {
    pub(crate) patch: Patch,
    /// What gives the weight of each corner at a column and row of the grid: factors of these,
    /// and what is added.
    weights: [[f64; 3]; 3],
    points: [Vector3<f32>; 3],
    normals: [Vector3<f32>; 3],
    /// Whether the normal is the same everywhere.
    pub(crate) is_flat: bool,
    /// Unit vector away from the solid.
    outward: Vector3<f32>,
    pub(crate) body: usize,
}

/// Cosine of the greatest bend across which a surface counts as one.
const GENTLE: f32 = 0.97;

impl Seen {
    /// Whether the other triangle belongs to the same, hardly bent part of a body.
    pub(crate) fn continues(&self, other: &Self) -> bool {
        self.body == other.body && self.outward.dot(&other.outward) > GENTLE
    }

    /// Position (m, map frame) and normal of what is seen at the column and row of the grid.
    pub(crate) fn at(&self, x: f64, y: f64) -> (Vector3<f32>, Vector3<f32>) {
        let weights = self.weights.map(|[a, b, c]| (a * x + b * y + c).max(0.0));
        let sum = weights[0] + weights[1] + weights[2];
        let weights = if sum > 0.0 {
            let per_sum = 1.0 / sum;
            weights.map(|w| (w * per_sum) as f32)
        } else {
            [1.0 / 3.0; 3]
        };
        let mix = |v: &[Vector3<f32>; 3]| v[0] * weights[0] + v[1] * weights[1] + v[2] * weights[2];
        let normal = mix(&self.normals);
        let normal = normal.try_normalize(1e-6).unwrap_or(self.normals[0]);
        (mix(&self.points), normal)
    }
}

/// A corner being projected.
#[derive(Clone, Copy)]
struct Vertex {
    camera: Vector3<f64>,
    point: Vector3<f64>,
    normal: Vector3<f64>,
}

/// Projects onto the grid of samples of a camera's picture.
pub(crate) struct Projector {
    pub(crate) eye: Vector3<f64>,
    to_camera: Matrix3<f64>,
    near: f64,
    /// Distance of the picture plane (samples).
    pub(crate) focal: f64,
    pub(crate) width: usize,
    pub(crate) height: usize,
}

impl Projector {
    pub(crate) fn new(camera: &Camera) -> Self {
        let rotation = camera.pose.rotation.inverse();
        Self {
            eye: camera.pose.translation.vector,
            to_camera: *rotation.to_rotation_matrix().matrix(),
            near: camera.near.max(1e-3),
            focal: camera.focal_length() * SAMPLES as f64,
            width: camera.width * SAMPLES,
            height: camera.height * SAMPLES,
        }
    }

    /// Direction (map frame, not normalised) in which the place of the grid looks.
    pub(crate) fn ray(&self, x: f64, y: f64) -> Vector3<f64> {
        let across = (x - self.width as f64 / 2.0) / self.focal;
        let down = (y - self.height as f64 / 2.0) / self.focal;
        self.to_camera.tr_mul(&Vector3::new(across, down, 1.0))
    }

    /// The parts of the triangles that may be visible, in order.
    pub(crate) fn project(&self, facets: &[Facet]) -> Vec<Seen> {
        let mut seen = Vec::with_capacity(facets.len() / 2);
        for facet in facets {
            if facet.outward.dot(&(facet.points[0] - self.eye)) < 0.0 {
                self.project_one(facet, &mut seen);
            }
        }
        seen
    }

    fn project_one(&self, facet: &Facet, seen: &mut Vec<Seen>) {
        let vertex = |i: usize| Vertex {
            camera: self.to_camera * (facet.points[i] - self.eye),
            point: facet.points[i],
            normal: facet.normals[i],
        };
        let corners = [vertex(0), vertex(1), vertex(2)];
        let is_near = |v: &Vertex| v.camera.z < self.near;
        if corners.iter().all(is_near) {
            return;
        }
        if !corners.iter().any(is_near) {
            seen.extend(self.patch(corners, facet));
            return;
        }
        // A plane clips a triangle to at most four corners.
        let mut kept = Vec::with_capacity(4);
        for i in 0..3 {
            let (from, to) = (corners[i], corners[(i + 1) % 3]);
            if !is_near(&from) {
                kept.push(from);
            }
            if is_near(&from) != is_near(&to) {
                let share = (self.near - from.camera.z) / (to.camera.z - from.camera.z);
                let mix = |a: Vector3<f64>, b: Vector3<f64>| a + (b - a) * share;
                kept.push(Vertex {
                    camera: mix(from.camera, to.camera),
                    point: mix(from.point, to.point),
                    normal: mix(from.normal, to.normal),
                });
            }
        }
        for pair in kept.windows(2).skip(1) {
            seen.extend(self.patch([kept[0], pair[0], pair[1]], facet));
        }
    }

    fn patch(&self, vertices: [Vertex; 3], facet: &Facet) -> Option<Seen> {
        let corners = vertices.map(|v| {
            [
                self.width as f64 / 2.0 + self.focal * v.camera.x / v.camera.z,
                self.height as f64 / 2.0 + self.focal * v.camera.y / v.camera.z,
                1.0 / v.camera.z,
            ]
        });
        let patch = Patch::new(corners, self.width, self.height)?;
        let [a, b, c] = corners;
        // A patch has a positive area.
        let per_area = 1.0 / twice_area(a, b, c);
        // The share of the triangle's area that is opposite to a corner, by the corner's
        // nearness: the nearer one counts more than its share of the picture.
        let weight = |one: Corner, two: Corner, corner: Corner| {
            let (across, down) = (two[0] - one[0], two[1] - one[1]);
            [-down, across, down * one[0] - across * one[1]].map(|v| v * per_area * corner[2])
        };
        Some(Seen {
            patch,
            weights: [weight(b, c, a), weight(c, a, b), weight(a, b, c)],
            points: vertices.map(|v| v.point.cast()),
            normals: vertices.map(|v| v.normal.cast()),
            is_flat: facet
                .normals
                .iter()
                .all(|normal| *normal == facet.normals[0]),
            outward: facet.outward.cast(),
            body: facet.body,
        })
    }
}
