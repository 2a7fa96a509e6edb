//! The relations at the end of a recording are those of its messages, or are not believed.

use std::io::Cursor;

use view::watch::recording::{Episode, RecordingError, Wanted, read_episode, read_episode_of_file};

use super::recording::{compressed, recorded, rows};

const RELATIONS: [&str; 8] = [
    "task", "param", "failure", "event", "contact", "log", "object", "robot",
];

fn of_end(bytes: &[u8], wanted: Wanted) -> Result<Episode, RecordingError> {
    read_episode_of_file(Cursor::new(bytes), wanted)
}

/// Where the records of a kind are: begin and end.
fn places(bytes: &[u8], kind: u8) -> Vec<(usize, usize)> {
    let (mut at, mut found) = (8, Vec::new());
    while at + 9 <= bytes.len() {
        let length = u64::from_le_bytes(bytes[at + 1..at + 9].try_into().unwrap());
        let Some(end) = usize::try_from(length)
            .ok()
            .and_then(|n| n.checked_add(at + 9))
        else {
            break;
        };
        if bytes[at] == kind {
            found.push((at, end));
        }
        at = end;
    }
    found
}

const CHUNK: u8 = 6;
const ATTACHMENT: u8 = 9;

#[test]
fn the_end_says_what_the_messages_say() {
    let (bytes, _) = recorded("ends");
    let wanted = RELATIONS.map(|relation| Wanted::of(|name| name == relation));
    for wanted in wanted.into_iter().chain([Wanted::ALL]) {
        let (end, messages) = (of_end(&bytes, wanted), read_episode(&bytes[..], wanted));
        let (end, messages) = (end.unwrap(), messages.unwrap());
        let filled = |episode: Episode| {
            let mut relations = episode.relations;
            relations.retain(|(_, rows)| !rows.rows.is_empty());
            relations
        };
        assert!(!end.is_cut_off && !messages.is_cut_off);
        assert_eq!(filled(end), filled(messages), "{wanted:?}");
    }
    for relation in ["task", "param", "contact", "log", "object", "robot"] {
        let all = of_end(&bytes, Wanted::ALL).unwrap();
        assert!(!rows(&all, relation).rows.is_empty(), "{relation}");
    }
}

#[test]
fn questions_do_not_read_the_messages() {
    let (mut bytes, _) = recorded("unread");
    let whole = of_end(&bytes, Wanted::ALL).unwrap();
    for (begin, end) in places(&bytes.clone(), CHUNK) {
        bytes[begin + 9..end].fill(0);
    }
    let found = of_end(&bytes, Wanted::ALL).unwrap();
    assert_eq!(found.relations, whole.relations);
    let messages = read_episode(&bytes[..], Wanted::ALL);
    assert!(messages.is_err() || rows(&messages.unwrap(), "task").rows.is_empty());
}

#[test]
fn a_damaged_end_is_not_believed() {
    let (bytes, _) = recorded("damaged-end");
    let whole = read_episode(&bytes[..], Wanted::ALL).unwrap();
    let [(begin, end)] = places(&bytes, ATTACHMENT)[..] else {
        panic!("one attachment is expected");
    };
    let inside = (begin..end).step_by((end - begin) / 100);
    let after = (end..bytes.len()).step_by(7);
    for at in inside.chain(after) {
        for change in [0x01, 0x80, 0xff] {
            let mut damaged = bytes.clone();
            damaged[at] ^= change;
            let found = of_end(&damaged, Wanted::ALL).unwrap();
            assert_eq!(found.relations, whole.relations, "byte {at}");
        }
    }
    for length in (end - 20..bytes.len()).step_by(5) {
        let found = of_end(&bytes[..length], Wanted::ALL).unwrap();
        assert_eq!(found.relations, whole.relations, "{length} bytes");
    }
}

#[test]
fn the_end_is_not_believed_where_other_messages_are_in_front() {
    let (bytes, _) = recorded("copied");
    let plain = compressed(&bytes, "", <[u8]>::to_vec);
    // The attachment is elsewhere now, and where it says in the file of which that is a copy.
    assert_eq!(
        of_end(&plain, Wanted::ALL).unwrap().relations,
        read_episode(&bytes[..], Wanted::ALL).unwrap().relations
    );

    // Another tool copies a recording without its log, and what is attached to it.
    let mut copy = Cursor::new(Vec::new());
    let options = mcap::WriteOptions::new().compression(None);
    let mut writer = options.create(&mut copy).unwrap();
    for message in mcap::MessageStream::new(&plain).unwrap() {
        let message = message.unwrap();
        if message.channel.topic != "/log" {
            writer.write(&message).unwrap();
        }
    }
    let [(begin, end)] = places(&bytes, ATTACHMENT)[..] else {
        panic!("one attachment is expected");
    };
    let record = &bytes[begin + 9..end];
    let attachment = mcap::Attachment {
        log_time: 1,
        create_time: 1,
        name: "planwright/episode".to_owned(),
        media_type: String::new(),
        data: data_of(record).into(),
    };
    writer.attach(&attachment).unwrap();
    writer.finish().unwrap();
    drop(writer);
    let copy = copy.into_inner();
    assert_eq!(places(&copy, ATTACHMENT).len(), 1);
    let found = of_end(&copy, Wanted::ALL).unwrap();
    assert!(rows(&found, "log").rows.is_empty());
    assert!(!rows(&found, "task").rows.is_empty());
}

/// The data of an attachment: what follows two times, two texts and its length, up to a checksum.
fn data_of(record: &[u8]) -> &[u8] {
    let mut at = 16;
    for _ in 0..2 {
        let length = u32::from_le_bytes(record[at..at + 4].try_into().unwrap());
        at += 4 + usize::try_from(length).unwrap();
    }
    &record[at + 8..record.len() - 4]
}
