//! A functor implemented in Rust: one row of a table.

use super::goal::Action;
use super::term::Bindings;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

/// A functor. It is recognised by its name, in whatever package.
pub struct Functor {
    /// The name in upper case.
    pub name: &'static str,
    /// The arguments of a goal, which also determine their number. Those in capitals cannot be unbound variables.
    pub arguments: &'static str,
    /// When the goal holds.
    pub doc: &'static str,
    /// The effect of a goal.
    pub apply: fn(Call<'_>) -> Result<Action, Box<Raise>>,
}

/// A functor.
pub const fn functor(
    name: &'static str,
    arguments: &'static str,
    doc: &'static str,
    apply: fn(Call<'_>) -> Result<Action, Box<Raise>>,
) -> Functor {
    Functor {
        name,
        arguments,
        doc,
        apply,
    }
}

impl Functor {
    /// Whether a goal may have this many arguments.
    pub fn takes(&self, count: usize) -> bool {
        let (mut least, mut most) = (0, Some(0));
        let mut is_optional = false;
        for word in self.arguments.split_whitespace() {
            match word {
                "&optional" => is_optional = true,
                word if word.ends_with('…') => most = None,
                _ => {
                    least += usize::from(!is_optional);
                    most = most.map(|most| most + 1);
                }
            }
        }
        count >= least && most.is_none_or(|most| count <= most)
    }

    /// The numbers of those arguments, from 0, that cannot be unbound variables.
    pub fn given(&self) -> Vec<usize> {
        let words = self.arguments.split_whitespace();
        let words = words.filter(|word| *word != "&optional").enumerate();
        let capitals = words.filter(|(_, word)| word.chars().all(|c| c.is_uppercase()));
        capitals.map(|(number, _)| number).collect()
    }
}

/// A goal that is to be proved.
pub struct Call<'c> {
    /// The image.
    pub image: &'c mut Image,
    /// The bindings so far.
    pub bindings: &'c mut Bindings,
    /// The functor as written.
    pub functor: Sym,
    /// The arguments, as many as the functor takes.
    pub args: &'c [Value],
    /// Number of choice points when the clause of the goal was entered: `!` cuts back to that many.
    pub(crate) clause: usize,
    /// Number of choice points.
    pub(crate) barrier: usize,
    /// The number of the next choice point.
    pub(crate) next_choice: u64,
}

impl Call<'_> {
    /// An argument; `NIL` beyond the last one.
    pub fn arg(&self, index: usize) -> Value {
        self.args.get(index).cloned().unwrap_or(Value::NIL)
    }

    /// The arguments from the given index on.
    pub fn rest(&self, from: usize) -> &[Value] {
        self.args.get(from..).unwrap_or_default()
    }

    /// Unifies two terms: the goal holds if that is possible.
    pub fn unify(self, a: &Value, b: &Value) -> Action {
        holds(self.bindings.unify(a, b))
    }

    /// Arguments as passed to functions.
    pub fn shown(&self, terms: &[Value]) -> Result<Vec<Value>, Box<Raise>> {
        terms.iter().map(|term| self.bindings.shown(term)).collect()
    }
}

/// The goal holds, or it does not.
pub fn holds(is_so: bool) -> Action {
    if is_so { Action::Succeed } else { Action::Fail }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_arguments_is_read_from_the_shape() {
        let takes =
            |arguments, count| functor("F", arguments, "", |_| Ok(Action::Fail)).takes(count);
        assert!(takes("", 0) && !takes("", 1));
        assert!(takes("a b", 2) && !takes("a b", 1) && !takes("a b", 3));
        assert!(takes("a &optional b", 1) && takes("a &optional b", 2));
        assert!(!takes("a &optional b", 3));
        assert!(takes("a goal…", 1) && takes("a goal…", 7) && !takes("a goal…", 0));
    }
}
