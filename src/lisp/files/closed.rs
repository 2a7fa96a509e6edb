//! No files at all.

use std::io::{Error, ErrorKind, Result};

use super::{FileFacts, Files, Opening, Output};

/// Refuses every use of a file.
#[derive(Clone, Copy, Debug)]
pub struct Closed;

/// Why a file cannot be used.
fn refused<T>() -> Result<T> {
    Err(Error::new(
        ErrorKind::Unsupported,
        "this session has no files",
    ))
}

impl Files for Closed {
    fn facts(&self, _: &str) -> Result<FileFacts> {
        refused()
    }

    fn read(&self, _: &str) -> Result<Vec<u8>> {
        refused()
    }

    fn open(&self, _: &str, _: Opening) -> Result<Box<dyn Output>> {
        refused()
    }

    fn true_name(&self, _: &str) -> Result<String> {
        refused()
    }

    fn names(&self, _: &str) -> Result<Vec<String>> {
        refused()
    }

    fn remove(&self, _: &str) -> Result<()> {
        refused()
    }

    fn rename(&self, _: &str, _: &str) -> Result<()> {
        refused()
    }

    fn create_folders(&self, _: &str) -> Result<()> {
        refused()
    }
}
