//! States of the world, to which a program returns.

use std::fmt;
use std::rc::Rc;

use thiserror::Error;

use crate::Session;
use crate::objects::Objects;
use crate::person;
use view::watch::Cause;

/// A state of the world: where everything is and how it moves, the robot's joints, and what the hands
/// hold. Variables of the language and simulated time are not part of it, as in `rewind`.
#[derive(Clone)]
pub struct Snapshot {
    state: person::Snapshot,
    /// What identifies the session.
    session: Rc<Objects>,
}

/// Why the world cannot return to a snapshot.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
pub enum RestoreError {
    /// The snapshot is of another session.
    #[error("the snapshot is of another session")]
    OtherSession,
    /// The robot moves.
    #[error("the world cannot be taken back while the robot moves")]
    Moving,
}

impl fmt::Debug for Snapshot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Snapshot").finish_non_exhaustive()
    }
}

impl Session {
    /// The present state of the world.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            state: person::Snapshot::take(&self.evaluator.host.simulation),
            session: Rc::clone(&self.evaluator.objects),
        }
    }

    /// Takes the world to an earlier state, from which it then goes on as it did then.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), RestoreError> {
        if !Rc::ptr_eq(&snapshot.session, &self.evaluator.objects) {
            return Err(RestoreError::OtherSession);
        }
        let host = &mut self.evaluator.host;
        let snapshots = &mut host.person.snapshots;
        snapshots
            .go_to(&mut host.simulation, &snapshot.state)
            .map_err(|_| RestoreError::Moving)?;
        host.audience.show(&host.simulation, Cause::Edit);
        Ok(())
    }
}
