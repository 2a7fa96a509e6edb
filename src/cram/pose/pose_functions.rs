//! Composes, inverts and converts poses and transforms without frames.

use super::names;
use crate::pose::value::Vector3;
use nalgebra::Point3;

use super::argument;
use super::argument::Result;
use super::value;
use super::value::Placement;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;

/// The product of transforms: the last is applied first.
///
/// `(cl-tf:transform* (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)))` => `#<TRANSFORM #<3D-VECTOR (2.0d0 0.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin("TRANSFORM*")]
fn transform(image: &mut Image, transform: Placement, transforms: &[Value]) -> Result<Value> {
    let mut product = transform.to_pose();
    for arg in transforms {
        product *= argument::placement(image, arg)?.to_pose();
    }
    Ok(value::transform(Placement::of(&product)))
}

/// The transform back; of a stamped one, with its frames exchanged.
///
/// `(cl-tf:transform-inv (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)))` => `#<TRANSFORM #<3D-VECTOR (-1.0d0 0.0d0 0.0d0)> #<QUATERNION (-0.0d0 -0.0d0 -0.0d0 1.0d0)>>`
#[builtin]
fn transform_inv(transform: &Value) -> Result<Value> {
    invert(transform)
}

/// The transform that leads from the second to the first.
///
/// `(cl-tf:transform-diff (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) (cl-tf:make-identity-transform))` => `#<TRANSFORM #<3D-VECTOR (1.0d0 0.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin]
fn transform_diff(transform: Placement, other: Placement) -> Result<Value> {
    let a = transform.to_pose();
    let b = other.to_pose();
    Ok(value::transform(Placement::of(&(b.inverse() * a))))
}

/// The pose carried along by the transform.
///
/// `(cl-tf:transform-pose (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) (cl-tf:make-pose (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)))` => `#<POSE #<3D-VECTOR (2.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin]
fn transform_pose(transform: Placement, pose: Placement) -> Result<Value> {
    let transform = transform.to_pose();
    let pose = pose.to_pose();
    Ok(value::pose(Placement::of(&(transform * pose))))
}

/// The point carried along by the transform (m).
///
/// `(cl-tf:transform-point (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) (cl-tf:make-3d-vector 1 2 3))` => `#<3D-VECTOR (2.0d0 2.0d0 3.0d0)>`
#[builtin]
fn transform_point(transform: Placement, point: Vector3) -> Result<Value> {
    let transform = transform.to_pose();
    let point = Point3::from(point.0);
    let moved = transform * point;
    Ok(value::vector([moved.x, moved.y, moved.z]))
}

/// The transform with a pose's position and orientation.
///
/// `(cl-tf:pose->transform (cl-tf:make-pose (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)))` => `#<TRANSFORM #<3D-VECTOR (1.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin("POSE->TRANSFORM")]
fn pose_to_transform(pose: Placement) -> Result<Value> {
    Ok(value::transform(pose))
}

/// The pose with a transform's translation and rotation.
///
/// `(cl-tf:transform->pose (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)))` => `#<POSE #<3D-VECTOR (1.0d0 0.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin("TRANSFORM->POSE")]
fn transform_to_pose(transform: Placement) -> Result<Value> {
    Ok(value::pose(transform))
}

/// The object as a pose.
///
/// `(cl-tf:to-pose (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)))` => `#<POSE #<3D-VECTOR (1.0d0 0.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin]
fn to_pose(object: Placement) -> Result<Value> {
    Ok(value::pose(object))
}

/// The object as a transform.
///
/// `(cl-tf:to-transform (cl-tf:make-pose (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)))` => `#<TRANSFORM #<3D-VECTOR (1.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin]
fn to_transform(object: Placement) -> Result<Value> {
    Ok(value::transform(object))
}

/// The inverse: a stamped transform then leads from the child frame to the frame.
pub(crate) fn invert(transform: &Value) -> Result<Value> {
    let placement = argument::as_kind(transform, names::TRANSFORM)?;
    let inverse = Placement::of(&placement.to_pose().inverse());
    Ok(match value::as_transform_stamped(transform) {
        Some(t) => value::transform_stamped_at(t.child, t.frame, t.stamp, inverse),
        None => value::transform(inverse),
    })
}

/// Position and orientation as `((x y z) (x y z w))`.
pub(crate) fn placement_to_list(image: &Image, pose: &Value) -> Result<Value> {
    let placement = argument::placement(image, pose)?;
    Ok(Value::list([
        Value::list(placement.position.0.map(Value::Double)),
        Value::list(placement.orientation.0.map(Value::Double)),
    ]))
}

/// Functions of package `CL-TRANSFORMS`.
pub(crate) static TABLE: &[Builtin] = builtins![
    transform,
    transform_inv,
    transform_diff,
    transform_pose,
    transform_point,
    pose_to_transform,
    transform_to_pose,
    to_pose,
    to_transform,
];
