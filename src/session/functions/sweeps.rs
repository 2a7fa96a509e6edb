//! What sweeps ask of the session: a fresh world, the numbers of its draws, and the record of what
//! came of it. The rest of sweeps is written in Lisp (`plans/lib/sweeps.plan`).

use crate::audience::Audience;
use crate::dialogue::Swept;
use crate::host::SimulationHost;
use crate::simulation::Simulation;
use crate::simulation::injection::{Fault, FaultKind};
use crate::simulation::names::name_text;
use crate::sweeping::{Known, Stage, Sweeping, excuse_lack_of_memory};
use closest_name::closest_name;
use cram::Handlers;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, FromValue, builtin, builtins};
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use sweep::summary::{Summary, Title};
use sweep::{Drawn, Ending, Record, normal_quantile};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLAN-SYSTEM`, which `PLANWRIGHT` imports.
pub(super) static TABLE: &[Builtin] = builtins![
    begin,
    run_begins,
    run_ends,
    inject,
    inject_schedule,
    injected_faults,
    end_faults,
    begin_faults,
    record,
    restore_quietly,
    mute_output,
    varying,
    unit,
    overriding,
    set,
    forget,
    note,
    kitchen,
    overrides,
    deviate,
    known,
    summary
];

/// A seed or the number of a world.
struct Number(u64);

impl FromValue<'_> for Number {
    fn from_value(_: &mut Image, value: &Value) -> Result<Self> {
        let number = match value {
            Value::Int(number) => u64::try_from(*number).ok(),
            Value::Big(number) => u64::try_from(&**number).ok(),
            _ => None,
        };
        number.map(Number).ok_or_else(|| {
            Raise::simple(
                "A seed or the number of a world is an integer from 0 to 18446744073709551615.",
            )
        })
    }
}

/// The path of a draw, or another text.
struct Text(String);

impl FromValue<'_> for Text {
    fn from_value(_: &mut Image, value: &Value) -> Result<Self> {
        text(value).map(Text)
    }
}

fn text(value: &Value) -> Result<String> {
    value
        .as_text()
        .ok_or_else(|| Raise::simple("The path of a draw is a string."))
}

/// Takes everything to the start of a world of a sweep: no objects, the robot at the origin, random numbers
/// as its seed and number say.
#[builtin("%SWEEP-BEGIN", edit)]
fn begin(host: &mut SimulationHost, image: &mut Image, seed: Number, world: Number) {
    let (Number(seed), Number(world)) = (seed, world);
    let state = Sweeping::of(image);
    state.begin(seed, world);
    image.seed(state.bits("lisp"));
    let injection = std::rc::Rc::clone(&host.simulation.injection);
    injection.borrow_mut().begin(seed, world, state.off());
    host.simulation.restart_with(state.bits("simulation"));
}

/// The plan begins: from here on its time is counted.
#[builtin("%SWEEP-RUN-BEGINS", edit)]
fn run_begins(host: &mut SimulationHost, image: &mut Image) {
    Handlers::of(image).reset();
    Sweeping::of(image).enter(Stage::Running);
    host.simulation.begin_tally();
    host.person.timeline.set_off(true);
}

/// The plan has ended.
#[builtin("%SWEEP-RUN-ENDS", edit)]
fn run_ends(simulation: &mut Simulation) {
    simulation.end_tally();
}

/// Faults are drawn anew, as the seed says.
#[builtin("%BEGIN-FAULTS", edit)]
fn begin_faults(simulation: &mut Simulation, image: &mut Image, seed: Number) {
    let off = Sweeping::of(image).off();
    simulation.injection.borrow_mut().begin(seed.0, 0, off);
    simulation.begin_tally();
}

/// No fault strikes any more.
///
/// `(pw::%end-faults)` => `NIL`
#[builtin("%END-FAULTS", edit)]
fn end_faults(simulation: &mut Simulation) {
    simulation.injection.borrow_mut().end();
}

/// The faults that have struck since the last ones were injected, as strings.
///
/// `(pw::%injected-faults)` => `NIL`
#[builtin("%INJECTED-FAULTS")]
fn injected_faults(simulation: &mut Simulation) -> Vec<String> {
    simulation.injection.borrow().struck()
}

/// Faults that have struck in a world strike again, in the same meetings with the same objects.
#[builtin("%INJECT-SCHEDULE", edit)]
fn inject_schedule(simulation: &mut Simulation, image: &mut Image, faults: &Value) -> Result<()> {
    let mut schedule: Vec<Fault> = Vec::new();
    for item in faults.iter_list() {
        let Some(fault) = item.as_text().and_then(|path| Fault::of_path(&path)) else {
            return Err(Raise::simple(format!(
                "{} is no fault of a schedule: a string such as \"inject.gripper-slip.BOTTLE.1\" was \
                 expected, as (injected-faults) returns them; errors of perception-noise cannot be repeated so.",
                print::to_string(image, &item, true)
            )));
        };
        // One fault for each kind and object, or each would count meetings.
        let same = |known: &&mut Fault| known.kind == fault.kind && known.of == fault.of;
        match schedule.iter_mut().find(same) {
            Some(known) => known.at.extend(fault.at),
            None => schedule.push(fault),
        }
    }
    let mut injection = simulation.injection.borrow_mut();
    schedule.into_iter().for_each(|fault| injection.add(fault));
    Ok(())
}

/// A meeting, or a list of meetings, counted from 1.
fn meetings(image: &Image, value: &Value) -> Result<Vec<u64>> {
    let all = match value {
        Value::Int(_) => vec![value.clone()],
        _ => value.list_to_vec().unwrap_or_else(|| vec![value.clone()]),
    };
    let number = |value: &Value| match value {
        Value::Int(number) => u64::try_from(*number).ok().filter(|number| *number > 0),
        _ => None,
    };
    let numbers: Option<Vec<u64>> = all.iter().map(number).collect();
    numbers.ok_or_else(|| {
        Raise::simple(format!(
            "{} does not say when a fault strikes: 1 for the first time that it could, or a list such as \
             (1 3), was expected.",
            print::to_string(image, value, true)
        ))
    })
}

/// A fault may strike motions from now on.
#[builtin("%INJECT", edit)]
fn inject(
    simulation: &mut Simulation,
    image: &mut Image,
    kind: &Value,
    probability: &Value,
    after: &Value,
    duration: &Value,
    of: &Value,
    at: &Value,
    position: &Value,
    yaw: &Value,
) -> Result<()> {
    let name = name_text(image, kind).unwrap_or_default();
    let names = FaultKind::ALL.map(FaultKind::name);
    let mut kinds = FaultKind::ALL.into_iter();
    let Some(kind) = kinds.find(|kind| kind.name().eq_ignore_ascii_case(&name)) else {
        let name = name.to_lowercase();
        let near = closest_name(&name, names).map_or_else(
            || format!("; there are {}.", names.join(", ")),
            |near| format!("; did you mean {near}?"),
        );
        return Err(Raise::simple(format!("{name} is no kind of fault{near}")));
    };
    let number_from = |value: &Value, what: &str, most: f64| match value {
        value if !value.is_true() => Ok(None),
        value => match number::to_f64(value).filter(|number| (0.0..=most).contains(number)) {
            Some(number) => Ok(Some(number)),
            None => Err(Raise::simple(format!(
                "{} is no {what}: a number from 0 to {most} was expected.",
                print::to_string(image, value, true)
            ))),
        },
    };
    let of = match of {
        value if !value.is_true() => None,
        value => Some(name_text(image, value).ok_or_else(|| {
            Raise::simple("What a fault is :OF is the name of an object or of a type.")
        })?),
    };
    let fault = Fault {
        kind,
        probability: number_from(probability, "probability", 1.0)?.unwrap_or(1.0),
        after: number_from(after, "time", 1e9)?,
        duration: number_from(duration, "duration", 1e9)?,
        of,
        at: meetings(image, at)?,
        position: number_from(position, "standard deviation of positions", 1.0)?.unwrap_or(0.0),
        yaw: number_from(yaw, "standard deviation of angles", 4.0)?.unwrap_or(0.0),
    };
    simulation.injection.borrow_mut().add(fault);
    Ok(())
}

/// As RESTORE, without a word.
#[builtin("%RESTORE-QUIETLY", edit)]
fn restore_quietly(host: &mut SimulationHost, image: &mut Image, name: &Value) -> Result<()> {
    let name = name.as_symbol().map(|sym| image.name(sym).to_owned());
    let name = name.unwrap_or_default();
    host.person
        .snapshots
        .restore_kept(&mut host.simulation, &name)
}

/// Drops what is written from now on, unless INSTEAD is NIL; it says what is going on instead. Returns what
/// was given before.
///
/// `(pw::%mute-output nil)` => `NIL`
#[builtin("%MUTE-OUTPUT")]
fn mute_output(image: &mut Image, instead: &Value) -> Option<Value> {
    let before = image.output.mute(instead.as_text());
    before.map(|text| Value::string(&text))
}

/// Whether the values of a sweep's variables, or its faults, are being found: what fails then is a mistake in
/// the sweep.
///
/// `(pw::%sweep-varying nil)` => `NIL`
#[builtin("%SWEEP-VARYING")]
fn varying(image: &mut Image, flag: bool) {
    let stage = if flag { Stage::Varying } else { Stage::SetUp };
    Sweeping::of(image).enter(stage);
}

/// The next number from 0 to 1 of a path.
#[builtin("%SWEEP-UNIT")]
fn unit(image: &mut Image, path: Text) -> f64 {
    Sweeping::of(image).unit(&path.0)
}

/// A list of the value that is set for a draw; NIL if none is.
#[builtin("%SWEEP-OVERRIDE")]
fn overriding(image: &mut Image, path: Text) -> Option<Value> {
    let found = Sweeping::of(image).overriding(&path.0);
    found.map(|value| Value::list([value]))
}

/// Sets the value of a draw in the worlds that begin from now on.
#[builtin("%SWEEP-SET")]
fn set(image: &mut Image, path: Text, value: Value) {
    Sweeping::of(image).set(&path.0, value);
}

/// Draws are set no more.
///
/// `(pw::%sweep-forget)` => `NIL`
#[builtin("%SWEEP-FORGET")]
fn forget(image: &mut Image) {
    Sweeping::of(image).forget();
}

/// Notes what was drawn, and the simplest value that could have been.
#[builtin("%SWEEP-NOTE")]
fn note(image: &mut Image, path: Text, value: &Value, simplest: Option<&Value>) {
    let value = drawn(image, value);
    Sweeping::of(image).note(&path.0, value);
    if let Some(simplest) = simplest {
        let simplest = drawn(image, simplest);
        Sweeping::of(image).note_simplest(&path.0, simplest);
    }
}

/// Notes of the kitchen that has been drawn, by its path, which values of parameters would be simpler, a list
/// of (NAME VALUE), and which parameters are set, a list of (NAME TEXT).
#[builtin("%SWEEP-KITCHEN")]
fn kitchen(image: &mut Image, path: Text, simpler: &Value, settings: &Value) -> Result<()> {
    let path = path.0;
    let pairs = |list: &Value| {
        let pairs = list.iter_list().map(|pair| {
            let mut pair = pair.iter_list();
            let name = text(&pair.next().unwrap_or(Value::NIL))?;
            Ok((name, pair.next().unwrap_or(Value::NIL)))
        });
        pairs.collect::<Result<Vec<_>>>()
    };
    let simpler = pairs(simpler)?.into_iter();
    let simpler = simpler.map(|(name, value)| (format!("{path}.{name}"), drawn(image, &value)));
    let simpler = simpler.collect();
    let settings = pairs(settings)?.into_iter();
    let settings = settings.map(|(name, value)| Ok((name, text(&value)?)));
    let settings = settings.collect::<Result<_>>()?;
    Sweeping::of(image).note_kitchen(simpler, settings);
    Ok(())
}

/// What is set for draws right below a path: a list of (NAME VALUE).
///
/// `(pw::%sweep-overrides "home")` => `NIL`
#[builtin("%SWEEP-OVERRIDES")]
fn overrides(image: &mut Image, path: Text) -> Vec<Value> {
    let all = Sweeping::of(image).overrides(&path.0);
    let all = all.into_iter();
    all.map(|(name, value)| Value::list([Value::string(&name), value]))
        .collect()
}

/// A value as it is recorded.
fn drawn(image: &Image, value: &Value) -> Drawn {
    match value {
        Value::Int(number) => Drawn::Integer(*number),
        // As it was written: 0.3, not the nearest number of less precision.
        Value::Single(number) if number.is_finite() => number
            .to_string()
            .parse()
            .map_or(Drawn::Flag(false), Drawn::Number),
        _ if !value.is_true() => Drawn::Flag(false),
        Value::Symbol(sym, ..) if image.name(*sym) == "T" => Drawn::Flag(true),
        _ => match number::to_f64(value).filter(|number| number.is_finite()) {
            Some(number) => Drawn::Number(number),
            None => Drawn::Text(print::to_string(image, value, false)),
        },
    }
}

/// The standard normal deviate at that share of the distribution, or of its part between two deviates.
///
/// `(pw::%normal-deviate 0.5d0)` => `0.0d0`
#[builtin("%NORMAL-DEVIATE")]
fn deviate(unit: &Value, low: Option<&Value>, high: Option<&Value>) -> f64 {
    let [lowest, highest] = [low, high].map(|bound| bound.and_then(number::to_f64));
    let unit = number::to_f64(unit).unwrap_or(0.5);
    // The share of the distribution below a deviate.
    let below = |z: f64| 0.5 * libm::erfc(-z / std::f64::consts::SQRT_2);
    let low = lowest.map_or(0.0, below);
    let high = highest.map_or(1.0, below);
    let share = (low + unit * (high - low)).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0);
    let deviate = normal_quantile(share);
    let least = lowest.unwrap_or(f64::NEG_INFINITY);
    let most = highest.unwrap_or(f64::INFINITY);
    deviate.max(least).min(most)
}

/// Tells the command line of a sweep.
#[builtin("%SWEEP-KNOWN")]
fn known(image: &mut Image, name: Text, worlds: Number, goal: &Value) {
    let known = Known {
        name: name.0,
        worlds: worlds.0,
        goal: number::to_f64(goal),
    };
    Sweeping::of(image).know(known);
}

/// What the lines of a sweep say together, as text.
#[builtin("%SWEEP-SUMMARY")]
fn summary(
    audience: &mut Audience,
    name: Text,
    seed: Number,
    goal: &Value,
    lines: &Value,
) -> String {
    let title = Title {
        name: name.0,
        seed: seed.0,
        goal: number::to_f64(goal),
    };
    let lines = lines.iter_list().filter_map(|line| line.as_text());
    let records: Vec<Record> = lines
        .filter_map(|line| serde_json::from_str(&line).ok())
        .collect();
    let text = Summary::new(&title, &records).to_string();
    audience.swept = Some(Swept { title, records });
    text
}

/// What came of the world, as a line of JSON.
#[builtin("%SWEEP-RECORD")]
fn record(
    simulation: &mut Simulation,
    image: &mut Image,
    #[key] outcome: Option<&Value>,
    #[key] class: Option<&Value>,
    #[key] cause: Option<&Value>,
    #[key] expectations: Option<&Value>,
    #[key] measures: Option<&Value>,
) -> String {
    let state = Sweeping::of(image);
    let mut record = state.record(image, Ending::Success);
    if let Some(outcome) = outcome {
        record.outcome = ending(image, outcome);
    }
    if let Some(class) = class {
        record.class = class.as_text();
    }
    match cause {
        None => {}
        Some(Value::Symbol(sym, ..)) if image.is_keyword(*sym) => {
            record.cause = simulation.failed_by();
            record.bodies = simulation.bodies_of_failure();
        }
        Some(cause) => record.cause = cause.as_text(),
    }
    for answer in expectations.into_iter().flat_map(Value::iter_list) {
        let name = answer.car_or_nil().as_text().unwrap_or_default();
        record
            .expectations
            .set(&name, answer.cdr_or_nil().is_true());
    }
    for answer in measures.into_iter().flat_map(Value::iter_list) {
        let name = answer.car_or_nil().as_text().unwrap_or_default();
        record
            .measures
            .set(&name, drawn(image, &answer.cdr_or_nil()));
    }
    simulation.complete(&mut record);
    excuse_lack_of_memory(image, &mut record);
    let line = record.line();
    state.keep(record);
    line
}

fn ending(image: &Image, value: &Value) -> Ending {
    let name = value.as_symbol().map_or("", |sym| image.name(sym));
    match name {
        "SUCCESS" => Ending::Success,
        "EXPECTATION" => Ending::Expectation,
        "LIMIT" => Ending::Limit,
        "INVALID" => Ending::Invalid,
        _ => Ending::Failure,
    }
}
