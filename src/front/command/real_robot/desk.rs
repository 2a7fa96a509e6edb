//! Speaks with the robot, in a thread of its own: a session that thinks must not keep it waiting.

mod camera;
mod endpoints;
mod groups;

use std::collections::{BTreeMap, VecDeque};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use super::super::ros2::warn;
use super::end::end_of;
use camera::Question;
pub(super) use endpoints::Endpoints;
use endpoints::{LEAVING, Search};
use groups::Waiting;
use robotics::motion::RobotTrouble;
use robotics::robot::{PartInterface, RobotInterface, RobotPart};
use ros::Value;
use ros::action::{ClientEnd, GoalId};
use ros::frames::Frames;
use ros::joints::Joints;
use ros::robot_clock::{RobotClock, Timing};
use ros::wire::ActionClient;
use session::outside::{PartGoal, RobotEnd, SeenObject};
use spatial::Pose;

/// Real time between two looks at what has been sent.
const BETWEEN_LOOKS: Duration = Duration::from_millis(2);
/// A clock of this machine that jumps by more than this has jumped.
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

/// Speaks with the robot.
pub(super) struct Desk {
    ends: Endpoints,
    /// Those of before, as long as goals of theirs may turn out to be accepted.
    retired: Vec<Endpoints>,
    search: Search,
    distribution: String,
    waiting: Vec<Waiting>,
    running: Vec<Running>,
    questions: Vec<Question>,
    interface: RobotInterface,
    base: String,
    camera: String,
    shared: Arc<Mutex<Shared>>,
    begin: Instant,
    /// By how much the clock of this machine differs from the one that never jumps (s).
    own_clock: Option<f64>,
    /// The robot's clock, by each topic of joint states.
    robot_clocks: Vec<RobotClock>,
    /// The topics of which has been told that they cannot be heard.
    remarked: Vec<String>,
    looked: Duration,
    oddities: u64,
    oddities_of_camera: u64,
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
    pub(super) fn new(
        ends: Endpoints,
        distribution: String,
        interface: &RobotInterface,
        base: String,
        camera: String,
        shared: Arc<Mutex<Shared>>,
        begin: Instant,
    ) -> Self {
        Self {
            ends,
            retired: Vec::new(),
            search: Search::default(),
            distribution,
            waiting: Vec::new(),
            running: Vec::new(),
            questions: Vec::new(),
            interface: interface.clone(),
            base,
            camera,
            shared,
            begin,
            own_clock: None,
            robot_clocks: vec![RobotClock::default(); interface.joint_states.len()],
            remarked: Vec::new(),
            looked: Duration::ZERO,
            oddities: 0,
            oddities_of_camera: 0,
        }
    }

    /// Works until it is to end; then the robot gets no goals any more, and those that it has are cancelled.
    pub(super) fn run(mut self, orders: &Receiver<Order>, signals: &Signals) {
        self.work(orders, signals);
        self.say_goodbye();
        for ends in self.retired {
            ends.leave(Duration::ZERO);
        }
        self.ends.leave(LEAVING);
    }

    fn work(&mut self, orders: &Receiver<Order>, signals: &Signals) {
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
                    Err(TryRecvError::Disconnected) => return,
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
            self.search(now);
            thread::sleep(BETWEEN_LOOKS);
        }
    }

    /// Whether the robot may be carrying something out.
    fn may_run(&self) -> bool {
        self.ends.parts.iter().any(|part| part.client.may_run())
    }

    fn say_goodbye(&mut self) {
        let begin = self.begin.elapsed();
        self.cancel_all(begin);
        while self.may_run() {
            let now = self.begin.elapsed();
            if now.saturating_sub(begin) > GOODBYE {
                let running = self.ends.parts.iter().filter(|part| part.client.may_run());
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
            if let Some(part) = self.ends.parts.get_mut(goal.part) {
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
                    if let Some(part) = self.ends.parts.get_mut(goal.part) {
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

    /// Sends and hears what concerns goals.
    fn speak(&mut self, now: Duration) {
        self.send_waiting(now);
        for part in &mut self.ends.parts {
            part.client.poll(now);
        }
        self.keep_together(now);
        let (parts, shared) = (&self.ends.parts, &self.shared);
        let unanswered = &mut self.search.is_unanswered;
        self.running.retain_mut(|goal| {
            let Some(part) = parts.get(goal.part) else {
                return false;
            };
            let Some(end) = part.client.end(&goal.id) else {
                return true;
            };
            let is_there = part.client.counted().0 > 0;
            *unanswered |= is_there && matches!(end, ClientEnd::NoAnswer { .. });
            let mut end = end_of(&part.interface.name, part.interface.part, end);
            if let Some(verdict) = goal.verdict.take() {
                end.is_cancelled = false;
                end.trouble = Some(verdict);
            }
            lock(shared).ends.insert(goal.ticket, end);
            false
        });
        let of_parts = self.ends.parts.iter().map(|part| part.client.oddities());
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
        while let Some(message) = self.ends.still_transforms.take() {
            shared.frames.hear(&message, true, now);
        }
        for (topic, clock) in self.ends.joint_states.iter().zip(&mut self.robot_clocks) {
            while let Some(message) = topic.take() {
                let timing = stamp(&message).map(|stamp| clock.hear(stamp, now));
                match timing {
                    Some(Timing::Late) => continue,
                    Some(Timing::Jumped(by)) => {
                        shared.joints.forget_stamps();
                        has_jumped = has_jumped.or(Some(("of the robot", by)));
                    }
                    Some(Timing::Usual) | None => {}
                }
                shared.joints.hear(&message, now);
                self.search.joints = Some(now);
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
        while let Some(message) = self.ends.transforms.take() {
            shared.frames.hear(&message, false, now);
            is_news = true;
        }
        if is_news {
            self.search.frames = Some(now);
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

    /// By how much (s) the robot's clock is ahead of the one that never jumps.
    fn ahead(&self) -> Option<f64> {
        let known = self.robot_clocks.iter().filter_map(RobotClock::ahead);
        known.reduce(f64::max)
    }

    /// Tells of topics that cannot be heard.
    fn remark(&mut self, now: Duration) {
        if now.saturating_sub(self.looked) < Duration::from_millis(200) {
            return;
        }
        self.looked = now;
        let topics = [&self.ends.transforms, &self.ends.still_transforms].into_iter();
        for topic in topics.chain(&self.ends.joint_states) {
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
