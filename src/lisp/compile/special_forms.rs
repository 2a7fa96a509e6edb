//! The special operators: the forms that the compiler translates itself.

use std::rc::Rc;

use super::analyze::{Compiled, Compiler};
use super::body::parse_body;
use super::node::{Binding, Node};
use super::scope::{DynamicKind, Entry, FunctionMeaning, Scope, Tagbody, VariableMeaning};
use crate::evaluator::nested;
use crate::image::notes::NoteKind;
use crate::print;
use crate::value::Value;
use crate::value::known;
use crate::value::symbol::{Sym, VariableKind};

/// Analyses the rest of a form after its operator.
pub(super) type SpecialForm = fn(&mut Compiler<'_>, &Value, &Scope) -> Compiled<Node>;

/// The special operator of that name.
pub(super) fn lookup(name: Sym) -> Option<SpecialForm> {
    Some(match name {
        known::QUOTE => |_, rest, _| Ok(Node::Const(rest.car_or_nil())),
        known::FUNCTION => function,
        known::LAMBDA => lambda,
        known::NAMED_LAMBDA => named_lambda,
        known::PROGN | known::LOCALLY => progn,
        known::IF => if_form,
        known::OR => or_form,
        known::AND => and_form,
        known::LET => |c, rest, scope| let_form(c, rest, scope, false),
        known::LET_STAR => |c, rest, scope| let_form(c, rest, scope, true),
        known::SETQ => setq,
        known::BLOCK => block,
        known::RETURN_FROM => return_from,
        known::TAGBODY => tagbody,
        known::GO => go,
        known::CATCH => catch,
        known::THROW => throw,
        known::UNWIND_PROTECT => unwind_protect,
        known::MULTIPLE_VALUE_CALL => multiple_value_call,
        known::MULTIPLE_VALUE_PROG1 => |c, rest, scope| prog1(c, rest, scope, true),
        known::PROG1 => |c, rest, scope| prog1(c, rest, scope, false),
        known::MULTIPLE_VALUE_BIND => multiple_value_bind,
        known::FLET => flet,
        known::LABELS => labels,
        known::MACROLET => macrolet,
        known::SYMBOL_MACROLET => symbol_macrolet,
        known::PROGV => progv,
        known::THE => |c, rest, scope| c.analyze(&rest.cdr_or_nil().car_or_nil(), scope),
        known::EVAL_WHEN => eval_when,
        known::LOAD_TIME_VALUE => load_time_value,
        known::DECLARE => |c, _, _| {
            Err(c.program_error(
                "There is no function named DECLARE: declarations stand at the start of a body.",
            ))
        },
        known::HANDLER_BIND => handler_bind,
        known::WITH_RESTARTS => restarts,
        known::WITHOUT_PACKAGE_LOCKS => super::locks::without_package_locks,
        _ => return None,
    })
}

fn progn(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let body = parse_body(rest, false);
    c.analyze_body(&body, &[], scope)
}

fn function(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
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
                c.image.note(place, || NoteKind::Function(sym, None));
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

fn lambda(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let lambda_list = rest.car_or_nil();
    let name = Value::list([known::LAMBDA.into(), lambda_list.clone()]);
    let node = c.analyze_lambda(name, &lambda_list, &rest.cdr_or_nil(), None, scope)?;
    Ok(Node::Lambda(node))
}

/// `(named-lambda name lambda-list body…)`: a function with a name and a block of that name.
fn named_lambda(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
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

fn if_form(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let Some(parts) = rest.list_to_vec().filter(|p| matches!(p.len(), 2 | 3)) else {
        return Err(
            c.program_error("IF takes a test, a form for true and at most one form for false.")
        );
    };
    let mut nodes = parts.iter().map(|p| c.analyze(p, scope));
    let mut next = || nodes.next().unwrap_or(Ok(Node::NIL));
    Ok(Node::If(
        Box::new(next()?),
        Box::new(next()?),
        Box::new(next()?),
    ))
}

fn or_form(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let mut nodes = c.analyze_list(rest, scope)?;
    let mut node = nodes.pop().unwrap_or(Node::NIL);
    while let Some(first) = nodes.pop() {
        node = Node::Or(Box::new(first), Box::new(node));
    }
    Ok(node)
}

fn and_form(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let mut nodes = c.analyze_list(rest, scope)?;
    let mut node = nodes.pop().unwrap_or(Node::Const(Value::T));
    while let Some(first) = nodes.pop() {
        node = Node::If(Box::new(first), Box::new(node), Box::new(Node::NIL));
    }
    Ok(node)
}

fn let_form(c: &mut Compiler<'_>, rest: &Value, scope: &Scope, sequential: bool) -> Compiled<Node> {
    let body = parse_body(&rest.cdr_or_nil(), false);
    let Some(specs) = rest.car_or_nil().list_to_vec() else {
        return Err(
            c.program_error("Malformed LET bindings: a list of (variable value) was expected.")
        );
    };
    let mut bindings = Vec::new();
    let mut bound = Vec::new();
    let mut inner = scope.clone();
    let depth = c.dynamic_depth();
    for spec in &specs {
        let (name, init) = binding_parts(c, spec)?;
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
    Ok(Node::Let {
        bindings,
        sequential,
        body: Box::new(node?),
    })
}

/// The error for a name that a form binds twice at once.
fn occurs_twice(c: &Compiler<'_>, what: &str, name: Sym, operator: &str) -> Box<crate::Raise> {
    let name = print::to_string(c.image, &name.into(), true);
    c.program_error(format!(
        "The {what} {name} occurs more than once in the {operator}."
    ))
}

/// Signals an error if specifications of a form that binds names have a name twice.
fn check_names(c: &Compiler<'_>, specs: &Value, what: &str, operator: &str) -> Compiled<()> {
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

fn setq(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let Some(parts) = rest.list_to_vec().filter(|p| p.len().is_multiple_of(2)) else {
        return Err(c.program_error("odd number of args to SETQ"));
    };
    let mut nodes = Vec::new();
    for pair in parts.chunks_exact(2) {
        nodes.push(assign_variable(c, &pair[0], &pair[1], scope)?);
    }
    Ok(match nodes.len() {
        0 => Node::NIL,
        1 => nodes.remove(0),
        _ => Node::Progn(nodes),
    })
}

/// `(setq name form)`.
pub(super) fn assign_variable(
    c: &mut Compiler<'_>,
    name: &Value,
    form: &Value,
    scope: &Scope,
) -> Compiled<Node> {
    let Some(sym) = name.as_symbol() else {
        let shown = print::to_string(c.image, name, true);
        return Err(c.program_error(format!("Variable name is not a symbol: {shown}.")));
    };
    let expansion = match scope.variable(sym) {
        Some(VariableMeaning::Lexical(var)) => {
            let value = c.analyze(form, scope)?;
            c.refer(var);
            var.assigned.set(true);
            return Ok(Node::SetLocal(var.clone(), Box::new(value)));
        }
        Some(VariableMeaning::SymbolMacro(expansion)) => Some(expansion.clone()),
        Some(VariableMeaning::Special) => None,
        None => c.image.symbol(sym).symbol_macro.clone(),
    };
    if let Some(expansion) = expansion {
        let form = Value::list([known::SETF.into(), expansion, form.clone()]);
        return c.analyze(&form, scope);
    }
    if c.image.symbol(sym).kind == VariableKind::Constant {
        let shown = print::to_string(c.image, name, true);
        return Err(c.program_error(format!("{shown} is a constant and thus can't be set.")));
    }
    let place = c.place;
    c.image.note(place, || NoteKind::Assigned(sym));
    let value = c.analyze(form, scope)?;
    Ok(Node::SetGlobal(sym, Box::new(value)))
}

fn block(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let Some(name) = rest.car_or_nil().as_symbol() else {
        return Err(c.program_error("The block name is not a symbol."));
    };
    let info = c.new_block(name);
    let inner = scope.with(Entry::Block(info.clone()));
    let body = c.analyze_progn(&rest.cdr_or_nil(), &inner)?;
    Ok(if info.used.get() {
        Node::Block(info, Box::new(body))
    } else {
        body
    })
}

fn return_from(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let Some(name) = rest.car_or_nil().as_symbol() else {
        return Err(c.program_error("The block name of RETURN-FROM is not a symbol."));
    };
    let Some(info) = scope.block(name).cloned() else {
        let text = format!("return for unknown block: {}", c.image.name(name));
        return Err(c.program_error(text));
    };
    info.used.set(true);
    let value = c.analyze(&rest.cdr_or_nil().car_or_nil(), scope)?;
    let value = Box::new(value);
    if info.owner == c.function_id() && !c.crosses_cleanup(info.depth) {
        return Ok(Node::LocalReturn(info, value));
    }
    info.dynamic.set(true);
    c.refer(&info.identity);
    Ok(Node::DynamicReturn(info, value))
}

fn tagbody(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let Some(items) = rest.list_to_vec() else {
        return Err(c.program_error("TAGBODY takes a proper list of tags and statements."));
    };
    let is_tag = |v: &Value| matches!(v, Value::Symbol(..) | Value::Int(_));
    let mut tags: Vec<&Value> = Vec::new();
    for tag in items.iter().filter(|item| is_tag(item)) {
        if tags.iter().any(|other| other.is_eql(tag)) && !tag.is_nil() {
            let shown = print::to_string(c.image, tag, true);
            return Err(c.program_error(format!(
                "The tag {shown} occurs more than once in the TAGBODY."
            )));
        }
        tags.push(tag);
    }
    let info = Rc::new(Tagbody {
        tags: items.iter().filter(|v| is_tag(v)).cloned().collect(),
        owner: c.function_id(),
        depth: c.dynamic_depth(),
        identity: c.new_var(known::TAGBODY),
        dynamic: false.into(),
    });
    let inner = scope.with(Entry::Tagbody(info.clone()));
    let mut statements = Vec::new();
    let mut positions = Vec::new();
    for item in &items {
        if is_tag(item) {
            positions.push(statements.len());
        } else {
            statements.push(c.analyze(item, &inner)?);
        }
    }
    Ok(Node::Tagbody(info, statements, positions))
}

fn go(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let tag = rest.car_or_nil();
    let Some((info, index)) = scope.tag(&tag).map(|(t, i)| (t.clone(), i)) else {
        let shown = print::to_string(c.image, &tag, true);
        return Err(c.program_error(format!("attempt to GO to nonexistent tag: {shown}")));
    };
    if info.owner == c.function_id() && !c.crosses_cleanup(info.depth) {
        return Ok(Node::LocalGo(info, index));
    }
    info.dynamic.set(true);
    c.refer(&info.identity);
    Ok(Node::DynamicGo(info, index))
}

fn catch(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let tag = c.analyze(&rest.car_or_nil(), scope)?;
    let body = c.inside(DynamicKind::Plain, 1, |c| {
        c.analyze_progn(&rest.cdr_or_nil(), scope)
    })?;
    Ok(Node::Catch(Box::new(tag), Box::new(body)))
}

fn throw(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    if rest.iter_list().count() != 2 {
        return Err(c.program_error("THROW takes a tag and a form."));
    }
    let tag = c.analyze(&rest.car_or_nil(), scope)?;
    let value = c.analyze(&rest.cdr_or_nil().car_or_nil(), scope)?;
    Ok(Node::Throw(Box::new(tag), Box::new(value), c.place))
}

fn unwind_protect(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let body = c.inside(DynamicKind::Unwind, 1, |c| {
        c.analyze(&rest.car_or_nil(), scope)
    })?;
    // An exit from the cleanup forms abandons the exit that they interrupted, so it has to unwind.
    let cleanup = c.inside(DynamicKind::Unwind, 1, |c| {
        c.analyze_progn(&rest.cdr_or_nil(), scope)
    })?;
    Ok(Node::UnwindProtect(Box::new(body), Box::new(cleanup)))
}

fn multiple_value_call(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let function = c.analyze(&rest.car_or_nil(), scope)?;
    let args = c.analyze_list(&rest.cdr_or_nil(), scope)?;
    Ok(Node::MultipleValueCall(Box::new(function), args, c.place))
}

fn prog1(c: &mut Compiler<'_>, rest: &Value, scope: &Scope, multi: bool) -> Compiled<Node> {
    let first = c.analyze(&rest.car_or_nil(), scope)?;
    let others = c.analyze_list(&rest.cdr_or_nil(), scope)?;
    Ok(Node::Prog1(Box::new(first), others, multi))
}

fn multiple_value_bind(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let Some(names) = rest.car_or_nil().list_to_vec() else {
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
    Ok(Node::MultipleValueBind {
        bindings,
        values: Box::new(values),
        body: Box::new(node?),
    })
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

fn flet(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
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

fn labels(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
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

fn macrolet(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
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

fn symbol_macrolet(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
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

fn progv(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
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

fn eval_when(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let evaluated = rest.car_or_nil().iter_list().any(|situation| {
        situation.as_symbol().is_some_and(|s| {
            // Whatever is loaded is loaded as a source.
            matches!(s, known::K_EXECUTE | known::EVAL)
        })
    });
    if evaluated {
        c.analyze_progn(&rest.cdr_or_nil(), scope)
    } else {
        Ok(Node::NIL)
    }
}

fn load_time_value(c: &mut Compiler<'_>, rest: &Value, _: &Scope) -> Compiled<Node> {
    let code = super::compile_form(c.image, &rest.car_or_nil())?;
    let function = crate::value::function::Function::closure(code, Vec::new());
    let value = nested::call_nested(c.image, Value::Function(Rc::new(function)), Vec::new())?;
    Ok(Node::Const(value))
}

fn handler_bind(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let mut types = Vec::new();
    let mut functions = Vec::new();
    for clause in rest.car_or_nil().iter_list() {
        super::compiled_macros::check_binding(c.image, &clause).map_err(|r| r.at(c.place))?;
        types.push(clause.car_or_nil());
        functions.push(c.analyze(&clause.cdr_or_nil().car_or_nil(), scope)?);
    }
    if types.is_empty() {
        return c.analyze_progn(&rest.cdr_or_nil(), scope);
    }
    let body = c.inside(DynamicKind::Plain, 1, |c| {
        c.analyze_progn(&rest.cdr_or_nil(), scope)
    })?;
    Ok(Node::Handlers(
        Value::list(types),
        functions,
        Box::new(body),
        c.place,
    ))
}

/// `(with-restarts restart-list-form body…)`.
fn restarts(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let list = c.analyze(&rest.car_or_nil(), scope)?;
    let body = c.inside(DynamicKind::Plain, 1, |c| {
        c.analyze_progn(&rest.cdr_or_nil(), scope)
    })?;
    Ok(Node::Restarts(Box::new(list), Box::new(body)))
}
