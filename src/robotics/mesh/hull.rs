//! Convex hulls with few corners.

use parry3d_f64::math::Vector;
use parry3d_f64::shape::ConvexPolyhedron;
use parry3d_f64::transformation::try_convex_hull;

use spatial::Polyhedron;

/// So far (m) may points stick out of their hull, in favour of fewer corners.
const SHORT: f64 = 3e-4;

/// A hull of so many points is taken as it is.
const FEW: usize = 24;

/// So often are points added that stick out.
const ROUNDS: usize = 24;

/// Bodies are at least as thick (m).
const THINNEST: f64 = 1e-3;

/// The convex hull of some points (m), which may be short of them by [`SHORT`]. Points in a plane or on a
/// line get a thickness. `None` without points.
pub(super) fn hull(points: &[[f64; 3]]) -> Option<Polyhedron> {
    let points: Vec<Vector> = points
        .iter()
        .map(|[x, y, z]| Vector::new(*x, *y, *z))
        .collect();
    let (mins, maxs) = points.iter().fold(
        (
            Vector::splat(f64::INFINITY),
            Vector::splat(f64::NEG_INFINITY),
        ),
        |(mins, maxs), point| (mins.min(*point), maxs.max(*point)),
    );
    if !(maxs - mins).is_finite() {
        return None;
    }
    if let Some(normal) = flat_along(&points, mins, maxs) {
        let half = normal * (THINNEST / 2.0);
        let both = points
            .iter()
            .flat_map(|point| [*point - half, *point + half]);
        let both: Vec<Vector> = both.collect();
        return reduced(&both).or_else(|| body_of_box(mins - half.abs(), maxs + half.abs()));
    }
    reduced(&points).or_else(|| body_of_box(mins, maxs))
}

/// The direction in which the points are thinner than a body may be, if there is one.
fn flat_along(points: &[Vector], mins: Vector, maxs: Vector) -> Option<Vector> {
    let first = *points.first()?;
    let far = |from: Vector| {
        points
            .iter()
            .copied()
            .fold((from, -1.0), |(best, most), point| {
                let distance = (point - from).length_squared();
                if distance > most {
                    (point, distance)
                } else {
                    (best, most)
                }
            })
    };
    let (one, _) = far(first);
    let (two, length) = far(one);
    if length < 1e-12 {
        return Some(Vector::Z);
    }
    let along = (two - one).normalize();
    // The point farthest from the line through both.
    let away = |point: Vector| {
        let offset = point - one;
        offset - along * offset.dot(along)
    };
    let (side, width) = points.iter().map(|point| away(*point)).fold(
        (Vector::ZERO, 0.0),
        |(best, most), offset| {
            let distance = offset.length_squared();
            if distance > most {
                (offset, distance)
            } else {
                (best, most)
            }
        },
    );
    if width < 1e-12 {
        return Some(along.any_orthonormal_vector());
    }
    let normal = along.cross(side.normalize());
    let depths = points.iter().map(|point| (*point - one).dot(normal));
    let (low, high) = depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), depth| {
        (low.min(depth), high.max(depth))
    });
    let thinnest = (maxs - mins).min_element();
    if high - low < THINNEST / 10.0 {
        return Some(normal);
    }
    if thinnest < THINNEST / 10.0 {
        let size = maxs - mins;
        return Some(if size.x == thinnest {
            Vector::X
        } else if size.y == thinnest {
            Vector::Y
        } else {
            Vector::Z
        });
    }
    None
}

/// The hull of the points that matter: a hull grows from the outermost ones along a few directions by
/// those that stick out of it farthest.
fn reduced(points: &[Vector]) -> Option<Polyhedron> {
    if points.len() <= FEW {
        return checked(points);
    }
    let mut chosen: Vec<usize> = Vec::new();
    for x in -1..=1 {
        for y in -1..=1 {
            for z in -1..=1 {
                let direction = Vector::new(f64::from(x), f64::from(y), f64::from(z));
                if direction != Vector::ZERO {
                    chosen.push(farthest(points, direction));
                }
            }
        }
    }
    chosen.sort_unstable();
    chosen.dedup();
    let mut found = None;
    let mut candidates: Vec<usize> = (0..points.len()).collect();
    for _ in 0..ROUNDS {
        let some: Vec<Vector> = chosen.iter().map(|i| points[*i]).collect();
        let Some((corners, triangles)) = raw(&some) else {
            break;
        };
        let planes = triangles.iter().filter_map(|triangle| {
            let [a, b, c] = triangle.map(|i| corners[i as usize]);
            let normal = (b - a).cross(c - a).try_normalize()?;
            Some((normal, normal.dot(a)))
        });
        let planes: Vec<_> = planes.collect();
        // The farthest candidate ahead of each plane.
        let mut outside = vec![(SHORT, None); planes.len()];
        // What is inside stays inside, since the hull only grows.
        candidates.retain(|candidate| {
            let point = points[*candidate];
            let mut most = (SHORT, None);
            for (plane, (normal, offset)) in planes.iter().enumerate() {
                let ahead = normal.dot(point) - offset;
                if ahead > most.0 {
                    most = (ahead, Some(plane));
                }
            }
            let Some(plane) = most.1 else {
                return false;
            };
            if most.0 > outside[plane].0 {
                outside[plane] = (most.0, Some(*candidate));
            }
            true
        });
        found = Some((corners, triangles));
        let before = chosen.len();
        chosen.extend(outside.into_iter().filter_map(|(_, place)| place));
        chosen.sort_unstable();
        chosen.dedup();
        if chosen.len() == before {
            break;
        }
    }
    let (corners, triangles) = found?;
    sound(corners, triangles).or_else(|| checked(points))
}

/// The point farthest in a direction.
fn farthest(points: &[Vector], direction: Vector) -> usize {
    let mut best = (0, f64::NEG_INFINITY);
    for (place, point) in points.iter().enumerate() {
        let reach = point.dot(direction);
        if reach > best.1 {
            best = (place, reach);
        }
    }
    best.0
}

fn raw(points: &[Vector]) -> Option<(Vec<Vector>, Vec<[u32; 3]>)> {
    try_convex_hull(points).ok()
}

fn checked(points: &[Vector]) -> Option<Polyhedron> {
    let (corners, triangles) = raw(points)?;
    sound(corners, triangles)
}

/// The body, if the physics engine can calculate with it.
fn sound(corners: Vec<Vector>, triangles: Vec<[u32; 3]>) -> Option<Polyhedron> {
    ConvexPolyhedron::from_convex_mesh(corners.clone(), &triangles)?;
    let body = Polyhedron {
        corners: corners
            .iter()
            .map(|corner| [corner.x, corner.y, corner.z])
            .collect(),
        triangles,
    };
    (volume(&body) > 1e-12).then_some(body)
}

/// Volume (m³) of a closed surface; negative if its triangles face inwards.
pub(super) fn volume(body: &Polyhedron) -> f64 {
    let origin = body.corners.first().copied().unwrap_or_default();
    let six: f64 = body
        .triangles
        .iter()
        .map(|triangle| {
            let corners = body.triangle(*triangle);
            let [a, b, c] =
                corners.map(|p| Vector::new(p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]));
            a.dot(b.cross(c))
        })
        .sum();
    six / 6.0
}

fn body_of_box(mins: Vector, maxs: Vector) -> Option<Polyhedron> {
    let half = Vector::splat(THINNEST / 2.0);
    let middle = (mins + maxs) / 2.0;
    let (mins, maxs) = (mins.min(middle - half), maxs.max(middle + half));
    let corner = |i: u32| {
        let side = |axis: u32, low: f64, high: f64| if i >> axis & 1 == 1 { high } else { low };
        Vector::new(
            side(0, mins.x, maxs.x),
            side(1, mins.y, maxs.y),
            side(2, mins.z, maxs.z),
        )
    };
    let corners: Vec<Vector> = (0..8).map(corner).collect();
    checked(&corners)
}
