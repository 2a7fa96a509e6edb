//! The simulated robot in its world, as plans use it: active motions, what the hands hold
//! and how it was grasped, and the names by which users know the objects.

pub(super) mod containers;
mod explain;
pub(super) mod grasp_choice;
pub(super) mod grasp_search;
pub(super) mod held;
pub(super) mod imagined;
pub(super) mod injection;
pub mod jobs;
pub(crate) mod known_grasps;
pub(super) mod locations;
pub(super) mod mesh_places;
pub(super) mod motion_types;
pub(super) mod motions;
pub(super) mod names;
pub(super) mod obstacle;
pub(super) mod outcome;
mod pose_argument;
pub(super) mod properties;
pub(super) mod reached_grasps;
pub(super) mod real;
pub(super) mod seen;
mod sweep_world;
mod tally;
pub(super) mod target_checks;
pub(super) mod transforms;
mod vain_paths;

use std::cell::{OnceCell, RefCell};
use std::rc::Rc;
use std::sync::Arc;

use indexmap::IndexMap;

use super::log_level::LogLevel;
use lisp::value::Value;
use lisp::value::copy::Copier;
use robotics::location::OutOfReach;
use robotics::motion::DetectQuery;
use robotics::robot::ArmPositions;
use robotics::world::grasp_library::GraspLibrary;
use robotics::world::noise::{Noise, NoiseLevels};
use robotics::world::object_library::ObjectLibrary;
use robotics::world::{Models, RobotConfiguration, World};
use spatial::Pose;
use spatial::pose::from_xy_yaw;
use sweep::relations::Relations;
use view::picture::{LocationMap, Looks};

use injection::SharedInjection;
use jobs::Jobs;
use known_grasps::KnownGrasps;
use mesh_places::MeshPlaces;
use real::SharedRobot;
use tally::Tally;

/// Coordinate axes that the user asked to see.
#[derive(Clone, Debug, PartialEq)]
pub struct Axes {
    /// Their pose in the map frame.
    pub pose: Pose,
    /// Length of the bars (m).
    pub size: f64,
}

/// The robot in its world.
pub struct Simulation {
    pub(super) models: Arc<Models>,
    /// The kitchen in which the session began.
    home: Arc<Models>,
    pub(super) grasps: KnownGrasps,
    /// Where meshes of types of objects are.
    pub(super) meshes: MeshPlaces,
    pub(super) log_level: LogLevel,
    /// The seed of the session.
    seed: u64,
    /// Simulated time (s) last reported by the scheduler.
    pub(super) now: f64,
    looks: OnceCell<Looks>,
    /// What the present run of a plan costs.
    pub(super) tally: Tally,
    /// The faults that may strike motions.
    pub(super) injection: SharedInjection,
    begun_searches: locations::Searches,
    out_of_reach: OutOfReach,
    /// To which grasps no path has been found.
    vain_paths: vain_paths::VainPaths,
    /// The world as it is at the start; copies of the session share it.
    start: Rc<OnceCell<World>>,
    pub(super) world: World,
    /// The symbol under which each object was spawned, by its name in the world.
    pub(super) names: IndexMap<String, Value>,
    pub(super) held: IndexMap<String, held::Held>,
    /// The posture for carrying that was last found for each arm.
    pub(crate) carrying: [Option<ArmPositions>; 2],
    /// Active and waiting motions.
    pub(super) jobs: Jobs,
    pub(super) axes: Option<Axes>,
    /// The map of a location that the user asked to see.
    pub(super) location_map: Option<Arc<LocationMap>>,
    /// The map of the location that was resolved last, for followers.
    pub(super) resolved_map: Option<Arc<LocationMap>>,
    /// The last failure of a motion, to be explained on demand.
    last_failure: Option<Box<explain::Remembered>>,
    /// What the last failed action has told of its attempts, if that is newer.
    pub(super) last_account: Option<String>,
    /// The objects that the robot looked for last.
    sought: Option<DetectQuery>,
    /// How many times the robot has begun to make errors.
    noises: u64,
    /// Facts of other runs that have been read.
    pub(crate) facts: Rc<Relations>,
    /// How many searches for locations have begun in this world.
    pub(super) searches: u64,
    /// What a sweep has put into the world, and where.
    pub(super) put_for_sweep: Vec<(String, Pose)>,
    /// The robot elsewhere that plans can drive, if there is one. Copies have none.
    pub(crate) robot: Option<SharedRobot>,
}

impl Simulation {
    /// The robot as after start-up: at the origin of the map, its arms tucked.
    pub(super) fn new(models: Arc<Models>, log_level: LogLevel, seed: u64) -> Simulation {
        Simulation {
            world: starting_world(&models),
            names: IndexMap::new(),
            held: IndexMap::new(),
            carrying: [None; 2],
            jobs: Jobs::default(),
            axes: None,
            location_map: None,
            resolved_map: None,
            last_failure: None,
            last_account: None,
            sought: None,
            noises: 0,
            facts: Rc::default(),
            searches: 0,
            put_for_sweep: Vec::new(),
            robot: None,
            home: Arc::clone(&models),
            grasps: KnownGrasps::of(&models),
            models,
            meshes: MeshPlaces::default(),
            log_level,
            seed,
            now: 0.0,
            looks: OnceCell::new(),
            tally: Tally::default(),
            injection: SharedInjection::default(),
            begun_searches: locations::Searches::default(),
            out_of_reach: OutOfReach::default(),
            vain_paths: vain_paths::VainPaths::default(),
            start: Rc::default(),
        }
    }

    /// The same simulation for a copy of the image. A robot that moves, and what plans have learnt
    /// from the world, are refused.
    pub(super) fn copied(&self, copier: &mut Copier) -> Simulation {
        let is_idle = self.jobs.is_idle() && self.jobs.partial_step.is_none();
        let knows_nothing = self.last_failure.is_none()
            && self.last_account.is_none()
            && self.sought.is_none()
            && self.begun_searches.are_over();
        if !is_idle || !knows_nothing {
            copier.refuse("a world in which something has been done");
        }
        let names = self.names.iter();
        let names = names.map(|(name, symbol)| (name.clone(), copier.value(symbol)));
        Simulation {
            models: Arc::clone(&self.models),
            home: Arc::clone(&self.home),
            grasps: self.grasps.clone(),
            meshes: self.meshes.clone(),
            log_level: self.log_level,
            seed: self.seed,
            now: self.now,
            looks: OnceCell::new(),
            tally: self.tally.clone(),
            injection: Rc::new(RefCell::new(self.injection.borrow().clone())),
            begun_searches: locations::Searches::default(),
            out_of_reach: OutOfReach::default(),
            vain_paths: vain_paths::VainPaths::default(),
            start: Rc::clone(&self.start),
            world: self.world.clone(),
            names: names.collect(),
            held: self.held.clone(),
            carrying: self.carrying,
            jobs: Jobs::after(self.jobs.begun),
            axes: self.axes.clone(),
            location_map: self.location_map.clone(),
            resolved_map: self.resolved_map.clone(),
            last_failure: None,
            last_account: None,
            sought: None,
            noises: self.noises,
            facts: Rc::clone(&self.facts),
            searches: self.searches,
            put_for_sweep: self.put_for_sweep.clone(),
            robot: None,
        }
    }

    fn start(&self) -> &World {
        self.start.get_or_init(|| starting_world(&self.models))
    }

    /// Resets the world: no objects, the robot at the origin. Simulated time continues.
    pub(super) fn restart(&mut self) {
        let noise = self.noise_levels();
        self.world = self.start().clone();
        self.world.set_object_types(Arc::clone(&self.models));
        self.set_noise(noise);
        self.names.clear();
        self.held.clear();
        self.axes = None;
        self.location_map = None;
        self.resolved_map = None;
        self.sought = None;
        self.searches = 0;
        self.put_for_sweep.clear();
    }

    /// How large the errors of sensors and motors are, if there are any.
    pub(super) fn noise_levels(&self) -> Option<NoiseLevels> {
        self.world.noise().map(|noise| noise.levels)
    }

    /// Sets how large the errors of sensors and motors are.
    pub(super) fn set_noise(&mut self, levels: Option<NoiseLevels>) {
        self.noises += u64::from(levels.is_some());
        let noise = levels.map(|levels| Noise::new(levels, [self.seed, self.noises]));
        self.world.set_noise(noise);
    }

    /// Simulated time (s).
    pub fn now(&self) -> f64 {
        self.now
    }

    /// The world.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The number of motions begun so far.
    pub(super) fn motions_begun(&self) -> u64 {
        self.jobs.begun
    }

    /// The appearance of everything.
    pub(super) fn looks(&self) -> &Looks {
        self.looks.get_or_init(|| Looks::of(&self.models))
    }

    /// The types of objects that can be spawned.
    pub fn object_types(&self) -> &ObjectLibrary {
        &self.models.objects
    }

    /// From now on, objects are of these types; those that are there stay as they are.
    pub(super) fn know_objects(&mut self, objects: Arc<ObjectLibrary>) {
        self.models = Arc::new(self.models.with_objects(objects));
        self.world.set_object_types(Arc::clone(&self.models));
        self.looks = OnceCell::new();
    }

    /// Another robot or another kitchen, without objects, with the robot at its start; types of objects stay known. The
    /// world of a snapshot may be restored then.
    pub(super) fn begin_with(&mut self, models: &Models) {
        let objects = Arc::clone(&self.models.objects);
        self.models = Arc::new(models.with_objects(objects));
        self.grasps.fit(&self.models);
        self.start = Rc::default();
        self.looks = OnceCell::new();
        self.begun_searches = locations::Searches::default();
        self.out_of_reach = OutOfReach::default();
        self.vain_paths = vain_paths::VainPaths::default();
        self.restart();
    }

    /// The kitchen in which the session began, without objects.
    pub(super) fn go_home(&mut self) {
        let home = Arc::clone(&self.home);
        if !self.models.share_kitchen(&home) {
            let models = self.models.with_kitchen_of(&home);
            self.begin_with(&models);
        }
    }

    /// How objects are grasped.
    pub fn grasp_library(&self) -> &GraspLibrary {
        &self.grasps
    }

    /// The coordinate axes to show, if any.
    pub fn axes(&self) -> Option<&Axes> {
        self.axes.as_ref()
    }

    /// The pose of the robot's base in the map frame.
    pub(super) fn base(&self) -> Pose {
        self.world.robot_configuration().base
    }

    /// Where the robot takes its base to be in the map frame.
    pub(super) fn believed_base(&self) -> Pose {
        self.world.believed_base()
    }
}

/// The world in which a session with these models begins.
pub(super) fn starting_world(models: &Arc<Models>) -> World {
    // A robot that says where it stands is not moved by what the kitchen says.
    let own = models.description.base.start;
    let base = match models.kitchen_description.start {
        Some([x, y, heading]) if own == Pose::identity() => from_xy_yaw(x, y, heading.to_radians()),
        _ => own,
    };
    let robot = RobotConfiguration {
        base,
        joints: models.description.start_positions(&models.robot),
    };
    World::new(models.clone(), robot)
}
