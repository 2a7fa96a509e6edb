//! The class that was probably meant.

use crate::image::Image;
use crate::value::symbol::Sym;
use closest_name::closest_name;

/// The name of a class that is nearest to one that is none.
pub(super) fn near_class(image: &Image, name: Sym) -> Option<Sym> {
    nearest(image, name, defined_classes(image))
}

/// The names of all classes that are defined, in order of definition.
pub(crate) fn defined_classes(image: &Image) -> impl Iterator<Item = Sym> {
    let classes = image.classes.iter();
    let classes = classes.filter(|(_, class)| class.is_defined.get());
    classes.map(|(name, _)| *name)
}

/// Of some names, the one that is nearest to another name, if it is near.
pub(crate) fn nearest(image: &Image, name: Sym, names: impl Iterator<Item = Sym>) -> Option<Sym> {
    let names: Vec<Sym> = names.collect();
    let near = closest_name(image.name(name), names.iter().map(|sym| image.name(*sym)))?;
    names.into_iter().find(|sym| image.name(*sym) == near)
}
