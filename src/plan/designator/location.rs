//! Locations: poses that are given, generated or sampled, and checked by validators.
//!
//! Generators run in order of ascending priority; each gives a list of poses. A pose is a
//! solution if no validator rejects it. After so many rejections in a row
//! (`*location-generator-max-retries*`) the search ends.

use super::check;
use super::continuation::{Next, Result, call};
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
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;
use crate::plan::packages;
use crate::plan::pose::value::as_placement;

/// Where generators are kept: a list of `(priority function documentation enabled)`.
const GENERATORS: &str = "*LOCATION-GENERATORS*";
/// Where validators are kept, in the same way.
const VALIDATORS: &str = "*LOCATION-VALIDATION-FUNCTIONS*";
/// The variable that says how many rejections in a row end a search.
const MOST_RETRIES: &str = "*LOCATION-GENERATOR-MAX-RETRIES*";
/// Its value at the start.
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

/// The functions that are enabled, in order of priority.
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

/// A search for solutions of one location.
struct Search {
    /// The description.
    designator: Value,
    /// The designator that gets the solution.
    owner: Value,
    /// Poses that were generated and not looked at.
    samples: Vec<Value>,
    /// Generators that have not run.
    generators: Vec<Value>,
    rejections: i64,
    next: Next,
    missing: Missing,
}

/// What a search that finds nothing ends in.
enum Missing {
    /// An error of the designator.
    Error,
    /// A plan failure with a text.
    Failure(String),
    /// `NIL`.
    Nil,
}

/// Resolves a location and goes on with its pose.
pub(crate) fn reference(machine: &mut Machine<'_>, designator: &Value, next: Next) -> Result<Step> {
    first_solution(machine, designator, next, Missing::Error)
}

/// The same, with a plan failure if there is no solution.
pub(crate) fn try_reference(
    machine: &mut Machine<'_>,
    designator: &Value,
    message: String,
    next: Next,
) -> Result<Step> {
    first_solution(machine, designator, next, Missing::Failure(message))
}

fn first_solution(
    machine: &mut Machine<'_>,
    designator: &Value,
    next: Next,
    missing: Missing,
) -> Result<Step> {
    let target = value::designator(machine.image, designator)?;
    if let Some(data) = target.data.borrow().clone() {
        return next(machine, data);
    }
    check::check_inside(machine.image, designator, 2)?;
    if let Some(pose) = given_pose(machine.image, target) {
        *target.data.borrow_mut() = Some(pose.clone());
        *target.solutions.borrow_mut() = Some(Value::NIL);
        return next(machine, pose);
    }
    let designator = designator.clone();
    let functor = variable(machine.image, "LOCATION-GROUNDING");
    solutions_of(
        machine,
        functor,
        None,
        &designator.clone(),
        Box::new(move |machine, grounded| {
            let mut generators = enabled(machine.image, GENERATORS);
            generators.reverse();
            let mut samples: Vec<Value> = grounded.iter_list().collect();
            samples.reverse();
            let search = Search {
                owner: designator.clone(),
                designator,
                samples,
                generators,
                rejections: 0,
                next,
                missing,
            };
            search.go_on(machine)
        }),
    )
}

/// The pose that a location says itself, or that of the object it is the location of.
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

impl Search {
    /// Looks at the next sample, or asks the next generator for some.
    fn go_on(mut self, machine: &mut Machine<'_>) -> Result<Step> {
        if let Some(sample) = self.samples.pop() {
            let mut validators = enabled(machine.image, VALIDATORS);
            validators.reverse();
            return self.validate(machine, sample, validators, Verdict::default());
        }
        let Some(generator) = self.generators.pop() else {
            return self.end(machine);
        };
        let args = vec![self.designator.clone()];
        Ok(call(
            generator,
            args,
            "REFERENCE",
            Box::new(move |machine, poses| {
                self.samples = match &poses {
                    Value::Cons(_) => poses.iter_list().collect(),
                    Value::Symbol(known::NIL) => Vec::new(),
                    single => vec![single.clone()],
                };
                self.samples.reverse();
                self.go_on(machine)
            }),
        ))
    }

    /// Asks the validators that are left about a sample.
    fn validate(
        self,
        machine: &mut Machine<'_>,
        sample: Value,
        mut validators: Vec<Value>,
        verdict: Verdict,
    ) -> Result<Step> {
        let Some(validator) = validators.pop() else {
            if verdict.is_rejected() {
                return self.reject(machine);
            }
            return self.accept(machine, sample);
        };
        let args = vec![self.designator.clone(), sample.clone()];
        Ok(call(
            validator,
            args,
            "REFERENCE",
            Box::new(move |machine, answer| {
                let mut verdict = verdict;
                let answer = answer.as_symbol().map(|s| machine.image.name(s));
                match answer {
                    Some("ACCEPT") => verdict.accepted = true,
                    Some("MAYBE-REJECT") => verdict.maybe_rejected = true,
                    Some("UNKNOWN") => {}
                    _ => return self.reject(machine),
                }
                self.validate(machine, sample, validators, verdict)
            }),
        ))
    }

    fn reject(mut self, machine: &mut Machine<'_>) -> Result<Step> {
        self.rejections += 1;
        let most = variable(machine.image, MOST_RETRIES);
        let most = match machine.image.special(most) {
            Value::Int(most) => *most,
            _ => RETRIES,
        };
        if self.rejections >= most {
            return self.end(machine);
        }
        self.go_on(machine)
    }

    fn accept(self, machine: &mut Machine<'_>, sample: Value) -> Result<Step> {
        let target = value::designator(machine.image, &self.owner)?;
        *target.data.borrow_mut() = Some(sample.clone());
        let rest = Value::cons(Value::list(self.samples), Value::list(self.generators));
        *target.solutions.borrow_mut() = Some(rest);
        (self.next)(machine, sample)
    }

    fn end(self, machine: &mut Machine<'_>) -> Result<Step> {
        let image = &mut *machine.image;
        let reason = match self.rejections {
            0 => "Nothing generates such a location: write (a location (pose ?pose)).".to_owned(),
            n => format!(
                "{n} candidate{} rejected.",
                if n == 1 { " was" } else { "s were" }
            ),
        };
        match self.missing {
            Missing::Nil => Ok(Step::Return(Value::NIL)),
            Missing::Failure(message) => {
                let reason = if message.is_empty() { reason } else { message };
                let why = Unresolved::new(reason);
                Err(failure::reference_failure(image, &self.designator, &why))
            }
            Missing::Error => {
                let shown = print::to_string(image, &self.designator, false);
                let text = format!("Unable to resolve designator `{shown}'");
                let why = Unresolved::new(reason);
                Err(failure::designator_error(
                    image,
                    &self.designator,
                    &text,
                    &why,
                ))
            }
        }
    }
}

/// What the validators said of a sample so far.
#[derive(Clone, Copy, Default)]
struct Verdict {
    accepted: bool,
    maybe_rejected: bool,
}

impl Verdict {
    fn is_rejected(self) -> bool {
        self.maybe_rejected && !self.accepted
    }
}

/// The next solution, as a designator that is equated with this one; `NIL` if there is none.
pub(crate) fn next_solution(machine: &mut Machine<'_>, designator: &Value) -> Result<Step> {
    let designator = designator.clone();
    first_solution(
        machine,
        &designator.clone(),
        Box::new(move |machine, _| {
            let target = value::designator(machine.image, &designator)?;
            if let Some(next) = target.successor.borrow().clone() {
                return Ok(Step::Return(next));
            }
            let rest = target.solutions.borrow().clone().unwrap_or(Value::NIL);
            let owner = same_description(machine.image, target);
            let search = Search {
                designator: designator.clone(),
                owner: owner.clone(),
                // Both are kept in reverse.
                samples: rest.car_or_nil().iter_list().collect(),
                generators: rest.cdr_or_nil().iter_list().collect(),
                rejections: 0,
                next: Box::new(move |_, _| {
                    value::equate(&designator, &owner);
                    Ok(Step::Return(owner))
                }),
                missing: Missing::Nil,
            };
            search.go_on(machine)
        }),
        Missing::Nil,
    )
}
