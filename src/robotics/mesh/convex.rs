//! How far a convex body bulges out of the surface that it stands for.

use parry3d_f64::math::Vector;
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::{TriMesh, TriMeshBuilderError};

use spatial::Polyhedron;

/// So many points of bodies are measured, about.
const SAMPLES: f64 = 600.0;

/// Bodies closer than this (m) touch.
const TOUCH: f64 = 1e-3;

/// A surface to which distances are measured.
pub(super) struct Measured {
    mesh: TriMesh,
}

impl Measured {
    /// Prepares a surface, which has triangles.
    pub(super) fn new(surface: &Polyhedron) -> Result<Self, TriMeshBuilderError> {
        let mesh = TriMesh::new(vectors(surface), surface.triangles.clone())?;
        Ok(Self { mesh })
    }

    /// Distances (m) from points spread over bodies to the surface, shortest first. Points where bodies
    /// touch are inside all of them together, and do not count.
    pub(super) fn bulges(&self, bodies: &[Polyhedron]) -> Vec<f64> {
        let whole: f64 = bodies.iter().map(area).sum();
        let mut distances = Vec::new();
        // What the triangles before had too few points for.
        let mut owed = 0.0;
        for (place, body) in bodies.iter().enumerate() {
            let others = bodies.iter().enumerate();
            let others = others.filter(|(other, _)| *other != place);
            let others: Vec<_> = others.map(|(_, other)| other).collect();
            for triangle in &body.triangles {
                let corners = body.triangle(*triangle);
                owed += SAMPLES * area_of(corners) / whole.max(1e-12);
                self.add(corners, &mut owed, &others, &mut distances);
            }
        }
        distances.sort_by(f64::total_cmp);
        distances
    }

    /// Adds the distances from as many points of a triangle as are owed.
    fn add(
        &self,
        corners: [[f64; 3]; 3],
        owed: &mut f64,
        others: &[&Polyhedron],
        distances: &mut Vec<f64>,
    ) {
        let [a, b, c] = corners.map(Vector::from_array);
        let outward = (b - a).cross(c - a).normalize_or_zero();
        let mut number = 0u32;
        while *owed >= 1.0 {
            *owed -= 1.0;
            number += 1;
            // Points of a sequence that fills a square evenly, folded into the triangle.
            let mut u = (f64::from(number) * 0.754_877_666_246_692_8).fract();
            let mut v = (f64::from(number) * 0.569_840_290_998_053_3).fract();
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            let point = a + (b - a) * u + (c - a) * v;
            let ahead = (point + outward * TOUCH).to_array();
            if !others.iter().any(|other| other.convex_contains(ahead)) {
                distances.push(self.mesh.distance_to_local_point(point, true));
            }
        }
    }
}

/// Area (m²) of a body's surface.
fn area(body: &Polyhedron) -> f64 {
    body.triangles
        .iter()
        .map(|triangle| area_of(body.triangle(*triangle)))
        .sum()
}

fn area_of(corners: [[f64; 3]; 3]) -> f64 {
    let [a, b, c] = corners.map(Vector::from_array);
    (b - a).cross(c - a).length() / 2.0
}

/// The value below which a share of them lies; they are in order.
pub(super) fn quantile(values: &[f64], share: f64) -> f64 {
    let place = (values.len() as f64 * share) as usize;
    let place = place.min(values.len().saturating_sub(1));
    values.get(place).copied().unwrap_or(0.0)
}

/// The corners in the form of the library.
pub(super) fn vectors(surface: &Polyhedron) -> Vec<Vector> {
    let corners = surface.corners.iter();
    corners.map(|[x, y, z]| Vector::new(*x, *y, *z)).collect()
}
