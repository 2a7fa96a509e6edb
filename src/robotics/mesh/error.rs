//! Why a mesh cannot be had.

use thiserror::Error;

/// Why a mesh cannot be had.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MeshError {
    /// There is no such file in any of the places where it could be.
    #[error("{}", not_found(file, tried))]
    NotFound {
        /// The file as the URDF names it.
        file: String,
        /// The paths that were tried.
        tried: Vec<String>,
    },
    /// The file is named in a way that leads to no place.
    #[error("the mesh {file} cannot be had: {reason}")]
    Name {
        /// The file as the URDF names it.
        file: String,
        /// What is wrong with the name.
        reason: &'static str,
    },
    /// The file cannot be read.
    #[error("{path}: {error}")]
    Unreadable {
        /// The path.
        path: String,
        /// What the system says.
        error: String,
    },
    /// The file is in no known format.
    #[error("{path} is no mesh that can be read; give an STL, OBJ or DAE (COLLADA) file")]
    Format {
        /// The path.
        path: String,
    },
    /// The file is wrong.
    #[error("{path}: {problem}")]
    Wrong {
        /// The path.
        path: String,
        /// What is wrong and where.
        problem: String,
    },
}

fn not_found(file: &str, tried: &[String]) -> String {
    let hint = match file.contains("://") {
        true => "; say where the package is with --package-path FOLDER",
        false => "",
    };
    match tried {
        [] => format!("there is no file for the mesh {file}: no folder is known to look in{hint}"),
        tried => {
            let shown = tried.get(..MAX_SHOWN).unwrap_or(tried);
            let others = match tried.len() - shown.len() {
                0 => String::new(),
                others => format!(" and {others} more"),
            };
            let shown = shown.join(", ");
            format!("there is no file for the mesh {file}; tried {shown}{others}{hint}")
        }
    }
}

/// So many of the paths that were tried are shown.
const MAX_SHOWN: usize = 4;
