//! Goals that nothing can prove since they are written wrong: a warning tells how they would be right.

use super::facts::{Clause, Known};
use super::functor::Functor;
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::symbol::Sym;

/// Writes a warning.
pub(super) fn warn(image: &mut Image, text: &str) {
    image.output.fresh_line();
    image.output.write(&format!("WARNING: {text}\n"));
}

/// Why no rule of a functor is for a goal with this number of arguments; `None` if one is.
pub(super) fn of_rules(
    image: &Image,
    functor: Sym,
    clauses: &[Clause],
    goal: &Value,
) -> Option<String> {
    let mut terms = goal.iter_list();
    // A goal without arguments may be written as its functor alone.
    let count = terms.by_ref().count().max(1);
    // What the rest of the goal is bound to may be anything.
    if !matches!(terms.rest, Value::Symbol(..))
        || clauses.iter().any(|clause| takes(&clause.head, count))
    {
        return None;
    }
    let heads = clauses.iter().map(|clause| &clause.head);
    Some(of_heads(image, functor, heads, count.saturating_sub(1)))
}

/// That a goal has another number of arguments than any of these heads.
fn of_heads<'h>(
    image: &Image,
    functor: Sym,
    heads: impl Iterator<Item = &'h Value>,
    count: usize,
) -> String {
    let mut lengths = Vec::new();
    let mut shapes = Vec::new();
    for head in heads {
        let length = head.iter_list().count();
        if !lengths.contains(&length) {
            lengths.push(length);
            shapes.push(print::to_string(image, head, true));
        }
    }
    wrong_count(image, functor, count, &shapes.join(" or "))
}

/// Why no goal of a functor has this number of arguments, as far as rules and functors implemented in Rust tell;
/// `None` if one may.
pub fn of_count(image: &Image, known: &Known, count: usize) -> Option<String> {
    match (&known.heads, known.functor) {
        (Some(heads), _) => {
            let is_taken = heads.iter().any(|head| takes(head, count + 1));
            (!is_taken).then(|| of_heads(image, known.meant, heads.iter(), count))
        }
        (None, Some(functor)) if !functor.takes(count) => {
            Some(of_functor(image, known.meant, functor, count))
        }
        (None, _) => None,
    }
}

/// Why a functor implemented in Rust is not for a goal with this number of arguments.
pub(super) fn of_functor(image: &Image, functor: Sym, known: &Functor, count: usize) -> String {
    let arguments = known.arguments.split_whitespace();
    let arguments: String = arguments.map(|argument| format!(" {argument}")).collect();
    let shape = format!("({}{arguments})", known.name);
    wrong_count(image, functor, count, &shape)
}

fn wrong_count(image: &Image, functor: Sym, count: usize, shapes: &str) -> String {
    format!(
        "The Prolog goal {} does not take {count} argument{}; it is written {shapes}.",
        print::to_string(image, &functor.into(), true),
        if count == 1 { "" } else { "s" },
    )
}

/// Can a goal with this number of terms, the functor among them, be an instance of a head?
fn takes(head: &Value, count: usize) -> bool {
    if let Value::Symbol(..) = head {
        return count == 1;
    }
    let mut terms = head.iter_list();
    let least = terms.by_ref().count();
    count == least || count > least && terms.rest.is_true()
}
