//! The special operators that bind variables: `let`, `multiple-value-bind`, `progv` and their kin.

use super::analyze::{Compiled, Compiler};
use super::body::parse_body;
use super::node::{Binding, Node};
use super::scope::{DynamicKind, Entry, Scope, VariableMeaning};
use crate::print;
use crate::value::Value;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

pub(super) fn let_form(
    c: &mut Compiler<'_>,
    rest: &Value,
    scope: &Scope,
    sequential: bool,
) -> Compiled<Node> {
    let body = parse_body(&rest.cdr_or_nil(), false);
    let Some(specs) = rest.car_or_nil().list_to_vec() else {
        return Err(c.program_error(
            "Malformed LET bindings: what was expected is (let ((variable value)…) body…).",
        ));
    };
    let mut bindings = Vec::new();
    let mut bound = Vec::new();
    let mut inner = scope.clone();
    let depth = c.dynamic_depth();
    for spec in &specs {
        let (name, init) = binding_parts(c, spec)?;
        if let ([variable, value], true) = (&*specs, name.as_symbol().is_none()) {
            return Err(unparenthesized(c, variable, value));
        }
        let name = c.check_bindable(&name)?;
        if !sequential && bound.contains(&name) {
            return Err(occurs_twice(c, "variable", name, "LET"));
        }
        let init = if sequential {
            c.analyze(&init, &inner.clone())?
        } else {
            c.analyze(&init, scope)?
        };
        let (binding, next) = c.bind(name, body.specials.contains(&name), &inner);
        if sequential && matches!(binding, Binding::Special(_)) {
            c.open_dynamic(DynamicKind::Plain);
        }
        inner = next;
        bound.push(name);
        bindings.push((binding, init));
    }
    if !sequential {
        for (binding, _) in &bindings {
            if matches!(binding, Binding::Special(_)) {
                c.open_dynamic(DynamicKind::Plain);
            }
        }
    }
    let node = c.analyze_body(&body, &bound, &inner);
    c.close_dynamic(depth);
    let list = rest.car_or_nil();
    for (spec, (binding, _)) in specs.iter().zip(&bindings) {
        c.note_unread(binding, &[spec, &list], &body);
    }
    Ok(Node::Let {
        bindings,
        sequential,
        body: Box::new(node?),
    })
}

/// The error for a name that a form binds twice at once.
pub(super) fn occurs_twice(c: &Compiler<'_>, what: &str, name: Sym, operator: &str) -> Box<Raise> {
    let name = print::to_string(c.image, &name.into(), true);
    c.program_error(format!(
        "The {what} {name} occurs more than once in the {operator}."
    ))
}

/// Signals an error if specifications of a form that binds names have a name twice.
pub(super) fn check_names(
    c: &Compiler<'_>,
    specs: &Value,
    what: &str,
    operator: &str,
) -> Compiled<()> {
    let mut names = Vec::new();
    for spec in specs.iter_list() {
        let name = spec.car_or_nil();
        if names.iter().any(|other: &Value| {
            other.is_eql(&name)
                || other
                    .setf_name()
                    .is_some_and(|of| name.setf_name() == Some(of))
        }) {
            let name = print::to_string(c.image, &name, true);
            return Err(c.program_error(format!(
                "The {what} {name} occurs more than once in the {operator}."
            )));
        }
        names.push(name);
    }
    Ok(())
}

/// The error for `(let (x 1) …)`.
fn unparenthesized(c: &Compiler<'_>, variable: &Value, value: &Value) -> Box<Raise> {
    let shown = |value| print::to_string(c.image, value, true);
    let (variable, value) = (shown(variable), shown(value));
    c.program_error(format!(
        "The LET bindings ({variable} {value}) are malformed: a binding has parentheses of its own, (({variable} {value}))."
    ))
}

fn binding_parts(c: &Compiler<'_>, spec: &Value) -> Compiled<(Value, Value)> {
    match spec {
        Value::Cons(cons) => {
            let rest = cons.cdr();
            if !rest.cdr_or_nil().is_nil() {
                let shown = print::to_string(c.image, spec, true);
                return Err(c.program_error(format!(
                    "The LET binding spec {shown} is malformed: (variable value) was expected."
                )));
            }
            Ok((cons.car(), rest.car_or_nil()))
        }
        name => Ok((name.clone(), Value::NIL)),
    }
}

pub(super) fn multiple_value_bind(
    c: &mut Compiler<'_>,
    rest: &Value,
    scope: &Scope,
) -> Compiled<Node> {
    let list = rest.car_or_nil();
    let Some(names) = list.list_to_vec() else {
        return Err(c.program_error("MULTIPLE-VALUE-BIND takes a list of variables first."));
    };
    let rest = rest.cdr_or_nil();
    let values = c.analyze(&rest.car_or_nil(), scope)?;
    let body = parse_body(&rest.cdr_or_nil(), false);
    let depth = c.dynamic_depth();
    let mut bindings = Vec::new();
    let mut bound = Vec::new();
    let mut inner = scope.clone();
    for name in &names {
        let name = c.check_bindable(name)?;
        if bound.contains(&name) {
            return Err(occurs_twice(c, "variable", name, "MULTIPLE-VALUE-BIND"));
        }
        let (binding, next) = c.bind(name, body.specials.contains(&name), &inner);
        inner = next;
        bound.push(name);
        bindings.push(binding);
    }
    for binding in &bindings {
        if matches!(binding, Binding::Special(_)) {
            c.open_dynamic(DynamicKind::Plain);
        }
    }
    let node = c.analyze_body(&body, &bound, &inner);
    c.close_dynamic(depth);
    for binding in &bindings {
        c.note_unread(binding, &[&list], &body);
    }
    Ok(Node::MultipleValueBind {
        bindings,
        values: Box::new(values),
        body: Box::new(node?),
    })
}

pub(super) fn symbol_macrolet(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    check_names(c, &rest.car_or_nil(), "name", "SYMBOL-MACROLET")?;
    let mut inner = scope.clone();
    for spec in rest.car_or_nil().iter_list() {
        let name = c.check_bindable(&spec.car_or_nil())?;
        if c.is_special(name) {
            return Err(c.special_symbol_macro(name));
        }
        let expansion = spec.cdr_or_nil().car_or_nil();
        inner = inner.with(Entry::Variable(
            name,
            VariableMeaning::SymbolMacro(expansion),
        ));
    }
    let body = parse_body(&rest.cdr_or_nil(), false);
    let names = rest.car_or_nil();
    let mut names = names
        .iter_list()
        .filter_map(|spec| spec.car_or_nil().as_symbol());
    if let Some(name) = names.find(|name| body.specials.contains(name)) {
        return Err(c.special_symbol_macro(name));
    }
    c.analyze_body(&body, &[], &inner)
}

pub(super) fn progv(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let symbols = c.analyze(&rest.car_or_nil(), scope)?;
    let rest = rest.cdr_or_nil();
    let values = c.analyze(&rest.car_or_nil(), scope)?;
    // The number of bindings is known only at run time, so exits have to unwind.
    let body = c.inside(DynamicKind::Unwind, 1, |c| {
        c.analyze_progn(&rest.cdr_or_nil(), scope)
    })?;
    Ok(Node::Progv(
        Box::new(symbols),
        Box::new(values),
        Box::new(body),
    ))
}
