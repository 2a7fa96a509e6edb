//! What the plans for picking up and placing ask of the objects around: what is where, what has
//! been disturbed, what stands on what.

use nalgebra::Vector3;

use crate::simulation::Simulation;
use cram::pose::value::pose_stamped;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::world::{Object, WorldError};
use spatial::{Pose, trig};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Tilt (degrees) from which an object counts as tipped.
const TIPPED: f64 = 5.0;

/// Builtins of package `CRAM-MOBILE-PICK-PLACE-PLANS`.
pub(super) static TABLE: &[Builtin] = builtins![
    scene_at_rest,
    disturbed_objects,
    object_lifted_p,
    support_of,
    carriers_of,
    drop_below
];

fn world_error(error: WorldError) -> Box<Raise> {
    Raise::reporting(error)
}

/// The objects that lie or stand still and that no hand holds, as a list of (name pose).
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (length (pp-plans::scene-at-rest)))` => `1`
#[builtin]
fn scene_at_rest(simulation: &mut Simulation) -> Result<Vec<Value>> {
    let world = &simulation.world;
    let moving: Vec<&str> = world.moving_objects().map(Object::name).collect();
    let still = world
        .objects()
        .filter(|o| o.attachment().is_none() && !moving.contains(&o.name()));
    let mut scene = Vec::new();
    for object in still {
        let pose = world.object_pose(object.name()).map_err(world_error)?;
        let name = simulation.symbol_of(object.name());
        scene.push(Value::list([name, pose_stamped("map", &pose)]));
    }
    Ok(scene)
}

/// What has happened to objects of a scene, a list of (name pose), that are farther (m) from their poses now
/// or have been tipped: a list of texts. Objects that a hand holds do not count.
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (pp-plans::disturbed-objects (pp-plans::scene-at-rest) 0.005))` => `NIL`
#[builtin]
fn disturbed_objects(
    simulation: &mut Simulation,
    image: &mut Image,
    scene: &Value,
    distance: &Value,
) -> Result<Vec<String>> {
    let limit = number::to_f64(distance).unwrap_or(0.0);
    let mut texts = Vec::new();
    for entry in scene.iter_list() {
        let parts = entry.list_to_vec().unwrap_or_default();
        let [name, pose] = parts.as_slice() else {
            return Err(Raise::simple(format!(
                "{} is no entry of a scene: (name pose) was expected.",
                print::to_string(image, &entry, true)
            )));
        };
        let before = simulation.pose_in_map(image, pose)?;
        texts.extend(simulation.disturbance(image, name, &before, limit)?);
    }
    Ok(texts)
}

impl Simulation {
    /// What has happened to the object since it was at the pose, if it is not held now, and
    /// farther away than the limit (m) or tipped. Nothing happened to one that is gone.
    fn disturbance(
        &self,
        image: &Image,
        name: &Value,
        before: &Pose,
        limit: f64,
    ) -> Result<Option<String>> {
        let Ok(name) = self.object_named(image, name) else {
            return Ok(None);
        };
        let object = self.world.object(&name).map_err(world_error)?;
        if object.attachment().is_some() {
            return Ok(None);
        }
        let now = self.world.object_pose(&name).map_err(world_error)?;
        let moved = (now.translation.vector - before.translation.vector).norm();
        let [was_up, is_up] = [before, &now].map(|pose| pose.rotation * Vector3::z());
        let tilt = trig::atan2(was_up.cross(&is_up).norm(), was_up.dot(&is_up)).to_degrees();
        let mut what = Vec::new();
        if moved > limit {
            what.push(format!("was moved by {:.1} cm", moved * 100.0));
        }
        if tilt > TIPPED && object.can_tip() {
            what.push(format!("was tipped by {tilt:.0} degrees"));
        }
        Ok((!what.is_empty()).then(|| format!("{name} {}", what.join(" and "))))
    }
}

/// Does a hand hold the object, and has it lifted it off what it stood on?
#[builtin]
fn object_lifted_p(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<bool> {
    let name = simulation.object_named(image, name)?;
    let object = simulation.world.object(&name).map_err(world_error)?;
    Ok(object.hold().is_some_and(|hold| hold.is_lifted()))
}

/// The name of what carries most of an object, except the robot: a string.
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (pp-plans::support-of 'bottle-1))` => `"table_area_main"`
#[builtin]
fn support_of(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<String> {
    let name = simulation.object_named(image, name)?;
    let carrier = simulation.world.carrier(&name).map_err(world_error)?;
    Ok(carrier.map_or_else(|| "nothing".to_owned(), |body| body.to_string()))
}

/// How far (m) an object would fall from a pose, and the name of what it would fall onto: a list; NIL if
/// nothing is below.
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (second (pp-plans::drop-below 'bottle-1 (pp-tut:make-pose "map" '((-1.6 -0.9 1.2) (0 0 0 1))))))` => `"table_area_main"`
#[builtin]
fn drop_below(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    pose: &Value,
) -> Result<Option<Value>> {
    let name = simulation.object_named(image, name)?;
    let pose = simulation.pose_in_map(image, pose)?;
    let below = simulation.world.below(&name, &pose).map_err(world_error)?;
    Ok(below.map(|(drop, body)| Value::list([Value::Double(drop), Value::from(body.to_string())])))
}

/// The names of what carries an object, what carries that, and so on down to furniture or the floor: strings.
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (pp-plans::carriers-of 'bottle-1))` => `("table_area_main")`
#[builtin]
fn carriers_of(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
) -> Result<Vec<String>> {
    let name = simulation.object_named(image, name)?;
    let carriers = simulation.world.carriers(&name).map_err(world_error)?;
    Ok(carriers.iter().map(ToString::to_string).collect())
}
