//! Where joints are, as others tell it, in one message or in several.

use std::time::Duration;

use indexmap::IndexMap;
use thiserror::Error;

use crate::frames::seconds;
use crate::robot_clock::OVERTAKEN;
use crate::value::Value;

/// Why it is not known where a joint is.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum JointError {
    /// No joint at all was heard.
    #[error("no joint states have been heard")]
    Silent,
    /// What was heard of all joints is too old.
    #[error("no joint states for {:.1} s", .age.as_secs_f64())]
    Old {
        /// How long ago the last one was heard.
        age: Duration,
    },
    /// Others are heard, but not this one.
    #[error("the joint states lack {joint}")]
    Missing {
        /// The joint.
        joint: String,
    },
    /// It was heard, but not lately, while others are.
    #[error("the joint states have lacked {joint} for {:.1} s", .age.as_secs_f64())]
    Lacking {
        /// The joint.
        joint: String,
        /// How long ago it was heard last.
        age: Duration,
    },
    /// What was heard of it is no number.
    #[error("the joint states have no finite position of {joint}")]
    NotFinite {
        /// The joint.
        joint: String,
    },
    /// Names and positions are not equally many.
    #[error("the joint states have {positions} positions for {names} joints")]
    Lengths {
        /// Number of names.
        names: usize,
        /// Number of positions.
        positions: usize,
    },
}

/// Maximum number of joints that are kept.
const MAX_JOINTS: usize = 10_000;

/// What was heard of a joint.
#[derive(Clone, Copy, Debug)]
struct Heard {
    /// Where it is (rad or m), and how fast (rad/s or m/s) it moves, if that is told.
    position: f64,
    velocity: Option<f64>,
    /// The stamp (s) of the message; one whose stamp stands still is no news.
    stamp: f64,
    at: Duration,
}

/// Where joints are. Times are those of a clock that never jumps.
#[derive(Clone, Debug, Default)]
pub struct Joints {
    joints: IndexMap<String, Heard>,
    last: Option<Duration>,
    /// What was wrong with the last message.
    wrong: Option<JointError>,
}

impl Joints {
    /// Hears a message. Names come in any order, and a message need not have all of them.
    pub fn hear(&mut self, message: &Value, now: Duration) {
        let list = |name: &str| {
            let list = message.get(name).and_then(Value::as_list);
            list.unwrap_or_default()
        };
        let (names, positions, velocities) = (list("name"), list("position"), list("velocity"));
        if names.len() != positions.len() {
            self.wrong = Some(JointError::Lengths {
                names: names.len(),
                positions: positions.len(),
            });
            return;
        }
        self.wrong = None;
        let stamp = seconds(message.at(&["header", "stamp"]));
        for (number, (name, position)) in names.iter().zip(positions).enumerate() {
            let (Some(name), Some(position)) = (name.as_text(), position.as_float()) else {
                continue;
            };
            let known = self.joints.get(name);
            // What stands still is no news, and what was overtaken on its way tells of the past.
            let is_old = known.is_some_and(|known| {
                let is_overtaken = now.saturating_sub(known.at) < OVERTAKEN;
                stamp != 0.0 && (known.stamp == stamp || (stamp < known.stamp && is_overtaken))
            });
            let has_room = known.is_some() || self.joints.len() < MAX_JOINTS;
            if is_old || !has_room {
                continue;
            }
            let velocity = velocities.get(number).and_then(Value::as_float);
            let velocity = velocity.filter(|_| velocities.len() == names.len());
            // Without one, what has become of the position tells.
            let velocity = velocity
                .filter(|velocity| velocity.is_finite())
                .or_else(|| {
                    let known = known?;
                    let time = now.checked_sub(known.at)?.as_secs_f64();
                    (time > 0.0).then(|| (position - known.position) / time)
                });
            let heard = Heard {
                position,
                velocity,
                stamp,
                at: now,
            };
            self.joints.insert(name.to_owned(), heard);
            self.last = Some(now);
        }
    }

    /// The clock of the speakers has jumped: what was said before has no stamp that could be compared.
    pub fn forget_stamps(&mut self) {
        for heard in self.joints.values_mut() {
            heard.stamp = 0.0;
        }
    }

    /// Where a joint is (rad or m). It must have been heard within the last `max_age`.
    pub fn position(
        &self,
        joint: &str,
        max_age: Duration,
        now: Duration,
    ) -> Result<f64, JointError> {
        let missing = |joint: &str| JointError::Missing {
            joint: joint.to_owned(),
        };
        let Some(last) = self.last else {
            return Err(self.wrong.clone().unwrap_or(JointError::Silent));
        };
        let age = now.saturating_sub(last);
        if age > max_age {
            return Err(self.wrong.clone().unwrap_or(JointError::Old { age }));
        }
        let heard = self.joints.get(joint).ok_or_else(|| missing(joint))?;
        let age = now.saturating_sub(heard.at);
        if age > max_age {
            let joint = joint.to_owned();
            return Err(JointError::Lacking { joint, age });
        }
        match heard.position.is_finite() {
            true => Ok(heard.position),
            false => Err(JointError::NotFinite {
                joint: joint.to_owned(),
            }),
        }
    }

    /// How fast (rad/s or m/s) the fastest of some joints moves, as far as that was heard within the last `max_age`;
    /// `None` if nothing was heard.
    pub fn fastest<'a>(
        &self,
        joints: impl IntoIterator<Item = &'a str>,
        max_age: Duration,
        now: Duration,
    ) -> Option<f64> {
        let heard = joints
            .into_iter()
            .filter_map(|joint| self.joints.get(joint));
        let heard = heard.filter(|heard| now.saturating_sub(heard.at) <= max_age);
        // What is no number is not known to stand.
        let speed = |velocity: f64| match velocity.is_nan() {
            true => f64::INFINITY,
            false => velocity.abs(),
        };
        let velocities = heard.filter_map(|heard| Some(speed(heard.velocity?)));
        velocities.reduce(f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::message::header;

    fn message(stamp: f64, names: &[&str], positions: &[f64]) -> Value {
        Value::record([
            ("header", header(Duration::from_secs_f64(stamp), "")),
            ("name", Value::texts(names.iter().copied())),
            ("position", Value::floats(positions.iter().copied())),
        ])
    }

    const MAX_AGE: Duration = Duration::from_millis(500);

    fn ms(number: u64) -> Duration {
        Duration::from_millis(number)
    }

    fn at(joints: &Joints, joint: &str, now: u64) -> Result<f64, String> {
        let position = joints.position(joint, MAX_AGE, ms(now));
        position.map_err(|error| error.to_string())
    }

    fn wrong<T>(text: &str) -> Result<T, String> {
        Err(text.to_owned())
    }

    #[test]
    fn joints_are_heard_in_any_order_and_in_several_messages() {
        let mut joints = Joints::default();
        joints.hear(&message(1.0, &["a", "b"], &[1.0, 2.0]), ms(0));
        joints.hear(&message(1.0, &["c"], &[3.0]), ms(1));
        joints.hear(&message(1.1, &["b", "a"], &[2.5, 1.5]), ms(100));
        let all = ["a", "b", "c"].map(|joint| at(&joints, joint, 100));
        assert_eq!(all, [Ok(1.5), Ok(2.5), Ok(3.0)]);
        assert_eq!(joints.fastest(["a", "c"], MAX_AGE, ms(100)), Some(5.0));
    }

    #[test]
    fn a_message_that_was_overtaken_tells_of_the_past() {
        let mut joints = Joints::default();
        joints.hear(&message(2.0, &["a"], &[2.0]), ms(0));
        joints.hear(&message(1.5, &["a"], &[1.5]), ms(10));
        assert_eq!(at(&joints, "a", 10), Ok(2.0));
        // Unless nothing else is told: then it is the clock that was set back, of which may also be told.
        joints.hear(&message(1.6, &["a"], &[1.6]), ms(320));
        assert_eq!(at(&joints, "a", 320), Ok(1.6));
        joints.forget_stamps();
        joints.hear(&message(0.5, &["a"], &[0.5]), ms(330));
        assert_eq!(at(&joints, "a", 330), Ok(0.5));
        // One without a stamp counts when it is heard.
        joints.hear(&message(0.0, &["a"], &[0.1]), ms(340));
        assert_eq!(at(&joints, "a", 340), Ok(0.1));
    }

    #[test]
    fn what_is_not_known_has_a_reason() {
        let mut joints = Joints::default();
        assert_eq!(
            at(&joints, "a", 0),
            wrong("no joint states have been heard")
        );
        joints.hear(&message(1.0, &["a", "b"], &[1.0, f64::NAN]), ms(0));
        assert_eq!(at(&joints, "c", 0), wrong("the joint states lack c"));
        assert_eq!(
            at(&joints, "b", 0),
            wrong("the joint states have no finite position of b")
        );
        assert_eq!(at(&joints, "a", 700), wrong("no joint states for 0.7 s"));
        // The same message again is no news, and one of others does not help.
        joints.hear(&message(1.0, &["a", "b"], &[1.0, 1.0]), ms(700));
        assert_eq!(at(&joints, "a", 700), wrong("no joint states for 0.7 s"));
        joints.hear(&message(1.1, &["b"], &[1.0]), ms(700));
        assert_eq!(
            at(&joints, "a", 700),
            wrong("the joint states have lacked a for 0.7 s")
        );
        joints.hear(&message(2.0, &["a", "b"], &[1.0]), ms(2000));
        assert_eq!(
            at(&joints, "a", 2000),
            wrong("the joint states have 1 positions for 2 joints")
        );
    }
}
