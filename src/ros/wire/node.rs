//! A node of ROS 2, and the topics that it writes.

use std::cell::{Cell, RefCell};
use std::net::Ipv4Addr;
use std::sync::Arc;
use std::time::Duration;

use rustdds::no_key::{DataWriter, SimpleDataReader};
use rustdds::policy::{Durability, History};
use rustdds::{
    DataWriterStatus, DomainParticipant, DomainParticipantBuilder, Publisher, QosPolicies,
    QosPolicyBuilder, RTPSEntity, StatusEvented, TopicKind,
};
use thiserror::Error;

use super::payload::{AsBytes, Payload};
use super::service::Service;
use super::service_client::ServiceClient;
use super::topic_reader::TopicReader;
use crate::cdr::{CdrError, encode};
use crate::layout::Layouts;
use crate::names;
use crate::reach::Reach;
use crate::value::Value;

/// The topic by which tools learn which node writes and reads what, and its type.
const NODES: [&str; 2] = [
    "ros_discovery_info",
    "rmw_dds_common/msg/ParticipantEntitiesInfo",
];

/// How long a write may wait for room.
const MAX_WAIT: Duration = Duration::from_millis(10);

/// Why a node cannot speak.
#[derive(Debug, Error)]
pub enum NodeError {
    /// The network cannot be used as asked.
    #[error("the node of ROS 2 cannot start ({reach}): {cause}")]
    Start {
        /// Who was to hear it.
        reach: Reach,
        /// The reason.
        cause: String,
    },
    /// A topic cannot be had.
    #[error("{topic} cannot be published or heard: {cause}")]
    Topic {
        /// The topic.
        topic: String,
        /// The reason.
        cause: String,
    },
    /// A message is not what its layout says.
    #[error("{topic}: {cause}")]
    Message {
        /// The topic.
        topic: String,
        /// The reason.
        cause: CdrError,
    },
}

/// Whether what is lost on the way is sent again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reliability {
    /// It is.
    Reliable,
    /// It is not.
    BestEffort,
}

/// Whether who comes later gets what was sent before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Retention {
    /// No.
    Volatile,
    /// Yes, as much as is kept.
    TransientLocal,
}

/// The quality of service of a topic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TopicQos {
    /// Whether what is lost is sent again.
    pub reliability: Reliability,
    /// Whether who comes later gets what was sent before.
    pub retention: Retention,
    /// How many messages are kept.
    pub depth: u16,
}

impl TopicQos {
    /// Reliable, for those who are there.
    pub const fn volatile(depth: u16) -> Self {
        Self {
            reliability: Reliability::Reliable,
            retention: Retention::Volatile,
            depth,
        }
    }

    /// The last message, also for those who come later.
    pub const fn latched() -> Self {
        Self {
            reliability: Reliability::Reliable,
            retention: Retention::TransientLocal,
            depth: 1,
        }
    }

    /// The newest message, if it arrives.
    pub const fn best_effort(depth: u16) -> Self {
        Self {
            reliability: Reliability::BestEffort,
            retention: Retention::Volatile,
            depth,
        }
    }

    pub(super) fn policies(self) -> QosPolicies {
        let builder = QosPolicyBuilder::new()
            .history(History::KeepLast {
                depth: i32::from(self.depth),
            })
            .durability(match self.retention {
                Retention::Volatile => Durability::Volatile,
                Retention::TransientLocal => Durability::TransientLocal,
            });
        match self.reliability {
            Reliability::Reliable => builder.reliable(rustdds::Duration::from_std(MAX_WAIT)),
            Reliability::BestEffort => builder.best_effort(),
        }
        .build()
    }
}

/// A node of ROS 2.
pub struct Node {
    name: String,
    reach: Reach,
    layouts: Arc<Layouts>,
    participant: DomainParticipant,
    publisher: Publisher,
    /// Identities of what it writes and reads.
    writers: Vec<[u8; 16]>,
    readers: Vec<[u8; 16]>,
    announcements: Option<TopicWriter>,
}

impl Node {
    /// A node of a name, whose messages have these layouts.
    pub fn open(name: &str, reach: Reach, layouts: Layouts) -> Result<Self, NodeError> {
        let failed = |cause: &dyn ToString| NodeError::Start {
            reach,
            cause: cause.to_string(),
        };
        let mut builder = DomainParticipantBuilder::new(reach.domain);
        if reach.only_this_machine {
            builder = builder.with_only_networks([Ipv4Addr::LOCALHOST]);
        }
        let participant = builder.build().map_err(|error| failed(&error))?;
        let qos = QosPolicyBuilder::new().build();
        let publisher = participant.create_publisher(&qos);
        let mut node = Self {
            name: name.to_owned(),
            reach,
            layouts: Arc::new(layouts),
            publisher: publisher.map_err(|error| failed(&error))?,
            participant,
            writers: Vec::new(),
            readers: Vec::new(),
            announcements: None,
        };
        let [topic, kind] = NODES;
        node.announcements =
            Some(node.writer_of(topic, topic.to_owned(), kind, TopicQos::latched())?);
        node.announce()?;
        Ok(node)
    }

    /// Who can hear the node.
    pub fn reach(&self) -> Reach {
        self.reach
    }

    /// The layouts of its messages.
    pub fn layouts(&self) -> &Arc<Layouts> {
        &self.layouts
    }

    /// A topic that the node writes from now on.
    pub fn writer(
        &mut self,
        topic: &str,
        message: &str,
        qos: TopicQos,
    ) -> Result<TopicWriter, NodeError> {
        let writer = self.writer_of(topic, names::topic(topic), message, qos)?;
        self.writers.push(writer.writer.guid().to_bytes());
        self.announce()?;
        Ok(writer)
    }

    /// A service that the node offers from now on.
    pub fn service(
        &mut self,
        name: &str,
        request: String,
        response: String,
    ) -> Result<Service, NodeError> {
        let qos = TopicQos::volatile(100);
        let [request_topic, reply_topic] = names::service(name);
        let requests = self.reader_of(name, request_topic, &request, qos)?;
        let replies = self.writer_of(name, reply_topic, &response, qos)?.writer;
        self.readers.push(requests.guid().to_bytes());
        self.writers.push(replies.guid().to_bytes());
        self.announce()?;
        Ok(Service {
            layouts: Arc::clone(&self.layouts),
            request,
            response,
            requests,
            replies,
        })
    }

    /// A service that others offer, which the node asks from now on.
    pub fn client(
        &mut self,
        name: &str,
        request: String,
        response: String,
    ) -> Result<ServiceClient, NodeError> {
        let qos = TopicQos::volatile(100);
        let [request_topic, reply_topic] = names::service(name);
        // First who hears: a reply to the first request may come at once.
        let replies = self.reader_of(name, reply_topic, &response, qos)?;
        let requests = self.writer_of(name, request_topic, &request, qos)?.writer;
        self.readers.push(replies.guid().to_bytes());
        self.writers.push(requests.guid().to_bytes());
        self.announce()?;
        let identity = digest(&requests.guid().to_bytes());
        Ok(ServiceClient {
            layouts: Arc::clone(&self.layouts),
            request,
            response,
            requests,
            replies,
            identity,
            next: Cell::new(1),
            pending: RefCell::default(),
            matched: Cell::new([0, 0]),
        })
    }

    /// A topic that the node hears from now on.
    pub fn reader(
        &mut self,
        topic: &str,
        message: &str,
        qos: TopicQos,
    ) -> Result<TopicReader, NodeError> {
        let reader = self.reader_of(topic, names::topic(topic), message, qos)?;
        self.readers.push(reader.guid().to_bytes());
        self.announce()?;
        Ok(TopicReader {
            topic: topic.to_owned(),
            message: message.to_owned(),
            layouts: Arc::clone(&self.layouts),
            reader,
        })
    }

    /// What identifies the node among all.
    pub(super) fn identity(&self) -> [u8; 8] {
        digest(&self.participant.guid().to_bytes())
    }

    fn reader_of(
        &self,
        topic: &str,
        dds_topic: String,
        message: &str,
        qos: TopicQos,
    ) -> Result<SimpleDataReader<Payload, AsBytes>, NodeError> {
        let failed = |cause: &dyn ToString| NodeError::Topic {
            topic: topic.to_owned(),
            cause: cause.to_string(),
        };
        let policies = qos.policies();
        let kind = names::topic_type(message);
        let dds_topic = self
            .participant
            .create_topic(dds_topic, kind, &policies, TopicKind::NoKey);
        let dds_topic = dds_topic.map_err(|error| failed(&error))?;
        let subscriber = self.participant.create_subscriber(&policies);
        let subscriber = subscriber.map_err(|error| failed(&error))?;
        let reader = subscriber.create_simple_datareader_no_key(&dds_topic, Some(policies));
        reader.map_err(|error| failed(&error))
    }

    fn writer_of(
        &self,
        topic: &str,
        dds_topic: String,
        message: &str,
        qos: TopicQos,
    ) -> Result<TopicWriter, NodeError> {
        let failed = |cause: &dyn ToString| NodeError::Topic {
            topic: topic.to_owned(),
            cause: cause.to_string(),
        };
        let policies = qos.policies();
        let kind = names::topic_type(message);
        let dds_topic = self
            .participant
            .create_topic(dds_topic, kind, &policies, TopicKind::NoKey);
        let dds_topic = dds_topic.map_err(|error| failed(&error))?;
        let writer = self
            .publisher
            .create_datawriter_no_key(&dds_topic, Some(policies));
        Ok(TopicWriter {
            topic: topic.to_owned(),
            message: message.to_owned(),
            layouts: Arc::clone(&self.layouts),
            writer: writer.map_err(|error| failed(&error))?,
            listeners: Cell::new(0),
            mismatch: RefCell::default(),
        })
    }

    /// Tells tools such as `ros2 node list` what the node writes and reads.
    fn announce(&self) -> Result<(), NodeError> {
        let gid = |bytes: &[u8; 16]| {
            // Older distributions have room for more, which stays zero.
            let gid = self.layouts.fields("rmw_dds_common/msg/Gid");
            let is_long = gid.is_some_and(|fields| {
                let long = crate::Multiplicity::Array(24);
                fields.iter().any(|field| field.multiplicity == long)
            });
            let mut bytes = bytes.to_vec();
            bytes.resize(if is_long { 24 } else { 16 }, 0);
            Value::record([("data", Value::Bytes(bytes))])
        };
        let node = Value::record([
            ("node_namespace", "/".into()),
            ("node_name", self.name.as_str().into()),
            ("reader_gid_seq", Value::list(self.readers.iter().map(gid))),
            ("writer_gid_seq", Value::list(self.writers.iter().map(gid))),
        ]);
        let info = Value::record([
            ("gid", gid(&self.participant.guid().to_bytes())),
            ("node_entities_info_seq", Value::list([node])),
        ]);
        match &self.announcements {
            Some(writer) => writer.send(&info).map(drop),
            None => Ok(()),
        }
    }
}

/// Half as many bytes, in which all of an identity have a part (FNV-1a).
fn digest(identity: &[u8; 16]) -> [u8; 8] {
    let digest = identity.iter().fold(0xcbf2_9ce4_8422_2325, |digest, byte| {
        (digest ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    });
    u64::to_le_bytes(digest)
}

/// A topic that a node writes.
pub struct TopicWriter {
    topic: String,
    message: String,
    layouts: Arc<Layouts>,
    writer: DataWriter<Payload, AsBytes>,
    listeners: Cell<i32>,
    mismatch: RefCell<Option<String>>,
}

impl TopicWriter {
    /// Sends a message; false if there was no room for it, so that nobody will get it.
    pub fn send(&self, value: &Value) -> Result<bool, NodeError> {
        let bytes = encode(&self.layouts, &self.message, value);
        let bytes = bytes.map_err(|cause| NodeError::Message {
            topic: self.topic.clone(),
            cause,
        })?;
        Ok(self.writer.write(Payload::new(bytes), None).is_ok())
    }

    /// Its name.
    pub fn topic(&self) -> &str {
        &self.topic
    }

    /// The quality of service by which the last listener since the last call does not match, if there was one: it
    /// gets nothing, and the protocol tells neither side's user.
    pub fn mismatch(&self) -> Option<String> {
        self.hear();
        self.mismatch.take()
    }

    /// How many listen.
    pub fn listeners(&self) -> i32 {
        self.hear();
        self.listeners.get()
    }

    /// Hears who has come, and who has gone.
    fn hear(&self) {
        while let Some(status) = self.writer.try_recv_status() {
            match status {
                DataWriterStatus::OfferedIncompatibleQos { last_policy_id, .. } => {
                    self.mismatch.replace(Some(format!("{last_policy_id:?}")));
                }
                DataWriterStatus::PublicationMatched { current, .. } => {
                    self.listeners.set(current.count());
                }
                _ => {}
            }
        }
    }
}
