//! The goals that are still to be proved, as chains that choice points share.

use std::rc::Rc;

use super::goal::Goal;

/// Goals to prove, in order.
pub(super) type Goals = Option<Rc<GoalNode>>;

/// A goal and those after it.
pub(super) struct GoalNode {
    /// The goal.
    pub(super) goal: Goal,
    /// Number of choice points when the clause of this goal was entered: `!` cuts back to that
    /// many.
    pub(super) clause: usize,
    /// Number of goals from this one on.
    pub(super) count: usize,
    /// The goals after it.
    pub(super) next: Goals,
}

impl GoalNode {
    /// A goal before others.
    pub(super) fn before(next: Goals, goal: Goal, clause: usize) -> GoalNode {
        let count = 1 + next.as_ref().map_or(0, |next| next.count);
        GoalNode {
            goal,
            clause,
            count,
            next,
        }
    }

    /// A node like this one with another goal and others after it.
    pub(super) fn with(&self, goal: Goal, next: Goals) -> GoalNode {
        GoalNode {
            goal,
            clause: self.clause,
            count: self.count,
            next,
        }
    }
}

impl Drop for GoalNode {
    fn drop(&mut self) {
        // A loop, since a rule that proves itself makes long chains.
        let mut next = self.next.take();
        while let Some(node) = next {
            next = Rc::try_unwrap(node).map_or(None, |mut node| node.next.take());
        }
    }
}
