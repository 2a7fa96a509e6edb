//! The tutorial's functions on poses.

use super::argument;
use super::argument::Result;
use super::names;
use super::value;
use super::value::Placement;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;

/// The transform back.
///
/// `(pp-tut:inverse-transformation (cl-tf:make-transform-stamped "map" "base" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)))` => `#<TRANSFORM #<3D-VECTOR (-1.0d0 0.0d0 0.0d0)> #<QUATERNION (-0.0d0 -0.0d0 -0.0d0 1.0d0)>>`
#[builtin]
fn inverse_transformation(transform: &Value) -> Result<Value> {
    let transform = argument::as_kind(transform, names::TRANSFORM)?;
    let inverse = transform.to_pose().inverse();
    Ok(value::transform(Placement::of(&inverse)))
}

/// The pose carried along by the transform; frames are not compared.
///
/// `(pp-tut:apply-transformation (cl-tf:make-transform-stamped "map" "base" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) (cl-tf:make-pose-stamped "map" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)))` => `#<POSE #<3D-VECTOR (2.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin]
fn apply_transformation(transform: &Value, pose: Placement) -> Result<Value> {
    let transform = argument::as_kind(transform, names::TRANSFORM)?;
    let moved = transform.to_pose() * pose.to_pose();
    Ok(value::pose(Placement::of(&moved)))
}

/// The x of a pose's position (m).
///
/// `(pp-tut:get-x-of-pose (pp-tut:make-pose "map" '((1 2 0) (0 0 0 1))))` => `1.0d0`
#[builtin]
fn get_x_of_pose(image: &mut Image, pose: &Value) -> Result<Value> {
    coordinate(image, pose, 0)
}

/// The y of a pose's position (m).
///
/// `(pp-tut:get-y-of-pose (pp-tut:make-pose "map" '((1 2 0) (0 0 0 1))))` => `2.0d0`
#[builtin]
fn get_y_of_pose(image: &mut Image, pose: &Value) -> Result<Value> {
    coordinate(image, pose, 1)
}

/// A pose in a frame ("map", "base_footprint", the name of a link) from a list ((x y z) (x y z w)):
/// metres and a quaternion.
///
/// `(pp-tut:make-pose "map" '((0 1 0) (0 0 0 1)))` => `#<"map" ((0.00000 1.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin]
fn make_pose(image: &mut Image, frame: &Value, pose: &Value) -> Result<Value> {
    let Some(frame) = frame.as_text() else {
        return Err(Raise::simple(format!(
            "{} is not the name of a frame: a string such as \"map\" or \"base_footprint\" was expected.",
            print::to_string(image, frame, true)
        ))
        .with(known::K_DATUM, frame.clone()));
    };
    let placement = match value::as_placement(pose) {
        Some(placement) => placement,
        None => argument::placement_list(image, pose)?,
    };
    Ok(value::pose_stamped_at(frame, 0.0, placement))
}

fn coordinate(image: &Image, pose: &Value, index: usize) -> Result<Value> {
    let placement = argument::placement(image, pose)?;
    let x = placement.position.0.get(index).copied();
    Ok(Value::Double(x.unwrap_or_default()))
}

/// Functions of package `CRAM-PICK-PLACE-TUTORIAL`.
pub(crate) static TABLE: &[Builtin] = builtins![
    make_pose,
    inverse_transformation,
    apply_transformation,
    get_x_of_pose,
    get_y_of_pose,
];
