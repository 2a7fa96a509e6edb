//! A robot that is reached over ROS 2, as a session drives it.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use super::super::failure::CommandError;
use super::super::ros2::{open_node, say, warn};
use super::desk::{BASE_TIME, Desk, Endpoints, Order, Shared, Signals, Wanted, lock, seconds};
use robotics::motion::RobotTrouble;
use robotics::robot::{RobotInterface, RobotPart};
use session::Session;
use session::dialogue::Evaluate;
use session::outside::{GoalTicket, PartGoal, RobotEnd, RobotLink, RobotState, SeenObject};

/// How long [`RobotLink::wait`] waits.
const MOMENT: Duration = Duration::from_millis(4);
/// What moves more slowly (rad/s or m/s) stands still.
const STILL: f64 = 0.01;

/// A robot that plans drive; all its goals are cancelled when this ends.
pub(crate) struct Driving {
    halt: Arc<AtomicBool>,
    stop: Arc<AtomicBool>,
    desk: Option<JoinHandle<()>>,
}

impl Driving {
    /// Lets the robot stop when it is set, whatever the session does.
    pub(crate) fn halt(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.halt)
    }
}

impl Drop for Driving {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(desk) = self.desk.take() {
            // If it has failed, it has said why.
            drop(desk.join());
        }
    }
}

/// Lets plans of the session drive the robot whose actions its description names, with the messages of a
/// distribution, or of the environment's if the name is empty. Prints on standard error who can hear it.
pub(crate) fn connect(session: &mut Session, distribution: &str) -> Result<Driving, CommandError> {
    let wrong = |error: &dyn ToString| CommandError::Open(error.to_string());
    let (node, distribution) = open_node("planwright_plan", distribution)?;
    let reach = node.reach();
    let models = session.models();
    let description = &models.description;
    let link_name = |link| models.robot.link(link).name.clone();
    let interface = description.interface.clone();
    let base = link_name(description.base.frame);
    let camera = link_name(description.camera().frame);
    let sides: Vec<_> = description.sides().collect();
    let has = |part: RobotPart| match part {
        RobotPart::Torso => description.torso.joint.is_some(),
        RobotPart::Neck => !description.neck.joints.is_empty(),
        RobotPart::Arm(side) | RobotPart::Gripper(side) => sides.contains(&side),
        RobotPart::Base => true,
    };
    let parts = interface.parts.iter().filter(|part| has(part.part));
    let parts: Vec<_> = parts.cloned().collect();
    let joints = models.robot.joints();
    let joints = joints.filter(|(_, joint)| joint.is_actuated());
    let joints = joints.map(|(_, joint)| joint.name.clone()).collect();
    let shared = Arc::new(Mutex::new(Shared::default()));
    let begin = Instant::now();
    let known = Arc::clone(&shared);
    let ends = Endpoints::open(node, &interface, &parts).map_err(|error| wrong(&error))?;
    let named = distribution.to_owned();
    let desk = Desk::new(ends, named, &interface, base.clone(), camera, known, begin);
    let (halt, stop) = (Arc::<AtomicBool>::default(), Arc::<AtomicBool>::default());
    let is_idle = Arc::new(AtomicBool::new(true));
    let signals = Signals {
        halt: Arc::clone(&halt),
        is_idle: Arc::clone(&is_idle),
        interrupt: session.interrupt_handle(),
        stop: Arc::clone(&stop),
    };
    let (orders, ordered) = channel();
    let thread = thread::Builder::new().name("robot".to_owned());
    let desk = thread.spawn(move || desk.run(&ordered, &signals))?;
    let link = Link {
        orders,
        shared,
        interface,
        base,
        joints,
        begin,
        next: 0,
    };
    end_at_termination(link.clone(), Arc::clone(&halt), is_idle)?;
    session.drive(Box::new(link));
    say(&format!(
        "Plans drive the robot whose actions are served over ROS 2 ({distribution}) in {reach}"
    ));
    Ok(Driving {
        halt,
        stop,
        desk: Some(desk),
    })
}

/// How long the robot may take to stand still when the program is to end.
const ENDING: Duration = Duration::from_millis(2500);
/// The numbers of the signals that end a program.
#[cfg(unix)]
const TERMINATION: usize = 15;
#[cfg(unix)]
const HANG_UP: usize = 1;

/// When the program is to end (`kill`, a terminal that is closed), the goals are cancelled, and it ends once the robot stands
/// still, or has been waited for.
#[cfg(unix)]
fn end_at_termination(
    link: Link,
    halt: Arc<AtomicBool>,
    is_idle: Arc<AtomicBool>,
) -> Result<(), CommandError> {
    use signal_hook::consts::{SIGHUP, SIGTERM};
    use signal_hook::flag::register_usize;

    let received = Arc::<AtomicUsize>::default();
    for (signal, number) in [(SIGTERM, TERMINATION), (SIGHUP, HANG_UP)] {
        register_usize(signal, Arc::clone(&received), number)?;
    }
    let wait = move || {
        let signal = loop {
            match received.load(Ordering::Relaxed) {
                0 => thread::sleep(5 * MOMENT),
                signal => break signal,
            }
        };
        let begin = link.now();
        let mut was_halted = false;
        loop {
            // Again and again: the session may order something meanwhile.
            halt.store(true, Ordering::Relaxed);
            let has_stopped = is_idle.load(Ordering::Relaxed) && link.stands_still(None, true);
            if was_halted && has_stopped {
                break;
            }
            if link.now().saturating_sub(begin) > ENDING {
                warn(
                    "THE ROBOT DOES NOT STAND STILL, OR DOES NOT TELL. Use the emergency stop if it moves.",
                );
                break;
            }
            thread::sleep(10 * MOMENT);
            was_halted = true;
        }
        let status = if signal == HANG_UP { 129 } else { 143 };
        std::process::exit(status);
    };
    thread::Builder::new()
        .name("ending".to_owned())
        .spawn(wait)?;
    Ok(())
}

/// Elsewhere, the program ends at once.
#[cfg(not(unix))]
fn end_at_termination(_: Link, _: Arc<AtomicBool>, _: Arc<AtomicBool>) -> Result<(), CommandError> {
    Ok(())
}

/// The session's end.
#[derive(Clone)]
struct Link {
    orders: Sender<Order>,
    shared: Arc<Mutex<Shared>>,
    interface: RobotInterface,
    base: String,
    /// All joints that move by themselves.
    joints: Vec<String>,
    begin: Instant,
    next: u64,
}

impl Link {
    fn fresh(&mut self) -> GoalTicket {
        self.next += 1;
        GoalTicket(self.next)
    }

    fn order(&self, order: Order) {
        // Without the other thread, nothing ends: the state grows old, which is told.
        drop(self.orders.send(order));
    }
}

impl RobotLink for Link {
    fn state(&self, joints: &[&str]) -> Result<RobotState, RobotTrouble> {
        let now = self.now();
        let shared = lock(&self.shared);
        let unknown = |error: &dyn ToString| RobotTrouble::NoState(error.to_string());
        let max_age = seconds(self.interface.max_joint_age);
        let position = |joint: &&str| {
            let position = shared.joints.position(joint, max_age, now);
            position.map_err(|error| unknown(&error))
        };
        let joints = joints.iter().map(position).collect::<Result<_, _>>()?;
        let max_age = seconds(self.interface.max_frame_age);
        let base = shared
            .frames
            .pose(&self.base, &self.interface.map, max_age, now);
        Ok(RobotState {
            base: base.map_err(|error| unknown(&error))?,
            joints,
        })
    }

    fn send(&mut self, goals: &[(RobotPart, PartGoal, f64)]) -> Vec<GoalTicket> {
        let tickets: Vec<GoalTicket> = goals.iter().map(|_| self.fresh()).collect();
        let wanted = goals.iter().zip(&tickets);
        let wanted = wanted.map(|((part, goal, time_out), ticket)| Wanted {
            ticket: ticket.0,
            part: *part,
            goal: goal.clone(),
            time_out: seconds(*time_out),
        });
        self.order(Order::Goals(wanted.collect()));
        tickets
    }

    fn end(&mut self, ticket: GoalTicket) -> Option<RobotEnd> {
        lock(&self.shared).ends.remove(&ticket.0)
    }

    fn cancel(&mut self, ticket: GoalTicket) {
        self.order(Order::Cancel(ticket.0));
    }

    fn stands_still(&self, joints: Option<&[&str]>, base: bool) -> bool {
        let now = self.now();
        let shared = lock(&self.shared);
        let max_age = seconds(self.interface.max_joint_age);
        let stand = match joints {
            // A base has none of its own.
            Some([]) => true,
            Some(joints) => stand(&shared, joints.iter().copied(), max_age, now),
            None => stand(
                &shared,
                self.joints.iter().map(String::as_str),
                max_age,
                now,
            ),
        };
        stand && (!base || base_stands(&shared, now))
    }

    fn look(&mut self, type_name: &str, name: &str) -> GoalTicket {
        let ticket = self.fresh();
        self.order(Order::Look(ticket.0, type_name.to_owned(), name.to_owned()));
        ticket
    }

    fn seen(&mut self, ticket: GoalTicket) -> Option<Result<Vec<SeenObject>, RobotTrouble>> {
        lock(&self.shared).seen.remove(&ticket.0)
    }

    fn now(&self) -> Duration {
        self.begin.elapsed()
    }

    fn wait(&self) {
        thread::sleep(MOMENT);
    }

    fn shout(&self, text: &str) {
        warn(text);
    }
}

/// Whether joints that were heard lately do not move.
fn stand<'a>(
    shared: &Shared,
    joints: impl Iterator<Item = &'a str>,
    max_age: Duration,
    now: Duration,
) -> bool {
    let fastest = shared.joints.fastest(joints, max_age, now);
    fastest.is_some_and(|fastest| fastest < STILL)
}

/// Whether the base does not move, by where it was lately.
fn base_stands(shared: &Shared, now: Duration) -> bool {
    let Some((_, last)) = shared.base.back() else {
        return false;
    };
    let mut before = shared.base.iter();
    let before = before.find(|(at, _)| now.saturating_sub(*at) <= 2 * BASE_TIME);
    let Some((since, first)) = before.filter(|(at, _)| now.saturating_sub(*at) >= BASE_TIME) else {
        return false;
    };
    let time = now.saturating_sub(*since).as_secs_f64().max(1e-3);
    let way = (last.translation.vector - first.translation.vector).norm();
    let turn = last.rotation.angle_to(&first.rotation);
    way.max(turn) / time < STILL
}
