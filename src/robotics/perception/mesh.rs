//! Triangle meshes of the primitive shapes.

use nalgebra::Point3;

use spatial::{Shape, trig};

/// Corners of the polygon that approximates a circle.
const CIRCLE_CORNERS: u32 = 24;

/// Rings of a ball between its poles.
const BALL_RINGS: u32 = 12;

/// A closed surface; seen from outside, the corners of a triangle are in counter-clockwise
/// order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners (m) in the shape's frame.
    pub corners: Vec<Point3<f64>>,
    /// Triangles as indices into `corners`.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// The surface of a shape.
    pub fn of(shape: &Shape) -> Self {
        match shape {
            Shape::Box { size } => Self::cuboid(size.map(|s| s / 2.0)),
            Shape::Cylinder { radius, length } => Self::cylinder(*radius, length / 2.0),
            Shape::Sphere { radius } => Self::ball(*radius),
            Shape::Hull(body) | Shape::Mesh(body) => Self {
                corners: body.corners.iter().copied().map(Point3::from).collect(),
                triangles: body.triangles.clone(),
            },
        }
    }

    fn cuboid([x, y, z]: [f64; 3]) -> Self {
        let corners = [
            [-x, -y, -z],
            [x, -y, -z],
            [x, y, -z],
            [-x, y, -z],
            [-x, -y, z],
            [x, -y, z],
            [x, y, z],
            [-x, y, z],
        ];
        let quads = [
            [0, 3, 2, 1],
            [4, 5, 6, 7],
            [0, 1, 5, 4],
            [1, 2, 6, 5],
            [2, 3, 7, 6],
            [3, 0, 4, 7],
        ];
        let mut mesh = Self {
            corners: corners.map(Point3::from).to_vec(),
            triangles: Vec::new(),
        };
        quads.into_iter().for_each(|quad| mesh.add_quad(quad));
        mesh
    }

    fn cylinder(radius: f64, half_length: f64) -> Self {
        let mut mesh = Self::default();
        for i in 0..CIRCLE_CORNERS {
            let (s, c) = trig::sin_cos(turn(i, CIRCLE_CORNERS));
            for z in [-half_length, half_length] {
                mesh.corners.push(Point3::new(radius * c, radius * s, z));
            }
        }
        for i in 0..CIRCLE_CORNERS {
            let j = (i + 1) % CIRCLE_CORNERS;
            mesh.add_quad([2 * i, 2 * j, 2 * j + 1, 2 * i + 1]);
        }
        for i in 1..CIRCLE_CORNERS - 1 {
            mesh.triangles.push([0, 2 * (i + 1), 2 * i]);
            mesh.triangles.push([1, 2 * i + 1, 2 * (i + 1) + 1]);
        }
        mesh
    }

    fn ball(radius: f64) -> Self {
        let mut mesh = Self::default();
        for ring in 0..=BALL_RINGS {
            let (s, c) = trig::sin_cos(turn(ring, 2 * BALL_RINGS));
            for i in 0..CIRCLE_CORNERS {
                let (t, d) = trig::sin_cos(turn(i, CIRCLE_CORNERS));
                let point = Point3::new(s * d, s * t, c);
                mesh.corners.push(point * radius);
            }
        }
        for ring in 0..BALL_RINGS {
            let (above, below) = (ring * CIRCLE_CORNERS, (ring + 1) * CIRCLE_CORNERS);
            for i in 0..CIRCLE_CORNERS {
                let j = (i + 1) % CIRCLE_CORNERS;
                mesh.add_quad([above + i, below + i, below + j, above + j]);
            }
        }
        mesh
    }

    fn add_quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.triangles.extend([[a, b, c], [a, c, d]]);
    }
}

/// The angle (rad) of the i-th of `count` equal parts of a full turn.
fn turn(i: u32, count: u32) -> f64 {
    std::f64::consts::TAU * f64::from(i) / f64::from(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume (m³) enclosed by the surface, by the divergence theorem; positive only if the
    /// triangles face outwards.
    fn volume(mesh: &Mesh) -> f64 {
        let corner = |i: u32| mesh.corners[i as usize].coords;
        let six: f64 = mesh
            .triangles
            .iter()
            .map(|&[a, b, c]| corner(a).dot(&corner(b).cross(&corner(c))))
            .sum();
        six / 6.0
    }

    #[test]
    fn surfaces_face_outwards_and_enclose_the_volume() {
        let unit = volume(&Mesh::of(&Shape::Box {
            size: [1.0, 2.0, 3.0],
        }));
        assert!((unit - 6.0).abs() < 1e-12);
        let cylinder = volume(&Mesh::of(&Shape::Cylinder {
            radius: 1.0,
            length: 2.0,
        }));
        assert!((cylinder / std::f64::consts::TAU - 1.0).abs() < 0.02);
        let ball = volume(&Mesh::of(&Shape::Sphere { radius: 1.0 }));
        assert!((ball / (std::f64::consts::PI * 4.0 / 3.0) - 1.0).abs() < 0.05);
    }
}
