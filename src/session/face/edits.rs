//! Editing the world, as the functions of the language with the same names do.

use super::{Datum, Failure, FramedPose};
use crate::Session;

impl Session {
    /// Puts an object of a type into the world, and lets it come to rest, for up to 20 s of the world's
    /// own; simulated time does not pass. An object of that name is moved. Names are in any case; plans
    /// know the object by the symbol in the current package.
    pub fn spawn(
        &mut self,
        kind: &str,
        name: &str,
        pose: impl Into<FramedPose>,
    ) -> Result<(), Failure> {
        let arguments = [
            Datum::symbol(name),
            Datum::keyword(kind),
            Datum::keyword("pose"),
            pose.into().into(),
        ];
        self.edit("SPAWN-OBJECT", &arguments)
    }

    /// Puts an object somewhere else, and lets it come to rest as [`Session::spawn`] does.
    pub fn move_object(&mut self, name: &str, pose: impl Into<FramedPose>) -> Result<(), Failure> {
        self.edit("MOVE-OBJECT", &[Datum::symbol(name), pose.into().into()])
    }

    /// Removes an object.
    pub fn remove_object(&mut self, name: &str) -> Result<(), Failure> {
        self.edit("KILL-OBJECT", &[Datum::symbol(name)])
    }

    /// Puts the robot's base somewhere else at once, in the map frame.
    pub fn move_robot(&mut self, pose: spatial::Pose) -> Result<(), Failure> {
        self.edit("MOVE-ROBOT", &[Datum::from(pose)])
    }

    fn edit(&mut self, function: &str, arguments: &[Datum]) -> Result<(), Failure> {
        let function = format!("CRAM-BULLET-REASONING-UTILITIES:{function}");
        self.call(&function, arguments).map(drop)
    }
}
