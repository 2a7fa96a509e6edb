//! Poses and transforms in frames.

use super::argument;
use super::argument::Result;
use super::construct::changed;
use super::names;
use super::pose_functions;
use super::value;
use super::value::{Placement, PoseStamped, TransformStamped};
use crate::pose::argument::FrameName;
use crate::pose::value::Quaternion;
use crate::pose::value::Vector3;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::FromValue;
use lisp::typed::keywords;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;

/// A pose in a frame at a time (s).
///
/// `(cl-transforms-stamped:make-pose-stamped "map" 0.0 (cl-transforms:make-3d-vector 1 0 0) (cl-transforms:make-identity-rotation))` => `#<"map" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin(_, "frame-id stamp origin orientation")]
fn make_pose_stamped(
    frame_id: FrameName,
    stamp: Time,
    origin: Vector3,
    orientation_argument: Quaternion,
) -> Result<Value> {
    let placement = Placement {
        position: origin,
        orientation: orientation_argument,
    };
    let frame = frame_id.0;
    Ok(value::pose_stamped_at(&frame, stamp.0, placement))
}

/// A transform from a frame to a child frame at a time (s).
///
/// `(cl-tf:make-transform-stamped "map" "base" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation))` => `#<"map" "base" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin]
fn make_transform_stamped(
    frame_id: FrameName,
    child_frame_id: FrameName,
    stamp: Time,
    translation: Vector3,
    rotation: Quaternion,
) -> Result<Value> {
    let placement = Placement {
        position: translation,
        orientation: rotation,
    };
    let (frame, child) = (frame_id.0, child_frame_id.0);
    let stamp = stamp.0;
    Ok(value::transform_stamped_at(
        &frame, &child, stamp, placement,
    ))
}

/// The frame of a stamped pose or transform.
///
/// `(cl-transforms-stamped:frame-id (pp-tut:make-pose "map" '((0 0 0) (0 0 0 1))))` => `"map"`
#[builtin]
fn frame_id(stamped: &Value) -> Result<Value> {
    match value::frame_of(stamped) {
        Some(frame) => Ok(Value::string(frame.as_ref())),
        None => Err(Raise::type_error(stamped, names::POSE_STAMPED)),
    }
}

/// The child frame of a stamped transform.
///
/// `(cl-tf:child-frame-id (cl-tf:make-transform-stamped "map" "base" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)))` => `"base"`
#[builtin]
fn child_frame_id(transform_stamped: TransformStamped) -> Result<Value> {
    Ok(Value::string(transform_stamped.child.as_ref()))
}

/// The time (s) of a stamped pose or transform.
///
/// `(cl-transforms-stamped:stamp (pp-tut:make-pose "map" '((0 0 0) (0 0 0 1))))` => `0.0d0`
#[builtin]
fn stamp(stamped: &Value) -> Result<Value> {
    let stamp = match value::as_pose_stamped(stamped) {
        Some(pose) => pose.stamp,
        None => stamped_transform(stamped)?.stamp,
    };
    Ok(Value::Double(stamp))
}

/// A pose put into a frame.
///
/// `(cl-tf:pose->pose-stamped "map" 0.0 (cl-tf:make-pose (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)))` => `#<"map" ((1.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin("POSE->POSE-STAMPED")]
fn pose_to_pose_stamped(frame_id: FrameName, stamp: Time, pose: Placement) -> Result<Value> {
    let placement = pose;
    let frame = frame_id.0;
    Ok(value::pose_stamped_at(&frame, stamp.0, placement))
}

/// A transform put between frames.
///
/// `(cl-tf:transform->transform-stamped "map" "base" 0.0 (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)))` => `#<"map" "base" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin(
    "TRANSFORM->TRANSFORM-STAMPED",
    "frame-id child-frame-id stamp transform"
)]
fn transform_to_transform_stamped(image: &mut Image, args: &[Value]) -> Result<Value> {
    let placement = argument::placement(image, &args[3])?;
    let (frame, child) = (argument::frame(&args[0])?, argument::frame(&args[1])?);
    let stamp = time(&args[2])?;
    Ok(value::transform_stamped_at(
        &frame, &child, stamp, placement,
    ))
}

/// The pose without its frame.
///
/// `(cl-tf:pose-stamped->pose (cl-tf:make-pose-stamped "map" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)))` => `#<POSE #<3D-VECTOR (1.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin("POSE-STAMPED->POSE")]
fn pose_stamped_to_pose(pose_stamped: PoseStamped) -> Result<Value> {
    Ok(value::pose(pose_stamped.placement))
}

/// Position and orientation as ((x y z) (x y z w)).
///
/// `(cram-tf:pose->list (pp-tut:make-pose "map" '((0 1 0) (0 0 0 1))))` => `((0.0d0 1.0d0 0.0d0) (0.0d0 0.0d0 0.0d0 1.0d0))`
#[builtin("POSE->LIST")]
fn pose_to_list(image: &mut Image, pose: &Value) -> Result<Value> {
    pose_functions::placement_to_list(image, pose)
}

/// Position and orientation as (x y z x y z w).
///
/// `(cram-tf:pose->flat-list (cl-tf:make-pose (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)))` => `(1.0d0 2.0d0 0.0d0 0.0d0 0.0d0 0.0d0 1.0d0)`
#[builtin("POSE->FLAT-LIST")]
fn pose_to_flat_list(pose: Placement) -> Result<Value> {
    let placement = pose;
    let numbers = placement.position.0.iter().chain(&placement.orientation.0);
    Ok(Value::list(
        numbers.copied().map(Value::Double).collect::<Vec<_>>(),
    ))
}

/// The pose of a list ((x y z) (x y z w)).
///
/// `(cram-tf:list->pose '((1 2 0) (0 0 0 1)))` => `#<POSE #<3D-VECTOR (1.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin("LIST->POSE")]
fn list_to_pose(image: &mut Image, list: &Value) -> Result<Value> {
    Ok(value::pose(argument::placement_list(image, list)?))
}

/// The transform of a list ((x y z) (x y z w)).
///
/// `(cram-tf:list->transform '((1 2 0) (0 0 0 1)))` => `#<TRANSFORM #<3D-VECTOR (1.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>`
#[builtin("LIST->TRANSFORM")]
fn list_to_transform(image: &mut Image, list: &Value) -> Result<Value> {
    Ok(value::transform(argument::placement_list(image, list)?))
}

/// The transform between two frames that a pose says.
///
/// `(cram-tf:pose->transform-stamped "map" "base" 0.0 (cl-tf:make-pose (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)))` => `#<"map" "base" ((1.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin("POSE->TRANSFORM-STAMPED")]
fn pose_to_transform_stamped(
    parent_frame: FrameName,
    child_frame: FrameName,
    stamp: Time,
    pose: Placement,
) -> Result<Value> {
    let placement = pose;
    let (frame, child) = (parent_frame.0, child_frame.0);
    let stamp = stamp.0;
    Ok(value::transform_stamped_at(
        &frame, &child, stamp, placement,
    ))
}

/// The transform from the pose's frame to a child frame that stands in the pose.
///
/// `(cram-tf:pose-stamped->transform-stamped (cl-tf:make-pose-stamped "map" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) "base")` => `#<"map" "base" ((1.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin("POSE-STAMPED->TRANSFORM-STAMPED")]
fn pose_stamped_to_transform_stamped(
    pose_stamped: PoseStamped,
    child_frame: FrameName,
) -> Result<Value> {
    let pose = pose_stamped;
    let child = child_frame.0;
    Ok(value::transform_stamped_at(
        &pose.frame,
        &child,
        pose.stamp,
        pose.placement,
    ))
}

/// The pose of the child frame.
///
/// `(cram-tf:transform-stamped->pose-stamped (cl-tf:make-transform-stamped "map" "base" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)))` => `#<"map" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin("TRANSFORM-STAMPED->POSE-STAMPED")]
fn transform_stamped_to_pose_stamped(transform_stamped: TransformStamped) -> Result<Value> {
    let t = transform_stamped;
    Ok(value::pose_stamped_at(&t.frame, t.stamp, t.placement))
}

/// The pose of the child frame in its frame.
///
/// `(cram-tf:strip-transform-stamped (cl-tf:make-transform-stamped "map" "base" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)))` => `#<"map" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin]
fn strip_transform_stamped(transform_stamped: TransformStamped) -> Result<Value> {
    let t = transform_stamped;
    Ok(value::pose_stamped_at(&t.frame, t.stamp, t.placement))
}

/// The transform back, with the frames exchanged.
///
/// `(cram-tf:transform-stamped-inv (cl-tf:make-transform-stamped "map" "base" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)))` => `#<"base" "map" ((-1.00000 0.00000 0.00000) (-0.00000 -0.00000 -0.00000 1.00000))>`
#[builtin]
fn transform_stamped_inv(transform_stamped: &Value) -> Result<Value> {
    stamped_transform(transform_stamped)?;
    pose_functions::invert(transform_stamped)
}

/// The transform moved along the axes of its frame (m).
///
/// `(cram-tf:translate-transform-stamped (cl-tf:make-transform-stamped "map" "base" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) :z-offset 1)` => `#<"map" "base" ((1.00000 0.00000 1.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin(_, "transform-stamped &key x-offset y-offset z-offset")]
fn translate_transform_stamped(image: &mut Image, args: &[Value]) -> Result<Value> {
    translate_pose(image, args)
}

/// Are two poses within a distance (m) and an angle (rad) of each other, in the same frame?
///
/// `(cram-tf:poses-equal-p (cl-tf:make-pose-stamped "map" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) (cl-tf:make-pose-stamped "map" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) 0.01 0.01)` => `T`
#[builtin]
fn poses_equal_p(
    image: &mut Image,
    pose: &Value,
    other: &Value,
    position_threshold: f64,
    angle_threshold: f64,
) -> Result<Value> {
    let same_frame = value::frame_of(pose) == value::frame_of(other);
    let a = argument::placement(image, pose)?.to_pose();
    let b = argument::placement(image, other)?.to_pose();
    let near = spatial::pose::distance_between(&a, &b) <= position_threshold;
    let aligned = spatial::pose::angle_between(&a, &b) <= angle_threshold;
    Ok(Value::bool(same_frame && near && aligned))
}

/// A time (s); `NIL` is 0.
struct Time(f64);

impl FromValue<'_> for Time {
    const HAS_NIL: bool = true;

    fn from_value(_: &mut Image, value: &Value) -> Result<Self> {
        time(value).map(Time)
    }
}

fn time(argument: &Value) -> Result<f64> {
    if argument.is_nil() {
        return Ok(0.0);
    }
    argument::real(argument)
}

impl FromValue<'_> for PoseStamped {
    fn from_value(_: &mut Image, value: &Value) -> Result<Self> {
        stamped_pose(value)
    }
}

impl FromValue<'_> for TransformStamped {
    fn from_value(_: &mut Image, value: &Value) -> Result<Self> {
        stamped_transform(value)
    }
}

fn stamped_pose(argument: &Value) -> Result<PoseStamped> {
    value::as_pose_stamped(argument).ok_or_else(|| Raise::type_error(argument, names::POSE_STAMPED))
}

fn stamped_transform(argument: &Value) -> Result<TransformStamped> {
    value::as_transform_stamped(argument)
        .ok_or_else(|| Raise::type_error(argument, names::TRANSFORM_STAMPED))
}

/// A stamped pose with some parts changed.
///
/// `(cl-tf:copy-pose-stamped (cl-tf:make-pose-stamped "map" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) :frame-id "base")` => `#<"base" ((1.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin(_, "pose-stamped &key frame-id stamp origin orientation")]
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

/// A stamped transform with some parts changed.
///
/// `(cl-tf:copy-transform-stamped (cl-tf:make-transform-stamped "map" "base" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) :child-frame-id "torso")` => `#<"map" "torso" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin(
    _,
    "transform-stamped &key frame-id child-frame-id stamp translation rotation"
)]
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

/// The transform from x to z by way of y, as a stamped transform or as :POSE.
#[builtin(
    "MULTIPLY-TRANSFORM-STAMPEDS",
    "x-frame z-frame x-y-transform y-z-transform &key result-as-pose-or-transform"
)]
fn multiply_stampeds(image: &mut Image, args: &[Value]) -> Result<Value> {
    let (x, z) = (argument::frame(&args[0])?, argument::frame(&args[1])?);
    let left = stamped_transform(&args[2])?;
    let right = stamped_transform(&args[3])?;
    check_frames("The first transform leads from", &left.frame, &x)?;
    check_frames("The second transform leads to", &right.child, &z)?;
    check_meeting(&left, &right)?;
    product(image, &left, &right, (&x, &z), &args[4..])
}

/// The product of two stamped transforms that meet in a frame, as a stamped transform or as :POSE.
#[builtin(_, "left right &key result-as-pose-or-transform")]
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

/// The pose moved along the axes of its frame (m). `:x`, `:y` and `:z` are the same as `:x-offset`, ….
///
/// `(cram-tf:translate-pose (cl-tf:make-pose-stamped "map" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) :x-offset 1)` => `#<"map" ((2.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin(_, "pose &key x-offset y-offset z-offset x y z")]
fn translate_pose(image: &mut Image, args: &[Value]) -> Result<Value> {
    let mut placement = argument::placement(image, &args[0])?;
    let names = ["X-OFFSET", "Y-OFFSET", "Z-OFFSET", "X", "Y", "Z"].map(|n| image.keyword(n));
    let offsets = keywords::parse(image, &args[1..], names)?;
    for (at, offset) in offsets.iter().enumerate() {
        if let Some(offset) = offset {
            placement.position.0[at % 3] += argument::real(offset)?;
        }
    }
    Ok(replaced(&args[0], placement))
}

/// The pose turned about one of its own axes :X :Y :Z by an angle (rad).
///
/// `(cram-tf:rotate-pose (cl-tf:make-pose-stamped "map" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) :z 0)` => `#<"map" ((1.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin(_, "pose axis angle")]
fn rotate_pose(image: &mut Image, pose: &Value, axis_value: &Value, angle: f64) -> Result<Value> {
    let mut placement = argument::placement(image, pose)?;
    let axis = axis_value.as_symbol().map(|s| image.name(s).to_owned());
    let angles = match axis.as_deref() {
        Some("X") => [angle, 0.0, 0.0],
        Some("Y") => [0.0, angle, 0.0],
        Some("Z") => [0.0, 0.0, angle],
        _ => {
            return Err(Raise::simple(format!(
                "{} is not an axis: one of :X, :Y and :Z was expected.",
                lisp::print::to_string(image, axis_value, true)
            )));
        }
    };
    let turn = spatial::pose::from_xyz_rpy([0.0; 3], angles).rotation;
    let turned = placement.orientation.rotation() * turn;
    placement.orientation = Quaternion::of(&turned);
    Ok(replaced(pose, placement))
}

/// Functions of package `CL-TRANSFORMS-STAMPED`.
pub(crate) static TABLE: &[Builtin] = builtins![
    make_pose_stamped,
    make_transform_stamped,
    frame_id,
    child_frame_id,
    stamp,
    pose_to_pose_stamped,
    transform_to_transform_stamped,
    pose_stamped_to_pose,
    copy_pose_stamped,
    copy_transform_stamped,
];

/// Functions of package `CRAM-TF`.
pub(crate) static CRAM_TABLE: &[Builtin] = builtins![
    pose_to_list,
    pose_to_flat_list,
    list_to_pose,
    list_to_transform,
    pose_to_transform_stamped,
    pose_stamped_to_transform_stamped,
    transform_stamped_to_pose_stamped,
    strip_transform_stamped,
    transform_stamped_inv,
    multiply_stampeds,
    apply_transform,
    translate_pose,
    rotate_pose,
    translate_transform_stamped,
    poses_equal_p,
];
