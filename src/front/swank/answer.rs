//! What becomes of an evaluation that a client has asked for.

use super::definitions::location;
use super::sexp::Sexp;
use session::dialogue::{Finding, ObjectNumber, Severity};

/// How a request that evaluates is answered.
pub(super) enum Answer {
    /// Output and values are shown in the buffer of the prompt, each value as something that can
    /// be pointed at, if wanted; the answer itself is empty.
    Prompt { presents: bool },
    /// The values on one line.
    Values,
    /// The output and the values, as two strings.
    OutputAndValues,
    /// The values, each on a line.
    Lines,
    /// What was printed.
    Printed,
    /// The name of what was loaded.
    Loaded,
    /// That it was compiled, with what the checks have found.
    Compiled(Compiled),
    /// The inspector for the value.
    Inspector,
    /// Nothing.
    Nothing,
}

/// What the checks of a text have found.
pub(super) struct Compiled {
    pub(super) findings: Vec<Finding>,
    /// When it began, for the time that is told.
    pub(super) began: std::time::Instant,
}

/// What an evaluation has yielded so far.
#[derive(Default)]
pub(super) struct Yield {
    /// The values of the last form, as printed.
    pub(super) values: Vec<String>,
    /// The number of the first value of the last form.
    pub(super) object: Option<ObjectNumber>,
    /// What was printed, if that is wanted.
    pub(super) printed: String,
}

impl Answer {
    /// Whether output belongs to the answer instead of being shown.
    pub(super) fn takes_output(&self) -> bool {
        matches!(self, Answer::Printed | Answer::OutputAndValues)
    }

    /// Whether what the evaluation leaves behind in variables such as `*` and `*package*` stays.
    pub(super) fn is_of_prompt(&self) -> bool {
        matches!(self, Answer::Prompt { .. })
    }

    /// The value of the request, once the evaluation has ended; the inspector's is made by others.
    pub(super) fn value(&self, yielded: &Yield) -> Sexp {
        match self {
            Answer::Prompt { .. } | Answer::Inspector | Answer::Nothing => Sexp::NIL,
            Answer::Values => match yielded.values.as_slice() {
                [] => "; No value".into(),
                values => format!("=> {}", values.join(", ")).into(),
            },
            Answer::OutputAndValues => Sexp::list([
                yielded.printed.as_str().into(),
                yielded.values.join("\n").into(),
            ]),
            Answer::Lines => yielded.values.join("\n").into(),
            Answer::Printed => yielded.printed.as_str().into(),
            Answer::Loaded => "T".into(),
            Answer::Compiled(compiled) => compiled.value(),
        }
    }
}

impl Compiled {
    /// Whether nothing was found that cannot be evaluated.
    pub(super) fn succeeds(&self) -> bool {
        let mut findings = self.findings.iter();
        findings.all(|finding| finding.severity != Severity::Error)
    }

    /// `(:compilation-result …)`.
    pub(super) fn value(&self) -> Sexp {
        let notes = self.findings.iter().map(|finding| {
            let severity = match finding.severity {
                Severity::Error => ":error",
                Severity::Warning => ":warning",
            };
            Sexp::properties([
                ("message", finding.message.trim_end().into()),
                ("severity", Sexp::symbol(severity)),
                ("location", location(finding.place.as_ref())),
            ])
        });
        let seconds = format!("{:.3}", self.began.elapsed().as_secs_f64());
        Sexp::list([
            Sexp::symbol(":compilation-result"),
            Sexp::list(notes),
            Sexp::boolean(self.succeeds()),
            Sexp::Symbol(seconds),
            Sexp::NIL,
            Sexp::NIL,
        ])
    }
}
