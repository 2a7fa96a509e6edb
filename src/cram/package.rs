//! Makes packages from tables.

use lisp::image::Image;
use lisp::value::package::PackageId;

/// The definition of a package.
pub struct PackageDefinition {
    /// The name.
    pub name: &'static str,
    /// Other names.
    pub nicknames: &'static [&'static str],
    /// The documentation.
    pub doc: &'static str,
    /// Packages whose exported symbols it inherits; they must exist.
    pub uses: &'static [&'static str],
    /// Names of the symbols of its own that it exports.
    pub exports: &'static [&'static str],
    /// Packages whose exported symbols it also exports, except those with the same name as one of
    /// its own symbols.
    pub(crate) reexports: &'static [&'static str],
}

/// Makes the package, or completes an existing one with that name.
pub fn define(image: &mut Image, definition: &PackageDefinition) -> PackageId {
    let existing = image.packages.find(definition.name);
    let made = existing.or_else(|| image.packages.make(definition.name, &[]));
    // This fails only if there are 65536 packages; then the user's package is used instead.
    let id = made.unwrap_or(lisp::value::package::PackageTable::USER);
    for nickname in definition.nicknames {
        image.packages.add_nickname(id, nickname);
    }
    image.packages.get_mut(id).doc = Some(definition.doc.into());
    for used in definition.uses {
        if let Some(used) = image.packages.find(used) {
            image.packages.use_package(id, used);
        }
    }
    for name in definition.exports {
        image.export_symbol(id, name);
    }
    for source in definition.reexports {
        reexport(image, id, source);
    }
    id
}

/// Exports what another package exports, except names of the package's own symbols.
pub(crate) fn reexport(image: &mut Image, id: PackageId, source: &str) {
    let Some(source) = image.packages.find(source) else {
        return;
    };
    let external: Vec<_> = image
        .packages
        .get(source)
        .symbols
        .iter()
        .filter(|(_, (_, is_external))| *is_external)
        .map(|(name, (sym, _))| (name.clone(), *sym))
        .collect();
    for (name, sym) in external {
        let own = image.packages.get(id).symbols.get(&name).map(|(s, _)| *s);
        if own.is_none_or(|own| own == sym) {
            image.packages.export(&mut image.symbols, id, sym);
        }
    }
}
