//! Checks the values of keys as written. Only what a program says literally is judged; what it computes
//! is checked when it runs.

use super::literal::literal_name;
use super::schema;
use super::schema::Kind;
use super::syntax::nested_quantifier;
use super::value::Class;
use super::vocabulary::{Domain, Vocabulary};
use lisp::compile::is_visible_variable;
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::number;
use lisp::value::symbol::{Sym, VariableKind};

/// What a value is, as far as that is written.
enum Written {
    Number,
    Text(String),
    /// A name that stands for itself.
    Name(String),
    Designator(Class),
    List(Vec<Value>),
    /// Only the run will tell.
    Computed,
}

impl Written {
    fn of(image: &Image, value: &Value) -> Written {
        match value {
            Value::Symbol(known::NIL | known::T, ..) => Written::Computed,
            Value::Symbol(..) => match literal_name(image, value) {
                Some(name) => Written::Name(name),
                None => Written::Computed,
            },
            Value::Str(text) => Written::Text(text.text()),
            Value::Cons(cons) => match nested_quantifier(image, &cons.car(), value) {
                Some(_) => class_of(image, value).map_or(Written::Computed, Written::Designator),
                None => value.list_to_vec().map_or(Written::Computed, Written::List),
            },
            _ if number::is_real(value) => Written::Number,
            _ => Written::Computed,
        }
    }

    /// Is it a value of a kind?
    fn is_of(&self, image: &Image, kind: &Kind) -> bool {
        use Written::{Computed, Designator, List, Name, Number, Text};
        match (kind, self) {
            (_, Computed) | (Kind::Anything, _) => true,
            (Kind::Location | Kind::Place, Designator(class)) => *class == Class::Location,
            (
                Kind::Object | Kind::DetectedObject | Kind::Objects | Kind::KeywordOrObject,
                Designator(class),
            ) => *class == Class::Object,
            (Kind::Action, Designator(class)) => *class == Class::Action,
            (Kind::Objects, List(items)) => items
                .iter()
                .all(|item| Written::of(image, item).is_of(image, &Kind::Object)),
            (Kind::Member(members), Name(name)) => members.iter().any(|member| member == name),
            (Kind::Number, Number) => true,
            (Kind::Keywords | Kind::Keyword | Kind::Symbol | Kind::KeywordOrObject, Name(_)) => {
                true
            }
            (Kind::Symbol | Kind::Text, Text(_)) => true,
            (Kind::Keywords | Kind::List | Kind::Poses, List(_)) => true,
            _ => false,
        }
    }

    /// What it is, in messages.
    fn shown(&self, image: &Image, value: &Value) -> String {
        let text = print::to_string(image, value, true);
        match self {
            Written::Number => format!("the number {text}"),
            Written::Text(_) => format!("the string {text}"),
            Written::Name(name) => format!("the name {name}"),
            Written::Designator(class) => match class {
                Class::Action => "an action".to_owned(),
                Class::Object => "an object".to_owned(),
                other => format!("a {}", other.name().to_lowercase()),
            },
            Written::List(_) => "a list".to_owned(),
            Written::Computed => text,
        }
    }
}

/// The class of a nested designator.
fn class_of(image: &Image, form: &Value) -> Option<Class> {
    let name = image.name(form.cdr_or_nil().car_or_nil().as_symbol()?);
    Class::named(name).or_else(|| Class::named(name.trim_end_matches(['S', 's'])))
}

/// What is wrong with the value of a key, and the name that is.
pub(super) fn mistake(
    image: &Image,
    class: Class,
    written: &[(String, Value)],
    key: &str,
    value: &Value,
) -> Option<(String, String)> {
    let kinds = kinds(image, class, written, key);
    if kinds.is_empty() {
        return None;
    }
    let found = Written::of(image, value);
    if !kinds.iter().any(|kind| found.is_of(image, kind)) {
        let kind = kinds.first()?;
        return Some(wrong_kind(image, kind, key, value, &found));
    }
    let domain = domain(image, class, written, key)?;
    match &found {
        Written::Name(_) => wrong_name(image, domain, value),
        Written::Text(text) => Some((key.to_owned(), domain.mistake(image, text)?)),
        Written::List(items) => items
            .iter()
            .find_map(|item| wrong_name(image, domain, item)),
        _ => None,
    }
}

/// The kinds of values that a key takes; none if that is not known.
fn kinds(image: &Image, class: Class, written: &[(String, Value)], key: &str) -> Vec<Kind> {
    let of_class = |keys: &[schema::Key]| {
        let kinds = keys.iter().filter(|known| known.name == key);
        kinds.map(|known| known.kind.clone()).collect()
    };
    match class {
        Class::Object => of_class(schema::OBJECT_KEYS),
        Class::Location => of_class(schema::LOCATION_KEYS),
        Class::Human => Vec::new(),
        Class::Action | Class::Motion if key == "TYPE" => vec![Kind::Keyword],
        Class::Action | Class::Motion => {
            let rows = type_name(image, written).map(|name| schema::rows(image, class, &name));
            let rows = rows.unwrap_or_default();
            let keys = rows.iter().filter_map(|row| row.key(key));
            keys.map(|known| known.kind.clone()).collect()
        }
    }
}

fn type_name(image: &Image, written: &[(String, Value)]) -> Option<String> {
    let (_, value) = written.iter().find(|(key, _)| key == "TYPE")?;
    literal_name(image, value)
}

/// A value that is none of a kind.
fn wrong_kind(
    image: &Image,
    kind: &Kind,
    key: &str,
    value: &Value,
    found: &Written,
) -> (String, String) {
    let shown = found.shown(image, value);
    let text = format!(
        "({} …) takes {}, not {shown}",
        key.to_lowercase(),
        kind.taken()
    );
    if let (Some(meant), Written::Text(wrong)) = (unquoted(kind, found), found) {
        let text = format!("{text}{}: did you mean {meant}?", remedy(kind, found));
        return (wrong.to_uppercase(), text);
    }
    let Written::Name(name) = found else {
        return (key.to_owned(), text + remedy(kind, found) + ".");
    };
    let text = match (instead(image, value), kind) {
        (Some(instead), _) => format!("{text}; {instead}"),
        (None, Kind::Member(members)) => {
            match closest_name::closest_name(name, members.iter().map(AsRef::as_ref)) {
                Some(near) => format!("{text}; did you mean {near}?"),
                None => format!("{text}."),
            }
        }
        (None, _) => format!(
            "{text}; names stand for themselves in a designator, but for variables such as ?{}.",
            name.to_lowercase()
        ),
    };
    (name.clone(), text)
}

/// What a string would be without its quotes, if it is a value of the kind then.
fn unquoted(kind: &Kind, found: &Written) -> Option<String> {
    let Written::Text(text) = found else {
        return None;
    };
    let is_name = |c: char| c.is_ascii_alphanumeric() || "-_?".contains(c);
    let is_plain = !text.is_empty() && text.chars().all(is_name);
    match kind {
        Kind::Keywords | Kind::Keyword if is_plain => Some(text.to_uppercase()),
        Kind::Member(members) => {
            let name = text.to_uppercase();
            members.iter().any(|member| *member == name).then_some(name)
        }
        Kind::Number => text.parse::<f64>().ok().map(|_| text.clone()),
        _ => None,
    }
}

/// What to write instead of a value of another kind.
fn remedy(kind: &Kind, found: &Written) -> &'static str {
    match (kind, found) {
        (Kind::PoseStamped | Kind::Poses, _) => {
            "; (make-pose \"map\" '((x y z) (x y z w))) makes a pose, which a variable such as ?pose holds"
        }
        (Kind::Location | Kind::Place, _) => "; write (a location (pose ?pose))",
        (Kind::Object | Kind::DetectedObject | Kind::Objects, _) => {
            "; write (an object (type …)), or ?object for what was detected"
        }
        (Kind::Keywords | Kind::Keyword | Kind::Member(_), Written::Text(_)) => {
            "; names in a designator have no quotes"
        }
        (Kind::Number, Written::Text(_)) => "; a number has no quotes",
        _ => "",
    }
}

/// A name that is none of a domain.
fn wrong_name(image: &Image, domain: Domain, value: &Value) -> Option<(String, String)> {
    let Written::Name(name) = Written::of(image, value) else {
        return None;
    };
    let vocabulary = image.extension::<Vocabulary>()?;
    if vocabulary.has(domain, &name) {
        return None;
    }
    let text = match instead(image, value) {
        Some(instead) => format!("There is no {} {name}; {instead}", domain.noun()),
        None if domain == Domain::Furniture && vocabulary.is_like_object(&name) => return None,
        None => domain.mistake(image, &name)?,
    };
    Some((name, text))
}

/// The variable that was meant by a name without a question mark.
fn instead(image: &Image, value: &Value) -> Option<String> {
    let sym = value.as_symbol().filter(|sym| !image.is_keyword(*sym))?;
    let name = image.name(sym);
    let package = image.current_package();
    let marked = image.packages.find_symbol(package, &format!("?{name}"));
    if marked.is_some_and(|(marked, _)| is_variable(image, marked)) {
        return Some(format!("did you mean ?{name}?"));
    }
    is_visible_variable(image, sym).then(|| {
        format!(
            "only variables whose names begin with a question mark are evaluated here: bind ?{name} instead of {name}."
        )
    })
}

fn is_variable(image: &Image, sym: Sym) -> bool {
    is_visible_variable(image, sym) || image.symbol(sym).kind == VariableKind::Special
}

/// What the names that a key takes are names of. Users' own actions may have other names.
fn domain(image: &Image, class: Class, written: &[(String, Value)], key: &str) -> Option<Domain> {
    let is_given = |name: &str| written.iter().any(|(key, _)| key == name);
    match (class, key) {
        (Class::Object, "TYPE") if is_given("URDF-NAME") || is_given("PART-OF") => None,
        (Class::Object, "TYPE") => Some(Domain::ObjectType),
        (Class::Object, "URDF-NAME") => Some(Domain::Furniture),
        (Class::Location, "ARM") => Some(Domain::Arm),
        (Class::Location, "GRASP") => Some(Domain::Grasp),
        (Class::Location, "SIDE") => Some(Domain::Side),
        (Class::Location, "LEVEL" | "LEVEL-INVERT") => Some(Domain::Level),
        (Class::Location, "ORIENTATION") => Some(Domain::Orientation),
        (Class::Location, "ON" | "IN" | "ABOVE") => Some(Domain::Furniture),
        (Class::Action | Class::Motion, _) => {
            let name = type_name(image, written)?;
            let rows = schema::rows(image, class, &name);
            let is_built_in = |plan: Sym| plan == known::NIL || image.is_built_in_function(plan);
            if !rows.iter().all(|row| is_built_in(row.plan)) {
                return None;
            }
            match key {
                "ARM" | "ARMS" | "GRIPPER" => Some(Domain::Arm),
                "GRASP" | "GRASPS" | "LEFT-GRASP" | "RIGHT-GRASP" => Some(Domain::Grasp),
                "DIRECTION" if name == "LOOKING" => Some(Domain::Direction),
                "FRAME" => Some(Domain::Frame),
                _ => None,
            }
        }
        _ => None,
    }
}
