//! Normals for surfaces given only by points: gentle bends are shaded as round, sharp ones as
//! edges.

use nalgebra::{Point3, Vector3};

use super::surface::{Corner, Surface};

/// Cosine of the bend beyond which an edge stays an edge.
const EDGE: f64 = 0.62;

/// So many triangles at a point, which are beyond counting against each other, are all edges.
const MAX_AROUND: usize = 500;

/// Normals that differ by less than this are merged.
const SAME: f64 = 1e-9;

/// The surface of the triangles (indices into `points`); those without area are omitted.
pub(crate) fn smoothed(points: &[Point3<f64>], triangles: &[[u32; 3]]) -> Surface {
    let point = |i: u32| points.get(i as usize).copied();
    let known: Vec<_> = triangles
        .iter()
        .filter_map(|triangle| {
            let [a, b, c] = triangle.map(point);
            let (a, b, c) = (a?, b?, c?);
            let outward = (b - a).cross(&(c - a));
            Some((*triangle, outward, outward.try_normalize(1e-15)?))
        })
        .collect();
    let mut around: Vec<Vec<u32>> = vec![Vec::new(); points.len()];
    for (place, (triangle, ..)) in (0u32..).zip(&known) {
        // The triangles have valid indices, see above.
        triangle
            .iter()
            .for_each(|i| around[*i as usize].push(place));
    }
    let mut surface = Surface::default();
    let mut made: Vec<Vec<u32>> = vec![Vec::new(); points.len()];
    for (triangle, _, own) in &known {
        let corner = |i: u32| {
            let around = around.get(i as usize).map_or(&[][..], Vec::as_slice);
            let around = if around.len() > MAX_AROUND {
                &[]
            } else {
                around
            };
            let gentle = around.iter().map(|t| &known[*t as usize]);
            let gentle = gentle.filter(|(_, _, other)| other.dot(own) > EDGE);
            let sum = gentle.fold(Vector3::zeros(), |sum, (_, outward, _)| sum + outward);
            Corner {
                point: points[i as usize],
                normal: sum.try_normalize(1e-15).unwrap_or(*own),
            }
        };
        let places = triangle.map(|i| {
            let corner = corner(i);
            let is_same = |place: &&u32| {
                let normal = surface.corners[**place as usize].normal;
                (normal - corner.normal).norm() < SAME
            };
            let latest = made[i as usize].iter().rev().take(MAX_AROUND);
            match latest.rev().find(is_same) {
                Some(place) => *place,
                None => {
                    let place = surface.corners.len() as u32;
                    surface.corners.push(corner);
                    made[i as usize].push(place);
                    place
                }
            }
        });
        surface.triangles.push(places);
    }
    surface
}
