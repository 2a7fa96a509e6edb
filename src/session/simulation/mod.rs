//! The simulated robot in its world, as plans reach it: motions under way, what the hands
//! hold and how it was grasped, and the names under which people know the objects.
//!
//! Everything that a plan asks of the world comes here as a request of a builtin.

pub(crate) mod call;
mod explain;
mod film;
mod following;
mod functions;
mod grasp_search;
mod held;
mod imagined;
mod motions;
mod names;
mod pace;
pub(super) mod parts;
mod pose_argument;
mod properties;
mod raising;
pub(crate) mod request;
mod snapshots;
mod tables;
pub(crate) mod tour;
mod transforms;

use std::cell::OnceCell;
use std::collections::VecDeque;
use std::sync::Arc;

use indexmap::IndexMap;

use super::{SessionError, SessionOptions};
use crate::lisp::value::Value;
use crate::motion::{DetectQuery, Motion, ProcessModule};
use crate::picture;
use crate::picture::Looks;
use crate::plan::{TaskId, Ticket};
use crate::spatial::Pose;
use crate::watch::live::{PaceControl, Speed};
use crate::world::grasp_library::{GRASPS, GraspLibrary};
use crate::world::object_library::ObjectLibrary;
use crate::world::{Models, RobotConfiguration, World};

pub(crate) use film::Filming;
pub(crate) use following::FollowerId;
pub(crate) use functions::watching::WatchError;
use pace::Pace;
pub(crate) use tables::install;

/// A motion that a task waits for.
struct Job {
    ticket: Ticket,
    module: ProcessModule,
    motion: Box<dyn Motion>,
    /// The designator that failures name.
    subject: Value,
    /// The task that waits.
    task: TaskId,
    /// What kind of motion it is, for people.
    name: String,
    is_paused: bool,
}

/// Coordinate axes that a person asked to see.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Axes {
    /// Where, in the map frame.
    pub(crate) pose: Pose,
    /// Length of the bars (m).
    pub(crate) size: f64,
}

/// Looks at the world after every step of a motion.
pub(crate) type Observer = Box<dyn FnMut(&World)>;

/// The robot in its world.
pub(crate) struct Simulation {
    models: Arc<Models>,
    world: World,
    grasps: GraspLibrary,
    /// The symbol under which each object was spawned, by its name in the world.
    names: IndexMap<String, Value>,
    held: IndexMap<String, held::Held>,
    /// Motions under way, in order of their start.
    active: Vec<Job>,
    /// Motions that have been ticked for the step to come, when an interrupt came between.
    partial_step: Option<request::PartialStep>,
    /// Motions that wait for a process module, in order.
    waiting: VecDeque<Job>,
    next_ticket: u64,
    /// The task whose request is carried out.
    asking: TaskId,
    axes: Option<Axes>,
    log_level: LogLevel,
    pace: Option<Pace>,
    /// The exit status, once somebody has asked to leave.
    pub(super) quit: Option<u8>,
    observer: Option<Observer>,
    /// The last failure of a motion, to be explained on demand.
    last_failure: Option<Box<explain::Remembered>>,
    /// What was looked for last.
    sought: Option<DetectQuery>,
    /// Pictures that were made and not yet told of.
    pictures: Vec<Arc<picture::Image>>,
    looks: OnceCell<Looks>,
    film: Option<film::Film>,
    followers: following::Followers,
    watching: functions::watching::Watching,
    /// Simulated time (s) as the scheduler told it last.
    now: f64,
    snapshots: snapshots::Snapshots,
    /// The step of the tour that comes next, from zero.
    tour_step: usize,
    /// A value that somebody wants to take apart.
    pub(super) inspected: Option<Value>,
}

/// Severity of log lines.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum LogLevel {
    /// Everything.
    Debug,
    /// Progress of plans.
    Info,
    /// What may be wrong.
    Warn,
    /// What is wrong.
    Error,
    /// Nothing.
    None,
}

impl Simulation {
    /// The robot as after start-up: at the origin of the map, its arms tucked.
    pub(super) fn new(
        models: Arc<Models>,
        options: &SessionOptions,
    ) -> Result<Simulation, SessionError> {
        let grasps = GraspLibrary::from_sexp(GRASPS, "grasps.sexp")
            .map_err(|error| SessionError::Models(error.to_string()))?;
        Ok(Simulation {
            world: starting_world(&models),
            models,
            grasps,
            names: IndexMap::new(),
            held: IndexMap::new(),
            active: Vec::new(),
            partial_step: None,
            waiting: VecDeque::new(),
            next_ticket: 0,
            asking: TaskId(0),
            axes: None,
            log_level: options.log_level,
            pace: (options.realtime)
                .map(|factor| Pace::new(PaceControl::new(Speed::Times(factor)))),
            quit: None,
            observer: None,
            last_failure: None,
            sought: None,
            pictures: Vec::new(),
            looks: OnceCell::new(),
            film: None,
            followers: following::Followers::default(),
            watching: functions::watching::Watching::default(),
            now: 0.0,
            snapshots: snapshots::Snapshots::default(),
            tour_step: 0,
            inspected: None,
        })
    }

    /// Takes the world back to the start: no objects, the robot at the origin. Simulated
    /// time goes on.
    fn restart(&mut self) {
        self.world = starting_world(&self.models);
        self.names.clear();
        self.held.clear();
        self.axes = None;
        self.sought = None;
    }

    /// Simulated time (s).
    pub(crate) fn now(&self) -> f64 {
        self.now
    }

    /// The world.
    pub(crate) fn world(&self) -> &World {
        &self.world
    }

    /// How everything looks.
    fn looks(&self) -> &Looks {
        self.looks.get_or_init(|| Looks::of(&self.models))
    }

    /// The types of objects that can be spawned.
    pub(crate) fn object_types(&self) -> &ObjectLibrary {
        &self.models.objects
    }

    /// How objects are grasped.
    pub(crate) fn grasp_library(&self) -> &GraspLibrary {
        &self.grasps
    }

    /// Has a function look at the world after every step that a motion takes.
    pub(crate) fn set_observer(&mut self, observer: Observer) {
        self.observer = Some(observer);
    }

    fn observe(&mut self) {
        if let Some(observer) = &mut self.observer {
            observer(&self.world);
        }
    }

    /// The coordinate axes to be shown, if any.
    pub(crate) fn axes(&self) -> Option<&Axes> {
        self.axes.as_ref()
    }

    /// The pose of the robot's base in the map frame.
    fn base(&self) -> Pose {
        self.world.robot_configuration().base
    }
}

fn starting_world(models: &Arc<Models>) -> World {
    let robot = RobotConfiguration {
        base: Pose::identity(),
        joints: models.description.start_positions(&models.robot),
    };
    World::new(models.clone(), robot)
}
