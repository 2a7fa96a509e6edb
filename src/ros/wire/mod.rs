//! A node that speaks to others: DDS by `rustdds`.

mod action_server;
mod broadcast;
mod node;
mod payload;
mod service;

pub use action_server::{ActionServer, Wish};
pub use broadcast::{Broadcast, Follow, Newest};
pub use node::{Node, NodeError, Reliability, Retention, TopicQos, TopicWriter};
pub use service::{RequestId, Service};
