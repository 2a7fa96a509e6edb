//! Pictures of the world as data.

use crate::Session;
use view::picture::{Image, View, ViewError};

/// Maximum number of pixels along a side.
const MAX_PIXELS: usize = 4096;

impl Session {
    /// A picture of the world as it is, width × height pixels. Writes no file: that is done by
    /// [`Picture::to_png`](Image::to_png) and the program.
    pub fn picture(&self, view: &View, [width, height]: [usize; 2]) -> Result<Image, ViewError> {
        for side in [width, height] {
            if !(1..=MAX_PIXELS).contains(&side) {
                return Err(ViewError::Impossible(side as f64));
            }
        }
        self.simulation().picture(*view, width, height)
    }
}
