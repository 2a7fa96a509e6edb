//! The files that an image can use.
//!
//! Everything in the language that reads or writes a file does so through the [`Files`] of its
//! image. A program that embeds it chooses them: the machine's ([`Disk`]), none at all ([`Closed`]),
//! or others, where there is no file system. Names are texts whose parts are separated by `/`; those that are
//! relative begin in the folder that the program was started in.

mod closed;
mod disk;
mod plan;
mod waiting;

use std::fmt::Debug;
use std::io::{self, Read, Seek, Write};
use std::path::Path;

pub use closed::Closed;
pub use disk::Disk;
pub use plan::{MAX_PLAN_BYTES, permit_plan_length, permit_regular, utf8};

/// What can be read in parts.
pub trait FileReader: Read + Seek {}

impl<T: Read + Seek> FileReader for T {}

/// Files, by their names.
///
/// All functions fail as those of [`std::fs`] do, with the same kinds of errors.
pub trait Files: Debug + Send + Sync {
    /// What is known of a file or folder.
    fn facts(&self, name: &str) -> io::Result<FileFacts>;

    /// All bytes of a file.
    fn read(&self, name: &str) -> io::Result<Vec<u8>>;

    /// The bytes of a file, to be read in parts. Reading ends long work as [`crate::guard::look`] does.
    fn reader(&self, name: &str) -> io::Result<Box<dyn FileReader>> {
        Ok(Box::new(io::Cursor::new(self.read(name)?)))
    }

    /// All bytes of a file of forms, which is no folder and has [`MAX_PLAN_BYTES`] at most.
    fn read_plan(&self, name: &str) -> io::Result<Vec<u8>> {
        let facts = self.facts(name)?;
        if facts.is_folder {
            return Err(plan::not_regular("a folder"));
        }
        permit_plan_length(facts.length)?;
        self.read(name)
    }

    /// Opens a file for writing.
    fn open(&self, name: &str, opening: Opening) -> io::Result<Box<dyn Output>>;

    /// Makes the bytes the contents of a file, which is created if it is missing.
    fn write(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let opening = Opening {
            creates: true,
            contents: Contents::Drop,
        };
        let mut file = self.open(name, opening)?;
        file.write_all(bytes)?;
        file.flush()
    }

    /// The name of a file or folder that exists, from the root and without links.
    fn true_name(&self, name: &str) -> io::Result<String>;

    /// The names in a folder, in no particular order; those of folders end with a slash. Names that are
    /// no text are left out.
    fn names(&self, folder: &str) -> io::Result<Vec<String>>;

    /// Deletes a file.
    fn remove(&self, name: &str) -> io::Result<()>;

    /// Gives a file another name.
    fn rename(&self, old: &str, new: &str) -> io::Result<()>;

    /// Makes a folder, and those around it that are missing.
    fn create_folders(&self, name: &str) -> io::Result<()>;
}

/// The text of a file of forms on the machine, or of another file that is as small.
pub fn text_of(path: &Path) -> io::Result<String> {
    bytes_of(path).and_then(utf8)
}

/// The bytes of such a file.
pub fn bytes_of(path: &Path) -> io::Result<Vec<u8>> {
    let name = path.to_str().ok_or(io::ErrorKind::InvalidFilename)?;
    Disk.read_plan(name)
}

/// A file that is written.
pub trait Output: Write + Seek + Send {}

impl<T: Write + Seek + Send> Output for T {}

/// What is known of a file or folder.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct FileFacts {
    /// Is it a folder?
    pub is_folder: bool,
    /// Number of bytes.
    pub length: u64,
    /// When it was written last, in seconds since the beginning of 1970; `None` if unknown.
    pub modified: Option<u64>,
}

/// How a file is opened for writing.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Opening {
    /// Is it created if it is missing?
    pub creates: bool,
    /// What becomes of its contents.
    pub contents: Contents,
}

/// What becomes of the contents of a file that is opened for writing.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Contents {
    /// They are dropped.
    Drop,
    /// They are overwritten from the beginning, as far as something is written.
    Overwrite,
    /// What is written comes after them.
    Append,
}
