//! Choice points: what else to try, and the way back to it.

use std::rc::Rc;

use super::engine::Engine;
use super::facts::Clause;
use super::goal::{Collection, Goal};
use super::goal_chain::Goals;
use super::term::{Mark, Naming};
use super::tracing::TracedGoal;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::equality::equal;
use lisp::value::raise::Raise;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// What to do on backtracking to a choice point.
pub(super) enum Alternative {
    /// Try the next clauses of a goal.
    Clauses {
        goal: Value,
        clauses: Rc<[Clause]>,
        next: usize,
    },
    /// Unify a term with the next items of a list.
    Items {
        term: Value,
        rest: std::vec::IntoIter<Value>,
    },
    /// Continue with other goals.
    Goals,
    /// The collection is complete: unify it with a term.
    Collected {
        collection: usize,
        result: Value,
        kind: Collection,
    },
    /// Nothing any more.
    Forgotten,
    /// Nothing: a traced goal has failed.
    Failed(Rc<TracedGoal>),
    /// Nothing: another proof of a traced goal is searched for.
    Redone(Rc<TracedGoal>),
}

pub(super) struct Choice {
    pub(super) number: u64,
    pub(super) mark: Mark,
    pub(super) goals: Goals,
    pub(super) alternative: Alternative,
    /// In how many traced goals it was made.
    pub(super) depth: usize,
}

impl Engine {
    pub(super) fn push_choice(&mut self, goals: Goals, alternative: Alternative) {
        let mark = self.bindings.mark();
        self.push_choice_at(mark, goals, alternative);
    }

    fn push_choice_at(&mut self, mark: Mark, goals: Goals, alternative: Alternative) {
        self.choices.push(Choice {
            number: self.numbers,
            mark,
            goals,
            alternative,
            depth: self.depth,
        });
        self.numbers += 1;
    }

    /// Enters the first clause from `next` on whose head matches; leaves a choice point for others.
    pub(super) fn try_clauses(
        &mut self,
        image: &Image,
        goal: Value,
        clauses: Rc<[Clause]>,
        next: usize,
    ) -> Result<bool> {
        let mark = self.bindings.mark();
        for (index, clause) in clauses.iter().enumerate().skip(next) {
            let barrier = self.choices.len();
            let mut naming = Naming::default();
            let head = self.bindings.rename(image, &clause.head, &mut naming)?;
            if !self.bindings.unify(&goal, &head) {
                self.bindings.undo(mark);
                continue;
            }
            let body = self.bindings.rename(image, &clause.body, &mut naming)?;
            if index + 1 < clauses.len() {
                let alternative = Alternative::Clauses {
                    goal,
                    clauses: clauses.clone(),
                    next: index + 1,
                };
                let goals = self.goals.clone();
                self.push_choice_at(mark, goals, alternative);
            }
            let goals = body.iter_list().map(Goal::Prove).collect();
            self.push_goals(goals, barrier);
            return Ok(true);
        }
        Ok(false)
    }

    /// Unifies a term with the first item that matches; leaves a choice point for the others.
    pub(super) fn choose_item(
        &mut self,
        term: Value,
        mut items: std::vec::IntoIter<Value>,
    ) -> bool {
        let mark = self.bindings.mark();
        while let Some(item) = items.next() {
            if self.bindings.unify(&term, &item) {
                if !items.as_slice().is_empty() {
                    let goals = self.goals.clone();
                    let alternative = Alternative::Items { term, rest: items };
                    self.push_choice_at(mark, goals, alternative);
                }
                return true;
            }
            self.bindings.undo(mark);
        }
        false
    }

    /// Backtracks to the last choice point with an alternative left; false if there is none.
    pub(super) fn backtrack(&mut self, image: &mut Image) -> Result<bool> {
        while let Some(choice) = self.choices.pop() {
            self.bindings.undo(choice.mark);
            self.goals = choice.goals;
            self.depth = choice.depth;
            match choice.alternative {
                Alternative::Forgotten => {}
                Alternative::Failed(goal) => self.show(image, "fail", &goal)?,
                Alternative::Redone(goal) => self.show(image, "redo", &goal)?,
                Alternative::Goals => return Ok(true),
                Alternative::Items { term, rest } => {
                    if self.choose_item(term, rest) {
                        return Ok(true);
                    }
                }
                Alternative::Collected {
                    collection,
                    result,
                    kind,
                } => {
                    let items = self.collections.get_mut(collection);
                    let mut items = items.map(std::mem::take).unwrap_or_default();
                    if kind == Collection::Distinct {
                        items = distinct(items);
                    }
                    let is_enough = kind == Collection::All || !items.is_empty();
                    if is_enough && self.bindings.unify(&result, &Value::list(items)) {
                        return Ok(true);
                    }
                }
                Alternative::Clauses {
                    goal,
                    clauses,
                    next,
                } => {
                    if self.try_clauses(image, goal, clauses, next)? {
                        return Ok(true);
                    }
                }
            }
        }
        Ok(false)
    }
}

/// The items without those equal to earlier ones.
fn distinct(items: Vec<Value>) -> Vec<Value> {
    let mut kept: Vec<Value> = Vec::new();
    for item in items {
        if !kept.iter().any(|k| equal(k, &item)) {
            kept.push(item);
        }
    }
    kept
}
