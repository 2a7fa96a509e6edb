//! Files in memory.

use std::collections::BTreeMap;
use std::io;
use std::sync::Mutex;

use crate::mesh::{MeshError, MeshFiles, MeshLibrary, MeshPart, MeshPurpose, MeshRequest};

/// Files in memory, and what is kept of them.
#[derive(Debug, Default)]
pub(super) struct MemoryFiles {
    files: BTreeMap<String, Vec<u8>>,
    pub(super) kept: Mutex<BTreeMap<String, Vec<u8>>>,
}

impl MemoryFiles {
    /// With one file.
    pub(super) fn of(path: &str, bytes: impl Into<Vec<u8>>) -> Self {
        Self::default().with(path, bytes)
    }

    /// With another file.
    pub(super) fn with(mut self, path: &str, bytes: impl Into<Vec<u8>>) -> Self {
        self.files.insert(path.to_owned(), bytes.into());
        self
    }
}

impl MeshFiles for MemoryFiles {
    fn length(&self, path: &str) -> Option<u64> {
        Some(self.files.get(path)?.len() as u64)
    }

    fn read(&self, path: &str) -> io::Result<Vec<u8>> {
        let found = self.files.get(path).cloned();
        found.ok_or_else(|| io::ErrorKind::NotFound.into())
    }

    fn folders(&self, path: &str) -> Vec<String> {
        let below = self
            .files
            .keys()
            .filter_map(|file| file.strip_prefix(path)?.strip_prefix('/'));
        let folders = below.filter_map(|file| Some(file.split_once('/')?.0.to_owned()));
        let mut folders: Vec<String> = folders.collect();
        folders.dedup();
        folders
    }

    fn kept(&self, name: &str) -> Option<Vec<u8>> {
        self.kept.lock().ok()?.get(name).cloned()
    }

    fn keep(&self, name: &str, bytes: &[u8]) {
        if let Ok(mut kept) = self.kept.lock() {
            kept.insert(name.to_owned(), bytes.to_vec());
        }
    }
}

/// Reads a file for a purpose, with a scale.
pub(super) fn load(
    files: &MemoryFiles,
    file: &str,
    scale: [f64; 3],
    purpose: MeshPurpose,
) -> Result<Vec<MeshPart>, MeshError> {
    let request = MeshRequest {
        file: file.to_owned(),
        scale,
        purpose,
    };
    MeshLibrary::new(files, "/k/k.urdf", &[])
        .load(&[request])
        .remove(0)
}

/// Reads the only file in the folder of the URDF.
pub(super) fn only(
    name: &str,
    bytes: impl Into<Vec<u8>>,
    purpose: MeshPurpose,
) -> Result<Vec<MeshPart>, String> {
    let files = MemoryFiles::of(&format!("/k/{name}"), bytes);
    load(&files, name, [1.0; 3], purpose).map_err(|error| error.to_string())
}

/// A binary STL file.
pub(super) fn stl(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = b"solid no text".to_vec();
    bytes.resize(80, 0);
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        let numbers = triangle.iter().flatten();
        bytes.extend(numbers.flat_map(|number| number.to_le_bytes()));
        bytes.extend([7, 7]);
    }
    bytes
}

/// The triangles of a box from one corner to the opposite one (m).
pub(super) fn cuboid([x, y, z]: [f32; 3], [u, v, w]: [f32; 3]) -> Vec<[[f32; 3]; 3]> {
    let corner = |i: usize| {
        [
            if i & 1 == 1 { u } else { x },
            if i & 2 == 2 { v } else { y },
            if i & 4 == 4 { w } else { z },
        ]
    };
    let sides = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let halves = sides
        .into_iter()
        .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    halves.map(|triangle| triangle.map(corner)).collect()
}
