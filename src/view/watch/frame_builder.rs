//! Builds frames of the world.

use std::sync::Arc;

use indexmap::IndexMap;

use super::Observation;
use super::frame::{Frame, Hit, Hold, Path, Placed, Press};
use super::node::{GRAIN, Kind, MAP_OF_LOCATION, Node, VisualMesh};
use super::trajectory_lines::TrajectoryLines;
use crate::picture::LocationMap;
use crate::picture::scene::Scene;
use robotics::robot::{JointId, JointKind, KinematicTree, LinkId};
use robotics::world::{BodyName, CollisionHit, Object, World};
use spatial::{PlacedShape, Pose};

/// Minimum force (N) at which a contact is shown.
const MIN_FORCE: f64 = 0.5;

/// How long (s) to show what stopped a motion.
const HIT_SECONDS: f64 = 2.5;

/// Maps of locations become nodes, which are kept; later ones are not shown.
const MAX_MAPS: usize = 256;

/// Name, type and colour of an object; objects that differ in any of these are distinct nodes.
type ObjectKey = (String, String, [u32; 4], u32);

/// Builds frames of one world, and keeps the nodes that occur in them.
pub struct FrameBuilder {
    nodes: Vec<Arc<Node>>,
    /// Nodes of links, by the links' indices in their trees.
    robot: IndexMap<usize, u32>,
    furniture: IndexMap<usize, u32>,
    /// Links that can move, with their nodes.
    moving_furniture: Vec<(LinkId, u32)>,
    robot_links: Vec<(LinkId, u32)>,
    objects: IndexMap<ObjectKey, u32>,
    /// The meshes of objects, by type and colour.
    meshes: IndexMap<(String, [u32; 4], u32), Arc<VisualMesh>>,
    /// The maps of locations that have been shown, with their nodes.
    maps: Vec<(Arc<LocationMap>, u32)>,
    joints: Vec<JointId>,
    kitchen_joints: Vec<JointId>,
    base: u32,
    trajectories: Vec<TrajectoryLines>,
    paths: Arc<[Path]>,
    hits: Vec<(f64, Hit)>,
}

impl FrameBuilder {
    /// A builder for the world, whose robot and kitchen become nodes.
    pub fn new(world: &World) -> Self {
        let mut frame_builder = Self {
            nodes: Vec::new(),
            robot: IndexMap::new(),
            furniture: IndexMap::new(),
            moving_furniture: Vec::new(),
            robot_links: Vec::new(),
            objects: IndexMap::new(),
            meshes: IndexMap::new(),
            maps: Vec::new(),
            joints: Vec::new(),
            kitchen_joints: Vec::new(),
            base: 0,
            trajectories: Vec::new(),
            paths: Vec::new().into(),
            hits: Vec::new(),
        };
        let models = world.models();
        let actuated = models.robot.joints().filter(|(_, j)| j.is_actuated());
        frame_builder.joints = actuated.map(|(id, _)| id).collect();
        let actuated = models.kitchen.joints().filter(|(_, j)| j.is_actuated());
        frame_builder.kitchen_joints = actuated.map(|(id, _)| id).collect();
        let camera = models.description.camera().frame;
        let robot = models.robot.links().map(|(link, _)| {
            let scene = Scene::of_link(&models.robot, link, true);
            (link, scene)
        });
        let robot: Vec<_> = robot
            .filter(|(link, scene)| {
                !scene.bodies.is_empty() || *link == models.robot.root() || *link == camera
            })
            .collect();
        frame_builder.robot = frame_builder.numbers(robot.iter().map(|(link, _)| *link));
        for (link, scene) in &robot {
            let parent = carrier(&models.robot, *link, &frame_builder.robot);
            let carried = Carried {
                parent,
                still: None,
            };
            let node = frame_builder.add_link(&models.robot, *link, Kind::Robot, scene, carried);
            frame_builder.robot_links.push((*link, node));
        }
        frame_builder.base = frame_builder
            .node_of(models.robot.root().index())
            .unwrap_or(0);
        let kitchen = models.kitchen.links().map(|(link, _)| {
            let scene = Scene::of_link(&models.kitchen, link, false);
            (link, scene)
        });
        let kitchen: Vec<_> = kitchen
            .filter(|(_, scene)| !scene.bodies.is_empty())
            .collect();
        frame_builder.furniture = frame_builder.numbers(kitchen.iter().map(|(link, _)| *link));
        for (link, scene) in &kitchen {
            let parent = carrier(&models.kitchen, *link, &frame_builder.furniture);
            let is_still = |joint: JointId| models.kitchen.joint(joint).kind == JointKind::Fixed;
            let is_still = models.kitchen.ancestors(*link).all(is_still);
            let still = is_still.then(|| Placed::new(0, &world.furniture_pose(*link)));
            let carried = Carried { parent, still };
            let node =
                frame_builder.add_link(&models.kitchen, *link, Kind::Furniture, scene, carried);
            if !is_still {
                frame_builder.moving_furniture.push((*link, node));
            }
        }
        frame_builder
    }

    /// All known nodes, in order of their numbers.
    pub fn nodes(&self) -> &[Arc<Node>] {
        &self.nodes
    }

    /// The node of the link of the robot that has this name.
    pub fn node_named(&self, link: &str) -> Option<u32> {
        let robot = self.robot_links.iter().map(|(_, node)| *node);
        let named = |node: &u32| {
            self.nodes
                .get(*node as usize)
                .is_some_and(|n| n.name == link)
        };
        robot.into_iter().find(named)
    }

    /// The node of a link of the robot, by its index in the tree.
    fn node_of(&self, link: usize) -> Option<u32> {
        self.robot.get(&link).copied()
    }

    /// The names of the joints in [`Frame::joints`].
    pub(crate) fn joint_names(&self, world: &World) -> Vec<String> {
        let models = world.models();
        let robot = self.joints.iter().map(|id| &models.robot.joint(*id).name);
        let kitchen = self.kitchen_joints.iter();
        let kitchen = kitchen.map(|id| &models.kitchen.joint(*id).name);
        robot.chain(kitchen).cloned().collect()
    }

    /// A frame of the world as it is now. New objects become nodes.
    pub fn build(&mut self, observation: &Observation<'_>) -> Frame {
        let world = observation.world;
        let mut placed: Vec<Placed> = Vec::with_capacity(self.nodes.len());
        let links = self.robot_links.iter();
        placed.extend(links.map(|(link, node)| Placed::new(*node, &world.link_pose(*link))));
        let links = self.moving_furniture.iter();
        placed.extend(links.map(|(link, node)| Placed::new(*node, &world.furniture_pose(*link))));
        let mut holds = Vec::new();
        let mut presses = Vec::new();
        for object in world.objects() {
            let node = self.object_node(object);
            // The name comes from the world, so the object exists.
            let Ok(pose) = world.object_pose(object.name()) else {
                continue;
            };
            placed.push(Placed::new(node, &pose));
            if let Some(hold) = object.attachment() {
                let error = world.weld_error(object.name()).ok().flatten();
                holds.push(Hold {
                    object: node,
                    link: world.models().robot.link(hold.link).name.as_str().into(),
                    force: error.map_or(0.0, |error| rounded(error.force)),
                });
            }
            let strong = world.presses(object).into_iter();
            let strong = strong.filter(|press| press.force.norm() >= MIN_FORCE);
            presses.extend(strong.map(|press| Press {
                body: self.body_node(&press.body),
                object: node,
                at: <[f64; 3]>::from(press.at).map(|v| rounded(v * 1e3) / 1e3),
                force: <[f64; 3]>::from(press.force).map(rounded),
            }));
        }
        self.place_grains(world, &mut placed);
        if let Some(node) = observation.location.and_then(|map| self.map_node(map)) {
            placed.push(Placed::new(node, &Pose::identity()));
        }
        placed.sort_by_key(|p| p.node);
        self.hits
            .retain(|(since, _)| (0.0..HIT_SECONDS).contains(&(observation.time - since)));
        self.follow_trajectories(observation);
        let robot = self.joints.iter();
        let configuration = world.robot_configuration();
        let robot = robot.map(|id| world.models().robot.position(&configuration.joints, *id));
        let kitchen = self.kitchen_joints.iter();
        let kitchen = kitchen.map(|id| {
            world
                .models()
                .kitchen
                .position(world.kitchen_positions(), *id)
        });
        Frame {
            time: observation.time,
            placed,
            holds,
            presses,
            hits: self.hits.iter().map(|(_, hit)| hit.clone()).collect(),
            // The axes are not a node.
            axes: (observation.axes).map(|(pose, size)| (Placed::new(0, &pose), size as f32)),
            paths: self.paths.clone(),
            joints: robot.chain(kitchen).collect(),
        }
    }

    /// Records what stopped a motion at this time (s).
    pub fn collide(&mut self, time: f64, hit: &CollisionHit) {
        let bodies = [&hit.moving, &hit.other];
        let nodes = bodies.iter().filter_map(|body| self.body_node(body));
        let p = hit.point;
        let hit = Hit {
            nodes: nodes.collect(),
            at: [p.x as f32, p.y as f32, p.z as f32],
        };
        self.hits.push((time, hit));
    }

    fn body_node(&self, body: &BodyName) -> Option<u32> {
        match body {
            BodyName::Robot(link) => self.robot.get(&link.id.index()).copied(),
            BodyName::Furniture(link) => self.furniture.get(&link.id.index()).copied(),
            BodyName::Object(name) => {
                let mut known = self.objects.iter().rev();
                known.find(|((n, ..), _)| n == name).map(|(_, id)| *id)
            }
            BodyName::Floor => None,
        }
    }

    fn follow_trajectories(&mut self, observation: &Observation<'_>) {
        let is_known = |(known, (number, trajectory)): (&TrajectoryLines, &(u64, _))| {
            known.is(*number, trajectory)
        };
        if self.trajectories.len() == observation.trajectories.len()
            && self
                .trajectories
                .iter()
                .zip(observation.trajectories)
                .all(is_known)
        {
            return;
        }
        let mut before = std::mem::take(&mut self.trajectories);
        for (number, trajectory) in observation.trajectories {
            let place = before
                .iter()
                .position(|known| known.is(*number, trajectory));
            self.trajectories.push(match place {
                Some(place) => before.remove(place),
                None => TrajectoryLines::new(observation.world, self.base, *number, trajectory),
            });
        }
        let lines = self
            .trajectories
            .iter()
            .flat_map(|trajectory| trajectory.lines.iter().cloned());
        self.paths = lines.collect();
    }

    /// Each grain is a node, with a number behind its name.
    fn place_grains(&mut self, world: &World, placed: &mut Vec<Placed>) {
        let mut counts: IndexMap<String, usize> = IndexMap::new();
        for (grains, places) in world.grains() {
            let color = grains.color().map(f32::to_bits);
            let mesh = self.meshes.entry((GRAIN.to_owned(), color, 0));
            let mesh = mesh.or_insert_with(|| VisualMesh::of(&Scene::of_grain(grains)).into());
            let mesh = Arc::clone(mesh);
            let count = counts.entry(grains.what().to_owned()).or_default();
            for place in places {
                *count += 1;
                let name = format!("{} {count}", grains.what());
                let key = (name.clone(), GRAIN.to_owned(), color, 0);
                let node = match self.objects.get(&key) {
                    Some(known) => *known,
                    None => {
                        let node = self.add(Node {
                            id: 0,
                            name,
                            kind: Kind::Object,
                            type_name: GRAIN.to_owned(),
                            parent: None,
                            still: None,
                            mesh: Arc::clone(&mesh),
                            shapes: Arc::default(),
                        });
                        self.objects.insert(key, node);
                        node
                    }
                };
                let at =
                    Pose::from_parts(place.coords.into(), nalgebra::UnitQuaternion::identity());
                placed.push(Placed::new(node, &at));
            }
        }
    }

    fn object_node(&mut self, object: &Object) -> u32 {
        let name = object.name().to_owned();
        let key = (
            name,
            object.type_name().to_owned(),
            object.color().map(f32::to_bits),
            object.edition(),
        );
        if let Some(known) = self.objects.get(&key) {
            return *known;
        }
        let look = (key.1.clone(), key.2, key.3);
        let mesh = self.meshes.entry(look);
        let mesh = mesh.or_insert_with(|| VisualMesh::of(&Scene::of_object(object)).into());
        let mesh = Arc::clone(mesh);
        let node = self.add(Node {
            id: 0,
            name: key.0.clone(),
            kind: Kind::Object,
            type_name: key.1.clone(),
            parent: None,
            still: None,
            mesh,
            shapes: shapes_of(object),
        });
        self.objects.insert(key, node);
        node
    }

    /// The node of the map of a location.
    fn map_node(&mut self, map: &Arc<LocationMap>) -> Option<u32> {
        let known = self.maps.iter().find(|(known, _)| Arc::ptr_eq(known, map));
        if let Some((_, node)) = known {
            return Some(*node);
        }
        if self.maps.len() == MAX_MAPS {
            return None;
        }
        let mut scene = Scene::default();
        scene.add_location_map(map);
        let node = self.add(Node {
            id: 0,
            name: "location".to_owned(),
            kind: Kind::Object,
            type_name: MAP_OF_LOCATION.to_owned(),
            parent: None,
            still: None,
            mesh: VisualMesh::of(&scene).into(),
            shapes: Arc::default(),
        });
        self.maps.push((Arc::clone(map), node));
        Some(node)
    }

    fn add_link(
        &mut self,
        tree: &KinematicTree,
        link: LinkId,
        kind: Kind,
        scene: &Scene,
        carried: Carried,
    ) -> u32 {
        self.add(Node {
            id: 0,
            name: tree.link(link).name.clone(),
            kind,
            type_name: String::new(),
            parent: carried.parent,
            still: carried.still,
            mesh: VisualMesh::of(scene).into(),
            shapes: tree.link(link).visuals.as_slice().into(),
        })
    }

    /// The numbers that the nodes of these links will have, by the links' indices, if they are
    /// added next.
    fn numbers(&self, links: impl Iterator<Item = LinkId>) -> IndexMap<usize, u32> {
        let first = self.nodes.len();
        links
            .enumerate()
            .map(|(i, link)| (link.index(), number(first + i)))
            .collect()
    }

    fn add(&mut self, mut node: Node) -> u32 {
        node.id = number(self.nodes.len());
        if let Some(still) = &mut node.still {
            still.node = node.id;
        }
        let id = node.id;
        self.nodes.push(Arc::new(node));
        id
    }
}

/// Rounded to tenths (of a newton, or of a millimetre), so that what rests looks the same in all
/// frames.
fn rounded(value: f64) -> f32 {
    ((value * 10.0).round() / 10.0) as f32
}

/// The shapes that are shown of an object, in their colours or its own.
fn shapes_of(object: &Object) -> Arc<[PlacedShape]> {
    let shapes = object.looks().unwrap_or(object.shapes()).iter();
    let colored = shapes.map(|placed| PlacedShape {
        color: placed.color.or(Some(object.color())),
        ..placed.clone()
    });
    colored.collect()
}

/// How a link hangs together with others.
struct Carried {
    /// The node that carries it.
    parent: Option<u32>,
    /// Its pose, if it cannot move.
    still: Option<Placed>,
}

/// The number of the node at an index: four billion nodes do not fit into memory.
fn number(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}

/// The node of the nearest link above a link that is among these nodes.
fn carrier(tree: &KinematicTree, link: LinkId, nodes: &IndexMap<usize, u32>) -> Option<u32> {
    let mut above = tree.ancestors(link).map(|joint| tree.joint(joint).parent);
    above.find_map(|link| nodes.get(&link.index()).copied())
}
