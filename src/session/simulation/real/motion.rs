//! A motion that a robot elsewhere carries out.

mod stopping;

use std::rc::Rc;
use std::time::Duration;

use super::belief::Told;
use super::goals::{Order, orders, untried};
use super::trial::{Misfit, try_motion};
use super::{Query, RobotAccess, SharedRobot, UnderWay, check, sight};
use crate::outside::{GoalTicket, RobotEnd};
use robotics::motion::{
    Motion, MotionFailure, MotionOutcome, MotionStatus, PlannedTrajectory, ProcessModule, Progress,
    RobotFailure, RobotTrouble,
};
use robotics::robot::{PartInterface, RobotPart};
use robotics::world::World;

/// How long a robot that has done what it was to do may take to tell so of itself.
const SETTLING: Duration = Duration::from_millis(500);
/// How much longer (s) than it was allowed a goal, or a question to the camera, may take until it counts as lost, whatever
/// the link says or does not say: it may have waited for its server and for its turn.
const LOST: f64 = 90.0;

/// A motion that a robot elsewhere carries out.
pub(super) struct RealMotion {
    module: ProcessModule,
    /// The motion as it was requested; only copies of it are carried out.
    original: Box<dyn Motion>,
    query: Query,
    robot: SharedRobot,
    stage: Stage,
    /// Whether it is to begin only when nothing else is under way, since it does not go together with what was.
    waits_for_all: bool,
}

enum Stage {
    /// Nothing has been sent. Since when it has waited to hear the robot.
    Begin(Option<Duration>),
    /// The camera was asked.
    Looking(GoalTicket, Duration),
    /// The robot has goals.
    Moving(Box<Moving>),
    /// The robot is to stand still, since when, and how the motion ends then.
    Stopping(Duration, Vec<Sent>, Ending),
    /// The robot stands still, and the motion ends so when it goes on.
    Failed(Box<MotionFailure>),
    /// The motion has ended.
    Over,
}

enum Ending {
    /// It has failed.
    Failed(Box<MotionFailure>),
    /// It was cancelled.
    Cancelled,
    /// It was paused, and begins anew when it goes on.
    Anew,
}

/// A goal that a part has got.
struct Sent {
    order: Order,
    interface: PartInterface,
    ticket: GoalTicket,
    end: Option<RobotEnd>,
    /// When it was sent, and how long (s) it may take.
    since: Duration,
    time_out: f64,
}

struct Moving {
    sent: Vec<Sent>,
    /// The motion in the world here, until it has ended.
    here: Option<Box<dyn Motion>>,
    outcome: MotionOutcome,
    /// The world as it is to be at the end.
    end: World,
    /// Since when all goals are reported to be reached.
    reported: Option<Duration>,
    /// Whether the robot has been found where it was to be.
    is_checked: bool,
}

impl Moving {
    /// Whether goals were cancelled by this program.
    fn is_stopped(&self) -> bool {
        let mut ends = self.sent.iter().filter_map(|sent| sent.end.as_ref());
        ends.any(|end| end.is_cancelled)
    }
}

impl RealMotion {
    pub(super) fn new(original: Box<dyn Motion>, query: Query, robot: SharedRobot) -> Self {
        Self {
            module: original.module(),
            original,
            query,
            robot,
            stage: Stage::Begin(None),
            waits_for_all: false,
        }
    }

    fn now(&self) -> Duration {
        self.robot.link.borrow().now()
    }

    fn failure(&self, trouble: RobotTrouble) -> Box<MotionFailure> {
        let module = self.module;
        Box::new(MotionFailure::Robot(Box::new(RobotFailure {
            module,
            trouble,
        })))
    }

    /// The gap (m) above that of closed fingers up to which nothing is between them.
    fn closed(&self) -> f64 {
        let parts = self.robot.interface.parts.iter();
        let grippers = parts.filter(|part| matches!(part.part, RobotPart::Gripper(_)));
        let tolerances = grippers.map(|part| part.tolerance);
        tolerances.reduce(f64::max).unwrap_or_default()
    }

    /// Hears how the robot is, tries the motion, and sends its goals.
    fn begin(&mut self, world: &mut World, since: Option<Duration>) -> MotionStatus {
        let must_wait = match self.waits_for_all {
            true => !self.robot.is_idle(),
            false => self.robot.must_wait(self.module),
        };
        let companions = match must_wait {
            true => None,
            false => self.robot.companions(),
        };
        let Some(companions) = companions else {
            self.stage = Stage::Begin(None);
            return MotionStatus::Running;
        };
        let now = self.now();
        let since = since.unwrap_or(now);
        self.stage = Stage::Begin(Some(since));
        let told = match Told::now(&self.robot, world) {
            Ok(told) => told,
            Err(trouble) => {
                // At first, the robot has to be found.
                let waited = now.saturating_sub(since).as_secs_f64();
                let waits =
                    !self.robot.was_heard.get() && waited < self.robot.interface.server_time_out;
                if waits {
                    return MotionStatus::Running;
                }
                return self.fail(self.failure(trouble));
            }
        };
        let robot = Rc::clone(&self.robot);
        // What moves already is followed by the motions here that belong to it.
        let is_free = |part| !robot.is_busy(part);
        told.believe(world, is_free, self.closed());
        if let Some(query) = &self.query {
            let one = match query.types.as_slice() {
                [one] => one.as_str(),
                _ => "",
            };
            let name = query.name.clone().unwrap_or_default();
            // A more general type is known here, not to the camera.
            let is_exact = world.models().objects.get(&one.to_lowercase()).is_some();
            let kind = if is_exact { one } else { "" };
            let ticket = self.robot.link.borrow_mut().look(kind, &name);
            self.stage = Stage::Looking(ticket, self.now());
            return MotionStatus::Running;
        }
        let Some(copies) = self.original.copied().zip(self.original.copied()) else {
            let text = "faults cannot be injected into what a real robot does".to_owned();
            return self.fail(self.failure(RobotTrouble::NotPossible(text)));
        };
        let (tried, here) = copies;
        if let Some(order) =
            untried(world, self.original.as_ref()).filter(|_| !robot.is_tried.get())
        {
            // Where it ends is believed when it has ended.
            return self.send(vec![order], None, MotionOutcome::Arrived, world.clone());
        }
        let is_alone = companions.is_empty();
        // Others may be slower than they were tried, or take another way.
        let is_apart = |world: &World| {
            let alone = self.original.copied();
            is_alone || alone.is_some_and(|alone| try_motion(world, alone, Vec::new()).is_ok())
        };
        let trial = match try_motion(world, tried, companions) {
            Ok(trial) if is_apart(world) => trial,
            // What fails here is not tried in earnest.
            Err(Misfit::Fails(failure)) if is_alone => return self.fail(failure),
            _ => {
                self.waits_for_all = true;
                self.stage = Stage::Begin(None);
                return MotionStatus::Running;
            }
        };
        let turns = |joint| told.turns(joint, world);
        let is_busy = |part| robot.is_busy(part);
        let orders = match orders(world, self.original.as_ref(), &trial, turns, is_busy) {
            Ok(orders) => orders,
            Err(trouble) => return self.fail(self.failure(trouble)),
        };
        // Trying may have taken a while.
        let trouble = match Told::now(&self.robot, world) {
            Ok(now) if now.is_as(&told, is_free) => None,
            Ok(_) => {
                self.stage = Stage::Begin(Some(since));
                let waited = self.now().saturating_sub(since).as_secs_f64();
                if waited < self.robot.interface.server_time_out {
                    return MotionStatus::Running;
                }
                Some(RobotTrouble::NoState(
                    "the robot moves by itself".to_owned(),
                ))
            }
            Err(trouble) => Some(trouble),
        };
        if let Some(trouble) = trouble {
            return self.fail(self.failure(trouble));
        }
        let here = trial.begun.or(Some(here));
        self.send(orders, here, trial.outcome, trial.world)
    }

    /// Sends goals, so that something moves.
    fn send(
        &mut self,
        orders: Vec<Order>,
        here: Option<Box<dyn Motion>>,
        outcome: MotionOutcome,
        end: World,
    ) -> MotionStatus {
        let mut goals = Vec::new();
        let mut interfaces = Vec::new();
        for order in &orders {
            let part = order.part;
            let Some(interface) = self.robot.interface.part(part).cloned() else {
                let text = format!("there is no action for the part {}", part.name());
                return self.fail(self.failure(RobotTrouble::NotPossible(text)));
            };
            let time_out = interface.time_out + order.goal.duration();
            goals.push((part, order.goal.clone(), time_out));
            interfaces.push(interface);
        }
        // Only now does anything move.
        let tickets = self.robot.link.borrow_mut().send(&goals);
        let since = self.now();
        // What moves nothing keeps nobody waiting.
        if !orders.is_empty() {
            self.robot.under_way.borrow_mut().push(UnderWay {
                module: self.module,
                parts: orders.iter().map(|order| order.part).collect(),
                copy: None,
            });
        }
        let goals = goals.into_iter().zip(tickets).zip(interfaces);
        let sent = orders.into_iter().zip(goals);
        let sent = sent.map(|(order, (((_, _, time_out), ticket), interface))| Sent {
            order,
            interface,
            ticket,
            end: None,
            since,
            time_out,
        });
        self.stage = Stage::Moving(Box::new(Moving {
            sent: sent.collect(),
            here,
            outcome,
            end,
            reported: None,
            is_checked: false,
        }));
        MotionStatus::Running
    }

    fn fail(&mut self, failure: Box<MotionFailure>) -> MotionStatus {
        self.stage = Stage::Over;
        MotionStatus::Failed(failure)
    }

    fn look(&mut self, world: &mut World, ticket: GoalTicket, since: Duration) -> MotionStatus {
        let seen = self.robot.link.borrow_mut().seen(ticket);
        let (Some(seen), Some(query)) = (seen, self.query.clone()) else {
            let waited = self.now().saturating_sub(since).as_secs_f64();
            if waited > LOST {
                let name = self.robot.interface.perception.clone();
                return self.fail(self.failure(RobotTrouble::NoAnswer { name, waited }));
            }
            // A robot that tells nothing any more does not see either.
            return match Told::now(&self.robot, world) {
                Ok(_) => MotionStatus::Running,
                Err(trouble) => self.fail(self.failure(trouble)),
            };
        };
        self.stage = Stage::Over;
        match seen {
            Ok(seen) => sight::believe(world, &query, seen),
            Err(trouble) => MotionStatus::Failed(self.failure(trouble)),
        }
    }

    /// A step while the robot moves: how it ends, if it does.
    fn go_on(
        &self,
        moving: &mut Moving,
        world: &mut World,
    ) -> Result<Option<MotionOutcome>, Box<MotionFailure>> {
        self.hear_ends(&mut moving.sent)
            .map_err(|trouble| self.failure(trouble))?;
        let told = Told::now(&self.robot, world).map_err(|trouble| self.failure(trouble))?;
        // Fingers here move when those of the robot have: what they hold must not be held before.
        let waits = self.module == ProcessModule::Grippers && !moving.is_checked;
        if let Some(here) = moving.here.as_mut().filter(|_| !waits) {
            match here.tick(world) {
                MotionStatus::Running => {}
                MotionStatus::Done(outcome) => {
                    moving.outcome = outcome;
                    moving.here = None;
                }
                MotionStatus::Failed(failure) => return Err(failure),
            }
        }
        let parts: Vec<RobotPart> = moving.sent.iter().map(|sent| sent.order.part).collect();
        self.robot.leave_copy(&parts, moving.here.as_deref());
        let is_reported = moving.sent.iter().all(|sent| sent.end.is_some());
        if !is_reported || moving.is_stopped() {
            return Ok(None);
        }
        let now = self.now();
        let reported = *moving.reported.get_or_insert(now);
        if !moving.is_checked {
            let trouble = moving.sent.iter().find_map(|sent| {
                let fingers = sent.end.as_ref().and_then(|end| end.fingers);
                let missed = self.robot.missed(sent.order.part);
                let (order, interface) = (&sent.order, &sent.interface);
                check::trouble(order, interface, &told, &moving.end, fingers, missed)
            });
            match trouble {
                // What it tells of itself may come later than what it reports.
                Some(_) if now.saturating_sub(reported) < SETTLING => return Ok(None),
                Some(trouble) => {
                    self.note_missed(moving, true);
                    return Err(self.failure(trouble));
                }
                None => {
                    self.note_missed(moving, false);
                    moving.is_checked = true;
                }
            }
        }
        if moving.here.is_some() {
            return Ok(None);
        }
        told.believe(world, |part| parts.contains(&part), self.closed());
        Ok(Some(moving.outcome.clone()))
    }

    /// Remembers which hands have missed what they were to grip, and which have not, or are open.
    fn note_missed(&self, moving: &Moving, has_missed: bool) {
        for Sent { order, .. } in &moving.sent {
            let met = check::met(order, &moving.end).filter(|_| has_missed);
            let before = self.robot.missed(order.part).filter(|_| has_missed);
            let gap = met.into_iter().chain(before).reduce(f64::max);
            self.robot.note_missed(order.part, gap);
        }
    }

    /// Hears how goals have ended.
    fn hear_ends(&self, sent: &mut [Sent]) -> Result<(), RobotTrouble> {
        for sent in sent.iter_mut().filter(|sent| sent.end.is_none()) {
            let end = self.robot.link.borrow_mut().end(sent.ticket);
            let Some(mut end) = end else {
                let taken = self.now().saturating_sub(sent.since).as_secs_f64();
                if taken > sent.time_out + LOST {
                    return Err(RobotTrouble::Late {
                        name: sent.interface.name.clone(),
                        limit: taken,
                        has_ended: false,
                    });
                }
                continue;
            };
            // Fingers that something between them has stopped hold it, whatever their server makes of that.
            let is_stalled = end.fingers.is_some_and(|fingers| fingers.is_stalled);
            if let Some(RobotTrouble::Aborted { .. }) = &end.trouble
                && sent.order.grips
                && is_stalled
            {
                end.trouble = None;
            }
            let trouble = end.trouble.clone();
            sent.end = Some(end);
            if let Some(trouble) = trouble {
                return Err(trouble);
            }
        }
        Ok(())
    }

    /// The parts that this motion uses are free again.
    fn free(&self, moving: &Moving) {
        let parts: Vec<RobotPart> = moving.sent.iter().map(|sent| sent.order.part).collect();
        self.robot.free(&parts);
    }
}

impl Motion for RealMotion {
    fn module(&self) -> ProcessModule {
        self.module
    }

    fn tick(&mut self, world: &mut World) -> MotionStatus {
        match std::mem::replace(&mut self.stage, Stage::Over) {
            Stage::Begin(since) => self.begin(world, since),
            Stage::Looking(ticket, since) => {
                self.stage = Stage::Looking(ticket, since);
                self.look(world, ticket, since)
            }
            Stage::Moving(mut moving) => match self.go_on(&mut moving, world) {
                // The robot was stopped, but not by this motion: it begins anew if the plan goes on.
                _ if moving.is_stopped() => {
                    self.stop(moving.sent, Ending::Anew);
                    MotionStatus::Running
                }
                Ok(None) => {
                    self.stage = Stage::Moving(moving);
                    MotionStatus::Running
                }
                Ok(Some(outcome)) => {
                    self.free(&moving);
                    MotionStatus::Done(outcome)
                }
                Err(failure) => {
                    self.stop(moving.sent, Ending::Failed(failure));
                    MotionStatus::Running
                }
            },
            Stage::Stopping(since, sent, ending) => {
                self.stage = Stage::Stopping(since, sent, ending);
                if !self.stands(world) {
                    return MotionStatus::Running;
                }
                match std::mem::replace(&mut self.stage, Stage::Over) {
                    Stage::Stopping(_, _, Ending::Failed(failure)) => MotionStatus::Failed(failure),
                    Stage::Stopping(_, _, Ending::Anew) => {
                        self.stage = Stage::Begin(None);
                        MotionStatus::Running
                    }
                    _ => MotionStatus::Done(MotionOutcome::Arrived),
                }
            }
            Stage::Failed(failure) => MotionStatus::Failed(failure),
            Stage::Over => MotionStatus::Done(MotionOutcome::Arrived),
        }
    }

    fn cancel(&mut self) {
        match std::mem::replace(&mut self.stage, Stage::Over) {
            Stage::Moving(moving) => self.stop(moving.sent, Ending::Cancelled),
            Stage::Stopping(since, sent, _) => {
                self.stage = Stage::Stopping(since, sent, Ending::Cancelled);
            }
            _ => {}
        }
    }

    fn is_moving(&self) -> bool {
        matches!(self.stage, Stage::Moving(_) | Stage::Stopping(..))
    }

    fn brake(&mut self, world: &mut World) {
        if let Stage::Moving(_) = &self.stage
            && let Stage::Moving(moving) = std::mem::replace(&mut self.stage, Stage::Over)
        {
            self.stop(moving.sent, Ending::Anew);
        }
        if !self.stands(world) {
            self.robot.link.borrow().wait();
            return;
        }
        if let Stage::Stopping(..) = &self.stage {
            self.stage = match std::mem::replace(&mut self.stage, Stage::Over) {
                Stage::Stopping(_, _, Ending::Anew) => Stage::Begin(None),
                Stage::Stopping(_, _, Ending::Failed(failure)) => Stage::Failed(failure),
                _ => Stage::Over,
            };
        }
    }

    fn progress(&self) -> Progress {
        match &self.stage {
            Stage::Begin(_) => Progress {
                what: "waiting for the robot",
                fraction: 0.0,
            },
            Stage::Looking(..) => Progress {
                what: "asking the camera",
                fraction: 0.0,
            },
            Stage::Moving(moving) => match &moving.here {
                Some(here) => here.progress(),
                None => Progress {
                    what: "waiting for the robot to arrive",
                    fraction: 1.0,
                },
            },
            Stage::Stopping(..) | Stage::Failed(_) | Stage::Over => Progress {
                what: "stopping",
                fraction: 1.0,
            },
        }
    }

    fn is_elsewhere(&self) -> bool {
        true
    }

    fn planned(&self) -> Option<PlannedTrajectory<'_>> {
        match &self.stage {
            Stage::Moving(moving) => moving.here.as_ref()?.planned(),
            _ => None,
        }
    }

    /// A robot carries a motion out once.
    fn copied(&self) -> Option<Box<dyn Motion>> {
        None
    }

    fn before_planning(&self) -> Option<Box<dyn Motion>> {
        match &self.stage {
            Stage::Begin(since) => Some(Box::new(Self {
                module: self.module,
                original: self.original.copied()?,
                query: self.query.clone(),
                robot: Rc::clone(&self.robot),
                stage: Stage::Begin(*since),
                waits_for_all: self.waits_for_all,
            })),
            _ => None,
        }
    }
}

impl Drop for RealMotion {
    /// Nobody looks after the goals any more.
    fn drop(&mut self) {
        let robot: &RobotAccess = &self.robot;
        let sent = match &self.stage {
            Stage::Moving(moving) => &moving.sent,
            Stage::Stopping(_, sent, _) => sent,
            _ => return,
        };
        for sent in sent {
            if sent.end.is_none() {
                robot.link.borrow_mut().cancel(sent.ticket);
            }
            robot.free(&[sent.order.part]);
        }
    }
}
