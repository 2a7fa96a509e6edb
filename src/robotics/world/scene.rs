//! The world: robot, kitchen, objects, and the time that has passed.
//!
//! Invariants:
//! - Time passes only in [`World::step`], by exactly one physics step.
//! - The robot and the kitchen follow their joint vectors exactly. `set_…` makes them move
//!   there during the next step, pushing what is in the way; `teleport_…` puts them there
//!   at once, which is an edit of the world, not a motion. A joint of the kitchen whose handle a
//!   hand holds follows the hand.
//! - An object that is attached to a link is welded to it softly until it is detached; one that
//!   fingers hold, until they open or it slips.
//! - Objects are kept in the order in which they appeared.

use std::sync::Arc;

use indexmap::IndexMap;
use parry3d_f64::bounding_volume::Aabb;

use super::collision::CollisionChecker;
use super::content::Content;
use super::cutting::Cut;
use super::error::WorldError;
use super::explored_floor::ExploredFloor;
use super::grains::Grains;
use super::handle_hold::{HandleHold, HandleSlip};
use super::hash::Hasher;
use super::holding::Slip;
use super::link_geometry::TreeGeometry;
use super::models::Models;
use super::noise::Noise;
use super::object::Object;
use super::obstacles::Obstacles;
use super::opening_fingers::OpeningFingers;
use super::part_key::{PartKey, index};
use super::physics::{BodyHandle, BodyKind, Physics, STEP_SECONDS, Surface};
use super::riding::Riding;
use super::robot_configuration::RobotConfiguration;
use super::solid::to_parry;
use super::surroundings::{HeldObject, ObjectAt, Surroundings};
use super::tilt::Tilt;
use super::touches::Touches;
use crate::robot::{JointPositions, LinkId};
use closest_name::closest_name;
use spatial::Pose;

/// A kitchen with a robot and objects in it.
///
/// A clone is an independent world that continues from the same state with the same bits.
#[derive(Clone)]
pub struct World {
    pub(super) models: Arc<Models>,
    pub(super) physics: Physics,
    pub(super) state: State,
    pub(super) robot_bodies: Arc<[BodyHandle]>,
    pub(super) kitchen_bodies: Arc<[Option<BodyHandle>]>,
    pub(super) explored: ExploredFloor,
}

/// The names of an object, and its place among others (bytes), roughly.
const OBJECT_NAMES: usize = 128;

/// The state of a world besides that of the physics engine.
#[derive(Clone)]
pub(super) struct State {
    pub(super) robot: RobotConfiguration,
    pub(super) robot_poses: Vec<Pose>,
    pub(super) robot_moves: bool,
    /// For each body of the robot that does not follow it, the bounds (m) of the body where it is.
    pub(super) left_behind: Vec<Option<Aabb>>,
    pub(super) kitchen: JointPositions,
    pub(super) kitchen_poses: Vec<Pose>,
    pub(super) kitchen_moves: bool,
    pub(super) furniture: Arc<Obstacles>,
    pub(super) objects: IndexMap<String, Object>,
    pub(super) next_number: u32,
    pub(super) steps: u64,
    /// The last object that has slipped out of each hand.
    pub(super) slips: Vec<Slip>,
    /// What was upright in a hand and has been tilted, with the step: the last one for each hand.
    pub(super) tilts: Vec<(u64, Tilt)>,
    /// How hands hold handles.
    pub(super) handles: Vec<HandleHold>,
    /// The last handle that has slipped out of each hand.
    pub(super) handle_slips: Vec<HandleSlip>,
    /// Errors of sensors and motors, if there are any.
    pub(super) noise: Option<Noise>,
    /// What things have touched for which that is noted.
    pub(super) touches: Vec<Touches>,
    /// Tools that pass through what they cut.
    pub(super) cuts: Vec<Cut>,
    /// What stands on what two hands carry.
    pub(super) riding: Riding,
    /// Fingers that are opening, and when that was last said.
    pub(super) opening: Vec<OpeningFingers>,
    /// What vessels have been filled with in grains.
    pub(super) grains: Vec<Grains>,
}

impl State {
    /// How much memory (bytes) it takes, roughly.
    pub(super) fn bytes(&self) -> usize {
        size_of::<Self>()
            + size_of_val(self.robot_poses.as_slice())
            + size_of_val(self.left_behind.as_slice())
            + size_of_val(self.kitchen_poses.as_slice())
            + self.objects.len() * (size_of::<Object>() + OBJECT_NAMES)
            + self.grains.iter().map(Grains::bytes).sum::<usize>()
    }
}

impl World {
    /// A world without objects, with the kitchen closed and the robot in the given configuration.
    pub fn new(models: Arc<Models>, robot: RobotConfiguration) -> Self {
        let mut physics = Physics::new();
        physics.add_floor(PartKey::Floor.code());

        let kitchen = models.kitchen.zero_positions();
        let mut kitchen_poses = Vec::new();
        models
            .kitchen
            .forward_kinematics(&Pose::identity(), &kitchen, &mut kitchen_poses);
        let kitchen_bodies = models
            .kitchen_geometry
            .groups
            .iter()
            .enumerate()
            .map(|(i, group)| {
                let kind = if group.moves {
                    BodyKind::MovingFurniture
                } else {
                    BodyKind::Static
                };
                let plain = |_| Surface::Plain;
                let parts = group_parts(&models.kitchen_geometry, i, PartKey::Furniture, plain);
                let pose = pose_of(&kitchen_poses, group.root);
                (!parts.is_empty()).then(|| physics.add_body(kind, &pose, &parts))
            })
            .collect();

        let mut robot_poses = Vec::new();
        models
            .robot
            .forward_kinematics(&robot.base, &robot.joints, &mut robot_poses);
        let robot_bodies = models
            .robot_geometry
            .groups
            .iter()
            .enumerate()
            .map(|(i, group)| {
                let surface = |link| models.surface_of(link);
                let parts = group_parts(&models.robot_geometry, i, PartKey::Robot, surface);
                physics.add_body(BodyKind::Robot, &pose_of(&robot_poses, group.root), &parts)
            })
            .collect();

        let furniture = Arc::new(Obstacles::new(&models.kitchen_geometry, &kitchen_poses));
        let mut world = Self {
            models,
            physics,
            state: State {
                robot,
                robot_poses,
                robot_moves: false,
                left_behind: Vec::new(),
                kitchen,
                kitchen_poses,
                kitchen_moves: false,
                furniture,
                objects: IndexMap::new(),
                next_number: 0,
                steps: 0,
                slips: Vec::new(),
                tilts: Vec::new(),
                handles: Vec::new(),
                handle_slips: Vec::new(),
                noise: None,
                touches: Vec::new(),
                cuts: Vec::new(),
                opening: Vec::new(),
                riding: Riding::default(),
                grains: Vec::new(),
            },
            robot_bodies,
            kitchen_bodies,
            explored: ExploredFloor::default(),
        };
        world.place_robot_bodies();
        world
    }

    /// The models from which the world was built.
    pub fn models(&self) -> &Arc<Models> {
        &self.models
    }

    /// From now on, objects are of the kinds that these models know; robot and kitchen must be the same.
    /// Objects that are there stay as they are.
    pub fn set_object_types(&mut self, models: Arc<Models>) {
        self.models = models;
    }

    /// Advances by one physics step: robot and kitchen move to where they were set; objects
    /// fall, slide and are carried.
    pub fn step(&mut self) {
        if self.state.robot_moves || self.state.kitchen_moves {
            self.explored.forget();
        }
        if self.state.robot_moves {
            self.release_opened_hands();
            self.follow_hands();
        }
        self.move_robot_bodies();
        if self.state.robot_moves {
            for object in self
                .state
                .objects
                .values()
                .filter(|o| o.attachment.is_some())
            {
                self.physics.wake(object.body);
            }
            self.state.robot_moves = false;
        }
        if self.state.kitchen_moves {
            for (body, group) in self
                .kitchen_bodies
                .iter()
                .zip(&self.models.kitchen_geometry.groups)
            {
                if let (Some(body), true) = (body, group.moves) {
                    self.physics
                        .move_to(*body, &pose_of(&self.state.kitchen_poses, group.root));
                }
            }
            self.state.kitchen_moves = false;
        }
        self.physics.step();
        self.keep_riders();
        self.watch_holds();
        self.pour();
        self.shake();
        self.follow_grains();
        self.note_touches();
        self.state.steps += 1;
    }

    /// Lets time pass until every object is at rest, but at most `seconds` (s). Returns whether
    /// all have come to rest.
    pub fn settle(&mut self, seconds: f64) -> bool {
        self.settle_without(&[], seconds)
    }

    /// As [`Self::settle`], whatever the objects with those keys do.
    pub(super) fn settle_without(&mut self, restless: &[PartKey], seconds: f64) -> bool {
        let is_at_rest = |world: &Self| {
            let mut moving = world.moving_objects();
            moving.all(|object| restless.contains(&object.key()))
        };
        let mut quiet = 0;
        let mut left = steps_in(seconds);
        while left > 0 {
            self.step();
            left -= 1;
            quiet = if is_at_rest(self) { quiet + 1 } else { 0 };
            if quiet >= QUIET_STEPS {
                return true;
            }
        }
        is_at_rest(self)
    }

    /// Whether no object moves faster than 2 mm/s or turns faster than 0.02 rad/s, and no grain much faster; one in a
    /// hand rests when the hand does.
    pub fn is_at_rest(&self) -> bool {
        self.moving_objects().next().is_none() && self.grains_are_at_rest()
    }

    /// Whether every grain, and every object that no hand holds, sleeps: nothing moves any of them unless something else does. One that
    /// has just lost its support is at rest, but awake.
    pub fn sleeps(&self) -> bool {
        let mut objects = self.state.objects.values();
        objects.all(|object| object.attachment.is_some() || !self.physics.is_awake(object.body))
            && self.grains_sleep()
    }

    /// The objects that no hand holds and that are not at rest.
    pub fn moving_objects(&self) -> impl Iterator<Item = &Object> {
        let free = self.state.objects.values();
        let free = free.filter(|object| object.attachment.is_none());
        free.filter(|object| {
            let (linear, angular) = self.physics.velocity(object.body);
            let is_at_rest = linear.norm() < REST_SPEED && angular.norm() < REST_TURN;
            !is_at_rest
        })
    }

    /// Number of steps since the world began.
    pub fn steps(&self) -> u64 {
        self.state.steps
    }

    /// Simulated time since the world began (s).
    pub fn time(&self) -> f64 {
        // Exact for any number of steps that can be simulated.
        self.state.steps as f64 * STEP_SECONDS
    }

    /// All objects in the order in which they appeared.
    pub fn objects(&self) -> impl ExactSizeIterator<Item = &Object> {
        self.state.objects.values()
    }

    /// The object with that name.
    pub fn object(&self, name: &str) -> Result<&Object, WorldError> {
        self.state
            .objects
            .get(name)
            .ok_or_else(|| WorldError::UnknownObject {
                name: name.to_owned(),
                closest: closest_name(name, self.state.objects.keys().map(String::as_str))
                    .map(str::to_owned),
            })
    }

    /// Pose of the object in the map frame.
    pub fn object_pose(&self, name: &str) -> Result<Pose, WorldError> {
        Ok(self.physics.pose(self.object(name)?.body))
    }

    /// Keeps all current objects from falling asleep, so that every step costs as much as while
    /// things move. For measurements.
    pub fn keep_objects_awake(&mut self) {
        for object in self.state.objects.values() {
            self.physics.keep_awake(object.body);
        }
    }

    /// Number of bodies that each step costs time for.
    #[cfg(test)]
    pub fn awake(&self) -> usize {
        self.physics.awake()
    }

    /// The body of the engine that the link is part of, and the link whose frame it has.
    pub(super) fn body_of_link(&self, link: LinkId) -> Option<(BodyHandle, LinkId)> {
        let geometry = &self.models.robot_geometry;
        let group = *geometry.group_of.get(link.index())?;
        Some((
            *self.robot_bodies.get(group)?,
            geometry.groups.get(group)?.root,
        ))
    }

    /// A checker of robot configurations for the current state of the world.
    pub fn collision_checker(&self) -> CollisionChecker<'_> {
        self.checker_among(&self.state.furniture, |object| self.object_at(object))
    }

    /// A checker of robot configurations with furniture and lying objects elsewhere than they are.
    pub(super) fn checker_among<'w>(
        &'w self,
        furniture: &'w Obstacles,
        at: impl Fn(&'w Object) -> ObjectAt<'w>,
    ) -> CollisionChecker<'w> {
        let mut objects = Vec::new();
        let mut held = Vec::new();
        let riding = self.riders_of_two_hands();
        for object in self.state.objects.values() {
            let rides = riding.iter().find(|rider| rider.name == object.name());
            match (&object.attachment, rides) {
                (Some(attachment), _) => held.push(HeldObject {
                    key: object.key(),
                    name: &object.name,
                    solids: &object.solids,
                    bounds: object.bounds,
                    link: attachment.link,
                    at: attachment.at,
                    hands: [Some(attachment.link), object.second.map(|one| one.link)],
                    load: object.key(),
                }),
                (None, Some(rider)) => held.push(HeldObject {
                    key: object.key(),
                    name: &object.name,
                    solids: &object.solids,
                    bounds: object.bounds,
                    link: rider.link,
                    at: rider.at,
                    hands: [None, None],
                    load: rider.load,
                }),
                (None, None) => objects.push(at(object)),
            }
        }
        let surroundings = Surroundings {
            models: &self.models,
            furniture,
            objects,
            held,
        };
        CollisionChecker::new(surroundings).knowing(&self.state.robot, &self.state.robot_poses)
    }

    pub(super) fn object_at<'w>(&self, object: &'w Object) -> ObjectAt<'w> {
        let pose = to_parry(&self.physics.pose(object.body));
        ObjectAt {
            key: object.key(),
            name: &object.name,
            solids: &object.solids,
            pose,
            bounds: object.bounds.transform_by(&pose),
        }
    }

    /// A hash of the bits of the whole state.
    pub fn hash(&self) -> u64 {
        let mut hasher = Hasher::default();
        self.physics.hash_into(&mut hasher);
        hasher.integer(self.state.steps);
        hasher.pose(&self.state.robot.base);
        let joints = self.state.robot.joints.as_slice();
        for position in joints.iter().chain(self.state.kitchen.as_slice()) {
            hasher.number(*position);
        }
        for object in self.state.objects.values() {
            hasher.text(&object.name);
            hasher.text(&object.type_name);
            hasher.integer(object.key().code());
            // Hashes of worlds without contents stay as they were.
            if object.content != Content::default() {
                object.content.hash_into(&mut hasher);
                for part in object.swing.iter().filter(|part| **part != 0.0) {
                    hasher.number(*part);
                }
            }
            if let Some(attachment) = &object.attachment {
                hasher.integer(u64::from(index(attachment.link)));
                hasher.pose(&attachment.at);
                if let Some(hold) = &attachment.hold {
                    hold.hash_into(&mut hasher);
                }
            }
            if let Some(second) = &object.second {
                hasher.integer(u64::from(index(second.link)));
                hasher.pose(&second.at);
                if let Some(hold) = &second.hold {
                    hold.hash_into(&mut hasher);
                }
            }
        }
        for hold in &self.state.handles {
            hold.hash_into(&mut hasher);
        }
        if let Some(noise) = &self.state.noise {
            noise.hash_into(&mut hasher);
        }
        for touches in &self.state.touches {
            touches.hash_into(&mut hasher);
        }
        for cut in &self.state.cuts {
            cut.hash_into(&mut hasher);
        }
        if self.state.riding != Riding::default() {
            self.state.riding.hash_into(&mut hasher);
        }
        for grains in &self.state.grains {
            grains.hash_into(&mut hasher);
        }
        hasher.finish()
    }
}

/// Number of still steps that count as rest: a tenth of a second.
pub(super) const QUIET_STEPS: u32 = 24;

/// Speeds (m/s, rad/s) below which an object counts as resting.
const REST_SPEED: f64 = 0.002;
const REST_TURN: f64 = 0.02;

/// Number of steps that cover the time (s), at least one; nothing for a negative time.
pub(super) fn steps_in(seconds: f64) -> u64 {
    // The cast saturates.
    (seconds / STEP_SECONDS).ceil() as u64
}

/// The pose of the link; identity for a link of another tree.
pub(super) fn pose_of(poses: &[Pose], link: LinkId) -> Pose {
    poses.get(link.index()).copied().unwrap_or_default()
}

/// The solids of a group in its root's frame, with their keys and what they are.
fn group_parts(
    geometry: &TreeGeometry,
    group: usize,
    key: fn(u32) -> PartKey,
    surface: impl Fn(LinkId) -> Surface,
) -> Vec<(super::solid::Solid, u64, Surface)> {
    let mut parts = Vec::new();
    for (place, pose) in &geometry.groups[group].members {
        // Members are indices into this list.
        let link = &geometry.solid_links[*place];
        for solid in &link.solids {
            let mut solid = solid.clone();
            solid.pose = to_parry(pose) * solid.pose;
            parts.push((solid, key(index(link.link)).code(), surface(link.link)));
        }
    }
    parts
}

#[cfg(test)]
impl World {
    /// The bits of an object's mass properties, as the engine uses them.
    pub(crate) fn mass_properties_bits(&self, name: &str) -> Vec<u64> {
        let body = self.object(name).expect("the object is there").body;
        self.physics.mass_properties_bits(body)
    }
}
