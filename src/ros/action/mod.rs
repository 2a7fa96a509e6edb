//! Goals of actions, as their protocol defines them: as servers see them, and as clients do.

mod client_goal;
mod goals;

pub use client_goal::{Ask, ClientEnd, ClientGoal, Patience};
pub use goals::{Canceling, GoalEnd, GoalId, GoalState, Goals, ResultRequest};
