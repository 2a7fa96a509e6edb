//! The files that meshes are read from, and what is kept of earlier readings.

use std::fmt::Debug;
use std::io;

/// Files of meshes, and a place for what was made of them.
pub trait MeshFiles: Debug + Sync {
    /// Number of bytes of a file, if there is one with that path and it is no folder.
    fn length(&self, path: &str) -> Option<u64>;

    /// All bytes of a file.
    fn read(&self, path: &str) -> io::Result<Vec<u8>>;

    /// The names of the folders in a folder, in any order; none if there is no such folder.
    fn folders(&self, path: &str) -> Vec<String>;

    /// What was kept under a name, if it still is.
    fn kept(&self, name: &str) -> Option<Vec<u8>>;

    /// Keeps bytes under a name, if there is a place for them. Whatever prevents it prevents nothing else.
    fn keep(&self, name: &str, bytes: &[u8]);
}

/// No files at all.
#[derive(Clone, Copy, Debug)]
pub struct NoMeshFiles;

impl MeshFiles for NoMeshFiles {
    fn length(&self, _: &str) -> Option<u64> {
        None
    }

    fn read(&self, _: &str) -> io::Result<Vec<u8>> {
        Err(io::ErrorKind::NotFound.into())
    }

    fn folders(&self, _: &str) -> Vec<String> {
        Vec::new()
    }

    fn kept(&self, _: &str) -> Option<Vec<u8>> {
        None
    }

    fn keep(&self, _: &str, _: &[u8]) {}
}
