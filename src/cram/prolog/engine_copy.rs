//! Copies of provers that wait to be asked for the next proof, for a copy of their image.

use std::collections::HashMap;
use std::rc::Rc;

use super::choice_point::{Alternative, Choice};
use super::engine::{Awaited, Engine};
use super::facts::Facts;
use super::goal::Goal;
use super::goal_chain::{GoalNode, Goals};
use super::term::Naming;
use super::tracing::TracedGoal;
use lisp::value::copy::{Copied, Copier};

/// Copies of nodes by the addresses of the originals: choice points share the goals after them.
type Nodes = HashMap<*const GoalNode, Goals>;

impl Engine {
    /// A copy. It has no facts until [`Engine::attach`] gives it those of its image.
    pub(super) fn copied(&self, copier: &mut Copier) -> Engine {
        let mut nodes = Nodes::new();
        Engine {
            bindings: self.bindings.copied(copier),
            goals: goals(&self.goals, &mut nodes, copier),
            choices: self
                .choices
                .iter()
                .map(|choice| Choice {
                    number: choice.number,
                    mark: choice.mark,
                    goals: goals(&choice.goals, &mut nodes, copier),
                    alternative: alternative(&choice.alternative, copier),
                    depth: choice.depth,
                })
                .collect(),
            collections: self
                .collections
                .iter()
                .map(|items| items.iter().map(|item| copier.value(item)).collect())
                .collect(),
            awaited: self.awaited.as_ref().map(|it| awaited(it, copier)),
            facts: Rc::new(Facts::default()),
            query: Naming {
                variables: self
                    .query
                    .variables
                    .iter()
                    .map(|(name, variable)| (*name, copier.value(variable)))
                    .collect(),
            },
            is_started: self.is_started,
            numbers: self.numbers,
            depth: self.depth,
            lines: self.lines,
            warned: self.warned.clone(),
        }
    }
}

fn goals(goals: &Goals, nodes: &mut Nodes, copier: &mut Copier) -> Goals {
    let mut originals = Vec::new();
    let mut rest = goals;
    let mut copy = loop {
        let Some(node) = rest else { break None };
        if let Some(known) = nodes.get(&Rc::as_ptr(node)) {
            break known.clone();
        }
        originals.push(node);
        rest = &node.next;
    };
    for node in originals.into_iter().rev() {
        copy = Some(Rc::new(node.with(goal(&node.goal, copier), copy)));
        nodes.insert(Rc::as_ptr(node), copy.clone());
    }
    copy
}

fn goal(goal: &Goal, copier: &mut Copier) -> Goal {
    match goal {
        Goal::Prove(term) => Goal::Prove(copier.value(term)),
        Goal::Cut(count) => Goal::Cut(*count),
        Goal::Forget(number) => Goal::Forget(*number),
        Goal::Collect(collection, template) => Goal::Collect(*collection, copier.value(template)),
        Goal::Clauses(term) => Goal::Clauses(copier.value(term)),
        Goal::Handler(term) => Goal::Handler(copier.value(term)),
        Goal::Exit(goal) => Goal::Exit(traced(goal, copier)),
        Goal::Fail => Goal::Fail,
    }
}

fn alternative(alternative: &Alternative, copier: &mut Copier) -> Alternative {
    match alternative {
        Alternative::Clauses {
            goal,
            clauses,
            next,
        } => Alternative::Clauses {
            goal: copier.value(goal),
            clauses: clauses.iter().map(|clause| clause.copied(copier)).collect(),
            next: *next,
        },
        Alternative::Items { term, rest } => Alternative::Items {
            term: copier.value(term),
            rest: rest
                .as_slice()
                .iter()
                .map(|item| copier.value(item))
                .collect::<Vec<_>>()
                .into_iter(),
        },
        Alternative::Goals => Alternative::Goals,
        Alternative::Collected {
            collection,
            result,
            kind,
        } => Alternative::Collected {
            collection: *collection,
            result: copier.value(result),
            kind: *kind,
        },
        Alternative::Forgotten => Alternative::Forgotten,
        Alternative::Failed(goal) => Alternative::Failed(traced(goal, copier)),
        Alternative::Redone(goal) => Alternative::Redone(traced(goal, copier)),
    }
}

fn traced(goal: &TracedGoal, copier: &mut Copier) -> Rc<TracedGoal> {
    Rc::new(TracedGoal {
        term: copier.value(&goal.term),
        depth: goal.depth,
        number: goal.number,
    })
}

fn awaited(awaited: &Awaited, copier: &mut Copier) -> Awaited {
    match awaited {
        Awaited::Result(term) => Awaited::Result(copier.value(term)),
        Awaited::Truth => Awaited::Truth,
        Awaited::OneOf(term) => Awaited::OneOf(copier.value(term)),
        Awaited::OneOfBindings(variables) => {
            Awaited::OneOfBindings(variables.iter().map(|it| copier.value(it)).collect())
        }
        Awaited::Nothing => Awaited::Nothing,
    }
}
