//! Sweeps: one plan in many worlds. What a world draws, what came of it, and what all of them say
//! together.
//!
//! This room knows no robot and no language. A world depends on its seed and its number alone, and
//! every draw in it on its own name besides: so neither threads nor the order of worlds matter, and
//! a draw that is added changes no other.

mod beta;
mod division;
pub(crate) mod draw;
mod feature;
pub(crate) mod influence;
mod normal;
pub(crate) mod paired;
pub(crate) mod pairs;
mod plural;
pub(crate) mod rate;
pub(crate) mod record;
pub(crate) mod summary;
mod tree;

pub(crate) use draw::Draws;
pub(crate) use normal::normal_quantile;
pub(crate) use record::{Drawn, Ending, Record};
