//! A narrow interface to the rigid-body engine: bodies, welds, contact forces, steps,
//! snapshots.
//!
//! This file and its folder are the only ones that name rapier. Poses that cross its boundary are nalgebra's,
//! forces are in newtons. It knows bodies and the keys of their parts, but neither names nor
//! what a robot is.
//!
//! Invariants:
//! - The settings are those with which objects were measured to be held and placed exactly
//!   (see [`Physics::new`]); contact recycling in particular stays off, because it keeps
//!   stale contact points of things as small as a bottle.
//! - The engine runs on one thread with portable floating point: the same calls give the
//!   same bits.
//! - A snapshot holds all sets of the engine. Poses and velocities alone are not enough to
//!   continue with the same bits, since warm-start impulses and sleep belong to the state.
//! - Reading changes nothing. In particular no collision detection runs outside a step.

mod groups;
mod packed;
mod raw_contact;
mod riding;

use nalgebra::Vector3;
use rapier3d_f64::dynamics::{
    CCDSolver, CoefficientCombineRule, FixedJointBuilder, FrictionModel, ImpulseJointHandle,
    ImpulseJointSet, IntegrationParameters, IslandManager, MultibodyJointSet, RigidBody,
    RigidBodyActivation, RigidBodyBuilder, RigidBodyHandle, RigidBodySet, SoftBodySet,
    SpringCoefficients,
};
use rapier3d_f64::geometry::{
    BroadPhaseBvh, Collider, ColliderBuilder, ColliderHandle, ColliderSet, NarrowPhase, SharedShape,
};
use rapier3d_f64::math::Vector;
use rapier3d_f64::pipeline::PhysicsPipeline;

pub use self::groups::Robot;
use self::groups::{groups, groups_of_grains};
pub(crate) use self::packed::{LEFT_OUT, LEFT_OUT_AS_READ, Shapes};
use super::hash::Hasher;
use super::object_library::FRICTION;
use super::solid::{Solid, from_parry, from_parry_vector, to_parry};
use spatial::Pose;

/// Simulated time of one step (s).
pub const STEP_SECONDS: f64 = 1.0 / 240.0;

/// Acceleration of free fall (m/s²), towards -z.
pub(crate) const GRAVITY: f64 = 9.81;

/// Gap (m) up to which the solver keeps bodies from running into each other within a step. With the
/// engine's own, the sides of a mug, 8 mm above the table, would have as many constraints as its bottom.
const MARGIN: f64 = 0.005;

/// The same, the engine's own, while anything moves farther than the other within a step: a thing that
/// falls would pass through a thin board.
const MARGIN_FOR_FAST: f64 = 0.02;

/// Maximum distance (m) of a part of a body from its centre, as far as its turning matters here.
const EXTENT: f64 = 0.25;

/// Number of parts into which the solver divides a step.
const SOLVER_ITERATIONS: usize = 4;

/// Friction of gripping surfaces; there the larger of the two coefficients counts.
const GRIP_FRICTION: f64 = 1.0;

/// Natural frequency (Hz) and damping ratio of contacts between objects. The frequency is below a
/// quarter of the solver's rate, 960 Hz, beyond which contacts would not be stable. With the
/// engine's 30 Hz a stack of ten cubes buckles. What stands on furniture keeps the engine's 60 Hz:
/// with more, a cup that leans goes on rolling on its rim.
const CONTACT_FREQUENCY: f64 = 200.0;
const CONTACT_DAMPING: f64 = 10.0;

/// Natural frequency (Hz) and damping ratio of a weld: soft enough to yield to a wall, stiff
/// enough that gravity bends it by less than 1 mm.
const WELD_FREQUENCY: f64 = 30.0;
const WELD_DAMPING: f64 = 1.0;

/// Angular damping (1/s) that stands in for rolling friction, which the engine lacks.
const ANGULAR_DAMPING: f64 = 1.0;
/// The same for a ball, which nothing else stops: fruit comes to rest on a slope of some tenths of a degree.
const BALL_DAMPING: f64 = 10.0;

/// The same for a grain, which is no perfect ball either, and damping (1/s) of its way.
const GRAIN_ANGULAR_DAMPING: f64 = 20.0;
const GRAIN_DAMPING: f64 = 0.5;
/// What marks the bodies of grains.
const GRAIN: u128 = 1;

/// A body of the engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BodyHandle(RigidBodyHandle);

/// A soft weld between two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct WeldHandle(ImpulseJointHandle);

/// The role of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum BodyKind {
    /// Furniture that never moves.
    Static,
    /// Furniture that follows its joint.
    MovingFurniture,
    /// A part of the robot, which follows its joints.
    Robot,
    /// A thing that does not move, whatever happens to it.
    Fixed {
        /// Coefficient of friction.
        friction: f64,
    },
    /// A thing with a mass (kg) that falls, slides and is gripped.
    Object {
        /// Mass (kg).
        mass: f64,
        /// Coefficient of friction.
        friction: f64,
    },
}

/// What a part of a body is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// Anything but a hand.
    Plain,
    /// Part of the hand with that number, 0 or 1.
    Hand(usize),
    /// A gripping surface of that hand.
    Pad(usize),
}

/// The engine with everything in it.
pub(crate) struct Physics {
    sets: Sets,
    parameters: IntegrationParameters,
    pipeline: PhysicsPipeline,
}

/// What the engine keeps of a collider beside itself (bytes): its leaf in the broad phase and its node in the graph of contacts.
const BESIDE_COLLIDER: usize = 640;
/// What the engine keeps of two colliders near each other (bytes): their contact points, and where they stand in its graphs.
const PER_PAIR: usize = 1400;

/// The state of the engine. Shapes are shared, so a clone takes about 25 µs.
#[derive(Clone)]
pub struct Sets {
    bodies: RigidBodySet,
    colliders: ColliderSet,
    islands: IslandManager,
    broad_phase: BroadPhaseBvh,
    narrow_phase: NarrowPhase,
    impulse_joints: ImpulseJointSet,
    multibody_joints: MultibodyJointSet,
    soft_bodies: SoftBodySet,
    ccd_solver: CCDSolver,
    /// Whether anything was changed from outside since the last step.
    is_edited: bool,
    /// Whether joints were made or removed since the last step.
    has_new_joints: bool,
}

impl Clone for Physics {
    fn clone(&self) -> Self {
        Self {
            sets: self.sets.clone(),
            parameters: self.parameters,
            pipeline: PhysicsPipeline::new(),
        }
    }
}

impl Physics {
    /// Empty space with gravity along -z.
    pub(crate) fn new() -> Self {
        let parameters = IntegrationParameters {
            dt: STEP_SECONDS,
            num_solver_iterations: SOLVER_ITERATIONS,
            friction_model: FrictionModel::Simplified,
            friction_in_bias_pass: false,
            contact_recycling: false,
            contact_softness: SpringCoefficients::new(CONTACT_FREQUENCY, CONTACT_DAMPING),
            ..IntegrationParameters::default()
        };
        Self {
            sets: Sets {
                bodies: RigidBodySet::new(),
                colliders: ColliderSet::new(),
                islands: IslandManager::new(),
                broad_phase: BroadPhaseBvh::new(),
                narrow_phase: NarrowPhase::new(),
                impulse_joints: ImpulseJointSet::new(),
                multibody_joints: MultibodyJointSet::new(),
                soft_bodies: SoftBodySet::new(),
                ccd_solver: CCDSolver::new(),
                is_edited: true,
                has_new_joints: false,
            },
            parameters,
            pipeline: PhysicsPipeline::new(),
        }
    }

    /// The state, to be changed before the next step.
    fn edit(&mut self) -> &mut Sets {
        self.sets.is_edited = true;
        &mut self.sets
    }

    /// Adds the floor, the half-space below z = 0.
    pub(crate) fn add_floor(&mut self, key: u64) {
        let floor = ColliderBuilder::new(SharedShape::halfspace(Vector::Z))
            .friction(FRICTION)
            .collision_groups(groups(BodyKind::Static, Surface::Plain))
            .user_data(u128::from(key));
        self.edit().colliders.insert(floor);
    }

    /// Adds a body made of the solids, each with the key of its part and what it is.
    ///
    /// The mass of an object is spread over its solids by volume.
    pub(crate) fn add_body(
        &mut self,
        kind: BodyKind,
        pose: &Pose,
        parts: &[(Solid, u64, Surface)],
    ) -> BodyHandle {
        let builder = match kind {
            BodyKind::Static | BodyKind::Fixed { .. } => RigidBodyBuilder::fixed(),
            BodyKind::MovingFurniture | BodyKind::Robot => {
                RigidBodyBuilder::kinematic_position_based()
            }
            BodyKind::Object { .. } => {
                let is_ball = parts
                    .iter()
                    .all(|(solid, ..)| solid.shape.as_ball().is_some());
                let damping = if is_ball {
                    BALL_DAMPING
                } else {
                    ANGULAR_DAMPING
                };
                RigidBodyBuilder::dynamic().angular_damping(damping)
            }
        };
        let handle = self.edit().bodies.insert(builder.pose(to_parry(pose)));
        let volume: f64 = parts.iter().map(|(solid, ..)| solid.volume).sum();
        for (solid, key, surface) in parts {
            let (friction, rule) = match (surface, kind) {
                (Surface::Pad(_), _) => (GRIP_FRICTION, CoefficientCombineRule::Max),
                (_, BodyKind::Object { friction, .. } | BodyKind::Fixed { friction }) => {
                    (friction, CoefficientCombineRule::Average)
                }
                _ => (FRICTION, CoefficientCombineRule::Average),
            };
            let mut collider = ColliderBuilder::new(solid.shape.clone())
                .position(solid.pose)
                .friction(friction)
                .friction_combine_rule(rule)
                .collision_groups(groups(kind, *surface))
                .user_data(u128::from(*key));
            if let BodyKind::Object { mass, .. } = kind {
                collider = collider.mass(mass * solid.volume / volume);
            }
            self.sets
                .colliders
                .insert_with_parent(collider, handle, &mut self.sets.bodies);
        }
        BodyHandle(handle)
    }

    /// Adds a ball with a radius (m) and a mass (kg) that rolls about with others of its kind.
    pub(crate) fn add_grain(
        &mut self,
        pose: &Pose,
        radius: f64,
        mass: f64,
        key: u64,
    ) -> BodyHandle {
        let builder = RigidBodyBuilder::dynamic()
            .angular_damping(GRAIN_ANGULAR_DAMPING)
            .linear_damping(GRAIN_DAMPING)
            .user_data(GRAIN)
            .pose(to_parry(pose));
        let s = self.edit();
        let body = s.bodies.insert(builder);
        let collider = ColliderBuilder::new(SharedShape::ball(radius))
            .friction(FRICTION)
            .friction_combine_rule(CoefficientCombineRule::Average)
            .collision_groups(groups_of_grains())
            .mass(mass)
            .user_data(u128::from(key));
        s.colliders
            .insert_with_parent(collider, body, &mut s.bodies);
        BodyHandle(body)
    }

    /// Takes a body out of what the engine moves, or puts it back.
    pub(crate) fn set_enabled(&mut self, body: BodyHandle, is_enabled: bool) {
        if let Some(b) = self.edit().bodies.get_mut(body.0) {
            b.set_enabled(is_enabled);
        }
    }

    /// Gives an object another mass (kg), spread over its solids by volume.
    pub(crate) fn set_mass(&mut self, body: BodyHandle, mass: f64) {
        let s = self.edit();
        let Some(b) = s.bodies.get(body.0) else {
            return;
        };
        let colliders = b.colliders().to_vec();
        let volume = |s: &Sets, c: ColliderHandle| {
            let shape = s.colliders.get(c).map(|c| c.shape().mass_properties(1.0));
            shape.map_or(0.0, |properties| properties.mass())
        };
        let whole: f64 = colliders.iter().map(|c| volume(s, *c)).sum();
        for handle in colliders {
            let share = volume(s, handle) / whole;
            if let Some(collider) = s.colliders.get_mut(handle) {
                collider.set_mass(mass * share);
            }
        }
        if let Some(b) = s.bodies.get_mut(body.0) {
            b.recompute_mass_properties_from_colliders(&s.colliders);
        }
    }

    /// Centre of mass (m) in the body's frame, inverse principal moments of inertia (1/(kg m²)) and
    /// axes of a body, as the engine uses them: the bits of all numbers.
    #[cfg(test)]
    pub(crate) fn mass_properties_bits(&self, body: BodyHandle) -> Vec<u64> {
        let mut body = self.sets.bodies[body.0].clone();
        body.recompute_mass_properties_from_colliders(&self.sets.colliders);
        let properties = &body.mass_properties().local_mprops;
        let numbers = [
            properties.local_com.to_array().as_slice(),
            properties.inv_principal_inertia.to_array().as_slice(),
            properties
                .principal_inertia_local_frame
                .to_array()
                .as_slice(),
        ]
        .concat();
        numbers.into_iter().map(f64::to_bits).collect()
    }

    /// Removes the body and its welds; what rested on it wakes up.
    pub(crate) fn remove_body(&mut self, body: BodyHandle) {
        let s = self.edit();
        s.has_new_joints |= s.impulse_joints.attached_joints(body.0).next().is_some();
        s.bodies.remove(
            body.0,
            &mut s.islands,
            &mut s.colliders,
            &mut s.impulse_joints,
            &mut s.multibody_joints,
            &mut s.soft_bodies,
            true,
        );
    }

    /// Pose of the body; identity for a removed one.
    pub(crate) fn pose(&self, body: BodyHandle) -> Pose {
        self.sets
            .bodies
            .get(body.0)
            .map_or_else(Pose::identity, |b| from_parry(b.position()))
    }

    /// Linear (m/s) and angular (rad/s) velocity of the body.
    pub(crate) fn velocity(&self, body: BodyHandle) -> (Vector3<f64>, Vector3<f64>) {
        self.sets
            .bodies
            .get(body.0)
            .map_or((Vector3::zeros(), Vector3::zeros()), |b| {
                (from_parry_vector(b.linvel()), from_parry_vector(b.angvel()))
            })
    }

    /// Puts the body at the pose, at rest. An edit of the world, not a motion.
    pub(crate) fn place(&mut self, body: BodyHandle, pose: &Pose) {
        if let Some(b) = self.edit().bodies.get_mut(body.0) {
            b.set_position(to_parry(pose), true);
            if b.is_dynamic() {
                b.set_linvel(Vector::ZERO, true);
                b.set_angvel(Vector::ZERO, true);
            }
        }
    }

    /// Makes a kinematic body move to the pose during the next step.
    pub(crate) fn move_to(&mut self, body: BodyHandle, pose: &Pose) {
        let Some(b) = self.sets.bodies.get(body.0) else {
            return;
        };
        let mut next = to_parry(pose);
        // An orientation has two quaternions. To the engine, the wrong one would be a full
        // turn within one step, which would throw off what the body carries.
        if next.rotation.dot(*b.rotation()) < 0.0 {
            next.rotation = -next.rotation;
        }
        // What is borrowed mutably counts as changed, which would cost the step time.
        if (*b.position() != next || *b.next_position() != next)
            && let Some(b) = self.edit().bodies.get_mut(body.0)
        {
            b.set_next_kinematic_position(next);
        }
    }

    /// Whether the body is awake.
    pub(crate) fn is_awake(&self, body: BodyHandle) -> bool {
        let body = self.sets.bodies.get(body.0);
        body.is_some_and(|b| !b.is_sleeping())
    }

    /// Number of bodies that are awake.
    #[cfg(test)]
    pub(crate) fn awake(&self) -> usize {
        self.sets.islands.num_active_bodies()
    }

    /// Lets an object that is at rest fall asleep in the next step instead of half a second later,
    /// if all that it touches may.
    ///
    /// The engine must not be told that it sleeps: among others that are awake, it would go on
    /// falling, and its contacts would be left out.
    pub(crate) fn need_not_wait(&mut self, object: BodyHandle) {
        // What is borrowed mutably counts as changed, which would cost the step a little.
        if self.is_awake(object)
            && let Some(b) = self.edit().bodies.get_mut(object.0)
        {
            let activation = b.activation_mut();
            activation.time_since_can_sleep = activation.time_until_sleep;
        }
    }

    /// Puts a kinematic body that touches nothing to sleep where it is.
    pub(crate) fn sleep(&mut self, body: BodyHandle) {
        if self.is_awake(body)
            && let Some(b) = self.edit().bodies.get_mut(body.0)
        {
            b.sleep();
        }
    }

    /// Wakes the body.
    pub(crate) fn wake(&mut self, body: BodyHandle) {
        let s = self.edit();
        s.islands.wake_up(&mut s.bodies, body.0, true);
    }

    /// Wakes the body and gives it the velocity that a step of falling would give it.
    pub(crate) fn begin_to_fall(&mut self, body: BodyHandle) {
        self.wake(body);
        if let Some(b) = self.edit().bodies.get_mut(body.0) {
            let velocity = b.linvel() - Vector::new(0.0, 0.0, GRAVITY * STEP_SECONDS);
            b.set_linvel(velocity, true);
        }
    }

    /// Keeps a body from falling asleep.
    pub(crate) fn keep_awake(&mut self, body: BodyHandle) {
        if let Some(b) = self.edit().bodies.get_mut(body.0) {
            b.activation_mut().normalized_linear_threshold = -1.0;
            b.wake_up(true);
        }
    }

    /// Lets a body fall asleep again.
    pub(crate) fn let_sleep(&mut self, body: BodyHandle) {
        if let Some(b) = self.edit().bodies.get_mut(body.0) {
            let usual = RigidBodyActivation::default_normalized_linear_threshold();
            b.activation_mut().normalized_linear_threshold = usual;
        }
    }

    /// Welds `carried` softly to `carrier` at pose `at` in the carrier's frame. The two no
    /// longer collide with each other.
    pub(crate) fn weld(
        &mut self,
        carrier: BodyHandle,
        at: &Pose,
        carried: BodyHandle,
    ) -> WeldHandle {
        let joint = FixedJointBuilder::new()
            .local_frame1(to_parry(at))
            .contacts_enabled(false)
            .softness(SpringCoefficients::new(WELD_FREQUENCY, WELD_DAMPING));
        let s = self.edit();
        s.has_new_joints = true;
        WeldHandle(s.impulse_joints.insert(carrier.0, carried.0, joint, true))
    }

    /// Removes the weld.
    pub(crate) fn unweld(&mut self, weld: WeldHandle) {
        let s = self.edit();
        s.has_new_joints = true;
        s.impulse_joints.remove(weld.0, true);
    }

    /// Force (N) that the weld has exerted during the last step.
    pub(crate) fn weld_force(&self, weld: WeldHandle) -> f64 {
        self.sets.impulse_joints.get(weld.0).map_or(0.0, |joint| {
            let [x, y, z, ..] = joint.impulses;
            // A joint's impulse covers only the last of the equal parts of a step.
            (x * x + y * y + z * z).sqrt() * SOLVER_ITERATIONS as f64 / STEP_SECONDS
        })
    }

    /// The force (N) with which the weld has pushed what it carries during the last step, in the world's axes.
    pub(crate) fn weld_push(&self, weld: WeldHandle) -> Vector3<f64> {
        let Some(joint) = self.sets.impulse_joints.get(weld.0) else {
            return Vector3::zeros();
        };
        let Some(carrier) = self.sets.bodies.get(joint.body1()) else {
            return Vector3::zeros();
        };
        let [x, y, z, ..] = joint.impulses;
        let axes = from_parry(&(*carrier.position() * joint.data.local_frame1)).rotation;
        axes * Vector3::new(x, y, z) * (-(SOLVER_ITERATIONS as f64) / STEP_SECONDS)
    }

    /// Advances by [`STEP_SECONDS`].
    pub(crate) fn step(&mut self) {
        let s = &mut self.sets;
        // With everything asleep and nothing changed, the engine would find nothing to do.
        if !std::mem::take(&mut s.is_edited) && s.islands.num_active_bodies() == 0 {
            return;
        }
        s.has_new_joints = false;
        self.parameters.normalized_prediction_distance = s.margin();
        // What is held goes where the hand goes, which is checked before.
        self.parameters.max_ccd_substeps = usize::from(s.has_loose_body_awake());
        self.pipeline.step(
            Vector::new(0.0, 0.0, -GRAVITY),
            &self.parameters,
            &mut s.islands,
            &mut s.broad_phase,
            &mut s.narrow_phase,
            &mut s.bodies,
            &mut s.colliders,
            &mut s.impulse_joints,
            &mut s.multibody_joints,
            &mut s.soft_bodies,
            &mut s.ccd_solver,
            &(),
            &(),
        );
    }

    /// A copy of the state.
    pub(crate) fn save(&self) -> Sets {
        self.sets.clone()
    }

    /// Restores the state. What the pipeline remembers of its last step belongs to the state
    /// being left.
    pub(crate) fn load(&mut self, sets: Sets) {
        self.sets = sets;
        self.pipeline = PhysicsPipeline::new();
    }

    /// Feeds the bits of all poses and velocities.
    pub(crate) fn hash_into(&self, hasher: &mut Hasher) {
        for (_, body) in self.sets.bodies.iter() {
            let (t, q) = (body.translation(), body.rotation());
            let (v, w) = (body.linvel(), body.angvel());
            for number in [
                t.x, t.y, t.z, q.x, q.y, q.z, q.w, v.x, v.y, v.z, w.x, w.y, w.z,
            ] {
                hasher.number(number);
            }
        }
    }
}

impl Sets {
    /// How much memory (bytes) it takes, roughly; shapes are shared.
    pub(super) fn bytes(&self) -> usize {
        self.bodies.len() * size_of::<RigidBody>()
            + self.colliders.len() * (size_of::<Collider>() + BESIDE_COLLIDER)
            + self.narrow_phase.contact_graph().interactions().count() * PER_PAIR
    }

    /// The gap (m) up to which bodies are kept from running into each other in the coming step.
    fn margin(&self) -> f64 {
        let awake = self.islands.active_bodies();
        let awake = awake.filter_map(|body| self.bodies.get(body));
        // With the greater one, each grain that falls would be checked against all others around.
        let awake = awake.filter(|body| body.user_data != GRAIN);
        let speed = |body: &RigidBody| body.linvel().length() + body.angvel().length() * EXTENT;
        let fastest = awake.map(speed).fold(0.0, f64::max);
        match fastest * STEP_SECONDS > MARGIN {
            true => MARGIN_FOR_FAST,
            false => MARGIN,
        }
    }

    /// Whether anything that moves by itself, and is not welded to anything, is awake.
    fn has_loose_body_awake(&self) -> bool {
        let mut awake = self.islands.active_bodies();
        awake.any(|body| {
            let is_dynamic = self.bodies.get(body).is_some_and(RigidBody::is_dynamic);
            is_dynamic && self.impulse_joints.attached_joints(body).next().is_none()
        })
    }
}
