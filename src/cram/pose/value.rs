//! The values: vectors, quaternions, poses and transforms, with or without frames.

use super::names;
use std::rc::Rc;

use nalgebra::{Quaternion as Hamilton, Translation3, UnitQuaternion};

use lisp::value::Value;
use lisp::value::copy::Copier;
use lisp::value::foreign::{Foreign, ForeignCopy, PrintContext};
use lisp::value::symbol::Sym;
use spatial;

/// Quaternions shorter than this stand for no rotation.
const MIN_QUATERNION: f64 = 1e-9;

/// A position or direction (m).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Vector3(pub [f64; 3]);

/// A quaternion x y z w as given.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Quaternion(pub [f64; 4]);

impl Quaternion {
    /// No rotation.
    pub(crate) const IDENTITY: Quaternion = Quaternion([0.0, 0.0, 0.0, 1.0]);

    /// Whether it is finite and long enough to stand for a rotation.
    pub fn is_rotation(&self) -> bool {
        let [x, y, z, w] = self.0;
        let norm = Hamilton::new(w, x, y, z).norm();
        norm.is_finite() && norm > MIN_QUATERNION
    }

    /// As a rotation; a quaternion that is too short is no rotation.
    pub fn rotation(&self) -> UnitQuaternion<f64> {
        let [x, y, z, w] = self.0;
        if self.is_rotation() {
            UnitQuaternion::from_quaternion(Hamilton::new(w, x, y, z))
        } else {
            UnitQuaternion::identity()
        }
    }

    /// The rotation's quaternion.
    pub fn of(rotation: &UnitQuaternion<f64>) -> Quaternion {
        let q = rotation.quaternion();
        Quaternion([q.i, q.j, q.k, q.w])
    }
}

/// A position and a quaternion as given.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Placement {
    /// The position (m).
    pub position: Vector3,
    /// The orientation.
    pub orientation: Quaternion,
}

impl Placement {
    /// At the origin, unrotated.
    pub(crate) const IDENTITY: Placement = Placement {
        position: Vector3([0.0; 3]),
        orientation: Quaternion::IDENTITY,
    };

    /// With another position or orientation.
    pub(crate) fn with(
        self,
        position: Option<Vector3>,
        orientation: Option<Quaternion>,
    ) -> Placement {
        Placement {
            position: position.unwrap_or(self.position),
            orientation: orientation.unwrap_or(self.orientation),
        }
    }

    /// As a rigid transform.
    pub fn to_pose(self) -> spatial::Pose {
        spatial::Pose::from_parts(
            Translation3::from(self.position.0),
            self.orientation.rotation(),
        )
    }

    /// The rigid transform's position and quaternion.
    pub fn of(pose: &spatial::Pose) -> Placement {
        let t = &pose.translation.vector;
        Placement {
            position: Vector3([t.x, t.y, t.z]),
            orientation: Quaternion::of(&pose.rotation),
        }
    }
}

/// A pose or transform without frames.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Unstamped {
    /// Whether it is a transform rather than a pose.
    pub(crate) is_transform: bool,
    /// Where.
    pub placement: Placement,
}

/// A pose in a frame.
#[derive(Clone, PartialEq, Debug)]
pub struct PoseStamped {
    /// The frame's name.
    pub frame: Rc<str>,
    /// Its time stamp (s of simulated time).
    pub stamp: f64,
    /// Where.
    pub placement: Placement,
}

/// A transform from a frame to a child frame.
#[derive(Clone, PartialEq, Debug)]
pub struct TransformStamped {
    /// The frame's name.
    pub frame: Rc<str>,
    /// The child frame's name.
    pub child: Rc<str>,
    /// Its time stamp (s of simulated time).
    pub stamp: f64,
    /// The pose of the child frame in the frame.
    pub placement: Placement,
}

impl TransformStamped {
    /// As a rigid transform.
    pub fn pose(&self) -> spatial::Pose {
        self.placement.to_pose()
    }
}

/// A 3D vector (m).
pub fn vector(xyz: [f64; 3]) -> Value {
    Value::foreign(Vector3(xyz))
}

/// A quaternion x y z w.
pub fn quaternion(xyzw: [f64; 4]) -> Value {
    Value::foreign(Quaternion(xyzw))
}

/// A pose without a frame.
pub fn pose(placement: Placement) -> Value {
    Value::foreign(Unstamped {
        is_transform: false,
        placement,
    })
}

/// A transform without frames.
pub fn transform(placement: Placement) -> Value {
    Value::foreign(Unstamped {
        is_transform: true,
        placement,
    })
}

/// A pose in a frame, at time 0.
pub fn pose_stamped(frame: &str, pose: &spatial::Pose) -> Value {
    pose_stamped_at(frame, 0.0, Placement::of(pose))
}

/// A pose in a frame at a time (s).
pub(crate) fn pose_stamped_at(
    frame: impl Into<Rc<str>>,
    stamp: f64,
    placement: Placement,
) -> Value {
    Value::foreign(PoseStamped {
        frame: frame.into(),
        stamp,
        placement,
    })
}

/// A transform from a frame to a child frame, at time 0.
pub fn transform_stamped(frame: &str, child: &str, pose: &spatial::Pose) -> Value {
    transform_stamped_at(frame, child, 0.0, Placement::of(pose))
}

/// A transform from a frame to a child frame at a time (s).
pub(crate) fn transform_stamped_at(
    frame: impl Into<Rc<str>>,
    child: impl Into<Rc<str>>,
    stamp: f64,
    placement: Placement,
) -> Value {
    Value::foreign(TransformStamped {
        frame: frame.into(),
        child: child.into(),
        stamp,
        placement,
    })
}

/// The pose in a frame, if the value is one.
pub(crate) fn as_pose_stamped(value: &Value) -> Option<PoseStamped> {
    value.as_foreign::<PoseStamped>().cloned()
}

/// The transform between frames, if the value is one.
pub(crate) fn as_transform_stamped(value: &Value) -> Option<TransformStamped> {
    value.as_foreign::<TransformStamped>().cloned()
}

/// Position and orientation of any pose or transform.
pub fn as_placement(value: &Value) -> Option<Placement> {
    if let Some(p) = value.as_foreign::<Unstamped>() {
        return Some(p.placement);
    }
    if let Some(p) = value.as_foreign::<PoseStamped>() {
        return Some(p.placement);
    }
    value.as_foreign::<TransformStamped>().map(|t| t.placement)
}

/// The frame of a stamped pose or transform.
pub fn frame_of(value: &Value) -> Option<Rc<str>> {
    if let Some(p) = value.as_foreign::<PoseStamped>() {
        return Some(p.frame.clone());
    }
    value
        .as_foreign::<TransformStamped>()
        .map(|t| t.frame.clone())
}

/// The vector, if the value is one.
pub fn as_vector(value: &Value) -> Option<[f64; 3]> {
    value.as_foreign::<Vector3>().map(|v| v.0)
}

/// The quaternion, if the value is one.
pub fn as_quaternion(value: &Value) -> Option<[f64; 4]> {
    value.as_foreign::<Quaternion>().map(|q| q.0)
}

/// `((x y z) (x y z w))` with five decimals, as stamped poses print.
fn short(placement: &Placement) -> String {
    let [x, y, z] = placement.position.0;
    let [a, b, c, d] = placement.orientation.0;
    format!("(({x:.5} {y:.5} {z:.5}) ({a:.5} {b:.5} {c:.5} {d:.5}))")
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

fn numbers(context: &dyn PrintContext, numbers: &[f64]) -> String {
    let shown: Vec<String> = numbers
        .iter()
        .map(|x| context.text(&Value::Double(*x), true))
        .collect();
    format!("({})", shown.join(" "))
}

impl Foreign for Vector3 {
    fn copied(&self, _: &mut Copier) -> ForeignCopy {
        ForeignCopy::Same
    }

    fn type_symbol(&self) -> Sym {
        names::VECTOR_3D
    }

    fn print(&self, context: &dyn PrintContext, _: bool) -> String {
        format!("#<3D-VECTOR {}>", numbers(context, &self.0))
    }

    fn is_equal(&self, other: &Value) -> bool {
        other.as_foreign::<Vector3>() == Some(self)
    }
}

impl Foreign for Quaternion {
    fn copied(&self, _: &mut Copier) -> ForeignCopy {
        ForeignCopy::Same
    }

    fn type_symbol(&self) -> Sym {
        names::QUATERNION
    }

    fn print(&self, context: &dyn PrintContext, _: bool) -> String {
        format!("#<QUATERNION {}>", numbers(context, &self.0))
    }

    fn is_equal(&self, other: &Value) -> bool {
        other.as_foreign::<Quaternion>() == Some(self)
    }
}

impl Foreign for Unstamped {
    fn copied(&self, _: &mut Copier) -> ForeignCopy {
        ForeignCopy::Same
    }

    fn type_symbol(&self) -> Sym {
        if self.is_transform {
            names::TRANSFORM
        } else {
            names::POSE
        }
    }

    fn print(&self, context: &dyn PrintContext, escape: bool) -> String {
        let kind = if self.is_transform {
            "TRANSFORM"
        } else {
            "POSE"
        };
        let position = self.placement.position.print(context, escape);
        let orientation = self.placement.orientation.print(context, escape);
        format!("#<{kind} \n   {position}\n   {orientation}>")
    }

    fn is_equal(&self, other: &Value) -> bool {
        other.as_foreign::<Unstamped>() == Some(self)
    }
}

impl Foreign for PoseStamped {
    fn copied(&self, _: &mut Copier) -> ForeignCopy {
        ForeignCopy::Same
    }

    fn type_symbol(&self) -> Sym {
        names::POSE_STAMPED
    }

    fn print(&self, _: &dyn PrintContext, _: bool) -> String {
        format!("#<{} {}>", quoted(&self.frame), short(&self.placement))
    }

    fn is_equal(&self, other: &Value) -> bool {
        other.as_foreign::<PoseStamped>() == Some(self)
    }
}

impl Foreign for TransformStamped {
    fn copied(&self, _: &mut Copier) -> ForeignCopy {
        ForeignCopy::Same
    }

    fn type_symbol(&self) -> Sym {
        names::TRANSFORM_STAMPED
    }

    fn print(&self, _: &dyn PrintContext, _: bool) -> String {
        let (frame, child) = (quoted(&self.frame), quoted(&self.child));
        format!("#<{frame} {child} {}>", short(&self.placement))
    }

    fn is_equal(&self, other: &Value) -> bool {
        other.as_foreign::<TransformStamped>() == Some(self)
    }
}
