//! Slot descriptions of `defclass` and `define-condition`, and what they evaluate to.

use std::rc::Rc;

use crate::image::Image;
use crate::value::Value;
use crate::value::class::{Initform, SlotDefinition};
use crate::value::form::{constant_value, form, quote};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::shared_slot::SharedSlot;
use crate::value::symbol::{Sym, VariableKind};

/// A parsed slot description.
struct Description {
    name: Sym,
    initargs: Vec<Value>,
    initform: Option<Value>,
    readers: Vec<Value>,
    writers: Vec<Value>,
    slot_type: Value,
    is_shared: bool,
    doc: Value,
}

/// A slot as the defining builtin gets it: its definition and its accessors.
pub(crate) struct DefinedSlot {
    /// The definition.
    pub slot: SlotDefinition,
    /// Names of reader functions.
    pub(crate) readers: Vec<Value>,
    /// Names of writer functions: symbols, or lists `(setf name)`.
    pub(crate) writers: Vec<Value>,
}

/// The form whose value [`evaluated_slot`] reads.
pub(crate) fn slot_form(
    image: &Image,
    description: &Value,
    definer: &str,
) -> Result<Value, Box<Raise>> {
    let description = describe(image, description, definer)?;
    let initform = match &description.initform {
        None => Value::NIL,
        Some(init) => init_form(init),
    };
    let list = |items: Vec<Value>| quote(Value::list(items));
    Ok(form![
        known::LIST,
        quote(description.name),
        list(description.initargs),
        initform,
        list(description.readers),
        list(description.writers),
        quote(description.slot_type),
        Value::bool(description.is_shared),
        description.doc,
    ])
}

/// A form for an initial value: evaluates to `(:value . constant)` or to a function.
pub(crate) fn init_form(init: &Value) -> Value {
    match constant_value(init) {
        Some(value) => quote(Value::cons(known::K_VALUE.into(), value)),
        None => form![known::LAMBDA, Value::NIL, init.clone()],
    }
}

/// The initial value that [`init_form`] has described.
pub(crate) fn evaluated_init(value: &Value) -> Option<Initform> {
    match value {
        Value::Function(function) => Some(Initform::Function(function.clone())),
        Value::Cons(pair) => Some(Initform::Value(pair.cdr())),
        _ => None,
    }
}

/// Reads back what a slot form evaluated to.
pub(crate) fn evaluated_slot(value: &Value) -> Option<DefinedSlot> {
    let parts = value.list_to_vec()?;
    let [
        name,
        initargs,
        init,
        readers,
        writers,
        slot_type,
        is_shared,
        doc,
    ] = parts.as_slice()
    else {
        return None;
    };
    let mut slot = SlotDefinition::new(name.as_symbol()?);
    slot.initargs = initargs.iter_list().filter_map(|k| k.as_symbol()).collect();
    slot.initform = evaluated_init(init);
    slot.slot_type = slot_type.clone();
    slot.doc = doc.as_text().map(Into::into);
    slot.shared = is_shared.is_true().then(|| Rc::new(SharedSlot::default()));
    Some(DefinedSlot {
        slot,
        readers: readers.iter_list().collect(),
        writers: writers.iter_list().collect(),
    })
}

fn describe(image: &Image, description: &Value, definer: &str) -> Result<Description, Box<Raise>> {
    let malformed = || {
        Raise::program(format!(
            "{} is not a slot description of {definer}: it must be a name or a list of a name and options.",
            super::text(image, description)
        ))
    };
    let (name, options) = match description {
        Value::Symbol(name, ..) => (*name, Vec::new()),
        Value::Cons(cons) => (
            cons.car().as_symbol().ok_or_else(malformed)?,
            cons.cdr().list_to_vec().ok_or_else(malformed)?,
        ),
        _ => return Err(malformed()),
    };
    if image.is_keyword(name) || image.symbol(name).kind == VariableKind::Constant {
        let shown = super::text(image, &name.into());
        let what = match image.is_keyword(name) {
            true => "a keyword",
            false => "a constant",
        };
        return Err(Raise::program(format!(
            "The name {shown} of a slot in {definer} is {what}. A slot with options is a list of its own: ((x :initarg :x))."
        )));
    }
    if !options.len().is_multiple_of(2) {
        return Err(malformed());
    }
    let mut result = Description {
        name,
        initargs: Vec::new(),
        initform: None,
        readers: Vec::new(),
        writers: Vec::new(),
        slot_type: Value::T,
        is_shared: false,
        doc: Value::NIL,
    };
    let mut seen = Vec::new();
    for option in options.chunks_exact(2) {
        let value = option[1].clone();
        let key = option[0].as_symbol();
        if matches!(
            key,
            Some(known::K_INITFORM | known::K_TYPE | known::K_ALLOCATION | known::K_DOCUMENTATION)
        ) {
            if seen.contains(&key) {
                return Err(Raise::program(format!(
                    "Duplicate slot option {} for slot {} in {definer}.",
                    super::text(image, &option[0]),
                    image.name(name)
                )));
            }
            seen.push(key);
        }
        match option[0].as_symbol() {
            Some(known::K_INITARG) => result.initargs.push(value),
            Some(known::K_INITFORM) => result.initform = Some(value),
            Some(known::K_READER) => result.readers.push(value),
            Some(known::K_WRITER) => result.writers.push(value),
            Some(known::K_ACCESSOR) => {
                result.writers.push(form![known::SETF, value.clone()]);
                result.readers.push(value);
            }
            Some(known::K_TYPE) => result.slot_type = value,
            Some(known::K_ALLOCATION) => {
                result.is_shared = value.as_symbol() == Some(known::K_CLASS);
            }
            Some(known::K_DOCUMENTATION) => result.doc = value,
            _ => {
                return Err(Raise::program(format!(
                    "Invalid slot option {} for slot {} in {definer}.",
                    super::text(image, &option[0]),
                    image.name(name)
                )));
            }
        }
    }
    Ok(result)
}
