//! Filling the world of a sweep, and questions about what is in it.

use nalgebra::Vector3;

use crate::simulation::Simulation;
use crate::simulation::names::{name_text, suggestion, type_keyword, type_text};
use crate::simulation::obstacle::{OBSTACLE, obstacle};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::location::Support;
use robotics::world::body_name::BodyName;
use robotics::world::object_library::ObjectType;
use robotics::world::{AllowedPairs, Load, NoRoom, Object, StandingRoom, WorldError};
use spatial::pose::from_xy_yaw;
use spatial::{Pose, trig};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Range (m) of the edges of an obstacle.
const EDGES: std::ops::RangeInclusive<f64> = 0.02..=3.0;
/// How far (m) above a surface a thing begins to be lowered onto it.
const ABOVE: f64 = 0.02;
/// How much higher or lower (m) than the surface the ground below a thing may be.
const LEVEL: f64 = 0.005;
/// Longest time (s) that a thing has to come to rest.
const SETTLE: f64 = 10.0;
/// How far (m) a thing may move while it comes to rest, and how far (rad) it may tip.
const MOVED: f64 = 0.01;
const TIPPED: f64 = 0.05;
/// Overlap (m) that does not count.
const TOLERANCE: f64 = 0.002;
/// Height (m) of a lowest point up to which a thing is on the floor.
const FLOOR: f64 = 0.02;

/// Builtins of package `PLAN-SYSTEM`, which `PLANWRIGHT` imports.
pub(super) static TABLE: &[Builtin] = builtins![
    surface_point,
    place_on_surface,
    place_on_floor,
    settle_world,
    objects_of_world,
    tilt,
    type_of_object,
    is_obstacle,
    is_on_floor,
    no_penetration
];

fn world_error(error: WorldError) -> Box<Raise> {
    Raise::reporting(error)
}

fn real(value: &Value) -> Result<f64> {
    number::to_f64(value)
        .filter(|number| number.is_finite())
        .ok_or_else(|| Raise::simple("The place of a thing consists of finite numbers."))
}

impl Simulation {
    /// The object or the piece of furniture that a value names; an error suggests others.
    fn surface_named(&self, image: &Image, name: &Value) -> Result<Support> {
        if let Some(object) = self.named_object(image, name) {
            return Ok(Support::Object(object));
        }
        if let Some(link) = self.furniture_of(image, name) {
            return Ok(Support::Furniture(link));
        }
        let shown = print::to_string(image, name, false).to_lowercase();
        let wanted = shown.replace('-', "_");
        let links = self.models.kitchen.links();
        let links = links.filter(|(_, link)| !link.collisions.is_empty());
        let names = links.map(|(_, link)| link.name.as_str());
        let near = suggestion(&wanted, names, |name| name.replace('_', "-"));
        Err(Raise::simple(format!(
            "The kitchen has no furniture named {shown}{}",
            if near.is_empty() {
                "; (list-surfaces) lists the surfaces."
            } else {
                &near
            }
        )))
    }
}

/// The point (x y z), in the map (m), at the shares U and V of the edges of a surface, at its top; NIL if it
/// is none.
///
/// `(length (pw::%surface-point :table-area-main 0.5 0.5))` => `3`
#[builtin("%SURFACE-POINT")]
fn surface_point(
    simulation: &mut Simulation,
    image: &mut Image,
    surface: &Value,
    u: &Value,
    v: &Value,
) -> Result<Option<Value>> {
    let surface = simulation.surface_named(image, surface)?;
    let Ok(extent) = surface.extent(&simulation.world) else {
        return Ok(None);
    };
    let [u, v] = [real(u)?, real(v)?];
    let [width, depth, _] = extent.size();
    let local = nalgebra::Point3::new(extent.min[0] + u * width, extent.min[1] + v * depth, 0.0);
    let point = extent.frame * local;
    let point = [point.x, point.y, extent.top()];
    Ok(Some(Value::list(point.map(Value::Double))))
}

/// The name of an object and its type.
fn name_and_kind(
    simulation: &Simulation,
    image: &Image,
    name: &Value,
    kind: &Value,
) -> Result<(String, ObjectType)> {
    let wanted = type_text(image, kind).unwrap_or_default();
    let types = &simulation.models.objects;
    let Some(known) = types.get(&wanted) else {
        let names = types.types().map(|kind| kind.name.as_str());
        let near = suggestion(&wanted, names, |n| format!(":{}", n.to_uppercase()));
        let shown = print::to_string(image, kind, true);
        return Err(Raise::simple(format!(
            "There is no type of objects {shown}{}",
            if near.is_empty() {
                "; (list-available-objects) lists the types."
            } else {
                &near
            }
        )));
    };
    let Some(name) = name_text(image, name) else {
        return Err(Raise::simple("An object is named by a symbol."));
    };
    Ok((name, known.clone()))
}

fn why_no_room(reason: &NoRoom) -> String {
    match reason {
        NoRoom::NoSupport => "nothing is below it".to_owned(),
        NoRoom::On(body) => format!("{body} is below it"),
        NoRoom::Edge => "it would stick out beyond the edge".to_owned(),
        NoRoom::Touches(body) => format!("{body} is there"),
        NoRoom::Closing(body) => format!("it would meet {body} when that is closed"),
    }
}

/// Puts an object onto a surface where it stands level, with so much room (m) to other objects. NIL, or a
/// text that says why it cannot.
///
/// `(progn (pw::%sweep-begin 0 0) (pw::%place-on-surface 'cup-1 :cup :table-area-main -1.6 -0.9 0 0))` => `NIL`
#[builtin(
    "%PLACE-ON-SURFACE",
    "name type surface x y yaw apart &optional color mass",
    edit
)]
fn place_on_surface(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    kind: &Value,
    surface: &Value,
    x: &Value,
    y: &Value,
    yaw: &Value,
    apart: &Value,
    _color: Option<&Value>,
    mass: Option<&Value>,
) -> Result<Option<String>> {
    let (object, mut kind) = name_and_kind(simulation, image, name, kind)?;
    let surface = simulation.surface_named(image, surface)?;
    let [x, y, yaw, apart] = [x, y, yaw, apart].map(real);
    let (x, y, yaw, apart) = (x?, y?, yaw?, apart?);
    if let Some(mass) = mass.filter(|given| given.is_true()) {
        kind.mass = real(mass)?;
    }
    let pose = match simulation.standing_place(&kind, &surface, [x, y, yaw], apart) {
        Err(why) => return Ok(Some(why)),
        Ok(pose) => pose,
    };
    let report = simulation
        .world
        .spawn_kind(&object, &kind, &pose)
        .map_err(world_error)?;
    if let Some(body) = report.blocked_by {
        simulation.world.remove(&object).map_err(world_error)?;
        return Ok(Some(format!("{body} is there")));
    }
    simulation.put(object, name, report.pose);
    Ok(None)
}

impl Simulation {
    /// The pose in which a thing of a kind stands on a surface at a place (m, m, rad), with so much
    /// room (m) to other objects; or why it does not.
    fn standing_place(
        &self,
        kind: &ObjectType,
        surface: &Support,
        [x, y, yaw]: [f64; 3],
        apart: f64,
    ) -> std::result::Result<Pose, String> {
        let world = &self.world;
        let (Ok(extent), Ok(ground)) = (surface.extent(world), surface.ground(world)) else {
            return Err("the surface has no shape".to_owned());
        };
        let load = Load::of_shapes(&kind.shapes);
        let at = from_xy_yaw(x, y, yaw);
        let [width, depth, _] = load.size(&at);
        let reach = width.max(depth) + apart;
        let room = StandingRoom::new(
            world,
            [[x - reach, y - reach], [x + reach, y + reach]],
            None,
        );
        let top = extent.top();
        let (level, lower) = match surface {
            Support::Furniture(link) => {
                let levels = room.levels(&[*link], [x, y], [top + ABOVE, top - ABOVE]);
                (levels.first().copied(), LEVEL)
            }
            // In a bowl or on a tray, things stand lower than its rim.
            Support::Object(_) => (Some(top), extent.size()[2]),
        };
        let Some(level) = level else {
            let mut here = at;
            here.translation.z = top + load.depth(&at);
            return Err(
                match room.too_near(&load, &here, apart.max(TOLERANCE), ground) {
                    Some(body) => format!("{body} is there"),
                    None => "it would stick out beyond the edge".to_owned(),
                },
            );
        };
        let pose = room
            .stand(&load, &at, level + ABOVE, ABOVE + lower, ground)
            .map_err(|reason| why_no_room(&reason))?;
        match room.too_near(&load, &pose, apart, ground) {
            Some(body) => Err(format!("{body} is too near")),
            None => Ok(pose),
        }
    }

    /// An object has been put at a pose, under a symbol.
    fn put(&mut self, name: String, symbol: &Value, pose: Pose) {
        self.names.insert(name.clone(), symbol.clone());
        self.put_for_sweep.push((name, pose));
    }
}

/// Puts a box with a square base (m) onto the floor. NIL, or a text that says why it cannot.
#[builtin("%PLACE-ON-FLOOR", edit)]
fn place_on_floor(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    x: &Value,
    y: &Value,
    yaw: &Value,
    size: &Value,
    height: &Value,
) -> Result<Option<String>> {
    let Some(object) = name_text(image, name) else {
        return Err(Raise::simple("An object is named by a symbol."));
    };
    let [x, y, yaw] = [x, y, yaw].map(real);
    let [size, height] = [size, height].map(real);
    let (x, y, yaw, size, height) = (x?, y?, yaw?, size?, height?);
    if ![size, height].iter().all(|edge| EDGES.contains(edge)) {
        return Err(Raise::simple(format!(
            "An obstacle has edges from {} to {} m, not {size} and {height} m.",
            EDGES.start(),
            EDGES.end()
        )));
    }
    let kind = obstacle([size, size, height]);
    let report = simulation
        .world
        .spawn_kind(&object, &kind, &from_xy_yaw(x, y, yaw))
        .map_err(world_error)?;
    if let Some(body) = report.blocked_by.filter(|body| *body != BodyName::Floor) {
        simulation.world.remove(&object).map_err(world_error)?;
        return Ok(Some(format!("{body} is there")));
    }
    simulation.put(object, name, report.pose);
    Ok(None)
}

/// Lets everything come to rest. A list of the name of an object that does not stay where it was put, and
/// what became of it; or NIL.
///
/// `(progn (pw::%sweep-begin 0 0) (pw::%settle-world))` => `NIL`
#[builtin("%SETTLE-WORLD", edit)]
fn settle_world(simulation: &mut Simulation) -> Result<Option<Value>> {
    let put = simulation.put_for_sweep.clone();
    for (name, _) in &put {
        if !simulation
            .world
            .come_to_rest(name, SETTLE)
            .map_err(world_error)?
        {
            return Ok(Some(restless(name, "does not come to rest")));
        }
    }
    for (name, before) in &put {
        let now = simulation.world.object_pose(name).map_err(world_error)?;
        let way = (now.translation.vector - before.translation.vector).norm();
        if tilt_of(&now) > TIPPED {
            return Ok(Some(restless(name, "falls over")));
        }
        if way > MOVED {
            return Ok(Some(restless(name, "does not stay where it was put")));
        }
    }
    Ok(None)
}

/// The name of an object, and what becomes of it.
fn restless(name: &str, what: &str) -> Value {
    Value::list([Value::from(name.to_lowercase()), Value::from(what)])
}

/// The names of all objects.
///
/// `(progn (pp-tut:init-projection) (pw::%objects-of-world))` => `NIL`
#[builtin("%OBJECTS-OF-WORLD")]
fn objects_of_world(simulation: &mut Simulation) -> Vec<Value> {
    let names = simulation.world.objects().map(Object::name);
    names.map(|name| simulation.symbol_of(name)).collect()
}

/// The angle (rad) between the z axis of a pose and the vertical.
fn tilt_of(pose: &Pose) -> f64 {
    let up = pose.rotation * Vector3::z();
    trig::atan2(up.xy().norm(), up.z)
}

/// The angle (rad) between the axis of an object and the vertical.
#[builtin("%TILT", edit)]
fn tilt(simulation: &mut Simulation, image: &mut Image, object: &Value) -> Result<f64> {
    let name = simulation.object_named(image, object)?;
    let pose = simulation.world.object_pose(&name).map_err(world_error)?;
    Ok(tilt_of(&pose))
}

/// The type of an object, whatever the robot takes it for.
#[builtin("%TYPE-OF-OBJECT")]
fn type_of_object(simulation: &mut Simulation, image: &mut Image, object: &Value) -> Result<Value> {
    let name = simulation.object_named(image, object)?;
    let object = simulation.world.object(&name).map_err(world_error)?;
    let kind = object.type_name().to_owned();
    Ok(type_keyword(image, &kind))
}

/// Has a sweep put the object onto the floor, as an obstacle?
#[builtin("%OBSTACLE-P")]
fn is_obstacle(simulation: &mut Simulation, image: &mut Image, object: &Value) -> Result<bool> {
    let name = simulation.object_named(image, object)?;
    let object = simulation.world.object(&name).map_err(world_error)?;
    Ok(object.type_name() == OBSTACLE)
}

/// Is the lowest point of an object at the floor?
#[builtin("%ON-FLOOR-P")]
fn is_on_floor(simulation: &mut Simulation, image: &mut Image, object: &Value) -> Result<bool> {
    let name = simulation.object_named(image, object)?;
    let extent = simulation.world.object_extent(&name).map_err(world_error)?;
    let lowest = extent.frame.translation.z + extent.min[2];
    Ok(lowest < FLOOR)
}

/// Is nothing deeper in anything else than 2 mm?
#[builtin("%NO-PENETRATION-P")]
fn no_penetration(simulation: &mut Simulation) -> Result<bool> {
    let world = &simulation.world;
    if world
        .deepest_penetration(&AllowedPairs::default(), TOLERANCE)
        .is_some()
    {
        return Ok(false);
    }
    for object in world.objects().filter(|o| o.attachment().is_none()) {
        let (depth, _) = world.depth_of(object.name()).map_err(world_error)?;
        if depth > TOLERANCE {
            return Ok(false);
        }
    }
    Ok(true)
}
