//! What a prover that waits to be asked for the next proof refers to, for the collector of circles.

use std::collections::HashSet;
use std::rc::Rc;

use super::choice_point::Alternative;
use super::engine::{Awaited, Engine};
use super::goal::Goal;
use super::goal_chain::{GoalNode, Goals};
use super::term::Bindings;
use lisp::value::Value;

/// Nodes that have been visited: choice points share the goals after them.
type Nodes = HashSet<*const GoalNode>;

impl Engine {
    /// Visits the values that nothing but the prover holds for its proof. Facts are held elsewhere.
    pub(super) fn for_each_reference(&self, visit: &mut dyn FnMut(&Value)) {
        let mut nodes = Nodes::new();
        self.bindings.for_each_reference(visit);
        goals(&self.goals, &mut nodes, visit);
        for choice in &self.choices {
            goals(&choice.goals, &mut nodes, visit);
            alternative(&choice.alternative, visit);
        }
        self.collections.iter().flatten().for_each(&mut *visit);
        match &self.awaited {
            Some(Awaited::Result(term) | Awaited::OneOf(term)) => visit(term),
            Some(Awaited::OneOfBindings(variables)) => variables.iter().for_each(&mut *visit),
            Some(Awaited::Truth | Awaited::Nothing) | None => {}
        }
    }

    /// Lets go of all these values: nobody will ask for a proof any more.
    pub(super) fn let_go(&mut self) {
        self.bindings = Bindings::default();
        self.goals = None;
        self.choices.clear();
        self.collections.clear();
        self.awaited = None;
    }
}

fn goals(goals: &Goals, nodes: &mut Nodes, visit: &mut dyn FnMut(&Value)) {
    let mut rest = goals;
    while let Some(node) = rest
        && nodes.insert(Rc::as_ptr(node))
    {
        match &node.goal {
            Goal::Prove(term)
            | Goal::Clauses(term)
            | Goal::Handler(term)
            | Goal::Collect(_, term) => visit(term),
            Goal::Exit(goal) => visit(&goal.term),
            Goal::Cut(_) | Goal::Forget(_) | Goal::Fail => {}
        }
        rest = &node.next;
    }
}

fn alternative(alternative: &Alternative, visit: &mut dyn FnMut(&Value)) {
    match alternative {
        Alternative::Clauses { goal, .. } => visit(goal),
        Alternative::Items { term, rest } => {
            visit(term);
            rest.as_slice().iter().for_each(visit);
        }
        Alternative::Collected { result, .. } => visit(result),
        Alternative::Failed(goal) | Alternative::Redone(goal) => visit(&goal.term),
        Alternative::Goals | Alternative::Forgotten => {}
    }
}
