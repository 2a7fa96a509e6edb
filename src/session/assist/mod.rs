//! Help while typing: completion, and the signature of the form being typed. Both read the
//! tables and the image without changing anything.

mod assistant;
mod completion;
mod context;
mod definitions;
mod description;
mod designators;
mod files;
mod hint;
mod locals;
mod names;
mod symbols;
mod uses;
mod wording;

pub(crate) use assistant::Assistant;
pub(crate) use names::ToldNames;
