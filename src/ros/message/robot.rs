//! Joints and frames of the robot, and time.

use std::time::Duration;

use super::{header, time, transform};
use crate::scene_state::{SceneModel, SceneState};
use crate::value::Value;
use nalgebra::Isometry3;
use spatial::Pose;

/// A text, such as the description of a robot.
pub fn text(text: &str) -> Value {
    Value::record([("data", text.into())])
}

/// What the clock of all nodes shows.
pub fn clock(now: Duration) -> Value {
    Value::record([("clock", time(now))])
}

/// All joints with their positions and velocities; without these, they stand still.
pub fn joint_states(
    stamp: Duration,
    names: &[String],
    positions: &[f64],
    velocities: Option<&[f64]>,
) -> Value {
    let still = vec![0.0; positions.len()];
    let velocities = velocities.filter(|velocities| velocities.len() == positions.len());
    let velocities = velocities.unwrap_or(&still).iter().copied();
    Value::record([
        ("header", header(stamp, "")),
        ("name", Value::texts(names.iter().cloned())),
        ("position", Value::floats(positions.iter().copied())),
        ("velocity", Value::floats(velocities)),
    ])
}

/// The frames that move: that of the robot, and those of its links behind joints that can move.
pub fn moving_frames(stamp: Duration, model: &SceneModel, state: &SceneState) -> Value {
    let base = frame(stamp, &model.odometry, &model.base, &state.base);
    let frames = model.frames.iter().zip(&state.poses);
    let frames = frames.map(|((parent, child), pose)| frame(stamp, parent, child, pose));
    transforms(std::iter::once(base).chain(frames))
}

/// The frames that never move.
pub fn still_frames(stamp: Duration, model: &SceneModel) -> Value {
    let odometry = (model.odometry != model.map)
        .then(|| frame(stamp, model.map, &model.odometry, &Isometry3::identity()));
    let fixed = model.fixed.iter();
    let fixed = fixed.map(|(parent, child, pose)| frame(stamp, parent, child, pose));
    transforms(odometry.into_iter().chain(fixed))
}

fn transforms(frames: impl IntoIterator<Item = Value>) -> Value {
    Value::record([("transforms", Value::list(frames))])
}

fn frame(stamp: Duration, parent: &str, child: &str, pose: &Pose) -> Value {
    Value::record([
        ("header", header(stamp, parent)),
        ("child_frame_id", child.into()),
        ("transform", transform(pose)),
    ])
}
