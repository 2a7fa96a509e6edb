//! Searching in lists and association lists: `member`, `assoc`, `rassoc`, `pairlis`.

use super::criterion::{Criterion, Key, Test};
use super::keywords;
use crate::lisp::builtin::{Builtin, control, pure};
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::sequence::ListWalk;
use crate::lisp::vm::calls::{Calls, run};
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;

type Outcome = Result<Value, Box<Raise>>;

/// What is looked for in a list.
#[derive(Clone, Copy)]
enum Goal {
    /// An element; the result is the list from there.
    Tail,
    /// An entry by its car.
    ByCar,
    /// An entry by its cdr.
    ByCdr,
}

async fn search(calls: Calls, criterion: Criterion, list: Value, goal: Goal) -> Outcome {
    let mut walk = ListWalk::new(list);
    while let Some(cons) = walk.next_cons()? {
        let element = cons.car();
        let looked_at = match (goal, &element) {
            (Goal::Tail, _) => element.clone(),
            (_, Value::Symbol(known::NIL)) => continue,
            (Goal::ByCar, Value::Cons(entry)) => entry.car(),
            (Goal::ByCdr, Value::Cons(entry)) => entry.cdr(),
            (_, other) => return Err(Raise::type_error(other, known::LIST)),
        };
        if criterion.accepts(&calls, &looked_at).await {
            return Ok(match goal {
                Goal::Tail => Value::Cons(cons),
                Goal::ByCar | Goal::ByCdr => element,
            });
        }
    }
    Ok(Value::NIL)
}

/// The criterion of a function with the arguments item, list, `:key`, `:test`, `:test-not`.
fn item_criterion(image: &Image, args: &[Value]) -> Result<Criterion, Box<Raise>> {
    let [key, test, test_not] = keywords::parse(
        image,
        &args[2..],
        [known::K_KEY, known::K_TEST, known::K_TEST_NOT],
    )?;
    Ok(Criterion::item(
        args[0].clone(),
        Test::new(image, test, test_not)?,
        Key::new(image, key)?,
    ))
}

/// The criterion of a function with the arguments predicate, list, `:key`.
fn predicate_criterion(
    image: &Image,
    args: &[Value],
    expected: bool,
) -> Result<Criterion, Box<Raise>> {
    let [key] = keywords::parse(image, &args[2..], [known::K_KEY])?;
    Criterion::predicate(image, &args[0], expected, Key::new(image, key)?)
}

fn by_item(
    machine: &mut Machine<'_>,
    args: &[Value],
    name: &'static str,
    goal: Goal,
) -> Result<Step, Box<Raise>> {
    let criterion = item_criterion(machine.image, args)?;
    let list = args[1].clone();
    run(machine, name, |calls| search(calls, criterion, list, goal))
}

fn by_predicate(
    machine: &mut Machine<'_>,
    args: &[Value],
    name: &'static str,
    expected: bool,
    goal: Goal,
) -> Result<Step, Box<Raise>> {
    let criterion = predicate_criterion(machine.image, args, expected)?;
    let list = args[1].clone();
    run(machine, name, |calls| search(calls, criterion, list, goal))
}

fn member(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    by_item(machine, &args, "MEMBER", Goal::Tail)
}

fn member_if(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    by_predicate(machine, &args, "MEMBER-IF", true, Goal::Tail)
}

fn member_if_not(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    by_predicate(machine, &args, "MEMBER-IF-NOT", false, Goal::Tail)
}

fn assoc(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    by_item(machine, &args, "ASSOC", Goal::ByCar)
}

fn assoc_if(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    by_predicate(machine, &args, "ASSOC-IF", true, Goal::ByCar)
}

fn assoc_if_not(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    by_predicate(machine, &args, "ASSOC-IF-NOT", false, Goal::ByCar)
}

fn rassoc(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    by_item(machine, &args, "RASSOC", Goal::ByCdr)
}

fn rassoc_if(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    by_predicate(machine, &args, "RASSOC-IF", true, Goal::ByCdr)
}

fn rassoc_if_not(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    by_predicate(machine, &args, "RASSOC-IF-NOT", false, Goal::ByCdr)
}

fn acons(_: &mut Image, args: &[Value]) -> Outcome {
    let entry = Value::cons(args[0].clone(), args[1].clone());
    Ok(Value::cons(entry, args[2].clone()))
}

fn pairlis(_: &mut Image, args: &[Value]) -> Outcome {
    let mut result = args.get(2).cloned().unwrap_or(Value::NIL);
    let mut keys = ListWalk::new(args[0].clone());
    let mut values = ListWalk::new(args[1].clone());
    loop {
        match (keys.next()?, values.next()?) {
            (Some(key), Some(value)) => result = Value::cons(Value::cons(key, value), result),
            (None, None) => return Ok(result),
            _ => {
                return Err(Raise::simple(
                    "The lists of keys and data are of unequal length.",
                ));
            }
        }
    }
}

/// Searching in lists.
pub(crate) static TABLE: &[Builtin] = &[
    control(
        "MEMBER",
        "item list &key key test test-not",
        "The list from the first element that matches an item, or `NIL`.",
        &[
            "(member 2 '(1 2 3)) => (2 3)",
            "(member \"b\" '(\"a\" \"b\") :test #'equal) => (\"b\")",
        ],
        member,
    ),
    control(
        "MEMBER-IF",
        "predicate list &key key",
        "The list from the first element that satisfies a predicate.",
        &["(member-if #'evenp '(1 2 3)) => (2 3)"],
        member_if,
    ),
    control(
        "MEMBER-IF-NOT",
        "predicate list &key key",
        "The list from the first element that does not satisfy a predicate.",
        &["(member-if-not #'oddp '(1 2 3)) => (2 3)"],
        member_if_not,
    ),
    control(
        "ASSOC",
        "item alist &key key test test-not",
        "The first entry of an association list whose car matches an item.",
        &["(assoc 'b '((a . 1) (b . 2))) => (B . 2)"],
        assoc,
    ),
    control(
        "ASSOC-IF",
        "predicate alist &key key",
        "The first entry whose car satisfies a predicate.",
        &["(assoc-if #'evenp '((1 . a) (2 . b))) => (2 . B)"],
        assoc_if,
    ),
    control(
        "ASSOC-IF-NOT",
        "predicate alist &key key",
        "The first entry whose car does not satisfy a predicate.",
        &["(assoc-if-not #'evenp '((2 . b) (1 . a))) => (1 . A)"],
        assoc_if_not,
    ),
    control(
        "RASSOC",
        "item alist &key key test test-not",
        "The first entry of an association list whose cdr matches an item.",
        &["(rassoc 2 '((a . 1) (b . 2))) => (B . 2)"],
        rassoc,
    ),
    control(
        "RASSOC-IF",
        "predicate alist &key key",
        "The first entry whose cdr satisfies a predicate.",
        &["(rassoc-if #'evenp '((a . 1) (b . 2))) => (B . 2)"],
        rassoc_if,
    ),
    control(
        "RASSOC-IF-NOT",
        "predicate alist &key key",
        "The first entry whose cdr does not satisfy a predicate.",
        &["(rassoc-if-not #'oddp '((a . 1) (b . 2))) => (B . 2)"],
        rassoc_if_not,
    ),
    pure(
        "ACONS",
        "key datum alist",
        "An association list with another entry in front.",
        &["(acons 'a 1 '((b . 2))) => ((A . 1) (B . 2))"],
        acons,
    ),
    pure(
        "PAIRLIS",
        "keys data &optional alist",
        "An association list of keys with data.",
        &["(pairlis '(a b) '(1 2)) => ((B . 2) (A . 1))"],
        pairlis,
    ),
];
