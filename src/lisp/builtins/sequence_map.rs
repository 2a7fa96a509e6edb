//! Functions over the elements of sequences: `map`, `map-into`, `every`, `some`, `notany`,
//! `notevery`, `reduce`.

use super::criterion::Key;
use super::settled_types::sequence_type;
use crate::builtin::Builtin;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::{Bounds, Sequence, Walk};
use crate::vm::callable::callable;
use crate::vm::calls::{Args, Calls, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Several sequences walked side by side.
struct Side(Vec<Walk>);

impl Side {
    fn new(sequences: &[Value]) -> Result<Side> {
        let walks: Result<Vec<Walk>> = sequences
            .iter()
            .map(|s| Ok(Sequence::of(s)?.walk(Bounds::ALL)))
            .collect();
        walks.map(Side)
    }

    /// The next element of each, or none when one is at its end.
    fn next(&mut self) -> Result<Option<Args>> {
        if let [walk] = self.0.as_mut_slice() {
            return Ok(walk.next()?.map(|item| Args::One([item])));
        }
        let mut args = Vec::with_capacity(self.0.len());
        for walk in &mut self.0 {
            match walk.next()? {
                Some(item) => args.push(item),
                None => return Ok(None),
            }
        }
        Ok(Some(Args::Many(args)))
    }
}

/// A sequence of the results of a function for the elements of sequences; `NIL` as type collects
/// nothing.
///
/// `(map 'vector #'1+ '(1 2 3))` => `#(2 3 4)`
/// `(map 'list #'+ #(1 2) '(10 20))` => `(11 22)`
#[builtin(_, "result-type function sequence &rest sequences")]
fn map(
    machine: &mut Machine<'_>,
    result_type: &Value,
    function: &Value,
    sequences: &[Value],
) -> Result<Step> {
    let result = match result_type {
        Value::Symbol(known::NIL, ..) => None,
        specifier => Some(sequence_type(machine.image, specifier)?),
    };
    let function = callable(machine.image, function)?;
    let mut side = Side::new(sequences)?;
    run(machine, "MAP", |calls| async move {
        let mut items = Vec::new();
        while let Some(args) = side.next()? {
            let value = calls.call(&function, args).await;
            if result.is_some() {
                items.push(value);
            }
        }
        match result {
            Some(result) => result.make(items),
            None => Ok(Value::NIL),
        }
    })
}

/// Writes the results of a function for the elements of sequences into a sequence.
///
/// `(map-into (list 0 0) #'+ '(1 2) '(10 20))` => `(11 22)`
#[builtin]
fn map_into(
    machine: &mut Machine<'_>,
    target: Sequence,
    function: &Value,
    sequences: &[Value],
) -> Result<Step> {
    let function = callable(machine.image, function)?;
    let mut side = Side::new(sequences)?;
    // A vector with a fill pointer is filled up to its full size.
    let room = match &target {
        Sequence::Vector(vector) => vector.items.len(),
        Sequence::Str(string) => string.capacity(),
        other => other.len()?,
    };
    run(machine, "MAP-INTO", |calls| async move {
        let mut items = Vec::new();
        while items.len() < room
            && let Some(args) = side.next()?
        {
            items.push(calls.call(&function, args).await);
        }
        if let Sequence::Vector(vector) = &target
            && vector.fill_pointer.get().is_some()
        {
            vector.fill_pointer.set(Some(items.len()));
        }
        let count = items.len();
        if let Sequence::Str(string) = &target {
            if string.has_fill_pointer.get() {
                string.set_fill_pointer(count);
            }
            items.extend(target.items(Bounds {
                start: count,
                end: None,
            })?);
        }
        target.set_all(&items)?;
        Ok(target.value())
    })
}

/// When a walk over elements is decided, and its result.
#[derive(Clone, Copy)]
enum Quantifier {
    Every,
    Some,
    NotAny,
    NotEvery,
}

async fn quantified(
    calls: Calls,
    function: Value,
    mut side: Side,
    quantifier: Quantifier,
) -> Result<Value> {
    while let Some(args) = side.next()? {
        let value = calls.call(&function, args).await;
        match quantifier {
            Quantifier::Every if value.is_nil() => return Ok(Value::NIL),
            Quantifier::NotEvery if value.is_nil() => return Ok(Value::T),
            Quantifier::Some if value.is_true() => return Ok(value),
            Quantifier::NotAny if value.is_true() => return Ok(Value::NIL),
            _ => {}
        }
    }
    Ok(Value::bool(matches!(
        quantifier,
        Quantifier::Every | Quantifier::NotAny
    )))
}

fn quantify(
    machine: &mut Machine<'_>,
    predicate: &Value,
    sequences: &[Value],
    name: &'static str,
    quantifier: Quantifier,
) -> Result<Step> {
    let function = callable(machine.image, predicate)?;
    let side = Side::new(sequences)?;
    run(machine, name, |calls| {
        quantified(calls, function, side, quantifier)
    })
}

/// Do all elements satisfy a predicate?
///
/// `(every #'evenp '(2 4))` => `T`
#[builtin(_, "predicate sequence &rest sequences")]
fn every(machine: &mut Machine<'_>, predicate: &Value, sequences: &[Value]) -> Result<Step> {
    quantify(machine, predicate, sequences, "EVERY", Quantifier::Every)
}

/// The first true result of a predicate for the elements, or `NIL`.
///
/// `(some #'evenp '(1 2))` => `T`
#[builtin(_, "predicate sequence &rest sequences")]
fn some(machine: &mut Machine<'_>, predicate: &Value, sequences: &[Value]) -> Result<Step> {
    quantify(machine, predicate, sequences, "SOME", Quantifier::Some)
}

/// Does no element satisfy a predicate?
///
/// `(notany #'evenp '(1 3))` => `T`
#[builtin(_, "predicate sequence &rest sequences")]
fn notany(machine: &mut Machine<'_>, predicate: &Value, sequences: &[Value]) -> Result<Step> {
    quantify(machine, predicate, sequences, "NOTANY", Quantifier::NotAny)
}

/// Is there an element that does not satisfy a predicate?
///
/// `(notevery #'evenp '(2 3))` => `T`
#[builtin(_, "predicate sequence &rest sequences")]
fn notevery(machine: &mut Machine<'_>, predicate: &Value, sequences: &[Value]) -> Result<Step> {
    quantify(
        machine,
        predicate,
        sequences,
        "NOTEVERY",
        Quantifier::NotEvery,
    )
}

/// Combines the elements of a sequence two by two.
///
/// `(reduce #'+ '(1 2 3 4))` => `10`
/// `(reduce #'list '(1 2 3) :from-end t)` => `(1 (2 3))`
#[builtin]
fn reduce(
    machine: &mut Machine<'_>,
    function: Value,
    sequence: Sequence,
    #[key] key: Option<Value>,
    #[key] from_end: Option<Value>,
    #[key] start: Option<Value>,
    #[key] end: Option<Value>,
    #[key] initial_value: Option<Value>,
) -> Result<Step> {
    let image = &machine.image;
    let function = callable(image, &function)?;
    let key = Key::new(image, key)?;
    let bounds = Bounds::new(&sequence, start.as_ref(), end.as_ref())?;
    let from_end = from_end.is_some_and(|v| v.is_true());
    run(machine, "REDUCE", |calls| async move {
        let mut result = initial_value;
        if from_end {
            for item in sequence.items(bounds)?.into_iter().rev() {
                let item = key.of(&calls, item).await;
                result = Some(match result {
                    Some(value) => calls.call2(&function, item, value).await,
                    None => item,
                });
            }
        } else {
            let mut walk = sequence.walk(bounds);
            while let Some(item) = walk.next()? {
                let item = key.of(&calls, item).await;
                result = Some(match result {
                    Some(value) => calls.call2(&function, value, item).await,
                    None => item,
                });
            }
        }
        match result {
            Some(value) => Ok(value),
            None => Ok(calls.call(&function, Args::Many(Vec::new())).await),
        }
    })
}

/// Functions over the elements of sequences.
pub(crate) static TABLE: &[Builtin] =
    builtins![map, map_into, every, some, notany, notevery, reduce,];
