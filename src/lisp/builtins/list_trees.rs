//! Trees of pairs: `subst`, `sublis`, `tree-equal`. No recursion, whatever the depth.

use std::rc::Rc;

use super::criterion::{Criterion, Key, Test};
use super::keywords;
use crate::lisp::builtin::{Builtin, control};
use crate::lisp::value::Value;
use crate::lisp::value::cons::Cons;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::sequence::ListWalk;
use crate::lisp::vm::calls::{Calls, run};
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;

type Outcome = Result<Value, Box<Raise>>;

/// Pairs that a tree may have before it is taken for a circular one.
const MOST_PAIRS: usize = 10_000_000;

/// Counts the pairs of a tree that is walked.
#[derive(Default)]
pub(crate) struct PairCount(usize);

impl PairCount {
    /// One more pair; an error if there are so many that the tree must be circular.
    pub(crate) fn add_one(&mut self) -> Result<(), Box<Raise>> {
        self.0 += 1;
        if self.0 <= MOST_PAIRS {
            return Ok(());
        }
        let text = format!("The tree has more than {MOST_PAIRS} pairs; it must be circular.");
        Err(Raise::simple(text))
    }
}

/// What takes the place of parts of a tree.
enum Replacement {
    /// One value for all parts that satisfy a condition.
    One { new: Value, criterion: Criterion },
    /// The data of the first matching entry of an association list.
    Entries { alist: Value, test: Test, key: Key },
}

impl Replacement {
    async fn of(&self, calls: &Calls, part: &Value) -> Result<Option<Value>, Box<Raise>> {
        match self {
            Replacement::One { new, criterion } => {
                Ok(criterion.accepts(calls, part).await.then(|| new.clone()))
            }
            Replacement::Entries { alist, test, key } => {
                let looked_for = key.of(calls, part.clone()).await;
                let mut walk = ListWalk::new(alist.clone());
                while let Some(entry) = walk.next()? {
                    let Value::Cons(entry) = &entry else {
                        if entry.is_nil() {
                            continue;
                        }
                        return Err(Raise::type_error(&entry, known::LIST));
                    };
                    if test.matches(calls, &entry.car(), &looked_for).await {
                        return Ok(Some(entry.cdr()));
                    }
                }
                Ok(None)
            }
        }
    }

    /// What stands in the new tree for a part of the old one: a pair is copied (or kept,
    /// in place) and its halves are still to be looked at.
    async fn apply(
        &self,
        calls: &Calls,
        part: Value,
        in_place: bool,
        pending: &mut Vec<Half>,
    ) -> Outcome {
        if let Some(new) = self.of(calls, &part).await? {
            return Ok(new);
        }
        let Value::Cons(cons) = &part else {
            return Ok(part);
        };
        let cons = if in_place {
            cons.clone()
        } else {
            Rc::new(Cons::new(cons.car(), cons.cdr()))
        };
        pending.push(Half::Cdr(cons.clone()));
        pending.push(Half::Car(cons.clone()));
        Ok(Value::Cons(cons))
    }
}

/// A half of a pair that still holds its old value.
enum Half {
    Car(Rc<Cons>),
    Cdr(Rc<Cons>),
}

async fn replace(calls: Calls, tree: Value, replacement: Replacement, in_place: bool) -> Outcome {
    let mut pending = Vec::new();
    let result = replacement
        .apply(&calls, tree, in_place, &mut pending)
        .await?;
    let mut pairs = PairCount::default();
    while let Some(half) = pending.pop() {
        pairs.add_one()?;
        match half {
            Half::Car(cons) => {
                let new = replacement.apply(&calls, cons.car(), in_place, &mut pending);
                cons.set_car(new.await?);
            }
            Half::Cdr(cons) => {
                let new = replacement.apply(&calls, cons.cdr(), in_place, &mut pending);
                cons.set_cdr(new.await?);
            }
        }
    }
    Ok(result)
}

fn subst_item(
    machine: &mut Machine<'_>,
    args: &[Value],
    name: &'static str,
    in_place: bool,
) -> Result<Step, Box<Raise>> {
    let image = &machine.image;
    let [key, test, test_not] = keywords::parse(
        image,
        &args[3..],
        [known::K_KEY, known::K_TEST, known::K_TEST_NOT],
    )?;
    let criterion = Criterion::item(
        args[1].clone(),
        Test::new(image, test, test_not)?,
        Key::new(image, key)?,
    );
    let new = args[0].clone();
    let replacement = Replacement::One { new, criterion };
    let tree = args[2].clone();
    run(machine, name, |calls| {
        replace(calls, tree, replacement, in_place)
    })
}

fn subst_predicate(
    machine: &mut Machine<'_>,
    args: &[Value],
    name: &'static str,
    expected: bool,
    in_place: bool,
) -> Result<Step, Box<Raise>> {
    let image = &machine.image;
    let [key] = keywords::parse(image, &args[3..], [known::K_KEY])?;
    let criterion = Criterion::predicate(image, &args[1], expected, Key::new(image, key)?)?;
    let new = args[0].clone();
    let replacement = Replacement::One { new, criterion };
    let tree = args[2].clone();
    run(machine, name, |calls| {
        replace(calls, tree, replacement, in_place)
    })
}

fn sublis_of(
    machine: &mut Machine<'_>,
    args: &[Value],
    name: &'static str,
    in_place: bool,
) -> Result<Step, Box<Raise>> {
    let image = &machine.image;
    let [key, test, test_not] = keywords::parse(
        image,
        &args[2..],
        [known::K_KEY, known::K_TEST, known::K_TEST_NOT],
    )?;
    let replacement = Replacement::Entries {
        alist: args[0].clone(),
        test: Test::new(image, test, test_not)?,
        key: Key::new(image, key)?,
    };
    let tree = args[1].clone();
    run(machine, name, |calls| {
        replace(calls, tree, replacement, in_place)
    })
}

fn subst(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    subst_item(machine, &args, "SUBST", false)
}

fn nsubst(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    subst_item(machine, &args, "NSUBST", true)
}

fn subst_if(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    subst_predicate(machine, &args, "SUBST-IF", true, false)
}

fn subst_if_not(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    subst_predicate(machine, &args, "SUBST-IF-NOT", false, false)
}

fn nsubst_if(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    subst_predicate(machine, &args, "NSUBST-IF", true, true)
}

fn nsubst_if_not(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    subst_predicate(machine, &args, "NSUBST-IF-NOT", false, true)
}

fn sublis(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    sublis_of(machine, &args, "SUBLIS", false)
}

fn nsublis(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    sublis_of(machine, &args, "NSUBLIS", true)
}

async fn compare_trees(calls: Calls, a: Value, b: Value, test: Test) -> Outcome {
    let mut pending = vec![(a, b)];
    let mut pairs = PairCount::default();
    while let Some((a, b)) = pending.pop() {
        pairs.add_one()?;
        match (&a, &b) {
            (Value::Cons(x), Value::Cons(y)) => {
                pending.push((x.cdr(), y.cdr()));
                pending.push((x.car(), y.car()));
            }
            (Value::Cons(_), _) | (_, Value::Cons(_)) => return Ok(Value::NIL),
            _ if test.matches(&calls, &a, &b).await => {}
            _ => return Ok(Value::NIL),
        }
    }
    Ok(Value::T)
}

fn tree_equal(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    let image = &machine.image;
    let [test, test_not] = keywords::parse(image, &args[2..], [known::K_TEST, known::K_TEST_NOT])?;
    let test = Test::new(image, test, test_not)?;
    let (a, b) = (args[0].clone(), args[1].clone());
    run(machine, "TREE-EQUAL", |calls| {
        compare_trees(calls, a, b, test)
    })
}

/// Trees of pairs.
pub(crate) static TABLE: &[Builtin] = &[
    control(
        "SUBST",
        "new old tree &key key test test-not",
        "A tree with every part that matches `old` replaced by `new`.",
        &["(subst 'x 'b '(a b (b c))) => (A X (X C))"],
        subst,
    ),
    control(
        "NSUBST",
        "new old tree &key key test test-not",
        "Like `subst`, but changes the tree.",
        &["(nsubst 'x 'b (list 'a 'b)) => (A X)"],
        nsubst,
    ),
    control(
        "SUBST-IF",
        "new predicate tree &key key",
        "A tree with every part that satisfies a predicate replaced.",
        &["(subst-if 0 #'numberp '(a 1 (b 2))) => (A 0 (B 0))"],
        subst_if,
    ),
    control(
        "SUBST-IF-NOT",
        "new predicate tree &key key",
        "A tree with every part that does not satisfy a predicate replaced.",
        &["(subst-if-not 0 #'listp '(a (b))) => (0 (0))"],
        subst_if_not,
    ),
    control(
        "NSUBST-IF",
        "new predicate tree &key key",
        "Like `subst-if`, but changes the tree.",
        &["(nsubst-if 0 #'numberp (list 'a 1)) => (A 0)"],
        nsubst_if,
    ),
    control(
        "NSUBST-IF-NOT",
        "new predicate tree &key key",
        "Like `subst-if-not`, but changes the tree.",
        &["(nsubst-if-not 0 #'listp (list 'a)) => (0)"],
        nsubst_if_not,
    ),
    control(
        "SUBLIS",
        "alist tree &key key test test-not",
        "A tree with every part that is a key of an association list replaced by its datum.",
        &["(sublis '((a . 1) (b . 2)) '(a (b c))) => (1 (2 C))"],
        sublis,
    ),
    control(
        "NSUBLIS",
        "alist tree &key key test test-not",
        "Like `sublis`, but changes the tree.",
        &["(nsublis '((a . 1)) (list 'a 'b)) => (1 B)"],
        nsublis,
    ),
    control(
        "TREE-EQUAL",
        "tree-1 tree-2 &key test test-not",
        "Have two trees the same shape and matching leaves?",
        &["(tree-equal '(1 (2 3)) '(1 (2 3))) => T"],
        tree_equal,
    ),
];
