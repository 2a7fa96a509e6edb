//! How things look: surfaces by which users recognise what the world knows as a few boxes and
//! cylinders. Looks have no effect on anything: neither physics nor the robot's camera knows of
//! them.

mod appearances;
mod look;
mod surfaces;
mod vessel;

use std::sync::Arc;

use indexmap::IndexMap;

use super::scene::{Body, Finish, Kind, Owner, Scene};
use super::surface::Surface;
use appearances::Appearances;
use look::{Look, PLAIN};
use robotics::robot::{KinematicTree, Link, LinkId};
use robotics::world::{GRAIN_RADIUS, Grains, Models, Object, World};
use spatial::{Pose, trig};

/// Half the edge length (m) of the drawn floor.
const FLOOR_HALF: f64 = 30.0;

/// Maximum width (m) of bevelled edges.
const FURNITURE_BEVEL: f64 = 0.003;
const ROBOT_BEVEL: f64 = 0.022;

/// Number of straight pieces of the outline of a grain.
const GRAIN_PIECES: u32 = 6;

/// The looks of everything that a world may contain; made once, they serve any number of
/// scenes.
pub struct Looks {
    floor: Arc<Surface>,
    grain: Look,
    furniture: Vec<Dressed>,
    robot: Vec<Dressed>,
    /// By type, with the definition that they are of.
    objects: IndexMap<String, (u32, Vec<Look>)>,
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
            grain: look_of_grain(),
            furniture: dressed(&models.kitchen, Kind::Furniture),
            robot: dressed(&models.robot, Kind::Robot),
            objects: kinds
                .map(|kind| {
                    let own = kind.looks.as_deref();
                    let looks = Appearances::built_in().of_object(&kind.name, &kind.shapes, own);
                    (kind.name.clone(), (kind.edition, looks))
                })
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
                let looks = self.objects.get(object.type_name());
                match looks.filter(|(edition, _)| *edition == object.edition()) {
                    Some((_, looks)) => add_object(object, looks, &pose, &mut bodies),
                    // Of a type for which these looks were not made.
                    None => {
                        let looks = Appearances::built_in().of_object(
                            object.type_name(),
                            object.shapes(),
                            object.looks(),
                        );
                        add_object(object, &looks, &pose, &mut bodies);
                    }
                }
            }
        }
        for (grains, places) in world.grains() {
            let owner = Owner::new(Kind::Object, grains.what());
            bodies.extend(places.into_iter().map(|place| {
                let at =
                    Pose::from_parts(place.coords.into(), nalgebra::UnitQuaternion::identity());
                self.grain.body(&owner, &at, grains.color())
            }));
        }
        Scene { bodies }
    }
}

/// A ball of few corners, since there are many.
fn look_of_grain() -> Look {
    let arc = (0..=GRAIN_PIECES).map(|i| {
        let (sine, cosine) =
            trig::sin_cos(std::f64::consts::PI * f64::from(i) / f64::from(GRAIN_PIECES));
        [GRAIN_RADIUS * sine, -GRAIN_RADIUS * cosine]
    });
    let ball = Surface::lathed(&arc.collect::<Vec<_>>());
    Look {
        finish: Finish::Satin,
        ..Look::of_surface(Arc::new(ball), Pose::identity(), None)
    }
}

/// The appearance of a link, in the link's frame.
fn link_scene(tree: &KinematicTree, link: LinkId, kind: Kind) -> Scene {
    let mut scene = Scene::default();
    let dressed = Dressed::new(tree, link, tree.link(link), kind);
    dressed.add(&Pose::identity(), &mut scene.bodies);
    scene
}

/// The appearance of an object, in its own frame.
fn object_scene(object: &Object) -> Scene {
    let mut scene = Scene::default();
    let looks =
        Appearances::built_in().of_object(object.type_name(), object.shapes(), object.looks());
    add_object(object, &looks, &Pose::identity(), &mut scene.bodies);
    scene
}

impl Scene {
    /// The world as it is now. To draw it repeatedly, keep the [`Looks`] instead.
    pub fn of(world: &World) -> Self {
        Looks::of(world.models()).scene(world)
    }

    /// The appearance of a link, in the link's frame.
    pub(crate) fn of_link(tree: &KinematicTree, link: LinkId, is_robot: bool) -> Self {
        let kind = if is_robot {
            Kind::Robot
        } else {
            Kind::Furniture
        };
        link_scene(tree, link, kind)
    }

    /// The appearance of a grain, in its own frame.
    pub(crate) fn of_grain(grains: &Grains) -> Self {
        let owner = Owner::new(Kind::Object, grains.what());
        let body = look_of_grain().body(&owner, &Pose::identity(), grains.color());
        Self { bodies: vec![body] }
    }

    /// The appearance of an object, in its own frame.
    pub(crate) fn of_object(object: &Object) -> Self {
        object_scene(object)
    }
}

fn add_object(object: &Object, looks: &[Look], pose: &Pose, bodies: &mut Vec<Body>) {
    let owner = Owner::new(Kind::Object, object.name());
    let color = object.color();
    bodies.extend(looks.iter().map(|look| look.body(&owner, pose, color)));
}

impl Dressed {
    fn new(tree: &KinematicTree, id: LinkId, link: &Link, kind: Kind) -> Self {
        let own = match kind {
            Kind::Robot => Appearances::built_in().of_link(tree.name(), &link.name),
            _ => None,
        };
        Self {
            link: id,
            owner: Owner::new(kind, &link.name),
            looks: own.map_or_else(|| as_modelled(link, kind), <[Look]>::to_vec),
        }
    }

    fn add(&self, pose: &Pose, bodies: &mut Vec<Body>) {
        let looks = self.looks.iter();
        bodies.extend(looks.map(|look| look.body(&self.owner, pose, PLAIN)));
    }
}

fn dressed(tree: &KinematicTree, kind: Kind) -> Vec<Dressed> {
    tree.links()
        .map(|(id, link)| Dressed::new(tree, id, link, kind))
        .filter(|dressed| !dressed.looks.is_empty())
        .collect()
}

/// The shapes given by the model.
fn as_modelled(link: &Link, kind: Kind) -> Vec<Look> {
    let (bevel, finish) = match kind {
        Kind::Robot => (ROBOT_BEVEL, Finish::Gloss),
        _ => (FURNITURE_BEVEL, Finish::Satin),
    };
    let shapes = link.visuals.iter();
    let mut looks: Vec<_> = shapes.map(|s| Look::of_shape(s, bevel, finish)).collect();
    if kind == Kind::Furniture {
        looks.extend_from_slice(Appearances::built_in().of_furniture(&link.name));
    }
    looks
}
