//! What layers above the language keep in an image: one value per type.

use std::any::Any;
use std::rc::Rc;

use super::Image;
use crate::value::copy::Copier;

/// A value that a layer above the language keeps in the image.
pub trait Extension: Any {
    /// The value for a copy of the image; what there cannot be, it refuses.
    fn copied(self: Rc<Self>, copier: &mut Copier) -> Rc<dyn Extension>;
}

impl Image {
    /// Keeps a value of a layer above the language, replacing any value of the same type.
    pub fn extend<T: Extension>(&mut self, value: T) -> Rc<T> {
        let value = Rc::new(value);
        self.extensions.retain(|kept| {
            let kept: &dyn Any = kept.as_ref();
            !kept.is::<T>()
        });
        self.extensions.push(value.clone());
        value
    }

    /// The value of a layer above the language, found by its type.
    pub fn extension<T: Extension>(&self) -> Option<Rc<T>> {
        self.extensions.iter().find_map(|kept| {
            let kept: Rc<dyn Any> = kept.clone();
            kept.downcast().ok()
        })
    }
}
