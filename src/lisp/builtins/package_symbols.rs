//! The symbols of packages: importing, exporting, shadowing, and taking them out.

use super::packages::{names, one_or_more, or_current, package_error};
use super::property_lists::symbol;
use super::shown::shown;
use crate::builtin::Builtin;
use crate::image::Image;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::package::PackageId;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

type Outcome = Result<Value, Box<Raise>>;

/// Makes a symbol present in a package, unless the package has another of its name.
pub(crate) fn import_one(
    image: &mut Image,
    package: PackageId,
    sym: Sym,
) -> Result<(), Box<Raise>> {
    let found = image.packages.find_symbol(package, image.name(sym));
    if let Some((other, _)) = found
        && other != sym
    {
        return Err(package_error(
            format!(
                "IMPORT {} causes a name conflict in {}: it has another symbol of that name.",
                shown(image, &sym.into()),
                image.packages.get(package).name
            ),
            &Value::Package(package),
        ));
    }
    image.packages.import(&mut image.symbols, package, sym);
    Ok(())
}

/// Makes symbols present in a package (the current one).
///
/// `(import 'cl:car)` => `T`
#[builtin(_, "symbols &optional package")]
fn import(image: &mut Image, symbols_value: &Value, package: Option<&Value>) -> Outcome {
    let package = or_current(image, package)?;
    for sym in symbols(symbols_value)? {
        import_one(image, package, sym)?;
    }
    Ok(Value::T)
}

/// The symbols of a designator for a list of symbols; `NIL` is the empty list, not a symbol.
fn symbols(value: &Value) -> Result<Vec<Sym>, Box<Raise>> {
    one_or_more(value)?.iter().map(symbol).collect()
}

/// Makes symbols present in a package in place of others of their names.
///
/// `(shadowing-import nil)` => `T`
#[builtin(_, "symbols &optional package")]
fn shadowing_import(image: &mut Image, symbols_value: &Value, package: Option<&Value>) -> Outcome {
    let package = or_current(image, package)?;
    for sym in symbols(symbols_value)? {
        image
            .packages
            .shadowing_import(&mut image.symbols, package, sym);
    }
    Ok(Value::T)
}

/// Takes a symbol out of a package; was it there?
///
/// `(unintern (make-symbol "X"))` => `NIL`
// Removes a symbol from a package, unless two different symbols that it shadows would get its name.
#[builtin]
fn unintern(image: &mut Image, symbol: Sym, package: Option<&Value>) -> Outcome {
    let sym = symbol;
    let package = or_current(image, package)?;
    let name = image.name(sym).to_owned();
    let this = image.packages.get(package);
    let is_present = this
        .symbols
        .get(name.as_str())
        .is_some_and(|(present, _)| *present == sym);
    if is_present
        && this
            .shadowing
            .iter()
            .any(|shadowed| shadowed.as_ref() == name)
    {
        let mut inherited: Vec<Sym> = this
            .uses
            .iter()
            .filter_map(|used| image.packages.get(*used).symbols.get(name.as_str()))
            .filter(|(_, external)| *external)
            .map(|(inherited, _)| *inherited)
            .collect();
        inherited.dedup();
        if inherited.len() > 1 {
            return Err(package_error(
                format!(
                    "UNINTERN {name} causes a name conflict in {}: it shadows different symbols of packages that are used.",
                    this.name
                ),
                &Value::Package(package),
            ));
        }
    }
    let found = image.packages.unintern(&mut image.symbols, package, sym);
    Ok(found.into())
}

/// Checks that a symbol is accessible in a package; else it cannot be what is to be done to it.
fn must_be_accessible(
    image: &Image,
    package: PackageId,
    sym: Sym,
    what: &str,
    remedy: &str,
) -> Result<(), Box<Raise>> {
    let found = image.packages.find_symbol(package, image.name(sym));
    if found.is_some_and(|(found, _)| found == sym) {
        return Ok(());
    }
    Err(package_error(
        format!(
            "{} cannot be {what}: it is not accessible in {}{remedy}.",
            shown(image, &sym.into()),
            image.packages.get(package).name
        ),
        &Value::Package(package),
    ))
}

/// Exports symbols from a package (the current one).
///
/// `(export 'exported-as-example)` => `T`
#[builtin(_, "symbols &optional package")]
fn export(image: &mut Image, symbols_value: &Value, package: Option<&Value>) -> Outcome {
    let package = or_current(image, package)?;
    let users: Vec<PackageId> = users(image, package).collect();
    for sym in symbols(symbols_value)? {
        must_be_accessible(image, package, sym, "exported", "; import it first")?;
        no_conflict_in(image, &users, package, sym)?;
        image.packages.export(&mut image.symbols, package, sym);
    }
    Ok(Value::T)
}

/// The packages that use a package.
fn users(image: &Image, package: PackageId) -> impl Iterator<Item = PackageId> {
    let packages = &image.packages;
    let uses = move |user: &PackageId| packages.get(*user).uses.contains(&package);
    packages
        .ids()
        .filter(uses)
        .filter(|user| !packages.is_deleted(*user))
}

/// Checks that none of the packages that use one has another symbol of the name, unless it shadows that.
fn no_conflict_in(
    image: &Image,
    users: &[PackageId],
    package: PackageId,
    sym: Sym,
) -> Result<(), Box<Raise>> {
    let name = image.name(sym);
    let shadows = |user: PackageId| {
        let mut shadowing = image.packages.get(user).shadowing.iter();
        shadowing.any(|shadowed| shadowed.as_ref() == name)
    };
    let conflict = users.iter().copied().find(|user| {
        let found = image.packages.find_symbol(*user, name);
        found.is_some_and(|(other, _)| other != sym) && !shadows(*user)
    });
    match conflict {
        None => Ok(()),
        Some(user) => Err(package_error(
            format!(
                "EXPORT {} causes a name conflict in {}, which uses {}: it has another symbol of that name; shadow it there first.",
                shown(image, &sym.into()),
                image.packages.get(user).name,
                image.packages.get(package).name
            ),
            &Value::Package(package),
        )),
    }
}

/// Makes exported symbols internal again.
///
/// `(unexport 'exported-as-example)` => `T`
#[builtin(_, "symbols &optional package")]
fn unexport(image: &mut Image, symbols_value: &Value, package: Option<&Value>) -> Outcome {
    let package = or_current(image, package)?;
    for sym in symbols(symbols_value)? {
        must_be_accessible(image, package, sym, "unexported", "")?;
        image.packages.unexport(&image.symbols, package, sym);
    }
    Ok(Value::T)
}

/// Makes a name refer to a symbol of the package itself, whatever it would inherit.
pub(crate) fn shadow_one(image: &mut Image, package: PackageId, name: &str) {
    let present = image
        .packages
        .get(package)
        .symbols
        .get(name)
        .map(|(s, _)| *s);
    let sym = present.unwrap_or_else(|| image.make_symbol(name));
    if present.is_none() {
        image.symbols.get_mut(sym).package = Some(package);
    }
    let external = image
        .packages
        .get(package)
        .symbols
        .get(name)
        .is_some_and(|(_, external)| *external);
    image
        .packages
        .shadowing_import(&mut image.symbols, package, sym);
    if external {
        image.packages.export(&mut image.symbols, package, sym);
    }
}

/// Gives a package symbols of its own in place of inherited ones.
///
/// `(shadow "OWN-SYMBOL")` => `T`
#[builtin(_, "names &optional package")]
fn shadow(image: &mut Image, names_value: &Value, package: Option<&Value>) -> Outcome {
    let package = or_current(image, package)?;
    for name in names(image, Some(names_value))? {
        shadow_one(image, package, &name);
    }
    Ok(Value::T)
}

/// What is done to the symbols of packages.
pub(crate) static TABLE: &[Builtin] =
    builtins![import, shadowing_import, export, unintern, unexport, shadow,];
