//! Calls of generic functions.
//!
//! The classes of the arguments that some method is specialized on (and, for `eql`
//! specializers, which of their values an argument is) form a key; the effective method of
//! each key is computed once. A key holds the generation of a class, so a redefined class
//! is a new key.

use std::rc::Rc;

use super::class_of::{builtin_class_name, class_of};
use super::combine;
use super::update;
use crate::image::Image;
use crate::value::Value;
use crate::value::cycles;
use crate::value::dispatch::{
    BUILTIN_TAG, Dispatch, EQL_TAG, Effective, Key, MAX_ENTRIES, MAX_PARTS, NO_PART, Part,
    Position, Shape, SlotPlace,
};
use crate::value::function::Function;
use crate::value::generic::{GenericFunction, Method};
use crate::value::known;
use crate::value::raise::Raise;
use crate::vm::machine::Machine;
use crate::vm::step::Step;

impl Dispatch {
    /// The key of a call; none if it has too many parts.
    #[inline]
    fn key(&self, image: &Image, args: &[Value]) -> Option<Key> {
        if self.positions.len() > MAX_PARTS {
            return None;
        }
        let mut key = [NO_PART; MAX_PARTS];
        for (part, position) in key.iter_mut().zip(&self.positions) {
            *part = position.part(image, args.get(position.index)?)?;
        }
        Some(key)
    }

    fn remember(&mut self, image: &Image, args: &[Value], key: Key, effective: Rc<Effective>) {
        if self.entries.len() >= MAX_ENTRIES {
            self.entries.clear();
            self.classes.clear();
        }
        for position in &self.positions {
            if let Some(arg @ Value::Instance(_)) = args.get(position.index) {
                self.classes.push(class_of(image, arg));
            }
        }
        self.entries.push((key, effective));
    }
}

impl Position {
    /// What an argument contributes; none for an instance that is named itself, since its class, too,
    /// decides which methods apply, and may change.
    #[inline]
    fn part(&self, image: &Image, arg: &Value) -> Option<Part> {
        if let Some(i) = self.eql_values.iter().position(|v| v.is_eql(arg)) {
            let is_instance = matches!(arg, Value::Instance(_));
            return (!is_instance).then_some((i, EQL_TAG));
        }
        Some(match arg {
            Value::Instance(instance) => {
                let class = instance.class.borrow();
                (Rc::as_ptr(&class) as usize, class.generation.get())
            }
            other => (builtin_class_name(image, other).0 as usize, BUILTIN_TAG),
        })
    }
}

/// Calls a generic function.
pub(crate) fn call_generic(
    machine: &mut Machine<'_>,
    function: &Rc<Function>,
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    let Some(generic) = function.as_generic() else {
        return Ok(Step::TailCall {
            function: Value::Function(function.clone()),
            args,
        });
    };
    if !generic.parameters.borrow().accepts(args.len()) {
        return Err(Raise::program(format!(
            "invalid number of arguments: {}",
            args.len()
        )));
    }
    if let Some(obsolete) = args.iter().find(|a| is_obsolete(a)) {
        let obsolete = obsolete.clone();
        return update::then_call(machine, obsolete, Value::Function(function.clone()), args);
    }
    let effective = effective_method(machine.image, generic, &args)?;
    if let Some(keys) = &effective.keys
        && args.len() > effective.keys_from
    {
        check_keys(machine.image, keys, &args[effective.keys_from..])?;
    }
    match &effective.shape {
        Shape::Read(place, _) => {
            if let Some(value) = place.read(&args) {
                return Ok(Step::Return(value));
            }
        }
        Shape::Write(place, _) => {
            if let Some(value) = place.write(&args) {
                return Ok(Step::Return(value));
            }
        }
        Shape::Single(_) | Shape::Combined { .. } => {}
        Shape::NotApplicable => return no_applicable_method(machine.image, function, args),
    }
    combine::run(machine, &effective, combine::START, args)
}

/// A call of a generic function that is no more than a slot or one function.
pub(crate) enum AtOnce {
    /// The value of the slot, which has been read or written.
    Slot(Value),
    /// The function of the only method that runs; it takes the arguments of the call.
    Method(Rc<Function>),
}

/// Calls a generic function with arguments that need not be moved, if the effective method is known and
/// that simple.
pub(crate) fn call_at_once(
    image: &Image,
    generic: &GenericFunction,
    args: &[Value],
) -> Option<AtOnce> {
    if !generic.parameters.borrow().accepts(args.len()) || args.iter().any(is_obsolete) {
        return None;
    }
    let mut dispatch = generic.dispatch.borrow_mut();
    let key = dispatch.key(image, args)?;
    let effective = dispatch.find(&key)?;
    if effective.keys.is_some() {
        return None;
    }
    match &effective.shape {
        Shape::Read(place, _) => place.read(args).map(AtOnce::Slot),
        Shape::Write(place, _) => place.write(args).map(AtOnce::Slot),
        Shape::Single(method) => method.alone(),
        Shape::Combined {
            around,
            before,
            primary,
            after,
            combination,
        } if combination.is_standard()
            && around.is_empty()
            && before.is_empty()
            && after.is_empty() =>
        {
            primary.first()?.alone()
        }
        _ => None,
    }
}

impl Method {
    /// A call of the method alone, if it does not take the next one.
    fn alone(&self) -> Option<AtOnce> {
        (!self.takes_next).then(|| AtOnce::Method(self.function.clone()))
    }
}

impl SlotPlace {
    /// The value of the slot of the instance that is the argument, if it has one.
    #[inline]
    fn read(&self, args: &[Value]) -> Option<Value> {
        let value = match (self, args.first()) {
            (SlotPlace::Local(index), Some(Value::Instance(instance))) => {
                instance.slots.borrow().get(*index)?.clone()
            }
            (SlotPlace::Local(_), _) => return None,
            (SlotPlace::Shared(slot), _) => slot.get(),
        };
        (!value.is_unbound()).then_some(value)
    }

    /// Stores the first argument in the slot of the second one.
    #[inline]
    fn write(&self, args: &[Value]) -> Option<Value> {
        match (self, args) {
            (SlotPlace::Local(index), [value, Value::Instance(instance)]) => {
                let mut slots = instance.slots.borrow_mut();
                let slot = slots.get_mut(*index)?;
                cycles::note(instance, value);
                let old = std::mem::replace(slot, value.clone());
                drop(slots);
                drop(old);
            }
            (SlotPlace::Shared(slot), [value, _]) => slot.set(value.clone()),
            _ => return None,
        }
        args.first().cloned()
    }
}

#[inline]
fn is_obsolete(arg: &Value) -> bool {
    matches!(arg, Value::Instance(instance) if instance.is_obsolete())
}

/// The effective method of a call, remembered or computed.
fn effective_method(
    image: &Image,
    generic: &GenericFunction,
    args: &[Value],
) -> Result<Rc<Effective>, Box<Raise>> {
    let mut dispatch = generic.dispatch.borrow_mut();
    let key = dispatch.key(image, args);
    if let Some(key) = &key
        && let Some(effective) = dispatch.find(key)
    {
        return Ok(effective.clone());
    }
    let effective = Rc::new(Effective::compute(image, generic, args)?);
    if let Some(key) = key {
        dispatch.remember(image, args, key, effective.clone());
    }
    Ok(effective)
}

/// Checks the keyword arguments of a call against those that its methods accept.
fn check_keys(image: &Image, keys: &[crate::Sym], args: &[Value]) -> Result<(), Box<Raise>> {
    if !args.len().is_multiple_of(2) {
        return Err(Raise::program("odd number of &KEY arguments"));
    }
    let pairs = || args.chunks_exact(2);
    let allowed = pairs()
        .find(|p| p[0].as_symbol() == Some(known::K_ALLOW_OTHER_KEYS))
        .is_some_and(|p| p[1].is_true());
    if allowed {
        return Ok(());
    }
    for pair in pairs() {
        match pair[0].as_symbol() {
            Some(known::K_ALLOW_OTHER_KEYS) => {}
            Some(key) if keys.contains(&key) => {}
            _ => {
                let shown = super::text(image, &pair[0]);
                return Err(Raise::unknown_key(
                    &shown,
                    keys.iter().map(|key| image.name(*key)),
                ));
            }
        }
    }
    Ok(())
}

/// Calls the user's `no-applicable-method`, or returns the error that no method applies.
fn no_applicable_method(
    image: &Image,
    function: &Rc<Function>,
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    let extended = image
        .function(known::NO_APPLICABLE_METHOD)
        .filter(|f| f.as_generic().is_some() && !Rc::ptr_eq(f, function));
    if let Some(handler) = extended {
        let mut all = vec![Value::Function(function.clone())];
        all.extend(args);
        return Ok(Step::TailCall {
            function: Value::Function(handler.clone()),
            args: all,
        });
    }
    Err(no_applicable_method_error(
        image,
        Value::Function(function.clone()),
        args,
    ))
}

/// The error for a call to which no method of a generic function applies.
pub(crate) fn no_applicable_method_error(
    image: &Image,
    function: Value,
    args: Vec<Value>,
) -> Box<Raise> {
    let args = Value::list(args);
    let report = format!(
        "There is no applicable method for the generic function\n  {}\nwhen called with arguments\n  {}.",
        super::text(image, &function),
        super::text(image, &args)
    );
    Raise::new(known::NO_APPLICABLE_METHOD_ERROR, report)
        .with(known::K_GENERIC_FUNCTION, function)
        .with(known::K_ARGUMENTS, args)
}
