//! Where frames are, as others tell it by transforms.
//!
//! Speakers may lie: numbers that are none, rotations of length zero, two parents, circles, silence. Nothing of that
//! becomes a pose; the question for a pose has the reason as its answer.

use std::time::Duration;

use indexmap::IndexMap;
use thiserror::Error;

use crate::robot_clock::OVERTAKEN;
use crate::value::Value;
use spatial::Pose;

/// Why it is not known where a frame is.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum FrameError {
    /// Nothing was heard of it.
    #[error("no transform of {frame} has been heard")]
    Unknown {
        /// The frame.
        frame: String,
    },
    /// What was heard is too old.
    #[error("no transform of {frame} for {:.1} s", .age.as_secs_f64())]
    Old {
        /// The frame.
        frame: String,
        /// How long ago it was heard last.
        age: Duration,
    },
    /// What was heard is no transform.
    #[error("the transform of {frame} is none: {wrong}")]
    Wrong {
        /// The frame.
        frame: String,
        /// What is wrong.
        wrong: &'static str,
    },
    /// It hangs on other frames than the one in which it was to be.
    #[error("{frame} hangs on {root}, not on {wanted}")]
    Apart {
        /// The frame.
        frame: String,
        /// The last frame on which it hangs.
        root: String,
        /// The frame that was wanted.
        wanted: String,
    },
    /// Frames hang on each other in a circle.
    #[error("{frame} is in a circle of frames")]
    Circle {
        /// One of them.
        frame: String,
    },
    /// Two speakers disagree on what a frame hangs on.
    #[error("{frame} has two parents: {first} and {second}")]
    TwoParents {
        /// The frame.
        frame: String,
        /// What it hangs on.
        first: String,
        /// What it hangs on, too.
        second: String,
    },
}

/// Maximum number of frames that are kept.
const MAX_FRAMES: usize = 10_000;
/// How long a speaker may be silent until another parent is believed.
const OTHER_PARENT: Duration = Duration::from_secs(1);

#[derive(Clone, Debug)]
struct Edge {
    parent: String,
    pose: Result<Pose, &'static str>,
    /// The stamp (s); a moving frame whose stamp stands still was not heard anew.
    stamp: f64,
    heard: Duration,
    is_still: bool,
    /// Another parent, and when it was heard.
    other: Option<(String, Duration)>,
}

/// Frames in which others are. Times are those of a clock that never jumps.
#[derive(Clone, Debug, Default)]
pub struct Frames {
    edges: IndexMap<String, Edge>,
}

impl Frames {
    /// Hears a message of transforms; those of still frames hold until there are others.
    pub fn hear(&mut self, message: &Value, is_still: bool, now: Duration) {
        let transforms = message.get("transforms").and_then(Value::as_list);
        for transform in transforms.unwrap_or_default() {
            let text = |path: &[&str]| {
                let text = transform.at(path).and_then(Value::as_text);
                text.map(|text| text.trim_start_matches('/').to_owned())
            };
            let (Some(child), Some(parent)) =
                (text(&["child_frame_id"]), text(&["header", "frame_id"]))
            else {
                continue;
            };
            let stamp = seconds(transform.at(&["header", "stamp"]));
            let pose = pose(transform.get("transform"));
            self.note(child, parent, pose, stamp, is_still, now);
        }
    }

    fn note(
        &mut self,
        child: String,
        parent: String,
        pose: Result<Pose, &'static str>,
        stamp: f64,
        is_still: bool,
        now: Duration,
    ) {
        if let Some(edge) = self.edges.get_mut(&child) {
            let is_fresh = now.saturating_sub(edge.heard) < OTHER_PARENT || edge.is_still;
            if edge.parent != parent && is_fresh {
                edge.other = Some((parent, now));
                return;
            }
            // What stands still is no news, and what was overtaken on its way tells of the past.
            let is_overtaken =
                stamp < edge.stamp && now.saturating_sub(edge.heard) < OVERTAKEN && !edge.is_still;
            let is_old = stamp == edge.stamp || is_overtaken;
            if !is_still && stamp != 0.0 && is_old && edge.parent == parent {
                return;
            }
        } else if self.edges.len() >= MAX_FRAMES {
            return;
        }
        let other = self.edges.get(&child).and_then(|edge| edge.other.clone());
        let other = other.filter(|(_, heard)| now.saturating_sub(*heard) < OTHER_PARENT);
        let edge = Edge {
            parent,
            pose,
            stamp,
            heard: now,
            is_still,
            other,
        };
        self.edges.insert(child, edge);
    }

    /// Forgets what moves: the clock of the speakers has jumped.
    pub fn forget_moving(&mut self) {
        self.edges.retain(|_, edge| edge.is_still);
    }

    /// The pose of a frame in another one, on which it hangs. Transforms of moving frames must have been heard within
    /// the last `max_age`.
    pub fn pose(
        &self,
        frame: &str,
        within: &str,
        max_age: Duration,
        now: Duration,
    ) -> Result<Pose, FrameError> {
        let mut at = frame.trim_start_matches('/').to_owned();
        let mut pose = Pose::identity();
        for _ in 0..=self.edges.len() {
            if at == within.trim_start_matches('/') {
                return Ok(pose);
            }
            let Some(edge) = self.edges.get(&at) else {
                return Err(match at == frame {
                    true => FrameError::Unknown { frame: at },
                    false => FrameError::Apart {
                        frame: frame.to_owned(),
                        root: at,
                        wanted: within.to_owned(),
                    },
                });
            };
            let age = now.saturating_sub(edge.heard);
            if !edge.is_still && age > max_age {
                return Err(FrameError::Old { frame: at, age });
            }
            if let Some((second, heard)) = &edge.other
                && now.saturating_sub(*heard) < OTHER_PARENT
            {
                return Err(FrameError::TwoParents {
                    frame: at,
                    first: edge.parent.clone(),
                    second: second.clone(),
                });
            }
            let step = edge.pose.map_err(|wrong| FrameError::Wrong {
                frame: at.clone(),
                wrong,
            })?;
            pose = step * pose;
            at.clone_from(&edge.parent);
        }
        let frame = frame.to_owned();
        Err(FrameError::Circle { frame })
    }
}

/// A transform as a pose.
fn pose(transform: Option<&Value>) -> Result<Pose, &'static str> {
    let number = |part: &str, axis: &str| {
        let number = transform.and_then(|t| t.at(&[part, axis]).and_then(Value::as_float));
        number
            .filter(|number| number.is_finite())
            .ok_or("it has a number that is not finite")
    };
    let at = |axis| number("translation", axis);
    let turn = |axis| number("rotation", axis);
    let position = [at("x")?, at("y")?, at("z")?];
    let turn = [turn("x")?, turn("y")?, turn("z")?, turn("w")?];
    let pose = spatial::pose::from_xyz_quaternion(position, turn);
    pose.ok_or("its rotation has the length zero")
}

/// The seconds of a time.
pub fn seconds(time: Option<&Value>) -> f64 {
    let part = |name| time.and_then(|time| time.get(name)?.as_float());
    part("sec").unwrap_or_default() + part("nanosec").unwrap_or_default() * 1e-9
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::message;

    const SECOND: Duration = Duration::from_secs(1);

    fn transform(parent: &str, child: &str, x: f64, stamp: f64) -> Value {
        let stamp = Duration::from_secs_f64(stamp);
        let pose = message::pose(&Pose::translation(x, 0.0, 0.0));
        let transform = Value::record([
            ("translation", pose.get("position").cloned().unwrap()),
            ("rotation", pose.get("orientation").cloned().unwrap()),
        ]);
        let transform = Value::record([
            ("header", message::header(stamp, parent)),
            ("child_frame_id", child.into()),
            ("transform", transform),
        ]);
        Value::record([("transforms", Value::list([transform]))])
    }

    fn x(pose: Result<Pose, FrameError>) -> Result<f64, String> {
        pose.map(|pose| pose.translation.x)
            .map_err(|e| e.to_string())
    }

    #[test]
    fn poses_are_put_together_along_the_parents() {
        let mut frames = Frames::default();
        let now = SECOND;
        frames.hear(&transform("map", "/odom", 1.0, 0.0), true, now);
        frames.hear(&transform("odom", "base", 2.0, 5.0), false, now);
        assert_eq!(x(frames.pose("base", "map", SECOND, now)), Ok(3.0));
        assert_eq!(x(frames.pose("base", "odom", SECOND, now)), Ok(2.0));
        assert_eq!(x(frames.pose("map", "map", SECOND, now)), Ok(0.0));
    }

    #[test]
    fn a_transform_that_was_overtaken_tells_of_the_past() {
        let mut frames = Frames::default();
        let ms = Duration::from_millis;
        let at = |frames: &Frames, now| x(frames.pose("base", "map", SECOND, ms(now)));
        frames.hear(&transform("map", "base", 2.0, 5.0), false, ms(0));
        frames.hear(&transform("map", "base", 1.0, 4.0), false, ms(10));
        assert_eq!(at(&frames, 10), Ok(2.0));
        // Unless nothing else is told: then it is the clock that was set back.
        frames.hear(&transform("map", "base", 1.5, 4.5), false, ms(320));
        assert_eq!(at(&frames, 320), Ok(1.5));
    }

    #[test]
    fn what_is_not_known_has_a_reason() {
        let mut frames = Frames::default();
        let now = SECOND;
        let wrong = |frames: &Frames, now| x(frames.pose("base", "map", SECOND, now)).unwrap_err();
        assert_eq!(wrong(&frames, now), "no transform of base has been heard");
        frames.hear(&transform("odom", "base", 2.0, 5.0), false, now);
        assert_eq!(wrong(&frames, now), "base hangs on odom, not on map");
        frames.hear(&transform("base", "odom", 2.0, 5.0), false, now);
        assert_eq!(wrong(&frames, now), "base is in a circle of frames");
        let mut frames = Frames::default();
        frames.hear(&transform("map", "base", 2.0, 5.0), false, now);
        assert_eq!(wrong(&frames, 3 * SECOND), "no transform of base for 2.0 s");
        // The same message again is no news.
        frames.hear(&transform("map", "base", 2.0, 5.0), false, 3 * SECOND);
        assert_eq!(wrong(&frames, 3 * SECOND), "no transform of base for 2.0 s");
        frames.hear(&transform("map", "base", f64::NAN, 6.0), false, 3 * SECOND);
        assert_eq!(
            wrong(&frames, 3 * SECOND),
            "the transform of base is none: it has a number that is not finite"
        );
        frames.hear(&transform("map", "base", 2.0, 7.0), false, 3 * SECOND);
        frames.hear(&transform("elsewhere", "base", 2.0, 7.0), false, 3 * SECOND);
        assert_eq!(
            wrong(&frames, 3 * SECOND),
            "base has two parents: map and elsewhere"
        );
    }

    #[test]
    fn a_rotation_of_length_zero_is_none() {
        let zero = || {
            Value::record([
                ("x", 0.0.into()),
                ("y", 0.0.into()),
                ("z", 0.0.into()),
                ("w", 0.0.into()),
            ])
        };
        let transform = Value::record([("translation", zero()), ("rotation", zero())]);
        assert_eq!(
            pose(Some(&transform)),
            Err("its rotation has the length zero")
        );
        assert!(pose(None).is_err());
    }
}
