//! Poses and transforms in frames.

use super::argument;
use super::argument::Result;
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
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;

/// A pose in a frame at a time (s).
///
/// `(cl-transforms-stamped:make-pose-stamped "map" 0.0 (cl-transforms:make-3d-vector 1 0 0) (cl-transforms:make-identity-rotation))` => `#<"map" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin]
fn make_pose_stamped(
    frame_id: FrameName,
    stamp: Time,
    origin: Vector3,
    orientation: Quaternion,
) -> Value {
    let placement = Placement {
        position: origin,
        orientation,
    };
    value::pose_stamped_at(frame_id.0, stamp.0, placement)
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
) -> Value {
    let placement = Placement {
        position: translation,
        orientation: rotation,
    };
    value::transform_stamped_at(frame_id.0, child_frame_id.0, stamp.0, placement)
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
fn pose_to_pose_stamped(frame_id: FrameName, stamp: Time, pose: Placement) -> Value {
    value::pose_stamped_at(frame_id.0, stamp.0, pose)
}

/// A transform put between frames.
///
/// `(cl-tf:transform->transform-stamped "map" "base" 0.0 (cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)))` => `#<"map" "base" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin("TRANSFORM->TRANSFORM-STAMPED")]
fn transform_to_transform_stamped(
    frame_id: FrameName,
    child_frame_id: FrameName,
    stamp: Time,
    transform: Placement,
) -> Value {
    value::transform_stamped_at(frame_id.0, child_frame_id.0, stamp.0, transform)
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
) -> Value {
    value::transform_stamped_at(parent_frame.0, child_frame.0, stamp.0, pose)
}

/// The transform from the pose's frame to a child frame that stands in the pose.
///
/// `(cram-tf:pose-stamped->transform-stamped (cl-tf:make-pose-stamped "map" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) "base")` => `#<"map" "base" ((1.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin("POSE-STAMPED->TRANSFORM-STAMPED")]
fn pose_stamped_to_transform_stamped(pose_stamped: PoseStamped, child_frame: FrameName) -> Value {
    let pose = pose_stamped;
    value::transform_stamped_at(pose.frame, child_frame.0, pose.stamp, pose.placement)
}

/// The pose of the child frame.
///
/// `(cram-tf:transform-stamped->pose-stamped (cl-tf:make-transform-stamped "map" "base" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)))` => `#<"map" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin("TRANSFORM-STAMPED->POSE-STAMPED")]
fn transform_stamped_to_pose_stamped(transform_stamped: TransformStamped) -> Value {
    let t = transform_stamped;
    value::pose_stamped_at(t.frame, t.stamp, t.placement)
}

/// The pose of the child frame in its frame.
///
/// `(cram-tf:strip-transform-stamped (cl-tf:make-transform-stamped "map" "base" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)))` => `#<"map" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin]
fn strip_transform_stamped(transform_stamped: TransformStamped) -> Value {
    transform_stamped_to_pose_stamped(transform_stamped)
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
#[builtin]
fn translate_transform_stamped(
    image: &mut Image,
    transform_stamped: &Value,
    #[key] x_offset: Option<f64>,
    #[key] y_offset: Option<f64>,
    #[key] z_offset: Option<f64>,
) -> Result<Value> {
    translated(image, transform_stamped, &[x_offset, y_offset, z_offset])
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

    fn from_value(image: &mut Image, value: &Value) -> Result<Self> {
        let seconds = Option::<f64>::from_value(image, value)?;
        Ok(Time(seconds.unwrap_or_default()))
    }
}

impl FromValue<'_> for PoseStamped {
    fn from_value(_: &mut Image, value: &Value) -> Result<Self> {
        value::as_pose_stamped(value).ok_or_else(|| Raise::type_error(value, names::POSE_STAMPED))
    }
}

impl FromValue<'_> for TransformStamped {
    fn from_value(_: &mut Image, value: &Value) -> Result<Self> {
        stamped_transform(value)
    }
}

fn stamped_transform(argument: &Value) -> Result<TransformStamped> {
    value::as_transform_stamped(argument)
        .ok_or_else(|| Raise::type_error(argument, names::TRANSFORM_STAMPED))
}

/// A stamped pose with some parts changed.
///
/// `(cl-tf:copy-pose-stamped (cl-tf:make-pose-stamped "map" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) :frame-id "base")` => `#<"base" ((1.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin]
fn copy_pose_stamped(
    pose_stamped: PoseStamped,
    #[key] frame_id: Option<FrameName>,
    #[key] stamp: Option<Time>,
    #[key] origin: Option<Vector3>,
    #[key] orientation: Option<Quaternion>,
) -> Value {
    let old = pose_stamped;
    value::pose_stamped_at(
        frame_id.map_or(old.frame, |frame| frame.0),
        stamp.map_or(old.stamp, |stamp| stamp.0),
        old.placement.with(origin, orientation),
    )
}

/// A stamped transform with some parts changed.
///
/// `(cl-tf:copy-transform-stamped (cl-tf:make-transform-stamped "map" "base" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) :child-frame-id "torso")` => `#<"map" "torso" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin]
fn copy_transform_stamped(
    transform_stamped: TransformStamped,
    #[key] frame_id: Option<FrameName>,
    #[key] child_frame_id: Option<FrameName>,
    #[key] stamp: Option<Time>,
    #[key] translation: Option<Vector3>,
    #[key] rotation: Option<Quaternion>,
) -> Value {
    let old = transform_stamped;
    value::transform_stamped_at(
        frame_id.map_or(old.frame, |frame| frame.0),
        child_frame_id.map_or(old.child, |frame| frame.0),
        stamp.map_or(old.stamp, |stamp| stamp.0),
        old.placement.with(translation, rotation),
    )
}

/// The transform from x to z by way of y, as a stamped transform or as :POSE.
#[builtin]
fn multiply_transform_stampeds(
    image: &mut Image,
    x_frame: FrameName,
    z_frame: FrameName,
    x_y_transform: TransformStamped,
    y_z_transform: TransformStamped,
    #[key] result_as_pose_or_transform: Option<&Value>,
) -> Result<Value> {
    let (left, right) = (x_y_transform, y_z_transform);
    check_frames("The first transform leads from", &left.frame, &x_frame.0)?;
    check_frames("The second transform leads to", &right.child, &z_frame.0)?;
    apply_transform(image, left, right, result_as_pose_or_transform)
}

/// The product of two stamped transforms that meet in a frame, as a stamped transform or as :POSE.
#[builtin]
fn apply_transform(
    image: &mut Image,
    left: TransformStamped,
    right: TransformStamped,
    #[key] result_as_pose_or_transform: Option<&Value>,
) -> Result<Value> {
    check_meeting(&left, &right)?;
    let placement = Placement::of(&(left.pose() * right.pose()));
    let kind = result_as_pose_or_transform.and_then(Value::as_symbol);
    Ok(if kind == Some(image.keyword("POSE")) {
        value::pose_stamped_at(left.frame, left.stamp, placement)
    } else {
        value::transform_stamped_at(left.frame, right.child, left.stamp, placement)
    })
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
        return value::pose_stamped_at(pose.frame, pose.stamp, placement);
    }
    if let Some(t) = value::as_transform_stamped(original) {
        return value::transform_stamped_at(t.frame, t.child, t.stamp, placement);
    }
    value::pose(placement)
}

/// The pose moved along the axes of its frame (m). `:x`, `:y` and `:z` are the same as `:x-offset`, ….
///
/// `(cram-tf:translate-pose (cl-tf:make-pose-stamped "map" 0.0 (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) :x-offset 1)` => `#<"map" ((2.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin]
fn translate_pose(
    image: &mut Image,
    pose: &Value,
    #[key] x_offset: Option<f64>,
    #[key] y_offset: Option<f64>,
    #[key] z_offset: Option<f64>,
    #[key] x: Option<f64>,
    #[key] y: Option<f64>,
    #[key] z: Option<f64>,
) -> Result<Value> {
    translated(image, pose, &[x_offset, y_offset, z_offset, x, y, z])
}

/// The pose moved by offsets along x, y, z, x and so on, as far as they are given.
fn translated(image: &Image, pose: &Value, offsets: &[Option<f64>]) -> Result<Value> {
    let mut placement = argument::placement(image, pose)?;
    for (at, offset) in offsets.iter().enumerate() {
        if let Some(offset) = offset {
            placement.position.0[at % 3] += offset;
        }
    }
    Ok(replaced(pose, placement))
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
    multiply_transform_stampeds,
    apply_transform,
    translate_pose,
    rotate_pose,
    translate_transform_stamped,
    poses_equal_p,
];
