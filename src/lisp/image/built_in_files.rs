//! Files that are built in: what programs can load where no such file is.

use std::rc::Rc;

use super::extension::Extension;
use crate::value::copy::Copier;

/// The texts of files that are built in, by their names.
pub struct BuiltInFiles(pub fn(&str) -> Option<&'static str>);

impl Extension for BuiltInFiles {
    fn copied(self: Rc<Self>, _: &mut Copier) -> Rc<dyn Extension> {
        self
    }
}
