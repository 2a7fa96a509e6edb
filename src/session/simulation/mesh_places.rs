//! Where the meshes of types of objects are.

/// Where a session looks for meshes.
#[derive(Clone, Debug, Default)]
pub(crate) struct MeshPlaces {
    /// Folders with the packages of `package://…`.
    pub(crate) package_paths: Vec<String>,
    /// Where what was made of meshes is kept.
    pub(crate) kept_in: Option<String>,
    /// The file that is evaluated, if one is.
    pub(crate) source: String,
}
