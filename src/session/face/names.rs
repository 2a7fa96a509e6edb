//! Names of symbols as programs give them.

use super::Failure;
use lisp::image::Image;
use lisp::value::package::PackageId;
use lisp::value::symbol::Sym;

/// A symbol that there is already: `package::name`, `package:name`, or `name` in the current package.
pub(super) fn known_symbol(image: &Image, text: &str) -> Result<Sym, Failure> {
    let (package, name) = parts(image, text)?;
    let found = image.packages.find_symbol(package, &name);
    found.map(|(sym, _)| sym).ok_or_else(|| {
        let package = &image.packages.get(package).name;
        Failure::Invalid(format!("There is no symbol {name} in package {package}."))
    })
}

/// The same; one that there is not is made.
pub(super) fn symbol(image: &mut Image, text: &str) -> Result<Sym, Failure> {
    let (package, name) = parts(image, text)?;
    Ok(image.intern(package, &name))
}

/// A package by its name or a nickname; the current one without any.
pub(super) fn package(image: &Image, name: Option<&str>) -> Result<PackageId, Failure> {
    let Some(name) = name else {
        return Ok(image.current_package());
    };
    let packages = &image.packages;
    let found = packages.find(name);
    let found = found.or_else(|| packages.find(&name.to_uppercase()));
    let found = found.filter(|id| !packages.is_deleted(*id));
    found.ok_or_else(|| Failure::Invalid(format!("There is no package {name}.")))
}

/// The package and the name, in upper case.
fn parts(image: &Image, text: &str) -> Result<(PackageId, String), Failure> {
    let (before, name) = match text.split_once(':') {
        Some(("", name)) => (Some("KEYWORD"), name),
        Some((before, name)) => (Some(before), name.strip_prefix(':').unwrap_or(name)),
        None => (None, text),
    };
    Ok((package(image, before)?, name.to_uppercase()))
}
