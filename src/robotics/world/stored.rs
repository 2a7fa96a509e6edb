//! Snapshots as bytes, to be kept in a file.
//!
//! The bytes hold the sets of the physics engine as they are, because a world continues with the
//! same bits only with all of them. What follows from the rest is not stored but computed again in
//! the same way: the poses of links, the furniture, the solids of objects. The format is that of
//! this very build of the program.

use std::sync::Arc;

use indexmap::IndexMap;
use parry3d_f64::bounding_volume::Aabb;
use serde::{Deserialize, Serialize};

use super::handle_hold::{HandleHold, HandleSlip};
use super::holding::Slip;
use super::noise::Noise;
use super::object::{Attachment, Object};
use super::obstacles::Obstacles;
use super::physics::{BodyHandle, Sets};
use super::robot_configuration::RobotConfiguration;
use super::scene::{State, World};
use super::snapshot::Snapshot;
use super::solid::{Solid, bounds_of};
use crate::robot::JointPositions;
use spatial::{PlacedShape, Pose};

/// The state besides that of the engine.
#[derive(Serialize, Deserialize)]
struct StoredState {
    robot: RobotConfiguration,
    robot_moves: bool,
    left_behind: Vec<Option<Aabb>>,
    kitchen: JointPositions,
    kitchen_moves: bool,
    objects: Vec<StoredObject>,
    next_number: u32,
    steps: u64,
    slips: Vec<Slip>,
    handles: Vec<HandleHold>,
    handle_slips: Vec<HandleSlip>,
    noise: Option<Noise>,
}

/// An object without what follows from its shapes.
#[derive(Serialize, Deserialize)]
struct StoredObject {
    name: String,
    type_name: String,
    color: [f32; 4],
    mass: f64,
    friction: f64,
    shapes: Vec<PlacedShape>,
    number: u32,
    body: BodyHandle,
    attachment: Option<Attachment>,
}

impl StoredObject {
    fn of(object: &Object) -> StoredObject {
        StoredObject {
            name: object.name.clone(),
            type_name: object.type_name.clone(),
            color: object.color,
            mass: object.mass,
            friction: object.friction,
            shapes: object.shapes.to_vec(),
            number: object.number,
            body: object.body,
            attachment: object.attachment,
        }
    }

    /// `None` if it has no shape with a volume, which no object lacks.
    fn object(self) -> Option<Object> {
        let solids = Solid::all(&self.shapes);
        Some(Object {
            name: self.name,
            type_name: self.type_name,
            color: self.color,
            mass: self.mass,
            friction: self.friction,
            bounds: bounds_of(&solids)?,
            shapes: Arc::from(self.shapes),
            solids: Arc::from(solids),
            number: self.number,
            body: self.body,
            attachment: self.attachment,
        })
    }
}

impl Snapshot {
    /// The snapshot as bytes; `None` if the engine cannot write its state.
    pub fn to_bytes(&self) -> Option<Vec<u8>> {
        let state = &self.state;
        let stored = StoredState {
            robot: state.robot.clone(),
            robot_moves: state.robot_moves,
            left_behind: state.left_behind.clone(),
            kitchen: state.kitchen.clone(),
            kitchen_moves: state.kitchen_moves,
            objects: state.objects.values().map(StoredObject::of).collect(),
            next_number: state.next_number,
            steps: state.steps,
            slips: state.slips.clone(),
            handles: state.handles.clone(),
            handle_slips: state.handle_slips.clone(),
            noise: state.noise,
        };
        postcard::to_allocvec(&(&self.physics, &stored)).ok()
    }

    /// The snapshot that [`Snapshot::to_bytes`] wrote of a world with the same models as this one;
    /// `None` if the bytes are something else.
    pub fn from_bytes(world: &World, bytes: &[u8]) -> Option<Snapshot> {
        let (physics, stored): (Sets, StoredState) = postcard::from_bytes(bytes).ok()?;
        let models = &world.models;
        let fits = |positions: &JointPositions, like: &JointPositions| {
            positions.as_slice().len() == like.as_slice().len()
        };
        if !fits(&stored.robot.joints, &world.state.robot.joints)
            || !fits(&stored.kitchen, &world.state.kitchen)
            || stored.left_behind.len() != world.state.left_behind.len()
        {
            return None;
        }
        let mut robot_poses = Vec::new();
        let robot = &stored.robot;
        models
            .robot
            .forward_kinematics(&robot.base, &robot.joints, &mut robot_poses);
        let mut kitchen_poses = Vec::new();
        models
            .kitchen
            .forward_kinematics(&Pose::identity(), &stored.kitchen, &mut kitchen_poses);
        let furniture = if stored.kitchen == world.state.kitchen {
            Arc::clone(&world.state.furniture)
        } else {
            Arc::new(Obstacles::new(&models.kitchen_geometry, &kitchen_poses))
        };
        let objects: Option<IndexMap<String, Object>> = stored
            .objects
            .into_iter()
            .map(|object| Some((object.name.clone(), object.object()?)))
            .collect();
        Some(Snapshot {
            physics,
            state: State {
                robot: stored.robot,
                robot_poses,
                robot_moves: stored.robot_moves,
                left_behind: stored.left_behind,
                kitchen: stored.kitchen,
                kitchen_poses,
                kitchen_moves: stored.kitchen_moves,
                furniture,
                objects: objects?,
                next_number: stored.next_number,
                steps: stored.steps,
                slips: stored.slips,
                handles: stored.handles,
                handle_slips: stored.handle_slips,
                noise: stored.noise,
            },
        })
    }
}
