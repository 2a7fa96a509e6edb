//! Printing vectors and arrays.

use std::rc::Rc;

use super::{Printer, Task};
use crate::image::identity::identity;
use crate::print::shape::Style;
use crate::value::Value;
use crate::value::array::{Array, Vector};
use crate::value::document::Newline;
use crate::value::element_type::ElementType;

impl Printer<'_> {
    pub(super) fn vector(&mut self, value: &Value, vector: &Rc<Vector>, depth: usize) {
        let items = vector.to_vec();
        if !self.settings.array {
            let kind = if vector.element_type == ElementType::Bit {
                "SIMPLE-BIT-VECTOR"
            } else {
                "SIMPLE-VECTOR"
            };
            let text = format!(
                "#<({kind} {}) {}>",
                items.len(),
                identity(self.image, value)
            );
            self.document.text(&text);
            return;
        }
        if vector.element_type == ElementType::Bit {
            let bits = items.iter().map(|bit| {
                if matches!(bit, Value::Int(0)) {
                    '0'
                } else {
                    '1'
                }
            });
            let text: String = "#*".chars().chain(bits).collect();
            self.document.text(&text);
            return;
        }
        if self.settings.readably && vector.element_type != ElementType::T {
            let size = items.len();
            self.typed_array(&[size], vector.element_type, Value::list(items), depth);
            return;
        }
        if self.is_too_deep(depth) {
            return;
        }
        self.document.open("#(", ")");
        self.tasks.push(Task::Close(")"));
        self.tasks.push(Task::Elements {
            end: items.len(),
            items: Rc::new(items),
            next: 0,
            depth,
        });
    }

    pub(super) fn elements(
        &mut self,
        items: Rc<Vec<Value>>,
        next: usize,
        end: usize,
        depth: usize,
    ) {
        if next >= end {
            return;
        }
        if next > 0 {
            self.document.text(" ");
            self.document.newline(Newline::Fill);
        }
        if self.is_cut(next) {
            self.document.text("...");
            return;
        }
        if let Some(item) = items.get(next).cloned() {
            self.tasks.push(Task::Elements {
                items,
                next: next + 1,
                end,
                depth,
            });
            self.tasks.push(Task::Value(item, Style::Auto, depth + 1));
        }
    }

    pub(super) fn array(&mut self, value: &Value, array: &Rc<Array>, depth: usize) {
        if !self.settings.array {
            let text = format!("#<ARRAY {}>", identity(self.image, value));
            self.document.text(&text);
            return;
        }
        let dimensions = array.dimensions.borrow();
        if self.settings.readably && array.element_type != ElementType::T {
            let contents = nested(array, 0, 0);
            self.typed_array(&dimensions, array.element_type, contents, depth);
            return;
        }
        let rank = dimensions.len();
        // Dimensions after an empty one do not show.
        let hidden = dimensions.iter().skip_while(|size| **size > 0).skip(1);
        if self.settings.readably && hidden.clone().any(|size| *size > 0) {
            self.calls.note_unreadable(value);
        }
        self.document.text(&format!("#{rank}A"));
        self.tasks.push(Task::Rows {
            array: array.clone(),
            dimension: 0,
            next: 0,
            offset: 0,
            depth,
        });
    }

    /// Prints an array with its dimensions and element type: `#A((2) (UNSIGNED-BYTE 8) 1 2)`.
    fn typed_array(
        &mut self,
        dimensions: &[usize],
        element: ElementType,
        contents: Value,
        depth: usize,
    ) {
        let sizes = Value::list(dimensions.iter().map(|size| Value::from(*size)));
        let parts = Value::list_with_tail([sizes, element.specifier()], contents);
        self.document.text("#A");
        self.tasks.push(Task::Value(parts, Style::Auto, depth));
    }

    pub(super) fn rows(
        &mut self,
        array: Rc<Array>,
        dimension: usize,
        next: usize,
        offset: usize,
        depth: usize,
    ) {
        let Some(length) = array.dimensions.borrow().get(dimension).copied() else {
            let item = array.items.get(offset);
            let item = item.unwrap_or(Value::NIL);
            self.tasks.push(Task::Value(item, Style::Auto, depth));
            return;
        };
        if next == 0 {
            if self.is_too_deep(depth) {
                return;
            }
            self.document.open("(", ")");
        }
        let is_cut = next < length && self.is_cut(next);
        if next > 0 && next < length {
            self.document.text(" ");
            let is_last_dimension = dimension + 1 == array.dimensions.borrow().len();
            self.document.newline(if is_last_dimension {
                Newline::Fill
            } else {
                Newline::Linear
            });
        }
        if is_cut {
            self.document.text("...");
        }
        if is_cut || next >= length {
            self.document.end();
            self.document.text(")");
            return;
        }
        let step: usize = array
            .dimensions
            .borrow()
            .iter()
            .skip(dimension + 1)
            .product();
        self.tasks.push(Task::Rows {
            array: array.clone(),
            dimension,
            next: next + 1,
            offset: offset + step,
            depth,
        });
        self.tasks.push(Task::Rows {
            array,
            dimension: dimension + 1,
            next: 0,
            offset,
            depth: depth + 1,
        });
    }
}

/// The elements of an array from an offset on, as lists inside lists from a dimension on.
fn nested(array: &Array, dimension: usize, offset: usize) -> Value {
    let dimensions = array.dimensions.borrow();
    let Some(length) = dimensions.get(dimension) else {
        return array.items.get(offset).unwrap_or(Value::NIL);
    };
    let inner = dimensions.iter().skip(dimension + 1);
    // An array without elements may have dimensions whose product is larger than any number.
    let step = inner.fold(1usize, |step, size| step.saturating_mul(*size));
    Value::list((0..*length).map(|row| nested(array, dimension + 1, offset + row * step)))
}
