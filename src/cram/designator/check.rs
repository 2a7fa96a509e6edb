//! Checks property values against the kinds that the schema requires.

use super::schema;
use super::schema::{Key, Kind, TypeRow};
use super::value;
use super::value::{Class, Designator};
use crate::packages;
use crate::pose::names;
use crate::pose::value::{as_placement, as_pose_stamped};
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::number;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Maximum depth of nested designators that are checked.
const MAX_NESTED: usize = 16;

/// Whether the value is of the kind. `name` is the key as written: `pose` takes poses where
/// `target` takes locations.
fn is_of_kind(image: &Image, value: &Value, kind: &Kind, name: &str) -> bool {
    let is_class = |class| value::as_class(value, class).is_some();
    let is_symbol = matches!(value, Value::Symbol(..));
    match kind {
        Kind::Location => is_class(Class::Location),
        Kind::Place => {
            is_class(Class::Location)
                || (name.ends_with("POSE") && as_pose_stamped(value).is_some())
        }
        Kind::Object | Kind::DetectedObject => is_class(Class::Object),
        Kind::Member(members) => value
            .as_symbol()
            .is_some_and(|s| members.iter().any(|m| m == image.name(s))),
        Kind::Objects => {
            let is_object = |v: &Value| value::as_class(v, Class::Object).is_some();
            is_object(value)
                || (value.as_cons().is_some() && value.iter_list().all(|v| is_object(&v)))
        }
        Kind::Number => number::is_real(value),
        Kind::Keywords => is_symbol || value.is_list(),
        Kind::Keyword => value.as_symbol().is_some_and(|s| image.is_keyword(s)),
        Kind::Symbol => (is_symbol && value.is_true()) || matches!(value, Value::Str(_)),
        Kind::Text => matches!(value, Value::Str(_)),
        Kind::List => value.is_list(),
        Kind::Poses => value.is_list() || as_placement(value).is_some(),
        Kind::PoseStamped => as_pose_stamped(value).is_some(),
        Kind::KeywordOrObject => is_symbol || is_class(Class::Object),
        Kind::Action => is_class(Class::Action),
        Kind::Anything => true,
    }
}

/// The type specifier named in errors.
fn type_specifier(image: &mut Image, kind: &Kind, name: &str) -> Value {
    if let Kind::Member(members) = kind {
        let members = members.iter().map(|m| Value::from(image.keyword(m)));
        return Value::list_with_tail(
            [known::MEMBER.into()],
            Value::list(members.collect::<Vec<_>>()),
        );
    }
    let mut designator = |class: Class| {
        Value::from(packages::symbol(
            image,
            "CRAM-DESIGNATORS",
            class.class_name(),
        ))
    };
    let either = |a: Value, b: Value| Value::list([known::OR.into(), a, b]);
    match kind {
        Kind::Place if name.ends_with("POSE") => names::POSE_STAMPED.into(),
        Kind::Location | Kind::Place => designator(Class::Location),
        Kind::Object | Kind::DetectedObject | Kind::Objects => designator(Class::Object),
        Kind::Action => designator(Class::Action),
        Kind::KeywordOrObject => {
            let object = designator(Class::Object);
            either(known::KEYWORD.into(), object)
        }
        Kind::Number => known::NUMBER.into(),
        Kind::Keywords => either(known::KEYWORD.into(), known::LIST.into()),
        Kind::Keyword => known::KEYWORD.into(),
        Kind::Symbol => known::SYMBOL.into(),
        Kind::Text => known::STRING.into(),
        Kind::List | Kind::Poses => known::LIST.into(),
        Kind::PoseStamped => names::POSE_STAMPED.into(),
        Kind::Anything | Kind::Member(_) => known::T.into(),
    }
}

/// What to write instead, if that can be guessed.
fn hint(image: &Image, value: &Value, kind: &Kind, name: &str) -> Option<String> {
    let key = name.to_lowercase();
    let head = value.car_or_nil();
    if keyword(image, &head).is_some_and(|operator| is_called(image, operator)) {
        return Some(format!(
            "Nothing is quoted or called inside a designator: bind a variable such as ?{key} and write ({key} ?{key})."
        ));
    }
    let class = keyword(image, &head).map(|class| image.name(class));
    let articles = [
        ("LOCATION", "a"),
        ("OBJECT", "an"),
        ("ACTION", "an"),
        ("MOTION", "a"),
    ];
    let article = articles.iter().find(|(name, _)| class == Some(*name));
    if let Some((class, article)) = article {
        let class = class.to_lowercase();
        return Some(format!("Write ({key} ({article} {class} …))."));
    }
    match kind {
        Kind::Location | Kind::Place if as_placement(value).is_some() => {
            Some(format!("Write ({key} (a location (pose ?pose)))."))
        }
        Kind::PoseStamped if value.as_cons().is_some() => Some(
            "A pose in a frame is made by (make-pose \"map\" '((x y z) (x y z w))).".to_owned(),
        ),
        Kind::Object | Kind::DetectedObject | Kind::Objects if value.is_nil() => {
            Some(format!("The {key} is NIL: was the object detected first?"))
        }
        _ if value
            .as_symbol()
            .is_some_and(|sym| is_variable_name(image.name(sym))) =>
        {
            let name = print::to_string(image, value, false);
            Some(format!("The variable {name} is not defined."))
        }
        Kind::PoseStamped | Kind::Place if let Some(sym) = keyword(image, value) => {
            let name = image.name(sym).to_lowercase();
            Some(format!(
                "Names in a designator stand for themselves, but for variables, whose names begin with a question mark: bind ?{name} and write ({key} ?{name})."
            ))
        }
        Kind::Number if value.as_text().is_some() => Some(format!(
            "Write a number without quotes, such as ({key} 0.3)."
        )),
        Kind::Object | Kind::DetectedObject | Kind::Objects if value.as_symbol().is_some() => {
            Some(format!(
                "Write ({key} (an object (type …))), or ({key} ?variable) with what was detected."
            ))
        }
        _ => None,
    }
}

/// Whether a list that begins with the keyword was meant to be evaluated: it was read as QUOTE or the name of a function.
fn is_called(image: &Image, operator: Sym) -> bool {
    let name = image.name(operator);
    let package = image.current_package();
    let symbol = image.packages.find_symbol(package, name);
    name == "QUOTE" || symbol.is_some_and(|(symbol, _)| image.function(symbol).is_some())
}

/// Whether the name is that of a global variable by convention, `*NAME*`.
fn is_variable_name(name: &str) -> bool {
    name.len() > 2 && name.starts_with('*') && name.ends_with('*')
}

/// The symbol if the value is a keyword, as which names in designators are read.
fn keyword(image: &Image, value: &Value) -> Option<Sym> {
    value.as_symbol().filter(|sym| image.is_keyword(*sym))
}

/// Checks one value of a designator of a class.
pub(crate) fn check_value(
    image: &mut Image,
    class: Class,
    key: &Key,
    name: &str,
    value: &Value,
) -> Result<()> {
    if is_of_kind(image, value, &key.kind, name) {
        return Ok(());
    }
    let expected = type_specifier(image, &key.kind, name);
    let mut text = format!(
        "[{} SPEC:PROPERTY]: {} had to be of type {}",
        class.name(),
        print::to_string(image, value, true),
        print::to_string(image, &expected, false),
    );
    if let Some(hint) = hint(image, value, &key.kind, name) {
        text.push('\n');
        text.push_str(&hint);
    }
    Err(Raise::new(known::SIMPLE_TYPE_ERROR, text)
        .with(known::K_DATUM, value.clone())
        .with(known::K_EXPECTED_TYPE, expected))
}

/// Checks the properties that a row of the schema lists, and those of nested designators.
pub(crate) fn check_row(image: &mut Image, designator: &Designator, row: &TypeRow) -> Result<()> {
    for (key, values) in designator.properties() {
        let Some(name) = key.as_symbol().map(|s| image.name(s).to_owned()) else {
            continue;
        };
        let value = values.car_or_nil();
        if let Some(key) = row.key(&name) {
            check_value(image, designator.class, key, &name, &value)?;
        }
        check_inside(image, &value, MAX_NESTED)?;
    }
    Ok(())
}

/// Checks object and location designators by the keys of their classes.
pub(crate) fn check_inside(image: &mut Image, value: &Value, depth: usize) -> Result<()> {
    let Some(designator) = value::as_designator(value) else {
        return Ok(());
    };
    let keys = match designator.class {
        Class::Object => schema::OBJECT_KEYS,
        Class::Location => schema::LOCATION_KEYS,
        Class::Action | Class::Motion | Class::Human => return Ok(()),
    };
    let Some(depth) = depth.checked_sub(1) else {
        return Ok(());
    };
    for (key, values) in designator.properties() {
        let Some(name) = key.as_symbol().map(|s| image.name(s).to_owned()) else {
            continue;
        };
        let value = values.car_or_nil();
        if let Some(key) = keys.iter().find(|k| k.name == name) {
            check_value(image, designator.class, key, &name, &value)?;
        }
        check_inside(image, &value, depth)?;
    }
    Ok(())
}

/// Checks one property as the goal `(spec:property ?designator (:key ?value))` does.
pub(crate) fn check_property(
    image: &mut Image,
    designator: &Designator,
    name: &str,
    value: &Value,
) -> Result<()> {
    let keys = match designator.class {
        Class::Object => schema::OBJECT_KEYS,
        Class::Location => schema::LOCATION_KEYS,
        Class::Action | Class::Motion => {
            let kind = general_kind(designator.class, name);
            let key = Key {
                name: schema::Text::Borrowed(""),
                aliases: Vec::new(),
                kind,
                is_required: false,
                doc: schema::Text::Borrowed(""),
            };
            return check_value(image, designator.class, &key, name, value);
        }
        Class::Human => return Ok(()),
    };
    match keys.iter().find(|k| k.name == name) {
        Some(key) => check_value(image, designator.class, key, name, value),
        None => Ok(()),
    }
}

/// The kinds of the keys that actions and motions have regardless of their type.
fn general_kind(class: Class, name: &str) -> Kind {
    match (class, name) {
        (Class::Motion, "TARGET" | "LEFT-TARGET" | "RIGHT-TARGET") => Kind::Location,
        (Class::Motion, "OBJECT") => Kind::Object,
        (Class::Motion, "OBJECTS") => Kind::Objects,
        (Class::Motion, "FRAME") => Kind::Text,
        (Class::Motion, "EFFORT" | "JOINT-ANGLE") => Kind::Number,
        (Class::Motion, "GRIPPER" | "DIRECTION" | "ARM") => Kind::Keywords,
        (Class::Motion, "LEFT-CONFIGURATION" | "RIGHT-CONFIGURATION") => Kind::List,
        (Class::Action, "TARGET" | "LOCATION") => Kind::Location,
        (Class::Action, "LEFT-POSES" | "RIGHT-POSES") => Kind::List,
        (Class::Action, "GRIPPER" | "ARM" | "DIRECTION" | "GRASP" | "CAMERA" | "TYPE") => {
            Kind::Keywords
        }
        (Class::Action, "OBJECT" | "ON-OBJECT" | "WITH-OBJECT") => Kind::Object,
        (Class::Action, "POSITION" | "EFFORT" | "DISTANCE") => Kind::Number,
        (Class::Action, "FOR") => Kind::KeywordOrObject,
        _ => Kind::Anything,
    }
}
