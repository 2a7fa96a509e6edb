//! A copy of an image: everything means the same in it, and whatever happens in one of the two,
//! nobody notices in the other.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use indexmap::IndexMap;

use super::Image;
use super::input::Input;
use super::output::Output;
use super::setf_expander::SetfExpander;
use super::signalled::Signalled;
use super::warnings::Warnings;
use crate::source::Place;
use crate::value::Value;
use crate::value::copy::{Copied, Copier};
use crate::value::symbol::Sym;

impl Image {
    /// A copy, if there can be one: nothing runs in the image, no file is being written, and nothing
    /// of it waits to be shown or read. `copy` makes copies of values that are kept outside, for the
    /// copy of the image.
    ///
    /// # Errors
    ///
    /// What a copy cannot have.
    pub fn copied<T>(
        &self,
        copy: impl FnOnce(&mut Copier) -> T,
    ) -> Result<(Image, T), &'static str> {
        let mut copier = Copier::new(&self.symbols);
        let copier = &mut copier;
        if !self.environment.is_nil() || self.nesting > 0 || self.notes.is_some() {
            copier.refuse("an evaluation that goes on");
        }
        if !self.signalled.is_empty() {
            copier.refuse("conditions that are known with their calls");
        }
        let output = self.output.copied();
        let image = Image {
            symbols: self.symbols.copied(copier),
            packages: self.packages.clone(),
            classes: named(&self.classes, copier),
            types: named(&self.types, copier),
            type_names: named(&self.type_names, copier),
            sources: self.sources.clone(),
            output: output.unwrap_or_else(|| {
                copier.refuse("output that nobody has been shown");
                Output::default()
            }),
            files: Arc::clone(&self.files),
            input: Input::default(),
            random: self.random.clone(),
            setf_expanders: named(&self.setf_expanders, copier),
            limits: Rc::new(self.limits.copied()),
            notes: None,
            noted_form: Place::NONE,
            warnings: Warnings::default(),
            environment: Value::NIL,
            nesting: 0,
            wants_all: true,
            signalled: Signalled::default(),
            identities: self.identities,
            entries: self.entries.clone(),
            library: self.library.copied(copier),
            new_symbols: self.new_symbols,
            natives: self.natives.clone(),
            printed: RefCell::default(),
            locks: self.locks.clone(),
            extensions: {
                let kept = self.extensions.iter();
                kept.map(|kept| kept.clone().copied(copier)).collect()
            },
        };
        let outside = copy(copier);
        copier.finish()?;
        image.printed.replace(self.printed.borrow().copied(copier));
        Ok((image, outside))
    }
}

fn named<T: Copied>(table: &IndexMap<Sym, T>, copier: &mut Copier) -> IndexMap<Sym, T> {
    let entries = table.iter();
    entries
        .map(|(name, value)| (*name, value.copied(copier)))
        .collect()
}

impl Copied for SetfExpander {
    fn copied(&self, copier: &mut Copier) -> SetfExpander {
        match self {
            SetfExpander::Update(function) => SetfExpander::Update(*function),
            SetfExpander::Long(function, count) => {
                SetfExpander::Long(copier.value(function), *count)
            }
            SetfExpander::Expander(function) => SetfExpander::Expander(copier.value(function)),
        }
    }
}
