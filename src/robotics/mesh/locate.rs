//! Where the file of a mesh is.
//!
//! `package://NAME/PATH` is looked for below the folders of packages, in the order in which they are
//! given, then in the folders around the URDF; any of these may be the package itself.

use super::error::MeshError;
use super::files::MeshFiles;

/// Where the files that a URDF names are looked for.
#[derive(Clone, Debug, Default)]
pub(super) struct Places {
    /// The folder of the URDF.
    pub(super) folder: String,
    /// Folders that hold packages, or are packages.
    pub(super) packages: Vec<String>,
}

impl Places {
    /// The path of the file that the URDF names.
    pub(super) fn find(&self, file: &str, files: &dyn MeshFiles) -> Result<String, MeshError> {
        let wrong = |reason| MeshError::Name {
            file: file.to_owned(),
            reason,
        };
        let mut tried = match file.split_once("://") {
            Some(("package" | "model", path)) => {
                let (package, path) = path
                    .split_once('/')
                    .ok_or_else(|| wrong("expected package://NAME/PATH"))?;
                if path.split('/').any(|part| part == "..") || package == ".." {
                    return Err(wrong("the path leads out of the package"));
                }
                self.in_package(package, path, files)
            }
            Some(("file", path)) => vec![self.beside(path)],
            Some(_) => return Err(wrong("only package:// and file:// lead to files")),
            None => vec![self.beside(file)],
        };
        if file.contains('\0') {
            return Err(wrong("a path has no such character"));
        }
        match tried.iter().position(|path| files.length(path).is_some()) {
            Some(place) => Ok(tried.swap_remove(place)),
            None => {
                let mut known = Vec::new();
                tried.retain(|path| {
                    let is_new = !known.contains(path);
                    known.extend(is_new.then(|| path.clone()));
                    is_new
                });
                Err(MeshError::NotFound {
                    file: file.to_owned(),
                    tried,
                })
            }
        }
    }

    /// A path that is relative to the folder of the URDF, unless it is absolute.
    fn beside(&self, path: &str) -> String {
        match path.starts_with('/') || path.get(1..3) == Some(":/") {
            true => path.to_owned(),
            false => joined(&self.folder, path),
        }
    }

    fn in_package(&self, package: &str, path: &str, files: &dyn MeshFiles) -> Vec<String> {
        let mut tried = Vec::new();
        let mut try_below = |folder: &str| {
            if folder.rsplit('/').next() == Some(package) {
                tried.push(joined(folder, path));
            }
            tried.push(joined(&joined(folder, package), path));
        };
        for folder in &self.packages {
            let folder = folder.trim_end_matches('/');
            try_below(folder);
            // Packages often lie together in a folder that is no package.
            let mut inner = files.folders(folder);
            inner.sort_unstable();
            let holds = |name: &&String| {
                let path = joined(&joined(&joined(folder, name), package), path);
                files.length(&path).is_some()
            };
            if let Some(name) = inner.iter().find(holds) {
                try_below(&joined(folder, name));
            }
        }
        let mut folder = self.folder.trim_end_matches('/');
        loop {
            try_below(folder);
            match folder.rsplit_once('/') {
                Some((outer, _)) if !outer.is_empty() => folder = outer,
                _ => break,
            }
        }
        tried
    }
}

fn joined(folder: &str, path: &str) -> String {
    match folder {
        "" => path.to_owned(),
        folder => format!("{}/{path}", folder.trim_end_matches('/')),
    }
}
