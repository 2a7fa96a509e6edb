//! A convex solid in the form that geometric queries need, and the conversion of poses
//! between nalgebra (ours) and the query library's types.
//!
//! A solid includes the axis fix-up that the library needs (its cylinders lie along y), so
//! no other code has to deal with it. Shapes are shared: a clone costs a reference count.

use nalgebra::{Quaternion, Translation3, UnitQuaternion, Vector3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::{Pose as ParryPose, Rotation, Vector};
use parry3d_f64::shape::SharedShape;

use super::oriented_box::OrientedBox;
use spatial::{PlacedShape, Polyhedron, Pose, Shape};

/// The library's pose for ours.
pub(crate) fn to_parry(pose: &Pose) -> ParryPose {
    let t = &pose.translation.vector;
    let q = pose.rotation.quaternion();
    ParryPose::from_parts(
        Vector::new(t.x, t.y, t.z),
        Rotation::from_xyzw(q.i, q.j, q.k, q.w),
    )
}

/// Our pose for the library's.
pub(crate) fn from_parry(pose: &ParryPose) -> Pose {
    let (t, q) = (pose.translation, pose.rotation);
    Pose::from_parts(
        Translation3::new(t.x, t.y, t.z),
        UnitQuaternion::new_unchecked(Quaternion::new(q.w, q.x, q.y, q.z)),
    )
}

/// Our vector for the library's.
pub(crate) fn from_parry_vector(v: Vector) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}

/// A convex primitive placed in the frame of the link or object that owns it.
#[derive(Clone)]
pub struct Solid {
    /// The primitive.
    pub shape: SharedShape,
    /// Pose of the primitive, axis fix-up included, in the owner's frame.
    pub pose: ParryPose,
    /// Bounds in the owner's frame (m).
    pub bounds: Aabb,
    /// The box about the primitive, in the primitive's own frame.
    pub(crate) containing_box: OrientedBox,
    /// Volume (m³), the weight of this part in the mass of its owner.
    pub volume: f64,
}

impl Solid {
    /// The solid of a placed shape; `None` if its size is not positive and finite, or if a
    /// hull has no volume.
    pub fn new(placed: &PlacedShape) -> Option<Self> {
        let place = to_parry(&placed.pose);
        let positive = |values: &[f64]| values.iter().all(|v| v.is_finite() && *v > 0.0);
        let (shape, pose) = match &placed.shape {
            Shape::Box { size } if positive(size) => {
                let [x, y, z] = size.map(|s| s / 2.0);
                (SharedShape::cuboid(x, y, z), place)
            }
            Shape::Cylinder { radius, length } if positive(&[*radius, *length]) => {
                // A quarter turn about x maps the library's y axis to our z axis.
                let half = std::f64::consts::FRAC_1_SQRT_2;
                let turn = ParryPose::from_rotation(Rotation::from_xyzw(half, 0.0, 0.0, half));
                (SharedShape::cylinder(length / 2.0, *radius), place * turn)
            }
            Shape::Sphere { radius } if positive(&[*radius]) => (SharedShape::ball(*radius), place),
            Shape::Hull(body) => (hull(body)?, place),
            _ => return None,
        };
        let bounds = shape.compute_aabb(&pose);
        let volume = shape.mass_properties(1.0).mass();
        let containing_box = OrientedBox::new(&shape.compute_local_aabb());
        (volume > 0.0).then_some(Self {
            shape,
            pose,
            bounds,
            containing_box,
            volume,
        })
    }

    /// The solids of all shapes that have a volume.
    pub fn all(placed: &[PlacedShape]) -> Vec<Self> {
        placed.iter().filter_map(Self::new).collect()
    }
}

/// The library's form of a convex body.
fn hull(body: &Polyhedron) -> Option<SharedShape> {
    let corners = body.corners.iter().map(|[x, y, z]| Vector::new(*x, *y, *z));
    SharedShape::convex_mesh(corners.collect(), &body.triangles)
}

/// Bounds (m) of all solids in their owner's frame; `None` if there are none.
pub(crate) fn bounds_of(solids: &[Solid]) -> Option<Aabb> {
    let mut points = solids
        .iter()
        .flat_map(|s| [s.bounds.mins, s.bounds.maxs])
        .peekable();
    points.peek()?;
    Some(Aabb::from_points(points))
}
