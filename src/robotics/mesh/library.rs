//! The meshes that a URDF names, read all together.

use std::num::NonZero;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use super::clean::cleaned;
use super::decompose::bodies;
use super::error::MeshError;
use super::files::{MeshFiles, NoMeshFiles};
use super::format::Format;
use super::kept;
use super::locate::Places;
use super::part::MeshPart;
use super::wavefront;

/// Longer files are refused (bytes).
const MAX_BYTES: u64 = 1 << 26;

/// Stack (bytes) of a thread that takes meshes apart.
const STACK: usize = 32 << 20;

/// What a mesh is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshPurpose {
    /// Things collide with it: it becomes convex bodies.
    Solid,
    /// It is looked at: it stays as it is.
    Looks,
}

/// A mesh that is wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshRequest {
    /// The file as the URDF names it.
    pub file: String,
    /// Factors on its coordinates along x, y, z; none is 0.
    pub scale: [f64; 3],
    /// What it is for.
    pub purpose: MeshPurpose,
}

/// Reads the meshes that a URDF names.
#[derive(Debug)]
pub struct MeshLibrary<'f> {
    files: &'f dyn MeshFiles,
    places: Places,
}

impl MeshLibrary<'static> {
    /// A library without any files.
    pub fn none() -> Self {
        Self {
            files: &NoMeshFiles,
            places: Places::default(),
        }
    }
}

impl<'f> MeshLibrary<'f> {
    /// The library for a URDF with that path; `packages` are folders that hold packages or are some. The
    /// parts of paths are separated by `/`.
    pub fn new(files: &'f dyn MeshFiles, urdf: &str, packages: &[String]) -> Self {
        let folder = urdf
            .rsplit_once('/')
            .map_or("", |(folder, _)| match folder {
                "" => "/",
                folder => folder,
            });
        let places = Places {
            folder: folder.to_owned(),
            packages: packages.to_vec(),
        };
        Self { files, places }
    }

    /// The wanted meshes, in that order; each is read once, however often it is wanted.
    ///
    /// # Errors
    ///
    /// For each mesh, why it cannot be had.
    pub fn load(&self, wanted: &[MeshRequest]) -> Vec<Result<Vec<MeshPart>, MeshError>> {
        let mut different: Vec<&MeshRequest> = Vec::new();
        let places: Vec<usize> = wanted
            .iter()
            .map(|request| {
                let known = different.iter().position(|known| *known == request);
                known.unwrap_or_else(|| {
                    different.push(request);
                    different.len() - 1
                })
            })
            .collect();
        let found = self.load_each(&different);
        let found = places
            .into_iter()
            .map(|place| found.get(place).cloned().flatten());
        let missing = |request: &MeshRequest| MeshError::NotFound {
            file: request.file.clone(),
            tried: Vec::new(),
        };
        let pairs = found.zip(wanted);
        pairs
            .map(|(found, request)| found.unwrap_or_else(|| Err(missing(request))))
            .collect()
    }

    /// Reads meshes on as many threads as there are.
    fn load_each(&self, wanted: &[&MeshRequest]) -> Vec<Option<Result<Vec<MeshPart>, MeshError>>> {
        let found: Vec<_> = wanted.iter().map(|_| Mutex::new(None)).collect();
        let next = AtomicUsize::new(0);
        let work = || {
            while let Some((request, place)) = {
                let i = next.fetch_add(1, Ordering::Relaxed);
                wanted.get(i).zip(found.get(i))
            } {
                let parts = self.mesh(request);
                if let Ok(mut place) = place.lock() {
                    *place = Some(parts);
                }
            }
        };
        let threads = thread::available_parallelism()
            .map_or(1, NonZero::get)
            .min(wanted.len());
        thread::scope(|scope| {
            let started = (0..threads).filter(|_| {
                let thread = thread::Builder::new().stack_size(STACK);
                thread.spawn_scoped(scope, work).is_ok()
            });
            // Where there are no threads, this one does the work.
            if started.count() == 0 {
                work();
            }
        });
        let found = found
            .into_iter()
            .map(|place| place.into_inner().ok().flatten());
        found.collect()
    }

    fn mesh(&self, request: &MeshRequest) -> Result<Vec<MeshPart>, MeshError> {
        let path = self.places.find(&request.file, self.files)?;
        let wrong = |problem: String| MeshError::Wrong {
            path: path.clone(),
            problem,
        };
        let length = self.files.length(&path).unwrap_or(0);
        if length > MAX_BYTES {
            return Err(wrong(format!(
                "the file has {length} bytes; {MAX_BYTES} are allowed at most"
            )));
        }
        let bytes = self
            .files
            .read(&path)
            .map_err(|error| MeshError::Unreadable {
                path: path.clone(),
                error: error.to_string(),
            })?;
        let format =
            Format::of(&path, &bytes).ok_or_else(|| MeshError::Format { path: path.clone() })?;
        let materials = match (format, request.purpose) {
            (Format::Wavefront, MeshPurpose::Looks) => self.materials(&path, &bytes),
            _ => Vec::new(),
        };
        let scale = request.scale.map(f64::to_le_bytes).concat();
        let kind = format!("{format:?} {:?}", request.purpose);
        let name = kept::name(&[kind.as_bytes(), &scale, &bytes, &materials]);
        if let Some(parts) = self
            .files
            .kept(&name)
            .and_then(|bytes| kept::parts_of(&bytes))
        {
            return Ok(parts);
        }
        let colors = wavefront::colors(&materials);
        let parts = format.read(&bytes, &colors).map_err(wrong)?;
        let parts = cleaned(parts, request.scale).map_err(wrong)?;
        let parts = match request.purpose {
            MeshPurpose::Looks => parts,
            MeshPurpose::Solid => {
                let bodies = bodies(&parts).map_err(wrong)?.into_iter();
                let part = |surface| MeshPart {
                    surface,
                    color: None,
                };
                bodies.map(part).collect()
            }
        };
        self.files.keep(&name, &kept::bytes_of(&parts));
        Ok(parts)
    }

    /// The files of materials that an OBJ file names, one after the other; those that are missing are
    /// left out.
    fn materials(&self, path: &str, bytes: &[u8]) -> Vec<u8> {
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
        let mut all = Vec::new();
        for name in wavefront::libraries(bytes) {
            let path = match folder {
                "" => name,
                folder => format!("{folder}/{name}"),
            };
            if self
                .files
                .length(&path)
                .is_some_and(|length| length < MAX_BYTES / 10)
            {
                all.extend(self.files.read(&path).unwrap_or_default());
                all.push(b'\n');
            }
        }
        all
    }
}
