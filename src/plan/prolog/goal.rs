//! What there is to do in a proof, and what a functor asks for.

use crate::lisp::value::Value;

/// One thing to do.
#[derive(Clone)]
pub(crate) enum Goal {
    /// Prove a term.
    Prove(Value),
    /// Forget all choices made since there were so many.
    Cut(usize),
    /// Forget the one choice of this number, keeping later ones.
    Forget(u64),
    /// Keep a term in a collection, then fail.
    Collect(usize, Value),
    /// Fail.
    Fail,
}

/// What a functor of the language asks for.
pub(crate) enum Action {
    /// The goal holds.
    Succeed,
    /// It does not.
    Fail,
    /// Go on with these goals.
    Then(Vec<Goal>),
    /// A choice between goals and others; both go on with what follows.
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
    /// Call a function and go on.
    CallOnly { function: Value, args: Vec<Value> },
}

/// What becomes of collected solutions.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Collection {
    /// All of them, even if there is none.
    All,
    /// All of them; the goal fails if there is none.
    Some,
    /// Each once; the goal fails if there is none.
    Distinct,
}
