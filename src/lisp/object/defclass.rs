//! `defclass` and `define-condition`: their expansion, and the builtin behind it.

use super::define::ClassDefinition;
use super::method::{MethodDefinition, define_method, remove_method};
use super::slot_options::{DefinedSlot, evaluated_init, evaluated_slot, init_form, slot_form};
use crate::image::Image;
use crate::typed::{self, builtin};
use crate::value::Value;
use crate::value::class::{Class, ClassKind};
use crate::value::form::{doc_form, form, quote};
use crate::value::function::Function;
use crate::value::generic::{Accessor, Specializer};
use crate::value::known;
use crate::value::parameters::Parameters;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use std::rc::Rc;

/// `(defclass name superclasses slots options…)`.
pub(crate) fn expand_defclass(image: &mut Image, whole: &Value) -> Result<Value, Box<Raise>> {
    let definition = Definition::read(image, whole, "DEFCLASS")?;
    Ok(definition.form(known::SYS_DEFINE_CLASS, Value::NIL))
}

/// `(define-condition name superclasses slots options…)`.
pub(crate) fn expand_define_condition(
    image: &mut Image,
    whole: &Value,
) -> Result<Value, Box<Raise>> {
    let definition = Definition::read(image, whole, "DEFINE-CONDITION")?;
    let report = definition.report_form(image)?;
    Ok(definition.form(known::SYS_DEFINE_CONDITION, report))
}

struct Definition {
    name: Value,
    superclasses: Value,
    slots: Vec<Value>,
    default_initargs: Vec<Value>,
    report: Option<Value>,
    doc: Option<Rc<str>>,
    /// Warnings of options without effect.
    ignored: Vec<Value>,
}

impl Definition {
    fn read(image: &Image, whole: &Value, definer: &str) -> Result<Definition, Box<Raise>> {
        let parts = whole.list_to_vec().unwrap_or_default();
        let [_, name, superclasses, slots, options @ ..] = parts.as_slice() else {
            return Err(Raise::program(format!(
                "{definer} takes a name, a list of superclasses and a list of slots."
            )));
        };
        if name.as_symbol().is_none_or(|n| n == known::NIL) {
            return Err(Raise::program(format!(
                "{} is not a class name.",
                super::text(image, name)
            )));
        }
        let names = superclasses.list_to_vec().unwrap_or_default();
        if !superclasses.is_list() || names.iter().any(|n| n.as_symbol().is_none()) {
            return Err(Raise::program(format!(
                "{} is not a list of superclasses.",
                super::text(image, superclasses)
            )));
        }
        let Some(slots) = slots.list_to_vec() else {
            return Err(Raise::program(format!(
                "{} is not a list of slots.",
                super::text(image, slots)
            )));
        };
        let mut definition = Definition {
            name: name.clone(),
            superclasses: superclasses.clone(),
            slots: Vec::new(),
            default_initargs: Vec::new(),
            report: None,
            doc: None,
            ignored: Vec::new(),
        };
        let mut seen: Vec<Value> = Vec::new();
        for slot in &slots {
            let name = match slot {
                Value::Cons(c) => c.car(),
                other => other.clone(),
            };
            if seen.iter().any(|s| s.is_eq(&name)) {
                return Err(Raise::program(format!(
                    "There is more than one direct slot with the name {}.",
                    super::text(image, &name)
                )));
            }
            seen.push(name);
            definition.slots.push(slot_form(image, slot, definer)?);
        }
        for option in options {
            definition.add_option(image, option, definer)?;
        }
        Ok(definition)
    }

    fn add_option(
        &mut self,
        image: &Image,
        option: &Value,
        definer: &str,
    ) -> Result<(), Box<Raise>> {
        let values = option.cdr_or_nil();
        match option.car_or_nil().as_symbol() {
            Some(known::K_DEFAULT_INITARGS) => {
                let pairs = values.list_to_vec().unwrap_or_default();
                for pair in pairs.chunks(2) {
                    let [key, init] = pair else {
                        return Err(Raise::program("odd number of :DEFAULT-INITARGS"));
                    };
                    let mut others = pairs.chunks(2).filter(|other| other[0].is_eq(key));
                    if others.nth(1).is_some() {
                        return Err(Raise::program(format!(
                            "{} stands twice among the :DEFAULT-INITARGS of {definer}.",
                            super::text(image, key)
                        )));
                    }
                    self.default_initargs.push(form![
                        known::CONS,
                        quote(key.clone()),
                        init_form(init)
                    ]);
                }
            }
            Some(known::K_DOCUMENTATION) => {
                self.doc = values.car_or_nil().as_text().map(Into::into);
            }
            Some(known::K_REPORT) if definer == "DEFINE-CONDITION" => {
                self.report = Some(values.car_or_nil());
            }
            Some(known::K_METACLASS) if definer == "DEFCLASS" => {
                if values.car_or_nil().as_symbol() != Some(known::STANDARD_CLASS) {
                    self.ignored.push(super::warning_of_ignored(image, option));
                }
            }
            _ => {
                return Err(Raise::program(format!(
                    "Invalid option {} of {definer}.",
                    super::text(image, option)
                )));
            }
        }
        Ok(())
    }

    /// A form for a function that writes the report of a condition to a stream.
    fn report_form(&self, image: &mut Image) -> Result<Value, Box<Raise>> {
        Ok(match &self.report {
            None => Value::NIL,
            Some(text @ Value::Str(_)) => {
                let condition = image.gensym("CONDITION");
                let stream = image.gensym("STREAM");
                form![
                    known::LAMBDA,
                    form![condition.clone(), stream.clone()],
                    form![known::DECLARE, form![known::IGNORE, condition]],
                    form![known::WRITE_STRING, text.clone(), stream],
                ]
            }
            Some(function) => form![known::FUNCTION, function.clone()],
        })
    }

    fn form(self, definer: Sym, last: Value) -> Value {
        let ignored = Value::list(self.ignored);
        let definition = form![
            definer,
            quote(self.name),
            quote(self.superclasses),
            form![known::LIST; Value::list(self.slots)],
            form![known::LIST; Value::list(self.default_initargs)],
            doc_form(self.doc.as_ref()),
            last,
        ];
        if ignored.is_nil() {
            return definition;
        }
        form![known::PROG1, definition; ignored]
    }
}

/// Defines a class as DEFCLASS describes it.
#[builtin("%DEFINE-CLASS")]
pub(crate) fn define_class(
    image: &mut Image,
    name: Sym,
    superclasses: &Value,
    slots: &Value,
    default_initargs: &Value,
    documentation: &Value,
    _last: &Value,
) -> Result<Value, Box<Raise>> {
    let rest = [slots, default_initargs, documentation];
    define(image, ClassKind::Standard, name, superclasses, rest).map(Value::Class)
}

/// Defines a condition as DEFINE-CONDITION describes it.
#[builtin("%DEFINE-CONDITION")]
pub fn define_condition(
    image: &mut Image,
    name: Sym,
    superclasses: &Value,
    slots: &Value,
    default_initargs: &Value,
    documentation: &Value,
    report: &Value,
) -> Result<Sym, Box<Raise>> {
    let rest = [slots, default_initargs, documentation];
    let class = define(image, ClassKind::Condition, name, superclasses, rest)?;
    *class.report.borrow_mut() = match report {
        Value::Function(report) => Some(report.clone()),
        _ => None,
    };
    Ok(class.name)
}

fn define(
    image: &mut Image,
    kind: ClassKind,
    name: Sym,
    superclasses: &Value,
    [slots, default_initargs, doc]: [&Value; 3],
) -> Result<Rc<Class>, Box<Raise>> {
    let slots: Vec<DefinedSlot> = slots
        .iter_list()
        .filter_map(|s| evaluated_slot(&s))
        .collect();
    let default_initargs = default_initargs
        .iter_list()
        .filter_map(|pair| {
            let key = pair.car_or_nil().as_symbol()?;
            Some((key, evaluated_init(&pair.cdr_or_nil())?))
        })
        .collect();
    let class = image.define_class(ClassDefinition {
        name,
        kind,
        superclasses: superclasses
            .iter_list()
            .filter_map(|s| s.as_symbol())
            .collect(),
        slots: slots.iter().map(|s| s.slot.clone()).collect(),
        default_initargs,
        doc: doc.as_text().map(Into::into),
    })?;
    remove_accessors(image, &class);
    for slot in &slots {
        for reader in &slot.readers {
            add_accessor(image, reader, &class, Accessor::Reader(slot.slot.name))?;
        }
        for writer in &slot.writers {
            add_accessor(image, writer, &class, Accessor::Writer(slot.slot.name))?;
        }
    }
    Ok(class)
}

/// Adds the method that reads or writes a slot.
fn add_accessor(
    image: &mut Image,
    name: &Value,
    class: &Rc<Class>,
    accessor: Accessor,
) -> Result<(), Box<Raise>> {
    let of_class = Specializer::Class(class.clone());
    let (specializers, function) = match accessor {
        Accessor::Reader(slot) => {
            let function =
                Function::control_of(slot, (1, Some(1)), (), move |(), machine, args| {
                    let object = args.first().cloned().unwrap_or(Value::NIL);
                    super::access::slot_value(machine, &object, &Value::symbol(slot))
                });
            (vec![of_class], function)
        }
        Accessor::Writer(slot) => {
            let function =
                Function::control_of(slot, (2, Some(2)), (), move |(), machine, args| {
                    let value = args.first().cloned().unwrap_or(Value::NIL);
                    let object = args.get(1).cloned().unwrap_or(Value::NIL);
                    super::access::set_slot_value(machine, value, &object, &Value::symbol(slot))
                });
            let anything = match image.class(known::T) {
                Some(class) => Specializer::Class(class.clone()),
                None => of_class.clone(),
            };
            (vec![anything, of_class], function)
        }
    };
    let method = define_method(
        image,
        MethodDefinition {
            name: name.clone(),
            qualifiers: Vec::new(),
            parameters: Parameters::required(specializers.len()),
            specializers,
            function,
            takes_next: false,
            accessor: Some(accessor),
            doc: None,
        },
    )?;
    class.accessors.borrow_mut().push(method);
    Ok(())
}

/// Removes the accessors of an earlier definition of the class.
fn remove_accessors(image: &Image, class: &Class) {
    for method in class.accessors.take() {
        let function = image.named_function(&method.name);
        if let Some(generic) = function.as_ref().and_then(|f| f.as_generic()) {
            remove_method(generic, &method);
        }
    }
}
