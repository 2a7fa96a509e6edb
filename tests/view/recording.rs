//! Recordings: what is written is read back, the same session writes the same bytes, and
//! files that are none are refused.

use std::path::PathBuf;

use session::dialogue::{Evaluate, Outcome};
use session::{Session, SessionOptions};
use view::watch::live::{History, Origin};
use view::watch::recording::read::Recording;
use view::watch::recording::{Episode, RecordingError, Wanted, read_episode, read_recording};
use view::watch::{Kind, Press, TaskState, WatchEvent};

const EXERCISE: &str = "(in-package :pp-tut)
    (init-projection)
    (spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))
    (visualize-coordinates :bottle)
    (roslisp:ros-info (test) \"Here \\\"we\\\" go\")
    (progn (roslisp:ros-warn (test) \"one~%two\") (format t \"three~%\"))
    (with-simulated-robot
      (cpl:par
        (perform (a motion (type moving-torso) (joint-angle 0.3)))
        (park-arms)))
    (spawn-object '((-1.2 -0.9 0.82) (0 0 0 1)) :cup 'cup-1 '(0 1 0))";

/// A file of that name that does not exist yet.
fn file(name: &str) -> PathBuf {
    let folder = crate::tests::scratch_folder();
    let path = folder.join(format!("{name}.mcap"));
    let _ = std::fs::remove_file(&path);
    path
}

/// The bytes of a recording of the exercise, and the hash of the world after it.
pub(super) fn recorded(name: &str) -> (Vec<u8>, u64) {
    let path = file(name);
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    session.begin_recording(&path).unwrap();
    let outcome = session.evaluate("test", EXERCISE, &mut |_| {});
    assert_eq!(outcome, Outcome::Finished);
    session.end_recording().unwrap();
    let bytes = std::fs::read(&path).unwrap();
    (bytes, session.simulation().world().hash())
}

fn read(bytes: &[u8]) -> (Result<Recording, RecordingError>, History) {
    let history = History::new(Origin::Recording);
    (read_recording(bytes, &history), history)
}

#[test]
fn a_recording_shows_what_happened() {
    let (bytes, hash) = recorded("shows");
    let mut unseen = Session::new(&SessionOptions::default()).unwrap();
    unseen.evaluate("test", EXERCISE, &mut |_| {});
    assert_eq!(unseen.simulation().world().hash(), hash);

    let (found, history) = read(&bytes);
    let found = found.unwrap();
    // Thirty a second, and one for each change while the clock stands.
    let more = found.frames as f64 - 30.0 * unseen.simulation().now();
    assert!((0.0..12.0).contains(&more), "{found:?} {more}");
    assert!(!found.is_cut_off, "{found:?}");
    let nodes = history.nodes_from(0);
    let node = |name: &str| nodes.iter().find(|n| n.name == name).unwrap();
    let bottle = node("BOTTLE-1");
    assert_eq!((bottle.kind, &*bottle.type_name), (Kind::Object, "bottle"));
    assert!(!bottle.mesh.triangles.is_empty());

    let past = history.past(0.0, 100.0, 10_000);
    let last = past.last().unwrap();
    let place = |name: &str| last.placed.iter().find(|p| p.node == node(name).id);
    let world = unseen.simulation().world();
    for name in ["BOTTLE-1", "CUP-1"] {
        let real = world.object_pose(name).unwrap().translation.vector;
        let told = place(name).unwrap().at;
        let off = (0..3).map(|i| (real[i] - f64::from(told[i])).abs());
        assert!(off.fold(0.0, f64::max) < 1e-4, "{name}");
    }
    assert!(last.axes.is_some());
    // The cup appeared in the end, the way of the arms was seen meanwhile.
    assert!(past[0].placed.iter().all(|p| p.node != node("CUP-1").id));
    assert!(
        past.iter()
            .any(|m| m.paths.iter().any(|p| p.what == "left"))
    );

    let news = history.news();
    let ended = news.iter().filter(|n| match &n.1 {
        WatchEvent::Task(news) => news.state == TaskState::Succeeded,
        _ => false,
    });
    assert!(ended.count() >= 5);
    // Who starts a task is told before it.
    let mut told = Vec::new();
    for task in news.iter().filter_map(|n| match &n.1 {
        WatchEvent::Task(task) => Some(task),
        _ => None,
    }) {
        assert!(
            task.parent.is_none_or(|parent| told.contains(&parent)),
            "{task:?}"
        );
        told.push(task.id);
    }
    let line = WatchEvent::Output("[(TEST) INFO] 0.000: Here \"we\" go\n".to_owned());
    assert!(news.iter().any(|n| n.1 == line), "{news:?}");
    // A warning of several lines is one message, and what is printed after it another one.
    for text in ["[(TEST) WARN] 0.000: one\ntwo\n", "three\n"] {
        let told = WatchEvent::Output(text.to_owned());
        assert!(news.iter().any(|n| n.1 == told), "{text}: {news:?}");
    }
}

#[test]
fn the_same_session_writes_the_same_bytes() {
    assert!(recorded("one").0 == recorded("two").0);
}

#[test]
fn a_file_that_is_cut_off_is_shown_as_far_as_it_goes() {
    let (bytes, _) = recorded("cut");
    let (whole, _) = read(&bytes);
    let (part, _) = read(&bytes[..bytes.len() * 9 / 10]);
    let (whole, part) = (whole.unwrap(), part.unwrap());
    assert!(part.is_cut_off && part.frames > 0 && part.frames < whole.frames);
    let told = read(&bytes[..bytes.len() / 3]).0.unwrap_err().to_string();
    assert_eq!(told, "it is cut off before the end of its first second");
}

#[test]
fn what_is_no_recording_is_refused() {
    let (bytes, _) = recorded("garbage");
    for garbage in [&b""[..], b"hello", &bytes[1..], &bytes[..50]] {
        assert!(read(garbage).0.is_err());
    }
    // Damage anywhere ends in an error or in less, never otherwise.
    for at in (0..bytes.len()).step_by(bytes.len() / 60) {
        let mut damaged = bytes.clone();
        damaged[at] ^= 0x55;
        let _ = read(&damaged);
    }
}

#[test]
fn a_file_that_cannot_be_written_is_told() {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let path = crate::tests::scratch_folder().join("none/run.mcap");
    let error = session.begin_recording(&path).unwrap_err().to_string();
    assert!(
        error.contains("run.mcap") && error.contains("cannot record"),
        "{error}"
    );
}

#[test]
fn a_full_disk_is_called_so() {
    let full = std::path::Path::new("/dev/full");
    if !full.exists() {
        return;
    }
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let told = session.begin_recording(full).unwrap_err().to_string();
    assert_eq!(told, "cannot record into /dev/full: the disk is full");
}

/// The recording with its chunks compressed otherwise, as other tools rewrite it.
pub(super) fn compressed(bytes: &[u8], name: &str, compress: impl Fn(&[u8]) -> Vec<u8>) -> Vec<u8> {
    const CHUNK: u8 = 6;
    let number = |at: usize| {
        let bytes = bytes[at..at + 8].try_into().unwrap();
        usize::try_from(u64::from_le_bytes(bytes)).unwrap()
    };
    let mut to = bytes[..8].to_vec();
    let mut at = 8;
    let mut chunks = 0;
    while at + 9 <= bytes.len() {
        let (opcode, begin) = (bytes[at], at + 9);
        let end = begin + number(at + 1);
        if end > bytes.len() {
            break;
        }
        if opcode == CHUNK {
            chunks += 1;
            // Times, size and checksum, then the name, and the length of the content.
            assert_eq!(&bytes[begin + 28 + 4..begin + 28 + 4 + 3], b"lz4");
            let mut plain = Vec::new();
            let packed = &bytes[begin + 28 + 4 + 3 + 8..end];
            let mut decoder = lz4_flex::frame::FrameDecoder::new(packed);
            std::io::Read::read_to_end(&mut decoder, &mut plain).unwrap();
            let content = compress(&plain);
            let length = 28 + 4 + name.len() + 8 + content.len();
            to.push(CHUNK);
            to.extend((length as u64).to_le_bytes());
            to.extend(&bytes[begin..begin + 28]);
            to.extend(u32::try_from(name.len()).unwrap().to_le_bytes());
            to.extend(name.as_bytes());
            to.extend((content.len() as u64).to_le_bytes());
            to.extend(content);
        } else {
            to.extend(&bytes[at..end]);
        }
        at = end;
    }
    assert!(chunks > 0);
    to.extend(&bytes[at..]);
    to
}

fn lz4(content: &[u8]) -> Vec<u8> {
    let mut encoder = lz4_flex::frame::FrameEncoder::new(Vec::new());
    std::io::Write::write_all(&mut encoder, content).unwrap();
    encoder.finish().unwrap()
}

fn zstd(content: &[u8]) -> Vec<u8> {
    use ruzstd::encoding::{CompressionLevel, compress_to_vec};
    compress_to_vec(content, CompressionLevel::Fastest)
}

#[test]
fn what_other_tools_have_compressed_is_read() {
    let (bytes, _) = recorded("compressed");
    let (plain, plain_history) = read(&compressed(&bytes, "", <[u8]>::to_vec));
    let plain = plain.unwrap();
    for packed in [
        compressed(&bytes, "lz4", lz4),
        compressed(&bytes, "zstd", zstd),
    ] {
        let (found, history) = read(&packed);
        assert_eq!(found.unwrap(), plain);
        let past = |history: &History| format!("{:?}", history.past(0.0, 100.0, 10_000));
        assert!(past(&history) == past(&plain_history));

        let (cut, _) = read(&packed[..packed.len() * 7 / 10]);
        assert!(cut.map_or(true, |cut| cut.is_cut_off));
        for at in (0..packed.len()).step_by(packed.len() / 60) {
            let mut damaged = packed.clone();
            damaged[at] ^= 0x55;
            let _ = read(&damaged);
        }
    }
    let unknown = compressed(&bytes, "snappy", <[u8]>::to_vec);
    let told = read(&unknown).0.unwrap_err().to_string();
    assert_eq!(
        told,
        "a chunk is compressed with snappy: only lz4 and zstd can be read"
    );
}

/// The rows of a relation of an episode.
pub(super) fn rows<'e>(episode: &'e Episode, name: &str) -> &'e view::watch::recording::Rows {
    let mut relations = episode.relations.iter();
    &relations.find(|(known, _)| *known == name).unwrap().1
}

#[test]
fn relations_do_not_depend_on_how_chunks_are_compressed() {
    let (bytes, _) = recorded("relations");
    let whole = read_episode(&bytes[..], Wanted::ALL).unwrap();
    assert!(!whole.is_cut_off && !rows(&whole, "task").rows.is_empty());
    for packed in [
        compressed(&bytes, "", <[u8]>::to_vec),
        compressed(&bytes, "lz4", lz4),
        compressed(&bytes, "zstd", zstd),
    ] {
        let found = read_episode(&packed[..], Wanted::ALL).unwrap();
        assert_eq!(found.relations, whole.relations);
        assert!(!found.is_cut_off);
    }
    let unknown = compressed(&bytes, "snappy", <[u8]>::to_vec);
    assert!(read_episode(&unknown[..], Wanted::ALL).is_err());
}

#[test]
fn chunks_that_hold_nothing_wanted_stay_packed() {
    const CHUNK: u8 = 6;
    let (bytes, _) = recorded("skipped");
    let whole = read_episode(&bytes[..], Wanted::ALL).unwrap();
    let tasks = Wanted::of(|name| name == "task");
    let (mut at, mut chunks, mut skipped) = (8, 0, 0);
    while at + 9 <= bytes.len() {
        let length = u64::from_le_bytes(bytes[at + 1..at + 9].try_into().unwrap());
        let end = at + 9 + usize::try_from(length).unwrap();
        if bytes[at] == CHUNK {
            chunks += 1;
            let mut damaged = bytes.clone();
            damaged[end - 20] ^= 0x55;
            // Damage is not seen where it is not read.
            if let Ok(found) = read_episode(&damaged[..], tasks)
                && !found.is_cut_off
            {
                skipped += 1;
                assert_eq!(rows(&found, "task"), rows(&whole, "task"));
            }
        }
        at = end;
    }
    assert!(0 < skipped && skipped < chunks, "{skipped} of {chunks}");
}

#[test]
fn a_chunk_whose_index_is_cut_off_is_read() {
    const CHUNK: u8 = 6;
    let (bytes, _) = recorded("half-indexed");
    let tasks = Wanted::of(|name| name == "task");
    let (mut at, mut before, mut most) = (8, 0, 0);
    let read = |end: usize| {
        let found = read_episode(&bytes[..end], tasks);
        found.map_or(0, |found| rows(&found, "task").rows.len())
    };
    while at + 9 <= bytes.len() {
        let length = u64::from_le_bytes(bytes[at + 1..at + 9].try_into().unwrap());
        let end = at + 9 + usize::try_from(length).unwrap();
        // The tasks of a chunk are known from its end on, whatever is there of its index.
        let known = read(end);
        match bytes[at] {
            CHUNK => before = known,
            _ => assert_eq!(known, before, "byte {at}"),
        }
        most = most.max(known);
        at = end;
    }
    assert!(most > 2);
}

#[test]
fn a_chunk_that_unpacks_to_more_than_it_says_is_refused() {
    let (bytes, _) = recorded("bomb");
    let bomb = compressed(&bytes, "zstd", |content| {
        zstd(&vec![0; content.len() + (64 << 20)])
    });
    let told = read(&bomb).0.unwrap_err().to_string();
    assert!(told.starts_with("a chunk has "), "{told}");
}

#[test]
fn damage_that_the_reader_of_the_format_does_not_expect_is_an_error() {
    let (bytes, _) = recorded("panic");
    let mut bytes = compressed(&bytes, "", <[u8]>::to_vec);
    let mut at = 8;
    while bytes[at] != 6 {
        let length = u64::from_le_bytes(bytes[at + 1..at + 9].try_into().unwrap());
        at += 9 + usize::try_from(length).unwrap();
    }
    // The first record of the chunk says that it is longer than any number.
    let first = at + 9 + 28 + 4 + 8;
    bytes[first + 1..first + 9].fill(0xff);
    let told = read(&bytes).0.unwrap_err().to_string();
    assert!(told.starts_with("the file is damaged in a way"), "{told}");
}

/// A recording as earlier versions wrote it: JSON, everything in the map, all of it in every frame.
fn of_earlier_version() -> Vec<u8> {
    let mut to = std::io::Cursor::new(Vec::new());
    let options = mcap::WriteOptions::new().compression(None);
    let mut writer = options.create(&mut to).unwrap();
    let time = serde_json::json!({"sec": 0, "nsec": 0});
    let transform = |child: &str, x: f64| {
        serde_json::json!({
            "timestamp": time, "parent_frame_id": "map", "child_frame_id": child,
            "translation": {"x": x, "y": 0.0, "z": 1.0},
            "rotation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0},
        })
    };
    let entity = |id: &str, frame: &str, kind: &str, name: &str| {
        let pose = serde_json::json!({
            "position": {"x": 0.0, "y": 0.0, "z": 0.0},
            "orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0},
        });
        let point = |x: f64, y: f64| serde_json::json!({"x": x, "y": y, "z": 0.0});
        let red = serde_json::json!({"r": 1.0, "g": 0.0, "b": 0.0, "a": 1.0});
        serde_json::json!({
            "timestamp": time, "frame_id": frame, "id": id, "lifetime": time, "frame_locked": true,
            "metadata": [{"key": "name", "value": name}, {"key": "kind", "value": kind},
                         {"key": "type", "value": "cup"}],
            "arrows": [], "cubes": [], "spheres": [], "cylinders": [], "lines": [], "texts": [],
            "models": [],
            "triangles": [{
                "pose": pose, "points": [point(0.0, 0.0), point(1.0, 0.0), point(0.0, 1.0)],
                "color": red, "colors": [red, red, red], "indices": [0, 1, 2],
            }],
        })
    };
    let scene =
        |entity: serde_json::Value| serde_json::json!({"deletions": [], "entities": [entity]});
    let messages = [
        (
            "/scene/robot_and_kitchen",
            scene(entity("0", "base_link", "robot", "base_link")),
        ),
        (
            "/scene/objects",
            scene(entity("1", "object/CUP-1", "object", "CUP-1")),
        ),
        (
            "/shown",
            serde_json::json!({
                "timestamp": time, "held": [], "touching": [["base_link", "object/CUP-1"]],
                "stops": [], "axes": [], "paths": [],
            }),
        ),
        (
            "/joint_states",
            serde_json::json!({
                "timestamp": time, "joints": [{"name": "knee", "position": 0.5}],
            }),
        ),
        (
            "/tf",
            serde_json::json!({
                "transforms": [transform("base_link", 2.0), transform("object/CUP-1", 3.0)],
            }),
        ),
        (
            "/tasks",
            serde_json::json!({
                "timestamp": time, "id": "t1", "parent": "", "name": "plan", "state": "running",
                "failure": "",
            }),
        ),
    ];
    for (topic, message) in messages {
        let schema = writer.add_schema(topic, "jsonschema", b"{}").unwrap();
        let channel = writer.add_channel(schema, topic, "json", &Default::default());
        let header = mcap::records::MessageHeader {
            channel_id: channel.unwrap(),
            sequence: 0,
            log_time: 0,
            publish_time: 0,
        };
        let data = serde_json::to_vec(&message).unwrap();
        writer.write_to_known_channel(&header, &data).unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    to.into_inner()
}

#[test]
fn recordings_of_earlier_versions_are_shown() {
    let (found, history) = read(&of_earlier_version());
    let found = found.unwrap();
    assert_eq!((found.frames, found.news), (1, 1));
    let frame = &history.past(0.0, 1.0, 9)[0];
    let places: Vec<f32> = frame.placed.iter().map(|p| p.at[0]).collect();
    assert_eq!(places, [2.0, 3.0]);
    let press = Press {
        body: Some(0),
        object: 1,
        at: [0.0; 3],
        force: [0.0; 3],
    };
    assert_eq!(frame.presses, [press]);
    assert_eq!(&*frame.joints, [0.5]);
}

#[test]
fn what_carries_what_is_recorded_with_parameters_and_joints() {
    let (bytes, _) = recorded("carried");
    let (_, history) = read(&bytes);
    let nodes = history.nodes_from(0);
    let node = |name: &str| nodes.iter().find(|n| n.name == name).unwrap();
    let carrier = node("r_gripper_palm_link").parent.unwrap();
    assert_eq!(nodes[carrier as usize].name, "r_wrist_roll_link");
    assert_eq!(node("BOTTLE-1").parent, None);
    let past = history.past(0.0, 100.0, 10_000);
    // The torso, which is lifted, is among the joints.
    assert!(
        past.last()
            .unwrap()
            .joints
            .iter()
            .any(|q| (q - 0.3).abs() < 1e-3)
    );
    let news = history.news();
    let about = news.iter().find_map(|news| match &news.1 {
        WatchEvent::Task(task) if task.name == "moving-torso" => task.about.clone(),
        _ => None,
    });
    let about = about.unwrap();
    assert_eq!(about.keys, [("joint-angle".to_owned(), "0.3".to_owned())]);
    assert_eq!(about.place, "test:9:9");
}
