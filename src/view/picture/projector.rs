//! Triangles as a camera sees them.

use nalgebra::{Matrix3, Vector3};

use super::facet::{self, Mesh};
use super::raster::{Corner, Patch, twice_area};
use robotics::perception::camera::Camera;

/// Samples per pixel, along rows and columns.
pub(crate) const SAMPLES: usize = 2;

/// A triangle, or the part of it in front of the camera, in the grid of samples.
pub(super) struct Seen {
    pub(crate) patch: Patch,
    /// What gives the weight of each corner at a column and row of the grid: factors of these,
    /// and what is added.
    weights: [[f64; 3]; 3],
    points: [Vector3<f32>; 3],
    normals: [Vector3<f32>; 3],
    /// Whether the normal is the same everywhere.
    pub(crate) is_flat: bool,
    /// Index of the first of the triangles next to one another in this plane, this one among them.
    pub(crate) face: u32,
    /// Unit vector away from the solid.
    outward: Vector3<f32>,
    pub body: usize,
}

/// How far (m) from one plane the triangles of a face may be.
const LEVEL: f32 = 1e-4;

/// Cosine of the greatest bend across which a surface counts as one.
const GENTLE: f32 = 0.97;

impl Seen {
    /// Whether the other triangle belongs to the same, hardly bent part of a body.
    pub(super) fn continues(&self, other: &Self) -> bool {
        self.body == other.body && self.outward.dot(&other.outward) > GENTLE
    }

    /// Whether a triangle of the same body, also flat, lies in the same plane.
    fn is_level_with(&self, other: &Self) -> bool {
        let normal = self.normals[0];
        self.is_flat
            && other.is_flat
            && self.body == other.body
            && normal == other.normals[0]
            && normal.dot(&(other.points[0] - self.points[0])).abs() < LEVEL
    }

    /// Position (m, map frame) and normal of what is seen at the column and row of the grid; on a
    /// flat triangle, also outside it.
    pub(super) fn at(&self, x: f64, y: f64) -> (Vector3<f32>, Vector3<f32>) {
        let mix = |v: &[Vector3<f32>; 3], weights: [f32; 3]| {
            v[0] * weights[0] + v[1] * weights[1] + v[2] * weights[2]
        };
        let weights = self.weights.map(|[a, b, c]| a * x + b * y + c);
        let sum = weights[0] + weights[1] + weights[2];
        if self.is_flat && sum > 0.0 {
            let per_sum = 1.0 / sum;
            let weights = weights.map(|w| (w * per_sum) as f32);
            return (mix(&self.points, weights), self.normals[0]);
        }
        let weights = weights.map(|w| w.max(0.0));
        let sum = weights[0] + weights[1] + weights[2];
        let weights = if sum > 0.0 {
            let per_sum = 1.0 / sum;
            weights.map(|w| (w * per_sum) as f32)
        } else {
            [1.0 / 3.0; 3]
        };
        let normal = mix(&self.normals, weights);
        let normal = normal.try_normalize(1e-6).unwrap_or(self.normals[0]);
        (mix(&self.points, weights), normal)
    }

    /// The plane of a flat triangle.
    pub(crate) fn plane(&self) -> Plane {
        let factors = |i: usize| {
            let sum = self.weights.iter().map(|weights| weights[i]).sum();
            let points = self.points.iter().zip(self.weights);
            let point = points.map(|(point, weights)| point.cast() * weights[i]);
            (point.sum(), sum)
        };
        Plane {
            factors: [factors(0), factors(1), factors(2)],
            normal: self.normals[0],
        }
    }
}

/// A plane as a camera sees it.
pub(crate) struct Plane {
    /// What gives positions, times a nearness, and this nearness at a column and row of the grid:
    /// factors of these, and what is added.
    factors: [(Vector3<f64>, f64); 3],
    /// Its unit normal.
    pub normal: Vector3<f32>,
}

impl Plane {
    /// The position (m, map frame) at the column and row of the grid; `None` at the horizon and
    /// beyond it.
    pub(super) fn at(&self, x: f64, y: f64) -> Option<Vector3<f32>> {
        let [across, down, start] = &self.factors;
        let nearness = across.1 * x + down.1 * y + start.1;
        let point = across.0 * x + down.0 * y + start.0;
        (nearness > 0.0).then(|| (point * (1.0 / nearness)).cast())
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
    pub eye: Vector3<f64>,
    to_camera: Matrix3<f64>,
    near: f64,
    /// Distance of the picture plane (samples).
    pub(crate) focal: f64,
    pub width: usize,
    pub height: usize,
}

impl Projector {
    pub(super) fn new(camera: &Camera) -> Self {
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
    pub(crate) fn project(&self, mesh: Mesh<'_>) -> Vec<Seen> {
        let camera = |corner: &facet::Corner| self.to_camera * (corner.point - self.eye);
        let places: Vec<_> = mesh.corners.iter().map(camera).collect();
        let mut seen = Vec::with_capacity(mesh.facets.len() / 2);
        for facet in mesh.facets {
            // The corners of a mesh are all there.
            let [a, b, c] = facet.corners.map(|i| places[i as usize]);
            if (b - a).cross(&(c - a)).dot(&a) < 0.0 {
                let vertex = |i: usize| {
                    let corner = &mesh.corners[facet.corners[i] as usize];
                    Vertex {
                        camera: [a, b, c][i],
                        point: corner.point,
                        normal: corner.normal,
                    }
                };
                self.project_one([vertex(0), vertex(1), vertex(2)], facet.body, &mut seen);
            }
        }
        seen
    }

    fn project_one(&self, corners: [Vertex; 3], body: usize, seen: &mut Vec<Seen>) {
        let is_near = |v: &Vertex| v.camera.z < self.near;
        if corners.iter().all(is_near) {
            return;
        }
        if !corners.iter().any(is_near) {
            self.add(corners, body, seen);
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
            self.add([kept[0], pair[0], pair[1]], body, seen);
        }
    }

    /// Adds a triangle in front of the camera, if it covers any place of the grid.
    fn add(&self, vertices: [Vertex; 3], body: usize, seen: &mut Vec<Seen>) {
        if let Some(mut new) = self.patch(vertices, body) {
            let last = seen.last().filter(|last| last.is_level_with(&new));
            // Four billion triangles do not fit into memory.
            let own = u32::try_from(seen.len()).unwrap_or(u32::MAX);
            new.face = last.map_or(own, |last| last.face);
            seen.push(new);
        }
    }

    fn patch(&self, vertices: [Vertex; 3], body: usize) -> Option<Seen> {
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
        let [p, q, r] = vertices.map(|v| v.point);
        let outward = (q - p).cross(&(r - p)).try_normalize(1e-15)?;
        Some(Seen {
            patch,
            weights: [weight(b, c, a), weight(c, a, b), weight(a, b, c)],
            points: vertices.map(|v| v.point.cast()),
            normals: vertices.map(|v| v.normal.cast()),
            is_flat: vertices.iter().all(|v| v.normal == vertices[0].normal),
            face: 0,
            outward: outward.cast(),
            body,
        })
    }
}
