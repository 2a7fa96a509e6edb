//! Journals are read as they were written, and nothing destroys them.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use super::opening::{Opened, Wanted, open_in};
use super::reading::{Earlier, Tail};
use super::writing::Journal;
use super::{Beginning, End, JournalError, Loaded, Recorded, folder};

/// A folder that is removed with the value.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let folder =
            std::env::temp_dir().join(format!("planwright-journal-{}-{name}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        Folder(folder)
    }

    fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn read(path: &Path) -> Result<Earlier, JournalError> {
    Earlier::parse(path, &fs::read(path).unwrap())
}

/// What was typed, and what became of it.
fn inputs(earlier: &Earlier) -> Vec<(&str, End)> {
    let inputs = earlier.inputs.iter();
    inputs.map(|input| (&*input.text, input.end)).collect()
}

/// A journal with inputs that have ended.
fn written(path: &Path, texts: &[&str]) -> Journal {
    let mut journal = Journal::create(path, &Beginning::default(), &[]).unwrap();
    for (at, text) in texts.iter().enumerate() {
        journal.begun(text, true).unwrap();
        journal
            .ended(None, Some(at as u64), None, Vec::new())
            .unwrap();
    }
    journal
}

impl Folder {
    fn open(&self, wanted: Wanted<'_>) -> Result<Opened, JournalError> {
        open_in(Some(&self.0), wanted, &Beginning::default())
    }

    fn resumed(&self, path: &Path) -> Opened {
        self.open(Wanted::Of(path)).unwrap()
    }
}

#[test]
fn what_is_written_is_read_again() {
    let folder = Folder::new("round-trip");
    let path = folder.file("a.journal");
    let beginning = Beginning {
        seed: 7,
        world: Some("/a b\\n.urdf".into()),
        world_description: Some("/a b.sexp".into()),
        robot: None,
        robot_description: None,
        objects: Some("/things.sexp".into()),
        noise: Some("position=0.01".to_owned()),
        is_faithful: true,
        package_path: vec!["/packages a".into()],
        systems: vec!["/lisp a".into(), "/lisp b".into()],
        setup: vec!["/a b.plan".into()],
        is_closed: true,
        digests: vec![Loaded::of("/a b.plan", "(a)")],
    };
    let loaded = vec![Loaded::of("/c \\d.plan", "")];
    let mut journal = Journal::create(&path, &beginning, &[]).unwrap();
    journal.begun("(a\n \"\\n\")\r", true).unwrap();
    let ending = Some("stopped TYPE-ERROR");
    journal
        .ended(Some(12), Some(0xab), ending, loaded.clone())
        .unwrap();
    journal.begun("(b)", false).unwrap();
    drop(journal);
    let mut journal = folder.resumed(&path).journal.unwrap();
    let earlier = read(&path).unwrap();
    assert_eq!(earlier.inputs[0].loaded, loaded);
    journal.skipped(2).unwrap();
    journal.again(1).unwrap();
    drop(journal);
    let earlier = read(&path).unwrap();
    assert_eq!(earlier.beginning, beginning);
    let recorded = |text: &str, interrupted_at, stops, end| Recorded {
        text: text.to_owned(),
        interrupted_at,
        stops,
        end,
        ending: interrupted_at.and(ending).map(str::to_owned),
        loaded: Vec::new(),
    };
    assert_eq!(
        earlier.inputs,
        [
            recorded("(a\n \"\\n\")\r", Some(12), true, End::Unknown),
            recorded("(b)", None, false, End::Skipped)
        ]
    );
}

#[test]
fn files_of_a_session_are_found_from_another_directory() {
    let folder = Folder::new("absolute");
    let path = folder.file("a.journal");
    let beginning = Beginning {
        world: Some("kitchen.urdf".into()),
        ..Beginning::default()
    };
    drop(Journal::create(&path, &beginning, &[]).unwrap());
    let world = read(&path).unwrap().beginning.world.unwrap();
    assert_eq!(world, std::path::absolute("kitchen.urdf").unwrap());
}

#[test]
fn a_record_that_was_cut_off_does_not_count_and_is_overwritten() {
    let folder = Folder::new("cut");
    let path = folder.file("a.journal");
    drop(written(&path, &["(a)", "(b)"]));
    let bytes = fs::read(&path).unwrap();
    for length in 0..bytes.len() {
        fs::write(&path, &bytes[..length]).unwrap();
        match read(&path) {
            Ok(earlier) => assert!(!matches!(earlier.tail, Tail::Damaged { .. }), "{length}"),
            Err(error) => assert!(length <= 20, "{length}: {error}"),
        }
    }
    fs::write(&path, &bytes[..bytes.len() - 3]).unwrap();
    let mut journal = folder.resumed(&path).journal.unwrap();
    journal.begun("(c)", true).unwrap();
    drop(journal);
    let earlier = read(&path).unwrap();
    assert_eq!(
        inputs(&earlier),
        [
            ("(a)", End::Ended(Some(0))),
            ("(b)", End::Unknown),
            ("(c)", End::Unknown)
        ]
    );
}

#[test]
fn everything_before_damage_is_salvaged_and_the_line_is_named() {
    let folder = Folder::new("damage");
    let path = folder.file("a.journal");
    drop(written(&path, &["(a)", "(b)", "(c)"]));
    let bytes = fs::read(&path).unwrap();
    let first_line = bytes.iter().position(|byte| *byte == b'\n').unwrap();
    for at in first_line + 1..bytes.len() - 1 {
        for change in [0x01, 0x80] {
            let mut damaged = bytes.clone();
            damaged[at] ^= change;
            let earlier = Earlier::parse(&path, &damaged).unwrap();
            let line = 1 + bytes[..at].iter().filter(|byte| **byte == b'\n').count();
            // A line break that is damaged joins two lines; one that appears splits a line.
            assert!(
                matches!(earlier.tail, Tail::Damaged { line: told } if told == line),
                "{at}: {:?}",
                earlier.tail
            );
            // The first two lines are no inputs; then each has one that begins and one that ends.
            assert_eq!(earlier.inputs.len(), line.saturating_sub(2) / 2, "{at}");
        }
    }
    // A line that is missing is damage, too.
    let text = String::from_utf8(bytes).unwrap();
    let without: Vec<&str> = text
        .split_inclusive('\n')
        .enumerate()
        .filter(|(at, _)| *at != 3)
        .map(|(_, line)| line)
        .collect();
    let earlier = Earlier::parse(&path, without.concat().as_bytes()).unwrap();
    assert!(matches!(earlier.tail, Tail::Damaged { line: 4 }));
    assert_eq!(inputs(&earlier), [("(a)", End::Ended(None))]);
}

#[test]
fn a_journal_without_checksums_is_read_and_its_last_input_is_in_doubt() {
    let old = |text: &str| Earlier::parse(Path::new("j"), text.as_bytes());
    let earlier = old("planwright journal 1\nseed 3\ninput (a)\ninput (b)\n").unwrap();
    assert_eq!(earlier.beginning.seed, 3);
    assert_eq!(
        inputs(&earlier),
        [("(a)", End::Ended(None)), ("(b)", End::Unknown)]
    );
    let earlier = old("planwright journal 1\nseed 0\ninput (a)\ninterrupted 5\n").unwrap();
    assert_eq!(inputs(&earlier), [("(a)", End::Ended(None))]);
    let earlier = old("planwright journal 1\nseed 0\ninput (a)\nrubbish\ninput (b)\n").unwrap();
    assert!(matches!(earlier.tail, Tail::Damaged { line: 4 }));
    assert!(matches!(old("something\n"), Err(JournalError::Format(_))));
    assert!(matches!(
        old("planwright journal 3\n"),
        Err(JournalError::Newer(_))
    ));
}

#[test]
fn a_journal_that_another_session_writes_is_not_written_to() {
    let folder = Folder::new("lock");
    let path = folder.file("a.journal");
    let mut first = written(&path, &["(a)"]);
    let second = folder.resumed(&path);
    assert!(second.remarks[0].contains("belongs to a running session"));
    let copy = second.journal.unwrap();
    assert_eq!(copy.path().parent(), Some(&*folder.0));
    assert!(second.remarks[1].contains(&copy.path().display().to_string()));
    assert_eq!(
        read(copy.path()).unwrap().inputs,
        second.earlier.unwrap().inputs
    );
    first.begun("(b)", true).unwrap();
    let expected = [("(a)", End::Ended(Some(0))), ("(b)", End::Unknown)];
    assert_eq!(inputs(&read(&path).unwrap()), expected);
    drop(first);
    let third = folder.resumed(&path);
    assert_eq!(third.journal.unwrap().path(), path);
}

#[test]
fn nothing_is_overwritten_but_a_journal_without_inputs() {
    let folder = Folder::new("overwrite");
    let fresh = |path: &Path| folder.open(Wanted::In(path));
    let letter = folder.file("letter.txt");
    fs::write(&letter, "Dear reader").unwrap();
    assert!(matches!(fresh(&letter), Err(JournalError::Foreign(_))));
    assert_eq!(fs::read(&letter).unwrap(), b"Dear reader");

    let path = folder.file("a.journal");
    let running = fresh(&path).unwrap();
    assert!(matches!(fresh(&path), Err(JournalError::Exists { .. })));
    drop(running);
    assert!(fresh(&path).unwrap().journal.is_some());
    drop(fs::remove_file(&path));
    drop(written(&path, &["(a)"]));
    let before = fs::read(&path).unwrap();
    assert!(matches!(fresh(&path), Err(JournalError::Exists { .. })));
    assert_eq!(fs::read(&path).unwrap(), before);
}

#[test]
fn it_is_said_that_nothing_is_kept() {
    let folder = Folder::new("unkept");
    let missing = folder.file("missing/a.journal");
    for path in [&missing, &folder.0] {
        let opened = folder.open(Wanted::In(path)).unwrap();
        assert!(opened.journal.is_none());
        assert!(
            opened.remarks[0].starts_with("; Nothing typed here is kept: cannot write to "),
            "{:?}",
            opened.remarks
        );
    }
}

#[test]
fn journals_that_are_new_or_in_use_are_not_removed() {
    let folder = Folder::new("old");
    let files: Vec<PathBuf> = (0..30)
        .map(|n| folder.file(&format!("{n}.journal")))
        .collect();
    let mut kept: Vec<Journal> = files.iter().map(|file| written(file, &["(a)"])).collect();
    let in_use = kept.pop();
    drop(kept);
    // Earlier versions wrote such a file, too.
    let tape = folder.file("0.journal.tape");
    fs::write(&tape, "a tape").unwrap();
    let remaining = || folder::journals(&folder.0).len();
    let now = SystemTime::now();
    folder::forget_old(&folder.0, now);
    assert_eq!(remaining(), 30);
    assert!(tape.exists());
    folder::forget_old(&folder.0, now + Duration::from_secs(30 * 24 * 60 * 60));
    assert_eq!(remaining(), 19);
    assert!(!tape.exists());
    assert!(in_use.is_some() && files[29].exists());

    let inputs = read(&files[29]).unwrap().inputs;
    let journal = folder::begin(&folder.0, &Beginning::default(), &inputs).unwrap();
    assert_eq!(read(journal.path()).unwrap().inputs, inputs);
}

#[test]
fn the_last_session_is_the_newest_that_is_over_and_had_inputs() {
    let folder = Folder::new("last");
    let last = || folder.open(Wanted::Last);
    assert!(matches!(last(), Err(JournalError::None(Some(_)))));
    let running = written(&folder.file("1.journal"), &["(a)"]);
    assert!(matches!(last(), Err(JournalError::Running { .. })));
    let over = folder.file("0.journal");
    drop(written(&over, &["(b)"]));
    drop(written(&folder.file("2.journal"), &[]));
    fs::write(folder.file("3.journal"), "rubbish").unwrap();
    let resumed = last().unwrap();
    assert_eq!(
        resumed.journal.as_ref().map(|j| j.path().to_owned()),
        Some(over)
    );
    assert_eq!(resumed.remarks, [""; 0]);
    assert!(matches!(last(), Err(JournalError::Running { .. })));
    drop(running);
    assert!(last().is_ok());
}

#[test]
fn a_damaged_journal_stays_as_it_is() {
    let folder = Folder::new("damaged");
    let path = folder.file("a.journal");
    drop(written(&path, &["(a)", "(b)"]));
    let mut bytes = fs::read(&path).unwrap();
    let at = bytes.len() - 3;
    bytes[at] ^= 1;
    fs::write(&path, &bytes).unwrap();
    let resumed = folder.resumed(&path);
    let told = format!(
        "; {}, line 6: this record is damaged. What was typed before it, 2 inputs, is resumed",
        path.display()
    );
    assert!(
        resumed.remarks[0].starts_with(&told),
        "{:?}",
        resumed.remarks
    );
    assert!(
        resumed
            .journal
            .is_some_and(|journal| journal.path() != path)
    );
    assert_eq!(fs::read(&path).unwrap(), bytes);
}

#[test]
fn a_journal_that_may_only_be_read_is_continued_in_a_copy() {
    let folder = Folder::new("read-only");
    let path = folder.file("a.journal");
    drop(written(&path, &["(a)"]));
    let mut permissions = fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    let before = fs::read(&path).unwrap();
    // Some users may write to any file.
    let is_privileged = fs::OpenOptions::new().append(true).open(&path).is_ok();
    let resumed = folder.resumed(&path);
    let journal = resumed.journal.unwrap();
    assert_eq!(journal.path() == path, is_privileged);
    if !is_privileged {
        assert!(resumed.remarks[0].ends_with("cannot be written to."));
        assert_eq!(read(journal.path()).unwrap().inputs.len(), 1);
    }
    assert_eq!(fs::read(&path).unwrap(), before);
}
