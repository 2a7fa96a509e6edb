//! The chapters on actions and motions: their types and keys.

use super::{code, codes, line};
use cram::designator::schema::{self, Key, TypeRow};
use cram::designator::value::Class;
use lisp::image::Image;

pub(crate) fn write(to: &mut String, image: &Image) {
    line(to, "\n## Actions\n");
    line(
        to,
        "`(perform (an action (type TYPE) (KEY VALUE)…))` does one. Keys in bold are required.\n",
    );
    chapter(to, image, Class::Action);
    line(to, "\n## Motions\n");
    line(
        to,
        "`(perform (a motion (type TYPE) (KEY VALUE)…))` makes one. Keys in bold are required.\n",
    );
    chapter(to, image, Class::Motion);
}

pub(super) fn chapter(to: &mut String, image: &Image, class: Class) {
    for row in schema::all(image, class) {
        write_row(to, image, &row);
    }
}

fn write_row(to: &mut String, image: &Image, row: &TypeRow) {
    line(to, &format!("### {}\n", code(&row.name)));
    line(to, &format!("{}\n", row.doc));
    if !row.aliases.is_empty() {
        let aliases = row.aliases.iter().map(|name| &**name);
        line(to, &format!("Also {}.\n", codes(aliases)));
    }
    if row.class == Class::Action {
        let package = image.symbol(row.plan).package;
        let package = package.map(|id| image.packages.get(id));
        let nickname = package.and_then(|p| p.nicknames.iter().min_by_key(|name| name.len()));
        let package = nickname.map_or("pp-plans", |name| &**name);
        let plan = format!("{package}:{}", image.name(row.plan));
        line(to, &format!("Plan: {}.\n", code(&plan)));
    }
    if let Some(example) = &row.example {
        line(to, &format!("Example: `{example}`.\n"));
    }
    if !row.one_of.is_empty() {
        let names = codes(row.one_of.iter().map(|name| &**name));
        line(to, &format!("At least one of {names} is required.\n"));
    }
    if row.keys.is_empty() {
        return;
    }
    line(to, "| key | takes | meaning |\n|---|---|---|");
    for key in &row.keys {
        write_key(to, key);
    }
    line(to, "");
}

fn write_key(to: &mut String, key: &Key) {
    let name = if key.is_required {
        format!("**{}**", code(&key.name))
    } else {
        code(&key.name)
    };
    let aliases = if key.aliases.is_empty() {
        String::new()
    } else {
        format!(" (also {})", codes(key.aliases.iter().map(|name| &**name)))
    };
    line(
        to,
        &format!("| {name}{aliases} | {} | {} |", key.kind.taken(), key.doc),
    );
}
