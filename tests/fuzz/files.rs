//! Targets that are files of a session: transcripts, journals and recordings.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;

use super::corpus;
use super::target::{Taken, Taker, Target};
use crate::prompt::Earlier;
use crate::transcript::{Transcript, Verdict, blessed};
use view::watch::live::{History, Origin};
use view::watch::recording::{RecordingError, read_recording};

pub(super) fn targets() -> Vec<Target> {
    vec![
        Target {
            name: "transcript",
            share: 80,
            least_read: 70,
            words: &[
                "\nA> ",
                "\nPP-TUT 1]> ",
                "\nPP-TUT inspect> ",
                "\n...\n",
                "[..]",
                "\n",
                "\r\n",
                "(",
                ")",
                "\"",
                "; Ctrl-C at poll 3",
                "```session\n",
                "```\n",
                "~~~",
                "#|",
                "|#",
                "\u{e4}",
                "\t",
                "    ",
            ],
            corpus: || {
                [
                    corpus::stretches("tests/transcripts", ".transcript"),
                    corpus::stretches("tests/conformance", ".transcript"),
                    sessions(),
                ]
                .concat()
            },
            open: transcript,
        },
        Target {
            name: "journal",
            share: 100,
            least_read: 95,
            words: &[
                "\n",
                "\r",
                "\\n",
                "\\",
                "input ",
                "pasted ",
                "interrupted ",
                "ended ",
                "again 1",
                "skipped 1",
                "again 0",
                "seed ",
                "world ",
                "ended -",
                "planwright journal 1\n",
                "planwright journal 2\n",
                "planwright journal 3\n",
                "0000000000000000",
                " ",
                "\0",
            ],
            corpus: journals,
            open: journal,
        },
        Target {
            name: "recording",
            share: 40,
            least_read: 85,
            words: &[
                "\u{89}MCAP0\r\n",
                "\0\0\0\0\0\0\0\0",
                "\u{1}",
                "\u{6}",
                "lz4",
                "zstd",
                "{",
                "}",
                "[",
                "]",
                "\"",
                ",",
                ":",
                "null",
                "-1",
                "1e999",
                "\"t1\"",
                "\"m1\"",
            ],
            corpus: recordings,
            open: recording,
        },
    ]
}

/// The pieces of documents in which a session begins.
fn sessions() -> Vec<Vec<u8>> {
    let mut pieces = corpus::stretches("docs", ".md");
    let begins = |piece: &Vec<u8>| String::from_utf8_lossy(piece).contains("```session\n");
    pieces.retain(begins);
    pieces
}

/// Reads a transcript, compares its expectations with those of the next entry, and blesses it.
fn transcript() -> Taker {
    Box::new(|input| {
        let text = String::from_utf8_lossy(input);
        let name = if text.contains("```") || text.contains("~~~") {
            "a.md"
        } else {
            "a.transcript"
        };
        let transcript = Transcript::parse(name, &text);
        let outputs = transcript.entries.iter().cycle().skip(1);
        let pairs = transcript.entries.iter().zip(outputs);
        let verdicts: Vec<Verdict> = pairs
            .map(|(entry, next)| Verdict::of(entry, &next.expected.join("\n")))
            .collect();
        for verdict in &verdicts {
            if let Verdict::Failed(difference) = verdict {
                let _ = difference.unified();
            }
        }
        let _ = blessed(&transcript, &verdicts);
        Ok(Taken::if_read(!transcript.entries.is_empty()))
    })
}

const FIRST_LINE: &str = "planwright journal 2";

fn journals() -> Vec<Vec<u8>> {
    let programs = corpus::inputs("tests/conformance", ".transcript");
    let pieces = programs.chunks(4).enumerate().map(|(number, inputs)| {
        let mut lines = vec![format!("seed {number}")];
        for (at, input) in inputs.iter().enumerate() {
            let input = String::from_utf8_lossy(input).replace('\n', "\\n");
            lines.push(format!("{} {input}", ["input", "pasted"][at % 2]));
            lines.push(
                [
                    "ended 0123456789abcdef",
                    "interrupted 17",
                    "ended -",
                    "again 1",
                ][at]
                    .to_owned(),
            );
        }
        lines.push("skipped 2\n".to_owned());
        lines.join("\n").into_bytes()
    });
    corpus::small(pieces)
}

/// The records with their checksums.
fn sealed(records: &[u8]) -> Vec<u8> {
    let mut checksum = crc32fast::Hasher::new();
    checksum.update(FIRST_LINE.as_bytes());
    checksum.update(b"\n");
    let mut text = format!("{FIRST_LINE}\n").into_bytes();
    for line in records.split(|byte| *byte == b'\n') {
        checksum.update(line);
        checksum.update(b"\n");
        let space = line
            .iter()
            .position(|byte| *byte == b' ')
            .unwrap_or(line.len());
        text.extend(&line[..space]);
        text.extend(format!(" {:08x}", checksum.clone().finalize()).bytes());
        text.extend(&line[space..]);
        text.push(b'\n');
    }
    text
}

/// Reads the records as a journal with checksums, as an old one, and as they are. What has been
/// cut off has no more inputs than the whole.
fn journal() -> Taker {
    let parse = |bytes: &[u8]| Earlier::parse(Path::new("fuzz.journal"), bytes);
    Box::new(move |input| {
        let _ = parse(input);
        let _ = parse(&[b"planwright journal 1\n", input].concat());
        let whole = sealed(input);
        let cut = whole.len() * (input.len() % 7) / 7;
        let whole_inputs = parse(&whole).map_err(|error| error.to_string())?.inputs;
        if let Ok(part) = parse(&whole[..cut]) {
            let known = whole_inputs.iter().map(|input| &input.text);
            if !part
                .inputs
                .iter()
                .map(|input| &input.text)
                .eq(known.take(part.inputs.len()))
            {
                return Err("what has been cut off has other inputs".to_owned());
            }
        }
        Ok(Taken::if_read(!whole_inputs.is_empty()))
    })
}

/// Topics of a recording.
const TOPICS: &[&str] = &[
    "/tf",
    "/tf_static",
    "/scene/robot_and_kitchen",
    "/scene/objects",
    "/shown",
    "/log",
    "/tasks",
    "/joint_states",
];

/// Messages, each with the number of its topic.
const MESSAGES: &[(usize, &str)] = &[
    (
        0,
        r#"{"transforms":[{"timestamp":{"sec":1,"nsec":5},"parent_frame_id":"map","child_frame_id":"base_footprint","translation":{"x":1,"y":2,"z":0},"rotation":{"x":0,"y":0,"z":0,"w":1}}]}"#,
    ),
    (
        1,
        r#"{"transforms":[{"timestamp":{"sec":0,"nsec":0},"parent_frame_id":"map","child_frame_id":"table","translation":{"x":1,"y":2,"z":0},"rotation":{"x":0,"y":0,"z":0,"w":1}}]}"#,
    ),
    (
        2,
        r#"{"deletions":[],"entities":[{"timestamp":{"sec":0,"nsec":0},"frame_id":"table","id":"table","lifetime":{"sec":0,"nsec":0},"frame_locked":true,"metadata":[{"key":"kind","value":"furniture"}],"arrows":[],"cubes":[],"spheres":[],"cylinders":[],"lines":[],"triangles":[{"pose":{"position":{"x":0,"y":0,"z":0},"orientation":{"x":0,"y":0,"z":0,"w":1}},"points":[{"x":0,"y":0,"z":0},{"x":1,"y":0,"z":0},{"x":0,"y":1,"z":0}],"color":{"r":1,"g":1,"b":1,"a":1},"colors":[],"indices":[0,1,2]}],"texts":[],"models":[]}]}"#,
    ),
    (
        3,
        r#"{"deletions":[{"timestamp":{"sec":0,"nsec":0},"type":1,"id":""}],"entities":[]}"#,
    ),
    (
        4,
        r#"{"timestamp":{"sec":1,"nsec":0},"held":[{"object":"table","link":"r_gripper_palm_link"}],"touching":[["table","base_footprint"]],"stops":[{"frames":["table"],"position":{"x":0,"y":0,"z":0}}],"axes":[{"pose":{"position":{"x":0,"y":0,"z":0},"orientation":{"x":0,"y":0,"z":0,"w":1}},"length":0.1}],"paths":[{"what":"left","frame_id":"table","points":[{"x":0,"y":0,"z":0}]}]}"#,
    ),
    (
        5,
        r#"{"timestamp":{"sec":1,"nsec":0},"level":2,"message":"hello","name":"test","file":"","line":0}"#,
    ),
    (
        6,
        r#"{"timestamp":{"sec":1,"nsec":0},"id":"t1","parent":"","name":"[TOP-LEVEL]-1","state":"running","failure":""}"#,
    ),
    (
        7,
        r#"{"timestamp":{"sec":1,"nsec":0},"joints":[{"name":"torso_lift_joint","position":0.1}]}"#,
    ),
];

/// A recording of these messages.
fn written(messages: &[(usize, &[u8])]) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    let options = mcap::WriteOptions::new().compression(None);
    // Damage is to get further than to a checksum.
    let options = options
        .calculate_chunk_crcs(false)
        .calculate_data_section_crc(false);
    let mut writer = options.create(&mut file).unwrap();
    let schema = writer.add_schema("schema", "jsonschema", b"{}").unwrap();
    let none = BTreeMap::new();
    let ids: Vec<u16> = TOPICS
        .iter()
        .map(|topic| writer.add_channel(schema, topic, "json", &none).unwrap())
        .collect();
    for (number, (topic, message)) in (1..).zip(messages) {
        let header = mcap::records::MessageHeader {
            channel_id: ids[topic % ids.len()],
            sequence: number,
            log_time: u64::from(number) * 1_000_000,
            publish_time: 0,
        };
        writer.write_to_known_channel(&header, message).unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    file.into_inner()
}

fn recordings() -> Vec<Vec<u8>> {
    let one = |(topic, message): &(usize, &'static str)| (*topic, message.as_bytes());
    let messages: Vec<_> = MESSAGES.iter().map(one).collect();
    let mut corpus: Vec<Vec<u8>> = MESSAGES
        .iter()
        .map(|(_, m)| m.as_bytes().to_vec())
        .collect();
    corpus.push(written(&messages));
    corpus.push(written(&messages[5..]));
    corpus
}

/// The topic of the message that begins most like a text.
fn topic_of(text: &[u8]) -> usize {
    let alike = |message: &str| {
        let pairs = message.bytes().zip(text);
        pairs.take_while(|(a, b)| a == *b).count()
    };
    let like = MESSAGES.iter().max_by_key(|(_, message)| alike(message));
    like.map_or(0, |(topic, _)| *topic)
}

/// Reads a text as one message among sound ones, and anything else as a file. The library's own
/// panics become errors; a text is read by us, so there a panic is our own.
fn recording() -> Taker {
    Box::new(|input| {
        let history = History::new(Origin::Recording);
        if !input.starts_with(b"{") {
            let is_read = read_recording(input, &history).is_ok();
            return Ok(Taken::if_read(is_read));
        }
        let sound = |at: usize| (MESSAGES[at].0, MESSAGES[at].1.as_bytes());
        let topic = topic_of(input);
        let file = written(&[sound(0), sound(2), (topic, input), sound(0)]);
        match read_recording(&file, &history) {
            Err(RecordingError::Reader(problem)) => Err(problem),
            read => Ok(Taken::if_read(read.is_ok())),
        }
    })
}
