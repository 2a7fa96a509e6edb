//! Making packages from tables.

use crate::lisp::image::Image;
use crate::lisp::value::package::PackageId;

/// A package as a layer defines it.
pub(crate) struct PackageDefinition {
    /// The name.
    pub(crate) name: &'static str,
    /// Other names.
    pub(crate) nicknames: &'static [&'static str],
    /// A sentence about it.
    pub(crate) doc: &'static str,
    /// Packages whose exported symbols it inherits; they exist already.
    pub(crate) uses: &'static [&'static str],
    /// Names of symbols of its own that it exports.
    pub(crate) exports: &'static [&'static str],
    /// Packages whose exported symbols it exports, too, unless it has a symbol of its own
    /// by that name.
    pub(crate) reexports: &'static [&'static str],
}

/// Makes the package, or completes the one that has its name.
pub(crate) fn define(image: &mut Image, definition: &PackageDefinition) -> PackageId {
    let existing = image.packages.find(definition.name);
    let made = existing.or_else(|| image.packages.make(definition.name, &[]));
    // Only 65536 packages would leave none to make; the user's package then stands in.
    let id = made.unwrap_or(crate::lisp::value::package::PackageTable::USER);
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

/// Exports what another package exports, except under names that the package has itself.
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
