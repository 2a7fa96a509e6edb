//! Shows how goals are proved, as the four ports of a box: a goal is called, it exits with a proof, a further
//! proof of it is searched for (redo), and it fails.
//!
//! A traced goal leaves two marks: a goal after those that prove it, which is met at its exit, and choice points, which
//! are met on the way back. Neither changes what is proved, nor in which order.

use std::rc::Rc;

use super::choice_point::Alternative;
use super::engine::Engine;
use super::facts;
use super::goal::Goal;
use super::goal_chain::GoalNode;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::stream;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Maximum number of lines for one query.
const MAX_LINES: usize = 1000;
/// Maximum number of characters of a goal in a line.
const MAX_CHARACTERS: usize = 200;
/// Deeper goals are not indented further.
const MAX_INDENTATION: usize = 40;

/// Functors that say how goals are put together: they are not shown when all goals are.
const CONTROL: &[&str] = &[
    "AND", "OR", "NOT", "->", "*->", "!", "CUT", "CALL", "ONCE", "TRUE", "FAIL",
];

/// Which goals are traced.
#[derive(Clone, Default)]
pub(crate) struct Tracing {
    /// All but those of control.
    pub(crate) is_all: bool,
    /// Names of functors in upper case.
    pub(crate) names: Vec<String>,
}

impl Tracing {
    /// Is nothing traced?
    pub(crate) fn is_off(&self) -> bool {
        !self.is_all && self.names.is_empty()
    }

    fn is_of(&self, name: &str) -> bool {
        self.is_all && !CONTROL.contains(&name) || self.names.iter().any(|other| other == name)
    }
}

/// A goal that is traced, while it is proved.
pub struct TracedGoal {
    /// The goal.
    pub(super) term: Value,
    /// In how many traced goals it is.
    pub(super) depth: usize,
    /// The number of the choice point that was made before it.
    pub(super) number: u64,
}

impl Engine {
    /// Shows that a goal is called, if it is traced, and lets its other ports be shown.
    pub(super) fn trace_call(&mut self, image: &mut Image, term: &Value) -> Result<()> {
        let functor = match term {
            Value::Cons(cons) => self.bindings.walk(&cons.car()).as_symbol(),
            other => other.as_symbol(),
        };
        let Some(functor) = functor else {
            return Ok(());
        };
        let is_traced = self.facts.tracing.borrow().is_of(image.name(functor));
        if !is_traced || self.lines > MAX_LINES {
            return Ok(());
        }
        let goal = Rc::new(TracedGoal {
            term: term.clone(),
            depth: self.depth,
            number: self.numbers,
        });
        self.show(image, "call", &goal)?;
        self.push_choice(self.goals.clone(), Alternative::Failed(Rc::clone(&goal)));
        let next = self.goals.take();
        let exit = Goal::Exit(Rc::clone(&goal));
        self.goals = Some(Rc::new(GoalNode::before(next, exit, 0)));
        self.depth += 1;
        Ok(())
    }

    /// A traced goal has been proved.
    pub(super) fn trace_exit(&mut self, image: &mut Image, goal: &Rc<TracedGoal>) -> Result<()> {
        self.depth = goal.depth;
        self.show(image, "exit", goal)?;
        let is_last = |number| number == goal.number;
        if self.choices.last().is_some_and(|c| is_last(c.number)) {
            // There is no other proof.
            self.choices.pop();
        } else {
            self.push_choice(self.goals.clone(), Alternative::Redone(Rc::clone(goal)));
        }
        Ok(())
    }

    /// Shows a line about a goal, with its bindings.
    pub(super) fn show(&mut self, image: &mut Image, port: &str, goal: &TracedGoal) -> Result<()> {
        if self.lines > MAX_LINES || self.facts.tracing.borrow().is_off() {
            return Ok(());
        }
        self.lines += 1;
        let to = image.special(known::V_TRACE_OUTPUT).clone();
        stream::fresh_line(image, &to)?;
        if self.lines > MAX_LINES {
            let end = format!("  … the trace of this query ends after {MAX_LINES} lines\n");
            return stream::write(image, &to, &end);
        }
        let shown = print::to_string(image, &self.bindings.shown(&goal.term)?, true);
        let blank = " ".repeat(2 * (1 + goal.depth.min(MAX_INDENTATION)));
        let line = format!("{blank}{}: {port} {}\n", goal.depth, on_one_line(&shown));
        stream::write(image, &to, &line)
    }
}

/// A text on one line, cut off if it is long.
fn on_one_line(text: &str) -> String {
    let mut line = String::new();
    let mut is_between = false;
    for (number, c) in text.chars().enumerate() {
        if number >= MAX_CHARACTERS {
            line.push('…');
            break;
        }
        match c {
            ' ' | '\n' => is_between = true,
            c => {
                if std::mem::take(&mut is_between) {
                    line.push(' ');
                }
                line.push(c);
            }
        }
    }
    line
}

/// What is traced now: a list of names, or T.
#[builtin("%TRACED-GOALS")]
fn traced_goals(image: &mut Image) -> Value {
    let tracing = facts::of(image).tracing.borrow().clone();
    match tracing.is_all {
        true => Value::T,
        false => Value::list(
            tracing
                .names
                .iter()
                .map(|name| Value::string(name.as_str()))
                .collect::<Vec<_>>(),
        ),
    }
}

/// From now on, goals with these functors are traced: a list of names, or T.
#[builtin("%TRACE-GOALS", "names")]
fn trace_goals(image: &mut Image, names: &Value) -> Value {
    let texts = names.iter_list().filter_map(|name| name.as_text());
    let tracing = Tracing {
        is_all: names.is_eq(&Value::T),
        names: texts.collect(),
    };
    facts::of(image).tracing.replace(tracing);
    Value::NIL
}

/// Whether there is a functor of that name, and if not, the name of one that is similar.
#[builtin("%FUNCTOR-NAMED", "name")]
fn functor_named(image: &mut Image, name: &Value) -> Value {
    let facts = facts::of(image);
    let Some(name) = name.as_text() else {
        return Value::NIL;
    };
    if facts.has(image, &name) {
        return Value::T;
    }
    let near = facts.closest(image, &name);
    near.map_or(Value::NIL, Value::string)
}

/// What the library makes TRACE-PROLOG of.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![traced_goals, trace_goals, functor_named,];
