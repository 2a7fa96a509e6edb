//! The steps of a proof, and what a functor can request.

use std::rc::Rc;

use super::tracing::TracedGoal;
use lisp::value::Value;

/// A step of a proof.
#[derive(Clone)]
pub enum Goal {
    /// Prove a term.
    Prove(Value),
    /// Discard all choice points beyond this number of them.
    Cut(usize),
    /// Discard the choice point with this number, but keep later ones.
    Forget(u64),
    /// Add a term to a collection, then fail.
    Collect(usize, Value),
    /// Prove a term by the rules of its functor.
    Clauses(Value),
    /// Prove a term by the function of its functor.
    Handler(Value),
    /// A traced goal has been proved.
    Exit(Rc<TracedGoal>),
    /// Fail.
    Fail,
}

/// What a functor of the language requests.
pub enum Action {
    /// The goal holds.
    Succeed,
    /// It does not.
    Fail,
    /// Continue with these goals.
    Then(Vec<Goal>),
    /// Choose between two lists of goals; both continue with what follows.
    Either(Vec<Goal>, Vec<Goal>),
    /// Unify a term with each item in turn.
    Items(Value, Vec<Value>),
    /// Collect the solutions of a goal, then unify the list with a term.
    Collect {
        template: Value,
        goal: Value,
        result: Value,
        kind: Collection,
    },
    /// Call a function and unify its value with a term.
    CallFor {
        function: Value,
        args: Vec<Value>,
        result: Value,
    },
    /// Call a function and hold if its value is not `NIL`.
    CallTest { function: Value, args: Vec<Value> },
    /// Call a function, and unify a term with each item of its value in turn.
    CallItems {
        function: Value,
        args: Vec<Value>,
        term: Value,
    },
    /// Call a function that returns lists of bindings for these variables.
    CallBindings {
        function: Value,
        args: Vec<Value>,
        variables: Vec<Value>,
    },
    /// Call a function and continue.
    CallOnly { function: Value, args: Vec<Value> },
}

/// What to do with collected solutions.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Collection {
    /// Keep all of them, even if there is none.
    All,
    /// Keep all of them; the goal fails if there is none.
    Some,
    /// Keep each only once; the goal fails if there is none.
    Distinct,
}
