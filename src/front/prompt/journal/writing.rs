//! Writing a journal.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::record::{Checksum, FIRST_LINE, Record};
use super::{Beginning, End, Loaded, Recorded};

/// A journal that is being written. It is locked until it is dropped.
#[derive(Debug)]
pub(crate) struct Journal {
    /// None if there was no room for it.
    file: Option<File>,
    path: PathBuf,
    checksum: Checksum,
    /// What could not be written yet.
    pending: Vec<u8>,
}

impl Journal {
    /// A new journal in a file that does not exist, or is empty. While the disk is full, it is one
    /// that begins when there is room.
    pub(super) fn create(
        path: &Path,
        beginning: &Beginning,
        inputs: &[Recorded],
    ) -> io::Result<Journal> {
        let file = match opened(path) {
            Err(error) if is_full(&error) => None,
            file => Some(file?),
        };
        let mut journal = Journal {
            file,
            path: path.to_owned(),
            checksum: Checksum::of_first_line(),
            pending: format!("{FIRST_LINE}\n").into_bytes(),
        };
        for record in Record::of_beginning(beginning) {
            journal.add(&record);
        }
        for (index, input) in inputs.iter().enumerate() {
            journal.add_input(index + 1, input);
        }
        match journal.flush().and_then(|()| journal.sync()) {
            Err(error) if is_full(&error) => Ok(journal),
            begun => begun.map(|()| journal),
        }
    }

    /// Whether something could not be written yet.
    pub(crate) fn is_behind(&self) -> bool {
        !self.pending.is_empty()
    }

    fn sync(&self) -> io::Result<()> {
        self.file.as_ref().map_or(Ok(()), File::sync_data)
    }

    /// Continues a journal that is locked by `file` and in order up to byte `length`.
    pub(super) fn go_on(
        file: File,
        path: &Path,
        length: u64,
        checksum: Checksum,
    ) -> io::Result<Journal> {
        // What follows was cut short: it is no record.
        if file.metadata()?.len() > length {
            file.set_len(length)?;
        }
        let mut journal = Journal {
            file: Some(file),
            path: path.to_owned(),
            checksum,
            pending: Vec::new(),
        };
        journal.flush()?;
        Ok(journal)
    }

    /// The file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Records that the evaluation of an input begins; it is on disk when this returns.
    pub(crate) fn begun(&mut self, text: &str, stops: bool) -> io::Result<()> {
        let text = text.to_owned();
        self.add(&Record::Input { text, stops });
        self.flush()?;
        self.sync()
    }

    /// Records that the last input has ended: where it was interrupted, if it was, what it has loaded,
    /// and how it ended.
    pub(crate) fn ended(
        &mut self,
        interrupted_at: Option<u64>,
        hash: Option<u64>,
        ending: Option<&str>,
        loaded: Vec<Loaded>,
    ) -> io::Result<()> {
        if let Some(at) = interrupted_at {
            self.add(&Record::Interrupted(at));
        }
        for loaded in loaded {
            self.add(&Record::Loaded(loaded));
        }
        self.add(&Record::Ended(hash, ending.map(str::to_owned)));
        self.flush()?;
        match interrupted_at {
            // What a user decided cannot be found out again.
            Some(_) => self.sync(),
            None => Ok(()),
        }
    }

    /// Records that the evaluation of the input with that number, from one, begins again. This
    /// is known after the death of the program, but not necessarily after that of the machine.
    pub(crate) fn again(&mut self, number: usize) -> io::Result<()> {
        self.add(&Record::Again(number));
        self.flush()
    }

    /// Records that the input with that number, from one, is left out.
    pub(crate) fn skipped(&mut self, number: usize) -> io::Result<()> {
        self.add(&Record::Skipped(number));
        self.flush()
    }

    fn add_input(&mut self, number: usize, input: &Recorded) {
        let text = input.text.clone();
        self.add(&Record::Input {
            text,
            stops: input.stops,
        });
        if let Some(at) = input.interrupted_at {
            self.add(&Record::Interrupted(at));
        }
        for loaded in &input.loaded {
            self.add(&Record::Loaded(loaded.clone()));
        }
        match input.end {
            End::Unknown => {}
            End::Ended(hash) => self.add(&Record::Ended(hash, input.ending.clone())),
            End::Skipped => self.add(&Record::Skipped(number)),
        }
    }

    fn add(&mut self, record: &Record) {
        let line = self.checksum.sealed(record);
        self.pending.extend_from_slice(line.as_bytes());
    }

    /// Writes what is pending. What cannot be written stays pending for the next attempt, so
    /// that no record is lost or written twice while a disk is full.
    fn flush(&mut self) -> io::Result<()> {
        let file = match &mut self.file {
            Some(file) => file,
            none => none.insert(opened(&self.path)?),
        };
        while !self.pending.is_empty() {
            match file.write(&self.pending) {
                Ok(0) => return Err(ErrorKind::WriteZero.into()),
                Ok(count) => drop(self.pending.drain(..count)),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }
}

/// Whether there is no room on the disk, which may change.
fn is_full(error: &io::Error) -> bool {
    let kinds = [ErrorKind::StorageFull, ErrorKind::QuotaExceeded];
    kinds.contains(&error.kind())
}

/// Opens and locks a file that does not exist, or is empty.
fn opened(path: &Path) -> io::Result<File> {
    let may_be_empty = path.metadata().is_ok_and(|found| found.len() == 0);
    let mut options = OpenOptions::new();
    options.read(true).append(true);
    let file = if may_be_empty {
        options.open(path)?
    } else {
        options.create_new(true).open(path)?
    };
    if !lock(&file)? {
        return Err(io::Error::new(
            ErrorKind::ResourceBusy,
            "it belongs to a running session",
        ));
    }
    Ok(file)
}

/// Locks a file against other sessions; returns false if another session has locked it. Where
/// the file system has no locks, nothing is locked.
pub(super) fn lock(file: &File) -> io::Result<bool> {
    match file.try_lock() {
        Ok(()) => Ok(true),
        Err(TryLockError::WouldBlock) => Ok(false),
        Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => Ok(true),
        Err(TryLockError::Error(error)) => Err(error),
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::super::reading::Earlier;
    use super::*;

    #[test]
    fn what_a_full_disk_does_not_take_is_written_once_there_is_room() {
        let path = std::env::temp_dir().join(format!("planwright-{}-full", std::process::id()));
        let _ = std::fs::remove_file(&path);
        let mut journal = Journal::create(&path, &Beginning::default(), &[]).unwrap();
        let full = OpenOptions::new().append(true).open("/dev/full").unwrap();
        let disk = journal.file.replace(full);
        let error = journal.begun("(a)", true).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::StorageFull);
        assert!(journal.ended(None, Some(1), None, Vec::new()).is_err());
        journal.file = disk;
        journal.begun("(b)", true).unwrap();
        let earlier = Earlier::parse(&path, &std::fs::read(&path).unwrap()).unwrap();
        std::fs::remove_file(&path).unwrap();
        let texts: Vec<&str> = earlier.inputs.iter().map(|input| &*input.text).collect();
        assert_eq!(texts, ["(a)", "(b)"]);
        assert_eq!(earlier.inputs[0].end, End::Ended(Some(1)));
    }

    #[test]
    fn a_journal_that_had_no_room_begins_when_there_is_some() {
        let path = std::env::temp_dir().join(format!("planwright-{}-no-room", std::process::id()));
        let _ = std::fs::remove_file(&path);
        // Writing to the device fails as it does on a full disk.
        std::os::unix::fs::symlink("/dev/full", &path).unwrap();
        let mut journal = Journal::create(&path, &Beginning::default(), &[]).unwrap();
        assert!(journal.is_behind());
        assert!(journal.begun("(a)", true).is_err());
        std::fs::remove_file(&path).unwrap();
        journal.file = None;
        journal
            .ended(None, Some(1), Some("finished"), Vec::new())
            .unwrap();
        assert!(!journal.is_behind());
        let earlier = Earlier::parse(&path, &std::fs::read(&path).unwrap()).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert_eq!(earlier.inputs.len(), 1);
        assert_eq!(earlier.inputs[0].text, "(a)");
    }
}
