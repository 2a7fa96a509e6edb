//! The folder of a sweep's episodes: its records, and what was performed in each world, as JSON Lines.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::command::failure::CommandError;
use sweep::Record;

/// The files of such a folder, which are written in the order of the worlds.
pub(super) struct Episodes {
    folder: PathBuf,
    files: BTreeMap<String, BufWriter<File>>,
}

impl Episodes {
    /// Makes the folder. What is there of an earlier sweep is replaced.
    pub(super) fn begin(folder: &Path) -> Result<Self, CommandError> {
        let failed = |error| CommandError::Rewrite {
            path: folder.to_owned(),
            error,
        };
        fs::create_dir_all(folder).map_err(failed)?;
        let mut episodes = Self {
            folder: folder.to_owned(),
            files: BTreeMap::new(),
        };
        for name in ["records", "task", "param", "failure"] {
            episodes.write(name, "")?;
        }
        Ok(episodes)
    }

    /// Adds what came of a world, and what was performed in it.
    pub(super) fn add(
        &mut self,
        record: &Record,
        performed: &[(String, String)],
    ) -> Result<(), CommandError> {
        self.write("records", &format!("{}\n", record.line().trim_end()))?;
        for (relation, lines) in performed {
            self.write(relation, lines)?;
        }
        Ok(())
    }

    fn write(&mut self, relation: &str, lines: &str) -> Result<(), CommandError> {
        let path = self.folder.join(format!("{relation}.jsonl"));
        let failed = |error| CommandError::Rewrite {
            path: path.clone(),
            error,
        };
        if !self.files.contains_key(relation) {
            let file = File::create(&path).map_err(failed)?;
            self.files.insert(relation.to_owned(), BufWriter::new(file));
        }
        match self.files.get_mut(relation) {
            Some(file) => file
                .write_all(lines.as_bytes())
                .and_then(|()| file.flush())
                .map_err(failed),
            None => Ok(()),
        }
    }
}
