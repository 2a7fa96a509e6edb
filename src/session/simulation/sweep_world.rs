//! The world of a sweep: fresh, filled, and described in the end.

use serde_json::Value as Json;

use super::Simulation;
use super::tally::Tally;
use robotics::motion::PushedObject;
use robotics::motion::{MotionFailure, UnreachableReason};
use sweep::Record;

impl Simulation {
    /// Resets everything to the start of a session with that seed. Simulated time continues.
    pub(crate) fn restart_with(&mut self, seed: u64) {
        self.seed = seed;
        self.noises = 0;
        self.go_home();
        self.restart();
        self.last_failure = None;
        self.last_account = None;
        self.tally = Tally::beginning(self.now);
    }

    /// A plan begins.
    pub(crate) fn begin_tally(&mut self) {
        self.tally = Tally::beginning(self.now);
    }

    /// The plan has ended, if it had not before.
    pub(crate) fn end_tally(&mut self) {
        let now = self.now;
        let began = self.tally.began;
        self.tally.took.get_or_insert(now - began);
        self.injection.borrow_mut().end();
    }

    /// Fills in what the world shows at the end.
    pub(crate) fn complete(&self, record: &mut Record) {
        record.time = self.tally.took.unwrap_or(0.0);
        record.steps = self.world.steps();
        record.distance = self.tally.distance;
        for (class, count) in &self.tally.failures {
            record.failures.set(class, *count);
        }
        record.faults = self.injection.borrow().struck();
        record.hash = format!("{:016x}", self.world.hash());
    }

    fn last_motion_failure(&self) -> Option<&MotionFailure> {
        self.last_failure.as_ref().map(|last| &last.failure)
    }

    /// The kind of the last failure of a motion, and of its reason if it has kinds of reasons.
    pub(crate) fn failed_by(&self) -> Option<String> {
        let json = serde_json::to_value(self.last_motion_failure()?).ok()?;
        let (kind, data) = variant(&json)?;
        let reason = data.and_then(|data| variant(data.get("reason")?));
        Some(match reason {
            Some((reason, _)) => format!("{kind} {reason}"),
            None => kind.to_owned(),
        })
    }

    /// The bodies that the last failure of a motion is about.
    pub(crate) fn bodies_of_failure(&self) -> Vec<String> {
        let Some(failure) = self.last_motion_failure() else {
            return Vec::new();
        };
        let hit = match failure {
            MotionFailure::PoseUnreachable(pose) => match &pose.reason {
                UnreachableReason::Collisions { hit, .. } => Some(hit),
                _ => None,
            },
            _ => failure.hit(),
        };
        match (hit, failure) {
            (Some(hit), _) => vec![hit.moving.to_string(), hit.other.to_string()],
            (None, MotionFailure::HeldObjectSlipped(slip)) => vec![slip.object.clone()],
            (None, MotionFailure::HeldObjectStuck(stuck)) => vec![stuck.object.clone()],
            (None, MotionFailure::ObjectPinned(pinned)) => vec![pinned.object.clone()],
            (None, MotionFailure::ObjectPushed(pushed)) => touching(pushed),
            (None, MotionFailure::DrivePushes { pushed, .. }) => touching(pushed),
            _ => Vec::new(),
        }
    }
}

/// The two that touch while the robot pushes an object.
fn touching(pushed: &PushedObject) -> Vec<String> {
    vec![pushed.by.to_string(), pushed.object.clone()]
}

/// The name of a variant and its data, as serde writes them.
fn variant(json: &Json) -> Option<(&str, Option<&Json>)> {
    match json {
        Json::String(name) => Some((name, None)),
        Json::Object(map) => map
            .iter()
            .next()
            .map(|(name, data)| (name.as_str(), Some(data))),
        _ => None,
    }
}
