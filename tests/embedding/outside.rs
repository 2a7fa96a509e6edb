//! A program that gives a session files and a clock of its own: nothing of the machine's is used.

use std::collections::BTreeMap;
use std::io::{Cursor, Error, ErrorKind, Result, Seek, SeekFrom, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use planwright::files::{Contents, FileFacts, Files, Opening, Output};
use planwright::{Clock, Datum, Evaluate, Outside, Session, SessionOptions};

type Texts = Arc<Mutex<BTreeMap<String, Vec<u8>>>>;

/// Files in memory.
#[derive(Clone, Debug, Default)]
struct Memory(Texts);

/// A file in memory that is written.
struct Open {
    name: String,
    bytes: Cursor<Vec<u8>>,
    texts: Texts,
}

impl Write for Open {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        let count = self.bytes.write(bytes)?;
        let all = self.bytes.get_ref().clone();
        self.texts.lock().unwrap().insert(self.name.clone(), all);
        Ok(count)
    }

    fn flush(&mut self) -> Result<()> {
        Ok(())
    }
}

impl Seek for Open {
    fn seek(&mut self, to: SeekFrom) -> Result<u64> {
        self.bytes.seek(to)
    }
}

impl Memory {
    fn text(&self, name: &str) -> Option<String> {
        let bytes = self.0.lock().unwrap().get(name).cloned();
        bytes.map(|bytes| String::from_utf8(bytes).unwrap())
    }
}

fn missing<T>() -> Result<T> {
    Err(Error::from(ErrorKind::NotFound))
}

impl Files for Memory {
    fn facts(&self, name: &str) -> Result<FileFacts> {
        let Some(bytes) = self.0.lock().unwrap().get(name).cloned() else {
            return missing();
        };
        Ok(FileFacts {
            is_folder: false,
            length: bytes.len() as u64,
            modified: None,
        })
    }

    fn read(&self, name: &str) -> Result<Vec<u8>> {
        self.0
            .lock()
            .unwrap()
            .get(name)
            .cloned()
            .map_or_else(missing, Ok)
    }

    fn open(&self, name: &str, opening: Opening) -> Result<Box<dyn Output>> {
        let mut texts = self.0.lock().unwrap();
        if !opening.creates && !texts.contains_key(name) {
            return missing();
        }
        let bytes = texts.entry(name.to_owned()).or_default();
        if opening.contents == Contents::Drop {
            bytes.clear();
        }
        let mut cursor = Cursor::new(bytes.clone());
        if opening.contents == Contents::Append {
            cursor.seek(SeekFrom::End(0))?;
        }
        Ok(Box::new(Open {
            name: name.to_owned(),
            bytes: cursor,
            texts: Arc::clone(&self.0),
        }))
    }

    fn true_name(&self, name: &str) -> Result<String> {
        self.facts(name).map(|_| format!("/memory/{name}"))
    }

    fn names(&self, _: &str) -> Result<Vec<String>> {
        Ok(self.0.lock().unwrap().keys().cloned().collect())
    }

    fn remove(&self, name: &str) -> Result<()> {
        self.0
            .lock()
            .unwrap()
            .remove(name)
            .map_or_else(missing, |_| Ok(()))
    }

    fn rename(&self, old: &str, new: &str) -> Result<()> {
        let mut texts = self.0.lock().unwrap();
        let Some(bytes) = texts.remove(old) else {
            return missing();
        };
        texts.insert(new.to_owned(), bytes);
        Ok(())
    }

    fn create_folders(&self, _: &str) -> Result<()> {
        Ok(())
    }
}

/// A clock on which a second passes whenever it is looked at.
#[derive(Debug, Default)]
struct Ticking(AtomicU64);

impl Clock for Ticking {
    fn now(&self) -> Duration {
        Duration::from_secs(self.0.fetch_add(1, Ordering::Relaxed))
    }

    fn wait(&self, _: Duration) {}
}

fn session(files: &Memory) -> Session {
    let options = SessionOptions {
        outside: Outside {
            files: Arc::new(files.clone()),
            clock: Arc::new(Ticking::default()),
            breathe: None,
        },
        ..SessionOptions::default()
    };
    Session::new(&options).unwrap()
}

#[test]
fn a_session_uses_the_files_that_it_is_given() {
    let files = Memory::default();
    files.0.lock().unwrap().insert(
        "deep/first.plan".to_owned(),
        b"(defun twice (x) (* 2 x)) (load \"second.plan\")".to_vec(),
    );
    files.0.lock().unwrap().insert(
        "deep/second.plan".to_owned(),
        b"(defparameter *told* (twice 21))".to_vec(),
    );
    let mut session = session(&files);
    session.run_file("deep/first.plan").unwrap();
    assert_eq!(session.get("*told*").unwrap(), Datum::from(42));
    let writes = "(with-open-file (out \"new.txt\" :direction :output)
                    (write-string \"one\" out) (file-length out))";
    assert_eq!(session.run("writes", writes).unwrap(), [Datum::from(3)]);
    let appends = "(with-open-file (out \"new.txt\" :direction :output :if-exists :append)
                     (write-string \" two\" out) (list (file-position out) (file-length out)))";
    let both = Datum::list([Datum::from(7), Datum::from(7)]);
    assert_eq!(session.run("appends", appends).unwrap(), [both]);
    assert_eq!(files.text("new.txt").as_deref(), Some("one two"));
    let overwrites = "(with-open-file (out \"new.txt\" :direction :io :if-exists :overwrite)
                        (write-string \"ONE\" out))";
    session.run("overwrites", overwrites).unwrap();
    assert_eq!(files.text("new.txt").as_deref(), Some("ONE two"));
    session
        .run("renames", "(rename-file \"new.txt\" \"old.txt\")")
        .unwrap();
    assert_eq!(
        (files.text("new.txt"), files.text("old.txt").is_some()),
        (None, true)
    );
    session
        .run(
            "draws",
            "(save-view \"world.html\") (map-picture \"map.png\")",
        )
        .unwrap();
    assert!(
        files
            .text("world.html")
            .is_some_and(|page| page.contains("<html"))
    );
    assert!(
        files
            .0
            .lock()
            .unwrap()
            .get("map.png")
            .is_some_and(|png| png.starts_with(b"\x89PNG"))
    );
    let found = session
        .run("misses", "(load \"deep/scond.plan\")")
        .unwrap_err();
    assert!(found.to_string().contains("deep/scond.plan"), "{found}");
    for name in ["new.txt", "old.txt", "world.html", "map.png", "deep"] {
        assert!(!std::path::Path::new(name).exists(), "{name}");
    }
}

#[test]
fn a_session_measures_with_the_clock_that_it_is_given() {
    let mut session = session(&Memory::default());
    let mut printed = String::new();
    session.evaluate("test", "(time (sleep 2))", &mut |event| {
        if let planwright::Event::Output(text) = event {
            printed.push_str(&text);
        }
    });
    assert!(
        printed.contains("; 2.000 s simulated, 1.000 s real"),
        "{printed}"
    );
}

#[test]
fn a_session_that_is_closed_refuses_and_goes_on() {
    let files = Memory::default();
    let mut session = session(&files);
    session.close();
    for form in [
        "(open \"a\" :direction :output)",
        "(btr-utils:kill-all-objects)",
        "(map-picture \"map.png\")",
    ] {
        let failure = session.run("closed", form).unwrap_err().to_string();
        let says_so = failure.contains("closed") || failure.contains("has no files");
        assert!(says_so, "{form}: {failure}");
    }
    assert_eq!(session.run("closed", "(+ 1 2)").unwrap(), [Datum::from(3)]);
    assert!(files.0.lock().unwrap().is_empty());
}
