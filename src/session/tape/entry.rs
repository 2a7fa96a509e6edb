//! What is on a tape: the world's answers, in the order in which they were given.

use serde::{Deserialize, Serialize};

use super::data::{Data, Name, RaiseData};
use super::effects::Effects;
use cram::Reply;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::motion::DetectedObject;

/// An answer of the world.
#[derive(Clone, PartialEq, Serialize, Deserialize, Debug)]
pub enum Entry {
    /// A call that had nothing to do with the world: it is made again.
    Apart,
    /// The reply to a request.
    Answer {
        /// A checksum of the request.
        request: u32,
        effects: Effects,
        answer: Answer,
    },
    /// Time that passed (s), while motions were carried out or while the world was idle.
    Passed {
        from: f64,
        until: Option<f64>,
        reached: f64,
        effects: Effects,
        /// The motions that ended, by their tickets.
        done: Vec<(u64, Done)>,
    },
    /// The hash of the world.
    Hash(u64),
    /// Whether no motion was active or waiting.
    Rest(bool),
    /// A snapshot was taken; the number of its frame, if it has one.
    Snapshot(Option<u64>),
}

/// The reply to a request.
#[derive(Clone, PartialEq, Serialize, Deserialize, Debug)]
pub enum Answer {
    Value(Data),
    Raise(RaiseData),
    /// A motion was started.
    Later {
        ticket: u64,
        /// What its failures are about.
        subject: Data,
    },
}

/// How a motion ended.
#[derive(Clone, PartialEq, Serialize, Deserialize, Debug)]
pub enum Done {
    Value(Data),
    /// Objects were seen: what they are, and by which names users know them.
    Detected(Vec<(Name, DetectedObject)>),
    Raise(RaiseData),
}

impl Answer {
    /// The reply as data; `subject` is what a started motion is about.
    pub fn of(
        image: &Image,
        reply: &Result<Reply, Box<Raise>>,
        subject: Option<&Value>,
        given: &[Value],
    ) -> Option<Answer> {
        Some(match reply {
            Ok(Reply::Now(Ok(value))) => Answer::Value(Data::of(image, value, given)?),
            Ok(Reply::Now(Err(raise))) | Err(raise) => {
                Answer::Raise(RaiseData::of(image, raise, given)?)
            }
            Ok(Reply::Later(ticket)) => Answer::Later {
                ticket: ticket.0,
                subject: Data::of(image, subject?, given)?,
            },
        })
    }
}
