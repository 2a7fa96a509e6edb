//! Effective methods: what a call of a generic function does for arguments of given classes.

use std::cmp::Ordering;
use std::rc::Rc;

use super::class_of::class_of;
use crate::image::Image;
use crate::print;
use crate::value::Value;
use crate::value::class::Class;
use crate::value::dispatch::{Effective, Shape, SlotPlace};
use crate::value::generic::{Accessor, GenericFunction, Method, Specializer};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

impl Effective {
    /// The effective method for a call with these arguments (all required ones are there).
    pub fn compute(
        image: &Image,
        generic: &GenericFunction,
        args: &[Value],
    ) -> Result<Effective, Box<Raise>> {
        let methods = applicable_methods(image, generic, args);
        let (keys, keys_from) = accepted_keys(generic, &methods);
        Ok(Effective {
            shape: shape(image, generic, methods, args)?,
            keys,
            keys_from,
        })
    }
}

/// The applicable methods, most specific first.
pub(crate) fn applicable_methods(
    image: &Image,
    generic: &GenericFunction,
    args: &[Value],
) -> Vec<Rc<Method>> {
    let classes: Vec<Rc<Class>> = args
        .iter()
        .take(generic.parameters.borrow().required)
        .map(|arg| class_of(image, arg))
        .collect();
    let mut methods: Vec<Rc<Method>> = generic
        .methods
        .borrow()
        .iter()
        .filter(|m| applies(m, args, &classes))
        .cloned()
        .collect();
    let precedence = generic.precedence.borrow();
    methods.sort_by(|a, b| compare(a, b, &classes, &precedence));
    methods
}

fn applies(method: &Method, args: &[Value], classes: &[Rc<Class>]) -> bool {
    method
        .specializers
        .iter()
        .zip(args.iter().zip(classes))
        .all(|(specializer, (arg, class))| match specializer {
            Specializer::Eql(value) => value.is_eql(arg),
            Specializer::Class(wanted) => {
                wanted.name == known::T
                    || class
                        .precedence
                        .borrow()
                        .iter()
                        .any(|c| Rc::ptr_eq(c, wanted))
            }
        })
}

/// Which of two applicable methods is more specific, the leftmost argument deciding first unless
/// the generic function has another order.
fn compare(a: &Method, b: &Method, classes: &[Rc<Class>], precedence: &[usize]) -> Ordering {
    let by_argument = |i: &usize| {
        let (a, b) = (a.specializers.get(*i)?, b.specializers.get(*i)?);
        let class = classes.get(*i)?;
        Some(rank(a, class).cmp(&rank(b, class)))
    };
    if !precedence.is_empty() {
        return precedence
            .iter()
            .filter_map(by_argument)
            .find(|order| order.is_ne())
            .unwrap_or(Ordering::Equal);
    }
    a.specializers
        .iter()
        .zip(&b.specializers)
        .zip(classes)
        .map(|((a, b), class)| rank(a, class).cmp(&rank(b, class)))
        .find(|order| order.is_ne())
        .unwrap_or(Ordering::Equal)
}

fn rank(specializer: &Specializer, class: &Rc<Class>) -> usize {
    match specializer {
        Specializer::Eql(_) => 0,
        Specializer::Class(wanted) => class
            .precedence
            .borrow()
            .iter()
            .position(|c| Rc::ptr_eq(c, wanted))
            .map_or(usize::MAX, |i| i + 1),
    }
}

/// The keywords that the call accepts (none: anything), and where they begin.
fn accepted_keys(generic: &GenericFunction, methods: &[Rc<Method>]) -> (Option<Vec<Sym>>, usize) {
    let declared = generic.parameters.borrow();
    let from = declared.required + declared.optional;
    if declared.keys.is_none() && methods.iter().all(|m| m.parameters.keys.is_none()) {
        return (None, from);
    }
    let mut keys = Vec::new();
    let all = std::iter::once(&*declared).chain(methods.iter().map(|m| &m.parameters));
    for parameters in all {
        match &parameters.keys {
            _ if parameters.allows_other_keys => return (None, from),
            Some(names) => keys.extend(names),
            // `&rest` without `&key` accepts any keywords.
            None if parameters.has_rest => return (None, from),
            None => {}
        }
    }
    (Some(keys), from)
}

fn shape(
    image: &Image,
    generic: &GenericFunction,
    methods: Vec<Rc<Method>>,
    args: &[Value],
) -> Result<Shape, Box<Raise>> {
    let combination = generic.combination.get();
    let is_standard = combination.is_standard();
    if combination.is_long() && !methods.is_empty() {
        return Ok(Shape::Combined {
            around: Vec::new(),
            before: Vec::new(),
            primary: methods,
            after: Vec::new(),
            combination,
        });
    }
    let mut around = Vec::new();
    let mut before = Vec::new();
    let mut primary = Vec::new();
    let mut after = Vec::new();
    for method in methods {
        let qualifiers: Vec<Option<Sym>> = method.qualifiers.iter().map(Value::as_symbol).collect();
        match qualifiers.as_slice() {
            [Some(known::K_AROUND)] => around.push(method),
            [] if is_standard => primary.push(method),
            [Some(known::K_BEFORE)] if is_standard => before.push(method),
            [Some(known::K_AFTER)] if is_standard => after.push(method),
            [Some(qualifier)] if *qualifier == combination.name && !is_standard => {
                primary.push(method);
            }
            _ => return Err(bad_qualifiers(image, generic, &method)),
        }
    }
    after.reverse();
    if generic.most_specific_last.get() {
        primary.reverse();
    }
    if primary.is_empty() {
        return Ok(Shape::NotApplicable);
    }
    if is_standard && around.is_empty() && before.is_empty() && after.is_empty() {
        let first = primary[0].clone();
        if let Some(place) = accessor_place(&first, args) {
            return Ok(place);
        }
        if !first.takes_next {
            return Ok(Shape::Single(first));
        }
    }
    Ok(Shape::Combined {
        around,
        before,
        primary,
        after,
        combination,
    })
}

/// The direct access that an accessor method stands for.
fn accessor_place(method: &Rc<Method>, args: &[Value]) -> Option<Shape> {
    let (slot, object) = match method.accessor? {
        Accessor::Reader(slot) => (slot, args.first()?),
        Accessor::Writer(slot) => (slot, args.get(1)?),
    };
    let Value::Instance(instance) = object else {
        return None;
    };
    let class = instance.class();
    let index = class.slot_index(slot)?;
    let place = match &class.slots.borrow().get(index)?.shared {
        Some(shared) => SlotPlace::Shared(shared.clone()),
        None => SlotPlace::Local(index),
    };
    Some(match method.accessor? {
        Accessor::Reader(_) => Shape::Read(place, method.clone()),
        Accessor::Writer(_) => Shape::Write(place, method.clone()),
    })
}

fn bad_qualifiers(image: &Image, generic: &GenericFunction, method: &Method) -> Box<Raise> {
    let shown = |q: &Value| match q.as_symbol() {
        Some(symbol) => image.name(symbol).to_owned(),
        None => print::to_string(image, q, true),
    };
    let qualifiers: Vec<String> = method.qualifiers.iter().map(shown).collect();
    let combination = image.name(generic.combination.get().name);
    Raise::program(format!(
        "A method with qualifiers ({}) cannot be used with the method combination type {combination}.",
        qualifiers.join(" "),
    ))
}
