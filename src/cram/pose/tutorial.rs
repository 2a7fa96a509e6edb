//! The tutorial's functions on poses.

use super::argument;
use super::argument::Result;
use super::names;
use super::value;
use super::value::Placement;
use lisp::builtin::{Builtin, pure};
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;

/// Functions of package `CRAM-PICK-PLACE-TUTORIAL`.
pub static TABLE: &[Builtin] = &[
    pure(
        "MAKE-POSE",
        "frame pose",
        "A pose in a frame (\"map\", \"base_footprint\", the name of a link) from a list ((x y z) (x y z w)): metres and a quaternion.",
        &[
            "(pp-tut:make-pose \"map\" '((0 1 0) (0 0 0 1))) => #<\"map\" ((0.00000 1.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ],
        make_pose,
    ),
    pure(
        "INVERSE-TRANSFORMATION",
        "transform",
        "The transform back.",
        &[
            "(pp-tut:inverse-transformation (cl-tf:make-transform-stamped \"map\" \"base\" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation))) => #<TRANSFORM #<3D-VECTOR (-1.0d0 0.0d0 0.0d0)> #<QUATERNION (-0.0d0 -0.0d0 -0.0d0 1.0d0)>>",
        ],
        |_, args| {
            let transform = argument::as_kind(&args[0], names::TRANSFORM)?;
            let inverse = transform.to_pose().inverse();
            Ok(value::transform(Placement::of(&inverse)))
        },
    ),
    pure(
        "APPLY-TRANSFORMATION",
        "transform pose",
        "The pose carried along by the transform; frames are not compared.",
        &[
            "(pp-tut:apply-transformation (cl-tf:make-transform-stamped \"map\" \"base\" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) (cl-tf:make-pose-stamped \"map\" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation))) => #<POSE #<3D-VECTOR (2.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |image, args| {
            let transform = argument::as_kind(&args[0], names::TRANSFORM)?;
            let pose = argument::placement(image, &args[1])?;
            let moved = transform.to_pose() * pose.to_pose();
            Ok(value::pose(Placement::of(&moved)))
        },
    ),
    pure(
        "GET-X-OF-POSE",
        "pose",
        "The x of a pose's position (m).",
        &["(pp-tut:get-x-of-pose (pp-tut:make-pose \"map\" '((1 2 0) (0 0 0 1)))) => 1.0d0"],
        |image, args| coordinate(image, &args[0], 0),
    ),
    pure(
        "GET-Y-OF-POSE",
        "pose",
        "The y of a pose's position (m).",
        &["(pp-tut:get-y-of-pose (pp-tut:make-pose \"map\" '((1 2 0) (0 0 0 1)))) => 2.0d0"],
        |image, args| coordinate(image, &args[0], 1),
    ),
];

fn make_pose(image: &mut Image, args: &[Value]) -> Result<Value> {
    let Some(frame) = args[0].as_text() else {
        return Err(Raise::simple(format!(
            "{} is not the name of a frame: a string such as \"map\" or \"base_footprint\" was expected.",
            print::to_string(image, &args[0], true)
        ))
        .with(known::K_DATUM, args[0].clone()));
    };
    let placement = match value::as_placement(&args[1]) {
        Some(placement) => placement,
        None => argument::placement_list(image, &args[1])?,
    };
    Ok(value::pose_stamped_at(&frame, 0.0, placement))
}

fn coordinate(image: &Image, pose: &Value, index: usize) -> Result<Value> {
    let placement = argument::placement(image, pose)?;
    let x = placement.position.0.get(index).copied();
    Ok(Value::Double(x.unwrap_or_default()))
}
