//! Constructs vectors, quaternions, poses and transforms, and extracts their parts.

use super::argument;
use super::argument::Result;
use super::names;
use super::value;
use super::value::{Placement, Quaternion, Vector3};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

/// A vector (m).
///
/// `(cl-transforms:make-3d-vector 1 0.5 0)` => `#<3D-VECTOR (1.0d0 0.5d0 0.0d0)>`
#[builtin]
fn make_3d_vector(x: f64, y: f64, z: f64) -> Result<Value> {
    let xyz = [x, y, z];
    Ok(value::vector(xyz))
}

/// The vector of three zeros.
///
/// `(cl-transforms:make-identity-vector)` => `#<3D-VECTOR (0.0d0 0.0d0 0.0d0)>`
#[builtin(_, "")]
fn make_identity_vector() -> Result<Value> {
    Ok(value::vector([0.0; 3]))
}

/// A quaternion; it is kept as given and normalised when it is computed with.
///
/// `(cl-transforms:make-quaternion 0 0 0 1)` => `#<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>`
#[builtin]
fn make_quaternion(x: f64, y: f64, z: f64, w: f64) -> Result<Value> {
    let xyzw = [x, y, z, w];
    Ok(value::quaternion(xyzw))
}

/// The quaternion of no rotation.
///
/// `(cl-transforms:make-identity-rotation)` => `#<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>`
#[builtin(_, "")]
fn make_identity_rotation() -> Result<Value> {
    Ok(value::quaternion(Quaternion::IDENTITY.0))
}

/// A pose in no frame.
///
/// `(cl-tf:make-pose (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation))` => `#<POSE #<3D-VECTOR (1.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin]
fn make_pose(origin: Vector3, orientation: Quaternion) -> Value {
    value::pose(Placement {
        position: origin,
        orientation,
    })
}

/// The pose at the origin.
///
/// `(cl-tf:make-identity-pose)` => `#<POSE #<3D-VECTOR (0.0d0 0.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin(_, "")]
fn make_identity_pose() -> Result<Value> {
    Ok(value::pose(Placement::IDENTITY))
}

/// A transform between frames that it does not name.
///
/// `(cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation))` => `#<TRANSFORM #<3D-VECTOR (1.0d0 0.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin]
fn make_transform(translation: Vector3, rotation: Quaternion) -> Value {
    value::transform(Placement {
        position: translation,
        orientation: rotation,
    })
}

/// The transform that changes nothing.
///
/// `(cl-tf:make-identity-transform)` => `#<TRANSFORM #<3D-VECTOR (0.0d0 0.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin(_, "")]
fn make_identity_transform() -> Result<Value> {
    Ok(value::transform(Placement::IDENTITY))
}

/// The x of a vector or quaternion.
///
/// `(cl-transforms:x (cl-transforms:make-3d-vector 1 2 3))` => `1.0d0`
#[builtin]
fn x(image: &mut Image, object: &Value) -> Result<Value> {
    component(image, object, 0)
}

/// The y of a vector or quaternion.
///
/// `(cl-transforms:y (cl-transforms:make-3d-vector 1 2 3))` => `2.0d0`
#[builtin]
fn y(image: &mut Image, object: &Value) -> Result<Value> {
    component(image, object, 1)
}

/// The z of a vector or quaternion.
///
/// `(cl-transforms:z (cl-transforms:make-3d-vector 1 2 3))` => `3.0d0`
#[builtin]
fn z(image: &mut Image, object: &Value) -> Result<Value> {
    component(image, object, 2)
}

/// The w of a quaternion.
///
/// `(cl-transforms:w (cl-transforms:make-quaternion 0 0 0 1))` => `1.0d0`
#[builtin]
fn w(image: &mut Image, quaternion: &Value) -> Result<Value> {
    component(image, quaternion, 3)
}

/// The position of a pose (m).
///
/// `(cl-transforms:origin (cl-transforms:make-identity-pose))` => `#<3D-VECTOR (0.0d0 0.0d0 0.0d0)>`
#[builtin]
fn origin(pose: &Value) -> Result<Value> {
    position(pose, names::POSE)
}

/// The orientation of a pose.
///
/// `(cl-transforms:orientation (cl-transforms:make-identity-pose))` => `#<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>`
#[builtin("ORIENTATION")]
fn orientation_builtin(pose: &Value) -> Result<Value> {
    orientation(pose, names::POSE)
}

/// The translation of a transform (m).
///
/// `(cl-transforms:translation (cl-transforms:make-identity-transform))` => `#<3D-VECTOR (0.0d0 0.0d0 0.0d0)>`
#[builtin]
fn translation(transform: &Value) -> Result<Value> {
    position(transform, names::TRANSFORM)
}

/// The rotation of a transform.
///
/// `(cl-transforms:rotation (cl-transforms:make-identity-transform))` => `#<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>`
#[builtin]
fn rotation(transform: &Value) -> Result<Value> {
    orientation(transform, names::TRANSFORM)
}

/// A pose with another position or orientation.
///
/// `(cl-tf:copy-pose (cl-tf:make-identity-pose) :origin (cl-tf:make-3d-vector 1 2 3))` => `#<POSE #<3D-VECTOR (1.0d0 2.0d0 3.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin]
fn copy_pose(
    pose: Placement,
    #[key] origin: Option<Vector3>,
    #[key] orientation: Option<Quaternion>,
) -> Value {
    value::pose(pose.with(origin, orientation))
}

/// A transform with another translation or rotation.
///
/// `(cl-tf:copy-transform (cl-tf:make-identity-transform) :translation (cl-tf:make-3d-vector 1 2 3))` => `#<TRANSFORM #<3D-VECTOR (1.0d0 2.0d0 3.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin]
fn copy_transform(
    transform: &Value,
    #[key] translation: Option<Vector3>,
    #[key] rotation: Option<Quaternion>,
) -> Result<Value> {
    let old = argument::as_kind(transform, names::TRANSFORM)?;
    Ok(value::transform(old.with(translation, rotation)))
}

fn component(image: &Image, argument: &Value, index: usize) -> Result<Value> {
    let found = match (value::as_vector(argument), value::as_quaternion(argument)) {
        (Some(v), _) => v.get(index).copied(),
        (_, Some(q)) => q.get(index).copied(),
        _ => None,
    };
    match found {
        Some(x) => Ok(Value::Double(x)),
        None if value::as_placement(argument).is_some() => Err(Raise::simple(format!(
            "{} is a pose: take its ORIGIN or ORIENTATION first.",
            lisp::print::to_string(image, argument, true)
        ))),
        None if index == 3 => Err(Raise::type_error(argument, names::QUATERNION)),
        None => Err(Raise::type_error(argument, names::VECTOR_3D)),
    }
}

fn position(argument: &Value, expected: Sym) -> Result<Value> {
    let Vector3(xyz) = argument::as_kind(argument, expected)?.position;
    Ok(value::vector(xyz))
}

fn orientation(argument: &Value, expected: Sym) -> Result<Value> {
    let Quaternion(xyzw) = argument::as_kind(argument, expected)?.orientation;
    Ok(value::quaternion(xyzw))
}

/// A vector with some numbers changed.
///
/// `(cl-transforms:copy-3d-vector (cl-transforms:make-3d-vector 1 2 3) :z 0)` => `#<3D-VECTOR (1.0d0 2.0d0 0.0d0)>`
#[builtin]
fn copy_3d_vector(
    vector: Vector3,
    #[key] x: Option<f64>,
    #[key] y: Option<f64>,
    #[key] z: Option<f64>,
) -> Value {
    value::vector(replaced(vector.0, [x, y, z]))
}

/// A quaternion with some numbers changed.
///
/// `(cl-tf:copy-quaternion (cl-tf:make-quaternion 0 0 1 0) :x 1 :z 0)` => `#<QUATERNION (1.0d0 0.0d0 0.0d0 0.0d0)>`
#[builtin]
fn copy_quaternion(
    quaternion: Quaternion,
    #[key] x: Option<f64>,
    #[key] y: Option<f64>,
    #[key] z: Option<f64>,
    #[key] w: Option<f64>,
) -> Value {
    value::quaternion(replaced(quaternion.0, [x, y, z, w]))
}

/// The numbers, but the new ones where such are given.
fn replaced<const N: usize>(old: [f64; N], new: [Option<f64>; N]) -> [f64; N] {
    std::array::from_fn(|i| new[i].unwrap_or(old[i]))
}

/// Functions of package `CL-TRANSFORMS`.
pub(crate) static TABLE: &[Builtin] = builtins![
    make_3d_vector,
    make_identity_vector,
    make_quaternion,
    make_identity_rotation,
    make_pose,
    make_identity_pose,
    make_transform,
    make_identity_transform,
    x,
    y,
    z,
    w,
    origin,
    orientation_builtin,
    translation,
    rotation,
    copy_3d_vector,
    copy_quaternion,
    copy_pose,
    copy_transform,
];
