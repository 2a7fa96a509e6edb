//! Evaluating forms in a stack frame of a stopped evaluation.

use super::evaluator::Evaluator;
use super::stopped::Cause;
use crate::dialogue::{Event, Outcome};
use crate::printing;
use lisp::compile;
use lisp::evaluator::aside::Aside;
use lisp::evaluator::backtrace::VariablePlace;
use lisp::reader::Reader;
use lisp::value::Value;
use lisp::value::function::Function;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::symbol::{Sym, VariableKind};

/// A function of the variables of a frame, a function that assigns them, and a tag.
pub(super) struct InFrame {
    pub(super) function: Value,
    /// The values of the variables.
    pub(super) values: Vec<Value>,
    /// Where these are stored.
    pub(super) places: Vec<VariablePlace>,
    /// Index of the fiber to which the frame belongs.
    pub(super) link: usize,
}

impl Evaluator {
    /// Evaluates forms in the selected frame, up to the first that does not return.
    pub(super) fn evaluate_aside(
        &mut self,
        source_name: &str,
        text: &str,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        let forms = match self.forms_of(source_name, text) {
            Ok(forms) => forms,
            Err(abort) => {
                sink(Event::Aborted(abort));
                self.image.output.begin_line();
                return Outcome::Aborted;
            }
        };
        let mut outcome = Outcome::Finished;
        for form in forms {
            outcome = match self.console.answer_to_interrupt() {
                Some(_) => self.evaluate_form_beside(&form, sink),
                None => self.evaluate_form_aside(&form, sink),
            };
            if outcome != Outcome::Finished {
                break;
            }
        }
        outcome
    }

    fn forms_of(
        &mut self,
        source_name: &str,
        text: &str,
    ) -> Result<Vec<Value>, Box<crate::dialogue::Abort>> {
        let source = self.image.sources.add(source_name, text);
        let mut reader = Reader::new(&self.image, source);
        let mut forms = Vec::new();
        while let Some(form) = self.read_form(&mut reader)? {
            forms.push(form);
        }
        Ok(forms)
    }

    /// The one form of a text.
    pub(super) fn form_of(&mut self, source_name: &str, text: &str) -> Option<Value> {
        let forms = self.forms_of(source_name, text).ok()?;
        let mut forms = forms.into_iter();
        let first = forms.next()?;
        forms.next().is_none().then_some(first)
    }

    /// Evaluates a form in the selected frame.
    pub(super) fn evaluate_form_aside(
        &mut self,
        form: &Value,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        let aside = Aside::new();
        let Some(Cause::Condition(condition)) = self.console.levels.last().map(|l| &l.cause) else {
            return Outcome::Aborted;
        };
        let condition = condition.clone();
        let in_frame = match self.in_frame(form) {
            Ok(in_frame) => in_frame,
            Err(raise) => return self.tell_raised(raise, sink),
        };
        let InFrame {
            function,
            values,
            mut places,
            link,
        } = in_frame;
        if link > 0 {
            // Variables on other tasks' stacks cannot be assigned from here.
            for place in &mut places {
                if matches!(place, VariablePlace::Stack(_)) {
                    *place = VariablePlace::Closure;
                }
            }
        }
        let args = [values, vec![store(places), aside.tag()]].concat();
        let call = aside.call(condition, function, args);
        if let Some(level) = self.console.levels.last_mut() {
            level.aside = Some(aside);
        }
        self.host.person.snapshots.set_aside(true);
        let evaluation = self.go_on_with(sink, |scheduler, image, host| {
            scheduler.call(image, host, call, Vec::new())
        });
        self.host.person.snapshots.set_aside(false);
        self.settle(evaluation, sink)
    }

    /// Reports an error that has come before the evaluation of a form.
    pub(super) fn tell_raised(
        &mut self,
        raise: Box<Raise>,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        let abort = printing::raised(&mut self.image, raise);
        sink(Event::Aborted(Box::new(abort)));
        self.image.output.begin_line();
        Outcome::Aborted
    }

    /// The form as the body of a function of the selected frame's variables:
    /// `(lambda (variable… store tag)
    ///    (catch tag (multiple-value-prog1 form (funcall store variable…))))`.
    pub(super) fn in_frame(&mut self, form: &Value) -> Result<InFrame, Box<Raise>> {
        let (link, frame) = self.selected_frame().unwrap_or((0, usize::MAX));
        let fibers = self.scheduler.stopped_fibers();
        let variables = fibers.get(link).map(|fiber| fiber.variables(frame));
        let mut names: Vec<Value> = Vec::new();
        let mut values = Vec::new();
        let mut places = Vec::new();
        for variable in variables.unwrap_or_default() {
            let is_lexical = self.image.symbol(variable.name).kind == VariableKind::Lexical;
            if !is_lexical || variable.value.is_unbound() || self.image.is_keyword(variable.name) {
                continue;
            }
            names.push(variable.name.into());
            places.push(variable.place());
            values.push(variable.value);
        }
        let lambda = self.lambda(form, names);
        let function = compile::compile_lambda(&mut self.image, &lambda)?;
        Ok(InFrame {
            function: Value::Function(function),
            values,
            places,
            link,
        })
    }

    fn lambda(&mut self, form: &Value, names: Vec<Value>) -> Value {
        let mut fresh = |name| -> Value { self.image.make_symbol(name).into() };
        let (store, tag) = (fresh("STORE"), fresh("TAG"));
        let list = |items: Vec<Value>| Value::list(items);
        let call = |operator: Sym, rest: Vec<Value>| list([vec![operator.into()], rest].concat());
        let parameters = [names.clone(), vec![store.clone(), tag.clone()]].concat();
        let stored = call(known::FUNCALL, [vec![store], names].concat());
        let body = call(known::MULTIPLE_VALUE_PROG1, vec![form.clone(), stored]);
        let caught = call(known::CATCH, vec![tag, body]);
        call(known::LAMBDA, vec![list(parameters), caught])
    }
}

/// A function that assigns the variables.
fn store(places: Vec<VariablePlace>) -> Value {
    let store = Function::made_control(known::SETQ, (0, None), move |machine, values| {
        for (place, value) in places.iter().zip(values) {
            place.set(machine.fiber, value);
        }
        Ok(lisp::vm::step::Step::Return(Value::NIL))
    });
    Value::Function(store)
}
