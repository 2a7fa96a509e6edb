//! What there is to be seen: the surfaces of kitchen, robot and objects where they are now,
//! the floor, and coordinate axes that somebody wants to see.

use nalgebra::Vector3;

use super::surface::Surface;
use super::trim::trim_of;
use super::vessel::{Part, parts_of};
use crate::robot::{KinematicTree, LinkId};
use crate::spatial::{PlacedShape, Pose, Shape};
use crate::world::{Object, World};

/// Half the edge length (m) of the floor that is drawn.
const FLOOR_HALF: f64 = 30.0;

/// Linear colour of what has no colour of its own.
const PLAIN: [f32; 4] = [0.6, 0.6, 0.6, 1.0];

/// Thickness of coordinate axes as a share of their length.
const AXIS_THICKNESS: f64 = 0.04;

/// Greatest width (m) of broken edges.
const FURNITURE_BEVEL: f64 = 0.003;
const ROBOT_BEVEL: f64 = 0.022;
const OBJECT_BEVEL: f64 = 0.006;

/// How a surface takes the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finish {
    /// Scatters light evenly.
    Matt,
    /// With a faint reflection of the lamp.
    Satin,
    /// With a clear reflection of the lamp.
    Gloss,
    /// Floor boards; casts no shadow and fades into the background far away.
    Boards,
}

/// A surface with its place and colour.
#[derive(Clone, Debug)]
pub struct Body {
    /// The surface in its own frame.
    pub surface: Surface,
    /// Pose of that frame in the map frame.
    pub pose: Pose,
    /// Linear colour, red green blue alpha in 0..1.
    pub color: [f32; 4],
    /// How it takes the light.
    pub finish: Finish,
}

/// Everything that is to be drawn.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// The bodies; the order decides only between surfaces at exactly the same place.
    pub bodies: Vec<Body>,
}

impl Scene {
    /// The world as it is now.
    pub fn of(world: &World) -> Self {
        let mut scene = Self::default();
        scene.bodies.push(Body {
            surface: Surface::ground(FLOOR_HALF),
            pose: Pose::identity(),
            color: PLAIN,
            finish: Finish::Boards,
        });
        let models = world.models();
        let furniture = |link| world.furniture_pose(link);
        scene.add_tree(&models.kitchen, furniture, FURNITURE_BEVEL, Finish::Satin);
        let robot = |link| world.link_pose(link);
        scene.add_tree(&models.robot, robot, ROBOT_BEVEL, Finish::Gloss);
        for object in world.objects() {
            // The object comes from the world itself.
            let Ok(pose) = world.object_pose(object.name()) else {
                continue;
            };
            scene.add_object(object, &pose);
        }
        scene
    }

    /// What is seen of a link, in the link's frame; furniture has finer edges than the robot.
    pub fn of_link(tree: &KinematicTree, link: LinkId, is_robot: bool) -> Self {
        let (bevel, finish) = match is_robot {
            true => (ROBOT_BEVEL, Finish::Gloss),
            false => (FURNITURE_BEVEL, Finish::Satin),
        };
        let mut scene = Self::default();
        scene.add_link(tree, link, &Pose::identity(), bevel, finish);
        scene
    }

    /// What is seen of an object, in its own frame.
    pub fn of_object(object: &Object) -> Self {
        let mut scene = Self::default();
        scene.add_object(object, &Pose::identity());
        scene
    }

    /// Adds coordinate axes with bars of the length (m): x red, y green, z blue.
    pub fn add_axes(&mut self, pose: &Pose, length: f64) {
        let thickness = length * AXIS_THICKNESS;
        for axis in 0..3 {
            let mut size = [thickness; 3];
            size[axis] = length;
            let mut color = [0.02, 0.02, 0.02, 1.0];
            color[axis] = 0.7;
            let mut middle = Vector3::zeros();
            middle[axis] = length / 2.0;
            let placed = PlacedShape {
                shape: Shape::Box { size },
                pose: Pose::translation(middle.x, middle.y, middle.z),
                color: None,
            };
            self.add(&placed, pose, color, 0.0, Finish::Matt);
        }
    }

    fn add_object(&mut self, object: &Object, pose: &Pose) {
        for part in parts_of(object.shapes()) {
            match part {
                Part::Shape(placed) => {
                    let color = placed.color.unwrap_or(object.color());
                    self.add(placed, pose, color, OBJECT_BEVEL, Finish::Gloss);
                }
                Part::Vessel { surface, at } => self.bodies.push(Body {
                    surface,
                    pose: pose * at,
                    color: object.color(),
                    finish: Finish::Gloss,
                }),
            }
        }
    }

    fn add_tree(
        &mut self,
        tree: &KinematicTree,
        pose_of: impl Fn(LinkId) -> Pose,
        bevel: f64,
        finish: Finish,
    ) {
        for (id, _) in tree.links() {
            self.add_link(tree, id, &pose_of(id), bevel, finish);
        }
    }

    fn add_link(
        &mut self,
        tree: &KinematicTree,
        id: LinkId,
        pose: &Pose,
        bevel: f64,
        finish: Finish,
    ) {
        let link = tree.link(id);
        for placed in &link.visuals {
            self.add(placed, pose, placed.color.unwrap_or(PLAIN), bevel, finish);
        }
        for (placed, color) in trim_of(tree.name(), &link.name) {
            self.add(&placed, pose, color, bevel, Finish::Gloss);
        }
    }

    fn add(
        &mut self,
        placed: &PlacedShape,
        owner: &Pose,
        color: [f32; 4],
        bevel: f64,
        finish: Finish,
    ) {
        self.bodies.push(Body {
            surface: Surface::of(&placed.shape, bevel),
            pose: owner * placed.pose,
            color,
            finish,
        });
    }
}
