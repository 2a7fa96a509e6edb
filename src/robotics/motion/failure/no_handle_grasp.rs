//! Why a drawer or door cannot be opened or closed from where the robot stands.

use std::fmt;

use serde::Serialize;

use crate::robot::Side;
use crate::world::CollisionHit;

/// Why one way to take a handle does not work.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum HandleObstacle {
    /// The drawer or door itself, or what is in it, would run into something.
    Part(Box<CollisionHit>),
    /// The robot stands in the way of the drawer or door.
    Base(Box<CollisionHit>),
    /// The arm cannot bring the hand along the way.
    OutOfReach,
    /// The robot would touch something on the way.
    Collision(Box<CollisionHit>),
    /// Too many others failed for this one to be tried.
    NotTried,
}

/// What has been tried, and why nothing of it works.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NoHandleGrasp {
    /// Name of the handle.
    pub handle: String,
    /// Name of the joint.
    pub joint: String,
    /// Where the joint is, and where it was to be (rad or m).
    pub positions: [f64; 2],
    /// The arms, the causes, and how often each was met.
    pub causes: Vec<(Option<Side>, HandleObstacle, u32)>,
}

impl NoHandleGrasp {
    /// Notes a cause; of collisions with the same pair, the first is kept.
    pub(crate) fn add(&mut self, side: Option<Side>, cause: HandleObstacle) {
        let known = self
            .causes
            .iter_mut()
            .find(|(s, c, _)| *s == side && same(c, &cause));
        match known {
            Some((_, _, count)) => *count += 1,
            None => self.causes.push((side, cause, 1)),
        }
    }

    /// The cause that says most about the base pose.
    pub fn main(&self) -> Option<&HandleObstacle> {
        let rank = |cause: &HandleObstacle| match cause {
            HandleObstacle::Part(_) | HandleObstacle::Base(_) => 3,
            HandleObstacle::Collision(_) => 2,
            HandleObstacle::OutOfReach => 1,
            HandleObstacle::NotTried => 0,
        };
        let causes = self.causes.iter().map(|(_, cause, _)| cause);
        // The first of equals.
        causes.rev().max_by_key(|cause| rank(cause))
    }
}

fn same(a: &HandleObstacle, b: &HandleObstacle) -> bool {
    use HandleObstacle::{Base, Collision, Part};
    match (a, b) {
        (Part(a), Part(b)) | (Base(a), Base(b)) | (Collision(a), Collision(b)) => {
            a.moving == b.moving && a.other == b.other
        }
        _ => a == b,
    }
}

impl fmt::Display for NoHandleGrasp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [from, to] = self.positions;
        write!(
            f,
            "no hand can move {} by {} from {from:.3} to {to:.3} from where the robot stands: ",
            self.joint, self.handle
        )?;
        for (i, (side, cause, count)) in self.causes.iter().enumerate() {
            let separator = if i > 0 { "; " } else { "" };
            write!(f, "{separator}")?;
            if let Some(side) = side {
                write!(f, "{side} arm: ")?;
            }
            match cause {
                HandleObstacle::Part(hit) => {
                    write!(f, "{} would run into {}", hit.moving, hit.other)?
                }
                HandleObstacle::Base(hit) => {
                    write!(f, "{} is in the way of {}", hit.moving, hit.other)?
                }
                HandleObstacle::OutOfReach => write!(f, "out of reach")?,
                HandleObstacle::Collision(hit) => {
                    write!(f, "{} would touch {}", hit.moving, hit.other)?
                }
                HandleObstacle::NotTried => write!(f, "others not tried")?,
            }
            if *count > 1 {
                write!(f, " (×{count})")?;
            }
        }
        Ok(())
    }
}
