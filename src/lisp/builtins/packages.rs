//! Packages: finding, making, using.

use std::collections::BTreeMap;
use std::rc::Rc;

use crate::builtin::Builtin;
use crate::image::Image;
use crate::typed::FromValue;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::package::{Access, PackageId, PackageTable};
use crate::value::raise::Raise;
use crate::value::sequence::list_items;
use crate::value::symbol::Sym;

type Outcome = Result<Value, Box<Raise>>;

/// A package error with a text.
pub(crate) fn package_error(report: impl Into<String>, package: &Value) -> Box<Raise> {
    Raise::new(known::SIMPLE_PACKAGE_ERROR, report).with(known::K_PACKAGE, package.clone())
}

/// The package that a designator denotes, if there is one.
pub fn find(image: &Image, designator: &Value) -> Result<Option<PackageId>, Box<Raise>> {
    match designator {
        Value::Package(id) => Ok(Some(*id)),
        other => Ok(image
            .packages
            .find(&super::strings::designated(image, other)?)),
    }
}

/// The package that a designator denotes.
/// A package designator.
impl FromValue<'_> for PackageId {
    fn from_value(image: &mut Image, value: &Value) -> Result<Self, Box<Raise>> {
        designated(image, value)
    }
}

pub(crate) fn designated(image: &Image, designator: &Value) -> Result<PackageId, Box<Raise>> {
    match find(image, designator)? {
        Some(id) if !image.packages.is_deleted(id) => Ok(id),
        _ => {
            let name = match designator {
                Value::Package(id) => image.packages.get(*id).name.to_string(),
                other => super::strings::designated(image, other)?,
            };
            Err(package_error(
                format!("The name \"{name}\" does not designate any package."),
                designator,
            ))
        }
    }
}

/// The package that an optional argument denotes, by default the current one.
pub(crate) fn or_current(
    image: &Image,
    designator: Option<&Value>,
) -> Result<PackageId, Box<Raise>> {
    match designator {
        None | Some(Value::Symbol(known::NIL, ..)) => Ok(image.current_package()),
        Some(designator) => designated(image, designator),
    }
}

/// `:EXTERNAL`, `:INTERNAL`, `:INHERITED` or `NIL`.
pub fn status(access: Option<Access>) -> Value {
    match access {
        Some(Access::External) => known::K_EXTERNAL.into(),
        Some(Access::Internal) => known::K_INTERNAL.into(),
        Some(Access::Inherited) => known::K_INHERITED.into(),
        None => Value::NIL,
    }
}

/// The items of a list; a single item that is not a list counts as one.
pub(crate) fn one_or_more(value: &Value) -> Result<Vec<Value>, Box<Raise>> {
    if value.is_list() {
        list_items(value)
    } else {
        Ok(vec![value.clone()])
    }
}

/// The symbols accessible in a package, those present first, then the inherited ones, by
/// name.
pub fn accessible(image: &Image, package: PackageId) -> Vec<Sym> {
    let this = image.packages.get(package);
    let mut found: Vec<Sym> = this.symbols.values().map(|(sym, _)| *sym).collect();
    let mut inherited: BTreeMap<&str, Sym> = BTreeMap::new();
    for used in &this.uses {
        for (name, (sym, external)) in image.packages.get(*used).symbols.iter() {
            if *external && this.symbols.get(name).is_none() {
                inherited.entry(name).or_insert(*sym);
            }
        }
    }
    found.extend(inherited.into_values());
    found
}

/// Is the object a package?
///
/// `(packagep *package*)` => `T`
#[builtin]
fn packagep(object: &Value) -> bool {
    matches!(object, Value::Package(_))
}

/// The package of a name or nickname, or `NIL`.
///
/// `(find-package :cl)` => `#<PACKAGE "COMMON-LISP">`
#[builtin]
fn find_package(image: &mut Image, name: &Value) -> Outcome {
    Ok(find(image, name)?.map_or(Value::NIL, Value::Package))
}

/// A package's name.
///
/// `(package-name :cl)` => `"COMMON-LISP"`
#[builtin]
fn package_name(image: &mut Image, package: &Value) -> Outcome {
    if let Value::Package(id) = package
        && image.packages.is_deleted(*id)
    {
        return Ok(Value::NIL);
    }
    let id = designated(image, package)?;
    Ok(Value::string(image.packages.get(id).name.as_ref()))
}

/// A package's other names.
///
/// `(package-nicknames :keyword)` => `NIL`
#[builtin]
fn package_nicknames(image: &mut Image, package: PackageId) -> Outcome {
    let id = package;
    let names = &image.packages.get(id).nicknames;
    Ok(Value::list(names.iter().map(|n| Value::string(n.as_ref()))))
}

fn package_list(ids: impl IntoIterator<Item = PackageId>) -> Value {
    Value::list(ids.into_iter().map(Value::Package).collect::<Vec<_>>())
}

/// The packages that a package uses.
///
/// `(package-use-list :keyword)` => `NIL`
#[builtin]
fn package_use_list(image: &mut Image, package: PackageId) -> Outcome {
    let id = package;
    Ok(package_list(image.packages.get(id).uses.iter().copied()))
}

/// The packages that use a package.
///
/// `(package-used-by-list :keyword)` => `NIL`
#[builtin]
fn package_used_by_list(image: &mut Image, package: PackageId) -> Outcome {
    let id = package;
    let users = image.packages.ids();
    Ok(package_list(users.filter(|user| {
        !image.packages.is_deleted(*user) && image.packages.get(*user).uses.contains(&id)
    })))
}

/// The symbols that a package shadows.
///
/// `(package-shadowing-symbols :cl)` => `NIL`
#[builtin]
fn package_shadowing_symbols(image: &mut Image, package: PackageId) -> Outcome {
    let id = package;
    let this = image.packages.get(id);
    let symbols = this.shadowing.iter().filter_map(|n| this.symbols.get(n));
    let symbols: Vec<Sym> = symbols.map(|(sym, _)| *sym).collect();
    Ok(image.symbols.values(symbols))
}

/// All packages.
///
/// `(first (list-all-packages))` => `#<PACKAGE "COMMON-LISP">`
#[builtin(_, "")]
fn list_all_packages(image: &mut Image) -> Outcome {
    let all = image.packages.ids();
    Ok(package_list(
        all.filter(|id| !image.packages.is_deleted(*id)),
    ))
}

/// All symbols of a name.
///
/// `(find-all-symbols "CADDDR")` => `(CADDDR)`
#[builtin]
fn find_all_symbols(image: &mut Image, name: String) -> Outcome {
    let mut found: Vec<Sym> = Vec::new();
    for id in image.packages.ids() {
        if let Some((sym, _)) = image.packages.get(id).symbols.get(name.as_str())
            && !found.contains(sym)
        {
            found.push(*sym);
        }
    }
    Ok(image.symbols.values(found))
}

pub(super) fn names(image: &Image, list: Option<&Value>) -> Result<Vec<String>, Box<Raise>> {
    let items = list.map_or(Ok(Vec::new()), one_or_more)?;
    items
        .iter()
        .map(|item| super::strings::designated(image, item))
        .collect()
}

/// Makes a package.
pub fn make(image: &mut Image, name: &str, nicknames: &[String]) -> Result<PackageId, Box<Raise>> {
    let short: Vec<&str> = nicknames.iter().map(String::as_str).collect();
    image.packages.make(name, &short).ok_or_else(|| {
        let taken = std::iter::once(name)
            .chain(short.iter().copied())
            .find(|n| image.packages.find(n).is_some())
            .unwrap_or(name);
        package_error(
            format!("A package named \"{taken}\" already exists."),
            &Value::string(taken),
        )
    })
}

/// A new package.
///
/// `(package-name (system::%make-package :made-below))` => `"MADE-BELOW"`
#[builtin("%MAKE-PACKAGE", "name &key nicknames use")]
pub(super) fn make_package(
    image: &mut Image,
    name: String,
    #[key] nicknames: Option<&Value>,
    #[key] r#use: Option<&Value>,
    #[key] _size: Option<&Value>,
) -> Outcome {
    let nicknames = names(image, nicknames)?;
    let used: Result<Vec<PackageId>, _> = r#use
        .map_or(Ok(Vec::new()), one_or_more)?
        .iter()
        .map(|u| designated(image, u))
        .collect();
    let id = make(image, &name, &nicknames)?;
    for used in used? {
        use_one(image, id, used)?;
    }
    Ok(Value::Package(id))
}

/// Gives a package another name.
///
/// `(progn (make-package :old-name) (package-name (rename-package :old-name :new-name)))` => `"NEW-NAME"`
#[builtin]
fn rename_package(
    image: &mut Image,
    package: &Value,
    name: String,
    nicknames: Option<&Value>,
) -> Outcome {
    let id = designated(image, package)?;
    let nicknames: Vec<Rc<str>> = names(image, nicknames)?
        .iter()
        .map(|n| n.as_str().into())
        .collect();
    if image.packages.rename(id, &name, &nicknames) {
        Ok(Value::Package(id))
    } else {
        Err(package_error(
            format!("\"{name}\" or one of the nicknames is the name of another package."),
            package,
        ))
    }
}

/// Deletes a package.
///
/// `(progn (make-package :short) (system::%delete-package :short))` => `T`
#[builtin("%DELETE-PACKAGE")]
pub(super) fn delete_package(image: &mut Image, package: &Value) -> Outcome {
    if let Value::Package(id) = package
        && image.packages.is_deleted(*id)
    {
        return Ok(Value::NIL);
    }
    let id = designated(image, package)?;
    let name = image.packages.get(id).name.clone();
    if id <= PackageTable::SYSTEM {
        return Err(package_error(
            format!("The package {name} is part of the system and cannot be deleted."),
            package,
        ));
    }
    let users: Vec<PackageId> = image.packages.ids().collect();
    for user in users {
        image.packages.unuse_package(user, id);
    }
    let present: Vec<Sym> = image
        .packages
        .get(id)
        .symbols
        .values()
        .map(|(sym, _)| *sym)
        .collect();
    for sym in present {
        image.packages.unintern(&mut image.symbols, id, sym);
    }
    image.packages.delete(id);
    Ok(Value::T)
}

/// Lets a package use another, unless two different symbols would get the same name.
pub(crate) fn use_one(
    image: &mut Image,
    package: PackageId,
    used: PackageId,
) -> Result<(), Box<Raise>> {
    let shadowing = &image.packages.get(package).shadowing;
    let conflict = image
        .packages
        .get(used)
        .symbols
        .iter()
        .find(|(name, (sym, external))| {
            *external
                && !shadowing.contains(name)
                && image
                    .packages
                    .find_symbol(package, name)
                    .is_some_and(|(other, _)| other != *sym)
        });
    if let Some((name, _)) = conflict {
        let (user, used) = (
            &image.packages.get(package).name,
            &image.packages.get(used).name,
        );
        return Err(package_error(
            format!(
                "USE-PACKAGE {used} causes a name conflict in {user}: both have a symbol {name}; shadow it in {user} first."
            ),
            &Value::Package(package),
        ));
    }
    image.packages.use_package(package, used);
    Ok(())
}

/// Lets a package (the current one) inherit the exported symbols of others.
///
/// `(use-package :cl)` => `T`
#[builtin]
fn use_package(image: &mut Image, packages: &Value, package: Option<&Value>) -> Outcome {
    let package = or_current(image, package)?;
    for used in one_or_more(packages)? {
        let used = designated(image, &used)?;
        use_one(image, package, used)?;
    }
    Ok(Value::T)
}

/// Takes packages out of those that a package uses.
///
/// `(unuse-package :keyword)` => `T`
#[builtin]
fn unuse_package(image: &mut Image, packages: &Value, package: Option<&Value>) -> Outcome {
    let package = or_current(image, package)?;
    for used in one_or_more(packages)? {
        let used = designated(image, &used)?;
        image.packages.unuse_package(package, used);
    }
    Ok(Value::T)
}

/// Lets every name that is read in a package be one of its external symbols, and makes the package if there is
/// none: a package of names from elsewhere, of which nobody has a list.
///
/// `(progn (system:open-package "ELSEWHERE") (values (read-from-string "elsewhere:any")))` => `ELSEWHERE:ANY`
#[builtin]
fn open_package(image: &mut Image, name: String) -> Outcome {
    let known = image.packages.find(&name);
    let Some(id) = known.or_else(|| image.packages.make(&name, &[])) else {
        return Err(Raise::simple(format!(
            "No package {name} can be made: there are too many."
        )));
    };
    image.packages.get_mut(id).is_open = true;
    Ok(Value::Package(id))
}

/// Builtins of package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![open_package];

/// Packages.
pub(crate) static TABLE: &[Builtin] = builtins![
    packagep,
    find_package,
    package_name,
    package_nicknames,
    package_use_list,
    package_used_by_list,
    package_shadowing_symbols,
    list_all_packages,
    find_all_symbols,
    rename_package,
    use_package,
    unuse_package,
];
