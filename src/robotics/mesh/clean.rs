//! Makes sound triangles of what files hold: finite, with area, with shared corners, in metres.

use std::collections::HashMap;

use super::part::MeshPart;
use spatial::Polyhedron;

/// Meshes with more triangles are refused.
pub(super) const MAX_TRIANGLES: usize = 500_000;

/// Coordinates beyond this (m) are refused, as those of other shapes are.
const FARTHEST: f64 = 1e4;

/// Says that there are too many triangles.
pub(super) fn too_many(count: usize) -> String {
    format!("the mesh has {count} triangles or more; simplify it to {MAX_TRIANGLES} at most")
}

/// The parts with their coordinates multiplied by a scale for each axis, without triangles that have no
/// area or a corner that is nowhere. A scale that mirrors turns the triangles round.
pub(super) fn cleaned(parts: Vec<MeshPart>, scale: [f64; 3]) -> Result<Vec<MeshPart>, String> {
    let is_mirrored = scale.iter().filter(|s| **s < 0.0).count() % 2 == 1;
    let mut clean = Vec::with_capacity(parts.len());
    let mut count = 0;
    for part in parts {
        let surface = welded(&part.surface, scale, is_mirrored)?;
        count += surface.triangles.len();
        if count > MAX_TRIANGLES {
            return Err(too_many(count));
        }
        if !surface.triangles.is_empty() {
            clean.push(MeshPart {
                surface,
                color: part.color,
            });
        }
    }
    match clean.is_empty() {
        true => Err("the mesh has no triangle with an area".to_owned()),
        false => Ok(clean),
    }
}

/// Equal corners become one.
fn welded(surface: &Polyhedron, scale: [f64; 3], is_mirrored: bool) -> Result<Polyhedron, String> {
    let mut clean = Polyhedron::default();
    let mut places: HashMap<[u64; 3], u32> = HashMap::with_capacity(surface.corners.len() / 3);
    let mut place_of: Vec<Option<u32>> = Vec::with_capacity(surface.corners.len());
    for corner in &surface.corners {
        // Adding 0 makes one of the two zeros.
        let corner = [0, 1, 2].map(|axis| corner[axis] * scale[axis] + 0.0);
        if corner.iter().any(|x| x.abs() > FARTHEST && x.is_finite()) {
            return Err(format!(
                "a corner is farther than {FARTHEST:.0} m from the origin; expected metres, or a scale"
            ));
        }
        let is_somewhere = corner.iter().all(|x| x.is_finite());
        place_of.push(is_somewhere.then(|| {
            *places.entry(corner.map(f64::to_bits)).or_insert_with(|| {
                clean.corners.push(corner);
                clean.corners.len() as u32 - 1
            })
        }));
    }
    let place = |i: u32| place_of.get(i as usize).copied().flatten();
    for triangle in &surface.triangles {
        let [Some(a), Some(b), Some(c)] = triangle.map(place) else {
            continue;
        };
        let triangle = if is_mirrored { [a, c, b] } else { [a, b, c] };
        if has_area(clean.triangle(triangle)) {
            clean.triangles.push(triangle);
        }
    }
    Ok(clean)
}

fn has_area([a, b, c]: [[f64; 3]; 3]) -> bool {
    let minus = |p: [f64; 3], q: [f64; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    let (u, v) = (minus(b, a), minus(c, a));
    let cross = [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ];
    cross.iter().map(|x| x * x).sum::<f64>() > 1e-24
}
