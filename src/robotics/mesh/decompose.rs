//! Convex bodies in place of a surface.
//!
//! Each connected part of a surface is one body if its hull bulges little; otherwise it is taken apart.
//! The library that does it numbers what it finds in the order of the input, and its arithmetic is that of
//! the program, so the same surface always gives the same bits.

use defect::caught;
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

/// So many connected parts are taken apart one by one, the rest together.
const MAX_APART: usize = 6;

/// Against so many bodies it is looked whether something is inside them.
const MAX_COMPARED: usize = 64;

/// Smaller parts (m) are not taken apart.
const SMALL: f64 = 0.02;

/// Surfaces with more triangles than this are not taken apart.
pub(super) const MAX_SOLID_TRIANGLES: usize = 200_000;

/// The edge of the cells in which a surface is taken apart (m), and the numbers of cells along its
/// longest side between which that is kept.
const CELL: f64 = 4e-3;
const CELLS: [f64; 2] = [32.0, 64.0];

/// So many numbers of cells are tried, one after another, if the library fails.
const TRIES: usize = 4;

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
            body.corners
                .iter()
                .all(|corner| outer.convex_contains(*corner))
        };
        if kept
            .iter()
            .take(MAX_COMPARED)
            .all(|outer| !is_inside(outer))
        {
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
    let hulls = parts.into_iter().filter_map(|part| {
        let hull = hull(&part.corners)?;
        Some((volume(&hull), hull, part))
    });
    let mut hulls: Vec<_> = hulls.collect();
    hulls.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut bodies: Vec<Polyhedron> = Vec::new();
    let mut apart_before = 0;
    let mut rest = Polyhedron::default();
    for (_, hull, part) in hulls {
        // Screws in a housing, say.
        let is_in = |body: &Polyhedron| {
            part.corners
                .iter()
                .all(|corner| body.convex_contains(*corner))
        };
        if bodies.iter().take(MAX_COMPARED).any(is_in) {
            continue;
        }
        let measured = match is_small(&part) {
            true => None,
            false => Measured::new(&part).ok(),
        };
        let whole = [hull];
        let measured = measured.filter(|measured| bulge(&whole, measured) > SMALL_BULGE);
        let [hull] = whole;
        match measured {
            None => bodies.push(hull),
            Some(measured) if apart_before < MAX_APART => {
                apart_before += 1;
                bodies.extend(apart(&part, &measured).unwrap_or_else(|| vec![hull]));
            }
            Some(_) => add(&mut rest, &part),
        }
    }
    if let Ok(measured) = Measured::new(&rest) {
        let hull = hull(&rest.corners);
        bodies.extend(apart(&rest, &measured).unwrap_or_else(|| hull.into_iter().collect()));
    }
    bodies
        .into_iter()
        .map(|body| (volume(&body), body))
        .collect()
}

/// Whether a part is so small that its hull cannot bulge much.
fn is_small(part: &Polyhedron) -> bool {
    let bounds = part.bounds();
    bounds.is_none_or(|[low, high]| (0..3).all(|axis| high[axis] - low[axis] < SMALL))
}

/// Adds the triangles of a part to a surface.
fn add(surface: &mut Polyhedron, part: &Polyhedron) {
    let first = surface.corners.len() as u32;
    surface.corners.extend(&part.corners);
    let triangles = part.triangles.iter();
    surface
        .triangles
        .extend(triangles.map(|triangle| triangle.map(|corner| corner + first)));
}

/// The bodies that a surface is taken apart into; `None` if that is not possible.
fn apart(surface: &Polyhedron, measured: &Measured) -> Option<Vec<Polyhedron>> {
    let [low, high] = surface.bounds()?;
    let longest = (0..3)
        .map(|axis| high[axis] - low[axis])
        .fold(0.0, f64::max);
    let cells = (longest / CELL).clamp(CELLS[0], CELLS[1]);
    let rough = taken_apart(surface, cells, 0.01, 16)?;
    let first = bulge(&rough, measured);
    if first <= LARGE_BULGE {
        return Some(rough);
    }
    match taken_apart(surface, (cells * 1.5).max(CELLS[1]), 0.003, 40) {
        Some(fine) if bulge(&fine, measured) < first => Some(fine),
        _ => Some(rough),
    }
}

/// How far 95 % of the bodies' points are outside the surface at most (m).
fn bulge(bodies: &[Polyhedron], measured: &Measured) -> f64 {
    quantile(&measured.bulges(bodies), 0.95)
}

/// The bodies that a surface is taken apart into, with so many cells along its longest side.
///
/// The library panics when rounding makes the hull of some of the cells fail, which has nothing to do
/// with the surface: with one cell more there are other hulls.
fn taken_apart(
    surface: &Polyhedron,
    cells: f64,
    concavity: f64,
    most: u32,
) -> Option<Vec<Polyhedron>> {
    let fewest = cells as u32;
    let tries = (fewest..).take(TRIES);
    let mut bodies = tries.map(|cells| caught(|| with_cells(surface, cells, concavity, most)));
    bodies
        .find_map(Result::ok)
        .filter(|bodies| !bodies.is_empty())
}

fn with_cells(surface: &Polyhedron, resolution: u32, concavity: f64, most: u32) -> Vec<Polyhedron> {
    let parameters = VHACDParameters {
        concavity,
        resolution,
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
    bodies
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_pcg::Pcg64;
    use rand_pcg::rand_core::{Rng, SeedableRng};

    /// Triangles between points of a coarse grid.
    fn soup(seed: u64) -> Polyhedron {
        let mut random = Pcg64::seed_from_u64(seed);
        let mut below = |most: u32| random.next_u32() % most;
        let corners = (0..40).map(|_| [(); 3].map(|()| 0.3 * (f64::from(below(3)) - 1.0)));
        let corners = corners.collect();
        let count = 1 + below(59);
        let triangles = (0..count).map(|_| [(); 3].map(|()| below(40)));
        Polyhedron {
            triangles: triangles.collect(),
            corners,
        }
    }

    #[test]
    fn what_the_library_fails_at_is_taken_apart_with_more_cells() {
        let surface = soup(789);
        let defect = caught(|| with_cells(&surface, 32, 0.01, 16));
        assert!(defect.is_err(), "choose another surface");
        let bodies = taken_apart(&surface, 32.0, 0.01, 16).expect("it is taken apart");
        assert!(!bodies.is_empty());
        // Each corner of a triangle is in one of the bodies, but for what cells round.
        for corner in surface.triangles.iter().flatten() {
            let corner = surface.corners[*corner as usize];
            let is_near = |body: &Polyhedron| {
                let [low, high] = body.bounds().expect("a body has corners");
                (0..3).all(|axis| (low[axis] - 0.02..=high[axis] + 0.02).contains(&corner[axis]))
            };
            assert!(bodies.iter().any(is_near), "{corner:?}");
        }
    }
}
