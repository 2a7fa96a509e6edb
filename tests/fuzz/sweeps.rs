//! Targets that are files of a sweep: what is to be done, its shards, and what they become.

use std::io::Cursor;

use super::corpus;
use super::target::{Taken, Taker, Target};
use crate::command::sweep_texts;
use crate::sweep_report::{csv, html, junit};
use sweep::influence::Influence;
use sweep::relations::Relations;
use sweep::sqlite::Sqlite;
use sweep::summary::{Summary, Title};
use sweep::{Drawn, Ending, Record};

const WORDS: &[&str] = &[
    "{",
    "}",
    "[",
    "]",
    "\"",
    ",",
    ":",
    "null",
    "true",
    "-1",
    "1e999",
    "18446744073709551615",
    "\\u0000",
    "\\ud800",
    "\"world\":",
    "\"outcome\":\"failure\"",
    "\"outcome\":\"invalid\"",
    "\"draws\":{",
    "\"measures\":{",
    "\"shards\": ",
    "\"worlds\": ",
    "\"seed\": ",
    "\"time_limit\": ",
    "=1+1",
    "\n",
    "\u{1b}[2J",
];

pub(super) fn targets() -> Vec<Target> {
    vec![
        Target {
            name: "sweep",
            share: 20,
            least_read: 95,
            words: WORDS,
            corpus: || vec![PLAN.as_bytes().to_vec()],
            open: || {
                Box::new(|input| {
                    let text = String::from_utf8_lossy(input);
                    Ok(Taken::if_read(sweep_texts::is_plan(&text)))
                })
            },
        },
        Target {
            name: "records",
            share: 40,
            least_read: 95,
            words: WORDS,
            corpus: shards,
            open: records,
        },
    ]
}

/// What a sweep is to do.
const PLAN: &str = r#"{
  "version": "0.1.0",
  "program": "0123abcd-1000",
  "file": "a.plan",
  "text": "0123456789abcdef",
  "name": "carry",
  "seed": 7,
  "worlds": 40,
  "shards": 2,
  "goal": 0.9,
  "time_limit": 60.0
}"#;

/// Shards, without the line at their end.
fn shards() -> Vec<Vec<u8>> {
    let endings = [
        Ending::Success,
        Ending::Failure,
        Ending::Expectation,
        Ending::Limit,
        Ending::Invalid,
        Ending::Crashed,
    ];
    let record = |world: u64| {
        let mut record = Record::new(world, endings[world as usize % endings.len()]);
        if !record.is_success() {
            record.class = Some("GRIPPER-CLOSED-COMPLETELY".to_owned());
            record.cause = Some("out of reach".to_owned());
            record.bodies = vec!["BOWL-1".to_owned(), "table".to_owned()];
            record.failures.set("PERCEPTION-OBJECT-NOT-FOUND", world);
            record.handlers.set("a.plan:3 PLAN-FAILURE", 1);
        }
        record
            .draws
            .set("bottle.y", Drawn::Number(0.1 * world as f64));
        record.draws.set("clutter", Drawn::Integer(2));
        record.draws.set("kind", Drawn::Text(":CUP".to_owned()));
        record
            .draws
            .set("dark", Drawn::Flag(world.is_multiple_of(2)));
        record.expectations.set("parked", world != 2);
        record.measures.set("path", Drawn::Number(1.5));
        record.faults.push("gripper".to_owned());
        (record.time, record.steps, record.distance) = (30.5, 1000, 2.25);
        record.hash = format!("{world:016x}");
        record.line()
    };
    let shards = (1..6).map(|count| {
        let lines: Vec<String> = (0..count).map(record).collect();
        lines.join("\n").into_bytes()
    });
    corpus::small(shards)
}

/// Reads lines as a shard of a sweep and as facts, and writes what can be made of them.
fn records() -> Taker {
    Box::new(|input| {
        let text = String::from_utf8_lossy(input);
        let mut relations = Relations::default();
        let mut file = Sqlite::begin(Cursor::new(Vec::new())).map_err(|error| error.to_string())?;
        if relations.add("row", &text).is_ok() {
            // More columns than a table can have are an error.
            let _ = file.add_relations(&relations);
            let _ = file.finish();
        }
        let records = sweep_texts::shard(&text);
        let Ok(records) = records else {
            return Ok(Taken::Refused);
        };
        let title = Title {
            name: "fuzz".to_owned(),
            seed: 1,
            goal: Some(0.5),
        };
        let _ = Summary::new(&title, &records).to_string();
        let _ = Influence::of(&records).significant().count();
        let _ = (csv(&records), junit(&title, &records));
        let _ = html(&title, &records, "a.plan");
        let again: Vec<String> = records.iter().map(Record::line).collect();
        let again = sweep_texts::shard(&again.join("\n"))?;
        match again == records {
            true => Ok(Taken::Read),
            false => Err("records that are written read back as others".to_owned()),
        }
    })
}
