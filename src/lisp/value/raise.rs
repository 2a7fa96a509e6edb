//! Errors as builtins return them: the class of the condition, its report and its slots.
//! The machine turns them into condition objects and signals those.

use super::Value;
use super::symbol::{Sym, known};
use crate::guard::{MAX_ELEMENTS, Stopped, TooDeep, note_exhausted};
use crate::source::Place;
use closest_name::closest_name;

/// A condition that is to be signalled as by `error`.
#[derive(Clone)]
pub enum Raise {
    /// A condition object that exists already.
    Condition {
        condition: Value,
        /// The place of the form that a macro could not expand, if a macro signalled it.
        place: Place,
    },
    /// A condition still to be made.
    Make {
        class: Sym,
        /// The report; none if the class's own report says it.
        report: Option<String>,
        /// Values of its slots, by slot initarg keyword.
        initargs: Vec<(Sym, Value)>,
        /// The place of the error in the source, if a form and not a call is wrong.
        place: Place,
    },
}

/// A report as a sentence: with a full stop at its end, unless it ends like a sentence already.
pub fn sentence(report: impl std::fmt::Display) -> String {
    let mut text = report.to_string();
    if !text.ends_with(['.', '?', '!']) {
        text.push('.');
    }
    text
}

/// What follows a report that there is no key of a name: the one that is meant, or those that there are.
pub fn keys_hint<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    match closest_name(name, known.iter().copied()) {
        Some(near) => format!("; did you mean :{near}?"),
        None if known.is_empty() => String::new(),
        None => format!("; it has :{}", known.join(", :")),
    }
}

impl Raise {
    /// A condition of a class with a report.
    pub fn new(class: Sym, report: impl Into<String>) -> Box<Raise> {
        Box::new(Raise::Make {
            class,
            report: Some(report.into()),
            initargs: Vec::new(),
            place: Place::NONE,
        })
    }

    /// Adds the value of an initarg (a keyword) to a condition still to be made.
    pub fn with(mut self: Box<Self>, initarg: Sym, value: Value) -> Box<Raise> {
        if let Raise::Make { initargs, .. } = self.as_mut() {
            initargs.push((initarg, value));
        }
        self
    }

    /// The error with the place of the form it is about, unless it has one.
    pub fn at(mut self: Box<Self>, here: Place) -> Box<Raise> {
        let (Raise::Make { place, .. } | Raise::Condition { place, .. }) = self.as_mut();
        if !place.is_some() {
            *place = here;
        }
        self
    }

    /// The place of the form that the error is about, if it is about a form.
    pub fn place(&self) -> Place {
        match self {
            Raise::Make { place, .. } | Raise::Condition { place, .. } => *place,
        }
    }

    /// A condition object that exists already.
    pub fn condition(condition: Value) -> Box<Raise> {
        Box::new(Raise::Condition {
            condition,
            place: Place::NONE,
        })
    }

    /// A `SIMPLE-ERROR` that reports an error, as a sentence.
    pub fn reporting(error: impl std::fmt::Display) -> Box<Raise> {
        Raise::simple(sentence(error))
    }

    /// A `SIMPLE-ERROR` with a text.
    pub fn simple(report: impl Into<String>) -> Box<Raise> {
        Raise::new(known::SIMPLE_ERROR, report)
    }

    /// A `SIMPLE-PROGRAM-ERROR` with a text: a wrong form or a wrong call.
    pub fn program(report: impl Into<String>) -> Box<Raise> {
        Raise::new(known::SIMPLE_PROGRAM_ERROR, report)
    }

    /// A call with a keyword argument that the function does not have; says which there are, or which is meant; `shown` is its name as it is
    /// printed, `known` are the names of those that there are.
    pub fn unknown_key<'a>(shown: &str, known: impl IntoIterator<Item = &'a str>) -> Box<Raise> {
        let hint = keys_hint(shown.trim_start_matches(':'), known);
        Raise::program(format!("Unknown &KEY argument: {shown}{hint}"))
    }

    /// A `TYPE-ERROR`: `datum` is not of type `expected` (a type specifier).
    pub fn type_error(datum: &Value, expected: impl Into<Value>) -> Box<Raise> {
        Box::new(Raise::Make {
            class: known::TYPE_ERROR,
            report: None,
            initargs: vec![
                (known::K_DATUM, datum.clone()),
                (known::K_EXPECTED_TYPE, expected.into()),
            ],
            place: Place::NONE,
        })
    }

    /// The object that was given as a stream, if that is the error and it is one by its class.
    #[cold]
    pub(crate) fn stream_object(&self) -> Option<&Value> {
        let Raise::Make {
            class: known::TYPE_ERROR,
            initargs,
            ..
        } = self
        else {
            return None;
        };
        let [(_, object @ Value::Instance(instance)), (_, expected)] = initargs.as_slice() else {
            return None;
        };
        let is_stream = expected.as_symbol() == Some(known::STREAM) && instance.is_a(known::STREAM);
        is_stream.then_some(object)
    }

    /// An `UNBOUND-VARIABLE` error.
    pub(crate) fn unbound_variable(name: Sym) -> Box<Raise> {
        Box::new(Raise::Make {
            class: known::UNBOUND_VARIABLE,
            report: None,
            initargs: vec![(known::K_NAME, name.into())],
            place: Place::NONE,
        })
    }

    /// An `UNDEFINED-FUNCTION` error; the name is a symbol or `(setf symbol)`.
    pub fn undefined_function(name: Value) -> Box<Raise> {
        Box::new(Raise::Make {
            class: known::UNDEFINED_FUNCTION,
            report: None,
            initargs: vec![(known::K_NAME, name)],
            place: Place::NONE,
        })
    }

    /// Is it an interrupt that came in the middle of a call?
    pub fn is_interrupt(&self) -> bool {
        match self {
            Raise::Condition { condition, .. } => is_interrupt(condition),
            Raise::Make { class, .. } => *class == known::INTERACTIVE_INTERRUPT,
        }
    }

    /// A `CONTROL-ERROR` with a text.
    pub fn control(report: impl Into<String>) -> Box<Raise> {
        Raise::new(known::SIMPLE_CONTROL_ERROR, report)
    }
}

/// Is the condition an interrupt that came in the middle of a call?
pub fn is_interrupt(condition: &Value) -> bool {
    matches!(condition, Value::Instance(i) if i.class().name == known::INTERACTIVE_INTERRUPT)
}

impl From<TooDeep> for Box<Raise> {
    fn from(_: TooDeep) -> Box<Raise> {
        Raise::new(
            known::CONTROL_STACK_EXHAUSTED,
            "The form is nested too deeply to be compiled.",
        )
    }
}

impl From<Stopped> for Box<Raise> {
    fn from(reason: Stopped) -> Box<Raise> {
        if reason != Stopped::Interrupted {
            note_exhausted();
        }
        match reason {
            Stopped::Interrupted => Raise::new(known::INTERACTIVE_INTERRUPT, "Interrupted."),
            Stopped::HeapExhausted => Raise::new(
                known::HEAP_EXHAUSTED_ERROR,
                "Heap exhausted: more memory would be in use than --heap allows.",
            ),
            Stopped::TooLong => Raise::new(
                known::HEAP_EXHAUSTED_ERROR,
                format!("A sequence has at most {MAX_ELEMENTS} elements."),
            ),
        }
    }
}
