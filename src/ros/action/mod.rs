//! Goals of actions, as their protocol defines them.

mod goals;

pub use goals::{Canceling, GoalEnd, GoalId, GoalState, Goals, ResultRequest};
