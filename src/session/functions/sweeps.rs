//! What sweeps ask of the session: a fresh world, the numbers of its draws, and the record of what
//! came of it. The rest of sweeps is written in Lisp (`plans/lib/sweeps.plan`).

use crate::dialogue::Swept;
use crate::host::SimulationHost;
use crate::host::call::{done, edit, host};
use crate::simulation::injection::{Fault, FaultKind};
use crate::simulation::names::name_text;
use crate::sweeping::{Known, Stage, Sweeping, excuse_lack_of_memory};
use closest_name::closest_name;
use cram::{Handlers, Reply};
use lisp::builtin::{Builtin, control, pure};
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use sweep::summary::{Summary, Title};
use sweep::{Drawn, Ending, Record, normal_quantile};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLAN-SYSTEM`, which `PLANWRIGHT` imports.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "%SWEEP-BEGIN",
        "seed world",
        "Takes everything to the start of a world of a sweep: no objects, the robot at the origin, random numbers as its seed and number say.",
        &[],
        edit!(begin),
    ),
    control(
        "%SWEEP-RUN-BEGINS",
        "",
        "The plan begins: from here on its time is counted.",
        &[],
        edit!(run_begins),
    ),
    control(
        "%SWEEP-RUN-ENDS",
        "",
        "The plan has ended.",
        &[],
        edit!(run_ends),
    ),
    control(
        "%INJECT",
        "kind probability after duration of at position yaw",
        "A fault may strike motions from now on.",
        &[],
        edit!(inject),
    ),
    control(
        "%INJECT-SCHEDULE",
        "faults",
        "Faults that have struck in a world strike again, in the same meetings with the same objects.",
        &[],
        edit!(inject_schedule),
    ),
    control(
        "%INJECTED-FAULTS",
        "",
        "The faults that have struck since the last ones were injected, as strings.",
        &["(pw::%injected-faults) => NIL"],
        host!(injected_faults),
    ),
    control(
        "%END-FAULTS",
        "",
        "No fault strikes any more.",
        &["(pw::%end-faults) => NIL"],
        edit!(end_faults),
    ),
    control(
        "%BEGIN-FAULTS",
        "seed",
        "Faults are drawn anew, as the seed says.",
        &[],
        edit!(begin_faults),
    ),
    control(
        "%SWEEP-RECORD",
        "&key outcome class cause expectations measures",
        "What came of the world, as a line of JSON.",
        &[],
        host!(record),
    ),
    control(
        "%RESTORE-QUIETLY",
        "name",
        "As RESTORE, without a word.",
        &[],
        edit!(restore_quietly),
    ),
    pure(
        "%MUTE-OUTPUT",
        "instead",
        "Drops what is written from now on, unless INSTEAD is NIL; it says what is going on instead. \
         Returns what was given before.",
        &["(pw::%mute-output nil) => NIL"],
        mute_output,
    ),
    pure(
        "%SWEEP-VARYING",
        "flag",
        "Whether the values of a sweep's variables, or its faults, are being found: what fails then is a mistake in the sweep.",
        &["(pw::%sweep-varying nil) => NIL"],
        varying,
    ),
    pure(
        "%SWEEP-UNIT",
        "path",
        "The next number from 0 to 1 of a path.",
        &[],
        unit,
    ),
    pure(
        "%SWEEP-OVERRIDE",
        "path",
        "A list of the value that is set for a draw; NIL if none is.",
        &[],
        overriding,
    ),
    pure(
        "%SWEEP-SET",
        "path value",
        "Sets the value of a draw in the worlds that begin from now on.",
        &[],
        set,
    ),
    pure(
        "%SWEEP-FORGET",
        "",
        "Draws are set no more.",
        &["(pw::%sweep-forget) => NIL"],
        forget,
    ),
    pure(
        "%SWEEP-NOTE",
        "path value &optional simplest",
        "Notes what was drawn, and the simplest value that could have been.",
        &[],
        note,
    ),
    pure(
        "%SWEEP-KITCHEN",
        "path simpler settings",
        "Notes of the kitchen that has been drawn, by its path, which values of parameters would be simpler, a list of (NAME VALUE), and which parameters are set, a list of (NAME TEXT).",
        &[],
        kitchen,
    ),
    pure(
        "%SWEEP-OVERRIDES",
        "path",
        "What is set for draws right below a path: a list of (NAME VALUE).",
        &["(pw::%sweep-overrides \"home\") => NIL"],
        overrides,
    ),
    pure(
        "%NORMAL-DEVIATE",
        "unit &optional low high",
        "The standard normal deviate at that share of the distribution, or of its part between two deviates.",
        &["(pw::%normal-deviate 0.5d0) => 0.0d0"],
        deviate,
    ),
    pure(
        "%SWEEP-KNOWN",
        "name worlds goal",
        "Tells the command line of a sweep.",
        &[],
        known,
    ),
    control(
        "%SWEEP-SUMMARY",
        "name seed goal lines",
        "What the lines of a sweep say together, as text.",
        &[],
        host!(summary),
    ),
];

/// A number that is not negative.
fn index(value: &Value) -> Result<u64> {
    match value {
        Value::Int(number) => u64::try_from(*number).ok(),
        Value::Big(number) => u64::try_from(&**number).ok(),
        _ => None,
    }
    .ok_or_else(|| {
        Raise::simple(
            "A seed or the number of a world is an integer from 0 to 18446744073709551615.",
        )
    })
}

fn begin(host: &mut SimulationHost, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let (seed, world) = (index(&args[0])?, index(&args[1])?);
    let state = Sweeping::of(image);
    state.begin(seed, world);
    image.seed(state.bits("lisp"));
    let injection = std::rc::Rc::clone(&host.simulation.injection);
    injection.borrow_mut().begin(seed, world, state.off());
    host.simulation.restart_with(state.bits("simulation"));
    done(Value::NIL)
}

fn run_begins(host: &mut SimulationHost, image: &mut Image, _: &[Value]) -> Result<Reply> {
    Handlers::of(image).reset();
    Sweeping::of(image).enter(Stage::Running);
    host.simulation.begin_tally();
    host.person.timeline.set_off(true);
    done(Value::NIL)
}

fn run_ends(host: &mut SimulationHost, _: &mut Image, _: &[Value]) -> Result<Reply> {
    host.simulation.end_tally();
    done(Value::NIL)
}

fn begin_faults(host: &mut SimulationHost, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let seed = index(&args[0])?;
    let off = Sweeping::of(image).off();
    host.simulation.injection.borrow_mut().begin(seed, 0, off);
    host.simulation.begin_tally();
    done(Value::NIL)
}

fn end_faults(host: &mut SimulationHost, _: &mut Image, _: &[Value]) -> Result<Reply> {
    host.simulation.injection.borrow_mut().end();
    done(Value::NIL)
}

fn injected_faults(host: &mut SimulationHost, _: &mut Image, _: &[Value]) -> Result<Reply> {
    let struck = host.simulation.injection.borrow().struck();
    let struck = struck.into_iter().map(Value::string);
    done(Value::list(struck.collect::<Vec<_>>()))
}

fn inject_schedule(host: &mut SimulationHost, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let mut faults: Vec<Fault> = Vec::new();
    for item in args[0].iter_list() {
        let Some(fault) = item.as_text().and_then(|path| Fault::of_path(&path)) else {
            return Err(Raise::simple(format!(
                "{} is no fault of a schedule: a string such as \"inject.gripper-slip.BOTTLE.1\" was \
                 expected, as (injected-faults) returns them; errors of perception-noise cannot be repeated so.",
                print::to_string(image, &item, true)
            )));
        };
        // One fault for each kind and object, or each would count meetings.
        let same = |known: &&mut Fault| known.kind == fault.kind && known.of == fault.of;
        match faults.iter_mut().find(same) {
            Some(known) => known.at.extend(fault.at),
            None => faults.push(fault),
        }
    }
    let mut injection = host.simulation.injection.borrow_mut();
    faults.into_iter().for_each(|fault| injection.add(fault));
    done(Value::NIL)
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

fn inject(host: &mut SimulationHost, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = name_text(image, &args[0]).unwrap_or_default();
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
    let number_from = |at: usize, what: &str, most: f64| match &args[at] {
        value if !value.is_true() => Ok(None),
        value => match number::to_f64(value).filter(|number| (0.0..=most).contains(number)) {
            Some(number) => Ok(Some(number)),
            None => Err(Raise::simple(format!(
                "{} is no {what}: a number from 0 to {most} was expected.",
                print::to_string(image, value, true)
            ))),
        },
    };
    let of = match &args[4] {
        value if !value.is_true() => None,
        value => Some(name_text(image, value).ok_or_else(|| {
            Raise::simple("What a fault is :OF is the name of an object or of a type.")
        })?),
    };
    let fault = Fault {
        kind,
        probability: number_from(1, "probability", 1.0)?.unwrap_or(1.0),
        after: number_from(2, "time", 1e9)?,
        duration: number_from(3, "duration", 1e9)?,
        of,
        at: meetings(image, &args[5])?,
        position: number_from(6, "standard deviation of positions", 1.0)?.unwrap_or(0.0),
        yaw: number_from(7, "standard deviation of angles", 4.0)?.unwrap_or(0.0),
    };
    host.simulation.injection.borrow_mut().add(fault);
    done(Value::NIL)
}

fn restore_quietly(host: &mut SimulationHost, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = args[0].as_symbol().map(|sym| image.name(sym).to_owned());
    let name = name.unwrap_or_default();
    host.person
        .snapshots
        .restore_kept(&mut host.simulation, &name)?;
    done(Value::NIL)
}

fn text(value: &Value) -> Result<String> {
    value
        .as_text()
        .ok_or_else(|| Raise::simple("The path of a draw is a string."))
}

fn mute_output(image: &mut Image, args: &[Value]) -> Result<Value> {
    let before = image.output.mute(args[0].as_text());
    Ok(before.map_or(Value::NIL, |text| Value::string(&text)))
}

fn varying(image: &mut Image, args: &[Value]) -> Result<Value> {
    let flag = args.first().is_some_and(Value::is_true);
    let stage = if flag { Stage::Varying } else { Stage::SetUp };
    Sweeping::of(image).enter(stage);
    Ok(Value::NIL)
}

fn unit(image: &mut Image, args: &[Value]) -> Result<Value> {
    let path = text(&args[0])?;
    Ok(Value::Double(Sweeping::of(image).unit(&path)))
}

fn overriding(image: &mut Image, args: &[Value]) -> Result<Value> {
    let path = text(&args[0])?;
    let found = Sweeping::of(image).overriding(&path);
    Ok(found.map_or(Value::NIL, |value| Value::list([value])))
}

fn set(image: &mut Image, args: &[Value]) -> Result<Value> {
    let path = text(&args[0])?;
    Sweeping::of(image).set(&path, args[1].clone());
    Ok(Value::NIL)
}

fn forget(image: &mut Image, _: &[Value]) -> Result<Value> {
    Sweeping::of(image).forget();
    Ok(Value::NIL)
}

fn note(image: &mut Image, args: &[Value]) -> Result<Value> {
    let path = text(&args[0])?;
    let drawn = drawn(image, &args[1]);
    Sweeping::of(image).note(&path, drawn);
    if let Some(simplest) = args.get(2) {
        let simplest = self::drawn(image, simplest);
        Sweeping::of(image).note_simplest(&path, simplest);
    }
    Ok(Value::NIL)
}

fn kitchen(image: &mut Image, args: &[Value]) -> Result<Value> {
    let path = text(&args[0])?;
    let pairs = |list: &Value| {
        let pairs = list.iter_list().map(|pair| {
            let mut pair = pair.iter_list();
            let name = text(&pair.next().unwrap_or(Value::NIL))?;
            Ok((name, pair.next().unwrap_or(Value::NIL)))
        });
        pairs.collect::<Result<Vec<_>>>()
    };
    let simpler = pairs(&args[1])?.into_iter();
    let simpler = simpler.map(|(name, value)| (format!("{path}.{name}"), drawn(image, &value)));
    let simpler = simpler.collect();
    let settings = pairs(&args[2])?.into_iter();
    let settings = settings.map(|(name, value)| Ok((name, text(&value)?)));
    let settings = settings.collect::<Result<_>>()?;
    Sweeping::of(image).note_kitchen(simpler, settings);
    Ok(Value::NIL)
}

fn overrides(image: &mut Image, args: &[Value]) -> Result<Value> {
    let path = text(&args[0])?;
    let all = Sweeping::of(image).overrides(&path);
    let all = all
        .into_iter()
        .map(|(name, value)| Value::list([Value::string(&name), value]));
    Ok(Value::list(all.collect::<Vec<_>>()))
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

fn deviate(_: &mut Image, args: &[Value]) -> Result<Value> {
    let bound = |at: usize| args.get(at).and_then(number::to_f64);
    let unit = number::to_f64(&args[0]).unwrap_or(0.5);
    // The share of the distribution below a deviate.
    let below = |z: f64| 0.5 * libm::erfc(-z / std::f64::consts::SQRT_2);
    let low = bound(1).map_or(0.0, below);
    let high = bound(2).map_or(1.0, below);
    let share = (low + unit * (high - low)).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0);
    let deviate = normal_quantile(share);
    let least = bound(1).unwrap_or(f64::NEG_INFINITY);
    let most = bound(2).unwrap_or(f64::INFINITY);
    Ok(Value::Double(deviate.max(least).min(most)))
}

fn known(image: &mut Image, args: &[Value]) -> Result<Value> {
    let known = Known {
        name: text(&args[0])?,
        worlds: index(&args[1])?,
        goal: number::to_f64(&args[2]),
    };
    Sweeping::of(image).know(known);
    Ok(Value::NIL)
}

fn summary(host: &mut SimulationHost, _: &mut Image, args: &[Value]) -> Result<Reply> {
    let title = Title {
        name: text(&args[0])?,
        seed: index(&args[1])?,
        goal: number::to_f64(&args[2]),
    };
    let lines = args[3].iter_list().filter_map(|line| line.as_text());
    let records: Vec<Record> = lines
        .filter_map(|line| serde_json::from_str(&line).ok())
        .collect();
    let text = Summary::new(&title, &records).to_string();
    host.audience.swept = Some(Swept { title, records });
    done(Value::string(text))
}

fn record(host: &mut SimulationHost, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let state = Sweeping::of(image);
    let mut record = state.record(image, Ending::Success);
    let simulation = &host.simulation;
    for pair in args.chunks(2) {
        let [key, value] = pair else {
            continue;
        };
        let key = key.as_symbol().map(|sym| image.name(sym).to_owned());
        match key.as_deref() {
            Some("OUTCOME") => record.outcome = ending(image, value),
            Some("CLASS") => record.class = value.as_text().filter(|_| value.is_true()),
            Some("CAUSE") => match value {
                Value::Symbol(sym, ..) if image.is_keyword(*sym) => {
                    record.cause = simulation.failed_by();
                    record.bodies = simulation.bodies_of_failure();
                }
                _ => record.cause = value.as_text().filter(|_| value.is_true()),
            },
            Some("EXPECTATIONS") => {
                for answer in value.iter_list() {
                    let name = answer.car_or_nil().as_text().unwrap_or_default();
                    record
                        .expectations
                        .set(&name, answer.cdr_or_nil().is_true());
                }
            }
            Some("MEASURES") => {
                for answer in value.iter_list() {
                    let name = answer.car_or_nil().as_text().unwrap_or_default();
                    record
                        .measures
                        .set(&name, drawn(image, &answer.cdr_or_nil()));
                }
            }
            _ => {}
        }
    }
    simulation.complete(&mut record);
    excuse_lack_of_memory(image, &mut record);
    let line = record.line();
    state.keep(record);
    done(Value::string(line))
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
