//! Builtins for symbolic locations: the samples that generators give, what validators say of a
//! pose, and the furniture by name.

use crate::host::SimulationHost;
use crate::simulation::Simulation;
use crate::simulation::names::type_keyword;
use cram::designator::value::{as_designator, first};
use cram::pose::value::{as_placement, pose_stamped};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::location::surfaces;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-LOCATION-COSTMAP`.
pub(super) static TABLE: &[Builtin] = builtins![
    next_location_sample,
    suitable_robot_pose,
    judge_location_sample,
    location_search_begun_p,
    horizontal_size,
    furniture_extent,
    show_location_map
];

/// Builtins of package `CRAM-BULLET-REASONING`.
pub(crate) static VISUALIZATION_TABLE: &[Builtin] = builtins![clear_costmap_vis_object];

/// Builtins of package `PLANWRIGHT`.
pub(crate) static FURNITURE_TABLE: &[Builtin] = builtins![list_surfaces];

/// The next pose that fulfils the location's description, which has not been given before. A text that says
/// why if there is none; NIL if this is no description of a place; :INTERRUPTED. The references are what
/// LOCATION-REFERENCES gives.
///
/// `(costmap:next-location-sample (desig:a location) nil)` => `NIL`
#[builtin]
fn next_location_sample(
    host: &mut SimulationHost,
    image: &mut Image,
    location: &Value,
    references: &Value,
) -> Result<Value> {
    let simulation = &mut host.simulation;
    let Some(memory) = simulation.location_stream(image, location, references)? else {
        return Ok(Value::NIL);
    };
    let found = simulation.with_stream(image, &memory, |stream, scene| {
        let found = stream.next(scene)?;
        Ok((found.ok_or_else(|| stream.why()), stream.count()))
    })?;
    if host.audience.has_followers() && matches!(found, Some((Ok(_), 1))) {
        simulation.resolved_map = simulation.location_map_of(image, &memory)?;
    }
    Ok(match found.map(|(found, _)| found) {
        Some(Ok(pose)) => pose_stamped("map", &pose),
        Some(Err(why)) => Value::from(why),
        None => image.keyword("INTERRUPTED").into(),
    })
}

/// The pose of the robot if it fulfils the location's description, else NIL.
///
/// `(costmap:suitable-robot-pose (desig:a location) nil)` => `NIL`
#[builtin]
fn suitable_robot_pose(
    simulation: &mut Simulation,
    image: &mut Image,
    location: &Value,
    references: &Value,
) -> Result<Option<Value>> {
    let Some(memory) = simulation.location_stream(image, location, references)? else {
        return Ok(None);
    };
    let found = simulation.with_stream(image, &memory, |stream, scene| stream.here(scene))?;
    Ok(found.flatten().map(|pose| pose_stamped("map", &pose)))
}

/// What a validator says of a pose: :ACCEPT if it fulfils the location's description, :UNKNOWN if there is
/// none, else a text that says why not.
///
/// `(costmap:judge-location-sample (desig:a location) nil nil)` => `:UNKNOWN`
#[builtin]
fn judge_location_sample(
    simulation: &mut Simulation,
    image: &mut Image,
    location: &Value,
    references: &Value,
    pose: &Value,
) -> Result<Value> {
    let memory = simulation.location_stream(image, location, references)?;
    let (Some(memory), Some(_)) = (memory, as_placement(pose)) else {
        return Ok(image.keyword("UNKNOWN").into());
    };
    let pose = simulation.pose_in_map(image, pose)?;
    let verdict =
        simulation.with_stream(image, &memory, |stream, scene| stream.check(scene, &pose))?;
    Ok(match verdict {
        Some(Ok(())) => image.keyword("ACCEPT").into(),
        Some(Err(why)) => Value::from(why),
        None => image.keyword("INTERRUPTED").into(),
    })
}

/// Has the search for the location begun, so that its references are known?
///
/// `(costmap:location-search-begun-p (desig:a location))` => `NIL`
#[builtin]
fn location_search_begun_p(_: &mut Simulation, location: &Value) -> bool {
    let oldest = first(location);
    as_designator(&oldest).is_some_and(|d| d.memory.borrow().is_some())
}

/// The shorter of a thing's horizontal edges (m): of an object, a type of objects, or furniture; NIL if it is
/// none of these.
///
/// `(> (costmap:horizontal-size :bowl) 0.1)` => `T`
#[builtin]
fn horizontal_size(simulation: &mut Simulation, image: &mut Image, thing: &Value) -> Option<f64> {
    let size = simulation.size_of(image, thing);
    size.map(|[x, y]| x.min(y))
}

/// The limits of furniture in its own frame (m): least and greatest x, least and greatest y; NIL if it is
/// none.
///
/// `(length (costmap:furniture-extent :table-area-main))` => `4`
#[builtin]
fn furniture_extent(
    simulation: &mut Simulation,
    image: &mut Image,
    thing: &Value,
) -> Option<Value> {
    let extent = simulation.furniture_of(image, thing);
    let extent = extent.and_then(|link| simulation.world.assembly_extent(link));
    extent.map(|extent| {
        let [min, max] = [extent.min, extent.max];
        Value::list([min[0], max[0], min[1], max[1]].map(Value::Double))
    })
}

/// Shows where a location may be in pictures and the live view: cells coloured by their values, and the poses
/// offered so far as arrows, the last one in another colour. Writes how large the area is. It stays until
/// another one is shown.
#[builtin]
fn show_location_map(
    simulation: &mut Simulation,
    image: &mut Image,
    location: &Value,
    references: &Value,
) -> Result<()> {
    let Some(memory) = simulation.location_stream(image, location, references)? else {
        return Err(Raise::simple(
            "There is nothing to be seen: the location does not say on what it is, nor what the robot is to reach or see.",
        ));
    };
    simulation.location_map = simulation.location_map_of(image, &memory)?;
    let summary = simulation.with_stream(image, &memory, |stream, _| {
        Ok(match stream.is_empty() {
            true => stream.why(),
            false => stream.summary(),
        })
    })?;
    image.output.fresh_line();
    image.output.write(&summary.unwrap_or_default());
    image.output.fresh_line();
    Ok(())
}

/// Shows no map of a location any more.
///
/// `(btr:clear-costmap-vis-object)` => `NIL`
#[builtin]
fn clear_costmap_vis_object(simulation: &mut Simulation) {
    simulation.location_map = None;
    simulation.resolved_map = None;
}

/// The furniture on which things can be put: the names that (urdf-name …) takes.
///
/// `(and (member :table-area-main (list-surfaces)) t)` => `T`
#[builtin]
fn list_surfaces(simulation: &mut Simulation, image: &mut Image) -> Vec<Value> {
    let kitchen = &simulation.models.kitchen;
    let names = surfaces(&simulation.world).into_iter();
    let names = names.map(|(link, _)| furniture_keyword(image, &kitchen.link(link).name));
    names.collect()
}

/// The keyword of a link of the kitchen.
fn furniture_keyword(image: &mut Image, name: &str) -> Value {
    type_keyword(image, &name.replace('_', "-"))
}
