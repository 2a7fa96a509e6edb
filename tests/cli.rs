//! The command line from outside: what goes to which stream, and the exit statuses.

use std::io::{Read, Write};
use std::process::{Command, Output, Stdio};

fn planwright(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_planwright"));
    command
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

fn output(arguments: &[&str]) -> (Option<i32>, String, String) {
    told(planwright(arguments).output().unwrap())
}

fn told(output: Output) -> (Option<i32>, String, String) {
    (
        output.status.code(),
        String::from_utf8(output.stdout).unwrap(),
        String::from_utf8(output.stderr).unwrap(),
    )
}

#[test]
fn version_is_that_of_the_package() {
    let version = concat!("planwright ", env!("CARGO_PKG_VERSION"), "\n");
    assert_eq!(
        output(&["--version"]),
        (Some(0), version.to_owned(), String::new())
    );
}

#[test]
fn wrong_usage_exits_with_2() {
    for arguments in [
        &["run"][..],
        &["replay"],
        &["check"],
        &["juggle"],
        &["--realtime=0"],
        &["view"],
        &["replay", "--view", "x"],
        &["completions", "abacus"],
    ] {
        let (status, out, err) = output(arguments);
        assert_eq!((status, out.as_str()), (Some(2), ""), "{arguments:?}");
        assert!(err.starts_with("error: "), "{err}");
    }
}

#[test]
fn recordings_that_cannot_be_read_or_written_are_told() {
    let (status, _, err) = output(&["view", "Cargo.toml"]);
    assert_eq!(status, Some(2));
    assert!(
        err.starts_with("error: cannot show Cargo.toml: it is no MCAP file"),
        "{err}"
    );
    let (status, _, err) = output(&["view", "no/such.mcap"]);
    assert_eq!(status, Some(2));
    assert!(
        err.starts_with("error: cannot show no/such.mcap: "),
        "{err}"
    );
    let (status, out, err) = output(&["run", "--eval", "1", "--record", "no/such.mcap"]);
    assert_eq!((status, out.as_str()), (Some(2), ""));
    assert!(
        err.starts_with("error: cannot record into no/such.mcap: "),
        "{err}"
    );
}

#[test]
fn a_run_with_the_view_ends_when_nobody_looks() {
    let (status, out, err) = output(&["run", "--eval", "(+ 1 2)", "--view"]);
    assert_eq!((status, out.as_str()), (Some(0), "3\n"));
    assert!(
        err.starts_with("The live view is at http://127.0.0.1:"),
        "{err}"
    );
}

#[test]
fn a_file_that_cannot_be_read_is_named() {
    for command in ["run", "replay", "check"] {
        let (status, out, err) = output(&[command, "no/such.file"]);
        assert_eq!((status, out.as_str()), (Some(2), ""), "{command}");
        assert!(
            err.starts_with("error: cannot read no/such.file: "),
            "{err}"
        );
    }
}

#[test]
fn completions_are_made_for_known_shells() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let (status, out, err) = output(&["completions", shell]);
        assert_eq!((status, err.as_str()), (Some(0), ""), "{shell}");
        assert!(out.contains("replay"), "{shell}");
    }
}

#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let mut child = planwright(&[]).stdin(Stdio::piped()).spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    let mut out = child.stdout.take().unwrap();
    input.write_all(b"1\n").unwrap();
    let mut first = [0; 2];
    out.read_exact(&mut first).unwrap();
    drop(out);
    // The program may be gone before it has read everything.
    let _ = input.write_all("2\n".repeat(100).as_bytes());
    drop(input);
    let (status, _, err) = told(child.wait_with_output().unwrap());
    assert_eq!((&first, status, err.as_str()), (b"1\n", Some(0), ""));
}
