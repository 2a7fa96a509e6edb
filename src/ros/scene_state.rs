//! What of a session others are shown: positions of joints, frames, objects.

use std::sync::Arc;

use indexmap::IndexMap;

use robotics::robot::{JointId, JointKind, KinematicTree, LinkId};
use robotics::world::{Models, World};
use spatial::{PlacedShape, Pose};

/// What never changes while a session has its robot and its kitchen.
#[derive(Clone)]
pub struct SceneModel {
    /// The name of the frame in which everything is.
    pub map: &'static str,
    /// The name of the frame of odometry. Nothing drifts here: it is where the map is.
    pub odometry: String,
    /// The robot's root link.
    pub base: String,
    /// Fixed joints of the robot: parent, child, and the child's pose in the parent's frame.
    pub fixed: Vec<(String, String, Pose)>,
    /// All joints of the robot that can move, those that follow others among them.
    pub joints: Vec<String>,
    /// The frames that these joints move, in their order: parent, child.
    pub frames: Vec<(String, String)>,
    /// Joints of the furniture that can move.
    pub furniture_joints: Vec<String>,
    /// Pieces of furniture: their names and shapes.
    pub furniture: Vec<(String, Arc<[PlacedShape]>)>,
    moving: Vec<(JointId, LinkId, LinkId)>,
    moving_furniture: Vec<JointId>,
    pieces: Vec<LinkId>,
}

/// What the world is like at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneState {
    /// Simulated time (s) since the session began.
    pub time: f64,
    /// Pose of the robot's root link in the map.
    pub base: Pose,
    /// Positions (rad or m) of the model's joints, in their order.
    pub positions: Vec<f64>,
    /// How fast (rad/s or m/s) they have moved since the state before, if that was shortly before.
    pub velocities: Option<Vec<f64>>,
    /// Poses of the frames that the joints move, in their parents' frames.
    pub poses: Vec<Pose>,
    /// Positions of the furniture's joints.
    pub furniture_positions: Vec<f64>,
    /// Poses of the pieces of furniture in the map.
    pub furniture: Vec<Pose>,
    /// Objects, in the order in which they appeared.
    pub objects: Vec<ObjectState>,
}

/// An object in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectState {
    /// Its name.
    pub name: String,
    /// Its type, and which definition of that it was made by.
    pub type_name: (String, u32),
    /// Its pose in the map.
    pub pose: Pose,
    /// Its shapes, in its frame.
    pub shapes: Arc<[PlacedShape]>,
    /// The colour of shapes that have none: red green blue alpha in 0..1.
    pub color: [f32; 4],
}

impl SceneModel {
    /// The model of robot and furniture.
    pub fn new(models: &Models) -> Self {
        let robot = &models.robot;
        let name = |tree: &KinematicTree, link: LinkId| tree.link(link).name.clone();
        let fixed = robot.joints().filter(|(_, j)| j.kind == JointKind::Fixed);
        let moving: Vec<_> = robot
            .joints()
            .filter(|(_, joint)| joint.kind != JointKind::Fixed)
            .map(|(id, joint)| (id, joint.parent, joint.child))
            .collect();
        let furniture = models.kitchen.joints();
        let moving_furniture: Vec<JointId> = furniture
            .filter(|(_, joint)| joint.kind != JointKind::Fixed)
            .map(|(id, _)| id)
            .collect();
        let pieces = models.kitchen.links();
        let pieces: Vec<_> = pieces
            .filter(|(_, link)| !link.visuals.is_empty())
            .collect();
        let odometry = models.description.base.odometry.as_deref();
        Self {
            map: "map",
            odometry: odometry.unwrap_or("odom").to_owned(),
            base: name(robot, robot.root()),
            fixed: fixed
                .map(|(_, joint)| {
                    let ends = [joint.parent, joint.child].map(|link| name(robot, link));
                    let [parent, child] = ends;
                    (parent, child, joint.origin)
                })
                .collect(),
            joints: moving
                .iter()
                .map(|(id, ..)| robot.joint(*id).name.clone())
                .collect(),
            frames: moving
                .iter()
                .map(|(_, parent, child)| (name(robot, *parent), name(robot, *child)))
                .collect(),
            furniture_joints: moving_furniture
                .iter()
                .map(|id| models.kitchen.joint(*id).name.clone())
                .collect(),
            furniture: pieces
                .iter()
                .map(|(_, link)| (link.name.clone(), link.visuals.clone().into()))
                .collect(),
            pieces: pieces.iter().map(|(id, _)| *id).collect(),
            moving,
            moving_furniture,
        }
    }

    /// What a world of this model is like. `before` is an earlier state, whose shapes are shared.
    pub fn state(&self, time: f64, world: &World, before: &SceneState) -> SceneState {
        let models = world.models();
        let configuration = world.robot_configuration();
        let known: IndexMap<&str, &ObjectState> = before
            .objects
            .iter()
            .map(|object| (object.name.as_str(), object))
            .collect();
        let objects = world.objects().filter_map(|object| {
            let type_name = (object.type_name().to_owned(), object.edition());
            let known = known.get(object.name());
            let known = known.filter(|known| known.type_name == type_name);
            let known = known.map(|known| &known.shapes);
            Some(ObjectState {
                name: object.name().to_owned(),
                type_name,
                pose: world.object_pose(object.name()).ok()?,
                shapes: known.map_or_else(|| object.shapes().into(), Arc::clone),
                color: object.color(),
            })
        });
        let moving = self.moving.iter();
        let poses = moving
            .clone()
            .map(|(_, parent, child)| world.link_pose(*parent).inverse() * world.link_pose(*child));
        let positions = moving.map(|(id, ..)| models.robot.position(&configuration.joints, *id));
        let positions: Vec<f64> = positions.collect();
        SceneState {
            time,
            base: configuration.base,
            velocities: velocities(&positions, &before.positions, time - before.time),
            positions,
            poses: poses.collect(),
            furniture_positions: self
                .moving_furniture
                .iter()
                .map(|id| models.kitchen.position(world.kitchen_positions(), *id))
                .collect(),
            furniture: self
                .pieces
                .iter()
                .map(|link| world.furniture_pose(*link))
                .collect(),
            objects: objects.collect(),
        }
    }
}

/// The longest time (s) over which a difference is a velocity.
const MAX_SECONDS: f64 = 0.2;

fn velocities(now: &[f64], before: &[f64], seconds: f64) -> Option<Vec<f64>> {
    let is_near = seconds > 0.0 && seconds <= MAX_SECONDS && now.len() == before.len();
    let pairs = now.iter().zip(before);
    is_near.then(|| {
        pairs
            .map(|(now, before)| (now - before) / seconds)
            .collect()
    })
}

#[cfg(test)]
mod tests {
    use crate::scene_state::*;

    #[test]
    fn velocities_are_differences_by_time() {
        assert_eq!(
            velocities(&[1.0, 0.0], &[0.5, 0.0], 0.125),
            Some(vec![4.0, 0.0])
        );
        for (before, seconds) in [(&[0.5][..], 0.1), (&[0.5, 0.5], 0.0), (&[0.5, 0.5], 5.0)] {
            assert_eq!(velocities(&[1.0, 0.0], before, seconds), None);
        }
    }
}
