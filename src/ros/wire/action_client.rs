//! An action that others offer: three services and two topics.

use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use super::node::{Node, NodeError, TopicQos};
use super::service_client::{Answer, Sequence, ServiceClient};
use super::topic_reader::TopicReader;
use crate::action::{Ask, ClientEnd, ClientGoal, GoalId, Patience};
use crate::names::action_type;
use crate::value::Value;

/// Numbers of goals of this process.
static NUMBER: AtomicU32 = AtomicU32::new(0);

/// A goal that has been sent or is to be.
struct Sent {
    id: GoalId,
    value: Value,
    goal: ClientGoal,
    /// Requests that wait for an answer.
    goals: Vec<Sequence>,
    results: Vec<Sequence>,
}

/// An action that others offer. Times are those of a clock that never jumps.
pub struct ActionClient {
    name: String,
    identity: [u8; 8],
    send_goal: ServiceClient,
    cancel_goal: ServiceClient,
    get_result: ServiceClient,
    feedback: TopicReader,
    status: TopicReader,
    sent: Vec<Sent>,
    /// How many servers there were when they were last counted, and since when.
    counted: (usize, Duration),
    /// Answers that nobody has asked for.
    oddities: u64,
}

impl ActionClient {
    /// A client of an action `PACKAGE/action/NAME` of a name.
    pub fn open(node: &mut Node, name: &str, action: &str) -> Result<Self, NodeError> {
        let inner = |part: &str| format!("{name}/_action/{part}");
        let types = |part: &str| {
            ["Request", "Response"].map(|end| action_type(action, &format!("{part}_{end}")))
        };
        let [goal_request, goal_response] = types("SendGoal");
        let [result_request, result_response] = types("GetResult");
        let [cancel_request, cancel_response] = crate::service_type("action_msgs/srv/CancelGoal");
        let feedback = action_type(action, "FeedbackMessage");
        Ok(Self {
            name: name.to_owned(),
            identity: node.identity(),
            send_goal: node.client(&inner("send_goal"), goal_request, goal_response)?,
            cancel_goal: node.client(&inner("cancel_goal"), cancel_request, cancel_response)?,
            get_result: node.client(&inner("get_result"), result_request, result_response)?,
            feedback: node.reader(&inner("feedback"), &feedback, TopicQos::volatile(10))?,
            status: node.reader(
                &inner("status"),
                "action_msgs/msg/GoalStatusArray",
                TopicQos::latched(),
            )?,
            sent: Vec::new(),
            counted: (0, Duration::ZERO),
            oddities: 0,
        })
    }

    /// The name of the action.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether a server is there, with all that a goal needs.
    pub fn is_served(&self) -> bool {
        // All of them, so that each learns who is there.
        let services = [&self.send_goal, &self.cancel_goal, &self.get_result];
        services.map(ServiceClient::is_served) == [true; 3]
    }

    /// How many servers there are, with all that a goal needs.
    fn servers(&self) -> usize {
        let services = [&self.send_goal, &self.cancel_goal, &self.get_result];
        let servers = services.map(ServiceClient::servers);
        match servers.contains(&0) {
            true => 0,
            false => servers.into_iter().max().unwrap_or(0),
        }
    }

    /// How many servers there were when it was last polled, and since when. Servers that were there before this client
    /// are found one after the other.
    pub fn counted(&self) -> (usize, Duration) {
        self.counted
    }

    /// Whether the server has accepted a goal, or it has ended already.
    pub fn is_accepted(&self, id: &GoalId) -> bool {
        let sent = self.sent.iter().find(|sent| sent.id == *id);
        sent.is_none_or(|sent| sent.goal.is_accepted())
    }

    /// Sends a goal as soon as there is a server.
    pub fn send(&mut self, value: Value, patience: Patience, now: Duration) -> GoalId {
        let id = self.fresh_id();
        self.sent.push(Sent {
            id,
            value,
            goal: ClientGoal::new(patience, now),
            goals: Vec::new(),
            results: Vec::new(),
        });
        id
    }

    /// Lets a goal end.
    pub fn cancel(&mut self, id: &GoalId, now: Duration) {
        for sent in self.sent.iter_mut().filter(|sent| sent.id == *id) {
            sent.goal.cancel(now);
        }
    }

    /// How a goal has ended, if it has.
    pub fn end(&self, id: &GoalId) -> Option<&ClientEnd> {
        let sent = self.sent.iter().find(|sent| sent.id == *id);
        sent.and_then(|sent| sent.goal.end())
    }

    /// Whether a server may be carrying out a goal of this client.
    pub fn may_run(&self) -> bool {
        self.sent.iter().any(|sent| sent.goal.may_run())
    }

    /// Whether no answer matters any more, also none that comes late.
    pub fn is_idle(&self) -> bool {
        self.sent.is_empty()
    }

    /// How many answers were none: to nobody, doubled, before anything was asked.
    pub fn oddities(&self) -> u64 {
        let goals = self.sent.iter().map(|sent| sent.goal.oddities());
        self.oddities + goals.sum::<u64>()
    }

    /// Hears what has been answered, and asks what is to be asked.
    pub fn poll(&mut self, now: Duration) {
        self.hear(now);
        let servers = self.servers();
        if servers != self.counted.0 {
            self.counted = (servers, now);
        }
        let is_served = servers > 0;
        for sent in &mut self.sent {
            sent.goal.server(is_served, now);
            for ask in sent.goal.next(now) {
                let id = || Value::record([("uuid", Value::Bytes(sent.id.to_vec()))]);
                match ask {
                    Ask::Goal => {
                        let goal = sent.value.clone();
                        let request = Value::record([("goal_id", id()), ("goal", goal)]);
                        sent.goals.extend(self.send_goal.ask(&request));
                    }
                    Ask::Result => {
                        let request = Value::record([("goal_id", id())]);
                        sent.results.extend(self.get_result.ask(&request));
                    }
                    Ask::Cancel => {
                        let info = Value::record([("goal_id", id())]);
                        // The result tells what comes of it.
                        let request = Value::record([("goal_info", info)]);
                        self.cancel_goal.ask(&request);
                    }
                }
            }
        }
        let oddities = &mut self.oddities;
        self.sent.retain(|sent| {
            let is_over = sent.goal.is_over(now);
            if is_over {
                *oddities += sent.goal.oddities();
            }
            !is_over
        });
    }

    fn hear(&mut self, now: Duration) {
        while let Some(answer) = self.send_goal.take() {
            let (sequence, accepted) = match answer {
                Answer::To(sequence, value) => (sequence, value.get("accepted").cloned()),
                Answer::Unreadable(sequence) => (sequence, None),
                Answer::ToNobody => {
                    self.oddities += 1;
                    continue;
                }
            };
            let mut sent = self.sent.iter_mut();
            match (sent.find(|sent| sent.goals.contains(&sequence)), accepted) {
                (Some(sent), Some(Value::Bool(accepted))) => sent.goal.answered(accepted, now),
                (Some(sent), _) => sent.goal.oddity(),
                (None, _) => self.oddities += 1,
            }
        }
        while let Some(answer) = self.get_result.take() {
            let (sequence, value) = match answer {
                Answer::To(sequence, value) => (sequence, Some(value)),
                Answer::Unreadable(sequence) => (sequence, None),
                Answer::ToNobody => {
                    self.oddities += 1;
                    continue;
                }
            };
            let mut sent = self.sent.iter_mut();
            let Some(sent) = sent.find(|sent| sent.results.contains(&sequence)) else {
                self.oddities += 1;
                continue;
            };
            let status = value.as_ref().and_then(|value| value.get("status"));
            let status = status.and_then(Value::as_integer);
            let result = value.as_ref().and_then(|value| value.get("result"));
            match (status, result) {
                (Some(status), Some(result)) => sent.goal.result(status, result.clone(), now),
                _ => sent.goal.oddity(),
            }
        }
        // Whether it ends says the result.
        while self.cancel_goal.take().is_some() {}
        while let Some(message) = self.status.take() {
            let list = message.get("status_list").and_then(Value::as_list);
            for goal in list.unwrap_or_default() {
                let id = goal
                    .at(&["goal_info", "goal_id", "uuid"])
                    .and_then(Value::as_bytes);
                let status = goal.get("status").and_then(Value::as_integer);
                let mut sent = self.sent.iter_mut();
                let sent = sent.find(|sent| id == Some(&sent.id[..]));
                if let (Some(sent), Some(status)) = (sent, status) {
                    sent.goal.status(status, now);
                }
            }
        }
        while let Some(message) = self.feedback.take() {
            let id = message.at(&["goal_id", "uuid"]).and_then(Value::as_bytes);
            let mut sent = self.sent.iter_mut();
            // Goals of other clients are told of here, too.
            if let Some(sent) = sent.find(|sent| id == Some(&sent.id[..])) {
                sent.goal.feedback(now);
            }
        }
    }

    /// An identity that no goal has had.
    fn fresh_id(&self) -> GoalId {
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let since = SystemTime::now().duration_since(UNIX_EPOCH);
        let nanoseconds = since.map_or(0, |since| since.subsec_nanos());
        let mut id = [0; 16];
        let parts = self.identity.into_iter().chain(number.to_le_bytes());
        let parts = parts.chain(nanoseconds.to_le_bytes());
        for (slot, byte) in id.iter_mut().zip(parts) {
            *slot = byte;
        }
        id
    }
}
