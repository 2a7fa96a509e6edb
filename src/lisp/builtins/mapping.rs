//! The functions that map over lists: `mapcar`, `mapc`, `mapcan`, `maplist`, `mapl`,
//! `mapcon`.

use super::lists::nconc_all;
use crate::builtin::Builtin;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::ListBuilder;
use crate::vm::callable::callable;
use crate::vm::calls::{Args, Calls, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// What a mapping function passes on, and what it makes of the results.
#[derive(Clone, Copy)]
struct Mode {
    /// Call with the tails of the lists instead of their elements.
    tails: bool,
    collect: Collect,
}

#[derive(Clone, Copy)]
enum Collect {
    /// A list of the results.
    List,
    /// The results joined.
    Joined,
    /// Nothing; the first list is returned.
    Nothing,
}

/// The next arguments, or none when a list is at its end.
fn next_args(lists: &mut [Value], tails: bool) -> Result<Option<Args>> {
    match lists {
        [list] => Ok(step(list, tails)?.map(|a| Args::One([a]))),
        [first, second] => {
            let (a, b) = (step(first, tails)?, step(second, tails)?);
            Ok(a.zip(b).map(|(a, b)| Args::Two([a, b])))
        }
        _ => {
            let mut args = Vec::with_capacity(lists.len());
            for list in lists {
                match step(list, tails)? {
                    Some(arg) => args.push(arg),
                    None => return Ok(None),
                }
            }
            Ok(Some(Args::Many(args)))
        }
    }
}

/// Takes the first element of a list, or the whole list, and advances to its rest.
fn step(list: &mut Value, tails: bool) -> Result<Option<Value>> {
    let (item, rest) = match &*list {
        Value::Cons(cons) if tails => (list.clone(), cons.cdr()),
        Value::Cons(cons) => (cons.car(), cons.cdr()),
        Value::Symbol(known::NIL, ..) => return Ok(None),
        other => return Err(Raise::type_error(other, known::LIST)),
    };
    *list = rest;
    Ok(Some(item))
}

async fn map(calls: Calls, function: Value, mut lists: Vec<Value>, mode: Mode) -> Result<Value> {
    let first = lists.first().cloned().unwrap_or(Value::NIL);
    let mut results = ListBuilder::new();
    let mut parts = Vec::new();
    while let Some(args) = next_args(&mut lists, mode.tails)? {
        let result = calls.call(&function, args).await;
        match mode.collect {
            Collect::List => results.push(result),
            Collect::Joined if result.is_nil() => {}
            Collect::Joined => parts.push(result),
            Collect::Nothing => {}
        }
    }
    match mode.collect {
        Collect::List => Ok(results.finish()),
        Collect::Joined => nconc_all(&parts),
        Collect::Nothing => Ok(first),
    }
}

fn mapping(
    machine: &mut Machine<'_>,
    function: &Value,
    lists: Vec<Value>,
    name: &'static str,
    tails: bool,
    collect: Collect,
) -> Result<Step> {
    let function = callable(machine.image, function)?;
    let mode = Mode { tails, collect };
    run(machine, name, |calls| map(calls, function, lists, mode))
}

/// The results of a function for the elements of one or more lists, up to the end of the shortest.
///
/// `(mapcar #'1+ '(1 2 3))` => `(2 3 4)`
/// `(mapcar #'+ '(1 2 3) '(10 20))` => `(11 22)`
#[builtin(_, "function list &rest lists")]
fn mapcar(machine: &mut Machine<'_>, function: &Value, lists: Vec<Value>) -> Result<Step> {
    mapping(machine, function, lists, "MAPCAR", false, Collect::List)
}

/// Calls a function for the elements of lists; returns the first list.
///
/// `(mapc #'identity '(1 2))` => `(1 2)`
#[builtin(_, "function list &rest lists")]
fn mapc(machine: &mut Machine<'_>, function: &Value, lists: Vec<Value>) -> Result<Step> {
    mapping(machine, function, lists, "MAPC", false, Collect::Nothing)
}

/// Like `mapcar`, but joins the results, which must be fresh lists.
///
/// `(mapcan #'list '(1 2) '(a b))` => `(1 A 2 B)`
#[builtin(_, "function list &rest lists")]
fn mapcan(machine: &mut Machine<'_>, function: &Value, lists: Vec<Value>) -> Result<Step> {
    mapping(machine, function, lists, "MAPCAN", false, Collect::Joined)
}

/// Like `mapcar`, but hands out the list, its rest, and so on.
///
/// `(maplist #'length '(a b c))` => `(3 2 1)`
#[builtin(_, "function list &rest lists")]
fn maplist(machine: &mut Machine<'_>, function: &Value, lists: Vec<Value>) -> Result<Step> {
    mapping(machine, function, lists, "MAPLIST", true, Collect::List)
}

/// Calls a function for a list, its rest, and so on; returns the list.
///
/// `(mapl #'identity '(1 2))` => `(1 2)`
#[builtin(_, "function list &rest lists")]
fn mapl(machine: &mut Machine<'_>, function: &Value, lists: Vec<Value>) -> Result<Step> {
    mapping(machine, function, lists, "MAPL", true, Collect::Nothing)
}

/// Like `maplist`, but joins the results, which must be fresh lists.
///
/// `(mapcon #'list '(1 2))` => `((1 2) (2))`
#[builtin(_, "function list &rest lists")]
fn mapcon(machine: &mut Machine<'_>, function: &Value, lists: Vec<Value>) -> Result<Step> {
    mapping(machine, function, lists, "MAPCON", true, Collect::Joined)
}

/// Mapping over lists.
pub(crate) static TABLE: &[Builtin] = builtins![mapcar, mapc, mapcan, maplist, mapl, mapcon,];
