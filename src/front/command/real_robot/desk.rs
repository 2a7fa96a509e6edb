//! Speaks with the robot, in a thread of its own: a session that thinks must not keep it waiting.

use std::collections::{BTreeMap, VecDeque};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use super::super::robot::pose;
use super::super::ros2::warn;
use super::end::{end_of, shown};
use super::goal_message::{action_of, goal_message};
use robotics::motion::RobotTrouble;
use robotics::robot::{PartInterface, RobotInterface, RobotPart};
use ros::action::{GoalId, Patience};
use ros::frames::Frames;
use ros::joints::Joints;
use ros::wire::{
    ActionClient, Answer, Node, NodeError, Sequence, ServiceClient, TopicQos, TopicReader,
};
use ros::{Value, service_type};
use session::outside::{PartGoal, RobotEnd, SeenObject};
use spatial::Pose;

/// Real time between two looks at what has been sent.
const BETWEEN_LOOKS: Duration = Duration::from_millis(2);
/// How long a goal may wait for its turn, where its server says that it does.
const QUEUE: Duration = Duration::from_secs(60);
/// How long the camera may take to answer.
const SIGHT: Duration = Duration::from_secs(10);
/// How long after they are sent goals of several parts begin, so that all servers have accepted them before.
const TOGETHER: Duration = Duration::from_millis(500);
/// How long before that it is decided whether they have: a cancellation takes its time, too.
const CANCELLING: Duration = Duration::from_millis(150);
/// By how much (s) what is known of how far the robot's clock is ahead becomes less with each message.
const DRIFT: f64 = 1e-4;
/// A clock that jumps by more than this has jumped.
const JUMP: f64 = 1.0;
/// The time over which the velocity of the base is measured.
pub(super) const BASE_TIME: Duration = Duration::from_millis(150);
/// How long goals may take to end when the program does.
const GOODBYE: Duration = Duration::from_secs(2);

/// What a session wants.
pub(super) enum Order {
    /// Goals for parts that are to begin together.
    Goals(Vec<Wanted>),
    /// The end of a goal.
    Cancel(u64),
    /// What the camera sees of a type and a name.
    Look(u64, String, String),
}

/// What is known of the robot.
#[derive(Default)]
pub(super) struct Shared {
    pub(super) frames: Frames,
    pub(super) joints: Joints,
    /// Where the base was lately, and when.
    pub(super) base: VecDeque<(Duration, Pose)>,
    pub(super) ends: BTreeMap<u64, RobotEnd>,
    pub(super) seen: BTreeMap<u64, Result<Vec<SeenObject>, RobotTrouble>>,
}

pub(super) fn lock(shared: &Mutex<Shared>) -> MutexGuard<'_, Shared> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

struct Part {
    interface: PartInterface,
    client: ActionClient,
}

/// A goal that the session wants to be sent.
pub(super) struct Wanted {
    pub(super) ticket: u64,
    pub(super) part: RobotPart,
    pub(super) goal: PartGoal,
    /// How long it may take.
    pub(super) time_out: Duration,
}

/// Goals that wait for their servers.
struct Waiting {
    goals: Vec<Wanted>,
    since: Duration,
}

/// A goal of the session that has not ended.
struct Running {
    ticket: u64,
    part: usize,
    id: GoalId,
    /// Until when its server has to accept it, and the first of the goals that begin with it.
    together: Option<(Duration, u64)>,
    /// Why it was given up, if this program has done that.
    verdict: Option<RobotTrouble>,
}

/// A question to the camera.
struct Question {
    ticket: u64,
    request: Value,
    since: Duration,
    /// When it was asked, and as which request.
    asked: Option<(Duration, Sequence)>,
}

/// Speaks with the robot.
pub(super) struct Desk {
    /// Speaks last.
    parts: Vec<Part>,
    perception: ServiceClient,
    transforms: TopicReader,
    still_transforms: TopicReader,
    joint_states: Vec<TopicReader>,
    waiting: Vec<Waiting>,
    running: Vec<Running>,
    questions: Vec<Question>,
    interface: RobotInterface,
    base: String,
    camera: String,
    shared: Arc<Mutex<Shared>>,
    begin: Instant,
    /// By how much the clock of this machine, and that of the robot, differ from the one that never jumps (s).
    own_clock: Option<f64>,
    /// The latter for each topic of joint states.
    robot_clocks: Vec<Option<f64>>,
    /// By how much (s) the robot's clock is ahead of the one that never jumps: most of what was heard lately, since messages
    /// take their time.
    ahead: Option<f64>,
    /// The topics of which has been told that they cannot be heard.
    remarked: Vec<String>,
    looked: Duration,
    oddities: u64,
    oddities_of_camera: u64,
    _node: Node,
}

/// What ends the work of a desk, or lets the robot stop.
pub(super) struct Signals {
    /// The robot is to stop: from a handler of Ctrl-C, which resets nothing.
    pub(super) halt: Arc<AtomicBool>,
    /// The robot has no goals; for others to read.
    pub(super) is_idle: Arc<AtomicBool>,
    /// The evaluation is interrupted; the session resets it.
    pub(super) interrupt: Arc<AtomicBool>,
    /// The work ends.
    pub(super) stop: Arc<AtomicBool>,
}

impl Desk {
    pub(super) fn open(
        mut node: Node,
        interface: &RobotInterface,
        parts: &[PartInterface],
        base: String,
        camera: String,
        shared: Arc<Mutex<Shared>>,
        begin: Instant,
    ) -> Result<Self, NodeError> {
        let clients = parts.iter().map(|interface| {
            let action = action_of(interface.part);
            let client = ActionClient::open(&mut node, &interface.name, action)?;
            Ok(Part {
                interface: interface.clone(),
                client,
            })
        });
        let clients = clients.collect::<Result<Vec<_>, NodeError>>()?;
        let [request, response] = service_type("planwright_msgs/srv/DetectObjects");
        let perception = node.client(&interface.perception, request, response)?;
        let tf = "tf2_msgs/msg/TFMessage";
        let joints = "sensor_msgs/msg/JointState";
        let transforms = node.reader("/tf", tf, TopicQos::volatile(100))?;
        let still = TopicQos {
            depth: 100,
            ..TopicQos::latched()
        };
        let still_transforms = node.reader("/tf_static", tf, still)?;
        let topics = interface.joint_states.iter();
        // Some robots send them without sending again what is lost.
        let joint_states =
            topics.map(|topic| node.reader(topic, joints, TopicQos::best_effort(50)));
        Ok(Self {
            parts: clients,
            perception,
            transforms,
            still_transforms,
            joint_states: joint_states.collect::<Result<_, _>>()?,
            waiting: Vec::new(),
            running: Vec::new(),
            questions: Vec::new(),
            interface: interface.clone(),
            base,
            camera,
            shared,
            begin,
            own_clock: None,
            robot_clocks: vec![None; interface.joint_states.len()],
            ahead: None,
            remarked: Vec::new(),
            looked: Duration::ZERO,
            oddities: 0,
            oddities_of_camera: 0,
            _node: node,
        })
    }

    /// Works until it is to end; then the robot gets no goals any more, and those that it has are cancelled.
    pub(super) fn run(mut self, orders: &Receiver<Order>, signals: &Signals) {
        let mut was_interrupted = false;
        while !signals.stop.load(Ordering::Relaxed) {
            let now = self.begin.elapsed();
            self.hear(now);
            let halt = signals.halt.swap(false, Ordering::Relaxed);
            let interrupt = signals.interrupt.load(Ordering::Relaxed);
            loop {
                match orders.try_recv() {
                    Ok(order) => self.take(order, now),
                    Err(TryRecvError::Empty) => break,
                    Err(TryRecvError::Disconnected) => {
                        self.say_goodbye();
                        return;
                    }
                }
            }
            // Also what was ordered just now.
            if halt || (interrupt && !was_interrupted) {
                self.cancel_all(now);
            }
            was_interrupted = interrupt;
            self.speak(now);
            let is_idle = !self.may_run() && self.waiting.is_empty();
            signals.is_idle.store(is_idle, Ordering::Relaxed);
            self.ask_camera(now);
            self.remark(now);
            thread::sleep(BETWEEN_LOOKS);
        }
        self.say_goodbye();
    }

    /// Whether the robot may be carrying something out.
    fn may_run(&self) -> bool {
        self.parts.iter().any(|part| part.client.may_run())
    }

    fn say_goodbye(&mut self) {
        let begin = self.begin.elapsed();
        self.cancel_all(begin);
        while self.may_run() {
            let now = self.begin.elapsed();
            if now.saturating_sub(begin) > GOODBYE {
                let running = self.parts.iter().filter(|part| part.client.may_run());
                let names: Vec<&str> = running.map(|part| part.interface.name.as_str()).collect();
                warn(&format!(
                    "NOTHING SAYS THAT THE GOALS OF {} HAVE ENDED. Use the emergency stop if the robot moves.",
                    names.join(", ")
                ));
                return;
            }
            self.speak(now);
            thread::sleep(BETWEEN_LOOKS);
        }
    }

    fn cancel_all(&mut self, now: Duration) {
        for waiting in std::mem::take(&mut self.waiting) {
            self.give_up(waiting, None);
        }
        for goal in &self.running {
            if let Some(part) = self.parts.get_mut(goal.part) {
                part.client.cancel(&goal.id, now);
            }
        }
    }

    fn take(&mut self, order: Order, now: Duration) {
        match order {
            Order::Goals(goals) => self.waiting.push(Waiting { goals, since: now }),
            Order::Cancel(ticket) => {
                let is_it =
                    |waiting: &Waiting| waiting.goals.iter().any(|goal| goal.ticket == ticket);
                if let Some(place) = self.waiting.iter().position(is_it) {
                    let waiting = self.waiting.remove(place);
                    self.give_up(waiting, None);
                }
                for goal in self.running.iter().filter(|goal| goal.ticket == ticket) {
                    if let Some(part) = self.parts.get_mut(goal.part) {
                        part.client.cancel(&goal.id, now);
                    }
                }
            }
            Order::Look(ticket, kind, name) => self.questions.push(Question {
                ticket,
                request: Value::record([
                    ("type", kind.as_str().into()),
                    ("name", name.as_str().into()),
                ]),
                since: now,
                asked: None,
            }),
        }
    }

    /// Ends goals of which none was sent.
    fn give_up(&self, waiting: Waiting, trouble: Option<RobotTrouble>) {
        for goal in waiting.goals {
            let end = RobotEnd {
                is_cancelled: trouble.is_none(),
                trouble: trouble.clone(),
                ..RobotEnd::default()
            };
            lock(&self.shared).ends.insert(goal.ticket, end);
        }
    }

    /// Sends goals whose servers are all there, each of them once.
    fn send_waiting(&mut self, now: Duration) {
        for waiting in std::mem::take(&mut self.waiting) {
            let place = |goal: &Wanted| {
                let mut parts = self.parts.iter();
                parts.position(|part| part.interface.part == goal.part)
            };
            let places: Option<Vec<usize>> = waiting.goals.iter().map(place).collect();
            let Some(places) = places else {
                let unknown = waiting.goals.iter().find(|goal| place(goal).is_none());
                let part = unknown.map_or("", |goal| goal.part.name());
                let text = format!("the robot has no action for the part {part}");
                self.give_up(waiting, Some(RobotTrouble::NotPossible(text)));
                continue;
            };
            let mut trouble = None;
            let waited = now.saturating_sub(waiting.since).as_secs_f64();
            for part in places.iter().filter_map(|place| self.parts.get(*place)) {
                let name = part.interface.name.clone();
                match part.client.servers() {
                    1 => {}
                    0 => trouble = Some(RobotTrouble::Unserved { name, waited }),
                    servers => {
                        trouble = Some(RobotTrouble::Contested {
                            name,
                            servers,
                            waited,
                        });
                    }
                }
            }
            match trouble {
                None => self.send(waiting.goals, &places, now),
                Some(_) if waited < self.interface.server_time_out => self.waiting.push(waiting),
                trouble => self.give_up(waiting, trouble),
            }
        }
    }

    /// Sends goals. Trajectories of several parts have a stamp, so that these begin together after all were accepted.
    fn send(&mut self, goals: Vec<Wanted>, places: &[usize], now: Duration) {
        let follows = |goal: &Wanted| matches!(goal.goal, PartGoal::Follow { .. });
        let is_group = goals.len() > 1 && goals.iter().all(follows);
        let is_free = self.running.is_empty();
        // A server that carries out one goal after the other would find the stamp out of date behind others.
        let ahead = self.ahead.filter(|_| is_group && is_free);
        let stamp = ahead.and_then(|ahead| {
            let stamp = (now + TOGETHER).as_secs_f64() + ahead;
            Duration::try_from_secs_f64(stamp).ok()
        });
        let first = goals.first().map_or(0, |goal| goal.ticket);
        let together = stamp.map(|_| (now + TOGETHER, first));
        for (wanted, place) in goals.into_iter().zip(places) {
            let Some(part) = self.parts.get_mut(*place) else {
                continue;
            };
            let stamp = stamp.unwrap_or_default();
            let message = goal_message(&wanted.goal, &self.interface.map, &self.camera, stamp);
            let patience = Patience {
                server: seconds(self.interface.server_time_out),
                queue: QUEUE,
                result: wanted.time_out + stamp_time(together.is_some()),
            };
            let id = part.client.send(message, patience, now);
            self.running.push(Running {
                ticket: wanted.ticket,
                part: *place,
                id,
                together,
                verdict: None,
            });
        }
    }

    /// Gives up all goals that were to begin together if one of them was not accepted by then.
    fn keep_together(&mut self, now: Duration) {
        let mut apart: Vec<(u64, RobotTrouble)> = Vec::new();
        for goal in &self.running {
            let (Some((begin, first)), Some(part)) = (goal.together, self.parts.get(goal.part))
            else {
                continue;
            };
            let name = part.interface.name.clone();
            // A margin, so that what is cancelled has not begun.
            if now + CANCELLING >= begin && !part.client.is_accepted(&goal.id) {
                apart.push((first, RobotTrouble::Apart { name }));
            }
        }
        for goal in &mut self.running {
            let Some((begin, first)) = goal.together else {
                continue;
            };
            let trouble = apart.iter().find(|(known, _)| *known == first);
            if let (Some((_, trouble)), Some(part)) = (trouble, self.parts.get_mut(goal.part)) {
                goal.verdict = Some(trouble.clone());
                part.client.cancel(&goal.id, now);
            }
            if now + CANCELLING >= begin {
                goal.together = None;
            }
        }
    }

    /// Sends and hears what concerns goals.
    fn speak(&mut self, now: Duration) {
        self.send_waiting(now);
        for part in &mut self.parts {
            part.client.poll(now);
        }
        self.keep_together(now);
        let (parts, shared) = (&self.parts, &self.shared);
        self.running.retain_mut(|goal| {
            let Some(part) = parts.get(goal.part) else {
                return false;
            };
            let Some(end) = part.client.end(&goal.id) else {
                return true;
            };
            let mut end = end_of(&part.interface.name, part.interface.part, end);
            if let Some(verdict) = goal.verdict.take() {
                end.is_cancelled = false;
                end.trouble = Some(verdict);
            }
            lock(shared).ends.insert(goal.ticket, end);
            false
        });
        let of_parts = self.parts.iter().map(|part| part.client.oddities());
        let oddities = of_parts.sum::<u64>() + self.oddities_of_camera;
        if oddities > self.oddities {
            if self.oddities == 0 {
                warn("a server has answered what was not asked, or twice; that counts for nothing");
            }
            self.oddities = oddities;
        }
    }

    /// Hears how the robot is.
    fn hear(&mut self, now: Duration) {
        let clock = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
        let clock = clock.unwrap_or_default().as_secs_f64() - now.as_secs_f64();
        let mut has_jumped = jumps(&mut self.own_clock, clock).map(|by| ("of this machine", by));
        let mut shared = lock(&self.shared);
        while let Some(message) = self.still_transforms.take() {
            shared.frames.hear(&message, true, now);
        }
        for (topic, clock) in self.joint_states.iter().zip(&mut self.robot_clocks) {
            while let Some(message) = topic.take() {
                if let Some(stamp) = stamp(&message) {
                    let ahead = stamp - now.as_secs_f64();
                    let robot = jumps(clock, ahead);
                    let known = self.ahead.filter(|_| robot.is_none());
                    let known = known.map_or(ahead, |known| known - DRIFT);
                    self.ahead = Some(known.max(ahead));
                    has_jumped = has_jumped.or(robot.map(|by| ("of the robot", by)));
                }
                shared.joints.hear(&message, now);
            }
        }
        if let Some((whose, by)) = has_jumped {
            shared.frames.forget_moving();
            shared.base.clear();
            warn(&format!(
                "the clock {whose} has jumped by {by:.1} s: what was heard of moving frames is forgotten"
            ));
        }
        let mut is_news = false;
        while let Some(message) = self.transforms.take() {
            shared.frames.hear(&message, false, now);
            is_news = true;
        }
        if is_news {
            let pose = shared
                .frames
                .pose(&self.base, &self.interface.map, BASE_TIME, now);
            if let Ok(pose) = pose {
                shared.base.push_back((now, pose));
            }
        }
        let is_old = |at: Duration| now.saturating_sub(at) > 2 * BASE_TIME;
        while shared.base.front().is_some_and(|(at, _)| is_old(*at)) {
            shared.base.pop_front();
        }
    }

    /// Asks the camera, and hears what it sees.
    fn ask_camera(&mut self, now: Duration) {
        let mut answers = Vec::new();
        while let Some(answer) = self.perception.take() {
            match answer {
                Answer::To(sequence, value) => answers.push((sequence, Some(value))),
                Answer::Unreadable(sequence) => answers.push((sequence, None)),
                Answer::ToNobody => self.oddities_of_camera += 1,
            }
        }
        let is_served = self.perception.is_served();
        let mut questions = std::mem::take(&mut self.questions);
        questions.retain_mut(|question| {
            let name = || self.interface.perception.clone();
            let end = match question.asked {
                None => {
                    if is_served {
                        let sequence = self.perception.ask(&question.request);
                        question.asked = sequence.map(|sequence| (now, sequence));
                    }
                    let waited = now.saturating_sub(question.since).as_secs_f64();
                    let is_over =
                        question.asked.is_none() && waited >= self.interface.server_time_out;
                    is_over.then(|| {
                        Err(RobotTrouble::Unserved {
                            name: name(),
                            waited,
                        })
                    })
                }
                Some((asked, sequence)) => {
                    let answer = answers.iter().find(|(to, _)| *to == sequence);
                    let waited = now.saturating_sub(asked);
                    match answer {
                        Some((_, answer)) => Some(self.seen(answer.as_ref(), now)),
                        None if waited >= SIGHT => Some(Err(RobotTrouble::NoAnswer {
                            name: name(),
                            waited: waited.as_secs_f64(),
                        })),
                        None => None,
                    }
                }
            };
            match end {
                None => true,
                Some(end) => {
                    lock(&self.shared).seen.insert(question.ticket, end);
                    false
                }
            }
        });
        self.questions = questions;
    }

    /// The objects of an answer of the camera.
    fn seen(&self, answer: Option<&Value>, now: Duration) -> Result<Vec<SeenObject>, RobotTrouble> {
        let blind = |text: String| RobotTrouble::Blind {
            name: self.interface.perception.clone(),
            text,
        };
        let answer = answer.ok_or_else(|| blind("its answer cannot be read".to_owned()))?;
        let error = answer.get("error").and_then(Value::as_text);
        if let Some(error) = error.filter(|error| !error.trim().is_empty()) {
            return Err(blind(shown(error)));
        }
        let objects = answer.get("objects").and_then(Value::as_list);
        let objects = objects.unwrap_or_default().iter().map(|object| {
            let text = |name| {
                object
                    .get(name)
                    .and_then(Value::as_text)
                    .unwrap_or_default()
            };
            let frame = object
                .at(&["pose", "header", "frame_id"])
                .and_then(Value::as_text);
            let frame = frame.unwrap_or_default();
            let pose = pose(object.at(&["pose", "pose"]));
            let pose = pose
                .ok_or_else(|| blind(format!("the pose of a {} is none", shown(text("type")))))?;
            let max_age = seconds(self.interface.max_frame_age);
            let frames = &lock(&self.shared).frames;
            let carrier = frames.pose(frame, &self.interface.map, max_age, now);
            let carrier = carrier.map_err(|error| blind(error.to_string()))?;
            Ok(SeenObject {
                type_name: text("type").to_owned(),
                name: text("name").to_owned(),
                pose: carrier * pose,
            })
        });
        objects.collect()
    }

    /// Tells of topics that cannot be heard.
    fn remark(&mut self, now: Duration) {
        if now.saturating_sub(self.looked) < Duration::from_millis(200) {
            return;
        }
        self.looked = now;
        let topics = [&self.transforms, &self.still_transforms].into_iter();
        for topic in topics.chain(&self.joint_states) {
            let Some(policy) = topic.mismatch() else {
                continue;
            };
            let name = topic.topic().to_owned();
            if !self.remarked.contains(&name) {
                warn(&format!(
                    "{name} cannot be heard: its quality of service does not fit ({policy})"
                ));
                self.remarked.push(name);
            }
        }
    }
}

/// How much longer a goal takes that begins together with others.
fn stamp_time(is_together: bool) -> Duration {
    if is_together {
        TOGETHER
    } else {
        Duration::ZERO
    }
}

/// By how much (s) a clock has jumped, whose difference to one that never jumps is known.
fn jumps(known: &mut Option<f64>, now: f64) -> Option<f64> {
    let before = known.replace(now)?;
    Some(now - before).filter(|by| by.abs() > JUMP)
}

/// The stamp (s) of a message that has one.
fn stamp(message: &Value) -> Option<f64> {
    let stamp = ros::frames::seconds(message.at(&["header", "stamp"]));
    (stamp > 0.0).then_some(stamp)
}

/// A duration of seconds; a minute if it cannot be one.
pub(super) fn seconds(seconds: f64) -> Duration {
    Duration::try_from_secs_f64(seconds).unwrap_or(Duration::from_secs(60))
}
