//! How far a convex body bulges out of the surface that it stands for.

use parry3d_f64::math::Vector;
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::{TriMesh, TriMeshBuilderError};

use spatial::Polyhedron;

/// So many points of a body are measured, about.
const SAMPLES: f64 = 300.0;

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

    /// Distances (m) from points spread over a body to the surface, shortest first.
    pub(super) fn bulges(&self, body: &Polyhedron) -> Vec<f64> {
        let corners = vectors(body);
        let areas = body.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|i| corners[i as usize]);
            (b - a).cross(c - a).length() / 2.0
        });
        let areas: Vec<f64> = areas.collect();
        let whole: f64 = areas.iter().sum();
        let mut distances = Vec::new();
        // What the triangles before had too few points for.
        let mut owed = 0.0;
        for (triangle, area) in body.triangles.iter().zip(areas) {
            let [a, b, c] = triangle.map(|i| corners[i as usize]);
            owed += SAMPLES * area / whole.max(1e-12);
            let mut number = 0u32;
            while owed >= 1.0 {
                owed -= 1.0;
                number += 1;
                // Points of a sequence that fills a square evenly, folded into the triangle.
                let mut u = (f64::from(number) * 0.754_877_666_246_692_8).fract();
                let mut v = (f64::from(number) * 0.569_840_290_998_053_3).fract();
                if u + v > 1.0 {
                    (u, v) = (1.0 - u, 1.0 - v);
                }
                let point = a + (b - a) * u + (c - a) * v;
                distances.push(self.mesh.distance_to_local_point(point, true));
            }
        }
        distances.sort_by(f64::total_cmp);
        distances
    }
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
