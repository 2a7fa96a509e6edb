//! What `defpackage`, `do-symbols` and related macros call.

use super::package_symbols::{import_one, shadow_one};
use super::packages::{
    self, accessible, designated, make, one_or_more, package_error, status, use_one,
};
use super::shown::shown;
use super::strings;
use crate::builtin::Builtin;
use crate::image::Image;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::package::{Access, PackageId, PackageTable};
use crate::value::raise::Raise;
use crate::value::sequence::list_items;
use crate::value::symbol::Sym;

type Outcome = Result<Value, Box<Raise>>;

/// The strings that an option lists.
fn texts(image: &Image, items: &[Value]) -> Result<Vec<String>, Box<Raise>> {
    items
        .iter()
        .map(|i| strings::designated(image, i))
        .collect()
}

/// Carries out a `defpackage`.
///
/// `(system::%define-package "DEFINED-AS-EXAMPLE" '((:use :cl)))` => `#<PACKAGE "DEFINED-AS-EXAMPLE">`
// Carries out a `defpackage`: arguments are the name and the options.
#[builtin("%DEFINE-PACKAGE", "name options")]
fn define_package(image: &mut Image, name: String, options_value: &Value) -> Outcome {
    let mut options: Vec<(Sym, Vec<Value>)> = Vec::new();
    for option in list_items(options_value)? {
        let parts = list_items(&option)?;
        match parts.split_first() {
            Some((Value::Symbol(key, ..), rest)) => options.push((*key, rest.to_vec())),
            _ => {
                return Err(Raise::program(format!(
                    "Bogus DEFPACKAGE option: {}",
                    shown(image, &option)
                )));
            }
        }
    }
    let of = |key: Sym| {
        let matching = options.iter().filter(move |(k, _)| *k == key);
        matching
            .flat_map(|(_, items)| items.iter().cloned())
            .collect::<Vec<Value>>()
    };
    check_options(image, &options)?;
    let nicknames = texts(image, &of(known::K_NICKNAMES))?;
    let used: Vec<PackageId> = of(known::K_USE)
        .iter()
        .map(|u| designated(image, u))
        .collect::<Result<_, _>>()?;
    let imports = imported(image, &options, known::K_IMPORT_FROM)?;
    let shadowing_imports = imported(image, &options, known::K_SHADOWING_IMPORT_FROM)?;
    let id = match image.packages.find(&name) {
        Some(id) => {
            for nickname in &nicknames {
                if image
                    .packages
                    .find(nickname)
                    .is_some_and(|other| other != id)
                {
                    return Err(package_error(
                        format!("A package named \"{nickname}\" already exists."),
                        &Value::string(nickname.as_str()),
                    ));
                }
                image.packages.add_nickname(id, nickname);
            }
            // A package that uses others in place of COMMON-LISP has their symbols of those names.
            if !used.is_empty() && !used.contains(&PackageTable::CL) {
                image.packages.unuse_package(id, PackageTable::CL);
            }
            id
        }
        None => make(image, &name, &nicknames)?,
    };
    for name in texts(image, &of(known::K_SHADOW))? {
        shadow_one(image, id, &name);
    }
    for sym in shadowing_imports {
        image.packages.shadowing_import(&mut image.symbols, id, sym);
    }
    for used in used {
        use_one(image, id, used)?;
    }
    for sym in imports {
        import_one(image, id, sym)?;
    }
    for name in texts(image, &of(known::K_INTERN))? {
        image.intern(id, &name);
    }
    for name in texts(image, &of(known::K_EXPORT))? {
        image.export_symbol(id, &name);
    }
    if let Some(Value::Str(doc)) = of(known::K_DOCUMENTATION).first() {
        image.packages.get_mut(id).doc = Some(doc.text().into());
    }
    Ok(Value::Package(id))
}

/// Checks that there are only options that exist, each of which there can be one of once, and that no
/// name is given two meanings.
fn check_options(image: &Image, options: &[(Sym, Vec<Value>)]) -> Result<(), Box<Raise>> {
    let mut meanings: Vec<(String, Sym)> = Vec::new();
    for (index, (key, items)) in options.iter().enumerate() {
        if !is_option(*key) {
            return Err(Raise::program(format!(
                "Bogus DEFPACKAGE option: {}; there are :USE, :EXPORT, :NICKNAMES, :IMPORT-FROM, :SHADOW, :SHADOWING-IMPORT-FROM, :INTERN, :SIZE and :DOCUMENTATION.",
                shown(image, &(*key).into())
            )));
        }
        let is_single = matches!(*key, known::K_SIZE | known::K_DOCUMENTATION);
        if is_single && options.iter().take(index).any(|(other, _)| other == key) {
            return Err(Raise::program(format!(
                "DEFPACKAGE has two options {}.",
                shown(image, &(*key).into())
            )));
        }
        let names = match *key {
            known::K_SHADOW | known::K_INTERN | known::K_EXPORT => items.as_slice(),
            known::K_IMPORT_FROM | known::K_SHADOWING_IMPORT_FROM => {
                items.get(1..).unwrap_or_default()
            }
            _ => &[],
        };
        for name in texts(image, names)? {
            let other = meanings
                .iter()
                .find(|(n, other)| *n == name && are_exclusive(*key, *other));
            if let Some((_, other)) = other {
                return Err(Raise::program(format!(
                    "DEFPACKAGE has {name} both in {} and in {}.",
                    shown(image, &(*other).into()),
                    shown(image, &(*key).into())
                )));
            }
            meanings.push((name, *key));
        }
    }
    Ok(())
}

/// May a name not stand in options of both kinds? What is exported may also be shadowed or imported.
fn are_exclusive(a: Sym, b: Sym) -> bool {
    match (a, b) {
        (known::K_EXPORT, other) | (other, known::K_EXPORT) => other == known::K_INTERN,
        _ => a != b,
    }
}

fn is_option(key: Sym) -> bool {
    [
        known::K_USE,
        known::K_EXPORT,
        known::K_NICKNAMES,
        known::K_IMPORT_FROM,
        known::K_SHADOW,
        known::K_SHADOWING_IMPORT_FROM,
        known::K_INTERN,
        known::K_SIZE,
        known::K_DOCUMENTATION,
    ]
    .contains(&key)
}

/// The symbols of `(:import-from package name…)` options.
fn imported(
    image: &Image,
    options: &[(Sym, Vec<Value>)],
    key: Sym,
) -> Result<Vec<Sym>, Box<Raise>> {
    let mut symbols = Vec::new();
    for (_, items) in options.iter().filter(|(k, _)| *k == key) {
        let Some((from, wanted)) = items.split_first() else {
            continue;
        };
        let from = designated(image, from)?;
        for name in texts(image, wanted)? {
            match image.packages.find_symbol(from, &name) {
                Some((sym, _)) => symbols.push(sym),
                None => {
                    return Err(package_error(
                        format!(
                            "No symbol named \"{name}\" in the package {}.",
                            image.packages.get(from).name
                        ),
                        &Value::Package(from),
                    ));
                }
            }
        }
    }
    Ok(symbols)
}

/// The package of a name; an error if there is none.
///
/// `(system::%existing-package :cl)` => `#<PACKAGE "COMMON-LISP">`
#[builtin("%EXISTING-PACKAGE")]
fn existing_package(image: &mut Image, designator: &Value) -> Outcome {
    designated(image, designator).map(Value::Package)
}

/// The symbols of a package.
///
/// `(system::%package-symbols (make-package :empty-example) :external)` => `NIL`
// The symbols of a package: `:INHERITED` all accessible ones, `:INTERNAL` the present
// ones, `:EXTERNAL` the exported ones, `T` those of all packages.
#[builtin("%PACKAGE-SYMBOLS", "package kind")]
fn package_symbols(image: &mut Image, package: &Value, kind_value: &Value) -> Outcome {
    let symbols: Vec<Sym> = match kind_value {
        Value::Symbol(known::T, ..) => {
            let mut all: Vec<Sym> = image
                .packages
                .ids()
                .flat_map(|id| image.packages.get(id).symbols.values())
                .map(|(sym, _)| *sym)
                .collect();
            all.sort();
            all.dedup();
            all
        }
        Value::Symbol(known::K_INHERITED, ..) => {
            let id = designated(image, package)?;
            accessible(image, id)
        }
        kind => {
            let id = designated(image, package)?;
            let all = kind.as_symbol() == Some(known::K_INTERNAL);
            let present = image.packages.get(id).symbols.values();
            let chosen = present.filter(|(_, external)| all || *external);
            chosen.map(|(sym, _)| *sym).collect()
        }
    };
    Ok(image.symbols.values(symbols))
}

/// An iterator over the symbols of packages.
///
/// `(system::%package-iterator :cl nil)` => `(NIL)`
// The state of a package iterator: a pair whose car lists what is still to come.
#[builtin("%PACKAGE-ITERATOR", "packages kinds")]
fn package_iterator(image: &mut Image, packages: &Value, kinds_value: &Value) -> Outcome {
    let kinds = list_items(kinds_value)?;
    let mut entries = Vec::new();
    for package in one_or_more(packages)? {
        let id = designated(image, &package)?;
        for sym in accessible(image, id) {
            let access: Option<Access> = image
                .packages
                .find_symbol(id, image.name(sym))
                .map(|(_, access)| access);
            let status = status(access);
            if kinds.iter().any(|kind| kind.is_eq(&status)) {
                let symbol = image.symbols.value(sym);
                entries.push(Value::list([symbol, status, Value::Package(id)]));
            }
        }
    }
    Ok(Value::cons(Value::list(entries), Value::NIL))
}

/// What the expansions call; in `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    packages::make_package,
    packages::delete_package,
    define_package,
    existing_package,
    package_symbols,
    package_iterator,
];
