//! The messages that a session sends.

mod camera;
mod marker;
mod robot;

pub use camera::{camera_info, image};
pub use marker::{furniture_markers, object_markers};
pub use robot::{clock, joint_states, moving_frames, still_frames, text};

use std::time::Duration;

use crate::value::Value;
use spatial::Pose;

/// A time since 1970, as a message.
pub fn time(time: Duration) -> Value {
    Value::record([
        (
            "sec",
            Value::Integer(time.as_secs().min(i32::MAX as u64) as i64),
        ),
        ("nanosec", Value::Integer(i64::from(time.subsec_nanos()))),
    ])
}

/// A header: when, and in which frame.
pub fn header(stamp: Duration, frame: &str) -> Value {
    Value::record([("stamp", time(stamp)), ("frame_id", frame.into())])
}

/// A pose as a message.
pub fn pose(pose: &Pose) -> Value {
    let at = pose.translation.vector;
    Value::record([
        ("position", xyz([at.x, at.y, at.z])),
        ("orientation", quaternion(pose)),
    ])
}

/// A transform as a message.
fn transform(pose: &Pose) -> Value {
    let at = pose.translation.vector;
    Value::record([
        ("translation", xyz([at.x, at.y, at.z])),
        ("rotation", quaternion(pose)),
    ])
}

/// A point or a vector.
fn xyz([x, y, z]: [f64; 3]) -> Value {
    Value::record([("x", x.into()), ("y", y.into()), ("z", z.into())])
}

fn quaternion(pose: &Pose) -> Value {
    let q = pose.rotation.coords;
    Value::record([
        ("x", q.x.into()),
        ("y", q.y.into()),
        ("z", q.z.into()),
        ("w", q.w.into()),
    ])
}
