//! What hands reach, of many objects.

use super::asking::names_in;
use crate::simulation::Simulation;
use crate::simulation::motions::{side, side_keyword};
use crate::simulation::names::{name_text, type_keyword};
use crate::simulation::reached_grasps::{Hindrances, ReachedGrasps};
use lisp::image::Image;
use lisp::typed::{self, builtin};
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::robot::Side;
use robotics::world::{World, WorldError};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Of what the first grasp is enough.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Each {
    Object,
    Side,
    Grasp,
}

impl Each {
    fn of(image: &Image, value: &Value) -> Result<Each> {
        match name_text(image, value).as_deref() {
            Some("OBJECT") => Ok(Each::Object),
            Some("SIDE") => Ok(Each::Side),
            Some("GRASP") => Ok(Each::Grasp),
            _ => Err(Raise::simple(
                "The first grasp of each :OBJECT, each :SIDE or each :GRASP was expected.",
            )),
        }
    }
}

/// The sides of a list of arms.
fn sides_in(image: &Image, arms: &Value) -> Result<Vec<Side>> {
    arms.iter_list().map(|arm| side(image, &arm)).collect()
}

/// By which grasps hands reach objects from where the robot stands, as lists (object side grasp): all grasps
/// if EACH is :GRASP, the first of each hand if :SIDE, the first of all if :OBJECT; as if the objects ABSENT
/// were not there. With AMONG, lists such as these, of no others.
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr::%reached-grasps '(bottle-1) '(:left :right) :grasp))` => `NIL`
#[builtin("%REACHED-GRASPS")]
pub(super) fn reached(
    simulation: &mut Simulation,
    image: &mut Image,
    names: &Value,
    sides: &Value,
    each: &Value,
    absent: Option<&Value>,
    among: Option<&Value>,
) -> Result<Vec<Value>> {
    let names = names_in(simulation, image, names)?;
    let sides = sides_in(image, sides)?;
    let each = Each::of(image, each)?;
    let absent = absent.filter(|absent| absent.is_true());
    let absent = absent.map(|absent| names_in(simulation, image, absent));
    let absent = absent.transpose()?.unwrap_or_default();
    let among = among.filter(|among| among.is_true());
    let among: Option<Vec<Value>> = among.map(|rows| rows.iter_list().collect());
    let simulation = &*simulation;
    let copy = without_held(simulation, &absent)?;
    let (world, absent) = match &copy {
        Some(world) => (world, &[][..]),
        None => (&simulation.world, absent.as_slice()),
    };
    let mut reached = ReachedGrasps::new(simulation, world, absent);
    let mut rows = Vec::new();
    for name in &names {
        let kind = world.object(name).map_err(raise)?.type_name();
        'object: for &side in &sides {
            for grasp in simulation.defined_grasps(kind, side) {
                let Some(definition) = simulation.definition(kind, side, &grasp) else {
                    continue;
                };
                let row = [
                    simulation.symbol_of(name),
                    side_keyword(image, side),
                    type_keyword(image, &grasp),
                ];
                let symbols = row.each_ref().map(Value::as_symbol);
                let is_row =
                    |other: &Value| other.iter_list().map(|part| part.as_symbol()).eq(symbols);
                if among.as_ref().is_some_and(|all| !all.iter().any(is_row)) {
                    continue;
                }
                if !reached.has(name, side, &definition)? {
                    continue;
                }
                rows.push(Value::list(row));
                match each {
                    Each::Object => break 'object,
                    Each::Side => break,
                    Each::Grasp => {}
                }
            }
        }
    }
    Ok(rows)
}

/// The objects without any of which a hand could grasp an object from where the robot stands that no hand can
/// grasp now; or :UNCLEAR where objects are above that one or in hands, so that each has to be tried.
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr::%hindrances 'bottle-1 '(:left :right)))` => `NIL`
#[builtin("%HINDRANCES")]
pub(super) fn hindrances(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    sides: &Value,
) -> Result<Value> {
    let name = simulation.object_named(image, name)?;
    let sides = sides_in(image, sides)?;
    let simulation = &*simulation;
    let world = &simulation.world;
    let kind = world.object(&name).map_err(raise)?.type_name();
    let others = world.objects().map(|object| object.name().to_owned());
    let others: Vec<String> = others.filter(|other| *other != name).collect();
    let mut reached = ReachedGrasps::new(simulation, world, &[]);
    let mut without = ReachedGrasps::new(simulation, world, &others);
    let mut without_each: Vec<Option<ReachedGrasps>> = others.iter().map(|_| None).collect();
    let mut found = vec![false; others.len()];
    for &side in &sides {
        for grasp in simulation.defined_grasps(kind, side) {
            let Some(definition) = simulation.definition(kind, side, &grasp) else {
                continue;
            };
            let some = match reached.hindrances(&mut without, &name, side, &definition)? {
                Hindrances::Nothing => return Ok(Value::NIL),
                Hindrances::Objects(some) => some,
                Hindrances::Unclear => return Ok(type_keyword(image, "UNCLEAR")),
            };
            let each = others.iter().zip(&mut without_each).zip(&mut found);
            for ((other, without), is_found) in each {
                if !*is_found && some.contains(&other.as_str()) {
                    let absent = std::slice::from_ref(other);
                    let without = without
                        .get_or_insert_with(|| ReachedGrasps::new(simulation, world, absent));
                    *is_found = without.has(&name, side, &definition)?;
                }
            }
        }
    }
    let found = others.iter().zip(found).filter(|(_, is_found)| *is_found);
    Ok(Value::list(
        found.map(|(name, _)| simulation.symbol_of(name)),
    ))
}

/// A copy of the world without some objects, if hands hold something: what they hold moves with them.
fn without_held(simulation: &Simulation, absent: &[String]) -> Result<Option<World>> {
    let world = &simulation.world;
    let mut objects = world.objects();
    if absent.is_empty() || objects.all(|object| object.attachment().is_none()) {
        return Ok(None);
    }
    let mut copy = world.clone();
    for name in absent {
        copy.remove(name).map_err(raise)?;
    }
    Ok(Some(copy))
}

fn raise(error: WorldError) -> Box<Raise> {
    Raise::reporting(error)
}
