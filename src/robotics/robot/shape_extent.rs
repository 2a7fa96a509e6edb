//! How far solids extend along a direction.

use nalgebra::Vector3;

use spatial::{PlacedShape, Pose, Shape};

/// The least and the greatest coordinate (m) along a unit direction of a shape whose owner is at a pose.
pub(crate) fn extent(placed: &PlacedShape, owner: &Pose, direction: &Vector3<f64>) -> [f64; 2] {
    let pose = owner * placed.pose;
    let center = pose.translation.vector.dot(direction);
    let own = pose.rotation.inverse() * direction;
    let half = match &placed.shape {
        Shape::Box { size: [x, y, z] } => {
            (own.x.abs() * x + own.y.abs() * y + own.z.abs() * z) / 2.0
        }
        Shape::Cylinder { radius, length } => {
            libm::hypot(own.x, own.y) * radius + own.z.abs() * length / 2.0
        }
        Shape::Sphere { radius } => *radius,
        Shape::Hull(body) | Shape::Mesh(body) => {
            let corners = body.corners.iter();
            let along = corners.map(|[x, y, z]| own.x * x + own.y * y + own.z * z);
            let ends = along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| {
                [low.min(at), high.max(at)]
            });
            return ends.map(|end| center + end);
        }
    };
    [center - half, center + half]
}

/// The least and the greatest coordinate (m) of several shapes of one owner; inverted if there are none.
pub(crate) fn extent_of_all<'a>(
    shapes: impl IntoIterator<Item = &'a PlacedShape>,
    owner: &Pose,
    direction: &Vector3<f64>,
) -> [f64; 2] {
    let extents = shapes.into_iter().map(|s| extent(s, owner, direction));
    extents.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [a, b]| {
        [low.min(a), high.max(b)]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use spatial::Polyhedron;
    use spatial::pose::from_xyz_rpy;
    use std::f64::consts::FRAC_PI_2;
    use std::sync::Arc;

    #[test]
    fn shapes_extend_as_far_as_they_do() {
        let corners = vec![[0.0, 0.0, 0.0], [0.3, 0.0, 0.0], [0.0, -0.2, 0.0]];
        let hull = Polyhedron {
            corners,
            triangles: vec![],
        };
        let cases = [
            (
                Shape::Box {
                    size: [0.2, 0.4, 0.6],
                },
                [0.7, 1.3],
            ),
            (
                Shape::Cylinder {
                    radius: 0.1,
                    length: 0.8,
                },
                [0.6, 1.4],
            ),
            (Shape::Sphere { radius: 0.25 }, [0.75, 1.25]),
            (Shape::Hull(Arc::new(hull)), [1.0, 1.0]),
        ];
        // The turn takes the shape's z axis to the owner's -y, and its owner's y to x.
        let own = from_xyz_rpy([0.0, -1.0, 0.0], [FRAC_PI_2, 0.0, 0.0]);
        let owner = from_xyz_rpy([0.0; 3], [0.0, 0.0, FRAC_PI_2]);
        for (shape, expected) in cases {
            let placed = PlacedShape {
                shape,
                pose: own,
                color: None,
            };
            let found = extent(&placed, &owner, &Vector3::x());
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-12, "{placed:?}: {found}");
            }
        }
    }
}
