//! The chapters on actions and motions: their types and keys.

use super::{code, codes, line};
use crate::plan::designator::schema::{Key, Kind, TYPES, TypeRow};
use crate::plan::designator::value::Class;

pub(crate) fn write(to: &mut String) {
    line(to, "\n## Actions\n");
    line(
        to,
        "`(perform (an action (type TYPE) (KEY VALUE)…))` does one. Keys in bold are required.\n",
    );
    chapter(to, Class::Action);
    line(to, "\n## Motions\n");
    line(
        to,
        "`(perform (a motion (type TYPE) (KEY VALUE)…))` makes one. Keys in bold are required.\n",
    );
    chapter(to, Class::Motion);
}

fn chapter(to: &mut String, class: Class) {
    for row in TYPES.iter().filter(|row| row.class == class) {
        write_row(to, row);
    }
}

fn write_row(to: &mut String, row: &TypeRow) {
    line(to, &format!("### {}\n", code(row.name)));
    line(to, &format!("{}\n", row.doc));
    if !row.aliases.is_empty() {
        line(
            to,
            &format!("Also {}.\n", codes(row.aliases.iter().copied())),
        );
    }
    if row.class == Class::Action {
        line(
            to,
            &format!("Plan: {}.\n", code(&format!("pp-plans:{}", row.plan))),
        );
    }
    if !row.one_of.is_empty() {
        let names = codes(row.one_of.iter().copied());
        line(to, &format!("At least one of {names} is required.\n"));
    }
    if row.keys.is_empty() {
        return;
    }
    line(to, "| key | takes | meaning |\n|---|---|---|");
    for key in row.keys {
        write_key(to, key);
    }
    line(to, "");
}

fn write_key(to: &mut String, key: &Key) {
    let name = if key.is_required {
        format!("**{}**", code(key.name))
    } else {
        code(key.name)
    };
    let aliases = if key.aliases.is_empty() {
        String::new()
    } else {
        format!(" (also {})", codes(key.aliases.iter().copied()))
    };
    line(
        to,
        &format!("| {name}{aliases} | {} | {} |", taken(key.kind), key.doc),
    );
}

fn taken(kind: Kind) -> &'static str {
    match kind {
        Kind::Location => "a location",
        Kind::Place => "a location or a pose",
        Kind::Object => "an object",
        Kind::Objects => "an object, or a list of them",
        Kind::Number => "a number",
        Kind::Keywords => "a keyword, or a list of them",
        Kind::Keyword => "a keyword",
        Kind::Symbol => "a symbol",
        Kind::Text => "a string",
        Kind::List => "a list",
        Kind::Poses => "a pose, or a list of them",
        Kind::PoseStamped => "a pose with a frame",
        Kind::KeywordOrObject => "a keyword or an object",
        Kind::Action => "an action",
        Kind::Anything => "anything",
    }
}
