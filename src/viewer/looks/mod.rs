//! How things look: the surfaces by which people recognise what the world knows as a few
//! boxes and cylinders. Nothing here touches anything: neither physics nor the robot's camera
//! know of looks.

mod look;
mod objects;
mod trim;
mod vessel;

use std::sync::Arc;

use indexmap::IndexMap;

use super::scene::{Body, Finish, Kind, Owner, Scene};
use super::surface::Surface;
use crate::robot::{KinematicTree, Link, LinkId};
use crate::spatial::Pose;
use crate::world::{Models, Object, World};
use look::{Look, PLAIN};

/// Half the edge length (m) of the floor that is drawn.
const FLOOR_HALF: f64 = 30.0;

/// Greatest width (m) of broken edges.
const FURNITURE_BEVEL: f64 = 0.003;
const ROBOT_BEVEL: f64 = 0.022;

/// The looks of everything that a world may hold; made once, they serve any number of scenes.
pub struct Looks {
    floor: Arc<Surface>,
    furniture: Vec<Dressed>,
    robot: Vec<Dressed>,
    /// By type.
    objects: IndexMap<String, Vec<Look>>,
}

/// A link with its looks.
struct Dressed {
    link: LinkId,
    owner: Owner,
    looks: Vec<Look>,
}

impl Looks {
    /// The looks of robot, kitchen and objects.
    pub fn of(models: &Models) -> Self {
        let kinds = models.objects.types();
        Self {
            floor: Arc::new(Surface::ground(FLOOR_HALF)),
            furniture: dressed(&models.kitchen, Kind::Furniture, |name, tree, link| {
                looks_of_link(name, tree, link, FURNITURE_BEVEL, Finish::Satin)
            }),
            robot: dressed(&models.robot, Kind::Robot, |name, tree, link| {
                looks_of_link(name, tree, link, ROBOT_BEVEL, Finish::Gloss)
            }),
            objects: kinds
                .map(|kind| (kind.name.clone(), objects::looks_of(&kind.shapes)))
                .collect(),
        }
    }

    /// The world as it is now.
    pub fn scene(&self, world: &World) -> Scene {
        let mut bodies = vec![Body {
            owner: Owner::new(Kind::Floor, "floor"),
            surface: self.floor.clone(),
            pose: Pose::identity(),
            color: PLAIN,
            finish: Finish::Boards,
        }];
        for dressed in &self.furniture {
            dressed.add(&world.furniture_pose(dressed.link), &mut bodies);
        }
        for dressed in &self.robot {
            dressed.add(&world.link_pose(dressed.link), &mut bodies);
        }
        for object in world.objects() {
            // The object comes from the world itself.
            if let Ok(pose) = world.object_pose(object.name()) {
                self.add_object(object, &pose, &mut bodies);
            }
        }
        Scene { bodies }
    }

    fn add_object(&self, object: &Object, pose: &Pose, bodies: &mut Vec<Body>) {
        let owner = Owner::new(Kind::Object, object.name());
        let own;
        let looks = match self.objects.get(object.type_name()) {
            Some(looks) => looks,
            // Of a type that these looks were not made for.
            None => {
                own = objects::looks_of(object.shapes());
                &own
            }
        };
        let color = object.color();
        bodies.extend(looks.iter().map(|look| look.body(&owner, pose, color)));
    }
}

impl Dressed {
    fn add(&self, pose: &Pose, bodies: &mut Vec<Body>) {
        let looks = self.looks.iter();
        bodies.extend(looks.map(|look| look.body(&self.owner, pose, PLAIN)));
    }
}

fn dressed(
    tree: &KinematicTree,
    kind: Kind,
    looks: impl Fn(&str, &str, &Link) -> Vec<Look>,
) -> Vec<Dressed> {
    tree.links()
        .map(|(id, link)| Dressed {
            link: id,
            owner: Owner::new(kind, &link.name),
            looks: looks(&link.name, tree.name(), link),
        })
        .filter(|dressed| !dressed.looks.is_empty())
        .collect()
}

/// The shapes that the model gives, with what it leaves out.
fn looks_of_link(
    name: &str,
    tree: &str,
    link: &Link,
    bevel: f64,
    finish: Finish,
) -> Vec<Look> {
    let shapes = link.visuals.iter();
    let mut looks: Vec<_> = shapes.map(|s| Look::of_shape(s, bevel, finish)).collect();
    for (placed, _) in trim::trim_of(tree, name) {
        looks.push(Look::of_shape(&placed, bevel, Finish::Gloss));
    }
    looks
}
