//! Functions for use at the prompt: help, the list of actions, tasks, time, and
//! inspecting values.

use std::sync::Arc;

use crate::host::SimulationHost;
use crate::host::parts::{View, in_world};
use crate::outside::Outside;
use crate::simulation::Simulation;
use crate::simulation::names::{name_text, type_text};
use cram::designator::schema;
use cram::designator::value::Class;
use cram::{Plan, tell_overview};
use lisp::builtin::{Builtin, Operator};
use lisp::builtins::help::{Topic, Topics, of_symbol};
use lisp::image::Image;
use lisp::stream;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::package::PackageTable;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;
use lisp::vm::calls::run;
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;
use robotics::world::Models;
use spatial::Shortest;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = builtins![help, describe_topic, list_actions, tasks, inspect];

/// The function behind `time`, in package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![call_with_timing];

/// Calls a function and reports how long it took, in real and in simulated time.
#[builtin]
fn call_with_timing(machine: &mut Machine<'_>, function: Value) -> Result<Step> {
    let plan = Plan::of(machine.image);
    let outside = machine.image.extension::<Outside>().unwrap_or_default();
    let clock = Arc::clone(&outside.clock);
    let (begin, now) = (clock.now(), plan.now());
    run(machine, "TIME", |calls| async move {
        let values = calls.call_for_values(&function, Vec::new()).await;
        let simulated = plan.now() - now;
        let real = clock.now().saturating_sub(begin).as_secs_f64();
        let text = format!("; {simulated:.3} s simulated, {real:.3} s real");
        calls
            .with(move |machine| trace(machine.image, &text))
            .await?;
        Ok(values)
    })
}

/// Macros of package `PLANWRIGHT`.
pub(crate) static OPERATORS: &[Operator] = &[Operator {
    name: "DOC",
    lambda_list: "name",
    doc: "Tells what is known about a name, which need not be quoted. At the prompt, ?name is short for it.",
    examples: &[],
    expand: Some(expand_doc),
}];

fn expand_doc(image: &mut Image, form: &Value) -> Result<Value> {
    let name = form.cdr_or_nil().car_or_nil();
    let quoted = match &name {
        Value::Cons(cons) if cons.car().as_symbol() == Some(known::QUOTE) => name.clone(),
        _ => Value::list([known::QUOTE.into(), name]),
    };
    let package = image.packages.find("PLANWRIGHT");
    let topic = image.intern(package.unwrap_or(PackageTable::USER), "DESCRIBE-TOPIC");
    Ok(Value::list([topic.into(), quoted]))
}

/// Writes a line to `*trace-output*`.
fn trace(image: &mut Image, line: &str) -> Result<()> {
    let output = image.special(known::V_TRACE_OUTPUT).clone();
    stream::fresh_line(image, &output)?;
    stream::write(image, &output, &format!("{line}\n"))
}

fn say(image: &mut Image, text: &str) {
    image.output.fresh_line();
    image.output.write(text);
    if !text.ends_with('\n') {
        image.output.write("\n");
    }
}

/// No values.
fn nothing() -> Value {
    Value::values(Vec::new())
}

/// Gives an overview of the functions and of how to find out more.
#[builtin]
fn help(_: &mut Simulation, image: &mut Image) -> Value {
    say(image, include_str!("help.txt"));
    nothing()
}

/// Tells the types of actions that a plan can perform, with the keys that each takes.
#[builtin]
fn list_actions(_: &mut Simulation, image: &mut Image) -> Value {
    let rows = schema::all(image, Class::Action);
    let text: String = rows.iter().map(|row| row_text(row)).collect();
    say(image, &text);
    nothing()
}

/// Shows the tasks that are alive, and those of the last plan that have ended, as a tree with their status.
#[builtin]
fn tasks(machine: &mut Machine<'_>) -> Result<Step> {
    tell_overview(machine)
}

/// Makes known what names mean to the robot: actions, motions and types of objects.
pub(crate) fn install_topics(image: &mut Image, models: Arc<Models>) {
    let topics = move |image: &Image, sym: Sym| {
        let name = image.name(sym);
        let mut topics = Vec::new();
        for (class, kind) in [(Class::Action, "action"), (Class::Motion, "motion")] {
            let rows = schema::rows(image, class, name);
            topics.extend(rows.iter().map(|row| Topic {
                kind,
                text: row_text(row) + &keys_text(row),
            }));
        }
        if let Some(object) = models.objects.get(&name.to_lowercase()) {
            topics.push(Topic {
                kind: "type of objects",
                text: format!(
                    "A type of objects: {} kg, {}\n",
                    object.mass,
                    size_text(&object.size())
                ),
            });
        }
        topics
    };
    image.extend(Topics(Box::new(topics)));
}

/// Edge lengths (m) for people.
fn size_text(size: &[f64; 3]) -> String {
    let [x, y, z] = size.map(|edge| Shortest((edge * 1e3).round() / 10.0));
    format!("{x} x {y} x {z} cm")
}

/// An action or motion with its keys.
fn row_text(row: &schema::TypeRow) -> String {
    format!("{}\n    {}\n", row.shape(), row.doc)
}

/// What the keys of an action or motion mean, and an example.
fn keys_text(row: &schema::TypeRow) -> String {
    let mut text = String::new();
    for key in &row.keys {
        let mark = if key.is_required { ", needed" } else { "" };
        let name = key.name.to_lowercase();
        text.push_str(&format!("      {name}: {}{mark}\n", key.doc));
    }
    if let Some(example) = &row.example {
        text.push_str(&format!("    For example {example}\n"));
    }
    text
}

/// Tells what is known about a name: as a function, a variable, an action, a type of objects, an object in
/// the world. The function behind DOC.
#[builtin]
fn describe_topic(host: &mut SimulationHost, image: &mut Image, name: &Value) -> Result<Value> {
    let Some(word) = name_text(image, name) else {
        return Err(Raise::type_error(name, known::SYMBOL));
    };
    let mut text = String::new();
    if let Value::Symbol(sym, ..) = name {
        let told = of_symbol(image, *sym);
        // A symbol without a meaning of its own may still name one of the following.
        if told.lines().count() > 1 {
            text.push_str(&told);
        }
    }
    for class in [Class::Action, Class::Motion] {
        for row in schema::rows(image, class, &word) {
            text.push_str(&row_text(&row));
            text.push_str(&keys_text(&row));
        }
    }
    if let Some(kind) = type_text(image, name)
        && let Some(object) = host.simulation.models.objects.get(&kind)
    {
        let grasps = host
            .simulation
            .grasps
            .grasps(&kind)
            .join(", ")
            .to_lowercase();
        text.push_str(&format!(
            "A type of objects: {} kg, {}, grasps: {}\n",
            object.mass,
            size_text(&object.size()),
            if grasps.is_empty() { "none" } else { &grasps }
        ));
    }
    if let Some(view) = in_world(host, image, name) {
        text.push_str(&format!("An object in the world:\n{}", view.text(image)));
    }
    if text.is_empty() {
        text = format!(
            "Nothing is known about {word}; (apropos \"{}\") looks for names.\n",
            word.to_lowercase()
        );
    }
    say(image, &text);
    Ok(nothing())
}

/// Shows the parts of a value, numbered. In a terminal a number then goes into a part, b goes back, q ends.
/// 'NAME is an object in the world, :ROBOT the robot.
#[builtin]
fn inspect(host: &mut SimulationHost, image: &mut Image, object: &Value) -> Value {
    let text = View::of(host, image, object).text(image);
    say(image, &text);
    host.person.inspected = Some(object.clone());
    nothing()
}
