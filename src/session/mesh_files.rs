//! The files of meshes, among the files of the session.

use std::io;
use std::sync::Arc;

use lisp::files::Files;
use robotics::mesh::MeshFiles;

/// Files of meshes, and a folder for what was made of them.
#[derive(Clone, Debug)]
pub(super) struct SessionMeshes {
    /// The files of the session.
    pub(super) files: Arc<dyn Files>,
    /// Where what was made of meshes is kept; nothing is if `None`.
    pub(super) kept_in: Option<String>,
}

impl MeshFiles for SessionMeshes {
    fn length(&self, path: &str) -> Option<u64> {
        let facts = self.files.facts(path).ok()?;
        (!facts.is_folder).then_some(facts.length)
    }

    fn read(&self, path: &str) -> io::Result<Vec<u8>> {
        self.files.read_plan(path)
    }

    fn folders(&self, path: &str) -> Vec<String> {
        let names = self.files.names(path).unwrap_or_default();
        let folders = names.iter().filter_map(|name| name.strip_suffix('/'));
        folders.map(str::to_owned).collect()
    }

    fn kept(&self, name: &str) -> Option<Vec<u8>> {
        let folder = self.kept_in.as_ref()?;
        self.files.read_plan(&format!("{folder}/{name}")).ok()
    }

    fn keep(&self, name: &str, bytes: &[u8]) {
        let Some(folder) = &self.kept_in else {
            return;
        };
        // Under another name until it is whole; whatever else is read there, is noticed by its digest.
        let (path, unfinished) = (format!("{folder}/{name}"), format!("{folder}/{name}.new"));
        let _ = self
            .files
            .create_folders(folder)
            .and_then(|()| self.files.write(&unfinished, bytes))
            .and_then(|()| self.files.rename(&unfinished, &path));
    }
}
