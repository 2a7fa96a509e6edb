//! What a call changes in the image besides its value.

use serde::{Deserialize, Serialize};

use lisp::image::Image;
use lisp::value::package::PackageId;

/// The state of the image before a call.
#[derive(Clone, Copy)]
pub(crate) struct Mark {
    written: usize,
    symbols: usize,
    polls: u64,
    identities: u64,
}

/// What a call has changed.
#[derive(Clone, PartialEq, Serialize, Deserialize, Debug)]
pub struct Effects {
    /// What it wrote.
    text: String,
    /// The symbols that it made, with their packages.
    symbols: Vec<(u16, String)>,
    /// How often it looked at the interrupt flag.
    polls: u64,
    /// The number of motions begun so far.
    begun: u64,
}

impl Mark {
    pub(crate) fn of(image: &Image) -> Mark {
        Mark {
            written: image.output.len(),
            symbols: image.symbols.len(),
            polls: image.polls().count(),
            identities: image.printed.borrow().given(),
        }
    }

    /// What has changed since; `None` if that cannot be repeated. `begun` is the number of motions
    /// begun.
    pub(crate) fn effects(&self, image: &Image, begun: u64) -> Option<Effects> {
        // An object that was printed got a number, and nobody knows which object that was.
        if image.printed.borrow().given() != self.identities {
            return None;
        }
        let made = image.symbols.iter().skip(self.symbols);
        let symbols = made.map(|(_, data)| Some((data.package?.0, data.name.to_string())));
        Some(Effects {
            text: image.output.written_since(self.written)?.to_owned(),
            symbols: symbols.collect::<Option<_>>()?,
            polls: image.polls().count().checked_sub(self.polls)?,
            begun,
        })
    }
}

impl Effects {
    /// Changes the same things.
    pub fn repeat(&self, image: &mut Image) {
        for (package, name) in &self.symbols {
            image.intern(PackageId(*package), name);
        }
        if !self.text.is_empty() {
            image.output.write(&self.text);
        }
        image.polls().skip(self.polls);
    }

    /// The number of motions begun so far.
    pub fn begun(&self) -> u64 {
        self.begun
    }
}
