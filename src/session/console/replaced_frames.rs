//! Calls in the place of a frame: a value is returned from it, or it is restarted.

use super::evaluator::Evaluator;
use crate::dialogue::{Event, Outcome};
use cram::designator::perform::Performance;
use cram::packages;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::function::{Body, Function};
use lisp::value::known;
use lisp::vm::step::Step;

impl Evaluator {
    /// Leaves a frame and all that it has called, and calls a function in its place.
    pub(super) fn replace_frame(
        &mut self,
        frame: (usize, usize),
        function: Value,
        args: Vec<Value>,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        self.console.levels.pop();
        let evaluation = self.go_on_with(sink, |scheduler, image, host| {
            scheduler.replace_frame(image, host, frame, (function, args))
        });
        self.settle(evaluation, sink)
    }

    /// Returns the value of a form from the selected frame.
    pub(super) fn return_from_frame(
        &mut self,
        source_name: &str,
        text: &str,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        let (Some(form), Some(frame)) = (self.form_of(source_name, text), self.selected_frame())
        else {
            return self.tell("; One form was expected.", sink);
        };
        let outcome = self.evaluate_form_aside(&form, &mut |event| {
            if !matches!(event, Event::Values(_)) {
                sink(event);
            }
        });
        if outcome != Outcome::Finished {
            return outcome;
        }
        let value = self.image.special(known::TIMES).clone();
        let identity = Function::made_control(known::VALUES, (1, Some(1)), |_, args| {
            Ok(Step::Return(args.into_iter().next().unwrap_or_default()))
        });
        self.replace_frame(frame, Value::Function(identity), vec![value], sink)
    }

    /// Calls what the selected frame has called once more, in its place: a function with the present
    /// values of its parameters, in its newest definition, or the action that the frame performs.
    pub(super) fn restart_frame(&mut self, sink: &mut dyn FnMut(Event)) -> Outcome {
        let frames = self.frames();
        let selected = self.console.levels.last().map_or(0, |level| level.frame);
        let Some(told) = frames.get(selected) else {
            return self.tell("; There is no such frame.", sink);
        };
        let frame = (told.link, told.view.index);
        let annotation = told.view.annotation.as_ref();
        let call = match annotation.filter(|about| about.note.is::<Performance>()) {
            Some(about) => {
                let action = about.subject.clone();
                let perform = packages::symbol(&mut self.image, "CRAM-EXECUTIVE", "PERFORM");
                Some((perform.into(), vec![action]))
            }
            None => self.call_again(frame),
        };
        match call {
            Some((function, args)) => self.replace_frame(frame, function, args, sink),
            None => self.tell(
                "; This frame cannot be restarted, since its arguments are not known; \
                 :retry evaluates the whole form again.",
                sink,
            ),
        }
    }

    /// The call that restarts a frame of a function.
    fn call_again(&self, (link, index): (usize, usize)) -> Option<(Value, Vec<Value>)> {
        let fibers = self.scheduler.stopped_fibers();
        let (function, args) = fibers.get(link)?.call_of(index)?;
        let Body::Closure { code, .. } = &function.body else {
            return None;
        };
        // What is at the top level has no name.
        let name = Some(code.name.shown()).filter(|name| name.is_true())?;
        let function = newest_definition(&self.image, name).unwrap_or(Value::Function(function));
        Some((function, args))
    }
}

/// The name, if it is that of a function that is defined by name alone, and not by methods.
fn newest_definition(image: &Image, name: &Value) -> Option<Value> {
    let function = image.function(name.as_symbol()?)?;
    function.as_generic().is_none().then(|| name.clone())
}
