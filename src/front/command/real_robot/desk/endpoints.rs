//! What is said to and heard of a robot: a node, the clients of its actions, and the topics by which it tells of itself.
//!
//! What arrives garbled with a checksum that fits can leave the library of DDS waiting for what will never come, as it can
//! its threads. So a robot that is not heard any more is looked for once more, by a node that begins anew.

use std::sync::mpsc::channel;
use std::thread;
use std::time::Duration;

use super::super::super::ros2::{open_node, warn};
use super::super::goal_message::action_of;
use super::{Desk, Part};
use robotics::robot::{PartInterface, RobotInterface};
use ros::service_type;
use ros::wire::{ActionClient, Node, NodeError, ServiceClient, TopicQos, TopicReader};

/// How long a robot that was heard may be silent, while nothing is under way, until it is looked for once more; if that does
/// not help, after a time that is twice as long each time.
const SILENT: Duration = Duration::from_secs(5);
const MOST: Duration = Duration::from_secs(300);
/// How long the library may take to say that a node is gone.
pub(super) const LEAVING: Duration = Duration::from_secs(1);

/// What is said to and heard of a robot.
pub(in super::super) struct Endpoints {
    /// Speaks last.
    pub(super) parts: Vec<Part>,
    pub(super) perception: ServiceClient,
    pub(super) transforms: TopicReader,
    pub(super) still_transforms: TopicReader,
    pub(super) joint_states: Vec<TopicReader>,
    _node: Node,
}

impl Endpoints {
    pub(in super::super) fn open(
        mut node: Node,
        interface: &RobotInterface,
        parts: &[PartInterface],
    ) -> Result<Self, NodeError> {
        let clients = parts.iter().map(|interface| {
            let action = action_of(interface.part);
            let client = ActionClient::open(&mut node, &interface.name, action)?;
            Ok(Part {
                interface: interface.clone(),
                client,
            })
        });
        let parts = clients.collect::<Result<Vec<_>, NodeError>>()?;
        let [request, response] = service_type("planwright_msgs/srv/DetectObjects");
        let perception = node.client(&interface.perception, request, response)?;
        let tf = "tf2_msgs/msg/TFMessage";
        let joints = "sensor_msgs/msg/JointState";
        // Where the robot is now counts, not where it was: what is lost is not waited for. Some robots send it so, too.
        let transforms = node.reader("/tf", tf, TopicQos::best_effort(100))?;
        let still = TopicQos {
            depth: 100,
            ..TopicQos::latched()
        };
        let still_transforms = node.reader("/tf_static", tf, still)?;
        let topics = interface.joint_states.iter();
        let joint_states =
            topics.map(|topic| node.reader(topic, joints, TopicQos::best_effort(50)));
        Ok(Self {
            parts,
            perception,
            transforms,
            still_transforms,
            joint_states: joint_states.collect::<Result<_, _>>()?,
            _node: node,
        })
    }

    /// Lets the library say that the node is gone. A thread of its own waits for that: one of the library's that has
    /// failed may never end.
    pub(super) fn leave(self, most: Duration) {
        let (gone, is_gone) = channel();
        let leave = move || {
            drop(self);
            let _ = gone.send(());
        };
        let leaving = thread::Builder::new().name("leaving".to_owned());
        if leaving.spawn(leave).is_ok() {
            // What is not said in time is not said.
            let _ = is_gone.recv_timeout(most);
        }
    }
}

/// When the robot was heard, and when it was looked for once more.
#[derive(Debug, Default)]
pub(super) struct Search {
    pub(super) joints: Option<Duration>,
    pub(super) frames: Option<Duration>,
    /// A goal or a question got no answer from a server that is there.
    pub(super) is_unanswered: bool,
    /// When it was looked for last, and how long to wait until it is once more.
    last: Duration,
    pause: Duration,
}

impl Search {
    /// Whether the robot is to be looked for once more: it was heard and is not any more, or does not answer.
    fn is_due(&self, now: Duration) -> bool {
        let silent =
            |heard: Option<Duration>| heard.is_some_and(|heard| now.saturating_sub(heard) > SILENT);
        let is_wanted = self.is_unanswered || silent(self.joints) || silent(self.frames);
        is_wanted && now.saturating_sub(self.last) > self.pause.max(SILENT)
    }

    /// It was looked for.
    fn looked(&mut self, now: Duration) {
        let heard = [self.joints, self.frames].into_iter().flatten().max();
        // Twice as long as before, unless that has helped.
        let has_helped = heard.is_some_and(|heard| heard > self.last + SILENT);
        self.pause = match has_helped {
            true => SILENT,
            false => (self.pause * 2).clamp(SILENT, MOST),
        };
        self.last = now;
        self.is_unanswered = false;
    }
}

impl Desk {
    /// Looks for a robot once more that is not heard any more, while it has nothing to do. Goals that were given up are
    /// still cancelled by the node that has sent them.
    pub(super) fn search(&mut self, now: Duration) {
        for retired in &mut self.retired {
            for part in &mut retired.parts {
                part.client.poll(now);
            }
        }
        let is_over = |ends: &mut Endpoints| ends.parts.iter().all(|part| part.client.is_idle());
        for retired in self.retired.extract_if(.., is_over) {
            retired.leave(Duration::ZERO);
        }
        let is_busy =
            !self.waiting.is_empty() || !self.running.is_empty() || !self.questions.is_empty();
        if is_busy || self.may_run() || !self.search.is_due(now) {
            return;
        }
        self.search.looked(now);
        let parts = self.ends.parts.iter();
        let parts: Vec<PartInterface> = parts.map(|part| part.interface.clone()).collect();
        let opened = open_node("planwright_plan", &self.distribution)
            .map_err(|error| error.to_string())
            .and_then(|(node, _)| {
                Endpoints::open(node, &self.interface, &parts).map_err(|error| error.to_string())
            });
        match opened {
            Ok(ends) => {
                let old = std::mem::replace(&mut self.ends, ends);
                match old.parts.iter().all(|it| it.client.is_idle()) {
                    true => old.leave(Duration::ZERO),
                    false => self.retired.push(old),
                }
                warn("the robot is not heard, or does not answer: it is looked for once more");
            }
            Err(error) => warn(&format!(
                "the robot cannot be looked for once more: {error}"
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Duration = Duration::from_secs(1);

    #[test]
    fn a_robot_that_falls_silent_is_looked_for_more_and_more_seldom() {
        let mut search = Search::default();
        // One that was never heard may not be there.
        assert!(!search.is_due(SECOND * 100));
        (search.joints, search.frames) = (Some(SECOND * 100), Some(SECOND * 100));
        let mut looks = Vec::new();
        for second in 100..200 {
            if search.is_due(SECOND * second) {
                search.looked(SECOND * second);
                looks.push(second);
            }
        }
        assert_eq!(looks, [106, 112, 123, 144, 185]);
        // It was heard again, but not all of it.
        (search.joints, search.frames) = (Some(SECOND * 250), Some(SECOND * 220));
        assert!(search.is_due(SECOND * 300));
        search.looked(SECOND * 300);
        assert!(!search.is_due(SECOND * 305) && search.is_due(SECOND * 306));
    }

    #[test]
    fn a_robot_that_does_not_answer_is_looked_for_once() {
        let mut search = Search::default();
        (search.joints, search.frames) = (Some(SECOND * 10), Some(SECOND * 10));
        search.is_unanswered = true;
        assert!(search.is_due(SECOND * 10));
        search.looked(SECOND * 10);
        assert!(!search.is_due(SECOND * 11));
    }
}
