//! `def-action`: a type of actions, its keys and its plan in a single definition.

use super::schema::{self, Key, Kind, Text, TypeRow};
use super::value::Class;
use crate::packages;
use closest_name::closest_name;
use lisp::builtin::{Builtin, Operator};
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::form::{form, quote, split_body};
use lisp::value::known;
use lisp::value::package::PackageTable;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Macros of package `CRAM-DESIGNATORS`.
pub(crate) static OPERATORS: &[Operator] = &[Operator {
    name: "DEF-ACTION",
    lambda_list: "type (key… [&optional key…]) [documentation] option… body…",
    doc: "Defines a type of actions together with its plan. A key is a name, or (name kind \"what it means\" :aliases (name…) :default form); in the body ?name is its value. Kinds are location, place, object, detected-object, objects, number, keywords, keyword, (member name…), symbol, string, list, pose, poses, keyword-or-object, action, and t for anything. Options: (:aliases type…) other names of the type, (:one-of key…) keys of which one is needed, (:plan function) the name of the plan if it is not that of the type (without a body, a function that is there already), (:variant name) another definition of the same type that is told apart by the keys it needs, (:example designator). Checks, completion, hints and help know the type at once.",
    examples: &[
        "(desig:def-action waving ((arm (member left right) \"the arm to wave with\") &optional (times number \"how often\" :default 2)) \"Waves.\" (list ?arm ?times)) => WAVING",
    ],
    expand: Some(def_action),
}];

/// What DEF-ACTION expands into.
#[builtin(_, "definition")]
fn define_action_type(image: &mut Image, definition_value: &Value) -> Result<Value> {
    let definition = Definition::parse(image, definition_value)?;
    let row = definition.row(image);
    schema::define(image, row);
    Ok(definition_value.car_or_nil())
}

/// The syntax of a definition, for messages.
const SHAPE: &str =
    "(def-action type ((key kind \"what it means\")…) \"what it does\" (:option …)… body…)";

/// Options of a definition.
const OPTIONS: [&str; 5] = ["ALIASES", "ONE-OF", "PLAN", "VARIANT", "EXAMPLE"];

fn malformed(form: &Value, text: String) -> Box<Raise> {
    let raise = Raise::program(text);
    match form {
        Value::Cons(cons) => raise.at(cons.place()),
        _ => raise,
    }
}

fn shown(image: &Image, value: &Value) -> String {
    print::to_string(image, value, true)
}

/// The symbol, unless it is `NIL`.
fn name_of(value: &Value) -> Option<Sym> {
    value.as_symbol().filter(|_| value.is_true())
}

fn text_of(image: &Image, sym: Sym) -> Text {
    Text::Owned(image.name(sym).to_uppercase())
}

/// A key, and the form of its default value.
struct KeyDefinition {
    key: Key,
    default: Option<Value>,
}

/// A parsed definition.
struct Definition {
    name: Sym,
    keys: Vec<KeyDefinition>,
    doc: Option<Text>,
    aliases: Vec<Text>,
    one_of: Vec<Text>,
    plan: Sym,
    variant: Option<Text>,
    example: Option<Text>,
    /// The body of the plan.
    body: Value,
}

impl Definition {
    /// Parses what follows `def-action`.
    fn parse(image: &Image, definition: &Value) -> Result<Definition> {
        let type_name = definition.car_or_nil();
        let Some(name) = name_of(&type_name) else {
            return Err(malformed(
                definition,
                format!(
                    "{} is not the name of a type of actions: {SHAPE} was expected.",
                    shown(image, &type_name)
                ),
            ));
        };
        let rest = definition.cdr_or_nil();
        let keys = rest.car_or_nil();
        if !keys.is_list() || rest.is_nil() {
            return Err(malformed(
                definition,
                format!(
                    "DEF-ACTION {} has no list of keys, but {}: {SHAPE} was expected.",
                    image.name(name),
                    shown(image, &keys)
                ),
            ));
        }
        let mut parsed = Definition {
            name,
            keys: parse_keys(image, &keys)?,
            doc: None,
            aliases: Vec::new(),
            one_of: Vec::new(),
            plan: name,
            variant: None,
            example: None,
            body: Value::NIL,
        };
        let mut rest = rest.cdr_or_nil();
        if let Value::Str(text) = rest.car_or_nil() {
            parsed.doc = Some(Text::Owned(text.text()));
            rest = rest.cdr_or_nil();
        }
        let mut is_plan_named = false;
        loop {
            let option = rest.car_or_nil();
            let keyword = option.car_or_nil().as_symbol();
            let Some(keyword) = keyword.filter(|s| image.is_keyword(*s)) else {
                break;
            };
            is_plan_named |= image.name(keyword) == "PLAN";
            parsed.take_option(image, image.name(keyword), &option)?;
            rest = rest.cdr_or_nil();
        }
        parsed.body = rest;
        if parsed.body.is_nil() && !is_plan_named {
            return Err(malformed(
                definition,
                format!(
                    "DEF-ACTION {} has no body: write what the action does, or (:plan function) with the name of a function that does it.",
                    image.name(name)
                ),
            ));
        }
        let home = image.symbol(parsed.plan).package;
        if parsed.body.is_true() && home == Some(PackageTable::CL) {
            return Err(malformed(
                definition,
                format!(
                    "The plan of DEF-ACTION {} would redefine the function {} of Common Lisp: give it another name with (:plan name).",
                    image.name(name),
                    image.name(parsed.plan)
                ),
            ));
        }
        Ok(parsed)
    }

    fn take_option(&mut self, image: &Image, name: &str, option: &Value) -> Result<()> {
        let values: Vec<Value> = option.cdr_or_nil().iter_list().collect();
        let single = || match values.as_slice() {
            [value] => name_of(value),
            _ => None,
        };
        let one_name = || {
            single().ok_or_else(|| {
                malformed(
                    option,
                    format!(
                        "The option {} takes one name, as in (:{} name).",
                        shown(image, option),
                        name.to_lowercase()
                    ),
                )
            })
        };
        match name {
            "ALIASES" => self.aliases = names(image, option, &values)?,
            "ONE-OF" => {
                self.one_of = names(image, option, &values)?;
                for name in &self.one_of {
                    if self.keys.iter().all(|k| k.key.name != *name) {
                        let known = self.keys.iter().map(|k| &*k.key.name);
                        let near = asking(closest_name(name, known));
                        let text = format!(
                            "{name} of {} is not one of the keys{near}",
                            shown(image, option)
                        );
                        return Err(malformed(option, text));
                    }
                }
            }
            "PLAN" => self.plan = one_name()?,
            "VARIANT" => self.variant = Some(text_of(image, one_name()?)),
            "EXAMPLE" => self.example = Some(self.parse_example(image, option, &values)?),
            _ => {
                let near = asking(closest_name(name, OPTIONS));
                let known = OPTIONS.map(|o| format!(":{}", o.to_lowercase())).join(", ");
                return Err(malformed(
                    option,
                    format!("DEF-ACTION has no option :{name}{near} There are {known}."),
                ));
            }
        }
        Ok(())
    }

    /// Parses an example, which must be a designator of the type.
    fn parse_example(&self, image: &Image, option: &Value, values: &[Value]) -> Result<Text> {
        let head = |form: &Value| form.car_or_nil().as_symbol().map(|s| image.name(s));
        if let [example] = values
            && matches!(head(example), Some("A" | "AN"))
        {
            let rest = example.cdr_or_nil();
            let mut properties = rest.cdr_or_nil().iter_list();
            let is_type = |p: &Value| {
                head(p) == Some("TYPE")
                    && name_of(&p.cdr_or_nil().car_or_nil())
                        .is_some_and(|s| image.name(s) == image.name(self.name))
            };
            if head(&rest) == Some("ACTION") && properties.any(|p| is_type(&p)) {
                return Ok(Text::Owned(shown(image, example).to_lowercase()));
            }
        }
        Err(malformed(
            option,
            format!(
                "{} is not an example: (:example (an action (type {}) …)) was expected.",
                shown(image, option),
                image.name(self.name).to_lowercase()
            ),
        ))
    }

    /// The row for the table of types.
    fn row(self, image: &Image) -> TypeRow {
        TypeRow {
            class: Class::Action,
            name: text_of(image, self.name),
            variant: self.variant,
            aliases: self.aliases,
            plan: self.plan,
            keys: self.keys.into_iter().map(|k| k.key).collect(),
            one_of: self.one_of,
            is_known_by_keys: false,
            doc: self.doc.unwrap_or_default(),
            example: self.example,
        }
    }

    /// The lambda list of the plan: `(&key ((:target ?target)) … &allow-other-keys)`.
    fn lambda_list(&self, image: &mut Image) -> Value {
        let package = image.current_package();
        let mut list: Vec<Value> = vec![known::L_KEY.into()];
        for KeyDefinition { key, default } in &self.keys {
            let keyword = image.keyword(&key.name);
            let variable = image.intern(package, &format!("?{}", key.name));
            let name = form![keyword, variable];
            list.push(match default {
                Some(default) => form![name, default.clone()],
                None => form![name],
            });
        }
        list.push(known::L_ALLOW_OTHER_KEYS.into());
        Value::list(list)
    }
}

fn asking(near: Option<&str>) -> String {
    match near {
        Some(near) => format!("; did you mean {near}?"),
        None => ".".to_owned(),
    }
}

fn names(image: &Image, option: &Value, values: &[Value]) -> Result<Vec<Text>> {
    values
        .iter()
        .map(|value| match name_of(value) {
            Some(name) => Ok(text_of(image, name)),
            None => Err(malformed(
                option,
                format!(
                    "{} in {} is not a name.",
                    shown(image, value),
                    shown(image, option)
                ),
            )),
        })
        .collect()
}

fn parse_keys(image: &Image, list: &Value) -> Result<Vec<KeyDefinition>> {
    let mut keys: Vec<KeyDefinition> = Vec::new();
    let mut is_required = true;
    for item in list.iter_list() {
        let word = item.as_symbol().map(|s| image.name(s));
        match word {
            Some("&OPTIONAL") => is_required = false,
            Some(word) if word.starts_with('&') => {
                return Err(malformed(
                    list,
                    format!(
                        "{word} does not belong into the keys of an action: keys after &OPTIONAL need not be given."
                    ),
                ));
            }
            _ => {
                let definition = parse_key(image, list, &item, is_required)?;
                let twice = keys
                    .iter()
                    .flat_map(|other| other.key.names())
                    .find(|name| definition.key.is_named(name));
                if let Some(twice) = twice {
                    return Err(malformed(
                        &item,
                        format!("{twice} is the name of two keys of the action."),
                    ));
                }
                keys.push(definition);
            }
        }
    }
    Ok(keys)
}

/// A key: `name`, or `(name [kind] ["documentation"] [:aliases (name…)] [:default form])`.
fn parse_key(
    image: &Image,
    list: &Value,
    item: &Value,
    is_required: bool,
) -> Result<KeyDefinition> {
    let refuse = |text: String| {
        let place = if item.as_cons().is_some() { item } else { list };
        let end = if text.ends_with('?') { "" } else { "." };
        malformed(
            place,
            format!("In the key {}: {text}{end}", shown(image, item)),
        )
    };
    let (name, mut rest) = match item {
        Value::Cons(cons) => (cons.car(), cons.cdr()),
        other => (other.clone(), Value::NIL),
    };
    let Some(name) = name_of(&name) else {
        return Err(refuse(format!("{} is not a name", shown(image, &name))));
    };
    let mut definition = KeyDefinition {
        key: Key {
            name: text_of(image, name),
            aliases: Vec::new(),
            kind: Kind::Anything,
            is_required,
            doc: Text::Borrowed(""),
        },
        default: None,
    };
    let is_kind = |value: &Value| match value {
        Value::Cons(_) => true,
        other => name_of(other).is_some_and(|s| !image.is_keyword(s)),
    };
    if is_kind(&rest.car_or_nil()) {
        definition.key.kind = parse_kind(image, &rest.car_or_nil()).map_err(refuse)?;
        rest = rest.cdr_or_nil();
    }
    if let Value::Str(text) = rest.car_or_nil() {
        definition.key.doc = Text::Owned(text.text());
        rest = rest.cdr_or_nil();
    }
    while let Value::Cons(cons) = rest.clone() {
        let option = cons.car().as_symbol().map(|s| image.name(s));
        let Value::Cons(value) = cons.cdr() else {
            return Err(refuse(format!(
                "{} has no value",
                shown(image, &cons.car())
            )));
        };
        match option {
            Some("ALIASES") => {
                let aliases: Vec<Value> = value.car().iter_list().collect();
                if !value.car().is_list() || aliases.iter().any(|a| name_of(a).is_none()) {
                    let text = format!("{} is not a list of names", shown(image, &value.car()));
                    return Err(refuse(text));
                }
                let aliases = aliases.iter().filter_map(name_of);
                definition.key.aliases = aliases.map(|a| text_of(image, a)).collect();
            }
            Some("DEFAULT") if is_required => {
                return Err(refuse(
                    "a key that must be given has no default; those that need not be given come after &OPTIONAL".to_owned(),
                ));
            }
            Some("DEFAULT") => definition.default = Some(value.car()),
            _ => {
                return Err(refuse(format!(
                    "{} is neither a kind, a documentation string, :aliases nor :default",
                    shown(image, &cons.car())
                )));
            }
        }
        rest = value.cdr();
    }
    Ok(definition)
}

/// The kind that a definition names, or what is wrong with it.
fn parse_kind(image: &Image, value: &Value) -> std::result::Result<Kind, String> {
    if let Value::Cons(cons) = value {
        let head = cons.car().as_symbol().map(|s| image.name(s));
        let members: Vec<Value> = cons.cdr().iter_list().collect();
        let named: Vec<Text> = members
            .iter()
            .filter_map(name_of)
            .map(|s| text_of(image, s))
            .collect();
        if head == Some("MEMBER") && !named.is_empty() && named.len() == members.len() {
            return Ok(Kind::Member(named));
        }
        return Err(format!(
            "{} is not a kind: (member name…) was expected",
            shown(image, value)
        ));
    }
    let name = value.as_symbol().map_or("", |s| image.name(s));
    Kind::named(name).ok_or_else(|| match Kind::nearest_name(name) {
        Some(near) => format!("{name} is not a kind; did you mean {near}?"),
        None => {
            let known: Vec<&str> = Kind::names().collect();
            format!(
                "{name} is not a kind; there are {}, and (MEMBER …)",
                known.join(", ")
            )
        }
    })
}

fn def_action(image: &mut Image, form: &Value) -> Result<Value> {
    let definition = form.cdr_or_nil();
    let parsed = Definition::parse(image, &definition).map_err(|raise| match form {
        Value::Cons(cons) => raise.at(cons.place()),
        _ => raise,
    })?;
    let desig = packages::ensure(image, "CRAM-DESIGNATORS", &["DESIG"]);
    let define = image.intern(desig, "DEFINE-ACTION-TYPE");
    let row = form![define, quote(definition)];
    if parsed.body.is_nil() {
        return Ok(form![known::PROGN, row, quote(parsed.name)]);
    }
    let cpl = packages::ensure(image, "CRAM-LANGUAGE", &["CPL"]);
    let def_cram_function = match image.packages.find_symbol(cpl, "DEF-CRAM-FUNCTION") {
        Some((sym, _)) => sym,
        None => return Err(Raise::program("The plan language is not installed.")),
    };
    let body = split_body(&parsed.body);
    let lambda_list = parsed.lambda_list(image);
    let mut function: Vec<Value> = vec![def_cram_function.into(), parsed.plan.into(), lambda_list];
    function.extend(parsed.doc.as_deref().map(Value::string));
    function.extend(body.declarations);
    let function = Value::list_with_tail(function, body.forms);
    if let (Value::Cons(from), Value::Cons(to)) = (form, &function) {
        to.set_place(from.place());
    }
    Ok(form![known::PROGN, function, row, quote(parsed.name)])
}

/// Functions of package `CRAM-DESIGNATORS` that `def-action` expands into.
pub(crate) static TABLE: &[Builtin] = builtins![define_action_type,];
