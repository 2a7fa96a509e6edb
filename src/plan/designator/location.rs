//! Locations: poses that are given, generated or sampled, and checked by validators.
//!
//! Generators run in ascending order of priority; each returns a list of poses. A pose is a
//! solution if no validator rejects it. After a number of rejections in a row
//! (`*location-generator-max-retries*`) the search ends.

use super::check;
use super::failure;
use super::failure::Unresolved;
use super::object;
use super::reference::{same_description, solutions_of};
use super::value;
use super::value::{Class, Designator};
use crate::lisp::builtin::{Builtin, pure};
use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;
use crate::lisp::vm::calls::{Args, Calls};
use crate::plan::pose::value::as_placement;
use crate::plan::{Result, packages};

/// The variable with the generators: a list of `(priority function documentation enabled)`.
const GENERATORS: &str = "*LOCATION-GENERATORS*";
/// The variable with the validators, in the same form.
const VALIDATORS: &str = "*LOCATION-VALIDATION-FUNCTIONS*";
/// The variable with the number of rejections in a row that ends a search.
const MOST_RETRIES: &str = "*LOCATION-GENERATOR-MAX-RETRIES*";
/// Its initial value.
const RETRIES: i64 = 30;

/// Functions of package `CRAM-DESIGNATORS`.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "REGISTER-LOCATION-GENERATOR",
        "priority function &optional documentation",
        "Lets a function of a location designator, which returns a list of poses, resolve locations; low priorities come first.",
        &[],
        |image, args| register(image, GENERATORS, args),
    ),
    pure(
        "REGISTER-LOCATION-VALIDATION-FUNCTION",
        "priority function &optional documentation",
        "Lets a function of a location designator and a pose judge solutions: :ACCEPT, :MAYBE-REJECT, :UNKNOWN, or NIL to reject.",
        &[],
        |image, args| register(image, VALIDATORS, args),
    ),
    pure(
        "DELETE-LOCATION-GENERATOR-FUNCTION",
        "function",
        "Forgets a generator.",
        &["(desig:delete-location-generator-function 'no-such) => NIL"],
        |image, args| change(image, GENERATORS, &args[0], Change::Delete),
    ),
    pure(
        "ENABLE-LOCATION-GENERATOR-FUNCTION",
        "function",
        "Uses a generator again.",
        &[],
        |image, args| change(image, GENERATORS, &args[0], Change::Enable),
    ),
    pure(
        "DISABLE-LOCATION-GENERATOR-FUNCTION",
        "function",
        "Does not use a generator for the time being.",
        &[],
        |image, args| change(image, GENERATORS, &args[0], Change::Disable),
    ),
    pure(
        "DELETE-LOCATION-VALIDATION-FUNCTION",
        "function",
        "Forgets a validator.",
        &[],
        |image, args| change(image, VALIDATORS, &args[0], Change::Delete),
    ),
    pure(
        "ENABLE-LOCATION-VALIDATION-FUNCTION",
        "function",
        "Uses a validator again.",
        &[],
        |image, args| change(image, VALIDATORS, &args[0], Change::Enable),
    ),
    pure(
        "DISABLE-LOCATION-VALIDATION-FUNCTION",
        "function",
        "Does not use a validator for the time being.",
        &[],
        |image, args| change(image, VALIDATORS, &args[0], Change::Disable),
    ),
    pure(
        "LIST-LOCATION-GENERATOR-FUNCTIONS",
        "",
        "All generators: (priority function documentation enabled).",
        &[],
        |image, _| {
            let list = variable(image, GENERATORS);
            Ok(image.special(list).clone())
        },
    ),
];

enum Change {
    Delete,
    Enable,
    Disable,
}

/// Defines the variables.
pub(crate) fn define(image: &mut Image) {
    for name in [GENERATORS, VALIDATORS] {
        let sym = variable(image, name);
        image.define_special(sym, Value::NIL);
    }
    let sym = variable(image, MOST_RETRIES);
    image.define_special(sym, Value::Int(RETRIES));
}

/// A symbol of `CRAM-DESIGNATORS`.
fn variable(image: &mut Image, name: &str) -> Sym {
    packages::symbol(image, "CRAM-DESIGNATORS", name)
}

fn register(image: &mut Image, list: &str, args: &[Value]) -> Result<Value> {
    let Value::Int(priority) = args[0] else {
        return Err(Raise::type_error(&args[0], known::INTEGER));
    };
    let entry = Value::list([
        args[0].clone(),
        args[1].clone(),
        args.get(2).cloned().unwrap_or(Value::NIL),
        Value::T,
    ]);
    let list = variable(image, list);
    let mut entries: Vec<Value> = image
        .special(list)
        .iter_list()
        .filter(|e| !is_about(e, &args[1]))
        .collect();
    let place = entries
        .iter()
        .position(|e| matches!(e.car_or_nil(), Value::Int(p) if p > priority));
    entries.insert(place.unwrap_or(entries.len()), entry);
    image.set_special(list, Value::list(entries));
    Ok(args[1].clone())
}

fn is_about(entry: &Value, function: &Value) -> bool {
    entry.cdr_or_nil().car_or_nil().is_eql(function)
}

fn change(image: &mut Image, list: &str, function: &Value, change: Change) -> Result<Value> {
    let list = variable(image, list);
    let mut found = false;
    let mut entries = Vec::new();
    for entry in image.special(list).iter_list() {
        if !is_about(&entry, function) {
            entries.push(entry);
            continue;
        }
        found = true;
        let parts: Vec<Value> = entry.iter_list().take(3).collect();
        match change {
            Change::Delete => {}
            Change::Enable => entries.push(Value::list_with_tail(parts, Value::list([Value::T]))),
            Change::Disable => {
                entries.push(Value::list_with_tail(parts, Value::list([Value::NIL])));
            }
        }
    }
    image.set_special(list, Value::list(entries));
    Ok(Value::bool(found))
}

/// The enabled functions, in order of priority.
fn enabled(image: &mut Image, list: &str) -> Vec<Value> {
    let list = variable(image, list);
    image
        .special(list)
        .iter_list()
        .filter_map(|entry| {
            let parts = entry.list_to_vec()?;
            match parts.as_slice() {
                [_, function, _, enabled] if enabled.is_true() => Some(function.clone()),
                _ => None,
            }
        })
        .collect()
}

/// The result of a search.
enum Found {
    /// A pose.
    Pose(Value),
    /// Nothing, for this reason.
    Nothing(String),
}

/// Resolves a location to its pose.
pub(crate) async fn reference(calls: &Calls, designator: &Value) -> Result<Value> {
    match first_solution(calls, designator).await? {
        Found::Pose(pose) => Ok(pose),
        Found::Nothing(reason) => {
            let designator = designator.clone();
            let error = calls.with(move |machine| {
                let shown = print::to_string(machine.image, &designator, false);
                let text = format!("Unable to resolve designator `{shown}'");
                let why = Unresolved::new(reason);
                failure::designator_error(machine.image, &designator, &text, &why)
            });
            Err(error.await)
        }
    }
}

/// Like [`reference()`], but with a plan failure if there is no solution; its text is the message, if
/// there is one, instead of the reason.
pub(crate) async fn try_reference(
    calls: &Calls,
    designator: &Value,
    message: String,
) -> Result<Value> {
    match first_solution(calls, designator).await? {
        Found::Pose(pose) => Ok(pose),
        Found::Nothing(reason) => {
            let reason = if message.is_empty() { reason } else { message };
            let designator = designator.clone();
            let failure = calls.with(move |machine| {
                let why = Unresolved::new(reason);
                failure::reference_failure(machine.image, &designator, &why)
            });
            Err(failure.await)
        }
    }
}

/// The pose that a location was resolved to or specifies, or else the first one found.
async fn first_solution(calls: &Calls, designator: &Value) -> Result<Found> {
    let location = designator.clone();
    let known = calls.with(move |machine| known_pose(machine.image, &location));
    if let Some(pose) = known.await? {
        return Ok(Found::Pose(pose));
    }
    let functor = calls.with(|machine| variable(machine.image, "LOCATION-GROUNDING"));
    let grounded = solutions_of(calls, functor.await, None, designator).await?;
    let mut generators = calls
        .with(|machine| enabled(machine.image, GENERATORS))
        .await;
    generators.reverse();
    let mut samples: Vec<Value> = grounded.iter_list().collect();
    samples.reverse();
    let search = Search {
        designator: designator.clone(),
        owner: designator.clone(),
        samples,
        generators,
    };
    search.run(calls).await
}

/// The pose of a location, if no search is needed.
fn known_pose(image: &mut Image, designator: &Value) -> Result<Option<Value>> {
    let target = value::designator(image, designator)?;
    if let Some(data) = target.data.borrow().clone() {
        return Ok(Some(data));
    }
    check::check_inside(image, designator, 2)?;
    let pose = given_pose(image, target);
    if let Some(pose) = &pose {
        *target.data.borrow_mut() = Some(pose.clone());
        *target.solutions.borrow_mut() = Some(Value::NIL);
    }
    Ok(pose)
}

/// The pose that a location specifies, or that of the object whose location it is.
fn given_pose(image: &Image, target: &Designator) -> Option<Value> {
    if let Some(pose) = target.property_named(image, "POSE") {
        return Some(pose);
    }
    let object = value::current(&target.property_named(image, "OF")?);
    if let Some(pose) = object::pose_property(image, &object, "POSE-IN-MAP") {
        return Some(pose);
    }
    let at = value::as_class(&object, Class::Object)?.property_named(image, "AT")?;
    match value::as_class(&at, Class::Location) {
        Some(location) => location.property_named(image, "POSE"),
        None => as_placement(&at).map(|_| at.clone()),
    }
}

/// A search for solutions of one location.
struct Search {
    /// The designator that describes the location.
    designator: Value,
    /// The designator that receives the solution.
    owner: Value,
    /// Poses that were generated but not checked yet, the next one last.
    samples: Vec<Value>,
    /// Generators that have not run yet, the next one last.
    generators: Vec<Value>,
}

impl Search {
    /// Checks samples, running generators for more, until one is accepted.
    async fn run(mut self, calls: &Calls) -> Result<Found> {
        let mut rejections = 0;
        loop {
            let Some(sample) = self.samples.pop() else {
                let Some(generator) = self.generators.pop() else {
                    return Ok(Found::Nothing(reason(rejections)));
                };
                let poses = calls.call1(&generator, self.designator.clone()).await;
                self.samples = match &poses {
                    Value::Cons(_) => poses.iter_list().collect(),
                    Value::Symbol(known::NIL) => Vec::new(),
                    single => vec![single.clone()],
                };
                self.samples.reverse();
                continue;
            };
            if self.is_accepted(calls, &sample).await {
                self.settle(&sample);
                return Ok(Found::Pose(sample));
            }
            rejections += 1;
            if rejections >= calls.with(|machine| most_retries(machine.image)).await {
                return Ok(Found::Nothing(reason(rejections)));
            }
        }
    }

    /// Whether the validators accept a sample.
    async fn is_accepted(&self, calls: &Calls, sample: &Value) -> bool {
        let validators = calls.with(|machine| enabled(machine.image, VALIDATORS));
        let mut is_sure = false;
        let mut is_doubtful = false;
        for validator in validators.await {
            let args = Args::Two([self.designator.clone(), sample.clone()]);
            let answer = calls.call(&validator, args).await;
            let answer = calls.with(move |machine| {
                let sym = answer.as_symbol();
                sym.map(|sym| machine.image.name(sym).to_owned())
            });
            match answer.await.as_deref() {
                Some("ACCEPT") => is_sure = true,
                Some("MAYBE-REJECT") => is_doubtful = true,
                Some("UNKNOWN") => {}
                _ => return false,
            }
        }
        is_sure || !is_doubtful
    }

    /// Makes a sample the value of the owner, and keeps what has not been checked.
    fn settle(self, sample: &Value) {
        if let Some(target) = value::as_designator(&self.owner) {
            *target.data.borrow_mut() = Some(sample.clone());
            let rest = Value::cons(Value::list(self.samples), Value::list(self.generators));
            *target.solutions.borrow_mut() = Some(rest);
        }
    }
}

/// The number of rejections in a row that ends a search.
fn most_retries(image: &mut Image) -> i64 {
    let most = variable(image, MOST_RETRIES);
    match image.special(most) {
        Value::Int(most) => *most,
        _ => RETRIES,
    }
}

/// Why a search has found nothing.
fn reason(rejections: i64) -> String {
    match rejections {
        0 => "Nothing generates such a location: write (a location (pose ?pose)).".to_owned(),
        1 => "1 candidate was rejected.".to_owned(),
        n => format!("{n} candidates were rejected."),
    }
}

/// The next solution, as a designator equated with this one; `NIL` if there is none.
pub(crate) async fn next_solution(calls: &Calls, designator: &Value) -> Result<Value> {
    if let Found::Nothing(_) = first_solution(calls, designator).await? {
        return Ok(Value::NIL);
    }
    let Some(target) = value::as_designator(designator) else {
        return Ok(Value::NIL);
    };
    if let Some(next) = target.successor.borrow().clone() {
        return Ok(next);
    }
    let rest = target.solutions.borrow().clone().unwrap_or(Value::NIL);
    let location = designator.clone();
    let owner = calls.with(move |machine| {
        let target = value::designator(machine.image, &location)?;
        Ok::<_, Box<Raise>>(same_description(machine.image, target))
    });
    let owner = owner.await?;
    let search = Search {
        designator: designator.clone(),
        owner: owner.clone(),
        // Both are kept in reverse order.
        samples: rest.car_or_nil().iter_list().collect(),
        generators: rest.cdr_or_nil().iter_list().collect(),
    };
    Ok(match search.run(calls).await? {
        Found::Pose(_) => {
            value::equate(designator, &owner);
            owner
        }
        Found::Nothing(_) => Value::NIL,
    })
}
