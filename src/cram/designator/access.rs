//! Creating, reading and linking designators.

use super::value;
use super::value::{Class, Designator, Quantifier};
use crate::packages;
use lisp::builtin::{Builtin, Operator, pure};
use lisp::builtins::keywords;
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Functions of package `CRAM-DESIGNATORS`.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "DESIGNATOR-OF-FORM",
        "quantifier class properties",
        "What (a TYPE …) expands into; NIL among the properties is left out.",
        &[],
        designator_of_form,
    ),
    pure(
        "MAKE-DESIGNATOR",
        "class description &optional parent",
        "A designator from a list of properties; a parent is equated with it.",
        &[
            "(desig:desig-prop-value (desig:make-designator :object '((:type :bottle))) :type) => :BOTTLE",
        ],
        make_designator,
    ),
    pure(
        "DESCRIPTION",
        "designator",
        "The list of properties.",
        &["(desig:description (desig:an object (type bottle))) => ((:TYPE :BOTTLE))"],
        description,
    ),
    pure(
        "PROPERTIES",
        "designator",
        "The list of properties.",
        &["(desig:properties (desig:an object (type bottle))) => ((:TYPE :BOTTLE))"],
        description,
    ),
    pure(
        "DESIG-PROP-VALUE",
        "designator key",
        "The first value of a property, or NIL.",
        &["(desig:desig-prop-value (desig:an object (type bottle)) :type) => :BOTTLE"],
        prop_value,
    ),
    pure(
        "DESIG-PROP-VALUES",
        "designator key",
        "The first values of all properties of a key.",
        &["(desig:desig-prop-values (desig:an action (tool a) (tool b)) :tool) => (:A :B)"],
        prop_values,
    ),
    pure(
        "QUANTIFIER",
        "designator",
        ":A or :ALL.",
        &["(desig:quantifier (desig:an object)) => :A"],
        |image, args| {
            let name = value::designator(image, &args[0])?.quantifier.name();
            Ok(image.keyword(name).into())
        },
    ),
    pure(
        "EQUATE",
        "parent successor",
        "Says that two designators describe the same thing, the second knowing better; the second.",
        &[
            "(let ((a (desig:an object (type cup))) (b (desig:an object (type cup) (color red)))) (desig:equate a b) (eq (desig:current-desig a) b)) => T",
        ],
        equate,
    ),
    pure(
        "CURRENT-DESIG",
        "designator",
        "The newest designator that was equated with this one.",
        &["(desig:current-desig nil) => NIL"],
        |_, args| Ok(value::current(&args[0])),
    ),
    pure(
        "FIRST-DESIG",
        "designator",
        "The oldest designator that was equated with this one.",
        &["(desig:first-desig nil) => NIL"],
        |_, args| Ok(value::first(&args[0])),
    ),
    pure(
        "PARENT",
        "designator",
        "The designator that this one was equated to, or NIL.",
        &["(desig:parent (desig:an object)) => NIL"],
        |image, args| {
            let link = value::designator(image, &args[0])?.parent.borrow().clone();
            Ok(link.unwrap_or(Value::NIL))
        },
    ),
    pure(
        "SUCCESSOR",
        "designator",
        "The designator that was equated to this one, or NIL.",
        &["(desig:successor (desig:an object)) => NIL"],
        |image, args| {
            let link = value::designator(image, &args[0])?
                .successor
                .borrow()
                .clone();
            Ok(link.unwrap_or(Value::NIL))
        },
    ),
    pure(
        "DESIG-EQUAL",
        "designator other",
        "Were two designators equated?",
        &["(desig:desig-equal (desig:an object) (desig:an object)) => NIL"],
        |_, args| Ok(Value::bool(value::equal(&args[0], &args[1]))),
    ),
    pure(
        "COPY-DESIGNATOR",
        "designator &key new-description",
        "A designator of its own; the new properties take the place of those with the same keys.",
        &[
            "(desig:properties (desig:copy-designator (desig:an object (type a)) :new-description '((:type :b)))) => ((:TYPE :B))",
        ],
        copy,
    ),
    pure(
        "EXTEND-DESIGNATOR-PROPERTIES",
        "designator properties",
        "A designator with more properties.",
        &[
            "(desig:properties (desig:extend-designator-properties (desig:an object (type a)) '((:name :b)))) => ((:TYPE :A) (:NAME :B))",
        ],
        extend,
    ),
    pure(
        "RENAME-DESIGNATOR-PROPERTY-KEY",
        "designator old new",
        "A designator in which a property has another key.",
        &[
            "(desig:properties (desig:rename-designator-property-key (desig:an object (type a)) :type :kind)) => ((:KIND :A))",
        ],
        rename,
    ),
    pure(
        "MERGE-DESIGNATORS",
        "designator other &rest others",
        "A designator with the properties of all; those of the first win.",
        &[
            "(desig:desig-prop-value (desig:merge-designators (desig:an object (type cup)) (desig:an object (color red))) :color) => :RED",
        ],
        merge,
    ),
    pure(
        "DESIG-DESCR-INCLUDED",
        "description other",
        "Are all properties of the first list among those of the second?",
        &["(desig:desig-descr-included '((:a 1)) '((:b 2) (:a 1))) => T"],
        |_, args| {
            let other: Vec<Value> = args[1].iter_list().collect();
            let included = args[0]
                .iter_list()
                .all(|p| other.iter().any(|q| lisp::value::equality::equal(&p, q)));
            Ok(Value::bool(included))
        },
    ),
    pure(
        "EFFECTIVE",
        "designator",
        "Does the designator refer to something known by effect, such as a perceived object?",
        &["(desig:effective (desig:an object)) => NIL"],
        |image, args| {
            let designator = value::designator(image, &args[0])?;
            Ok(Value::bool(designator.is_effective.get()))
        },
    ),
    pure(
        "DATA",
        "designator",
        "What the designator refers to, as far as it is known; else NIL.",
        &["(desig:data (desig:an object)) => NIL"],
        |image, args| {
            let data = value::designator(image, &args[0])?.data.borrow().clone();
            Ok(data.unwrap_or(Value::NIL))
        },
    ),
    pure(
        "MAKE-EFFECTIVE-DESIGNATOR",
        "parent &key new-properties data-object timestamp",
        "A designator equated to the parent that refers to the data object.",
        &[],
        make_effective,
    ),
    pure(
        "NEWEST-EFFECTIVE-DESIGNATOR",
        "designator",
        "The newest designator of the chain that refers to something known by effect, or NIL.",
        &["(desig:newest-effective-designator (desig:an object)) => NIL"],
        newest_effective,
    ),
    pure(
        "DESIGNATOR-P",
        "object",
        "Is this a designator?",
        &["(desig:designator-p 1) => NIL"],
        |_, args| Ok(Value::bool(value::as_designator(&args[0]).is_some())),
    ),
];

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
fn class(image: &Image, argument: &Value) -> Result<Class> {
    let name = match argument {
        Value::Symbol(sym, ..) => image.name(*sym).to_owned(),
        Value::Str(text) => text.text(),
        other => return Err(Raise::type_error(other, known::SYMBOL)),
    };
    Class::named(&name).ok_or_else(|| Raise::simple(format!("Designator type `{name}' undefined")))
}

fn designator_of_form(image: &mut Image, args: &[Value]) -> Result<Value> {
    let class = class(image, &args[1])?;
    let quantifier = match args[0].as_symbol().map(|s| image.name(s)) {
        Some("ALL") => Quantifier::All,
        _ => Quantifier::A,
    };
    let properties: Vec<Value> = args[2].iter_list().filter(Value::is_true).collect();
    let designator = Designator::new(image, class, quantifier, list(properties));
    Ok(Value::foreign(designator))
}

fn make_designator(image: &mut Image, args: &[Value]) -> Result<Value> {
    let class = class(image, &args[0])?;
    let description = checked_description(image, &args[1])?;
    let made = Value::foreign(Designator::new(image, class, Quantifier::A, description));
    if let Some(parent) = keywords::optional(args, 2) {
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

fn description(image: &mut Image, args: &[Value]) -> Result<Value> {
    Ok(value::designator(image, &args[0])?
        .description
        .borrow()
        .clone())
}

fn prop_value(image: &mut Image, args: &[Value]) -> Result<Value> {
    let values = prop_values(image, args)?;
    Ok(values.car_or_nil())
}

fn prop_values(_: &mut Image, args: &[Value]) -> Result<Value> {
    let Some(designator) = value::as_designator(&args[0]) else {
        return Ok(Value::NIL);
    };
    let values = designator
        .properties()
        .into_iter()
        .filter(|(k, _)| lisp::value::equality::equal(k, &args[1]))
        .map(|(_, values)| values.car_or_nil())
        .collect();
    Ok(list(values))
}

fn equate(image: &mut Image, args: &[Value]) -> Result<Value> {
    value::designator(image, &args[0])?;
    value::designator(image, &args[1])?;
    if value::equate(&args[0], &args[1]) {
        return Ok(args[1].clone());
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

fn copy(image: &mut Image, args: &[Value]) -> Result<Value> {
    let original = value::designator(image, &args[0])?;
    let name = image.keyword("NEW-DESCRIPTION");
    let [new] = keywords::parse(image, &args[1..], [name])?;
    let new = new.unwrap_or(Value::NIL);
    let new: Vec<Value> = checked_description(image, &new)?.iter_list().collect();
    let mut properties: Vec<Value> = original
        .description
        .borrow()
        .iter_list()
        .filter(|p| !new.iter().any(|n| n.car_or_nil().is_eql(&p.car_or_nil())))
        .collect();
    properties.extend(new);
    Ok(like(image, original, properties))
}

fn extend(image: &mut Image, args: &[Value]) -> Result<Value> {
    let original = value::designator(image, &args[0])?;
    let new = checked_description(image, &args[1])?;
    let mut properties: Vec<Value> = original.description.borrow().iter_list().collect();
    properties.extend(new.iter_list());
    Ok(like(image, original, properties))
}

fn rename(image: &mut Image, args: &[Value]) -> Result<Value> {
    let original = value::designator(image, &args[0])?;
    let properties = original
        .description
        .borrow()
        .iter_list()
        .map(|p| match &p {
            Value::Cons(cons) if cons.car().is_eql(&args[1]) => {
                Value::cons(args[2].clone(), cons.cdr())
            }
            _ => p,
        })
        .collect();
    Ok(like(image, original, properties))
}

fn merge(image: &mut Image, args: &[Value]) -> Result<Value> {
    let first = value::designator(image, &args[0])?;
    let mut properties: Vec<Value> = first.description.borrow().iter_list().collect();
    for other in &args[1..] {
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

fn make_effective(image: &mut Image, args: &[Value]) -> Result<Value> {
    let parent = value::designator(image, &args[0])?;
    let names = ["NEW-PROPERTIES", "DATA-OBJECT", "TIMESTAMP"].map(|n| image.keyword(n));
    let [properties, data, _] = keywords::parse(image, &args[1..], names)?;
    let properties = match properties {
        Some(list) => checked_description(image, &list)?.iter_list().collect(),
        None => parent.description.borrow().iter_list().collect(),
    };
    let made = like(image, parent, properties);
    if let Some(new) = value::as_designator(&made) {
        *new.data.borrow_mut() = data;
        new.is_effective.set(true);
    }
    value::equate(&args[0], &made);
    Ok(made)
}

fn newest_effective(_: &mut Image, args: &[Value]) -> Result<Value> {
    let mut at = value::current(&args[0]);
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
    let variable = Value::from(image.gensym("DESIG"));
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
