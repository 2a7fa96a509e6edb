//! Builtins for symbolic locations: the samples that generators give, what validators say of a
//! pose, and the furniture by name.

use crate::host::SimulationHost;
use crate::host::call::{done, host};
use crate::simulation::Simulation;
use crate::simulation::names::type_keyword;
use cram::Reply;
use cram::designator::value::{as_designator, first};
use cram::pose::value::{as_placement, pose_stamped};
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::location::surfaces;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-LOCATION-COSTMAP`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "NEXT-LOCATION-SAMPLE",
        "location references",
        "The next pose that fulfils the location's description, which has not been given before. A text that says why if there is none; NIL if this is no description of a place; :INTERRUPTED. The references are what LOCATION-REFERENCES gives.",
        &["(costmap:next-location-sample (desig:a location) nil) => NIL"],
        host!(next_sample),
    ),
    control(
        "SUITABLE-ROBOT-POSE",
        "location references",
        "The pose of the robot if it fulfils the location's description, else NIL.",
        &["(costmap:suitable-robot-pose (desig:a location) nil) => NIL"],
        host!(suitable_robot_pose),
    ),
    control(
        "JUDGE-LOCATION-SAMPLE",
        "location references pose",
        "What a validator says of a pose: :ACCEPT if it fulfils the location's description, :UNKNOWN if there is none, else a text that says why not.",
        &["(costmap:judge-location-sample (desig:a location) nil nil) => :UNKNOWN"],
        host!(judge),
    ),
    control(
        "LOCATION-SEARCH-BEGUN-P",
        "location",
        "Has the search for the location begun, so that its references are known?",
        &["(costmap:location-search-begun-p (desig:a location)) => NIL"],
        host!(has_begun),
    ),
    control(
        "HORIZONTAL-SIZE",
        "thing",
        "The shorter of a thing's horizontal edges (m): of an object, a type of objects, or furniture; NIL if it is none of these.",
        &["(> (costmap:horizontal-size :bowl) 0.1) => T"],
        host!(horizontal_size),
    ),
    control(
        "FURNITURE-EXTENT",
        "thing",
        "The limits of furniture in its own frame (m): least and greatest x, least and greatest y; NIL if it is none.",
        &["(length (costmap:furniture-extent :table-area-main)) => 4"],
        host!(furniture_extent),
    ),
    control(
        "SHOW-LOCATION-MAP",
        "location references",
        "Shows where a location may be in pictures and the live view: cells coloured by their values, and the poses offered so far as arrows, the last one in another colour. Writes how large the area is. It stays until another one is shown.",
        &[],
        host!(show_map),
    ),
];

/// Builtins of package `CRAM-BULLET-REASONING`.
pub(crate) static VISUALIZATION_TABLE: &[Builtin] = &[control(
    "CLEAR-COSTMAP-VIS-OBJECT",
    "",
    "Shows no map of a location any more.",
    &["(btr:clear-costmap-vis-object) => NIL"],
    host!(clear_map),
)];

/// Builtins of package `PLANWRIGHT`.
pub(crate) static FURNITURE_TABLE: &[Builtin] = &[control(
    "LIST-SURFACES",
    "",
    "The furniture on which things can be put: the names that (urdf-name …) takes.",
    &["(and (member :table-area-main (list-surfaces)) t) => T"],
    host!(list_surfaces),
)];

fn next_sample(host: &mut SimulationHost, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let simulation = &mut host.simulation;
    let Some(memory) = simulation.location_stream(image, &args[0], &args[1])? else {
        return done(Value::NIL);
    };
    let found = simulation.with_stream(image, &memory, |stream, scene| {
        let found = stream.next(scene)?;
        Ok((found.ok_or_else(|| stream.why()), stream.count()))
    })?;
    if host.audience.has_followers() && matches!(found, Some((Ok(_), 1))) {
        simulation.resolved_map = simulation.location_map_of(image, &memory)?;
    }
    match found.map(|(found, _)| found) {
        Some(Ok(pose)) => done(pose_stamped("map", &pose)),
        Some(Err(why)) => done(Value::from(why.as_str())),
        None => done(image.keyword("INTERRUPTED")),
    }
}

fn suitable_robot_pose(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let Some(memory) = simulation.location_stream(image, &args[0], &args[1])? else {
        return done(Value::NIL);
    };
    let found = simulation.with_stream(image, &memory, |stream, scene| stream.here(scene))?;
    let pose = found.flatten();
    done(pose.map_or(Value::NIL, |pose| pose_stamped("map", &pose)))
}

fn judge(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let memory = simulation.location_stream(image, &args[0], &args[1])?;
    let Some(memory) = memory else {
        return done(image.keyword("UNKNOWN"));
    };
    if as_placement(&args[2]).is_none() {
        return done(image.keyword("UNKNOWN"));
    }
    let pose = simulation.pose_in_map(image, &args[2])?;
    let verdict =
        simulation.with_stream(image, &memory, |stream, scene| stream.check(scene, &pose))?;
    match verdict {
        Some(Ok(())) => done(image.keyword("ACCEPT")),
        Some(Err(why)) => done(Value::from(why.as_str())),
        None => done(image.keyword("INTERRUPTED")),
    }
}

fn has_begun(_: &mut Simulation, _: &mut Image, args: &[Value]) -> Result<Reply> {
    let oldest = first(&args[0]);
    done(as_designator(&oldest).is_some_and(|d| d.memory.borrow().is_some()))
}

fn horizontal_size(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let size = simulation.size_of(image, &args[0]);
    done(size.map_or(Value::NIL, |[x, y]| Value::Double(x.min(y))))
}

fn furniture_extent(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let extent = simulation.furniture_of(image, &args[0]);
    let extent = extent.and_then(|link| simulation.world.assembly_extent(link));
    done(extent.map_or(Value::NIL, |extent| {
        let [min, max] = [extent.min, extent.max];
        Value::list([min[0], max[0], min[1], max[1]].map(Value::Double))
    }))
}

fn show_map(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let Some(memory) = simulation.location_stream(image, &args[0], &args[1])? else {
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
    done(Value::NIL)
}

fn clear_map(simulation: &mut Simulation, _: &mut Image, _: &[Value]) -> Result<Reply> {
    simulation.location_map = None;
    simulation.resolved_map = None;
    done(Value::NIL)
}

fn list_surfaces(simulation: &mut Simulation, image: &mut Image, _: &[Value]) -> Result<Reply> {
    let kitchen = &simulation.models.kitchen;
    let names = surfaces(&simulation.world).into_iter();
    let names = names.map(|(link, _)| furniture_keyword(image, &kitchen.link(link).name));
    done(Value::list(names.collect::<Vec<_>>()))
}

/// The keyword of a link of the kitchen.
fn furniture_keyword(image: &mut Image, name: &str) -> Value {
    type_keyword(image, &name.replace('_', "-"))
}
