//! Nothing is found in what is right: all plans and systems that come with the program, the sessions of
//! the documents, and what the transcripts evaluate without an error.

use std::fs;
use std::path::{Path, PathBuf};

use super::{found_in, fresh};
use crate::Session;
use crate::dialogue::prompt_line::prompt_line;
use crate::dialogue::{Evaluate, is_whole};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The files of a folder whose names end so, in order.
fn files(folder: &str, end: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join(folder)).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let mut paths: Vec<PathBuf> = paths
        .filter(|path| path.to_string_lossy().ends_with(end))
        .collect();
    paths.sort();
    paths
}

/// The inputs of a text with prompts that end without an error.
fn inputs(text: &str, is_markdown: bool) -> Vec<String> {
    let mut is_session = !is_markdown;
    let lines: Vec<&str> = text
        .lines()
        .filter(|line| {
            if is_markdown && line.starts_with("```") {
                is_session = *line == "```session";
            }
            is_session
        })
        .collect();
    let mut all = Vec::new();
    let mut at = 0;
    while at < lines.len() {
        let Some(prompt) = prompt_line(lines[at]) else {
            at += 1;
            continue;
        };
        let is_stopped = !prompt.state.is_empty();
        let mut input = prompt.input.to_owned();
        at += 1;
        while !is_whole(&input) && at < lines.len() {
            input.push('\n');
            input.push_str(lines[at]);
            at += 1;
        }
        let output = lines[at..]
            .iter()
            .take_while(|line| prompt_line(line).is_none());
        let fails = output
            .clone()
            .any(|line| line.starts_with("; Evaluation aborted") || line.starts_with(" 0: "));
        if !fails && !is_stopped && input.starts_with('(') {
            all.push(input);
        }
    }
    all
}

/// A session in which the systems are loaded whose packages the documents use.
fn with_demos() -> Session {
    let mut session = fresh();
    let load = "(ros-load:load-system \"cram_pr2_pick_place_demo\") \
                (ros-load:load-system \"cram_projection_demos\")";
    session.evaluate("demos", load, &mut |_| {});
    session
}

fn name_of(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

#[test]
fn plans_have_no_mistakes() {
    let folders = ["lib", "tutorial", "demos", "exercises", "sweeps"];
    let paths = folders.map(|folder| files(&format!("plans/{folder}"), ".plan"));
    let mut wrong = Vec::new();
    for path in paths.concat() {
        let text = fs::read_to_string(&path).unwrap();
        let name = name_of(&path);
        let mut found = found_in(&mut with_demos(), &name, &text);
        // The library defines what is locked afterwards.
        found.retain(|finding| !finding.contains("belongs to the locked package"));
        wrong.extend(found.into_iter().map(|finding| format!("{name}:{finding}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_documents_and_transcripts_evaluate_has_no_mistakes() {
    let documents = files("docs", ".md").into_iter();
    let transcripts = files("tests/transcripts", ".transcript").into_iter();
    let readme = [root().join("README.md")];
    let (mut wrong, mut count) = (Vec::new(), 0);
    for path in documents.chain(transcripts).chain(readme) {
        let name = name_of(&path);
        let text = fs::read_to_string(&path).unwrap();
        let mut session = with_demos();
        for input in inputs(&text, name.ends_with(".md")) {
            count += 1;
            if input.starts_with("(lesson ") {
                session.evaluate("lesson", &input, &mut |_| {});
            }
            for finding in found_in(&mut session, &name, &input) {
                let is_meant = MEANT.contains(&(name.as_str(), finding.as_str()));
                // Files that are loaded define what later inputs use.
                let is_from_file = text.contains("(load \"")
                    && (finding.contains("is not defined") || finding.contains("is unbound"));
                if !is_meant && !is_from_file {
                    wrong.push(format!("{name}:{finding}\n{input}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 700, "only {count} inputs were found");
}

/// What files show on purpose, and what is found there.
const MEANT: &[(&str, &str)] = &[
    (
        "ask.md",
        "2:16: There is no Prolog functor SUPORTED-BY; did you mean SUPPORTED-BY?",
    ),
    (
        "ask.md",
        "2:70: The variable ?DISTANCE is not bound here: in the goal (NEAR …), argument 4 must be given.",
    ),
    (
        "packages-more.transcript",
        "1:1: The name \"made\" does not designate any package.",
    ),
    (
        "packages-more.transcript",
        "1:10: Package made does not exist.",
    ),
    (
        "packages-more.transcript",
        "1:2: The function DOUBLED is not defined.",
    ),
    ("reported.transcript", "1:55: There is no type NOPE."),
];
