//! The files of the machine.

use std::fs::{self, OpenOptions};
use std::io::{BufWriter, Error, ErrorKind, Read, Result};
use std::time::UNIX_EPOCH;

use super::{Contents, FileFacts, FileReader, Files, Opening, Output};
use super::{plan, waiting};

/// The file system that the process sees.
#[derive(Clone, Copy, Debug)]
pub struct Disk;

impl Files for Disk {
    fn facts(&self, name: &str) -> Result<FileFacts> {
        let known = fs::metadata(name)?;
        let modified = known.modified().ok();
        let since = modified.map(|time| time.duration_since(UNIX_EPOCH).unwrap_or_default());
        Ok(FileFacts {
            is_folder: known.is_dir(),
            length: known.len(),
            modified: since.map(|since| since.as_secs()),
        })
    }

    fn read(&self, name: &str) -> Result<Vec<u8>> {
        waiting::read(name)
    }

    fn reader(&self, name: &str) -> Result<Box<dyn FileReader>> {
        waiting::reader(name)
    }

    fn read_plan(&self, name: &str) -> Result<Vec<u8>> {
        let known = fs::metadata(name)?;
        plan::permit_regular(&known)?;
        // Some files, such as those that the system makes up, have more bytes than they tell.
        plan::permit_plan_length(known.len())?;
        let mut bytes = Vec::new();
        let file = fs::File::open(name)?;
        file.take(plan::MAX_PLAN_BYTES + 1)
            .read_to_end(&mut bytes)?;
        plan::permit_plan_length(bytes.len() as u64)?;
        Ok(bytes)
    }

    fn open(&self, name: &str, opening: Opening) -> Result<Box<dyn Output>> {
        let mut options = OpenOptions::new();
        options.write(true).create(opening.creates);
        match opening.contents {
            Contents::Drop => options.truncate(true),
            Contents::Overwrite => options.truncate(false),
            Contents::Append => options.append(true),
        };
        Ok(Box::new(BufWriter::new(waiting::open(&options, name)?)))
    }

    fn true_name(&self, name: &str) -> Result<String> {
        let found = fs::canonicalize(name)?.into_os_string().into_string();
        found.map_err(|_| Error::from(ErrorKind::InvalidData))
    }

    fn names(&self, folder: &str) -> Result<Vec<String>> {
        let entries = fs::read_dir(folder)?.flatten();
        let named = entries.filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            let is_folder = fs::metadata(entry.path()).is_ok_and(|known| known.is_dir());
            Some(if is_folder { name + "/" } else { name })
        });
        Ok(named.collect())
    }

    fn remove(&self, name: &str) -> Result<()> {
        fs::remove_file(name)
    }

    fn rename(&self, old: &str, new: &str) -> Result<()> {
        fs::rename(old, new)
    }

    fn create_folders(&self, name: &str) -> Result<()> {
        fs::create_dir_all(name)
    }
}
