//! Composes, inverts and converts poses and transforms without frames.

use super::names;
use nalgebra::Point3;

use super::argument;
use super::argument::Result;
use super::value;
use super::value::Placement;
use lisp::builtin::{Builtin, pure};
use lisp::image::Image;
use lisp::value::Value;

/// Functions of package `CL-TRANSFORMS`.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "TRANSFORM*",
        "transform &rest transforms",
        "The product of transforms: the last is applied first.",
        &[
            "(cl-tf:transform* (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation))) => #<TRANSFORM #<3D-VECTOR (2.0d0 0.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |image, args| {
            let mut product = argument::placement(image, &args[0])?.to_pose();
            for arg in &args[1..] {
                product *= argument::placement(image, arg)?.to_pose();
            }
            Ok(value::transform(Placement::of(&product)))
        },
    ),
    pure(
        "TRANSFORM-INV",
        "transform",
        "The transform back; of a stamped one, with its frames exchanged.",
        &[
            "(cl-tf:transform-inv (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation))) => #<TRANSFORM #<3D-VECTOR (-1.0d0 0.0d0 0.0d0)> #<QUATERNION (-0.0d0 -0.0d0 -0.0d0 1.0d0)>>",
        ],
        |_, args| invert(&args[0]),
    ),
    pure(
        "TRANSFORM-DIFF",
        "transform other",
        "The transform that leads from the second to the first.",
        &[
            "(cl-tf:transform-diff (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) (cl-tf:make-identity-transform)) => #<TRANSFORM #<3D-VECTOR (1.0d0 0.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |image, args| {
            let a = argument::placement(image, &args[0])?.to_pose();
            let b = argument::placement(image, &args[1])?.to_pose();
            Ok(value::transform(Placement::of(&(b.inverse() * a))))
        },
    ),
    pure(
        "TRANSFORM-POSE",
        "transform pose",
        "The pose carried along by the transform.",
        &[
            "(cl-tf:transform-pose (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) (cl-tf:make-pose (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation))) => #<POSE #<3D-VECTOR (2.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |image, args| {
            let transform = argument::placement(image, &args[0])?.to_pose();
            let pose = argument::placement(image, &args[1])?.to_pose();
            Ok(value::pose(Placement::of(&(transform * pose))))
        },
    ),
    pure(
        "TRANSFORM-POINT",
        "transform point",
        "The point carried along by the transform (m).",
        &[
            "(cl-tf:transform-point (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) (cl-tf:make-3d-vector 1 2 3)) => #<3D-VECTOR (2.0d0 2.0d0 3.0d0)>",
        ],
        |image, args| {
            let transform = argument::placement(image, &args[0])?.to_pose();
            let point = Point3::from(argument::vector(image, &args[1])?.0);
            let moved = transform * point;
            Ok(value::vector([moved.x, moved.y, moved.z]))
        },
    ),
    pure(
        "POSE->TRANSFORM",
        "pose",
        "The transform with a pose's position and orientation.",
        &[
            "(cl-tf:pose->transform (cl-tf:make-pose (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation))) => #<TRANSFORM #<3D-VECTOR (1.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |image, args| Ok(value::transform(argument::placement(image, &args[0])?)),
    ),
    pure(
        "TRANSFORM->POSE",
        "transform",
        "The pose with a transform's translation and rotation.",
        &[
            "(cl-tf:transform->pose (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation))) => #<POSE #<3D-VECTOR (1.0d0 0.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |image, args| Ok(value::pose(argument::placement(image, &args[0])?)),
    ),
    pure(
        "TO-POSE",
        "object",
        "The object as a pose.",
        &[
            "(cl-tf:to-pose (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation))) => #<POSE #<3D-VECTOR (1.0d0 0.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |image, args| Ok(value::pose(argument::placement(image, &args[0])?)),
    ),
    pure(
        "TO-TRANSFORM",
        "object",
        "The object as a transform.",
        &[
            "(cl-tf:to-transform (cl-tf:make-pose (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation))) => #<TRANSFORM #<3D-VECTOR (1.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |image, args| Ok(value::transform(argument::placement(image, &args[0])?)),
    ),
];

/// The inverse: a stamped transform then leads from the child frame to the frame.
pub(crate) fn invert(transform: &Value) -> Result<Value> {
    let placement = argument::as_kind(transform, names::TRANSFORM)?;
    let inverse = Placement::of(&placement.to_pose().inverse());
    Ok(match value::as_transform_stamped(transform) {
        Some(t) => value::transform_stamped_at(&t.child, &t.frame, t.stamp, inverse),
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
