//! What somebody may have meant by a name that means nothing.

use std::path::Path;

use crate::package_name::short_name;
use closest_name::closest_name;
use cram::designator::schema::{self, Kind};
use cram::designator::value::Class;
use cram::pose::names as pose;
use lisp::builtins::help;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::package::{Access, PackageId, PackageTable};
use lisp::value::pathname::file_name;
use lisp::value::symbol::{FunctionCell, Sym, VariableKind};
use plan_files::{DEMOS, TUTORIAL};

/// How many files of a folder are looked at.
const MAX_ENTRIES: usize = 10_000;

/// How deep a form is looked into, and at how many parts of a list.
const MAX_NESTED: usize = 20;
const MAX_PARTS: usize = 100;

/// Words that people try, and what there is for it.
const OTHER_WORDS: &[(&str, &str)] = &[
    (
        "UNDO",
        "(rewind) takes the world back to before the last form that changed it.",
    ),
    (
        "REDO",
        "There is no way back after (rewind), unless (snapshot 'name) has saved the world for (restore 'name).",
    ),
    (
        "RESET",
        "(init-projection) begins again with a kitchen without objects, (rewind) takes the world back by a form.",
    ),
    (
        "CLEAR",
        "(init-projection) begins again with a kitchen without objects.",
    ),
    (
        "SAVE",
        "(snapshot 'name) saves the world for (restore 'name), (save-transcript \"file\") writes the session.",
    ),
];

/// What may be meant by a name.
pub(super) enum Meant {
    /// The same name, exported by another package.
    InPackage(PackageId),
    /// A similar name that is accessible in the current package.
    Similar(String),
}

impl Meant {
    /// What may be meant by the name of something of a kind.
    pub(super) fn by(image: &Image, name: Sym, is_kind: impl Fn(Sym) -> bool) -> Option<Meant> {
        let wanted = image.name(name);
        let namesake = image.symbols.iter().find_map(|(sym, data)| {
            let fits = sym != name
                && *data.name == *wanted
                && image.home_access(sym) == Some(Access::External)
                && is_kind(sym);
            data.package.filter(|_| fits)
        });
        if let Some(package) = namesake {
            return Some(Meant::InPackage(package));
        }
        let package = image.symbol(name).package.unwrap_or(PackageTable::USER);
        let visible = image.symbols.iter().filter_map(|(sym, data)| {
            let found = image.packages.find_symbol(package, &data.name);
            let is_visible = sym != name && found.is_some_and(|(found, _)| found == sym);
            (is_visible && sym != known::NIL && is_kind(sym)).then_some(&*data.name)
        });
        // Names of one or two letters are all similar.
        let is_long = wanted.chars().count() > 2;
        let near = closest_name(wanted, visible).filter(|_| is_long)?;
        Some(Meant::Similar(near.to_owned()))
    }

    /// The question whether it was meant by the name.
    fn question(&self, image: &Image, name: Sym) -> String {
        match self {
            Meant::Similar(near) => format!("Did you mean {near}?"),
            Meant::InPackage(package) => {
                let (name, package) = (image.name(name), short_name(image, *package));
                // The package in which most of the robot's functions are at hand.
                let tutorial = image.packages.find("PP-TUT");
                let there = tutorial.and_then(|there| image.packages.find_symbol(there, name));
                let is_there = there.is_some_and(|(sym, _)| {
                    has_function(image, sym) || image.symbol(sym).kind == VariableKind::Special
                });
                let at_hand = if is_there {
                    " After (in-package :pp-tut), it needs no prefix."
                } else {
                    ""
                };
                format!("Did you mean {package}:{name}?{at_hand}")
            }
        }
    }
}

/// What to say to somebody whose program has met a name that means nothing; `condition` tells of that.
pub(crate) fn hint(image: &Image, condition: &Value) -> Option<String> {
    let Value::Instance(instance) = condition else {
        return None;
    };
    match instance.class().name {
        known::SIMPLE_PACKAGE_ERROR => return package_hint(image, &instance.slot(known::PACKAGE)?),
        known::TYPE_ERROR => {
            let is_pose = instance.slot(known::EXPECTED_TYPE)?.as_symbol() == Some(pose::POSE);
            return is_pose.then(|| {
                "A pose is written '((x y z) (x y z w)): position, then orientation, (0 0 0 1) for none; \
                 make-pose makes one in a frame."
                    .to_owned()
            });
        }
        known::FILE_ERROR => return file_hint(image, &instance.slot(known::PATHNAME)?),
        _ => {}
    }
    let name = instance.slot(known::NAME)?.as_symbol()?;
    let is_variable = |sym| image.symbol(sym).kind == VariableKind::Special;
    let is_action = || !schema::rows(image, Class::Action, image.name(name)).is_empty();
    let call = || {
        let signature = help::signature(image, name)?;
        Some(format!("A call of it: {}", signature.call(image, name)))
    };
    if instance.class().name == known::UNDEFINED_FUNCTION
        && let Some(told) = other_word(image.name(name))
    {
        return Some(told.to_owned());
    }
    let meant = match instance.class().name {
        known::SIMPLE_PROGRAM_ERROR => return call(),
        known::UNDEFINED_FUNCTION if image.name(name) == "RETRY" => {
            return Some(
                "(retry) has a meaning only in the handlers of with-failure-handling.".to_owned(),
            );
        }
        known::UNDEFINED_FUNCTION if is_action() => {
            let name = image.name(name).to_lowercase();
            return Some(format!(
                "{name} is an action: (with-simulated-robot (perform (an action (type {name}) …)))"
            ));
        }
        known::UNDEFINED_FUNCTION => Meant::by(image, name, |sym| has_function(image, sym)),
        known::UNBOUND_VARIABLE if has_function(image, name) => return call(),
        known::UNBOUND_VARIABLE if is_value(image, image.name(name)) => {
            return Some(format!("Did you mean the keyword :{}?", image.name(name)));
        }
        known::UNBOUND_VARIABLE => match Meant::by(image, name, is_variable) {
            None => return call_hint(image, image.special(known::MINUS), name),
            meant => meant,
        },
        known::CLASS_NOT_FOUND_ERROR => {
            Meant::by(image, name, |sym| image.classes.contains_key(&sym))
        }
        _ => None,
    };
    Some(meant?.question(image, name))
}

/// What there is for a word that people try.
fn other_word(name: &str) -> Option<&'static str> {
    let mut words = OTHER_WORDS.iter();
    let (_, told) = words.find(|(word, _)| *word == name)?;
    Some(told)
}

/// What to say to somebody who has evaluated a form in which a name without a value is an argument of
/// something unknown: that comes first.
fn call_hint(image: &Image, form: &Value, name: Sym) -> Option<String> {
    let unknown = unknown_call(image, form, name, MAX_NESTED)?;
    let meant = Meant::by(image, unknown, |sym| has_function(image, sym))?;
    let unknown_name = image.name(unknown);
    let question = meant.question(image, unknown);
    Some(format!(
        "{unknown_name} is not known here, either. {question}"
    ))
}

/// The name of the innermost unknown function that a form calls with a variable as argument.
fn unknown_call(image: &Image, form: &Value, variable: Sym, depth: usize) -> Option<Sym> {
    let depth = depth.checked_sub(1)?;
    let parts = || form.iter_list().take(MAX_PARTS);
    let head = parts().next()?.as_symbol()?;
    // What stands in a call of a macro is not evaluated as it stands.
    if let FunctionCell::Macro(_) | FunctionCell::Builtin = image.symbol(head).function {
        return None;
    }
    if let Some(found) = parts().find_map(|part| unknown_call(image, &part, variable, depth)) {
        return Some(found);
    }
    let is_argument = parts()
        .skip(1)
        .any(|part| part.as_symbol() == Some(variable));
    (is_argument && !has_function(image, head)).then_some(head)
}

/// Is the name that of a keyword which plans have as a value: an arm, a type of objects, a choice of a
/// key?
pub(super) fn is_value(image: &Image, name: &str) -> bool {
    let is_choice = |class| {
        let rows = schema::all(image, class);
        rows.iter()
            .flat_map(|row| &row.keys)
            .any(|key| match &key.kind {
                Kind::Member(members) => members.iter().any(|member| member == name),
                _ => false,
            })
    };
    matches!(name, "LEFT" | "RIGHT")
        || help::is_topic(image, name, "type of objects")
        || is_choice(Class::Action)
        || is_choice(Class::Motion)
}

/// What to say to somebody who has named a package that does not exist.
fn package_hint(image: &Image, designator: &Value) -> Option<String> {
    let wanted = match designator {
        Value::Symbol(sym, ..) => image.name(*sym).to_owned(),
        Value::Str(text) => text.text(),
        _ => return None,
    };
    let known = image.packages.names().map(|(name, _)| name);
    let near = closest_name(&wanted, known)?;
    (!near.eq_ignore_ascii_case(&wanted)).then(|| format!("Did you mean {near}?"))
}

/// What to say to somebody who has named a file that does not exist: one with a similar name in the
/// same folder, or among those that come with the program.
fn file_hint(image: &Image, path: &Value) -> Option<String> {
    let name = file_name(path)?;
    if image.files.facts(&name).is_ok() {
        return None;
    }
    let near = similar_file(image, Path::new(&name)).or_else(|| similar_plan(&name))?;
    Some(format!("Did you mean {near:?}?"))
}

/// A file in the same folder whose name is similar, or the same up to a type that was left out.
fn similar_file(image: &Image, path: &Path) -> Option<String> {
    let folder = path.parent()?;
    let is_here = folder.as_os_str().is_empty();
    let names = image
        .files
        .names(if is_here { "." } else { folder.to_str()? });
    let mut names = names.ok()?;
    names.sort();
    names.truncate(MAX_ENTRIES);
    let wanted = path.file_name()?.to_str()?;
    let names = || names.iter().map(|name| name.trim_end_matches('/'));
    let same_stem = || names().find(|name| stem(name) == wanted && *name != wanted);
    let near = same_stem().or_else(|| closest_name(wanted, names()))?;
    Some(folder.join(near).to_str()?.to_owned())
}

/// A file of plans that comes with the program and has such a name.
fn similar_plan(wanted: &str) -> Option<String> {
    let names = || TUTORIAL.iter().chain(DEMOS).map(|(name, _)| *name);
    let last = wanted.rsplit('/').next()?;
    let same_name = || {
        names().find(|name| {
            let own = name.rsplit('/').next().unwrap_or(name);
            own == last || stem(own) == last
        })
    };
    let near = same_name().or_else(|| closest_name(wanted, names()))?;
    Some(near.to_owned())
}

/// The name of a file without its type.
fn stem(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

/// Is there a function, macro or operator of that name?
pub(super) fn has_function(image: &Image, sym: Sym) -> bool {
    !matches!(image.symbol(sym).function, FunctionCell::Unbound)
}
