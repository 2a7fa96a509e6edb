//! Requested motions: one variant for each type, with its arguments.
//!
//! Everything about a type is in its file: its names, its keys, how it is made from arguments, and
//! the job that carries it out. A new type is a new file and a line in the list below. Nothing here
//! depends on how a language writes values: [`ArgumentKind`] says what a key takes, and the caller
//! provides [`Arguments`] of these kinds.

mod argument;
mod detecting;
mod following_trajectory;
mod going;
mod hands;
mod looking;
mod motion_type;
mod moving_arm_joints;
mod moving_tcp;
mod moving_torso;
mod pulling;
mod putting;
mod waiting;

pub use argument::{Argument, ArgumentError, ArgumentKind, Arguments};
pub use motion_type::{MotionKey, MotionType};

use crate::motion::jobs::job::Motion;

/// A type of motions: a struct of its arguments.
trait Command: Sized {
    /// The description of the type.
    const TYPE: MotionType;

    /// The motion with these arguments.
    fn new(arguments: &Arguments) -> Result<Self, ArgumentError>;

    /// The job that carries it out.
    fn job(self) -> Box<dyn Motion>;
}

macro_rules! commands {
    ($($variant:ident($file:ident)),* $(,)?) => {
        /// A requested motion.
        #[derive(Clone, Debug, PartialEq)]
        pub enum MotionCommand {
            $(#[doc = concat!("See [`", stringify!($file), "`].")] $variant($file::$variant)),*
        }

        /// All types of motions, in the order of the manual.
        pub static TYPES: &[MotionType] = &[$($file::$variant::TYPE),*];

        impl MotionCommand {
            /// The motion of the type with that name, which must not be an alias; `None` if there
            /// is no such type.
            pub fn new(
                name: &str,
                arguments: &Arguments,
            ) -> Option<Result<Self, ArgumentError>> {
                $(if name == $file::$variant::TYPE.name {
                    return Some($file::$variant::new(arguments).map(Self::$variant));
                })*
                None
            }

            /// The job that carries it out.
            pub fn job(self) -> Box<dyn Motion> {
                match self {
                    $(Self::$variant(command) => command.job()),*
                }
            }
        }
    };
}

commands! {
    Going(going),
    MovingTorso(moving_torso),
    Looking(looking),
    Detecting(detecting),
    Opening(hands),
    Closing(hands),
    Gripping(hands),
    MovingGripperJoint(hands),
    MovingTcp(moving_tcp),
    Putting(putting),
    Pulling(pulling),
    MovingArmJoints(moving_arm_joints),
    FollowingTrajectory(following_trajectory),
    Waiting(waiting),
}

/// The type with that name, which must not be an alias.
pub fn type_named(name: &str) -> Option<&'static MotionType> {
    TYPES.iter().find(|known| known.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_keys_that_a_type_refers_to_are_its_own() {
        for motion in TYPES {
            for name in motion.one_of.iter().chain(motion.about) {
                assert!(motion.keys.iter().any(|key| key.name == *name), "{name}");
            }
        }
    }

    #[test]
    fn a_motion_without_its_arguments_is_refused_or_needs_none() {
        for motion in TYPES {
            let made = MotionCommand::new(motion.name, &Arguments::default());
            let is_optional = motion.keys.iter().all(|key| !key.is_required);
            assert!(
                made.is_some_and(|made| made.is_err() || is_optional),
                "{}",
                motion.name
            );
        }
    }
}
