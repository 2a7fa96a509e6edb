//! What came of one world: a line of JSON.
//!
//! A line has fixed keys in a fixed order, and nothing that depends on the machine or the time of
//! day: the same world is the same bytes.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::pairs::Pairs;

/// How a world ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Ending {
    /// No condition left the plan, and everything expected holds.
    Success,
    /// A condition left the plan.
    Failure,
    /// Something that was expected does not hold.
    Expectation,
    /// The plan took more simulated time than it may.
    Limit,
    /// The plan computed without end while no simulated time passed.
    Endless,
    /// It took more real time than it may: what it would have come to depends on the machine.
    Timeout,
    /// What the world was to contain found no place. This says nothing about the plan.
    Invalid,
    /// planwright itself failed, or one of its limits was reached, such as that of memory.
    Defect,
    /// The process that ran the world was killed by it.
    Crashed,
    /// The sweep itself is wrong: what varies cannot be found.
    Mistake,
}

impl Ending {
    /// Whether it says anything about the plan.
    pub fn counts(self) -> bool {
        !matches!(self, Self::Invalid | Self::Mistake) && !self.is_defect()
    }

    /// Whether planwright could not do its work, so that nothing is known about the plan.
    pub fn is_defect(self) -> bool {
        matches!(self, Self::Defect | Self::Crashed | Self::Timeout)
    }

    fn name(self) -> &'static str {
        match self {
            Self::Success => "success",
            Self::Failure => "failure",
            Self::Expectation => "expectation",
            Self::Limit => "limit",
            Self::Endless => "endless",
            Self::Timeout => "timeout",
            Self::Invalid => "invalid",
            Self::Defect => "defect",
            Self::Crashed => "crashed",
            Self::Mistake => "mistake",
        }
    }
}

impl fmt::Display for Ending {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A value that was drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Drawn {
    /// Whether something is so.
    Flag(bool),
    /// An integer.
    Integer(i64),
    /// A number.
    Number(f64),
    /// Anything else, as the language prints it.
    Text(String),
}

impl Drawn {
    /// It as a number; a flag is 0 or 1.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Flag(is_set) => Some(f64::from(u8::from(*is_set))),
            Self::Integer(number) => Some(*number as f64),
            Self::Number(number) => Some(*number),
            Self::Text(_) => None,
        }
    }
}

impl fmt::Display for Drawn {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Flag(is_set) => write!(f, "{is_set}"),
            Self::Integer(number) => write!(f, "{number}"),
            Self::Number(number) => write!(f, "{number}"),
            Self::Text(text) => f.write_str(text),
        }
    }
}

/// What came of one world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Its number.
    pub world: u64,
    /// How it ended.
    pub outcome: Ending,
    /// The class of the condition, the expectation, or the variable that found no place.
    pub class: Option<String>,
    /// The cause: the kind of failure of the last motion that failed, or why there was no place.
    pub cause: Option<String>,
    /// The bodies that touched, or would have.
    pub bodies: Vec<String>,
    /// Whether each expectation holds.
    pub expectations: Pairs<bool>,
    /// What was drawn, by path.
    pub draws: Pairs<Drawn>,
    /// The faults that were injected.
    pub faults: Vec<String>,
    /// Simulated time that the plan took (s).
    pub time: f64,
    /// Steps of the world since it began.
    pub steps: u64,
    /// How far the base has driven (m).
    pub distance: f64,
    /// How many motions failed, by class; the plan may have handled them.
    pub failures: Pairs<u64>,
    /// How often the handlers of the plan have handled each failure that they name, by file, line and
    /// failure.
    #[serde(default)]
    pub handlers: Pairs<u64>,
    /// What was measured.
    pub measures: Pairs<Drawn>,
    /// The hash of the world at the end.
    pub hash: String,
}

impl Record {
    /// A world about which nothing is known yet but how it ended.
    pub fn new(world: u64, outcome: Ending) -> Self {
        Self {
            world,
            outcome,
            class: None,
            cause: None,
            bodies: Vec::new(),
            expectations: Pairs::default(),
            draws: Pairs::default(),
            faults: Vec::new(),
            time: 0.0,
            steps: 0,
            distance: 0.0,
            failures: Pairs::default(),
            handlers: Pairs::default(),
            measures: Pairs::default(),
            hash: String::new(),
        }
    }

    /// Whether the plan worked.
    pub fn is_success(&self) -> bool {
        self.outcome == Ending::Success
    }

    /// The bytes of memory that it takes, or a few more.
    pub fn bytes(&self) -> usize {
        // A vector that grows has room for as many again.
        const ROOM: usize = 2;
        const STRING: usize = size_of::<String>();
        let texts = [&self.class, &self.cause].into_iter().flatten();
        let texts = texts.chain(&self.bodies).chain(&self.faults);
        let texts = texts.map(|text| STRING + text.capacity()).sum::<usize>();
        let drawn = |drawn: &Drawn| match drawn {
            Drawn::Text(text) => text.capacity(),
            _ => 0,
        };
        ROOM * size_of::<Self>()
            + texts
            + self.hash.capacity()
            + self.expectations.bytes(|_| 0)
            + self.draws.bytes(drawn)
            + self.failures.bytes(|_| 0)
            + self.handlers.bytes(|_| 0)
            + self.measures.bytes(drawn)
    }

    /// The line of JSON, without its end.
    pub fn line(&self) -> String {
        // Nothing in a record fails to be written: names are texts, and numbers that are not finite
        // become null.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// Why it ended as it did: worlds with the same kind are counted together.
    pub fn kind(&self) -> [String; 3] {
        let class = match (&self.outcome, &self.class) {
            (Ending::Expectation, Some(name)) => format!("expectation {name}"),
            (_, Some(class)) => class.clone(),
            (outcome, None) => outcome.to_string(),
        };
        [
            class,
            self.cause.clone().unwrap_or_default(),
            self.bodies.join("/"),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_reads_back_to_the_same_line() {
        let mut record = Record::new(17, Ending::Failure);
        record.class = Some("TORSO-GOAL-NOT-REACHED".to_owned());
        for (name, value) in [
            ("b", Drawn::Number(-1.0)),
            ("a", Drawn::Number(0.1 + 0.2)),
            ("n", Drawn::Integer(3)),
            ("f", Drawn::Flag(true)),
            ("t", Drawn::Text(":CUP".to_owned())),
        ] {
            record.draws.set(name, value);
        }
        let line = record.line();
        assert!(
            line.starts_with(r#"{"world":17,"outcome":"failure","class":"TORSO"#),
            "{line}"
        );
        assert!(
            line.contains(
                r#""draws":{"b":-1.0,"a":0.30000000000000004,"n":3,"f":true,"t":":CUP"}"#
            ),
            "{line}"
        );
        let again: Record = serde_json::from_str(&line).unwrap();
        assert_eq!(again, record);
        assert_eq!(again.line(), line);
    }
}
