//! A run as an animation: a GIF with a single palette, in which each frame holds only what has
//! changed.

use std::borrow::Cow;
use std::io::{self, Write};

use gif::{Encoder, EncodingError, Frame, Repeat};

use super::image::Image;
use super::palette::Palette;
use super::render::render;
use super::scene::Scene;
use robotics::perception::Camera;

/// Number of colours; one entry of the palette is reserved for unchanged pixels.
const COLORS: usize = 255;
const SAME: u8 = 255;

/// Number of frames from which the palette is made.
const PALETTE_FRAMES: usize = 12;

/// One frame of the animation, to be drawn.
#[derive(Clone, Debug)]
pub struct Shot {
    /// What to draw.
    pub scene: Scene,
    /// The camera to draw it from.
    pub camera: Camera,
}

impl Shot {
    /// The picture.
    pub fn image(&self) -> Image {
        render(&self.scene, &self.camera)
    }
}

/// Writes the shots, which must all have the same size, as a GIF that repeats for ever and
/// shows each for `delay` hundredths of a second.
pub fn write_gif(shots: &[Shot], delay: u16, to: impl Write) -> io::Result<()> {
    let Some(first) = shots.first() else {
        return Ok(());
    };
    let size = |length: usize| u16::try_from(length).map_err(io::Error::other);
    let (width, height) = (first.camera.width, first.camera.height);
    let stride = shots.len().div_ceil(PALETTE_FRAMES);
    let sampled: Vec<Image> = shots.iter().step_by(stride).map(Shot::image).collect();
    let palette = Palette::of(sampled.iter(), COLORS);
    let mut colors: Vec<u8> = palette.colors().concat();
    colors.resize(256 * 3, 0);
    let mut encoder = Encoder::new(to, size(width)?, size(height)?, &colors).map_err(into_io)?;
    encoder.set_repeat(Repeat::Infinite).map_err(into_io)?;
    let mut shown: Option<Vec<u8>> = None;
    let mut waiting: Option<Frame<'_>> = None;
    for shot in shots {
        let places = palette.places(&shot.image());
        let change = match &shown {
            Some(shown) => changed(shown, &places, width),
            None => Some(([0, 0], [width, height])),
        };
        let Some(([left, top], [columns, rows])) = change else {
            // Nothing has changed, so the frame before is shown longer.
            if let Some(frame) = &mut waiting {
                frame.delay = frame.delay.saturating_add(delay);
            }
            continue;
        };
        if let Some(frame) = waiting.take() {
            encoder.write_frame(&frame).map_err(into_io)?;
        }
        let mut buffer = Vec::with_capacity(columns * rows);
        for row in top..top + rows {
            let place = row * width + left;
            // The rectangle is inside the picture.
            let new = &places[place..place + columns];
            match &shown {
                Some(shown) => {
                    let old = &shown[place..place + columns];
                    let pairs = new.iter().zip(old);
                    buffer.extend(pairs.map(|(new, old)| if new == old { SAME } else { *new }));
                }
                None => buffer.extend(new),
            }
        }
        waiting = Some(Frame {
            delay,
            left: size(left)?,
            top: size(top)?,
            width: size(columns)?,
            height: size(rows)?,
            transparent: shown.is_some().then_some(SAME),
            buffer: Cow::Owned(buffer),
            ..Frame::default()
        });
        shown = Some(places);
    }
    match waiting {
        Some(frame) => encoder.write_frame(&frame).map_err(into_io),
        None => Ok(()),
    }
}

/// Corner and size of the smallest rectangle that contains all differences.
fn changed(old: &[u8], new: &[u8], width: usize) -> Option<([usize; 2], [usize; 2])> {
    let differences = old.iter().zip(new).enumerate().filter(|(_, (a, b))| a != b);
    let mut bounds: Option<[usize; 4]> = None;
    for (place, _) in differences {
        let (column, row) = (place % width, place / width);
        let [left, top, right, bottom] = bounds.unwrap_or([column, row, column, row]);
        bounds = Some([
            left.min(column),
            top.min(row),
            right.max(column),
            bottom.max(row),
        ]);
    }
    let [left, top, right, bottom] = bounds?;
    Some(([left, top], [right - left + 1, bottom - top + 1]))
}

fn into_io(error: EncodingError) -> io::Error {
    match error {
        EncodingError::Io(error) => error,
        other => io::Error::other(other),
    }
}

#[cfg(test)]
mod tests {
    use crate::picture::animation::*;

    #[test]
    fn what_changed_is_in_the_rectangle() {
        let old = [0; 20];
        let mut new = old;
        assert_eq!(changed(&old, &new, 5), None);
        new[7] = 1;
        new[13] = 1;
        assert_eq!(changed(&old, &new, 5), Some(([2, 1], [2, 2])));
    }
}
