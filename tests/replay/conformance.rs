//! Replays all transcripts of the project and holds the entries that differ against the
//! list of those that are known to.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::thread;

use crate::transcript::{Transcript, Verdict, replay_all};
use session::Session;
use session::dialogue::Repeat;

const KNOWN: &str = "tests/conformance/known-differences.txt";
const FOLDERS: [(&str, &str); 4] = [
    (".", "md"),
    ("tests/conformance", "transcript"),
    ("tests/transcripts", "transcript"),
    ("docs", "md"),
];

/// An entry: `FILE:LINE`, the line being that of its prompt.
type Place = String;

#[test]
fn only_known_entries_differ() {
    let transcripts: Vec<Transcript> = FOLDERS
        .iter()
        .flat_map(|(folder, extension)| transcripts(folder, extension))
        .collect();
    let known = known_differences(&fs::read_to_string(KNOWN).unwrap()).unwrap();
    let differing = differing(&transcripts, open);
    let complaints = complaints(&known, &differing);
    assert!(
        complaints.is_empty(),
        "{}\n{} complaints; {KNOWN} is the list",
        complaints.join("\n"),
        complaints.len()
    );
}

fn open() -> Result<Session, String> {
    crate::command::open_default()
}

/// The transcripts in a folder, by name; a folder that is not there holds none.
fn transcripts(folder: &str, extension: &str) -> Vec<Transcript> {
    let mut names: Vec<String> = fs::read_dir(Path::new(folder))
        .into_iter()
        .flatten()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| Path::new(name).extension().is_some_and(|e| e == extension))
        .collect();
    names.sort();
    names
        .iter()
        .map(|name| {
            let name = format!("{folder}/{name}");
            let text = fs::read_to_string(&name).unwrap();
            Transcript::parse(&name, &text)
        })
        .collect()
}

/// What differs, with the diff.
fn differing<V: Repeat>(
    transcripts: &[Transcript],
    open: impl Fn() -> Result<V, String> + Sync,
) -> BTreeMap<Place, String> {
    let mut differing = BTreeMap::new();
    let jobs = thread::available_parallelism().unwrap();
    replay_all(transcripts, jobs, open, |transcript, verdicts| {
        for verdict in verdicts.unwrap() {
            if let Verdict::Failed(difference) = verdict {
                let place = format!("{}:{}", transcript.name, difference.entry_line);
                let shown = [difference.input.clone()]
                    .into_iter()
                    .chain(difference.unified())
                    .collect::<Vec<_>>()
                    .join("\n");
                differing.insert(place, shown);
            }
        }
        true
    });
    differing
}

/// The places that are listed, each of which needs a reason.
fn known_differences(list: &str) -> Result<BTreeSet<Place>, String> {
    list.lines()
        .filter(|line| !line.trim().is_empty() && !line.starts_with('#'))
        .map(|line| match line.split_once(' ') {
            Some((place, reason)) if !reason.trim().is_empty() => Ok(place.to_owned()),
            _ => Err(format!("no reason is given: {line}")),
        })
        .collect()
}

fn complaints(known: &BTreeSet<Place>, differing: &BTreeMap<Place, String>) -> Vec<String> {
    let unknown = differing
        .iter()
        .filter(|(place, _)| !known.contains(*place))
        .map(|(place, shown)| format!("{place} differs: {shown}"));
    let passing = known
        .iter()
        .filter(|place| !differing.contains_key(*place))
        .map(|place| format!("{place} is listed, but it passes or is not there"));
    unknown.chain(passing).collect()
}

#[test]
fn a_listed_difference_needs_a_reason() {
    assert_eq!(
        known_differences("# list\n\na:1 SBCL's taste\n"),
        Ok(BTreeSet::from(["a:1".to_owned()]))
    );
    assert!(known_differences("a:1\n").is_err());
}

#[test]
fn the_list_and_the_differences_have_to_be_the_same() {
    let known = BTreeSet::from(["a:1".to_owned(), "a:2".to_owned()]);
    let differing = BTreeMap::from([
        ("a:2".to_owned(), String::new()),
        ("a:3".to_owned(), "(f)".to_owned()),
    ]);
    assert_eq!(
        complaints(&known, &differing),
        [
            "a:3 differs: (f)",
            "a:1 is listed, but it passes or is not there"
        ]
    );
}
