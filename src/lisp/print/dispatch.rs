//! What a program prints in its own way: by the pretty printer's dispatch table and by methods of
//! `print-object`.
//!
//! A dispatch table is a hash table from types to pairs of a function and a priority; `NIL` is the standard
//! one, which has no functions.

use super::calls::Calls;
use crate::image::Image;
use crate::value::Value;
use crate::value::class::Instance;
use crate::value::generic::Specializer;
use crate::value::known;
use crate::value::number;
use crate::value::symbol::FunctionCell;

/// The function that prints the value by the current table, if it has one: that of the highest priority;
/// among equals, that of the type that came first.
pub(super) fn function_for(image: &Image, value: &Value, calls: &mut Calls) -> Option<Value> {
    let Value::Hash(table) = image.special(known::V_PRINT_PPRINT_DISPATCH) else {
        return None;
    };
    if table.is_empty() {
        return None;
    }
    let mut best: Option<(Value, Value)> = None;
    for (specifier, entry) in table.pairs() {
        let priority = entry.cdr_or_nil();
        let is_better = best.as_ref().is_none_or(|(_, most)| {
            number::compare(&priority, most).is_ok_and(|order| order.is_some_and(|o| o.is_gt()))
        });
        if is_better && calls.has_type(image, value, &specifier) {
            best = Some((entry.car_or_nil(), priority));
        }
    }
    best.map(|(function, _)| function)
}

/// Does the program define how the instance is printed?
pub(super) fn has_print_method(image: &Image, instance: &Instance) -> bool {
    let FunctionCell::Function(function) = &image.symbol(known::PRINT_OBJECT).function else {
        return false;
    };
    let Some(generic) = function.as_generic() else {
        return false;
    };
    let class = instance.class();
    generic.methods.borrow().iter().any(|method| {
        !method.is_builtin
            && match method.specializers.first() {
                Some(Specializer::Class(specializer)) => class.is_within(specializer),
                _ => false,
            }
    })
}
