//! Policies: conditions that are watched while a body runs. The Lisp library implements them.

use crate::Result;
use crate::state::Plan;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::FromValue;
use lisp::typed::{self, builtin, builtins};
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

    fn may_be_in_circle(&self) -> bool {
        true
    }

    fn for_each_reference(&self, visit: &mut dyn FnMut(&Value)) {
        for part in [&self.name, &self.parameters, &self.doc, &self.parts] {
            visit(part);
        }
    }

    fn type_symbol(&self) -> Sym {
        self.type_symbol
    }

    fn print(&self, context: &dyn PrintContext, _: bool) -> String {
        let name = context.text(&self.name, true);
        format!("#<POLICY {name}>")
    }
}

/// The names of a policy's parameters.
#[builtin]
fn parameters(policy: &Policy) -> Result<Value> {
    Ok(policy.parameters.clone())
}

/// The documentation of a policy.
#[builtin]
fn description(policy: &Policy) -> Result<Value> {
    Ok(policy.doc.clone())
}

/// A policy with a property list of functions.
#[builtin(_, "name parameters doc parts")]
fn make_policy(
    image: &mut Image,
    name_value: Value,
    parameters_value: Value,
    doc_value: Value,
    parts_value: Value,
) -> Result<Value> {
    Ok(Value::foreign(Policy {
        name: name_value,
        parameters: parameters_value,
        doc: doc_value,
        parts: parts_value,
        type_symbol: Plan::of(image).names.policy,
    }))
}

/// The functions of a policy by the names of its parts.
#[builtin]
fn policy_parts(policy: &Policy) -> Result<Value> {
    Ok(policy.parts.clone())
}

impl<'a> FromValue<'a> for &'a Policy {
    fn from_value(image: &mut Image, value: &'a Value) -> Result<Self> {
        policy(image, value)
    }
}

fn policy<'a>(image: &Image, value: &'a Value) -> Result<&'a Policy> {
    value
        .as_foreign::<Policy>()
        .ok_or_else(|| Raise::type_error(value, Plan::of(image).names.policy))
}

/// The name of a policy, if the value is one.
pub(super) fn policy_name(value: &Value) -> Option<Value> {
    value.as_foreign::<Policy>().map(|p| p.name.clone())
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![parameters, description,];

/// Builtins of package `PLAN-SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![make_policy, policy_parts,];
