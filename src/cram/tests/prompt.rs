//! A prompt without a world, for tests of the plan language.

use std::convert::Infallible;

use crate::{Evaluation, NullHost, Scheduler};
use lisp::reader;
use lisp::value::known;
use lisp::{Image, evaluator::nested, print, value::Value};

/// An image with the plan language, in a package that uses it.
pub(crate) struct Prompt {
    pub(crate) image: Image,
    pub(crate) scheduler: Scheduler<Infallible>,
}

impl Prompt {
    pub(crate) fn new() -> Prompt {
        let mut image = Image::new();
        crate::install(&mut image);
        let mut prompt = Prompt {
            image,
            scheduler: Scheduler::new(),
        };
        for form in [
            "(defpackage :demo (:use :cpl))",
            "(in-package :demo)",
            "(define-condition f1 (simple-plan-failure) ((x :initarg :x :initform nil :reader f1-x)))",
            "(define-condition f2 (f1) ())",
            "(define-condition f3 (plan-failure) () (:report \"f3 report text\"))",
            "(defmacro tl (&body body) `(top-level ,@body))",
            "(defvar *never* (make-fluent :name 'never))",
        ] {
            prompt.eval(form);
        }
        prompt
    }

    fn shown(&mut self, value: &Value, function: lisp::Sym) -> String {
        nested::call_nested(&mut self.image, function.into(), vec![value.clone()])
            .ok()
            .and_then(|text| text.as_text())
            .unwrap_or_else(|| print::to_string(&self.image, value, true))
    }

    /// What the prompt shows for the forms of a text: what is printed, ` | `, and the
    /// values of the last one, or `!! CLASS report` for a condition that nobody handles.
    pub(crate) fn eval(&mut self, text: &str) -> String {
        let source = self.image.sources.add("test", text);
        let mut reader = reader::Reader::new(&self.image, source);
        let mut result = String::new();
        let mut printed = String::new();
        while let Some((form, _)) = reader
            .next_form(&mut self.image)
            .unwrap_or_else(|e| panic!("{text}: {e}"))
        {
            let evaluation = self
                .scheduler
                .evaluate(&mut self.image, &mut NullHost, &form);
            result = match evaluation {
                Evaluation::Values(values) => {
                    let values: Vec<String> = values
                        .iter()
                        .map(|v| self.shown(v, known::PRIN1_TO_STRING))
                        .collect();
                    values.join(" ; ")
                }
                Evaluation::Unhandled(condition) => {
                    let report = self.shown(&condition, known::PRINC_TO_STRING);
                    let class = match &condition {
                        Value::Instance(i) => self.image.name(i.class().name).to_owned(),
                        _ => "?".to_owned(),
                    };
                    self.scheduler.abort(&mut self.image, &mut NullHost);
                    format!("!! {class} {report}")
                }
                Evaluation::Interrupted => {
                    self.scheduler.abort(&mut self.image, &mut NullHost);
                    "interrupted".to_owned()
                }
            };
            printed.push_str(&self.image.output.take());
        }
        if printed.is_empty() {
            result
        } else {
            format!("{} | {result}", printed.trim_end())
        }
    }
}

/// Evaluates each form at a prompt of its own, and compares what is shown.
#[allow(dead_code)]
pub(crate) fn check(rows: &[(&str, &str)]) {
    let mut wrong = Vec::new();
    for (form, expected) in rows {
        // Line breaks are the printer's business.
        let shown = in_one_line(&Prompt::new().eval(form));
        let fits = match expected.strip_suffix('…') {
            Some(start) => shown.starts_with(&in_one_line(start)),
            None => shown == in_one_line(expected),
        };
        if !fits {
            wrong.push(format!("{form}\n  gave     {shown}\n  expected {expected}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[allow(dead_code)]
fn in_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
