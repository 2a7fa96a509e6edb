//! Targets that are files: URDF, data as s-expressions, transcripts, journals and recordings.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;
use std::sync::{Arc, LazyLock};

use super::corpus;
use super::run::{Taker, Target};
use crate::prompt::Earlier;
use crate::transcript::{Transcript, Verdict, blessed};
use descriptions::{KITCHEN_DESCRIPTION, KITCHEN_URDF, PR2_DESCRIPTION, PR2_URDF};
use robotics::robot::{KinematicTree, RobotDescription};
use robotics::world::grasp_library::{GRASPS, GraspLibrary};
use robotics::world::object_library::{OBJECTS, ObjectLibrary};
use robotics::world::{KitchenDescription, Models, RobotConfiguration, World};
use view::watch::live::{History, Origin};
use view::watch::recording::{RecordingError, read_recording};

pub(super) fn targets() -> Vec<Target> {
    vec![
        Target {
            name: "urdf",
            share: 60,
            words: &[
                "<",
                ">",
                "/>",
                "</",
                "\"",
                "<!--",
                "-->",
                "<![CDATA[",
                "]]>",
                "<?",
                "?>",
                "&lt;",
                "&#0;",
                "&#x110000;",
                "<link name=\"x\"/>",
                "<joint",
                "</robot>",
                " xyz=\"",
                " rpy=\"",
                " size=\"",
                " radius=\"",
                " scale=\"",
                "<mimic joint=\"j\"/>",
                "<box ",
                "<cylinder radius=\"1\" length=\"1\"/>",
                "<sphere radius=\"",
                "type=\"fixed\"",
                "type=\"planar\"",
                "1e-6 ",
                "1e4 ",
                "\u{e4}",
                "\0",
            ],
            corpus: urdfs,
            open: urdf,
        },
        Target {
            name: "data",
            share: 120,
            words: &[
                "(",
                ")",
                "()",
                " . ",
                "'",
                "#",
                "#(",
                ";",
                "#;",
                "#|",
                "\"",
                "|",
                "\\",
                ":",
                "#:",
                "(object ",
                "(grasp ",
                "(arm ",
                "(available ",
                "(kinds ",
                "(order ",
                "(rotation ",
                "1e400",
                "-",
                "+inf.0",
                "#t",
                "nil",
                "\u{e4}",
            ],
            corpus: || corpus::forms("world", ".sexp"),
            open: data,
        },
        Target {
            name: "transcript",
            share: 90,
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
                    corpus::stretches("docs", ".md"),
                ]
                .concat()
            },
            open: transcript,
        },
        Target {
            name: "journal",
            share: 130,
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
            share: 60,
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

const SMALL_URDF: &str = "<?xml version=\"1.0\"?>\n<robot name=\"r\"><!-- three links -->\
    <material name=\"red\"><color rgba=\"1 0 0 1\"/></material>\
    <link name=\"a\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" \
    iyz=\"0\" izz=\"1\"/></inertial><visual><origin xyz=\"0 0 1\"/><geometry><box size=\"1 1 1\"/>\
    </geometry><material name=\"red\"/></visual>\
    <collision><geometry><cylinder radius=\"0.3\" length=\"1\"/></geometry></collision></link>\
    <link name=\"b\"><collision><origin xyz=\"0 0 1\" rpy=\"0 1 0\"/><geometry>\
    <sphere radius=\"0.2\"/></geometry></collision></link><link name=\"c\"><collision><geometry>\
    <box size=\"0.1 2 1\"/></geometry></collision></link>\
    <joint name=\"j\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0 1\"/>\
    <limit lower=\"-1\" upper=\"1\" velocity=\"1\" effort=\"3\"/></joint>\
    <joint name=\"k\" type=\"prismatic\"><origin xyz=\"1 2 0\"/><parent link=\"b\"/><child link=\"c\"/>\
    <axis xyz=\"1 0 0\"/><limit lower=\"0\" upper=\"0.5\"/><mimic joint=\"j\" multiplier=\"2\" offset=\"1\"/>\
    </joint></robot>";

fn urdfs() -> Vec<Vec<u8>> {
    let mut pieces = corpus::stretches("world", ".urdf");
    pieces.extend(std::iter::repeat_n(
        SMALL_URDF.as_bytes().to_vec(),
        pieces.len() / 2 + 1,
    ));
    pieces
}

struct Pr2 {
    tree: KinematicTree,
    description: RobotDescription,
}

static PR2: LazyLock<Pr2> = LazyLock::new(|| {
    let tree = KinematicTree::from_urdf(PR2_URDF, "pr2.urdf").unwrap();
    let description = RobotDescription::from_sexp(PR2_DESCRIPTION, "pr2.sexp", &tree).unwrap();
    Pr2 { tree, description }
});

static KITCHEN: LazyLock<KinematicTree> =
    LazyLock::new(|| KinematicTree::from_urdf(KITCHEN_URDF, "kitchen.urdf").unwrap());

/// Reads a kitchen, and now and then builds a world with it and lets it take some steps.
fn urdf() -> Taker {
    let mut read = 0;
    Box::new(move |input| {
        let text = String::from_utf8_lossy(input);
        let Ok(kitchen) = KinematicTree::from_urdf(&text, "r.urdf") else {
            return Ok(());
        };
        read += 1;
        if read % 100 == 0 {
            let objects = ObjectLibrary::from_sexp(OBJECTS, "objects.sexp").unwrap();
            let furnishing = KitchenDescription::built_in(&kitchen).unwrap();
            let models = Models::new(
                PR2.tree.clone(),
                PR2.description.clone(),
                kitchen,
                furnishing,
                objects,
            );
            let joints = models.description.start_positions(&models.robot);
            let base = spatial::Pose::identity();
            let mut world = World::new(Arc::new(models), RobotConfiguration { base, joints });
            for _ in 0..3 {
                world.step();
            }
        }
        Ok(())
    })
}

fn data() -> Taker {
    LazyLock::force(&PR2);
    LazyLock::force(&KITCHEN);
    Box::new(|input| {
        let text = String::from_utf8_lossy(input);
        let _ = ObjectLibrary::from_sexp(&text, "objects.sexp");
        let _ = GraspLibrary::from_sexp(&text, "grasps.sexp");
        // A record alone is an error before most is looked at; behind the built-in ones it counts.
        match input.len() % 16 {
            0 => drop(ObjectLibrary::from_sexp(
                &format!("{OBJECTS}\n{text}"),
                "objects.sexp",
            )),
            1 => drop(GraspLibrary::from_sexp(
                &format!("{GRASPS}\n{text}"),
                "grasps.sexp",
            )),
            2 => drop(RobotDescription::from_sexp(
                &format!("{PR2_DESCRIPTION}\n{text}"),
                "pr2.sexp",
                &PR2.tree,
            )),
            3 => drop(RobotDescription::from_sexp(&text, "pr2.sexp", &PR2.tree)),
            4 => drop(KitchenDescription::from_sexp(
                &format!("{KITCHEN_DESCRIPTION}\n{text}"),
                "kitchen.sexp",
                &KITCHEN,
            )),
            5 => drop(KitchenDescription::from_sexp(
                &text,
                "kitchen.sexp",
                &KITCHEN,
            )),
            _ => {}
        }
        Ok(())
    })
}

/// Reads a transcript, compares its expectations with those of the next entry, and blesses it.
fn transcript() -> Taker {
    Box::new(|input| {
        let text = String::from_utf8_lossy(input);
        let name = if input.len() % 2 == 0 {
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
        Ok(())
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
        Ok(())
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

/// Reads a text as one message among sound ones, and anything else as a file. The library's own
/// panics become errors; a text is read by us, so there a panic is our own.
fn recording() -> Taker {
    Box::new(|input| {
        let history = History::new(Origin::Recording);
        if !input.starts_with(b"{") {
            let _ = read_recording(input, &history);
            return Ok(());
        }
        let sound = |at: usize| (MESSAGES[at].0, MESSAGES[at].1.as_bytes());
        let topic = input.len() % TOPICS.len();
        let file = written(&[sound(0), sound(2), (topic, input), sound(0)]);
        match read_recording(&file, &history) {
            Err(RecordingError::Reader(problem)) => Err(problem),
            Ok(_) | Err(_) => Ok(()),
        }
    })
}
