//! The conditions signalled when a designator cannot be resolved.

use crate::packages;
use lisp::image::Image;
use lisp::object::define::ClassDefinition;
use lisp::print;
use lisp::value::Value;
use lisp::value::class::{ClassKind, Initform, SlotDefinition};
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

/// Defines the condition classes. If the failures of the plan language have not been defined,
/// errors take their place.
pub fn define(image: &mut Image) {
    let error = packages::symbol(image, "CRAM-DESIGNATORS", "DESIGNATOR-ERROR");
    let slots = ["DESIGNATOR", "REASON", "SUGGESTION"].map(|name| slot(image, name));
    define_class(image, error, vec![known::SIMPLE_ERROR], slots.to_vec());
    let mut parents = vec![error];
    if let Some(failure) = plan_failure(image) {
        parents.insert(0, failure);
    }
    for name in [
        "DESIGNATOR-REFERENCE-FAILURE",
        "DESIGNATOR-GOAL-PARSING-FAILURE",
    ] {
        let name = packages::symbol(image, "CRAM-EXECUTIVE", name);
        define_class(image, name, parents.clone(), Vec::new());
    }
}

fn slot(image: &mut Image, name: &str) -> SlotDefinition {
    let sym = packages::symbol(image, "CRAM-DESIGNATORS", name);
    let mut slot = SlotDefinition::new(sym);
    slot.initargs.push(image.keyword(name));
    slot.initform = Some(Initform::Value(Value::NIL));
    slot
}

fn define_class(image: &mut Image, name: Sym, superclasses: Vec<Sym>, slots: Vec<SlotDefinition>) {
    // The superclasses have been defined.
    let _ = image.define_unchecked(ClassDefinition {
        name,
        kind: ClassKind::Condition,
        superclasses,
        slots,
        default_initargs: Vec::new(),
        doc: None,
    });
}

/// The class of plain plan failures, if the plan language is present.
fn plan_failure(image: &Image) -> Option<Sym> {
    ["CRAM-LANGUAGE", "CRAM-LANGUAGE-IMPLEMENTATION"]
        .into_iter()
        .filter_map(|package| image.packages.find(package))
        .filter_map(|package| image.packages.find_symbol(package, "SIMPLE-PLAN-FAILURE"))
        .map(|(sym, _)| sym)
        .find(|sym| image.class(*sym).is_some())
}

fn with_data(
    image: &mut Image,
    raise: Box<Raise>,
    designator: &Value,
    reason: &str,
    suggestion: Option<&str>,
) -> Box<Raise> {
    let [k_designator, k_reason, k_suggestion] =
        ["DESIGNATOR", "REASON", "SUGGESTION"].map(|n| image.keyword(n));
    let mut raise = raise.with(k_designator, designator.clone());
    if !reason.is_empty() {
        raise = raise.with(k_reason, reason.into());
    }
    if let Some(suggestion) = suggestion {
        raise = raise.with(k_suggestion, suggestion.into());
    }
    raise
}

/// Why a designator cannot be resolved.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub(crate) struct Unresolved {
    /// A sentence; empty if nothing is known.
    pub reason: String,
    /// The name that was probably meant.
    pub suggestion: Option<String>,
}

impl Unresolved {
    /// A reason without a suggestion.
    pub(crate) fn new(reason: impl Into<String>) -> Unresolved {
        Unresolved {
            reason: reason.into(),
            suggestion: None,
        }
    }
}

/// The failure of `perform`: "Designator … could not be resolved."
pub(crate) fn reference_failure(
    image: &mut Image,
    designator: &Value,
    why: &Unresolved,
) -> Box<Raise> {
    let class = packages::symbol(image, "CRAM-EXECUTIVE", "DESIGNATOR-REFERENCE-FAILURE");
    let shown = print::to_string(image, designator, false);
    let text = format!("Designator {shown} could not be resolved.\n{}", why.reason);
    let raise = Raise::new(class, text);
    let suggestion = why.suggestion.as_deref();
    with_data(image, raise, designator, &why.reason, suggestion)
}

/// A `DESIGNATOR-ERROR` with a text, and the reason on a separate line.
pub(crate) fn designator_error(
    image: &mut Image,
    designator: &Value,
    text: &str,
    why: &Unresolved,
) -> Box<Raise> {
    let class = packages::symbol(image, "CRAM-DESIGNATORS", "DESIGNATOR-ERROR");
    let text = match why.reason.is_empty() {
        true => text.to_owned(),
        false => format!("{text}\n{}", why.reason),
    };
    let raise = Raise::new(class, text);
    let suggestion = why.suggestion.as_deref();
    with_data(image, raise, designator, &why.reason, suggestion)
}

/// The failure for a motion that no process module carries out.
pub fn no_process_module(image: &mut Image, shown: &str) -> Box<Raise> {
    let class = plan_failure(image).unwrap_or(known::SIMPLE_ERROR);
    Raise::new(
        class,
        format!("No matching process module found for {shown}"),
    )
}

/// A plain plan failure with a text.
pub(crate) fn simple_failure(image: &mut Image, text: String) -> Box<Raise> {
    let class = plan_failure(image).unwrap_or(known::SIMPLE_ERROR);
    Raise::new(class, text)
}
