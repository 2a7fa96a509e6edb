//! An action while it is performed, as the journal sees it.

use std::cell::RefCell;
use std::rc::Rc;

use super::journal::{ActionEnd, BegunAction, Change, EndedAction, Starter};
use super::scheduler::unwrapped;
use super::state::Plan;
use super::task::TaskId;
use lisp::image::Image;
use lisp::image::signalled::Leaving;
use lisp::source::Place;
use lisp::value::Value;

/// An action while it is performed. When it is dropped, with the stack frame of its plan, the
/// action has ended.
pub(crate) struct OpenAction {
    plan: Rc<Plan>,
    task: TaskId,
    begun: BegunAction,
    value: RefCell<Option<Value>>,
    leaving: Leaving,
}

impl OpenAction {
    /// Notes the begin of an action at a place, if the journal is kept.
    pub(crate) fn begin(image: &Image, designator: &Value, place: Place) -> Option<Rc<OpenAction>> {
        let plan = Plan::of(image);
        let task = plan.journal.running().filter(|_| plan.journal.is_kept())?;
        let starter = plan.starter(task);
        let begun = BegunAction {
            id: plan.journal.open_action(task),
            starter: Some(starter),
            designator: designator.clone(),
            place,
            time: plan.now(),
        };
        plan.journal.note(Change::Begun(begun.clone()));
        Some(Rc::new(OpenAction {
            plan,
            task,
            begun,
            value: RefCell::default(),
            leaving: image.leaving(),
        }))
    }

    /// The action has succeeded with a value.
    pub(crate) fn succeed(&self, value: &Value) {
        self.value.replace(Some(value.clone()));
    }
}

impl Drop for OpenAction {
    fn drop(&mut self) {
        let journal = &self.plan.journal;
        let end = match self.value.take() {
            Some(value) => ActionEnd::Succeeded(value),
            // The frame is left by its task as a whole, by a handler, or by another exit.
            None => journal.unwinding().unwrap_or_else(|| {
                let failure = |condition| ActionEnd::Failed(unwrapped(&self.plan, condition));
                let cause = self.leaving.cause();
                cause.map_or(ActionEnd::Evaporated, failure)
            }),
        };
        journal.close_action(self.task, self.begun.id);
        journal.note(Change::Ended(EndedAction {
            begun: self.begun.clone(),
            end,
            time: self.plan.now(),
        }));
    }
}

impl Plan {
    /// What starts something that a task starts now: the innermost action that it performs, or
    /// else the task itself.
    pub fn starter(&self, task: TaskId) -> Starter {
        let action = self.journal.action_of(task);
        action.map_or(Starter::Task(task), Starter::Action)
    }
}
