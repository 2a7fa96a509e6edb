//! The types of actions and motions that an image knows.

use std::cell::RefCell;
use std::rc::Rc;

use super::TypeRow;
use crate::designator::value::Class;
use closest_name::closest_name;
use lisp::image::Image;
use lisp::image::extension::Extension;
use lisp::value::copy::Copier;

/// The table of an image, in order of definition.
#[derive(Default)]
struct Types(RefCell<Vec<Rc<TypeRow>>>);

impl Extension for Types {
    fn copied(self: Rc<Self>, _: &mut Copier) -> Rc<dyn Extension> {
        Rc::new(Types(self.0.clone()))
    }
}

/// Makes an empty table.
pub fn install(image: &mut Image) {
    image.extend(Types::default());
}

/// Adds a row, replacing the one with the same name and variant, if there is one.
pub fn define(image: &Image, row: TypeRow) {
    let Some(types) = image.extension::<Types>() else {
        return;
    };
    let mut rows = types.0.borrow_mut();
    let is_same = |other: &Rc<TypeRow>| {
        other.class == row.class && other.name == row.name && other.variant == row.variant
    };
    match rows.iter().position(is_same) {
        Some(place) => {
            rows.remove(place);
            rows.insert(place, Rc::new(row));
        }
        None => rows.push(Rc::new(row)),
    }
}

/// The types of a class, in order of definition.
pub fn all(image: &Image, class: Class) -> Vec<Rc<TypeRow>> {
    such(image, |row| row.class == class)
}

fn such(image: &Image, is_wanted: impl Fn(&TypeRow) -> bool) -> Vec<Rc<TypeRow>> {
    let Some(types) = image.extension::<Types>() else {
        return Vec::new();
    };
    let rows = types.0.borrow();
    rows.iter().filter(|row| is_wanted(row)).cloned().collect()
}

/// The rows of a type with that name or alias, those with the name first.
pub fn rows(image: &Image, class: Class, name: &str) -> Vec<Rc<TypeRow>> {
    let mut rows = such(image, |row| row.class == class && row.is_named(name));
    rows.sort_by_key(|row| row.name != name);
    rows
}

/// Whether there is a type with that name or alias.
pub fn is_type(image: &Image, class: Class, name: &str) -> bool {
    !rows(image, class, name).is_empty()
}

/// The name of a type that was probably meant.
pub(crate) fn nearest_type(image: &Image, class: Class, name: &str) -> Option<String> {
    let rows = all(image, class);
    let mut names: Vec<&str> = Vec::new();
    for known in rows.iter().flat_map(|row| row.names()) {
        if !names.contains(&known) {
            names.push(known);
        }
    }
    closest_name(name, names).map(str::to_owned)
}
