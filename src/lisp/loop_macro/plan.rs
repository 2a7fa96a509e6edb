//! What a clause loop does, according to its clauses.

use crate::value::Value;

/// A variable, or a tree of variables, and the form whose value it gets.
pub(crate) type Assignment = (Value, Value);

/// What happens when the variables of some `for` clauses take their next values: tests that end the
/// loop, assignments, tests, assignments. Each set of assignments is made in parallel.
#[derive(Clone, Default)]
pub(crate) struct Step {
    /// Forms that end the loop when they are true, before anything is assigned.
    pub tests: Vec<Value>,
    /// What the user's variables get.
    pub sets: Vec<Assignment>,
    /// Forms that end the loop when they are true, with the new values.
    pub(crate) tests_after: Vec<Value>,
    /// What hidden variables get.
    pub(crate) advances: Vec<Assignment>,
}

impl Step {
    /// Adds what another clause, joined by `and`, does at the same time.
    pub(crate) fn join(&mut self, other: Step) {
        self.tests.extend(other.tests);
        self.sets.extend(other.sets);
        self.tests_after.extend(other.tests_after);
        self.advances.extend(other.advances);
    }
}

/// What an accumulation builds.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Building {
    /// A list.
    List,
    /// A sum or a count.
    Total,
    /// A largest or smallest value.
    Extreme,
}

/// A result that clauses accumulate.
pub(crate) struct Accumulator {
    /// The variable after `into`; none for the loop's own result.
    pub into: Option<Value>,
    /// What is built.
    pub(crate) building: Building,
    /// The variable that holds the result: `into`, or a hidden one.
    pub variable: Value,
    /// For lists, the pair in front of the list, which is in a hidden variable.
    pub front: Value,
    /// For lists, the variable that holds the last pair; else a scratch variable.
    pub tail: Value,
}

/// A whole loop.
#[derive(Default)]
pub(crate) struct Plan {
    /// The name of the block.
    pub name: Value,
    /// Bindings, group by group; those of a group are made in parallel.
    pub bindings: Vec<Vec<Assignment>>,
    /// Hidden variables that start as `NIL`.
    pub scratch: Vec<Value>,
    /// What happens before the first iteration, clause group by clause group.
    pub first: Vec<Step>,
    /// What happens before each other iteration.
    pub next: Vec<Step>,
    /// Forms before everything else.
    pub(crate) initially: Vec<Value>,
    pub body: Vec<Value>,
    /// Forms after the last iteration.
    pub finally: Vec<Value>,
    /// Results that are accumulated.
    pub(crate) accumulators: Vec<Accumulator>,
    /// Does the loop return true if nothing ended it (`always`, `never`)?
    pub(crate) default_true: bool,
    /// The clause `always`, `never` or `thereis` that decides what the loop returns.
    pub(crate) decides: Option<&'static str>,
    /// The tag at the loop's end.
    pub(crate) end_tag: Value,
    /// All variables of `for` and `with` clauses.
    pub variables: Vec<Value>,
}
