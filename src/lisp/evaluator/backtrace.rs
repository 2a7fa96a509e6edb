//! The stack frames of a suspended fiber, as a debugger shows them: what was called with which
//! arguments, and the variables in scope.

use std::rc::Rc;

use crate::source::Place;
use crate::value::Value;
use crate::value::function::{Body, Function};
use crate::value::symbol::Sym;
use crate::vm::calls::Annotation;
use crate::vm::fiber::Fiber;
use crate::vm::frames::{Frame, FrameKind};

/// Frames that are shown at either end of the stack.
const MAX_AT_AN_END: usize = 5_000;

/// A stack frame as the user sees it.
pub struct FrameView {
    /// Its index in the fiber, outermost first.
    pub index: usize,
    /// What was called: a symbol, `(setf name)`, `(lambda …)`; a text for a builtin.
    pub name: Value,
    /// The parameters that are known, in order.
    pub arguments: Vec<Value>,
    /// The source place that it was executing.
    pub place: Place,
    /// What the layer that made the call says about it.
    pub annotation: Option<Rc<Annotation>>,
}

impl FrameView {
    /// A frame of which nothing can be said.
    fn unknown(index: usize) -> FrameView {
        FrameView {
            index,
            name: Value::NIL,
            arguments: Vec::new(),
            place: Place::NONE,
            annotation: None,
        }
    }
}

/// A variable of a frame.
pub struct Variable {
    pub name: Sym,
    /// Its value; unbound for a parameter that was not supplied.
    pub value: Value,
    place: VariablePlace,
}

/// Where a variable is stored.
#[derive(Clone)]
pub enum VariablePlace {
    /// On the value stack, counted from its bottom.
    Stack(usize),
    /// In a closure that cannot be changed.
    Closure,
    /// In a box.
    Cell(Value),
}

impl Variable {
    /// Where it is stored.
    pub fn place(&self) -> VariablePlace {
        self.place.clone()
    }
}

impl VariablePlace {
    /// Assigns a variable of a fiber.
    pub fn set(&self, fiber: &mut Fiber, value: Value) {
        match self {
            VariablePlace::Stack(at) => {
                if let Some(place) = fiber.stack.get_mut(*at) {
                    *place = value;
                }
            }
            VariablePlace::Cell(Value::Cell(cell)) => cell.set(value),
            VariablePlace::Cell(_) | VariablePlace::Closure => {}
        }
    }
}

impl Fiber {
    /// The frames, innermost first; of very many, those at both ends.
    pub fn views(&self) -> Vec<FrameView> {
        let inner = self.frames.len().saturating_sub(MAX_AT_AN_END);
        let frames = self.frames.iter().enumerate().rev();
        frames
            .filter(|(index, _)| *index < MAX_AT_AN_END || *index >= inner)
            .map(|(index, frame)| self.view(index, frame))
            .collect()
    }

    fn view(&self, index: usize, frame: &Frame) -> FrameView {
        match &frame.kind {
            FrameKind::Native { then, .. } => FrameView {
                index,
                name: then.name().into(),
                arguments: then
                    .annotation()
                    .iter()
                    .map(|a| a.subject.clone())
                    .collect(),
                place: Place::NONE,
                annotation: then.annotation().cloned(),
            },
            FrameKind::Code { function, pc } => match &function.body {
                Body::Closure { code, .. } => {
                    let count = code.parameters.slots();
                    let values = self.stack.iter().skip(frame.base).take(count);
                    let values = values.map(|value| match value {
                        Value::Cell(cell) => cell.get(),
                        other => other.clone(),
                    });
                    FrameView {
                        index,
                        name: code.name.value(),
                        arguments: values.filter(|value| !value.is_unbound()).collect(),
                        place: code.place_at(pc.get().saturating_sub(1)),
                        annotation: None,
                    }
                }
                _ => FrameView::unknown(index),
            },
            FrameKind::Over => FrameView::unknown(index),
        }
    }

    /// The function of a frame, and the arguments that would call it with the present values of its
    /// parameters; none for frames of builtins.
    pub fn call_of(&self, frame: usize) -> Option<(Rc<Function>, Vec<Value>)> {
        let frame = self.frames.get(frame)?;
        let FrameKind::Code { function, .. } = &frame.kind else {
            return None;
        };
        let Body::Closure { code, .. } = &function.body else {
            return None;
        };
        let parameters = &code.parameters;
        let slots = self.stack.iter().skip(frame.base);
        let mut values = slots.map(|value| seen(value, VariablePlace::Closure).0);
        let positional = usize::from(parameters.required) + usize::from(parameters.optional);
        let mut args: Vec<Value> = values.by_ref().take(positional).collect();
        if parameters.rest {
            // With keys, these are among the rest.
            args.extend(values.next()?.iter_list());
        } else {
            for (key, value) in parameters.keys.iter().zip(values) {
                if !value.is_unbound() {
                    args.extend([(*key).into(), value]);
                }
            }
        }
        let supplied = args.iter().take_while(|arg| !arg.is_unbound()).count();
        args.truncate(supplied);
        Some((Rc::clone(function), args))
    }

    /// The variables in scope in a frame; of several with one name, the innermost.
    pub fn variables(&self, frame: usize) -> Vec<Variable> {
        let Some(frame) = self.frames.get(frame) else {
            return Vec::new();
        };
        let FrameKind::Code { function, pc } = &frame.kind else {
            return Vec::new();
        };
        let Body::Closure { code, captured } = &function.body else {
            return Vec::new();
        };
        let Some(content) = code.content() else {
            return Vec::new();
        };
        let pc = u32::try_from(pc.get().saturating_sub(1)).unwrap_or(u32::MAX);
        let mut found: Vec<Variable> = Vec::new();
        let locals = content.locals.iter().rev();
        for local in locals.filter(|local| local.from <= pc && pc < local.to) {
            let at = frame.base + local.slot as usize;
            let Some(value) = self.stack.get(at) else {
                continue;
            };
            let (value, place) = seen(value, VariablePlace::Stack(at));
            add(&mut found, local.name, value, place);
        }
        found.reverse();
        for (name, value) in content.free.iter().zip(captured) {
            let (value, place) = seen(value, VariablePlace::Closure);
            add(&mut found, *name, value, place);
        }
        found
    }
}

fn seen(value: &Value, place: VariablePlace) -> (Value, VariablePlace) {
    match value {
        Value::Cell(cell) => (cell.get(), VariablePlace::Cell(value.clone())),
        other => (other.clone(), place),
    }
}

fn add(to: &mut Vec<Variable>, name: Sym, value: Value, place: VariablePlace) {
    if !to.iter().any(|known| known.name == name) {
        to.push(Variable { name, value, place });
    }
}
