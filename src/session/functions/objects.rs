//! Builtins for objects: spawning, moving, removing.

use super::object_record::quoted;
use crate::log_level::LogLevel;
use crate::simulation::Simulation;
use crate::simulation::names::{name_text, suggestion, type_text_of};
use cram::pose::value::pose_stamped;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::world::object_definitions::plain_type;
use robotics::world::{Object, SpawnReport, WorldError};
use spatial::{Pose, Shape};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Longest time (s) that a spawned object has to come to rest.
const SETTLE: f64 = 20.0;
/// Displacements of an object from where it was to be that count as rough figures of the user: to
/// the side, up, and down if something was there, or if nothing was (m).
const ASIDE: f64 = 0.05;
const HIGHER: f64 = 0.15;
const LOWER: f64 = 0.05;
const FALL: f64 = 0.3;

/// Builtins of package `CRAM-BULLET-REASONING-UTILITIES`.
pub(super) static TABLE: &[Builtin] = builtins![
    spawn_object,
    kill_object,
    kill_all_objects,
    move_object,
    object_pose,
    object_exists,
    move_robot
];

/// The arguments for spawning an object.
pub(super) struct Spawning<'a> {
    pub name: &'a Value,
    pub kind: &'a Value,
    pub pose: Pose,
    pub color: Option<&'a Value>,
    pub mass: Option<f64>,
}

impl Simulation {
    /// Adds an object to the world, or moves the one with that name, and lets it settle.
    pub(super) fn spawn(&mut self, image: &mut Image, spawning: &Spawning<'_>) -> Result<()> {
        let Some(name) = name_text(image, spawning.name) else {
            return Err(Raise::type_error(spawning.name, known::SYMBOL));
        };
        let kind = type_text_of(image, spawning.kind)?;
        if self.models.objects.get(&kind).is_none() {
            let types = self.models.objects.types();
            let near = suggestion(&kind, types.map(|t| t.name.as_str()), |n| {
                format!(":{}", n.to_uppercase())
            });
            let shown = print::to_string(image, spawning.kind, true);
            return Err(Raise::simple(format!(
                "Couldn't find a mesh for object type {shown}{}",
                if near.is_empty() {
                    "; (list-available-objects) lists the types."
                } else {
                    &near
                }
            )));
        }
        let color = spawning.color.map(color).transpose()?;
        let report = self
            .world
            .spawn(&name, &kind, &spawning.pose, color, spawning.mass)
            .map_err(world_error)?;
        self.names
            .entry(name.clone())
            .or_insert_with(|| spawning.name.clone());
        self.let_settle(image, &name, &spawning.pose, &report)
    }

    /// Adds an object of a shape, whose frame is in its middle, and lets it settle.
    #[allow(clippy::too_many_arguments, reason = "an object is made of so many")]
    pub(super) fn spawn_shape(
        &mut self,
        image: &mut Image,
        symbol: &Value,
        kind: &str,
        shape: Shape,
        pose: &Pose,
        mass: &Value,
        color_value: &Value,
    ) -> Result<()> {
        let Some(name) = name_text(image, symbol) else {
            return Err(Raise::type_error(symbol, known::SYMBOL));
        };
        let color = match color_value.is_true() {
            true => color(color_value)?,
            false => [0.6, 0.6, 0.6, 1.0],
        };
        let mass = number::to_f64(mass).unwrap_or(0.2);
        let kind = plain_type(kind, shape, mass, color);
        let report = self
            .world
            .spawn_kind(&name, &kind, pose)
            .map_err(world_error)?;
        self.names
            .entry(name.clone())
            .or_insert_with(|| symbol.clone());
        self.let_settle(image, &name, pose, &report)
    }

    /// Defines a type by a file of a mesh, unless it is known.
    fn define_by_mesh(&mut self, image: &mut Image, kind: &Value, mesh: &Value) -> Result<()> {
        let kind = type_text_of(image, kind)?;
        if self.models.objects.get(&kind).is_some() {
            return Ok(());
        }
        let Value::Str(file) = mesh else {
            return Err(Raise::type_error(mesh, known::STRING));
        };
        let record = format!("(object {kind} :shapes ((mesh {})))", quoted(&file.text()));
        let source = self.meshes.source.clone();
        self.define_object(image, &kind, &record, &source)
    }

    /// Lets an object come to rest that was put at a pose, and logs it if it does not, or ends
    /// elsewhere.
    fn let_settle(
        &mut self,
        image: &mut Image,
        name: &str,
        wanted: &Pose,
        report: &SpawnReport,
    ) -> Result<()> {
        self.held.shift_remove(name);
        let is_at_rest = self.world.come_to_rest(name, SETTLE).map_err(world_error)?;
        let now = self.world.object_pose(name).map_err(world_error)?;
        let way = now.translation.vector - wanted.translation.vector;
        let fell = match report.blocked_by {
            Some(_) => way.z < -LOWER,
            None => way.z < -FALL,
        };
        if way.xy().norm() > ASIDE || way.z > HIGHER || fell {
            let place = |p: &Pose| {
                let t = p.translation;
                format!("({:.2} {:.2} {:.2})", t.x, t.y, t.z)
            };
            let why = match &report.blocked_by {
                Some(body) => format!("does not fit at {}, where {body} is", place(wanted)),
                None => format!("did not stay at {}", place(wanted)),
            };
            let support = self.world.carrier(name).map_err(world_error)?;
            let on = support.map_or_else(String::new, |support| format!(", on {support}"));
            let text = format!("{name} {why}. It is at {}{on}.", place(&now));
            self.log(image, LogLevel::Warn, SPAWN_TAGS, &text);
        }
        if !is_at_rest {
            let moving: Vec<&str> = self.world.moving_objects().map(Object::name).collect();
            let which = if moving.is_empty() {
                name.to_owned()
            } else {
                moving.join(", ")
            };
            let text =
                format!("Not at rest after {SETTLE} s: {which}. It goes on moving as time passes.");
            self.log(image, LogLevel::Warn, SPAWN_TAGS, &text);
        }
        Ok(())
    }
}

/// The tags of log lines about spawned objects.
const SPAWN_TAGS: &str = "(BTR-UTILS SPAWN-OBJECT)";

fn world_error(error: WorldError) -> Box<Raise> {
    Raise::reporting(error)
}

/// A colour: a list of red, green, blue and optionally alpha, in 0..1.
pub(super) fn color(value: &Value) -> Result<[f32; 4]> {
    let parts: Vec<f32> = value
        .iter_list()
        .filter_map(|v| number::to_f64(&v))
        .map(|x| x as f32)
        .collect();
    match parts.as_slice() {
        [r, g, b] => Ok([*r, *g, *b, 1.0]),
        [r, g, b, a] => Ok([*r, *g, *b, *a]),
        _ => Err(Raise::simple(
            "A colour is a list of red, green and blue between 0 and 1, such as '(1 0 0).",
        )),
    }
}

/// Puts an object of a type into the world. A type that is not known yet is defined if MESH says what file it
/// looks like; see DEF-OBJECT-TYPE.
///
/// `(progn (pp-tut:init-projection) (btr-utils:spawn-object 'cup-1 :cup :pose '((1.4 0.6 0.9) (0 0 0 1))) (btr-utils:object-exists 'cup-1))` => `T`
#[builtin(_, "name type &key pose color mass mesh", edit)]
fn spawn_object(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    kind: &Value,
    #[key] pose: Option<&Value>,
    #[key] color: Option<&Value>,
    #[key] mass: Option<&Value>,
    #[key] mesh: Option<&Value>,
) -> Result<Value> {
    if let Some(mesh) = mesh {
        simulation.define_by_mesh(image, kind, mesh)?;
    }
    let pose = match pose {
        Some(pose) => simulation.pose_in_map(image, pose)?,
        None => Pose::translation(2.0, 0.0, 0.0),
    };
    simulation.spawn(
        image,
        &Spawning {
            name,
            kind,
            pose,
            color,
            mass: mass.and_then(number::to_f64),
        },
    )?;
    Ok(name.clone())
}

/// Removes an object.
#[builtin(edit)]
fn kill_object(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<()> {
    let name = simulation.object_named(image, name)?;
    simulation.world.remove(&name).map_err(world_error)?;
    simulation.names.shift_remove(&name);
    simulation.held.shift_remove(&name);
    Ok(())
}

/// Removes all objects.
///
/// `(btr-utils:kill-all-objects)` => `NIL`
#[builtin(edit)]
fn kill_all_objects(simulation: &mut Simulation) {
    simulation.world.remove_all();
    simulation.names.clear();
    simulation.held.clear();
}

/// Puts an object somewhere else.
#[builtin(edit)]
fn move_object(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    pose: Option<&Value>,
) -> Result<Value> {
    let moved = simulation.object_named(image, name)?;
    let pose = match pose {
        Some(pose) => simulation.pose_in_map(image, pose)?,
        None => Pose::translation(2.0, 0.0, 0.0),
    };
    let report = simulation
        .world
        .move_object(&moved, &pose)
        .map_err(world_error)?;
    simulation.let_settle(image, &moved, &pose, &report)?;
    Ok(name.clone())
}

/// The pose of an object in the map frame.
#[builtin]
fn object_pose(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<Value> {
    let name = simulation.object_named(image, name)?;
    let pose = simulation.world.object_pose(&name).map_err(world_error)?;
    Ok(pose_stamped("map", &pose))
}

/// Is there an object of that name?
///
/// `(progn (btr-utils:kill-all-objects) (btr-utils:object-exists 'cup-1))` => `NIL`
#[builtin]
fn object_exists(simulation: &mut Simulation, image: &mut Image, name: &Value) -> bool {
    let name = name_text(image, name).unwrap_or_default();
    simulation.world.object(&name).is_ok()
}

/// Puts the robot somewhere else at once.
#[builtin(edit)]
fn move_robot(
    simulation: &mut Simulation,
    image: &mut Image,
    pose: Option<&Value>,
) -> Result<Value> {
    let pose = match pose {
        Some(pose) => simulation.pose_as_given(image, pose)?,
        None => simulation.models.description.base.start,
    };
    simulation
        .world
        .check_place("the robot", &pose)
        .map_err(world_error)?;
    let mut robot = simulation.world.robot_configuration().clone();
    robot.base = pose;
    simulation.world.teleport_robot(&robot);
    Ok(Value::T)
}
