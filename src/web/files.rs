//! Files in memory, for a page that keeps them.

use std::collections::BTreeMap;
use std::fmt;
use std::io::{self, Cursor, ErrorKind, Seek, SeekFrom, Write};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lisp::files::{Contents, FileFacts, Files, Opening, Output};

/// Called with the name of a file that has been written, and its contents; `None` if it was deleted.
pub type Written = fn(name: &str, bytes: Option<&[u8]>);

/// Files in memory. Clones share them.
#[derive(Clone)]
pub struct MemoryFiles {
    shared: Arc<Mutex<BTreeMap<String, Vec<u8>>>>,
    written: Written,
}

impl fmt::Debug for MemoryFiles {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.files().keys()).finish()
    }
}

/// The name of a file from the root: parts `.` and `..` are resolved.
fn resolved(name: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in name.split('/') {
        match part {
            "" | "." | "~" => {}
            ".." => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    parts.join("/")
}

impl MemoryFiles {
    /// No files; `written` is called when there are some.
    pub fn new(written: Written) -> MemoryFiles {
        MemoryFiles {
            shared: Arc::default(),
            written,
        }
    }

    /// Makes the bytes the contents of a file, without calling `written`.
    pub fn put(&self, name: &str, bytes: Vec<u8>) {
        self.files().insert(resolved(name), bytes);
    }

    /// Deletes a file, without calling `written`.
    pub fn delete(&self, name: &str) {
        self.files().remove(&resolved(name));
    }

    fn files(&self) -> MutexGuard<'_, BTreeMap<String, Vec<u8>>> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn is_folder(&self, name: &str) -> bool {
        let files = self.files();
        let inside = format!("{name}/");
        name.is_empty() || files.keys().any(|known| known.starts_with(&inside))
    }
}

fn missing<T>() -> io::Result<T> {
    Err(ErrorKind::NotFound.into())
}

impl Files for MemoryFiles {
    fn facts(&self, name: &str) -> io::Result<FileFacts> {
        let name = resolved(name);
        let length = self.files().get(&name).map(|bytes| bytes.len() as u64);
        match length {
            Some(length) => Ok(FileFacts {
                is_folder: false,
                length,
                modified: None,
            }),
            None if self.is_folder(&name) => Ok(FileFacts {
                is_folder: true,
                length: 0,
                modified: None,
            }),
            None => missing(),
        }
    }

    fn read(&self, name: &str) -> io::Result<Vec<u8>> {
        let bytes = self.files().get(&resolved(name)).cloned();
        bytes.map_or_else(missing, Ok)
    }

    fn open(&self, name: &str, opening: Opening) -> io::Result<Box<dyn Output>> {
        let name = resolved(name);
        if name.is_empty() || self.is_folder(&name) {
            return Err(ErrorKind::IsADirectory.into());
        }
        let known = self.files().get(&name).cloned();
        if known.is_none() && !opening.creates {
            return missing();
        }
        let mut bytes = Cursor::new(match opening.contents {
            Contents::Drop => Vec::new(),
            Contents::Overwrite | Contents::Append => known.unwrap_or_default(),
        });
        if opening.contents == Contents::Append {
            bytes.seek(SeekFrom::End(0))?;
        }
        let mut file = OpenFile {
            files: self.clone(),
            name,
            bytes,
            is_kept: false,
        };
        // It exists from now on.
        file.flush()?;
        Ok(Box::new(file))
    }

    fn true_name(&self, name: &str) -> io::Result<String> {
        self.facts(name)?;
        Ok(format!("/{}", resolved(name)))
    }

    fn names(&self, folder: &str) -> io::Result<Vec<String>> {
        let folder = resolved(folder);
        if !self.is_folder(&folder) {
            return missing();
        }
        let inside = match folder.as_str() {
            "" => String::new(),
            folder => format!("{folder}/"),
        };
        let files = self.files();
        let rests = files.keys().filter_map(|name| name.strip_prefix(&inside));
        let mut names: Vec<String> = rests
            .map(|rest| match rest.split_once('/') {
                Some((folder, _)) => format!("{folder}/"),
                None => rest.to_owned(),
            })
            .collect();
        names.dedup();
        Ok(names)
    }

    fn remove(&self, name: &str) -> io::Result<()> {
        let name = resolved(name);
        let removed = self.files().remove(&name);
        removed.map_or_else(missing, |_| {
            (self.written)(&name, None);
            Ok(())
        })
    }

    fn rename(&self, old: &str, new: &str) -> io::Result<()> {
        let bytes = self.read(old)?;
        self.write(new, &bytes)?;
        match resolved(old) == resolved(new) {
            true => Ok(()),
            false => self.remove(old),
        }
    }

    fn create_folders(&self, _: &str) -> io::Result<()> {
        // There is a folder wherever a file is.
        Ok(())
    }
}

/// A file that is written: it is kept at each flush, and at the end.
struct OpenFile {
    files: MemoryFiles,
    name: String,
    bytes: Cursor<Vec<u8>>,
    is_kept: bool,
}

impl Write for OpenFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.is_kept = false;
        self.bytes.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        if !self.is_kept {
            self.is_kept = true;
            let bytes = self.bytes.get_ref().clone();
            (self.files.written)(&self.name, Some(&bytes));
            self.files.put(&self.name, bytes);
        }
        Ok(())
    }
}

impl Seek for OpenFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.bytes.seek(to)
    }
}

impl Drop for OpenFile {
    fn drop(&mut self) {
        // Writing into memory does not fail.
        let _ = self.flush();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_can_be_read_under_every_name_of_the_file() {
        let files = MemoryFiles::new(|_, _| {});
        files.write("plans/a.plan", b"(a)").unwrap();
        assert_eq!(files.read("/plans/./b/../a.plan").unwrap(), b"(a)");
        assert_eq!(files.true_name("plans/a.plan").unwrap(), "/plans/a.plan");
        assert!(files.facts("plans").unwrap().is_folder);
        assert_eq!(files.names(".").unwrap(), ["plans/"]);
        assert_eq!(files.names("plans").unwrap(), ["a.plan"]);
        let append = Opening {
            creates: false,
            contents: Contents::Append,
        };
        files
            .open("plans/a.plan", append)
            .unwrap()
            .write_all(b"(b)")
            .unwrap();
        files.rename("plans/a.plan", "c.plan").unwrap();
        assert_eq!(files.read("c.plan").unwrap(), b"(a)(b)");
        assert_eq!(
            files.read("plans/a.plan").unwrap_err().kind(),
            ErrorKind::NotFound
        );
        assert_eq!(
            files.names("plans").unwrap_err().kind(),
            ErrorKind::NotFound
        );
        assert!(files.write("..", b"").is_err());
    }
}
