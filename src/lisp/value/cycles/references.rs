//! What the objects of each kind refer to.

use std::rc::Rc;

use super::mark::Mark;
use crate::value::Value;
use crate::value::code::Code;
use crate::value::function::{Body, Function};
use crate::value::stream::{Stream, StreamKind};
use crate::value::symbol::{FunctionCell, SymbolData, SymbolTable};

/// The objects that a collection can see.
pub(super) struct Objects<'a> {
    /// Those of the image that runs, if that is known. Symbols of others count as held.
    symbols: Option<&'a mut SymbolTable>,
}

/// Is the value an object whose references are followed?
#[inline]
pub(super) fn is_walked(value: &Value) -> bool {
    match value {
        Value::Cons(_)
        | Value::Cell(_)
        | Value::Function(_)
        | Value::Instance(_)
        | Value::Vector(_)
        | Value::Hash(_)
        | Value::Array(_)
        | Value::Stream(_) => true,
        Value::Symbol(_, hold) => !hold.is_none(),
        Value::Foreign(object) => object.object().may_be_in_circle(),
        _ => false,
    }
}

impl<'a> Objects<'a> {
    pub(super) fn new(symbols: Option<&'a mut SymbolTable>) -> Objects<'a> {
        Objects { symbols }
    }

    /// The mark of an object, if its references are followed.
    pub(super) fn mark<'v>(&self, object: &'v Value) -> Option<&'v Mark> {
        Some(match object {
            Value::Cons(r) => r.mark(),
            Value::Cell(r) => r.mark(),
            Value::Function(r) => &r.mark,
            Value::Instance(r) => &r.mark,
            Value::Vector(r) => &r.mark,
            Value::Array(r) => &r.mark,
            Value::Hash(r) => &r.mark,
            Value::Stream(r) => &r.mark,
            Value::Foreign(r) if r.object().may_be_in_circle() => r.mark(),
            Value::Symbol(_, hold) if self.symbols.as_ref()?.is_own(hold) => hold.mark()?,
            _ => return None,
        })
    }

    /// The references to an object.
    pub(super) fn strong_count(&self, object: &Value) -> usize {
        match object {
            Value::Cons(r) => Rc::strong_count(r),
            Value::Cell(r) => Rc::strong_count(r),
            Value::Function(r) => Rc::strong_count(r),
            Value::Instance(r) => Rc::strong_count(r),
            Value::Vector(r) => Rc::strong_count(r),
            Value::Array(r) => Rc::strong_count(r),
            Value::Hash(r) => Rc::strong_count(r),
            Value::Stream(r) => Rc::strong_count(r),
            Value::Foreign(r) => Rc::strong_count(r),
            Value::Symbol(_, hold) => hold.strong_count(),
            _ => usize::MAX,
        }
    }

    /// Visits the references of an object to those with marks. What is being changed at the moment
    /// appears to have none, so that what it holds counts as held.
    pub(super) fn for_each_reference(&self, object: &Value, visit: &mut dyn FnMut(&Value, &Mark)) {
        let mut visit = |held: &Value| {
            if let Some(mark) = self.mark(held) {
                visit(held, mark);
            }
        };
        match object {
            Value::Cons(cons) => cons.for_each(&mut visit),
            Value::Cell(slot) => slot.with(visit),
            Value::Function(function) => {
                if let Body::Closure { code, captured } = &function.body {
                    captured.iter().for_each(&mut visit);
                    of_code(code, &mut visit);
                }
            }
            Value::Instance(instance) => {
                if let Ok(slots) = instance.slots.try_borrow() {
                    slots.iter().for_each(visit);
                }
            }
            Value::Vector(vector) => vector.items.for_each_reference(&mut visit),
            Value::Array(array) => array.items.for_each_reference(&mut visit),
            Value::Hash(table) => table.for_each_reference(&mut visit),
            Value::Stream(stream) => of_stream(stream, &mut visit),
            Value::Foreign(object) => object.object().for_each_reference(&mut visit),
            Value::Symbol(sym, _) => {
                let data = self.symbols.as_ref().and_then(|table| table.passing(*sym));
                if let Some(data) = data {
                    of_symbol(data, &mut visit);
                }
            }
            _ => {}
        }
    }
}

/// What others use, too, appears to have no references, so that what it holds counts as held.
fn of_code(code: &Rc<Code>, visit: &mut dyn FnMut(&Value)) {
    if code.is_fixed || Rc::strong_count(code) > 1 {
        return;
    }
    visit(code.name.shown());
    if let Some(content) = code.content() {
        visit(content.lambda_list.shown());
        content.constants.iter().for_each(&mut *visit);
        content
            .inner
            .iter()
            .for_each(|(inner, _)| of_code(inner, visit));
    }
}

fn of_stream(stream: &Stream, visit: &mut dyn FnMut(&Value)) {
    let mut visit_stream = |stream: &Rc<Stream>| visit(&Value::Stream(Rc::clone(stream)));
    let Ok(kind) = stream.kind.try_borrow() else {
        return;
    };
    match &*kind {
        StreamKind::Broadcast { targets } => targets.iter().for_each(visit_stream),
        StreamKind::Concatenated { inputs, .. } => inputs.iter().for_each(visit_stream),
        StreamKind::TwoWay { input, output, .. } => {
            visit_stream(input);
            visit_stream(output);
        }
        StreamKind::Synonym { symbol } => visit(symbol),
        _ => {}
    }
}

fn of_symbol(data: &SymbolData, visit: &mut dyn FnMut(&Value)) {
    let mut visit_function = |function: &Rc<Function>| visit(&Value::Function(Rc::clone(function)));
    match &data.function {
        FunctionCell::Function(function) | FunctionCell::Macro(function) => {
            visit_function(function);
        }
        FunctionCell::Unbound | FunctionCell::Builtin => {}
    }
    data.setf_function.iter().for_each(visit_function);
    visit(&data.value);
    visit(&data.plist);
    data.symbol_macro.iter().for_each(visit);
}

/// Takes everything out of an object that nobody can see any more. Closures cannot be changed;
/// the boxes that they hold are emptied.
pub(super) fn empty(objects: &mut Objects<'_>, object: &Value) {
    match object {
        Value::Cons(cons) => cons.empty(),
        Value::Cell(slot) => drop(slot.take()),
        Value::Instance(instance) => drop(instance.slots.take()),
        Value::Vector(vector) => vector.items.empty(),
        Value::Array(array) => array.items.empty(),
        Value::Hash(table) => table.clear(),
        Value::Stream(stream) => drop(stream.kind.replace(StreamKind::Closed)),
        Value::Foreign(object) => object.object().let_go(),
        Value::Symbol(sym, _) => {
            let data = objects
                .symbols
                .as_mut()
                .and_then(|table| table.forget(*sym));
            drop(data);
        }
        _ => {}
    }
}
