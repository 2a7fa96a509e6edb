//! An action that a node offers: three services and two topics.

use std::time::{Duration, SystemTime, UNIX_EPOCH};

use super::node::{Node, NodeError, TopicQos, TopicWriter};
use super::service::{RequestId, Service};
use crate::action::{GoalEnd, GoalId, Goals, ResultRequest};
use crate::names::action_type;
use crate::value::Value;

/// What clients want of an action.
#[derive(Clone, Debug, PartialEq)]
pub enum Wish {
    /// Carry out a goal, which has been accepted.
    Begin(GoalId, Value),
    /// Let a goal end.
    Cancel(GoalId),
}

/// An action that a node offers.
pub struct ActionServer {
    send_goal: Service,
    cancel_goal: Service,
    get_result: Service,
    feedback: TopicWriter,
    status: TopicWriter,
    goals: Goals,
    /// Who waits for the result of which goal.
    waiting: Vec<(GoalId, RequestId)>,
}

/// Maximum number of requests for results that wait.
const MAX_WAITING: usize = 1024;

impl ActionServer {
    /// Offers an action `PACKAGE/action/NAME` under a name.
    pub fn open(node: &mut Node, name: &str, action: &str) -> Result<Self, NodeError> {
        let inner = |part: &str| format!("{name}/_action/{part}");
        let types = |part: &str| {
            ["Request", "Response"].map(|end| action_type(action, &format!("{part}_{end}")))
        };
        let [goal_request, goal_response] = types("SendGoal");
        let [result_request, result_response] = types("GetResult");
        let cancel = "action_msgs/srv/CancelGoal";
        let [cancel_request, cancel_response] = crate::service_type(cancel);
        let server = Self {
            send_goal: node.service(&inner("send_goal"), goal_request, goal_response)?,
            cancel_goal: node.service(&inner("cancel_goal"), cancel_request, cancel_response)?,
            get_result: node.service(&inner("get_result"), result_request, result_response)?,
            feedback: node.writer(
                &inner("feedback"),
                &action_type(action, "FeedbackMessage"),
                TopicQos::volatile(10),
            )?,
            status: node.writer(
                &inner("status"),
                "action_msgs/msg/GoalStatusArray",
                TopicQos::latched(),
            )?,
            goals: Goals::default(),
            waiting: Vec::new(),
        };
        server.tell_status();
        Ok(server)
    }

    /// Answers what clients have asked since the last time, and returns what they want. `fits` tells whether a goal
    /// can be one; others are rejected.
    pub fn poll(&mut self, mut fits: impl FnMut(&Value) -> bool) -> Vec<Wish> {
        let mut wishes = Vec::new();
        while let Some((request, value)) = self.send_goal.take() {
            let goal = value.get("goal").cloned();
            let goal = goal.filter(|goal| fits(goal));
            let accepted = goal.zip(goal_id(&value));
            let now = now();
            let accepted = accepted.filter(|(_, id)| self.goals.accept(*id, now));
            let answer = Value::record([
                ("accepted", accepted.is_some().into()),
                ("stamp", crate::message::time(now)),
            ]);
            self.send_goal.reply(request, &answer);
            if let Some((goal, id)) = accepted {
                self.tell_status();
                wishes.push(Wish::Begin(id, goal));
            }
        }
        while let Some((request, value)) = self.cancel_goal.take() {
            let info = value.get("goal_info");
            let id = info.and_then(goal_id).unwrap_or_default();
            let up_to = info.and_then(|info| info.get("stamp")).map(time);
            let canceling = self.goals.cancel(id, up_to.unwrap_or_default());
            self.cancel_goal.reply(request, &canceling.answer);
            self.tell_status();
            wishes.extend(canceling.goals.into_iter().map(Wish::Cancel));
        }
        while let Some((request, value)) = self.get_result.take() {
            let id = goal_id(&value).unwrap_or_default();
            match self.goals.result(&id) {
                ResultRequest::Answer(answer) => drop(self.get_result.reply(request, &answer)),
                ResultRequest::Later if self.waiting.len() < MAX_WAITING => {
                    self.waiting.push((id, request));
                }
                ResultRequest::Later => {}
            }
        }
        wishes
    }

    /// A goal is carried out from now on.
    pub fn begin(&mut self, id: &GoalId) {
        self.goals.begin(id);
        self.tell_status();
    }

    /// Tells how far a goal is.
    pub fn feedback(&self, id: &GoalId, feedback: Value) {
        let message = Value::record([
            (
                "goal_id",
                Value::record([("uuid", Value::Bytes(id.to_vec()))]),
            ),
            ("feedback", feedback),
        ]);
        // The next one comes soon.
        drop(self.feedback.send(&message));
    }

    /// A goal has ended: who waits for its result gets it.
    pub fn end(&mut self, id: &GoalId, end: GoalEnd, result: Value) {
        if !self.goals.end(id, end, result) {
            return;
        }
        self.tell_status();
        let ResultRequest::Answer(answer) = self.goals.result(id) else {
            return;
        };
        let service = &self.get_result;
        self.waiting.retain(|(waiting, request)| {
            if waiting == id {
                service.reply(*request, &answer);
            }
            waiting != id
        });
    }

    fn tell_status(&self) {
        // Who misses one gets the next one, or asks for the result.
        drop(self.status.send(&self.goals.status()));
    }
}

fn goal_id(value: &Value) -> Option<GoalId> {
    let bytes = value.at(&["goal_id", "uuid"]).and_then(Value::as_bytes);
    bytes.and_then(|bytes| bytes.try_into().ok())
}

/// A time as a message, since 1970; earlier ones are that.
fn time(value: &Value) -> Duration {
    let number = |name: &str| value.get(name).and_then(Value::as_integer).unwrap_or(0);
    let nanoseconds = u32::try_from(number("nanosec"))
        .unwrap_or(0)
        .min(999_999_999);
    Duration::new(u64::try_from(number("sec")).unwrap_or(0), nanoseconds)
}

fn now() -> Duration {
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    now.unwrap_or_default()
}
