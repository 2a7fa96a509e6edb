//! A robot without a network, which does what it is told, or lies about it in the way that a test wants.

use std::cell::{Ref, RefCell, RefMut};
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

use robotics::motion::RobotTrouble;
use robotics::robot::RobotPart;
use robotics::world::Models;
use session::outside::{
    FingersReport, GoalTicket, PartGoal, RobotEnd, RobotLink, RobotState, SeenObject,
};
use spatial::Pose;
use spatial::pose::{from_xy_yaw, yaw};

/// What passes on the robot's clock whenever it is asked something.
const MOMENT: Duration = Duration::from_millis(2);
/// How long (s) a drive takes.
const DRIVE: f64 = 1.0;
/// How fast (m/s) fingers move.
const FINGERS: f64 = 0.1;
/// How long a goal takes to end once it is cancelled.
const STOPPING: Duration = Duration::from_millis(50);

/// What becomes of the goals of a part.
#[derive(Clone, Debug)]
pub(super) enum Conduct {
    /// They are reached.
    Obeys,
    /// They end so, and nothing moves.
    Ends(RobotEnd),
    /// They are reported to be reached so far (m or rad) beside where they are, in the direction in which it is measured.
    Beside(f64),
    /// There is no result in time; what is cancelled stops.
    NeverEnds,
    /// There is never an end, neither in time nor after it was cancelled, and the part moves on.
    RunsAway,
    /// There is never an end, and nothing moves.
    Mute,
    /// They do what they are to do, and end so nevertheless.
    GivesUp(RobotEnd),
    /// Fingers report that, and close up to where something is between them.
    Reports(FingersReport),
}

/// What is wrong with what the robot tells of itself.
#[derive(Clone, Debug)]
pub(super) enum Untruth {
    /// It has told nothing for a while.
    Stale,
    /// It lacks a joint.
    Lacks(String),
    /// The place of a joint is no number.
    NoNumber(String),
    /// The place of the base is no number.
    NoPlace,
    /// There are fewer joints than were asked for.
    TooFew,
}

struct Goal {
    ticket: u64,
    part: RobotPart,
    goal: PartGoal,
    since: Duration,
    limit: f64,
    cancelled: Option<Duration>,
    base: Pose,
    joints: BTreeMap<String, f64>,
}

/// The robot as it is.
pub(super) struct Robot {
    models: Arc<Models>,
    pub(super) time: Duration,
    pub(super) base: Pose,
    pub(super) joints: BTreeMap<String, f64>,
    conducts: Vec<(RobotPart, Conduct)>,
    /// What is wrong with what it tells, from the time on when a goal has been under way for so long (s).
    pub(super) untruth: Option<(f64, Untruth)>,
    /// Whether somebody pushes it to and fro.
    pub(super) drifts: bool,
    /// How far (m) apart fingers stay, since something is between them.
    pub(super) between: f64,
    goals: Vec<Goal>,
    ends: BTreeMap<u64, RobotEnd>,
    /// What the camera answers; nothing if `None`.
    pub(super) sight: Option<Result<Vec<SeenObject>, RobotTrouble>>,
    /// How many goals it had at once at most.
    pub(super) at_once: usize,
    /// What it was told to do, in order.
    pub(super) told: Vec<String>,
    /// What a person has to notice.
    pub(super) shouts: Vec<String>,
    next: u64,
}

impl Robot {
    pub(super) fn new(models: &Arc<Models>, base: Pose, joints: BTreeMap<String, f64>) -> Self {
        Self {
            models: Arc::clone(models),
            time: Duration::ZERO,
            base,
            joints,
            conducts: Vec::new(),
            untruth: None,
            drifts: false,
            between: 0.0,
            goals: Vec::new(),
            ends: BTreeMap::new(),
            sight: None,
            at_once: 0,
            told: Vec::new(),
            shouts: Vec::new(),
            next: 0,
        }
    }

    /// From now on, goals of a part end in that way.
    pub(super) fn set(&mut self, part: RobotPart, conduct: Conduct) {
        self.conducts.retain(|(known, _)| *known != part);
        self.conducts.push((part, conduct));
    }

    fn conduct(&self, part: RobotPart) -> Conduct {
        let known = self.conducts.iter().find(|(known, _)| *known == part);
        known.map_or(Conduct::Obeys, |(_, conduct)| conduct.clone())
    }

    /// Whether a part has one of these joints.
    fn has_joint(&self, part: RobotPart, joints: &[&str]) -> bool {
        let body = &self.models.description;
        let own = match part {
            RobotPart::Arm(side) => body.arm(side).joints().to_vec(),
            RobotPart::Gripper(side) => vec![body.arm(side).gripper.joint],
            RobotPart::Torso => body.torso.joint.into_iter().collect(),
            RobotPart::Neck => body.neck.joints.clone(),
            RobotPart::Base => Vec::new(),
        };
        let mut names = own
            .iter()
            .map(|id| self.models.robot.joint(*id).name.as_str());
        names.any(|name| joints.contains(&name))
    }

    /// Whether something moves.
    pub(super) fn moves(&self) -> bool {
        let moves = |goal: &&Goal| !matches!(self.conduct(goal.part), Conduct::Mute);
        self.goals.iter().any(|goal| moves(&goal))
    }

    fn untruth(&self) -> Option<&Untruth> {
        let (after, untruth) = self.untruth.as_ref()?;
        let since = self.goals.first().map(|goal| goal.since);
        let is_due = match since {
            Some(since) => (self.time - since).as_secs_f64() >= *after,
            None => *after <= 0.0,
        };
        is_due.then_some(untruth)
    }

    /// Lets a moment pass.
    fn advance(&mut self) {
        self.time += MOMENT;
        if self.drifts {
            // To and fro.
            let way = if self.base.translation.x > 0.01 {
                -0.02
            } else {
                0.02
            };
            self.base *= Pose::translation(way, 0.0, 0.0);
        }
        let goals = std::mem::take(&mut self.goals);
        for goal in goals {
            if let Some(end) = self.go_on(&goal) {
                self.ends.insert(goal.ticket, end);
            } else {
                self.goals.push(goal);
            }
        }
    }

    /// Moves on for a goal; its end if it has one.
    fn go_on(&mut self, goal: &Goal) -> Option<RobotEnd> {
        let conduct = self.conduct(goal.part);
        let since = (self.time - goal.since).as_secs_f64();
        match &conduct {
            Conduct::Mute => return None,
            Conduct::Ends(end) => return (since > 0.1).then(|| end.clone()),
            Conduct::RunsAway => {
                self.base *= Pose::translation(1e-4, 0.0, 0.0);
                return None;
            }
            _ => {}
        }
        if let Some(cancelled) = goal.cancelled {
            return (self.time - cancelled >= STOPPING).then(|| RobotEnd {
                is_cancelled: true,
                ..RobotEnd::default()
            });
        }
        if let Conduct::NeverEnds = conduct {
            return (since > goal.limit).then(|| RobotEnd {
                trouble: Some(RobotTrouble::Late {
                    name: self.name(goal.part),
                    limit: goal.limit,
                    has_ended: true,
                }),
                ..RobotEnd::default()
            });
        }
        let beside = match conduct {
            Conduct::Beside(beside) => beside,
            _ => 0.0,
        };
        let (is_there, fingers) = self.approach(goal, since, beside);
        if let Conduct::GivesUp(end) = conduct {
            // Only where something stops them.
            let is_stopped = fingers.is_some_and(|fingers| fingers.is_stalled);
            return is_there.then(|| match is_stopped {
                true => end,
                false => RobotEnd::default(),
            });
        }
        let fingers = match conduct {
            Conduct::Reports(fingers) => Some(fingers),
            _ => fingers,
        };
        is_there.then(|| RobotEnd {
            fingers,
            ..RobotEnd::default()
        })
    }

    /// Whether a goal is reached, and how fingers are then.
    fn approach(&mut self, goal: &Goal, since: f64, beside: f64) -> (bool, Option<FingersReport>) {
        match &goal.goal {
            PartGoal::Drive(to) => {
                let share = (since / DRIVE).min(1.0);
                let [from, to] = [goal.base, *to * Pose::translation(beside, 0.0, 0.0)];
                let way = to.translation.vector - from.translation.vector;
                let at = from.translation.vector + way * share;
                let turn = spatial::trig::wrap(yaw(&to) - yaw(&from));
                self.base = from_xy_yaw(at.x, at.y, yaw(&from) + turn * share);
                (share >= 1.0, None)
            }
            PartGoal::Follow { joints, points } => {
                let end = points.last().map_or(0.0, |point| point.time);
                let share = if end > 0.0 {
                    (since / end).min(1.0)
                } else {
                    1.0
                };
                for (number, joint) in joints.iter().enumerate() {
                    let mut before = (0.0, goal.joints.get(joint).copied().unwrap_or_default());
                    let mut at = before.1;
                    for point in points {
                        let next = (point.time, point.positions[number]);
                        let part =
                            ((since - before.0) / (next.0 - before.0).max(1e-9)).clamp(0.0, 1.0);
                        at = before.1 + (next.1 - before.1) * part;
                        if since < next.0 {
                            break;
                        }
                        before = next;
                    }
                    let beside = if number == 0 { beside * share } else { 0.0 };
                    self.joints.insert(joint.clone(), at + beside);
                }
                (since >= end, None)
            }
            PartGoal::Fingers { gap, .. } => {
                let RobotPart::Gripper(side) = goal.part else {
                    return (true, None);
                };
                let models = Arc::clone(&self.models);
                let gripper = &models.description.arm(side).gripper;
                let name = &models.robot.joint(gripper.joint).name;
                let from = gripper.gap(goal.joints.get(name).copied().unwrap_or_default());
                let wanted = gap + beside;
                let to = if wanted < from {
                    wanted.max(self.between)
                } else {
                    wanted
                };
                let way = (FINGERS * since).min((to - from).abs());
                let now = from + way * (to - from).signum();
                self.joints
                    .insert(name.clone(), gripper.position_for_gap(now));
                let is_stalled = (to - wanted).abs() > 1e-9;
                (
                    (now - to).abs() < 1e-9,
                    Some(FingersReport {
                        gap: now,
                        is_stalled,
                    }),
                )
            }
            PartGoal::Aim(_) => (since > 0.2, None),
        }
    }

    fn name(&self, part: RobotPart) -> String {
        let interface = self.models.description.interface.part(part);
        interface.map_or_else(String::new, |interface| interface.name.clone())
    }
}

/// The robot, for the test and for the session.
#[derive(Clone)]
pub(super) struct ScriptedRobot(Rc<RefCell<Robot>>);

impl ScriptedRobot {
    pub(super) fn new(robot: Robot) -> Self {
        Self(Rc::new(RefCell::new(robot)))
    }

    pub(super) fn get(&self) -> Ref<'_, Robot> {
        self.0.borrow()
    }

    pub(super) fn change(&self) -> RefMut<'_, Robot> {
        self.0.borrow_mut()
    }

    fn at_next_moment(&self) -> RefMut<'_, Robot> {
        let mut robot = self.0.borrow_mut();
        robot.advance();
        robot
    }
}

impl RobotLink for ScriptedRobot {
    fn state(&self, joints: &[&str]) -> Result<RobotState, RobotTrouble> {
        let robot = self.at_next_moment();
        let untruth = robot.untruth();
        let no_state = |text: String| Err(RobotTrouble::NoState(text));
        let mut base = robot.base;
        let mut positions: Vec<f64> = Vec::new();
        for joint in joints {
            positions.push(robot.joints.get(*joint).copied().unwrap_or_default());
        }
        let place = |name: &String| joints.iter().position(|joint| joint == name);
        match untruth {
            None => {}
            Some(Untruth::Stale) => return no_state("no joint states for 0.7 s".to_owned()),
            Some(Untruth::Lacks(joint)) => {
                return no_state(format!("the joint states lack {joint}"));
            }
            Some(Untruth::NoNumber(joint)) => {
                if let Some(place) = place(joint) {
                    positions[place] = f64::NAN;
                }
            }
            Some(Untruth::NoPlace) => base.translation.vector.x = f64::NAN,
            Some(Untruth::TooFew) => {
                positions.pop();
            }
        }
        Ok(RobotState {
            base,
            joints: positions,
        })
    }

    fn send(&mut self, goals: &[(RobotPart, PartGoal, f64)]) -> Vec<GoalTicket> {
        let mut robot = self.0.borrow_mut();
        let mut tickets = Vec::new();
        for (part, goal, time_out) in goals {
            robot.next += 1;
            let ticket = robot.next;
            robot.told.push(format!("{} goes", part.name()));
            let goal = Goal {
                ticket,
                part: *part,
                goal: goal.clone(),
                since: robot.time,
                limit: *time_out,
                cancelled: None,
                base: robot.base,
                joints: robot.joints.clone(),
            };
            robot.goals.push(goal);
            tickets.push(GoalTicket(ticket));
        }
        robot.at_once = robot.at_once.max(robot.goals.len());
        tickets
    }

    fn end(&mut self, ticket: GoalTicket) -> Option<RobotEnd> {
        self.at_next_moment().ends.remove(&ticket.0)
    }

    fn cancel(&mut self, ticket: GoalTicket) {
        let mut robot = self.0.borrow_mut();
        let now = robot.time;
        let mut told = Vec::new();
        for goal in &mut robot.goals {
            if goal.ticket == ticket.0 && goal.cancelled.is_none() {
                goal.cancelled = Some(now);
                told.push(format!("{} stops", goal.part.name()));
            }
        }
        robot.told.append(&mut told);
    }

    fn stands_still(&self, joints: Option<&[&str]>, base: bool) -> bool {
        let robot = self.at_next_moment();
        let is_meant = |part: RobotPart| match joints {
            None => true,
            Some(_) if part == RobotPart::Base => base,
            Some(joints) => robot.has_joint(part, joints),
        };
        let moves = |goal: &&Goal| !matches!(robot.conduct(goal.part), Conduct::Mute);
        let mut goals = robot.goals.iter().filter(moves);
        !goals.any(|goal| is_meant(goal.part))
    }

    fn look(&mut self, type_name: &str, name: &str) -> GoalTicket {
        let mut robot = self.0.borrow_mut();
        robot.next += 1;
        robot.told.push(format!("looks for {type_name:?} {name:?}"));
        GoalTicket(robot.next)
    }

    fn seen(&mut self, _: GoalTicket) -> Option<Result<Vec<SeenObject>, RobotTrouble>> {
        self.at_next_moment().sight.clone()
    }

    fn now(&self) -> Duration {
        self.at_next_moment().time
    }

    fn wait(&self) {
        self.at_next_moment();
    }

    fn shout(&self, text: &str) {
        self.0.borrow_mut().shouts.push(text.to_owned());
    }
}
