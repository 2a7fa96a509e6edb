//! Creating, reading and linking designators.

use super::value;
use super::value::{Class, Designator, Quantifier};
use crate::packages;
use lisp::builtin::{Builtin, Operator};
use lisp::image::Image;
use lisp::print;
use lisp::typed::FromValue;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The list of properties.
///
/// `(desig:properties (desig:an object (type bottle)))` => `((:TYPE :BOTTLE))`
#[builtin]
fn properties(designator: &Designator) -> Result<Value> {
    description(designator)
}

/// :A or :ALL.
///
/// `(desig:quantifier (desig:an object))` => `:A`
#[builtin]
fn quantifier(image: &mut Image, designator: &Designator) -> Result<Value> {
    let name = designator.quantifier.name();
    Ok(image.keyword(name).into())
}

/// The newest designator that was equated with this one.
///
/// `(desig:current-desig nil)` => `NIL`
#[builtin]
fn current_desig(designator: &Value) -> Result<Value> {
    Ok(value::current(designator))
}

/// The oldest designator that was equated with this one.
///
/// `(desig:first-desig nil)` => `NIL`
#[builtin]
fn first_desig(designator: &Value) -> Result<Value> {
    Ok(value::first(designator))
}

/// The designator that this one was equated to, or NIL.
///
/// `(desig:parent (desig:an object))` => `NIL`
#[builtin]
fn parent(designator: &Designator) -> Result<Value> {
    let link = designator.parent.borrow().clone();
    Ok(link.unwrap_or(Value::NIL))
}

/// The designator that was equated to this one, or NIL.
///
/// `(desig:successor (desig:an object))` => `NIL`
#[builtin]
fn successor(designator: &Designator) -> Result<Value> {
    let link = designator.successor.borrow().clone();
    Ok(link.unwrap_or(Value::NIL))
}

/// Were two designators equated?
///
/// `(desig:desig-equal (desig:an object) (desig:an object))` => `NIL`
#[builtin]
fn desig_equal(designator: &Value, other: &Value) -> bool {
    value::equal(designator, other)
}

/// Are all properties of the first list among those of the second?
///
/// `(desig:desig-descr-included '((:a 1)) '((:b 2) (:a 1)))` => `T`
#[builtin(_, "description other")]
fn desig_descr_included(description: &Value, other_value: &Value) -> bool {
    let other: Vec<Value> = other_value.iter_list().collect();
    description
        .iter_list()
        .all(|p| other.iter().any(|q| lisp::value::equality::equal(&p, q)))
}

/// Does the designator refer to something known by effect, such as a perceived object?
///
/// `(desig:effective (desig:an object))` => `NIL`
#[builtin]
fn effective(designator: &Designator) -> bool {
    designator.is_effective.get()
}

/// What the designator refers to, as far as it is known; else NIL.
///
/// `(desig:data (desig:an object))` => `NIL`
#[builtin]
fn data(designator: &Designator) -> Result<Value> {
    let data = designator.data.borrow().clone();
    Ok(data.unwrap_or(Value::NIL))
}

/// Is this a designator?
///
/// `(desig:designator-p 1)` => `NIL`
#[builtin]
fn designator_p(object: &Value) -> bool {
    value::as_designator(object).is_some()
}

/// Macros of package `CRAM-DESIGNATORS`.
pub(crate) static OPERATORS: &[Operator] = &[
    Operator {
        name: "WITH-DESIGNATORS",
        lambda_list: "((variable class properties)…) &body body",
        doc: "Binds variables to designators made of lists of properties.",
        examples: &[
            "(desig:with-designators ((cup :object '((:type :cup)))) (desig:desig-prop-value cup :type)) => :CUP",
        ],
        expand: Some(with_designators),
    },
    Operator {
        name: "WITH-DESIG-PROPS",
        lambda_list: "properties designator &body body",
        doc: "Binds variables to the values of the properties of those names.",
        examples: &[
            "(desig:with-desig-props (type) (desig:an object (type bottle)) type) => :BOTTLE",
        ],
        expand: Some(with_desig_props),
    },
];

fn list(items: Vec<Value>) -> Value {
    Value::list(items)
}

/// The class that a symbol or string names.
impl FromValue<'_> for Class {
    fn from_value(image: &mut Image, value: &Value) -> Result<Self> {
        let name = match value {
            Value::Symbol(sym, ..) => image.name(*sym).to_owned(),
            Value::Str(text) => text.text(),
            other => return Err(Raise::type_error(other, known::SYMBOL)),
        };
        Class::named(&name)
            .ok_or_else(|| Raise::simple(format!("Designator type `{name}' undefined")))
    }
}

/// What (a TYPE …) expands into; NIL among the properties is left out.
#[builtin]
fn designator_of_form(
    image: &mut Image,
    quantifier: &Value,
    class: Class,
    properties: &Value,
) -> Result<Value> {
    let quantifier = match quantifier.as_symbol().map(|s| image.name(s)) {
        Some("ALL") => Quantifier::All,
        _ => Quantifier::A,
    };
    let properties = checked_description(image, properties)?;
    let designator = Designator::new(image, class, quantifier, properties);
    Ok(Value::foreign(designator))
}

/// A designator from a list of properties; a parent is equated with it.
///
/// `(desig:desig-prop-value (desig:make-designator :object '((:type :bottle))) :type)` => `:BOTTLE`
#[builtin]
fn make_designator(
    image: &mut Image,
    class: Class,
    description: &Value,
    parent: Option<&Value>,
) -> Result<Value> {
    let description = checked_description(image, description)?;
    let made = Value::foreign(Designator::new(image, class, Quantifier::A, description));
    if let Some(parent) = parent.filter(|parent| parent.is_true()) {
        value::designator(image, parent)?;
        value::equate(parent, &made);
    }
    Ok(made)
}

/// A list of properties without those that are `NIL`.
fn checked_description(image: &Image, description: &Value) -> Result<Value> {
    let Some(items) = description.list_to_vec() else {
        return Err(Raise::type_error(description, known::LIST));
    };
    for item in &items {
        if !item.is_list() {
            return Err(Raise::simple(format!(
                "{} is not a property: a list (:key value) was expected.",
                print::to_string(image, item, true)
            )));
        }
    }
    Ok(list(items.into_iter().filter(Value::is_true).collect()))
}

/// The list of properties.
///
/// `(desig:description (desig:an object (type bottle)))` => `((:TYPE :BOTTLE))`
#[builtin]
fn description(designator: &Designator) -> Result<Value> {
    Ok(designator.description.borrow().clone())
}

/// The first value of a property, or NIL.
///
/// `(desig:desig-prop-value (desig:an object (type bottle)) :type)` => `:BOTTLE`
#[builtin("DESIG-PROP-VALUE")]
fn prop_value(designator: &Value, key: &Value) -> Result<Value> {
    Ok(prop_values(designator, key)?.car_or_nil())
}

/// The first values of all properties of a key.
///
/// `(desig:desig-prop-values (desig:an action (tool a) (tool b)) :tool)` => `(:A :B)`
#[builtin("DESIG-PROP-VALUES")]
fn prop_values(designator: &Value, key: &Value) -> Result<Value> {
    let Some(designator) = value::as_designator(designator) else {
        return Ok(Value::NIL);
    };
    let values = designator
        .properties()
        .into_iter()
        .filter(|(k, _)| lisp::value::equality::equal(k, key))
        .map(|(_, values)| values.car_or_nil())
        .collect();
    Ok(list(values))
}

/// Says that two designators describe the same thing, the second knowing better; the second.
///
/// `(let ((a (desig:an object (type cup))) (b (desig:an object (type cup) (color red)))) (desig:equate a b) (eq (desig:current-desig a) b))` => `T`
#[builtin]
fn equate(image: &mut Image, parent: &Value, successor: &Value) -> Result<Value> {
    value::designator(image, parent)?;
    value::designator(image, successor)?;
    if value::equate(parent, successor) {
        return Ok(successor.clone());
    }
    Err(Raise::simple(
        "Cannot equate designators that are already equal.",
    ))
}

/// A designator like another one, but with other properties.
fn like(image: &mut Image, original: &Designator, properties: Vec<Value>) -> Value {
    let description = list(properties);
    Value::foreign(Designator::new(
        image,
        original.class,
        original.quantifier,
        description,
    ))
}

/// A designator of its own; the new properties take the place of those with the same keys.
///
/// `(desig:properties (desig:copy-designator (desig:an object (type a)) :new-description '((:type :b))))` => `((:TYPE :B))`
#[builtin("COPY-DESIGNATOR")]
fn copy(
    image: &mut Image,
    designator: &Designator,
    #[key] new_description: Option<Value>,
) -> Result<Value> {
    let new = checked_description(image, &new_description.unwrap_or(Value::NIL))?;
    let new: Vec<Value> = new.iter_list().collect();
    let mut properties: Vec<Value> = designator
        .description
        .borrow()
        .iter_list()
        .filter(|p| !new.iter().any(|n| n.car_or_nil().is_eql(&p.car_or_nil())))
        .collect();
    properties.extend(new);
    Ok(like(image, designator, properties))
}

/// A designator with more properties.
///
/// `(desig:properties (desig:extend-designator-properties (desig:an object (type a)) '((:name :b))))` => `((:TYPE :A) (:NAME :B))`
#[builtin("EXTEND-DESIGNATOR-PROPERTIES")]
fn extend(image: &mut Image, designator: &Designator, properties: &Value) -> Result<Value> {
    let original = designator;
    let new = checked_description(image, properties)?;
    let mut properties: Vec<Value> = original.description.borrow().iter_list().collect();
    properties.extend(new.iter_list());
    Ok(like(image, original, properties))
}

/// A designator in which a property has another key.
///
/// `(desig:properties (desig:rename-designator-property-key (desig:an object (type a)) :type :kind))` => `((:KIND :A))`
#[builtin("RENAME-DESIGNATOR-PROPERTY-KEY")]
fn rename(image: &mut Image, designator: &Designator, old: &Value, new: Value) -> Result<Value> {
    let original = designator;
    let properties = original
        .description
        .borrow()
        .iter_list()
        .map(|p| match &p {
            Value::Cons(cons) if cons.car().is_eql(old) => Value::cons(new.clone(), cons.cdr()),
            _ => p,
        })
        .collect();
    Ok(like(image, original, properties))
}

/// A designator with the properties of all; those of the first win.
///
/// `(desig:desig-prop-value (desig:merge-designators (desig:an object (type cup)) (desig:an object (color red))) :color)` => `:RED`
#[builtin("MERGE-DESIGNATORS", "designator other &rest others")]
fn merge(image: &mut Image, first: &Designator, others: &[Value]) -> Result<Value> {
    let mut properties: Vec<Value> = first.description.borrow().iter_list().collect();
    for other in others {
        let other = value::designator(image, other)?;
        for property in other.description.borrow().iter_list() {
            let key = property.car_or_nil();
            if !properties.iter().any(|p| p.car_or_nil().is_eql(&key)) {
                properties.push(property);
            }
        }
    }
    Ok(like(image, first, properties))
}

/// A designator equated to the parent that refers to the data object.
#[builtin("MAKE-EFFECTIVE-DESIGNATOR")]
fn make_effective(
    image: &mut Image,
    parent: &Value,
    #[key] new_properties: Option<&Value>,
    #[key] data_object: Option<Value>,
    #[key] _timestamp: Option<&Value>,
) -> Result<Value> {
    let original = value::designator(image, parent)?;
    let properties = match new_properties {
        Some(list) => checked_description(image, list)?.iter_list().collect(),
        None => original.description.borrow().iter_list().collect(),
    };
    let made = like(image, original, properties);
    if let Some(new) = value::as_designator(&made) {
        *new.data.borrow_mut() = data_object;
        value::note_changed(&made);
        new.is_effective.set(true);
    }
    value::equate(parent, &made);
    Ok(made)
}

/// The newest designator of the chain that refers to something known by effect, or NIL.
///
/// `(desig:newest-effective-designator (desig:an object))` => `NIL`
#[builtin("NEWEST-EFFECTIVE-DESIGNATOR")]
fn newest_effective(designator: &Value) -> Result<Value> {
    let mut at = value::current(designator);
    while let Some(designator) = value::as_designator(&at) {
        if designator.is_effective.get() {
            return Ok(at);
        }
        let parent = designator.parent.borrow().clone();
        at = parent.unwrap_or(Value::NIL);
    }
    Ok(Value::NIL)
}

/// `(let* ((variable (make-designator class properties)) …) body…)`.
fn with_designators(image: &mut Image, form: &Value) -> Result<Value> {
    let rest = form.cdr_or_nil();
    let maker = packages::symbol(image, "CRAM-DESIGNATORS", "MAKE-DESIGNATOR");
    let mut bindings = Vec::new();
    for definition in rest.car_or_nil().iter_list() {
        let variable = definition.car_or_nil();
        let mut class = definition.cdr_or_nil().car_or_nil();
        let mut properties = definition.cdr_or_nil().cdr_or_nil().car_or_nil();
        // `(variable (class properties))` is accepted, too.
        if let Value::Cons(inner) = &class {
            properties = inner.cdr().car_or_nil();
            class = inner.car();
        }
        let class = list(vec![known::QUOTE.into(), class]);
        let made = list(vec![maker.into(), class, properties]);
        bindings.push(list(vec![variable, made]));
    }
    Ok(Value::list_with_tail(
        [known::LET_STAR.into(), list(bindings)],
        rest.cdr_or_nil(),
    ))
}

/// `(let* ((d designator) (key (desig-prop-value d :key)) …) body…)`.
fn with_desig_props(image: &mut Image, form: &Value) -> Result<Value> {
    let rest = form.cdr_or_nil();
    let (names, rest) = (rest.car_or_nil(), rest.cdr_or_nil());
    let (designator, body) = (rest.car_or_nil(), rest.cdr_or_nil());
    let variable = image.gensym("DESIG");
    let reader = packages::symbol(image, "CRAM-DESIGNATORS", "DESIG-PROP-VALUE");
    let mut bindings = vec![list(vec![variable.clone(), designator])];
    for name in names.iter_list() {
        // As in `with-slots`, `(variable key)` gives the variable a name of its own.
        let (name, key) = match &name {
            Value::Cons(pair) => (pair.car(), pair.cdr().car_or_nil()),
            _ => (name.clone(), name.clone()),
        };
        let Some(key) = key.as_symbol() else {
            return Err(Raise::type_error(&key, known::SYMBOL));
        };
        let key: Sym = {
            let text = image.name(key).to_owned();
            image.keyword(&text)
        };
        let read = list(vec![reader.into(), variable.clone(), key.into()]);
        bindings.push(list(vec![name, read]));
    }
    Ok(Value::list_with_tail(
        [known::LET_STAR.into(), list(bindings)],
        body,
    ))
}

/// Functions of package `CRAM-DESIGNATORS`.
pub(crate) static TABLE: &[Builtin] = builtins![
    designator_of_form,
    make_designator,
    description,
    properties,
    prop_value,
    prop_values,
    quantifier,
    equate,
    current_desig,
    first_desig,
    parent,
    successor,
    desig_equal,
    copy,
    extend,
    rename,
    merge,
    desig_descr_included,
    effective,
    data,
    make_effective,
    newest_effective,
    designator_p,
];
