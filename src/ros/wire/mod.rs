//! A node that speaks to others: DDS by `rustdds`.

mod action_client;
mod action_server;
mod background;
mod broadcast;
mod camera_broadcast;
mod matches;
mod node;
mod payload;
mod service;
mod service_client;
mod topic_reader;

pub use action_client::ActionClient;
pub use action_server::{ActionServer, Wish};
pub use broadcast::{Broadcast, Follow, Newest};
pub use node::{Node, NodeError, Reliability, Retention, TopicQos, TopicWriter};
pub use service::{RequestId, Service};
pub use service_client::{Answer, Sequence, ServiceClient};
pub use topic_reader::TopicReader;
