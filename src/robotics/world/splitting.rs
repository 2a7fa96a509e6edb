//! Splitting solids by a plane.

use parry3d_f64::math::Vector;
use parry3d_f64::transformation::try_convex_hull;

use super::solid::Solid;
use spatial::{PlacedShape, Polyhedron, Pose, Shape, trig};

/// Number of sides of what is round.
const SIDES: u32 = 32;
/// Number of rings of a ball.
const RINGS: u32 = 16;
/// Distance (m) from the plane up to which a corner is on it.
const ON_PLANE: f64 = 1e-9;

/// Gap (m) between the pieces: bodies whose faces coincide exactly have no certain direction in which they touch.
const GAP: f64 = 2e-4;
/// A plane is across an axis if the cosine of the angle to it is greater: 2 mrad.
const ACROSS: f64 = 1.0 - 2e-6;

/// A plane: a point on it (m) and its unit normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane {
    pub(super) point: Vector,
    pub(super) normal: Vector,
}

impl Plane {
    /// How far (m) a point is in front of it.
    fn distance(&self, point: Vector) -> f64 {
        (point - self.point).dot(self.normal)
    }
}

/// What a plane makes of shapes.
#[derive(Clone, Debug, Default)]
pub(super) struct Split {
    /// The shapes behind the plane, and those in front of it.
    pub(super) sides: [Vec<PlacedShape>; 2],
    /// Points (m) of the section, whose hull it is.
    pub(super) section: Vec<Vector>,
}

impl Split {
    /// Splits shapes, which are in the frame in which the plane is. What is round becomes a body with 32 sides of the
    /// same volume, unless it is cut across its axis. The pieces are [`GAP`] apart.
    pub(super) fn of(shapes: &[PlacedShape], plane: &Plane) -> Option<Self> {
        let mut split = Self::default();
        for placed in shapes {
            let corners = corners_of(placed)?;
            let far: Vec<f64> = corners.iter().map(|c| plane.distance(*c)).collect();
            if far.iter().all(|d| *d < ON_PLANE) {
                split.sides[0].push(placed.clone());
                continue;
            }
            if far.iter().all(|d| *d > -ON_PLANE) {
                split.sides[1].push(placed.clone());
                continue;
            }
            split.section.extend(section(&corners, &far));
            if let Some(halves) = across_axis(placed, plane) {
                for (half, pieces) in halves.into_iter().zip(&mut split.sides) {
                    pieces.extend(half);
                }
                continue;
            }
            for (sign, pieces) in [-1.0, 1.0].into_iter().zip(&mut split.sides) {
                // Before the plane of this side.
                let far: Vec<f64> = far.iter().map(|d| d * sign - GAP / 2.0).collect();
                let own = corners.iter().zip(&far).filter(|(_, d)| **d >= 0.0);
                let own = own.map(|(corner, _)| *corner);
                let points: Vec<Vector> = own.chain(section(&corners, &far)).collect();
                if points.len() < 4 {
                    continue;
                }
                pieces.push(PlacedShape {
                    shape: Shape::Hull(hull(&points)?.into()),
                    pose: Pose::identity(),
                    color: placed.color,
                });
            }
        }
        Some(split)
    }
}

/// Points in which a plane meets a body, given how far its corners are from the plane. The corners of the section
/// are on edges, and every edge joins two corners.
fn section(corners: &[Vector], far: &[f64]) -> Vec<Vector> {
    let mut section = Vec::new();
    for (a, da) in corners.iter().zip(far) {
        for (b, db) in corners.iter().zip(far) {
            if *da < 0.0 && *db > 0.0 {
                section.push(*a + (*b - *a) * (da / (da - db)));
            }
        }
    }
    section
}

/// The halves of a box or a cylinder behind and before a plane across one of its axes, which are boxes or cylinders
/// again: the engine knows their contacts exactly. `None` for others.
fn across_axis(placed: &PlacedShape, plane: &Plane) -> Option<[Option<PlacedShape>; 2]> {
    let pose = super::solid::to_parry(&placed.pose);
    let (axes, lengths) = match &placed.shape {
        Shape::Box { size } => (vec![0, 1, 2], *size),
        Shape::Cylinder { length, .. } => (vec![2], [0.0, 0.0, *length]),
        _ => return None,
    };
    let directions = [Vector::X, Vector::Y, Vector::Z];
    let axis = axes.into_iter().find(|axis| {
        let across = (pose.rotation * directions[*axis]).dot(plane.normal);
        across.abs() > ACROSS
    })?;
    let direction = pose.rotation * directions[axis];
    let sign = direction.dot(plane.normal).signum();
    let cut = (plane.point - pose.translation).dot(plane.normal) / direction.dot(plane.normal);
    let half = lengths[axis] / 2.0;
    // Along the axis: what is before the cut, and what is after it.
    let parts = [(-half, cut - GAP / 2.0), (cut + GAP / 2.0, half)];
    let made = parts.map(|(from, to)| {
        let (length, middle) = (to - from, (from + to) / 2.0);
        (length > GAP).then(|| {
            let shape = match &placed.shape {
                Shape::Box { size } => {
                    let mut size = *size;
                    size[axis] = length;
                    Shape::Box { size }
                }
                Shape::Cylinder { radius, .. } => Shape::Cylinder {
                    radius: *radius,
                    length,
                },
                other => other.clone(),
            };
            let moved = (directions[axis] * middle).to_array();
            PlacedShape {
                shape,
                pose: placed.pose * Pose::translation(moved[0], moved[1], moved[2]),
                color: placed.color,
            }
        })
    });
    let [before, after] = made;
    Some(if sign > 0.0 {
        [before, after]
    } else {
        [after, before]
    })
}

/// The convex hull of points.
fn hull(points: &[Vector]) -> Option<Polyhedron> {
    let (corners, triangles) = try_convex_hull(points).ok()?;
    Some(Polyhedron {
        corners: corners.iter().map(|c| [c.x, c.y, c.z]).collect(),
        triangles,
    })
}

/// The corners of a solid, or of one with the same volume, in the frame of its owner.
fn corners_of(placed: &PlacedShape) -> Option<Vec<Vector>> {
    let own: Vec<Vector> = match &placed.shape {
        Shape::Box { size } => {
            let [x, y, z] = size.map(|s| s / 2.0);
            let sign = |bit: u32| if bit == 0 { -1.0 } else { 1.0 };
            let all =
                (0..8u32).map(|i| Vector::new(x * sign(i & 1), y * sign(i & 2), z * sign(i & 4)));
            all.collect()
        }
        Shape::Cylinder { radius, length } => {
            let angle = std::f64::consts::TAU / f64::from(SIDES);
            // As large as the circle.
            let (sine, _) = trig::sin_cos(angle);
            let radius = radius * (angle / sine).sqrt();
            let around = (0..SIDES).map(|i| trig::sin_cos(angle * f64::from(i)));
            let around = around.map(|(s, c)| (radius * c, radius * s));
            let ends = [-length / 2.0, length / 2.0];
            around
                .flat_map(|(x, y)| ends.map(|z| Vector::new(x, y, z)))
                .collect()
        }
        Shape::Sphere { radius } => {
            let ball = ball(*radius);
            let body = PlacedShape {
                shape: Shape::Hull(hull(&ball)?.into()),
                pose: Pose::identity(),
                color: None,
            };
            let volume = Solid::new(&body)?.volume;
            let wanted = 4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius;
            let factor = libm::cbrt(wanted / volume);
            ball.iter().map(|corner| *corner * factor).collect()
        }
        Shape::Hull(body) => {
            let corners = body.corners.iter();
            corners.map(|[x, y, z]| Vector::new(*x, *y, *z)).collect()
        }
        Shape::Mesh(_) => return None,
    };
    let pose = super::solid::to_parry(&placed.pose);
    Some(own.into_iter().map(|c| pose.transform_point(c)).collect())
}

/// Points on a ball (m).
fn ball(radius: f64) -> Vec<Vector> {
    let mut points = vec![Vector::Z * radius, Vector::Z * -radius];
    for ring in 1..RINGS {
        let (height, across) = {
            let (s, c) = trig::sin_cos(std::f64::consts::PI * f64::from(ring) / f64::from(RINGS));
            (radius * c, radius * s)
        };
        for i in 0..SIDES {
            let (s, c) = trig::sin_cos(std::f64::consts::TAU * f64::from(i) / f64::from(SIDES));
            points.push(Vector::new(across * c, across * s, height));
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    fn volume(shapes: &[PlacedShape]) -> f64 {
        Solid::all(shapes).iter().map(|solid| solid.volume).sum()
    }

    #[test]
    fn halves_have_the_volume_of_the_whole_but_for_the_gap() {
        let shapes = [
            Shape::Box {
                size: [0.26, 0.1, 0.06],
            },
            Shape::Cylinder {
                radius: 0.016,
                length: 0.1,
            },
            Shape::Sphere { radius: 0.04 },
        ];
        for shape in shapes {
            let whole = [PlacedShape {
                shape,
                pose: Pose::translation(0.01, 0.0, 0.0),
                color: None,
            }];
            for normal in [Vector::X, Vector::new(0.6, 0.8, 0.0), Vector::Z] {
                let plane = Plane {
                    point: Vector::new(0.015, 0.002, 0.003),
                    normal,
                };
                let split = Split::of(&whole, &plane).unwrap();
                let [behind, before] = [0, 1].map(|i| volume(&split.sides[i]));
                assert!(behind > before && before > 0.0, "{normal}");
                let share = (behind + before) / volume(&whole);
                // But for the gap.
                assert!((0.99..1.0).contains(&share), "{share}");
                assert!(
                    split
                        .section
                        .iter()
                        .all(|p| plane.distance(*p).abs() < 1e-9)
                );
            }
        }
    }

    #[test]
    fn what_is_beside_the_plane_stays_as_it_is() {
        let whole = [PlacedShape {
            shape: Shape::Sphere { radius: 0.04 },
            pose: Pose::identity(),
            color: None,
        }];
        let plane = Plane {
            point: Vector::new(0.05, 0.0, 0.0),
            normal: Vector::X,
        };
        let split = Split::of(&whole, &plane).unwrap();
        assert_eq!(split.sides[0], whole);
        assert!(split.sides[1].is_empty() && split.section.is_empty());
    }
}
