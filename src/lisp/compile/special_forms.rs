//! The special operators: the forms that the compiler translates itself. Those that make functions are in
//! `function_forms`, those that bind names in `binding_forms`.

use std::rc::Rc;

use super::analyze::{Compiled, Compiler};
use super::binding_forms::{let_form, multiple_value_bind, progv, symbol_macrolet};
use super::body::parse_body;
use super::function_forms::{flet, function, labels, lambda, macrolet, named_lambda};
use super::node::Node;
use super::scope::{DynamicKind, Entry, Scope, Tagbody, VariableMeaning};
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
    let info = c.new_block_of_macro(name);
    let inner = scope.with(Entry::Block(info.clone()));
    let body = c.analyze_progn(&rest.cdr_or_nil(), &inner)?;
    c.note_caught_returns(&info);
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
    c.note_exit_to(&info, scope);
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
    c.note_unreachable_statements(&items, is_tag, &statements);
    Ok(Node::Tagbody(info, statements, positions))
}

fn go(c: &mut Compiler<'_>, rest: &Value, scope: &Scope) -> Compiled<Node> {
    let tag = rest.car_or_nil();
    let Some((info, index)) = scope.tag(&tag).map(|(t, i)| (t.clone(), i)) else {
        let shown = print::to_string(c.image, &tag, true);
        return Err(c.program_error(format!("attempt to GO to nonexistent tag: {shown}")));
    };
    c.note_jump_to(&info, scope);
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
    c.note_exit_of_all(scope);
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
        let place = c.place;
        c.image
            .note(place, || NoteKind::Handled(clause.car_or_nil()));
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
