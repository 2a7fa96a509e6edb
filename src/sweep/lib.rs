//! Sweeps: one plan in many worlds. What a world draws, what came of it, and what all of them say
//! together.
//!
//! This room knows no robot and no language. A world depends on its seed and its number alone, and
//! every draw in it on its own name besides: so neither threads nor the order of worlds matter, and
//! a draw that is added changes no other.

mod beta;
mod column_index;
mod division;
pub mod draw;
mod feature;
pub mod influence;
mod line;
pub mod mark;
mod normal;
pub mod paired;
pub mod pairs;
pub mod plural;
pub mod rate;
pub mod record;
pub mod relations;
pub mod sqlite;
pub mod summary;
mod tree;

pub use draw::Draws;
pub use mark::Mark;
pub use normal::normal_quantile;
pub use record::{Drawn, Ending, Record};
