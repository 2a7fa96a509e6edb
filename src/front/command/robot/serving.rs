//! Carries out goals, one after the other, while others are answered.
//!
//! The session stays in its thread, which carries out one goal at a time. Another thread answers clients, hands goals
//! over, and interrupts the one under way when it is to end.

use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use super::super::failure::{CommandError, Status};
use super::super::ros2::Publishing;
use super::goal::{Call, Deed, Ended};
use super::offered::{Offered, offered};
use super::sight::see;
use robotics::world::Models;
use ros::action::{GoalEnd, GoalId};
use ros::wire::{ActionServer, Newest, RequestId, Service, Wish};
use ros::{SceneModel, Value, service_type};
use session::{Failure, InterruptHandle, Session};

/// What the goals are for the robot.
const ACTIONS: &str = include_str!("actions.plan");

/// The class of failures of what the arms cannot do, whatever is in the way.
const REFUSED: &str = "MANIPULATION-POSE-UNREACHABLE";

/// The service that tells what the camera sees.
const DETECT: &str = "planwright_msgs/srv/DetectObjects";

/// How long the goal of a part may come after that of another one if both are to move at once.
const TOGETHER: Duration = Duration::from_millis(60);

/// Real time between two looks at what clients have sent.
const BETWEEN_LOOKS: Duration = Duration::from_millis(3);

/// Real time between two messages about how far a goal is.
const BETWEEN_FEEDBACK: Duration = Duration::from_millis(100);

/// A goal: which action it is of, and its identity.
type Key = (usize, GoalId);

/// What the session is to do.
enum Order {
    /// Carry a goal out.
    Goal(Key, Deed, Value),
    /// Tell what the camera sees.
    See(RequestId, Value),
}

/// What the session has done.
enum Done {
    /// A goal has ended.
    Goal(Key, Ended),
    /// What the camera sees, as a message.
    Seen(RequestId, Value),
}

/// What both threads know.
#[derive(Default)]
struct Shared {
    /// The goals that are carried out: one, or trajectories of several parts.
    running: Vec<Key>,
    /// Goals that are to end.
    unwanted: Vec<Key>,
}

type Both = Arc<Mutex<Shared>>;

fn lock(both: &Both) -> MutexGuard<'_, Shared> {
    both.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Carries out goals until Ctrl-C.
pub(super) fn serve(
    mut session: Session,
    mut publishing: Publishing,
) -> Result<Status, CommandError> {
    let wrong = |error: &dyn ToString| CommandError::Open(error.to_string());
    let defined = session.run("actions.plan", ACTIONS);
    defined.map_err(|failure| wrong(&failure))?;
    let node = &mut publishing.node;
    let models = Arc::clone(session.models());
    let offered: Arc<[Offered]> = offered(&models).into();
    let servers = offered
        .iter()
        .map(|offered| ActionServer::open(node, &offered.name, offered.action))
        .collect::<Result<Vec<_>, _>>();
    let servers = servers.map_err(|error| wrong(&error))?;
    let camera = &models.description.interface.perception;
    let [request, response] = service_type(DETECT);
    let perception = node.service(camera, request, response);
    let perception = perception.map_err(|error| wrong(&error))?;
    let stop = Arc::new(AtomicBool::new(false));
    let (flag, interrupter) = (Arc::clone(&stop), session.interrupter());
    let handled = ctrlc::set_handler(move || {
        flag.store(true, Ordering::Relaxed);
        interrupter.interrupt();
    });
    handled.map_err(|error| wrong(&error))?;
    let both = Both::default();
    let (orders, ordered) = channel();
    let (ends, ended) = channel();
    let broadcast = &publishing.broadcast;
    let (scene, newest) = (Arc::clone(broadcast.model()), broadcast.newest().clone());
    let desk = Desk {
        servers,
        perception,
        offered: Arc::clone(&offered),
        both: Arc::clone(&both),
        orders,
        ended,
        under_way: Vec::new(),
        interrupter: session.interrupter(),
        models: Arc::clone(&models),
        scene: Arc::clone(&scene),
        newest: newest.clone(),
        stop: Arc::clone(&stop),
    };
    let desk = thread::Builder::new()
        .name("actions".to_owned())
        .spawn(move || desk.run())?;
    for offered in &*offered {
        writeln!(io::stdout(), "{} ({})", offered.name, offered.action)?;
    }
    writeln!(io::stdout(), "{camera} ({DETECT})")?;
    io::stdout().flush()?;
    let mut next = None;
    while !stop.load(Ordering::Relaxed) {
        let order = match next.take() {
            Some(order) => Ok(order),
            None => ordered.recv_timeout(Duration::from_millis(50)),
        };
        match order {
            Ok(Order::Goal(key, deed, goal)) => {
                let mut goals = vec![(key, deed, goal)];
                // Parts that are to move at once are sent their goals one after the other.
                let parts = offered.iter();
                let parts = parts.filter(|offered| matches!(offered.deed, Deed::Follow(_)));
                let parts = parts.count();
                while matches!(deed, Deed::Follow(_)) && goals.len() < parts && next.is_none() {
                    let is_new = |deed: &Deed| goals.iter().all(|(_, known, _)| known != deed);
                    match ordered.recv_timeout(TOGETHER) {
                        Ok(Order::Goal(key, deed @ Deed::Follow(_), goal)) if is_new(&deed) => {
                            goals.push((key, deed, goal));
                        }
                        Ok(other) => next = Some(other),
                        Err(_) => break,
                    }
                }
                for (key, end) in carry_out(&mut session, &both, &goals, &models, &scene, &newest) {
                    drop(ends.send(Done::Goal(key, end)));
                }
            }
            Ok(Order::See(request, question)) => {
                let answer = see(&mut session, &question, scene.map);
                drop(ends.send(Done::Seen(request, answer)));
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => break,
        }
    }
    stop.store(true, Ordering::Relaxed);
    // A thread that has failed has said why.
    drop(desk.join());
    drop(publishing);
    session.end_with_process();
    Ok(Status::Good)
}

/// Carries out goals, except for those that are to end already.
fn carry_out(
    session: &mut Session,
    both: &Both,
    goals: &[(Key, Deed, Value)],
    models: &Models,
    scene: &SceneModel,
    newest: &Newest,
) -> Vec<(Key, Ended)> {
    let state = newest.state();
    let mut ends = Vec::new();
    let mut calls = Vec::new();
    for (key, deed, goal) in goals {
        if lock(both).unwanted.contains(key) {
            ends.push((*key, Ended::Interrupted));
            continue;
        }
        match deed.prepare(goal, models, scene, &state) {
            Ok(call) => calls.push((*key, call)),
            Err(ended) => ends.push((*key, ended)),
        }
    }
    let keys: Vec<Key> = calls.iter().map(|(key, _)| *key).collect();
    let calls = calls.into_iter().map(|(_, call)| call);
    let Some(call) = calls.reduce(Call::together) else {
        return ends;
    };
    {
        let mut shared = lock(both);
        shared.running.clone_from(&keys);
    }
    let (function, arguments) = call.arguments();
    let ended = match session.call(function, &arguments) {
        Ok(_) => Ended::Reached,
        Err(Failure::Interrupted) => Ended::Interrupted,
        Err(failure) => match failure.unhandled() {
            Some(condition) if condition.abort.class == REFUSED => {
                Ended::Refused(condition.abort.report.trim_end().to_owned())
            }
            Some(condition) => Ended::Failed(condition.abort.report.trim_end().to_owned()),
            None => Ended::Failed(failure.to_string()),
        },
    };
    lock(both).running.clear();
    if ended != Ended::Reached {
        // What was under way brakes; whoever hears of the end finds a robot that stands.
        drop(session.call("planwright-robot::come-to-rest", &[]));
    }
    ends.extend(keys.into_iter().map(|key| (key, ended.clone())));
    ends
}

/// A goal that has been accepted and has not ended.
struct UnderWay {
    key: Key,
    goal: Value,
    begun: Option<Instant>,
    /// Why it is to end, and whether its evaluation has been interrupted.
    ending: Option<(Why, bool)>,
    told: Option<Instant>,
}

/// Why a goal is to end.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Why {
    /// A client wants that.
    Canceled,
    /// There is another goal of the same action.
    Replaced,
}

/// Answers clients.
struct Desk {
    servers: Vec<ActionServer>,
    perception: Service,
    offered: Arc<[Offered]>,
    both: Both,
    orders: Sender<Order>,
    ended: Receiver<Done>,
    under_way: Vec<UnderWay>,
    interrupter: InterruptHandle,
    models: Arc<Models>,
    scene: Arc<SceneModel>,
    newest: Newest,
    stop: Arc<AtomicBool>,
}

impl Desk {
    fn run(mut self) {
        while !self.stop.load(Ordering::Relaxed) {
            self.hear();
            self.hear_questions();
            self.begin();
            self.interrupt();
            self.end();
            self.tell();
            thread::sleep(BETWEEN_LOOKS);
        }
    }

    /// Takes what clients want.
    fn hear(&mut self) {
        for (action, offered) in self.offered.iter().enumerate() {
            let Some(server) = self.servers.get_mut(action) else {
                continue;
            };
            for wish in server.poll(|goal| offered.deed.fits(goal)) {
                match wish {
                    Wish::Begin(id, goal) => {
                        for older in self.under_way.iter_mut().filter(|it| it.key.0 == action) {
                            give_up(&self.both, older, Why::Replaced);
                        }
                        let key = (action, id);
                        self.under_way.push(UnderWay {
                            key,
                            goal: goal.clone(),
                            begun: None,
                            ending: None,
                            told: None,
                        });
                        // Without the session there is nobody left to tell.
                        drop(self.orders.send(Order::Goal(key, offered.deed, goal)));
                    }
                    Wish::Cancel(id) => {
                        let key = (action, id);
                        for goal in self.under_way.iter_mut().filter(|it| it.key == key) {
                            give_up(&self.both, goal, Why::Canceled);
                        }
                    }
                }
            }
        }
    }

    /// Takes questions to the camera.
    fn hear_questions(&self) {
        while let Some((request, question)) = self.perception.take() {
            // Without the session there is nobody left to tell.
            drop(self.orders.send(Order::See(request, question)));
        }
    }

    /// Tells that a goal is carried out from now on.
    fn begin(&mut self) {
        let running = lock(&self.both).running.clone();
        for goal in &mut self.under_way {
            if running.contains(&goal.key) && goal.begun.is_none() {
                goal.begun = Some(Instant::now());
                if let Some(server) = self.servers.get_mut(goal.key.0) {
                    server.begin(&goal.key.1);
                }
            }
        }
    }

    /// Interrupts the evaluation of a goal that is to end, once.
    fn interrupt(&mut self) {
        for goal in &mut self.under_way {
            let Some((_, interrupted @ false)) = &mut goal.ending else {
                continue;
            };
            // While this is locked, the session does not go on to another goal.
            let shared = lock(&self.both);
            if shared.running.contains(&goal.key) {
                // False while the evaluation is about to begin.
                *interrupted = self.interrupter.interrupt();
            }
        }
    }

    /// Tells how goals have ended.
    fn end(&mut self) {
        while let Ok(done) = self.ended.try_recv() {
            let (key, ended) = match done {
                Done::Goal(key, ended) => (key, ended),
                Done::Seen(request, answer) => {
                    self.perception.reply(request, &answer);
                    continue;
                }
            };
            let Some(at) = self.under_way.iter().position(|goal| goal.key == key) else {
                continue;
            };
            let goal = self.under_way.remove(at);
            lock(&self.both).unwanted.retain(|known| *known != key);
            let why = goal.ending.map(|(why, _)| why);
            let end = match (&ended, why) {
                (Ended::Reached, _) => GoalEnd::Succeeded,
                (Ended::Interrupted, Some(Why::Canceled)) => GoalEnd::Canceled,
                _ => GoalEnd::Aborted,
            };
            let deed = self.offered.get(key.0).map(|offered| offered.deed);
            let (Some(server), Some(deed)) = (self.servers.get_mut(key.0), deed) else {
                continue;
            };
            let state = self.newest.state();
            let result = deed.result(&goal.goal, &ended, &self.models, &self.scene, &state);
            server.end(&key.1, end, result);
        }
    }

    /// Tells how far goals are.
    fn tell(&mut self) {
        let now = Instant::now();
        for goal in &mut self.under_way {
            let Some(begun) = goal.begun else {
                continue;
            };
            let is_early = |told: Instant| now.duration_since(told) < BETWEEN_FEEDBACK;
            if goal.told.is_some_and(is_early) {
                continue;
            }
            goal.told = Some(now);
            let deed = self.offered.get(goal.key.0).map(|offered| offered.deed);
            let stamp = SystemTime::now().duration_since(UNIX_EPOCH);
            let time = [stamp.unwrap_or_default(), now.duration_since(begun)];
            let state = self.newest.state();
            let feedback = deed.and_then(|deed| {
                deed.feedback(&goal.goal, &self.models, &self.scene, &state, time)
            });
            if let (Some(server), Some(feedback)) = (self.servers.get(goal.key.0), feedback) {
                server.feedback(&goal.key.1, feedback);
            }
        }
    }
}

/// Lets a goal end. The first reason counts.
fn give_up(both: &Both, goal: &mut UnderWay, why: Why) {
    if goal.ending.is_none() {
        goal.ending = Some((why, false));
        lock(both).unwanted.push(goal.key);
    }
}
