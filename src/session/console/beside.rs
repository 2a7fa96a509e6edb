//! Evaluating forms in a stack frame of a plan that an interrupt has stopped.
//!
//! The plan stands in the middle of something, so that nothing can run on top of it: forms are
//! evaluated beside it, without any time passing.

use std::cell::RefCell;
use std::rc::Rc;

use super::aside::InFrame;
use super::evaluator::{Evaluator, interrupted};
use crate::dialogue::{Event, Outcome};
use crate::printing;
use cram::Evaluation;
use lisp::evaluator::aside::Aside;
use lisp::value::Value;
use lisp::value::function::Function;
use lisp::value::known;
use lisp::vm::step::Step;

/// The values of variables after an evaluation.
type Assigned = Rc<RefCell<Vec<Value>>>;

impl Evaluator {
    /// Evaluates a form in the selected frame of an interrupted plan.
    pub(super) fn evaluate_form_beside(
        &mut self,
        form: &Value,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        let InFrame {
            function,
            values,
            places,
            link,
        } = match self.in_frame(form) {
            Ok(in_frame) => in_frame,
            Err(raise) => return self.tell_raised(raise, sink),
        };
        let assigned = Assigned::default();
        let args = [values, vec![keep(&assigned), Aside::new().tag()]].concat();
        self.host.person.snapshots.set_aside(true);
        let evaluation = self.go_on_with(sink, |scheduler, image, host| {
            scheduler.call_beside(image, host, link, (function, args))
        });
        self.host.person.snapshots.set_aside(false);
        if let Some(fiber) = self.scheduler.stopped_fiber_at(link) {
            for (place, value) in places.iter().zip(assigned.take()) {
                place.set(fiber, value);
            }
        }
        let abort = match evaluation {
            Evaluation::Values(values) => return self.tell_aside(&values, sink),
            Evaluation::Unhandled(condition) => printing::describe(&mut self.image, &condition),
            Evaluation::Interrupted => interrupted(),
        };
        sink(Event::Aborted(Box::new(abort)));
        self.image.output.begin_line();
        Outcome::Aborted
    }
}

/// A function that keeps its arguments.
fn keep(assigned: &Assigned) -> Value {
    let assigned = Rc::clone(assigned);
    let keep = Function::made_control(known::SETQ, (0, None), move |_, values| {
        assigned.replace(values);
        Ok(Step::Return(Value::NIL))
    });
    Value::Function(keep)
}
