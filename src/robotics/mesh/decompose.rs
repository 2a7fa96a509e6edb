//! Convex bodies in place of a surface.
//!
//! Each connected part of a surface is one body if its hull bulges little; otherwise it is taken apart.
//! The library that does it numbers what it finds in the order of the input, and its arithmetic is that of
//! the program, so the same surface always gives the same bits.

use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};
use parry3d_f64::transformation::voxelization::FillMode;

use super::convex::{Measured, quantile, vectors};
use super::hull::{hull, volume};
use super::part::MeshPart;
use super::split::connected;
use spatial::Polyhedron;

/// A hull of which 95 % of the points bulge less (m) is good enough.
const SMALL_BULGE: f64 = 5e-3;

/// Bodies of which 95 % of the points bulge more (m) are taken apart once more.
const LARGE_BULGE: f64 = 9e-3;

/// A mesh with more connected parts than this is taken apart as a whole.
const MAX_PARTS: usize = 200;

/// Surfaces with more triangles than this are not taken apart.
pub(super) const MAX_SOLID_TRIANGLES: usize = 200_000;

/// The edge of the cells in which a surface is taken apart (m), and the numbers of cells along its
/// longest side between which that is kept.
const CELL: f64 = 4e-3;
const CELLS: [f64; 2] = [32.0, 96.0];

/// The convex bodies that stand for the parts of a mesh, the largest first.
pub(super) fn bodies(parts: &[MeshPart]) -> Result<Vec<Polyhedron>, String> {
    let count: usize = parts.iter().map(|part| part.surface.triangles.len()).sum();
    if count > MAX_SOLID_TRIANGLES {
        return Err(format!(
            "the mesh has {count} triangles; simplify what things collide with to \
             {MAX_SOLID_TRIANGLES} at most"
        ));
    }
    let mut found = Vec::new();
    for part in parts {
        found.extend(bodies_of(&part.surface));
    }
    if found.is_empty() {
        return Err("the mesh has no volume".to_owned());
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut kept: Vec<Polyhedron> = Vec::with_capacity(found.len());
    for (_, body) in found {
        // What is inside another body changes nothing.
        let is_inside = |outer: &Polyhedron| {
            body.corners.iter().all(|corner| outer.convex_contains(*corner))
        };
        if kept.iter().take(64).all(|outer| !is_inside(outer)) {
            kept.push(body);
        }
    }
    Ok(kept)
}

/// Convex bodies in place of a surface, with their volumes.
fn bodies_of(surface: &Polyhedron) -> Vec<(f64, Polyhedron)> {
    let mut parts = connected(surface);
    if parts.len() > MAX_PARTS {
        parts = vec![surface.clone()];
    }
    let bodies = parts.iter().flat_map(|part| {
        let Some(whole) = hull(&part.corners) else {
            return Vec::new();
        };
        let Ok(measured) = Measured::new(part) else {
            return vec![whole];
        };
        if quantile(&measured.bulges(&whole), 0.95) <= SMALL_BULGE {
            return vec![whole];
        }
        apart(part, &measured).unwrap_or_else(|| vec![whole])
    });
    bodies.map(|body| (volume(&body), body)).collect()
}

/// The bodies that a surface is taken apart into; `None` if that is not possible.
fn apart(surface: &Polyhedron, measured: &Measured) -> Option<Vec<Polyhedron>> {
    let [low, high] = surface.bounds()?;
    let longest = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
    let cells = (longest / CELL).clamp(CELLS[0], CELLS[1]);
    let rough = taken_apart(surface, cells, 0.01, 16)?;
    let bulge = |bodies: &[Polyhedron]| {
        let mut all: Vec<f64> = bodies.iter().flat_map(|body| measured.bulges(body)).collect();
        all.sort_by(f64::total_cmp);
        quantile(&all, 0.95)
    };
    let first = bulge(&rough);
    if first <= LARGE_BULGE {
        return Some(rough);
    }
    match taken_apart(surface, cells.max(64.0), 0.002, 48) {
        Some(fine) if bulge(&fine) < first => Some(fine),
        _ => Some(rough),
    }
}

fn taken_apart(
    surface: &Polyhedron,
    cells: f64,
    concavity: f64,
    most: u32,
) -> Option<Vec<Polyhedron>> {
    let parameters = VHACDParameters {
        concavity,
        resolution: cells as u32,
        max_convex_hulls: most,
        fill_mode: FillMode::FloodFill {
            detect_cavities: false,
        },
        ..VHACDParameters::default()
    };
    let corners = vectors(surface);
    let found = VHACD::decompose(&parameters, &corners, &surface.triangles, true);
    let mut bodies = Vec::new();
    for part in found.voxel_parts() {
        let points = part.compute_primitive_intersections(&corners, &surface.triangles);
        let points: Vec<[f64; 3]> = points.iter().map(|p| [p.x, p.y, p.z]).collect();
        bodies.extend(hull(&points));
    }
    (!bodies.is_empty()).then_some(bodies)
}
