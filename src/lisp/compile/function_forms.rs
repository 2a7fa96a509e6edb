//! The special operators that make functions and macros: `function`, `flet` and their kin.

use super::analyze::{Compiled, Compiler};
use super::binding_forms::check_names;
use super::body::parse_body;
use super::node::{Binding, Node};
use super::scope::{Entry, FunctionMeaning, Scope};
use crate::image::notes::NoteKind;
use crate::print;
use crate::value::Value;
use crate::value::known;
use crate::value::symbol::Sym;

pub(super) fn function(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let name = rest.car_or_nil();
    if let Some(sym) = name.as_symbol() {
        return match scope.function(sym, false) {
            Some(FunctionMeaning::Local(var)) => {
                c.refer(var);
                Ok(Node::Local(var.clone()))
            }
            Some(FunctionMeaning::Macro(_)) => {
                let text = format!("{} is a macro, not a function.", c.image.name(sym));
                Err(c.program_error(text))
            }
            None => {
                let place = c.place;
                c.image.note(place, || NoteKind::Function(sym));
                Ok(Node::Function(sym, place))
            }
        };
    }
    let head = name.car_or_nil().as_symbol();
    match head {
        Some(known::LAMBDA) => lambda(c, &name.cdr_or_nil(), scope),
        Some(known::NAMED_LAMBDA) => named_lambda(c, &name.cdr_or_nil(), scope),
        Some(known::SETF) => match name.cdr_or_nil().car_or_nil().as_symbol() {
            Some(sym) => match scope.function(sym, true) {
                Some(FunctionMeaning::Local(var)) => {
                    c.refer(var);
                    Ok(Node::Local(var.clone()))
                }
                _ => Ok(Node::SetfFunction(sym, c.place)),
            },
            None => Err(not_a_function_name(c, &name)),
        },
        _ => Err(not_a_function_name(c, &name)),
    }
}

fn not_a_function_name(c: &Compiler<'_>, name: &Value) -> Box<crate::Raise> {
    let shown = print::to_string(c.image, name, true);
    c.program_error(format!("{shown} is not a legal function name."))
}

pub(super) fn lambda(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let lambda_list = rest.car_or_nil();
    let name = Value::list([known::LAMBDA.into(), lambda_list.clone()]);
    let node = c.analyze_lambda(name, &lambda_list, &rest.cdr_or_nil(), None, scope)?;
    Ok(Node::Lambda(node))
}

/// `(named-lambda name lambda-list body…)`: a function with a name and a block of that name.
pub(super) fn named_lambda(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let name = rest.car_or_nil();
    let rest = rest.cdr_or_nil();
    let block = block_name(&name);
    let node = c.analyze_lambda(name, &rest.car_or_nil(), &rest.cdr_or_nil(), block, scope)?;
    Ok(Node::Lambda(node))
}

/// The name of the block around a function's body: the function's own, or `name` for `(setf name)`.
fn block_name(name: &Value) -> Option<Sym> {
    match name {
        Value::Symbol(sym, ..) => Some(*sym),
        Value::Cons(c) => c.cdr().car_or_nil().as_symbol(),
        _ => None,
    }
}

/// A local function definition: its name as written, the symbol in it, whether it is `(setf name)`,
/// the lambda list and the body.
fn local_function(c: &Compiler<'_>, spec: &Value) -> Compiled<(Value, Sym, bool, Value, Value)> {
    let name = spec.car_or_nil();
    let rest = spec.cdr_or_nil();
    let (sym, is_setf) = match &name {
        Value::Symbol(sym, ..) => (Some(*sym), false),
        other => (other.cdr_or_nil().car_or_nil().as_symbol(), true),
    };
    match sym {
        Some(sym) if rest.as_cons().is_some() => {
            Ok((name, sym, is_setf, rest.car_or_nil(), rest.cdr_or_nil()))
        }
        _ => {
            let shown = print::to_string(c.image, spec, true);
            Err(c.program_error(format!(
                "{shown} is no local function: (name (parameters…) body…) was expected."
            )))
        }
    }
}

pub(super) fn flet(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    check_names(c, &rest.car_or_nil(), "function", "FLET")?;
    let mut bindings = Vec::new();
    let mut inner = scope.clone();
    for spec in rest.car_or_nil().iter_list() {
        let (name, sym, is_setf, lambda_list, body) = local_function(c, &spec)?;
        let lambda = c.analyze_lambda(flet_name(&name), &lambda_list, &body, Some(sym), scope)?;
        let var = c.new_var(sym);
        inner = inner.with(Entry::Function(
            sym,
            is_setf,
            FunctionMeaning::Local(var.clone()),
        ));
        bindings.push((Binding::Lexical(var), Node::Lambda(lambda)));
    }
    let body = parse_body(&rest.cdr_or_nil(), false);
    let body = c.analyze_body(&body, &[], &inner)?;
    Ok(Node::Let {
        bindings,
        sequential: false,
        body: Box::new(body),
    })
}

fn flet_name(name: &Value) -> Value {
    Value::list([known::FLET.into(), name.clone()])
}

pub(super) fn labels(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    check_names(c, &rest.car_or_nil(), "function", "LABELS")?;
    let mut inner = scope.clone();
    let mut specs = Vec::new();
    for spec in rest.car_or_nil().iter_list() {
        let (name, sym, is_setf, lambda_list, body) = local_function(c, &spec)?;
        let var = c.new_var(sym);
        // The variable is set after closures over it exist.
        var.assigned.set(true);
        inner = inner.with(Entry::Function(
            sym,
            is_setf,
            FunctionMeaning::Local(var.clone()),
        ));
        specs.push((var, name, sym, lambda_list, body));
    }
    let mut functions = Vec::new();
    for (var, name, sym, lambda_list, body) in specs {
        let name = Value::list([known::LABELS.into(), name]);
        let lambda = c.analyze_lambda(name, &lambda_list, &body, Some(sym), &inner)?;
        functions.push((var, Node::Lambda(lambda)));
    }
    let body = parse_body(&rest.cdr_or_nil(), false);
    let body = c.analyze_body(&body, &[], &inner)?;
    Ok(Node::Labels(functions, Box::new(body)))
}

pub(super) fn macrolet(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    check_names(c, &rest.car_or_nil(), "macro", "MACROLET")?;
    let mut inner = scope.clone();
    for spec in rest.car_or_nil().iter_list() {
        let (_, sym, _, lambda_list, body) = local_function(c, &spec)?;
        let lambda = super::destructure::macro_function(c.image, sym, &lambda_list, &body)?;
        let function = super::compile_macro_function(c.image, &lambda, &scope.of_macros())
            .map_err(|r| r.at(c.place))?;
        inner = inner.with(Entry::Function(
            sym,
            false,
            FunctionMeaning::Macro(function),
        ));
    }
    let body = parse_body(&rest.cdr_or_nil(), false);
    c.analyze_body(&body, &[], &inner)
}
