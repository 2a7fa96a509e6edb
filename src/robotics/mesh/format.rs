//! The format of a file, by its name, or by how it begins.

use super::part::MeshPart;
use super::{collada, stl, wavefront};

/// A format of meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Stl,
    Wavefront,
    Collada,
}

impl Format {
    /// The format of a file.
    pub(super) fn of(path: &str, bytes: &[u8]) -> Option<Self> {
        let extension = path.rsplit_once('.').map_or("", |(_, extension)| extension);
        match extension.to_ascii_lowercase().as_str() {
            "stl" | "stlb" => Some(Self::Stl),
            "obj" => Some(Self::Wavefront),
            "dae" => Some(Self::Collada),
            _ => {
                let head = bytes.get(..bytes.len().min(4096)).unwrap_or_default();
                let has = |text: &[u8]| head.windows(text.len()).any(|part| part == text);
                if has(b"<COLLADA") {
                    Some(Self::Collada)
                } else if head.starts_with(b"solid") && has(b"facet") {
                    Some(Self::Stl)
                } else {
                    None
                }
            }
        }
    }

    /// What a file holds, in its own unit of length; `colors` are those of the materials that an OBJ
    /// file names.
    pub(super) fn read(
        self,
        bytes: &[u8],
        colors: &[(String, [f32; 4])],
    ) -> Result<Vec<MeshPart>, String> {
        match self {
            Self::Stl => stl::read(bytes),
            Self::Wavefront => wavefront::read(bytes, colors),
            Self::Collada => collada::read(bytes),
        }
    }
}
