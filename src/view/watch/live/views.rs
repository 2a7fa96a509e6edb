//! The data that the page needs for the named views.

use serde_json::{Value, json};

use crate::picture::View;
use crate::picture::view::{FIELD_OF_VIEW, FOLLOW_AT, FOLLOW_FROM};
use robotics::motion::ProcessModule;
use robotics::robot::{JointId, JointKind, LinkId};
use robotics::world::World;

/// Length (m) of the drawn frustum of the robot's camera.
const FRUSTUM: f64 = 1.6;

/// Height (m) of the point that a view looks at.
const LOOKED_AT: f64 = 0.7;

/// The data that the page needs for the named views.
#[derive(Clone, Debug)]
pub struct Views(pub Value);

impl Views {
    /// The named views of the world. `node_of` finds the node of a link of the robot by the
    /// link's name.
    pub fn new(world: &World, node_of: impl Fn(&str) -> Option<u32>) -> Self {
        Self(views(world, node_of))
    }
}

/// The nodes of the robot's parts, each with the process module that moves it and its side, if it
/// has one.
fn parts(world: &World, node: impl Fn(LinkId) -> Option<u32>) -> Vec<Value> {
    let models = world.models();
    let description = &models.description;
    let part = |link: LinkId| {
        let is_moved_by =
            |joints: &[JointId]| models.robot.ancestors(link).any(|j| joints.contains(&j));
        for arm in &description.arms {
            let side = arm.side.name();
            if arm.gripper.links().any(|part| part == link) {
                return (ProcessModule::Grippers, Some(side));
            }
            if is_moved_by(arm.joints()) {
                return (ProcessModule::Arms, Some(side));
            }
        }
        let neck = &description.neck;
        match () {
            () if is_moved_by(&neck.joints) => (ProcessModule::Neck, None),
            () if is_moved_by(description.torso.joint.as_slice()) => (ProcessModule::Torso, None),
            () => (ProcessModule::Navigation, None),
        }
    };
    let links = models.robot.links();
    let parts = links.filter_map(|(link, _)| {
        let (module, side) = part(link);
        Some(json!([node(link)?, module.to_string(), side]))
    });
    parts.collect()
}

fn views(world: &World, node_of: impl Fn(&str) -> Option<u32>) -> Value {
    let fixed = [View::Kitchen, View::Top, View::Table, View::Island];
    let fixed = fixed.into_iter().filter_map(|view| {
        let camera = view.camera(world, 4, 3).ok()?;
        let eye = camera.pose.translation.vector;
        let forward = camera.pose.rotation * nalgebra::Vector3::z();
        let distance = (eye.z - LOOKED_AT) / -forward.z.min(-0.05);
        let at = eye + forward * distance;
        Some(json!({
            "name": view.name(),
            "from": eye.as_slice(),
            "at": at.as_slice(),
            "fov": camera.vertical_fov,
        }))
    });
    let camera = world.models().description.camera();
    let robot = &world.models().robot;
    let node = |link: LinkId| node_of(&robot.link(link).name);
    // In the order of the positions in a frame.
    let kitchen = world.models().kitchen.joints();
    let joints = robot.joints().chain(kitchen);
    let joints = joints.filter(|(_, joint)| joint.is_actuated());
    let joints = joints.map(|(_, joint)| {
        json!({
            "name": joint.name,
            "unit": if joint.kind == JointKind::Prismatic { "m" } else { "rad" },
            "limits": joint.limits.map(|limits| [limits.lower, limits.upper]),
            "velocity": joint.max_velocity,
        })
    });
    json!({
        "fixed": fixed.collect::<Vec<_>>(),
        "base": node(robot.root()),
        "parts": parts(world, node),
        // Relative to the base, along the axes of the map.
        "follow": {"from": FOLLOW_FROM, "at": FOLLOW_AT, "fov": FIELD_OF_VIEW},
        "joints": joints.collect::<Vec<_>>(),
        "camera": {
            "node": node(camera.frame),
            "fov": camera.vertical_view,
            "aspect": camera.width as f64 / camera.height as f64,
            "near": camera.near,
            "far": FRUSTUM,
        },
    })
}
