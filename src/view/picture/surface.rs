//! Surfaces of shapes as triangles with normals: round things look round, and edges are slightly
//! bevelled, as on real things, so that they catch the light.

use std::f64::consts::TAU;

use nalgebra::{Point3, Vector2, Vector3};

use super::smooth::smoothed;
use spatial::{Shape, trig};

/// Rings of a ball between its poles.
const BALL_RINGS: u32 = 16;

/// A corner of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Position (m), in the shape's frame.
    pub point: Point3<f64>,
    /// Unit vector away from the solid, for shading.
    pub normal: Vector3<f64>,
}

/// A closed surface; seen from outside, the corners of a triangle are in counter-clockwise
/// order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Corners.
    pub corners: Vec<Corner>,
    /// Triangles as indices into `corners`.
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// The surface of a shape whose edges are bevelled by at most `bevel` (m).
    pub fn of(shape: &Shape, bevel: f64) -> Self {
        match shape {
            Shape::Box { size } => {
                let least = size.iter().fold(f64::INFINITY, |a, b| a.min(*b));
                Self::cuboid(size.map(|s| s / 2.0), bevel.min(least * 0.3))
            }
            Shape::Cylinder { radius, length } => {
                let bevel = bevel.min(radius * 0.4).min(length * 0.3);
                Self::cylinder(*radius, length / 2.0, bevel)
            }
            Shape::Sphere { radius } => Self::ball(*radius),
            Shape::Hull(body) | Shape::Mesh(body) => {
                let points: Vec<_> = body.corners.iter().copied().map(Point3::from).collect();
                smoothed(&points, &body.triangles)
            }
        }
    }

    /// A horizontal square around the origin, facing up; `half` is half its edge length (m).
    pub(crate) fn ground(half: f64) -> Self {
        let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
        let corner = |[x, y]: [f64; 2]| Corner {
            point: Point3::new(x, y, 0.0),
            normal: Vector3::z(),
        };
        Self {
            corners: corners.map(corner).to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
        }
    }

    /// Adds a horizontal convex polygon that faces up, at a height (m); its corners (m) are in
    /// counter-clockwise order seen from above.
    pub(crate) fn add_flat(&mut self, corners: &[[f64; 2]], height: f64) {
        // A surface of four billion corners does not fit into memory.
        let first = u32::try_from(self.corners.len()).unwrap_or(u32::MAX);
        self.corners.extend(corners.iter().map(|[x, y]| Corner {
            point: Point3::new(*x, *y, height),
            normal: Vector3::z(),
        }));
        let count = u32::try_from(corners.len()).unwrap_or(0);
        for i in 2..count {
            self.triangles.push([first, first + i - 1, first + i]);
        }
    }

    fn cuboid(half: [f64; 3], bevel: f64) -> Self {
        let mut surface = Self::default();
        // Corner 0..8 has bit i set if its coordinate i is positive; it is split into one
        // corner for each face that meets there.
        for corner in 0..8u32 {
            for face in 0..3 {
                let sign = |axis: usize| if corner >> axis & 1 == 1 { 1.0 } else { -1.0 };
                let inset = |axis: usize| if axis == face { 0.0 } else { bevel };
                let place = |axis: usize| sign(axis) * (half[axis] - inset(axis));
                let mut normal = Vector3::zeros();
                normal[face] = sign(face);
                surface.corners.push(Corner {
                    point: Point3::new(place(0), place(1), place(2)),
                    normal,
                });
            }
        }
        let at = |corner: u32, face: u32| corner * 3 + face;
        for face in 0..3 {
            let (u, v) = (1 << ((face + 1) % 3), 1 << ((face + 2) % 3));
            for side in [0, 1 << face] {
                let quad = [side, side | u, side | u | v, side | v];
                surface.add_outward(quad.map(|corner| at(corner, face)));
            }
        }
        if bevel > 0.0 {
            for along in 0..3 {
                let (one, two) = ((along + 1) % 3, (along + 2) % 3);
                let (u, v, w) = (1 << one, 1 << two, 1 << along);
                for corner in [0, u, v, u | v] {
                    surface.add_outward([
                        at(corner, one),
                        at(corner | w, one),
                        at(corner | w, two),
                        at(corner, two),
                    ]);
                }
            }
            for corner in 0..8 {
                surface.add_outward([at(corner, 0), at(corner, 1), at(corner, 2)]);
            }
        }
        surface
    }

    /// Adds a flat polygon of a convex solid around the origin, oriented outwards.
    fn add_outward<const N: usize>(&mut self, polygon: [u32; N]) {
        let point = |i: u32| self.corners[i as usize].point.coords;
        let [a, b, c] = [point(polygon[0]), point(polygon[1]), point(polygon[2])];
        let faces_out = (b - a).cross(&(c - a)).dot(&(a + b + c)) > 0.0;
        for i in 2..N {
            let (one, two) = (polygon[i - 1], polygon[i]);
            self.triangles.push(match faces_out {
                true => [polygon[0], one, two],
                false => [polygon[0], two, one],
            });
        }
    }

    fn cylinder(radius: f64, half: f64, bevel: f64) -> Self {
        let (inner, side) = (radius - bevel, half - bevel);
        let line = [
            Profile::new(0.0, -half, 0.0, -1.0),
            Profile::new(inner, -half, 0.0, -1.0),
            Profile::new(radius, -side, 1.0, 0.0),
            Profile::new(radius, side, 1.0, 0.0),
            Profile::new(inner, half, 0.0, 1.0),
            Profile::new(0.0, half, 0.0, 1.0),
        ];
        Self::turned(line.windows(2).map(|pair| [pair[0], pair[1]]))
    }

    fn ball(radius: f64) -> Self {
        let rings = (0..=BALL_RINGS).map(|ring| {
            let (s, c) = trig::sin_cos(TAU / 2.0 * f64::from(ring) / f64::from(BALL_RINGS));
            Profile::new(radius * s, -radius * c, s, -c)
        });
        let rings: Vec<_> = rings.collect();
        Self::turned(rings.windows(2).map(|pair| [pair[0], pair[1]]))
    }

    /// The surface of revolution of a line about the z axis. The line is given by its points,
    /// as distances from the axis and heights (m); the solid is to the left of it as it
    /// ascends.
    pub(crate) fn lathed(line: &[[f64; 2]]) -> Self {
        let pieces: Vec<_> = line
            .windows(2)
            .filter_map(|pair| {
                let (from, to) = (Vector2::from(pair[0]), Vector2::from(pair[1]));
                let along = (to - from).try_normalize(1e-9)?;
                Some((from, to, Vector2::new(along.y, -along.x)))
            })
            .collect();
        let piece = |place: Option<usize>| pieces.get(place?);
        Self::turned(pieces.iter().enumerate().map(|(i, (from, to, own))| {
            let end = |point: &Vector2<f64>, neighbour: Option<usize>| {
                // Gentle bends are rounded; sharp ones stay edges.
                let other = piece(neighbour).map(|p| p.2).filter(|n| n.dot(own) > 0.6);
                let normal = (own + other.unwrap_or(*own)).normalize();
                Profile::new(point.x, point.y, normal.x, normal.y)
            };
            [end(from, i.checked_sub(1)), end(to, i.checked_add(1))]
        }))
    }

    /// The surface of revolution of straight pieces about the z axis.
    fn turned(pieces: impl Iterator<Item = [Profile; 2]> + Clone) -> Self {
        let widest = pieces
            .clone()
            .flatten()
            .fold(0.0, |r: f64, p| r.max(p.radius));
        let count = match widest {
            r if r < 0.012 => 10,
            r if r < 0.06 => 24,
            _ => 36,
        };
        let mut surface = Self::default();
        for (piece, ends) in (0u32..).zip(pieces) {
            for ring in ends {
                for i in 0..count {
                    let (s, c) = trig::sin_cos(TAU * f64::from(i) / f64::from(count));
                    surface.corners.push(Corner {
                        point: Point3::new(ring.radius * c, ring.radius * s, ring.z),
                        normal: Vector3::new(ring.out * c, ring.out * s, ring.up),
                    });
                }
            }
            let first = 2 * piece * count;
            for i in 0..count {
                let j = (i + 1) % count;
                let (a, b) = (first + i, first + j);
                let (c, d) = (b + count, a + count);
                if ends[0].radius > 0.0 {
                    surface.triangles.push([a, b, c]);
                }
                if ends[1].radius > 0.0 {
                    surface.triangles.push([a, c, d]);
                }
            }
        }
        surface
    }
}

/// A point of a line that is revolved about the z axis.
#[derive(Clone, Copy)]
struct Profile {
    radius: f64,
    z: f64,
    /// The normal's components away from the axis and along it.
    out: f64,
    up: f64,
}

impl Profile {
    fn new(radius: f64, z: f64, out: f64, up: f64) -> Self {
        Self { radius, z, out, up }
    }
}

#[cfg(test)]
impl Surface {
    /// Volume (m³) enclosed by the surface; positive only if the triangles face outwards.
    pub(crate) fn volume(&self) -> f64 {
        let corner = |i: u32| self.corners[i as usize].point.coords;
        let six: f64 = self
            .triangles
            .iter()
            .map(|&[a, b, c]| corner(a).dot(&corner(b).cross(&corner(c))))
            .sum();
        six / 6.0
    }
}

#[cfg(test)]
mod tests {
    use crate::picture::surface::*;

    #[test]
    fn surfaces_face_outwards_and_enclose_the_volume() {
        let cuboid = Shape::Box {
            size: [1.0, 2.0, 3.0],
        };
        assert!((Surface::of(&cuboid, 0.0).volume() - 6.0).abs() < 1e-12);
        // Twelve edges with a total length of 24 m lose a prism each, the eight corners a bit
        // more.
        let bevelled = Surface::of(&cuboid, 0.01).volume();
        assert!((bevelled - (6.0 - 24.0 * 0.01 * 0.01 / 2.0)).abs() < 1e-5);
        let cylinder = Shape::Cylinder {
            radius: 1.0,
            length: 2.0,
        };
        let share = Surface::of(&cylinder, 0.0).volume() / TAU;
        assert!((share - 1.0).abs() < 0.01);
        let ball = Surface::of(&Shape::Sphere { radius: 1.0 }, 0.0).volume();
        assert!((ball / (TAU * 2.0 / 3.0) - 1.0).abs() < 0.02);
        // A cup with walls and a bottom 0.1 m thick.
        let cup = [
            [0.0, 0.0],
            [1.0, 0.0],
            [1.0, 1.0],
            [0.9, 1.0],
            [0.9, 0.1],
            [0.0, 0.1],
        ];
        let share = Surface::lathed(&cup).volume() / (TAU / 2.0 * (1.0 - 0.81 * 0.9));
        assert!((share - 1.0).abs() < 0.01);
    }

    #[test]
    fn normals_have_unit_length() {
        for shape in [
            Shape::Box { size: [0.1; 3] },
            Shape::Cylinder {
                radius: 0.1,
                length: 0.1,
            },
            Shape::Sphere { radius: 0.1 },
        ] {
            let surface = Surface::of(&shape, 0.01);
            let lengths = surface.corners.iter().map(|c| c.normal.norm());
            assert!(lengths.map(|l| (l - 1.0).abs()).all(|e| e < 1e-12));
        }
    }
}
