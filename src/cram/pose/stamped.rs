//! Poses and transforms in frames.

use super::argument;
use super::argument::Result;
use super::construct::changed;
use super::names;
use super::pose_functions;
use super::value;
use super::value::{Placement, PoseStamped, TransformStamped};
use lisp::builtin::{Builtin, pure};
use lisp::builtins::keywords;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use spatial;

/// Functions of package `CL-TRANSFORMS-STAMPED`.
pub static TABLE: &[Builtin] = &[
    pure(
        "MAKE-POSE-STAMPED",
        "frame-id stamp origin orientation",
        "A pose in a frame at a time (s).",
        &[
            "(cl-transforms-stamped:make-pose-stamped \"map\" 0.0 (cl-transforms:make-3d-vector 1 0 0) (cl-transforms:make-identity-rotation)) => #<\"map\" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ],
        |image, args| {
            let placement = Placement {
                position: argument::vector(image, &args[2])?,
                orientation: argument::quaternion(image, &args[3])?,
            };
            let frame = argument::frame(&args[0])?;
            Ok(value::pose_stamped_at(&frame, time(&args[1])?, placement))
        },
    ),
    pure(
        "MAKE-TRANSFORM-STAMPED",
        "frame-id child-frame-id stamp translation rotation",
        "A transform from a frame to a child frame at a time (s).",
        &[
            "(cl-tf:make-transform-stamped \"map\" \"base\" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) => #<\"map\" \"base\" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ],
        |image, args| {
            let placement = Placement {
                position: argument::vector(image, &args[3])?,
                orientation: argument::quaternion(image, &args[4])?,
            };
            let (frame, child) = (argument::frame(&args[0])?, argument::frame(&args[1])?);
            let stamp = time(&args[2])?;
            Ok(value::transform_stamped_at(
                &frame, &child, stamp, placement,
            ))
        },
    ),
    pure(
        "FRAME-ID",
        "stamped",
        "The frame of a stamped pose or transform.",
        &[
            "(cl-transforms-stamped:frame-id (pp-tut:make-pose \"map\" '((0 0 0) (0 0 0 1)))) => \"map\"",
        ],
        |_, args| match value::frame_of(&args[0]) {
            Some(frame) => Ok(Value::string(frame.as_ref())),
            None => Err(Raise::type_error(&args[0], names::POSE_STAMPED)),
        },
    ),
    pure(
        "CHILD-FRAME-ID",
        "transform-stamped",
        "The child frame of a stamped transform.",
        &[
            "(cl-tf:child-frame-id (cl-tf:make-transform-stamped \"map\" \"base\" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation))) => \"base\"",
        ],
        |_, args| Ok(Value::string(stamped_transform(&args[0])?.child.as_ref())),
    ),
    pure(
        "STAMP",
        "stamped",
        "The time (s) of a stamped pose or transform.",
        &["(cl-transforms-stamped:stamp (pp-tut:make-pose \"map\" '((0 0 0) (0 0 0 1)))) => 0.0d0"],
        |_, args| {
            let stamp = match value::as_pose_stamped(&args[0]) {
                Some(pose) => pose.stamp,
                None => stamped_transform(&args[0])?.stamp,
            };
            Ok(Value::Double(stamp))
        },
    ),
    pure(
        "POSE->POSE-STAMPED",
        "frame-id stamp pose",
        "A pose put into a frame.",
        &[
            "(cl-tf:pose->pose-stamped \"map\" 0.0 (cl-tf:make-pose (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation))) => #<\"map\" ((1.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ],
        |image, args| {
            let placement = argument::placement(image, &args[2])?;
            let frame = argument::frame(&args[0])?;
            Ok(value::pose_stamped_at(&frame, time(&args[1])?, placement))
        },
    ),
    pure(
        "TRANSFORM->TRANSFORM-STAMPED",
        "frame-id child-frame-id stamp transform",
        "A transform put between frames.",
        &[
            "(cl-tf:transform->transform-stamped \"map\" \"base\" 0.0 (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation))) => #<\"map\" \"base\" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ],
        |image, args| {
            let placement = argument::placement(image, &args[3])?;
            let (frame, child) = (argument::frame(&args[0])?, argument::frame(&args[1])?);
            let stamp = time(&args[2])?;
            Ok(value::transform_stamped_at(
                &frame, &child, stamp, placement,
            ))
        },
    ),
    pure(
        "POSE-STAMPED->POSE",
        "pose-stamped",
        "The pose without its frame.",
        &[
            "(cl-tf:pose-stamped->pose (cl-tf:make-pose-stamped \"map\" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation))) => #<POSE #<3D-VECTOR (1.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |_, args| Ok(value::pose(stamped_pose(&args[0])?.placement)),
    ),
    pure(
        "COPY-POSE-STAMPED",
        "pose-stamped &key frame-id stamp origin orientation",
        "A stamped pose with some parts changed.",
        &[
            "(cl-tf:copy-pose-stamped (cl-tf:make-pose-stamped \"map\" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) :frame-id \"base\") => #<\"base\" ((1.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ],
        copy_pose_stamped,
    ),
    pure(
        "COPY-TRANSFORM-STAMPED",
        "transform-stamped &key frame-id child-frame-id stamp translation rotation",
        "A stamped transform with some parts changed.",
        &[
            "(cl-tf:copy-transform-stamped (cl-tf:make-transform-stamped \"map\" \"base\" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) :child-frame-id \"torso\") => #<\"map\" \"torso\" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ],
        copy_transform_stamped,
    ),
];

/// Functions of package `CRAM-TF`.
pub(crate) static CRAM_TABLE: &[Builtin] = &[
    pure(
        "POSE->LIST",
        "pose",
        "Position and orientation as ((x y z) (x y z w)).",
        &[
            "(cram-tf:pose->list (pp-tut:make-pose \"map\" '((0 1 0) (0 0 0 1)))) => ((0.0d0 1.0d0 0.0d0) (0.0d0 0.0d0 0.0d0 1.0d0))",
        ],
        |image, args| pose_functions::placement_to_list(image, &args[0]),
    ),
    pure(
        "POSE->FLAT-LIST",
        "pose",
        "Position and orientation as (x y z x y z w).",
        &[
            "(cram-tf:pose->flat-list (cl-tf:make-pose (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation))) => (1.0d0 2.0d0 0.0d0 0.0d0 0.0d0 0.0d0 1.0d0)",
        ],
        |image, args| {
            let placement = argument::placement(image, &args[0])?;
            let numbers = placement.position.0.iter().chain(&placement.orientation.0);
            Ok(Value::list(
                numbers.copied().map(Value::Double).collect::<Vec<_>>(),
            ))
        },
    ),
    pure(
        "LIST->POSE",
        "list",
        "The pose of a list ((x y z) (x y z w)).",
        &[
            "(cram-tf:list->pose '((1 2 0) (0 0 0 1))) => #<POSE #<3D-VECTOR (1.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |image, args| Ok(value::pose(argument::placement_list(image, &args[0])?)),
    ),
    pure(
        "LIST->TRANSFORM",
        "list",
        "The transform of a list ((x y z) (x y z w)).",
        &[
            "(cram-tf:list->transform '((1 2 0) (0 0 0 1))) => #<TRANSFORM #<3D-VECTOR (1.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |image, args| Ok(value::transform(argument::placement_list(image, &args[0])?)),
    ),
    pure(
        "POSE->TRANSFORM-STAMPED",
        "parent-frame child-frame stamp pose",
        "The transform between two frames that a pose says.",
        &[
            "(cram-tf:pose->transform-stamped \"map\" \"base\" 0.0 (cl-tf:make-pose (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation))) => #<\"map\" \"base\" ((1.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ],
        |image, args| {
            let placement = argument::placement(image, &args[3])?;
            let (frame, child) = (argument::frame(&args[0])?, argument::frame(&args[1])?);
            let stamp = time(&args[2])?;
            Ok(value::transform_stamped_at(
                &frame, &child, stamp, placement,
            ))
        },
    ),
    pure(
        "POSE-STAMPED->TRANSFORM-STAMPED",
        "pose-stamped child-frame",
        "The transform from the pose's frame to a child frame that stands in the pose.",
        &[
            "(cram-tf:pose-stamped->transform-stamped (cl-tf:make-pose-stamped \"map\" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) \"base\") => #<\"map\" \"base\" ((1.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ],
        |_, args| {
            let pose = stamped_pose(&args[0])?;
            let child = argument::frame(&args[1])?;
            Ok(value::transform_stamped_at(
                &pose.frame,
                &child,
                pose.stamp,
                pose.placement,
            ))
        },
    ),
    pure(
        "TRANSFORM-STAMPED->POSE-STAMPED",
        "transform-stamped",
        "The pose of the child frame.",
        &[
            "(cram-tf:transform-stamped->pose-stamped (cl-tf:make-transform-stamped \"map\" \"base\" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation))) => #<\"map\" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ],
        |_, args| {
            let t = stamped_transform(&args[0])?;
            Ok(value::pose_stamped_at(&t.frame, t.stamp, t.placement))
        },
    ),
    pure(
        "STRIP-TRANSFORM-STAMPED",
        "transform-stamped",
        "The pose of the child frame in its frame.",
        &[
            "(cram-tf:strip-transform-stamped (cl-tf:make-transform-stamped \"map\" \"base\" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation))) => #<\"map\" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ],
        |_, args| {
            let t = stamped_transform(&args[0])?;
            Ok(value::pose_stamped_at(&t.frame, t.stamp, t.placement))
        },
    ),
    pure(
        "TRANSFORM-STAMPED-INV",
        "transform-stamped",
        "The transform back, with the frames exchanged.",
        &[
            "(cram-tf:transform-stamped-inv (cl-tf:make-transform-stamped \"map\" \"base\" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation))) => #<\"base\" \"map\" ((-1.00000 0.00000 0.00000) (-0.00000 -0.00000 -0.00000 1.00000))>",
        ],
        |_, args| {
            stamped_transform(&args[0])?;
            pose_functions::invert(&args[0])
        },
    ),
    pure(
        "MULTIPLY-TRANSFORM-STAMPEDS",
        "x-frame z-frame x-y-transform y-z-transform &key result-as-pose-or-transform",
        "The transform from x to z by way of y, as a stamped transform or as :POSE.",
        &[],
        multiply_stampeds,
    ),
    pure(
        "APPLY-TRANSFORM",
        "left right &key result-as-pose-or-transform",
        "The product of two stamped transforms that meet in a frame, as a stamped transform or as :POSE.",
        &[],
        apply_transform,
    ),
    pure(
        "TRANSLATE-POSE",
        "pose &key x-offset y-offset z-offset",
        "The pose moved along the axes of its frame (m).",
        &[
            "(cram-tf:translate-pose (cl-tf:make-pose-stamped \"map\" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) :x-offset 1) => #<\"map\" ((2.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ],
        translate_pose,
    ),
    pure(
        "ROTATE-POSE",
        "pose axis angle",
        "The pose turned about one of its own axes :X :Y :Z by an angle (rad).",
        &[
            "(cram-tf:rotate-pose (cl-tf:make-pose-stamped \"map\" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) :z 0) => #<\"map\" ((1.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ],
        rotate_pose,
    ),
    pure(
        "TRANSLATE-TRANSFORM-STAMPED",
        "transform-stamped &key x-offset y-offset z-offset",
        "The transform moved along the axes of its frame (m).",
        &[
            "(cram-tf:translate-transform-stamped (cl-tf:make-transform-stamped \"map\" \"base\" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) :z-offset 1) => #<\"map\" \"base\" ((1.00000 0.00000 1.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ],
        translate_pose,
    ),
    pure(
        "POSES-EQUAL-P",
        "pose other position-threshold angle-threshold",
        "Are two poses within a distance (m) and an angle (rad) of each other, in the same frame?",
        &[
            "(cram-tf:poses-equal-p (cl-tf:make-pose-stamped \"map\" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) (cl-tf:make-pose-stamped \"map\" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) 0.01 0.01) => T",
        ],
        |image, args| {
            let same_frame = value::frame_of(&args[0]) == value::frame_of(&args[1]);
            let a = argument::placement(image, &args[0])?.to_pose();
            let b = argument::placement(image, &args[1])?.to_pose();
            let near = spatial::pose::distance_between(&a, &b) <= argument::real(&args[2])?;
            let aligned = spatial::pose::angle_between(&a, &b) <= argument::real(&args[3])?;
            Ok(Value::bool(same_frame && near && aligned))
        },
    ),
];

/// A time (s); `NIL` is 0.
fn time(argument: &Value) -> Result<f64> {
    if argument.is_nil() {
        return Ok(0.0);
    }
    argument::real(argument)
}

fn stamped_pose(argument: &Value) -> Result<PoseStamped> {
    value::as_pose_stamped(argument).ok_or_else(|| Raise::type_error(argument, names::POSE_STAMPED))
}

fn stamped_transform(argument: &Value) -> Result<TransformStamped> {
    value::as_transform_stamped(argument)
        .ok_or_else(|| Raise::type_error(argument, names::TRANSFORM_STAMPED))
}

fn copy_pose_stamped(image: &mut Image, args: &[Value]) -> Result<Value> {
    let old = stamped_pose(&args[0])?;
    let names = ["FRAME-ID", "STAMP", "ORIGIN", "ORIENTATION"].map(|n| image.keyword(n));
    let [frame, stamp, origin, orientation] = keywords::parse(image, &args[1..], names)?;
    let frame = frame.map_or(Ok(old.frame.to_string()), |f| argument::frame(&f))?;
    let stamp = stamp.map_or(Ok(old.stamp), |s| time(&s))?;
    let mut placement = old.placement;
    if let Some(origin) = origin {
        placement.position = argument::vector(image, &origin)?;
    }
    if let Some(orientation) = orientation {
        placement.orientation = argument::quaternion(image, &orientation)?;
    }
    Ok(value::pose_stamped_at(&frame, stamp, placement))
}

fn copy_transform_stamped(image: &mut Image, args: &[Value]) -> Result<Value> {
    let old = stamped_transform(&args[0])?;
    let names = [
        "FRAME-ID",
        "CHILD-FRAME-ID",
        "STAMP",
        "TRANSLATION",
        "ROTATION",
    ]
    .map(|n| image.keyword(n));
    let [frame, child, stamp, translation, rotation] = keywords::parse(image, &args[1..], names)?;
    let frame = frame.map_or(Ok(old.frame.to_string()), |f| argument::frame(&f))?;
    let child = child.map_or(Ok(old.child.to_string()), |f| argument::frame(&f))?;
    let stamp = stamp.map_or(Ok(old.stamp), |s| time(&s))?;
    let mut rest = Vec::new();
    for (name, value) in [(names[3], translation), (names[4], rotation)] {
        if let Some(value) = value {
            rest.push(Value::from(name));
            rest.push(value);
        }
    }
    let placement = changed(image, old.placement, &rest, [names[3], names[4]])?;
    Ok(value::transform_stamped_at(
        &frame, &child, stamp, placement,
    ))
}

/// The product of two stamped transforms, with new frame names.
fn product(
    image: &mut Image,
    left: &TransformStamped,
    right: &TransformStamped,
    frames: (&str, &str),
    options: &[Value],
) -> Result<Value> {
    let names = [image.keyword("RESULT-AS-POSE-OR-TRANSFORM")];
    let [kind] = keywords::parse(image, options, names)?;
    let pose = image.keyword("POSE");
    let placement = Placement::of(&(left.pose() * right.pose()));
    Ok(if kind.and_then(|k| k.as_symbol()) == Some(pose) {
        value::pose_stamped_at(frames.0, left.stamp, placement)
    } else {
        value::transform_stamped_at(frames.0, frames.1, left.stamp, placement)
    })
}

fn multiply_stampeds(image: &mut Image, args: &[Value]) -> Result<Value> {
    let (x, z) = (argument::frame(&args[0])?, argument::frame(&args[1])?);
    let left = stamped_transform(&args[2])?;
    let right = stamped_transform(&args[3])?;
    check_frames("The first transform leads from", &left.frame, &x)?;
    check_frames("The second transform leads to", &right.child, &z)?;
    check_meeting(&left, &right)?;
    product(image, &left, &right, (&x, &z), &args[4..])
}

fn apply_transform(image: &mut Image, args: &[Value]) -> Result<Value> {
    let left = stamped_transform(&args[0])?;
    let right = stamped_transform(&args[1])?;
    check_meeting(&left, &right)?;
    let (x, z) = (left.frame.clone(), right.child.clone());
    product(image, &left, &right, (&x, &z), &args[2..])
}

fn check_frames(what: &str, actual: &str, wanted: &str) -> Result<()> {
    if actual == wanted {
        return Ok(());
    }
    Err(Raise::simple(format!(
        "{what} {actual:?} but {wanted:?} was named."
    )))
}

fn check_meeting(left: &TransformStamped, right: &TransformStamped) -> Result<()> {
    if left.child == right.frame {
        return Ok(());
    }
    Err(Raise::simple(format!(
        "The transforms do not meet: the first leads to {:?} and the second starts in {:?}.",
        left.child, right.frame
    )))
}

/// The same kind of value with another placement.
fn replaced(original: &Value, placement: Placement) -> Value {
    if let Some(pose) = value::as_pose_stamped(original) {
        return value::pose_stamped_at(&pose.frame, pose.stamp, placement);
    }
    if let Some(t) = value::as_transform_stamped(original) {
        return value::transform_stamped_at(&t.frame, &t.child, t.stamp, placement);
    }
    value::pose(placement)
}

fn translate_pose(image: &mut Image, args: &[Value]) -> Result<Value> {
    let mut placement = argument::placement(image, &args[0])?;
    let names = ["X-OFFSET", "Y-OFFSET", "Z-OFFSET"].map(|n| image.keyword(n));
    let offsets = keywords::parse(image, &args[1..], names)?;
    for (x, offset) in placement.position.0.iter_mut().zip(offsets) {
        if let Some(offset) = offset {
            *x += argument::real(&offset)?;
        }
    }
    Ok(replaced(&args[0], placement))
}

fn rotate_pose(image: &mut Image, args: &[Value]) -> Result<Value> {
    let mut placement = argument::placement(image, &args[0])?;
    let angle = argument::real(&args[2])?;
    let axis = args[1].as_symbol().map(|s| image.name(s).to_owned());
    let angles = match axis.as_deref() {
        Some("X") => [angle, 0.0, 0.0],
        Some("Y") => [0.0, angle, 0.0],
        Some("Z") => [0.0, 0.0, angle],
        _ => {
            return Err(Raise::simple(format!(
                "{} is not an axis: one of :X, :Y and :Z was expected.",
                lisp::print::to_string(image, &args[1], true)
            )));
        }
    };
    let turn = spatial::pose::from_xyz_rpy([0.0; 3], angles).rotation;
    let turned = placement.orientation.rotation() * turn;
    placement.orientation = value::Quaternion::of(&turned);
    Ok(replaced(&args[0], placement))
}
