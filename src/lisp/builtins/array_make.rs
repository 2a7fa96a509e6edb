//! Making arrays.

use crate::value::element_type::ElementType;
use std::cell::Cell;
use std::rc::Rc;

use super::arrays::{element_type, total_size};
use super::lists::size;
use super::settled_types;
use crate::builtin::Builtin;
use crate::guard::{MAX_ELEMENTS, reserve};
use crate::image::Image;
use crate::typed::keywords;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::array::{Array, Vector};
use crate::value::elements::Displacement;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::{Sequence, checked_element, index, list_items, text_of};
use crate::value::string::LispString;

type Outcome = Result<Value, Box<Raise>>;

/// The largest rank of an array.
pub(super) const MAX_RANK: usize = 128;

/// Keyword arguments of `make-array` and `adjust-array`.
pub(crate) struct Options {
    /// The value of all elements.
    pub element: Option<Value>,
    /// Nested sequences of the elements.
    pub contents: Option<Value>,
    /// The type of the elements, as it is stored, if it is given.
    pub(crate) element_type: Option<ElementType>,
    /// May the array be adjusted?
    pub adjustable: bool,
    fill_pointer: Option<Value>,
    displaced_to: Option<Value>,
    offset: Option<Value>,
}

impl Options {
    /// From keyword arguments.
    pub(crate) fn parse(image: &mut Image, args: &[Value]) -> Result<Options, Box<Raise>> {
        let [
            element,
            contents,
            element_type,
            fill_pointer,
            adjustable,
            displaced_to,
            offset,
        ] = keywords::parse(
            image,
            args,
            [
                known::K_INITIAL_ELEMENT,
                known::K_INITIAL_CONTENTS,
                known::K_ELEMENT_TYPE,
                known::K_FILL_POINTER,
                known::K_ADJUSTABLE,
                known::K_DISPLACED_TO,
                known::K_DISPLACED_INDEX_OFFSET,
            ],
        )?;
        let displaced_to = displaced_to.filter(Value::is_true);
        if displaced_to.is_some() && (element.is_some() || contents.is_some()) {
            return Err(Raise::simple(
                "A displaced array has the elements of another one; :INITIAL-ELEMENT and :INITIAL-CONTENTS cannot be given.",
            ));
        }
        if displaced_to.is_none() && offset.is_some() {
            return Err(Raise::simple(
                ":DISPLACED-INDEX-OFFSET needs :DISPLACED-TO.",
            ));
        }
        if element.is_some() && contents.is_some() {
            return Err(Raise::simple(
                "Only one of :INITIAL-ELEMENT and :INITIAL-CONTENTS can be given.",
            ));
        }
        let element_type = match element_type {
            Some(specifier) => Some(settled_types::element_type(image, &specifier)?),
            None => None,
        };
        Ok(Options {
            element,
            contents,
            element_type,
            adjustable: adjustable.is_some_and(|v| v.is_true()),
            fill_pointer,
            displaced_to,
            offset,
        })
    }

    /// The part of another array that an array of this shape is to consist of, if it is to be
    /// displaced.
    pub(crate) fn displacement(
        &self,
        of_type: ElementType,
        shape: &[usize],
    ) -> Result<Option<Displacement>, Box<Raise>> {
        let Some(target) = &self.displaced_to else {
            return Ok(None);
        };
        if element_type(target)? != of_type {
            return Err(Raise::simple(
                "An array can be displaced only to one with the same type of elements.",
            ));
        }
        let offset = self.offset.as_ref().map_or(Ok(0), index)?;
        let size: usize = shape.iter().product();
        let total = total_size(target)?;
        if offset.saturating_add(size) > total {
            return Err(Raise::simple(format!(
                "An array of {size} elements cannot be displaced to index {offset} of one that has {total}."
            )));
        }
        Ok(Some(Displacement {
            target: target.clone(),
            offset,
            size,
        }))
    }

    /// The fill pointer for a vector of this size, if it is to have one.
    pub(crate) fn fill_pointer(&self, size: usize) -> Result<Option<usize>, Box<Raise>> {
        match &self.fill_pointer {
            None | Some(Value::Symbol(known::NIL, ..)) => Ok(None),
            Some(Value::Symbol(known::T, ..)) => Ok(Some(size)),
            Some(value) => {
                let pointer = index(value)?;
                if pointer > size {
                    return Err(Raise::simple(format!(
                        "The fill pointer {pointer} is beyond the vector's size {size}."
                    )));
                }
                Ok(Some(pointer))
            }
        }
    }
}

/// The dimensions given by an argument: an integer or a list of integers.
pub(crate) fn shape(value: &Value) -> Result<Vec<usize>, Box<Raise>> {
    let shape: Vec<usize> = if value.is_list() {
        list_items(value)?
            .iter()
            .map(size)
            .collect::<Result<_, _>>()?
    } else {
        vec![size(value)?]
    };
    let total = shape
        .iter()
        .try_fold(1_usize, |total, size| total.checked_mul(*size));
    if total.is_none_or(|total| total > MAX_ELEMENTS) {
        return Err(Raise::new(
            known::HEAP_EXHAUSTED_ERROR,
            "An array of that size does not fit in memory.",
        ));
    }
    reserve(total.unwrap_or(0).saturating_mul(size_of::<Value>()));
    if shape.len() > MAX_RANK {
        return Err(Raise::simple(format!(
            "An array has at most {MAX_RANK} dimensions."
        )));
    }
    Ok(shape)
}

/// The elements of nested sequences in row-major order; the shape must fit.
pub(crate) fn flatten(contents: &Value, shape: &[usize]) -> Result<Vec<Value>, Box<Raise>> {
    let mut level = vec![contents.clone()];
    for size in shape {
        let mut next = Vec::new();
        for part in level {
            let items = Sequence::of(&part)?.all()?;
            if items.len() != *size {
                return Err(Raise::simple(format!(
                    "A dimension of size {size} needs that many elements in :INITIAL-CONTENTS, not {}.",
                    items.len()
                )));
            }
            next.extend(items);
        }
        level = next;
    }
    Ok(level)
}

/// The element that arrays of this element type hold by default.
pub(crate) fn filler(element_type: ElementType) -> Value {
    element_type.default_element()
}

/// A vector or string made of items.
pub(crate) fn vector(
    element_type: ElementType,
    items: Vec<Value>,
    fill_pointer: Option<usize>,
    adjustable: bool,
) -> Outcome {
    if element_type == ElementType::Character {
        let text = text_of(&items)?;
        let Some(count) = fill_pointer else {
            let string = LispString::new(text);
            string.adjustable.set(adjustable);
            return Ok(Value::Str(Rc::new(string)));
        };
        let string = LispString::with_fill_pointer(text, items.len(), adjustable);
        string.set_fill_pointer(count);
        return Ok(Value::Str(Rc::new(string)));
    }
    Ok(Value::Vector(Rc::new(Vector {
        fill_pointer: Cell::new(fill_pointer),
        adjustable,
        ..Vector::of_type(element_type, items)
    })))
}

/// A new array that is a part of another one.
pub(super) fn displaced(
    element_type: ElementType,
    shape: Vec<usize>,
    displacement: Displacement,
    options: &Options,
) -> Outcome {
    let size = displacement.size;
    if shape.len() != 1 {
        no_fill_pointer(options)?;
        let array = Array {
            adjustable: options.adjustable,
            ..Array::new(element_type, shape, Vec::new())
        };
        array.items.displace(displacement);
        return Ok(Value::Array(Rc::new(array)));
    }
    let pointer = options.fill_pointer(size)?;
    if element_type == ElementType::Character {
        let string = LispString::new(String::new());
        string.adjustable.set(options.adjustable);
        string.has_fill_pointer.set(pointer.is_some());
        string.displace(displacement);
        string.set_length(pointer.unwrap_or(size));
        return Ok(Value::Str(Rc::new(string)));
    }
    let vector = Vector {
        fill_pointer: Cell::new(pointer),
        adjustable: options.adjustable,
        ..Vector::of_type(element_type, Vec::new())
    };
    vector.items.displace(displacement);
    Ok(Value::Vector(Rc::new(vector)))
}

/// Only vectors have fill pointers.
fn no_fill_pointer(options: &Options) -> Result<(), Box<Raise>> {
    if options.fill_pointer.as_ref().is_some_and(Value::is_true) {
        return Err(Raise::simple("Only vectors can have fill pointers."));
    }
    Ok(())
}

/// An array; the dimensions are a list of sizes, or one size for a vector. A displaced array has
/// the elements of another one, from an index in row-major order on.
///
/// `(make-array 3 :initial-element 'x)` => `#(X X X)`
/// `(make-array '(2 2) :initial-contents '((1 2) (3 4)))` => `#2A((1 2) (3 4))`
/// `(make-array 2 :displaced-to #2A((1 2) (3 4)) :displaced-index-offset 1)` => `#(2 3)`
#[builtin(
    _,
    "dimensions &key element-type initial-element initial-contents adjustable fill-pointer displaced-to displaced-index-offset"
)]
fn make_array(image: &mut Image, dimensions: &Value, options: &[Value]) -> Outcome {
    let shape = shape(dimensions)?;
    let options = Options::parse(image, options)?;
    let total: usize = shape.iter().product();
    let of_type = options.element_type.unwrap_or(ElementType::T);
    if let Some(displacement) = options.displacement(of_type, &shape)? {
        return displaced(of_type, shape, displacement, &options);
    }
    let items = match &options.contents {
        Some(contents) => {
            let items = flatten(contents, &shape)?;
            for item in &items {
                checked_element(of_type, item.clone())?;
            }
            items
        }
        None => {
            let element = options.element.clone().unwrap_or_else(|| filler(of_type));
            vec![checked_element(of_type, element)?; total]
        }
    };
    if shape.len() == 1 {
        let pointer = options.fill_pointer(total)?;
        return vector(of_type, items, pointer, options.adjustable);
    }
    no_fill_pointer(&options)?;
    Ok(Value::Array(Rc::new(Array {
        adjustable: options.adjustable,
        ..Array::new(of_type, shape, items)
    })))
}

/// Making arrays.
pub(crate) static TABLE: &[Builtin] = builtins![make_array,];
