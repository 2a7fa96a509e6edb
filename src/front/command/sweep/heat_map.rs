//! The option that asks for a heat map.

use std::path::PathBuf;
use std::str::FromStr;

/// Two draws and the file for the picture: `bottle.x,bottle.y=map.png`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct HeatMap {
    /// Paths of the draws to the right and upwards.
    pub(super) axes: [String; 2],
    pub(super) path: PathBuf,
}

impl FromStr for HeatMap {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('=');
        let parts = parts.and_then(|(axes, path)| Some((axes.split_once(',')?, path)));
        let parts = parts.filter(|((x, y), path)| ![*x, *y, *path].contains(&""));
        let ((x, y), path) =
            parts.ok_or("two draws and a file were expected, as in bottle.x,bottle.y=map.png")?;
        Ok(Self {
            axes: [x, y].map(str::to_owned),
            path: PathBuf::from(path),
        })
    }
}
