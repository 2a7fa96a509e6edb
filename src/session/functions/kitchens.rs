//! Other kitchens than the one in which a session began: generated ones.

use crate::host::SimulationHost;
use crate::simulation::Simulation;
use crate::simulation::names::name_text;
use kitchens::{Facts, Kitchen, Setting, Settings, is_parameter};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::robot::KinematicTree;
use robotics::world::{KitchenDescription, Models};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = builtins![new_kitchen];

/// Builtins of package `PLAN-SYSTEM`, which `PLANWRIGHT` imports.
pub(super) static DRAWN: &[Builtin] = builtins![drawn_kitchen, open_if_free, has_parameter];

/// Puts a joint of the kitchen at a position (m or rad) at once, unless what it moves would hit anything
/// there. Has it?
#[builtin("%OPEN-IF-FREE", edit)]
fn open_if_free(host: &mut SimulationHost, joint: &Value, position: &Value) -> Result<bool> {
    let name = joint.as_text().unwrap_or_default();
    let position = number::to_f64(position).unwrap_or(f64::NAN);
    let world = &mut host.simulation.world;
    let joint = world.models().kitchen.joint_named(&name);
    let is_free = joint.is_some_and(|joint| {
        let part = world.part(joint);
        world.moved(&part, position).hit().is_none()
    });
    if is_free {
        let put = world.teleport_kitchen_joint(&name, position);
        put.map_err(Raise::reporting)?;
    }
    Ok(is_free)
}

/// Has a generated kitchen a parameter of that name, a string?
///
/// `(pw::%kitchen-parameter-p "table")` => `T`
/// `(pw::%kitchen-parameter-p "drawers")` => `NIL`
#[builtin("%KITCHEN-PARAMETER-P")]
fn has_parameter(name: &Value) -> bool {
    is_parameter(&name.as_text().unwrap_or_default())
}

/// Puts the robot into the generated kitchen of a seed, without objects; without a seed, into the kitchen in
/// which the session began. Parameters are keys with values, such as :arrangement :galley, :table nil,
/// :counter-height 0.9, or :back-3 nil for a module that is to be closed; all others stay as the seed draws
/// them. Returns what is remarkable about it: how its furniture is arranged, the size of the room, the
/// narrowest way between rows that face each other and the height of the counter (m), the number of drawers;
/// and :redrawn if the seed's own draws do not go with the parameters, so that all others were drawn anew.
///
/// `(getf (new-kitchen 7) :arrangement)` => `:L`
/// `(getf (new-kitchen 7 :counter-height 0.9) :counter-height)` => `0.9`
/// `(new-kitchen)` => `NIL`
#[builtin(edit)]
fn new_kitchen(
    host: &mut SimulationHost,
    image: &mut Image,
    seed: Option<&Value>,
    parameters: &[Value],
) -> Result<Value> {
    let seed = match seed.filter(|seed| seed.is_true()) {
        None => None,
        Some(given) => Some(seed_of(given)?),
    };
    let settings = settings_of(image, parameters)?;
    check_change(host)?;
    let Some(seed) = seed else {
        if !settings.is_empty() {
            return Err(Raise::simple(
                "Only a generated kitchen has parameters: (new-kitchen SEED :table nil), for example.",
            ));
        }
        let simulation = &mut host.simulation;
        simulation.go_home();
        simulation.restart();
        return Ok(Value::NIL);
    };
    let kitchen = Kitchen::with(seed, &settings).map_err(Raise::reporting)?;
    enter(host, seed, &kitchen)?;
    Ok(facts_of(image, &kitchen.facts))
}

/// As NEW-KITCHEN; returns a list of what that returns, of the parameters with their simplest values where
/// they have others, as lists (NAME VALUE), of those that are set, as lists (NAME TEXT), and of the extent of
/// the room (least x, least y, greatest x, greatest y; m, map). If there is no such kitchen, a string that
/// says why.
#[builtin("%NEW-KITCHEN", edit)]
fn drawn_kitchen(
    host: &mut SimulationHost,
    image: &mut Image,
    seed: &Value,
    parameters: &Value,
) -> Result<Value> {
    let seed = seed_of(seed)?;
    let parameters: Vec<Value> = parameters.iter_list().collect();
    let settings = settings_of(image, &parameters)?;
    check_change(host)?;
    let kitchen = match Kitchen::with(seed, &settings) {
        Ok(kitchen) => kitchen,
        // The seed would make each such world one of a kind.
        Err(impossible) => {
            let why = format!("no kitchen is like that: {}", impossible.rejection.words());
            return Ok(Value::string(&why));
        }
    };
    enter(host, seed, &kitchen)?;
    let simpler = kitchen.simpler.iter();
    let simpler = simpler.map(|(name, setting)| {
        let value = match setting {
            Setting::Flag(flag) => (*flag).into(),
            Setting::Number(number) => Value::Double(*number),
            Setting::Name(name) => Value::string(name),
        };
        Value::list([Value::string(name), value])
    });
    let simpler = Value::list(simpler.collect::<Vec<_>>());
    let settings = settings
        .iter()
        .map(|(name, setting)| [Value::string(name), Value::string(setting.to_string())]);
    let settings = Value::list(settings.map(Value::list).collect::<Vec<_>>());
    let Facts { room, start, .. } = kitchen.facts;
    let extent = [-start[0], -start[1], room[0] - start[0], room[1] - start[1]];
    let extent = Value::list(extent.map(Value::Double));
    Ok(Value::list([
        facts_of(image, &kitchen.facts),
        simpler,
        settings,
        extent,
    ]))
}

/// The parameters that keys with values set.
fn settings_of(image: &Image, parameters: &[Value]) -> Result<Settings> {
    let mut settings = Settings::default();
    for pair in parameters.chunks(2) {
        let shown = |value: &Value| print::to_string(image, value, true);
        let key = pair.first().and_then(|key| name_text(image, key));
        let (Some(key), [_, value]) = (key, pair) else {
            return Err(Raise::simple(format!(
                "{} lacks its value: keys with values were expected, as in (new-kitchen 7 :table nil).",
                pair.first().map(shown).unwrap_or_default()
            )));
        };
        let is_t = matches!(value, Value::Symbol(sym, ..) if image.name(*sym) == "T");
        let setting = match number::to_f64(value) {
            // As it was written: 0.3, not the nearest number of less precision.
            Some(number) => Setting::Number(match value {
                Value::Single(single) => single.to_string().parse().unwrap_or(number),
                _ => number,
            }),
            None if !value.is_true() => Setting::Flag(false),
            None if is_t => Setting::Flag(true),
            None => {
                let name = name_text(image, value).unwrap_or_else(|| shown(value));
                Setting::Name(name.to_lowercase())
            }
        };
        settings
            .set(&key.to_lowercase(), setting)
            .map_err(Raise::reporting)?;
    }
    Ok(settings)
}

/// An error if the kitchen cannot be changed now.
fn check_change(host: &SimulationHost) -> Result<()> {
    if host.audience.shows_kitchen() {
        return Err(Raise::simple(
            "The live view and recordings show one kitchen: end them, or start planwright with --world generated:SEED.",
        ));
    }
    if !host.simulation.jobs.is_idle() {
        return Err(Raise::simple(
            "The robot moves: stop it before it gets another kitchen.",
        ));
    }
    Ok(())
}

/// Puts the robot into a kitchen.
fn enter(host: &mut SimulationHost, seed: u64, kitchen: &Kitchen) -> Result<()> {
    let models = models_of(&host.simulation, seed, kitchen)?;
    host.simulation.begin_with(&models);
    Ok(())
}

/// The models of a session in another kitchen.
pub(super) fn models_of(simulation: &Simulation, seed: u64, kitchen: &Kitchen) -> Result<Models> {
    let name = format!("generated:{seed}");
    let tree = KinematicTree::built_in(&kitchen.urdf, &name).map_err(Raise::reporting)?;
    let description = KitchenDescription::from_sexp(&kitchen.description, &name, &tree)
        .map_err(Raise::reporting)?;
    Ok(simulation.models.with_kitchen(tree, description))
}

/// What is remarkable about a kitchen, as keys with values.
fn facts_of(image: &mut Image, facts: &Facts) -> Value {
    // As the reader makes it of a decimal fraction.
    let length = |length: f64| Value::Single(((length * 1e3).round() / 1e3) as f32);
    let arrangement = facts.arrangement.name().to_uppercase();
    let aisle = match facts.aisle.is_finite() {
        true => length(facts.aisle),
        false => Value::NIL,
    };
    let entries = [
        ("ARRANGEMENT", image.keyword(&arrangement).into()),
        ("ROOM", Value::list(facts.room.map(length))),
        ("AISLE", aisle),
        ("COUNTER-HEIGHT", length(facts.counter_height)),
        ("DRAWERS", Value::from(facts.drawers as i64)),
        ("TABLE", facts.has_table.into()),
    ];
    let redrawn = ("REDRAWN", Value::from(true));
    let redrawn = facts.is_redrawn.then_some(redrawn);
    let entries: Vec<Value> = entries
        .into_iter()
        .chain(redrawn)
        .flat_map(|(key, value)| [image.keyword(key).into(), value])
        .collect();
    Value::list(entries)
}

/// The seed that a value is.
pub(super) fn seed_of(given: &Value) -> Result<u64> {
    let seed = match given {
        Value::Int(seed) => u64::try_from(*seed).ok(),
        Value::Big(seed) => u64::try_from(&**seed).ok(),
        _ => None,
    };
    seed.ok_or_else(|| Raise::simple("A seed is an integer from 0 to 18446744073709551615."))
}
