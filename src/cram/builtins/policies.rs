//! Policies: conditions that are watched while a body runs. The Lisp library implements them.

use crate::Result;
use crate::state::Plan;
use lisp::builtin::{Builtin, pure};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::copy::Copier;
use lisp::value::foreign::{Foreign, ForeignCopy, PrintContext};
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

/// A policy.
pub(crate) struct Policy {
    name: Value,
    parameters: Value,
    doc: Value,
    /// A property list of functions that take a storage and the parameters.
    parts: Value,
    type_symbol: Sym,
}

impl Foreign for Policy {
    fn copied(&self, copier: &mut Copier) -> ForeignCopy {
        ForeignCopy::New(Box::new(Policy {
            name: copier.value(&self.name),
            parameters: copier.value(&self.parameters),
            doc: copier.value(&self.doc),
            parts: copier.value(&self.parts),
            type_symbol: self.type_symbol,
        }))
    }

    fn type_symbol(&self) -> Sym {
        self.type_symbol
    }

    fn print(&self, context: &dyn PrintContext, _: bool) -> String {
        let name = context.text(&self.name, true);
        format!("#<POLICY {name}>")
    }
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "PARAMETERS",
        "policy",
        "The names of a policy's parameters.",
        &[],
        |image, args| Ok(policy(image, &args[0])?.parameters.clone()),
    ),
    pure(
        "DESCRIPTION",
        "policy",
        "The documentation of a policy.",
        &[],
        |image, args| Ok(policy(image, &args[0])?.doc.clone()),
    ),
];

/// Builtins of package `PLAN-SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = &[
    pure(
        "MAKE-POLICY",
        "name parameters doc parts",
        "A policy with a property list of functions.",
        &[],
        |image, args| {
            Ok(Value::foreign(Policy {
                name: args[0].clone(),
                parameters: args[1].clone(),
                doc: args[2].clone(),
                parts: args[3].clone(),
                type_symbol: Plan::of(image).names.policy,
            }))
        },
    ),
    pure(
        "POLICY-PARTS",
        "policy",
        "The functions of a policy by the names of its parts.",
        &[],
        |image, args| Ok(policy(image, &args[0])?.parts.clone()),
    ),
];

fn policy<'a>(image: &Image, value: &'a Value) -> Result<&'a Policy> {
    value
        .as_foreign::<Policy>()
        .ok_or_else(|| Raise::type_error(value, Plan::of(image).names.policy))
}

/// The name of a policy, if the value is one.
pub(super) fn policy_name(value: &Value) -> Option<Value> {
    value.as_foreign::<Policy>().map(|p| p.name.clone())
}
