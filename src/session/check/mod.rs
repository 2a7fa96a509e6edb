//! Checking a text without running it, and hints for somebody whose program has met a name that means
//! nothing.

mod arguments;
mod goals;
mod judge;
mod known;
mod meant;
mod signature;
mod suggestion;
mod text;
mod tokens;
mod types;
mod warnings;

#[cfg(test)]
mod tests;

pub(super) use known::KnownNames;
pub(super) use meant::hint;
pub use suggestion::suggested;
pub(super) use text::check_text;
pub(super) use warnings::install;
