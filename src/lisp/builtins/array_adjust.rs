//! Adjustment of arrays: another shape, other elements, or those of another array.

use std::rc::Rc;

use super::array_make;
use super::arrays::{dimensions, element_type, is_adjustable, row_major};
use crate::builtin::Builtin;
use crate::image::Image;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::array::Array;
use crate::value::element_type::ElementType;
use crate::value::elements::Displacement;
use crate::value::raise::Raise;
use crate::value::sequence::{checked_element, text_of};

type Outcome = Result<Value, Box<Raise>>;

/// An array of another size with the same elements; an adjustable vector is changed itself.
///
/// `(adjust-array (make-array 2 :initial-element 1) 3 :initial-element 0)` => `#(1 1 0)`
#[builtin(
    _,
    "array dimensions &key initial-element initial-contents fill-pointer element-type displaced-to displaced-index-offset"
)]
fn adjust_array(
    image: &mut Image,
    array: &Value,
    new_dimensions: &Value,
    options: &[Value],
) -> Outcome {
    let shape = array_make::shape(new_dimensions)?;
    let options = array_make::Options::parse(image, options)?;
    let old_shape = dimensions(array)?;
    if old_shape.len() != shape.len() {
        return Err(Raise::simple(format!(
            "An array of rank {} cannot be given rank {}.",
            old_shape.len(),
            shape.len()
        )));
    }
    let of_type = element_type(array)?;
    if options.element_type.is_some_and(|wanted| wanted != of_type) {
        return Err(Raise::simple(
            "An array cannot be given another type of elements.",
        ));
    }
    if let Some(displacement) = options.displacement(of_type, &shape)? {
        return displaced(array, of_type, shape, displacement, &options);
    }
    let items = match &options.contents {
        Some(contents) => array_make::flatten(contents, &shape)?,
        None => {
            let filler = options
                .element
                .clone()
                .unwrap_or_else(|| array_make::filler(of_type));
            kept_items(array, &old_shape, &shape, filler)
        }
    };
    for item in &items {
        checked_element(of_type, item.clone())?;
    }
    match array {
        Value::Str(s) if is_adjustable(array) => {
            let count = items.len();
            let pointer = options.fill_pointer(count)?;
            let length = match pointer {
                Some(pointer) => pointer,
                None if s.has_fill_pointer.get() => s.len().min(count),
                None => count,
            };
            s.replace(&text_of(&items)?, length);
            Ok(array.clone())
        }
        Value::Vector(v) if is_adjustable(array) => {
            let count = items.len();
            v.items.own(items);
            if let Some(old) = v.fill_pointer.get() {
                let pointer = options.fill_pointer(count)?.unwrap_or(old.min(count));
                v.fill_pointer.set(Some(pointer));
            }
            Ok(array.clone())
        }
        Value::Array(a) if a.adjustable => {
            *a.dimensions.borrow_mut() = shape;
            a.items.own(items);
            Ok(array.clone())
        }
        Value::Array(a) => Ok(Value::Array(Rc::new(Array {
            adjustable: options.adjustable,
            ..Array::new(a.element_type, shape, items)
        }))),
        _ => {
            let pointer = options.fill_pointer(items.len())?;
            array_make::vector(of_type, items, pointer, options.adjustable)
        }
    }
}

/// ADJUST-ARRAY that makes an array a part of another one.
fn displaced(
    array: &Value,
    of_type: ElementType,
    shape: Vec<usize>,
    displacement: Displacement,
    options: &array_make::Options,
) -> Outcome {
    if !is_adjustable(array) {
        return array_make::displaced(of_type, shape, displacement, options);
    }
    if displacement.leads_to(array) {
        return Err(Raise::simple("An array cannot be displaced to itself."));
    }
    let size = displacement.size;
    let pointer = options.fill_pointer(size)?;
    match array {
        Value::Str(s) => {
            s.displace(displacement);
            if s.has_fill_pointer.get() {
                s.set_fill_pointer(pointer.unwrap_or(s.len()));
            } else {
                s.set_length(size);
            }
        }
        Value::Vector(v) => {
            v.items.displace(displacement);
            if let Some(old) = v.fill_pointer.get() {
                v.fill_pointer.set(Some(pointer.unwrap_or(old.min(size))));
            }
        }
        Value::Array(a) => {
            *a.dimensions.borrow_mut() = shape;
            a.items.displace(displacement);
        }
        _ => {}
    }
    Ok(array.clone())
}

/// The elements of an array in a new shape; places that the old one lacks get a filler.
fn kept_items(array: &Value, old: &[usize], new: &[usize], filler: Value) -> Vec<Value> {
    let total: usize = new.iter().product();
    let mut items = Vec::with_capacity(total);
    let mut subscripts = vec![0_usize; new.len()];
    for _ in 0..total {
        let inside = subscripts.iter().zip(old).all(|(i, size)| i < size);
        let at = subscripts
            .iter()
            .zip(old)
            .fold(0, |at, (i, size)| at * size + i);
        let item = if inside { row_major(array, at) } else { None };
        items.push(item.unwrap_or_else(|| filler.clone()));
        for (i, size) in subscripts.iter_mut().zip(new).rev() {
            *i += 1;
            if *i < *size {
                break;
            }
            *i = 0;
        }
    }
    items
}

/// Adjustment of arrays.
pub(crate) static TABLE: &[Builtin] = builtins![adjust_array,];
