//! A robot in a simulated kitchen: its body, the physics around it, what its camera sees, how it
//! moves, and where it and things could be. Nothing here knows of a plan language.

pub mod location;
pub mod mesh;
pub mod motion;
pub mod perception;
pub mod robot;
pub mod sexp;
pub mod world;

/// White-box tests by room.
#[cfg(test)]
#[allow(clippy::print_stdout)]
mod tests {
    mod mesh;
    mod motion;
    mod robot;
    pub(crate) mod world;
}
