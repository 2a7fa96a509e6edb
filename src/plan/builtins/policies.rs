//! Policies: conditions that are watched while a body runs.

use std::rc::Rc;

use crate::lisp::builtin::{Builtin, control, pure};
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::foreign::{Foreign, PrintContext};
use crate::lisp::value::hash_table::{HashTable, HashTest};
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;
use crate::plan::Result;
use crate::plan::state::Plan;

/// A policy.
pub(crate) struct Policy {
    name: Value,
    parameters: Value,
    doc: Value,
    /// Functions of a storage and the parameters, or `NIL`: init, check, recover, clean-up.
    parts: [Value; 4],
    type_symbol: Sym,
}

impl Foreign for Policy {
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
    control(
        "NAMED-POLICY",
        "name",
        "The policy of a name; fails with POLICY-NOT-FOUND.",
        &[],
        named_policy,
    ),
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
        "name parameters doc init check recover clean-up",
        "A policy.",
        &[],
        |image, args| {
            Ok(Value::foreign(Policy {
                name: args[0].clone(),
                parameters: args[1].clone(),
                doc: args[2].clone(),
                parts: [3, 4, 5, 6].map(|i| args[i].clone()),
                type_symbol: Plan::of(image).names.policy,
            }))
        },
    ),
    pure(
        "REGISTER-POLICY",
        "policy",
        "Makes a policy known by its name.",
        &[],
        |image, args| {
            let Some(name) = policy(image, &args[0])?.name.as_symbol() else {
                return Err(Raise::type_error(&args[0], known::SYMBOL));
            };
            let plan = Plan::of(image);
            plan.policies.borrow_mut().insert(name, args[0].clone());
            Ok(args[0].clone())
        },
    ),
    pure(
        "POLICY-PART",
        "policy part",
        "The function of a part of a policy: 0 init, 1 check, 2 recover, 3 clean-up; NIL if there is none.",
        &[],
        |image, args| {
            let parts = &policy(image, &args[0])?.parts;
            let i = match args[1] {
                Value::Int(i) => usize::try_from(i).unwrap_or(usize::MAX),
                _ => usize::MAX,
            };
            Ok(parts.get(i).cloned().unwrap_or(Value::NIL))
        },
    ),
    pure(
        "POLICY-NAME",
        "policy",
        "The name of a policy.",
        &[],
        |image, args| Ok(policy(image, &args[0])?.name.clone()),
    ),
    pure(
        "STORAGE",
        "&optional table symbol value",
        "A new storage of a policy, the value of a symbol in it, or a new value.",
        &[],
        storage,
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

fn named_policy(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    let plan = Plan::of(machine.image);
    let policies = plan.policies.borrow();
    let found = args[0].as_symbol().and_then(|name| policies.get(&name));
    Ok(match found {
        Some(policy) => Step::Return(policy.clone()),
        None => Step::TailCall {
            function: plan.names.fail.into(),
            args: vec![
                plan.names.policy_not_found.into(),
                plan.names.name.into(),
                args[0].clone(),
            ],
        },
    })
}

fn storage(_: &mut Image, args: &[Value]) -> Result<Value> {
    let Some(table) = args.first() else {
        return Ok(Value::Hash(Rc::new(HashTable::new(HashTest::Eql))));
    };
    let Value::Hash(table) = table else {
        return Err(Raise::type_error(table, known::HASH_TABLE));
    };
    let key = args.get(1).cloned().unwrap_or(Value::NIL);
    match args.get(2) {
        Some(value) => {
            table.insert(key, value.clone());
            Ok(value.clone())
        }
        None => Ok(table.get(&key).unwrap_or(Value::NIL)),
    }
}
