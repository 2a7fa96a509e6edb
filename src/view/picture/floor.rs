//! The floor of pictures and of the live view: boards that differ a little in their brightness.
//! The page calculates the same in the browser's graphics card (`floor.js`), with these numbers.

use nalgebra::Vector3;

use super::shade::{Color, smooth};

/// Linear colour of the boards.
pub(crate) const BOARD: Color = [0.40, 0.27, 0.165];

/// Width and length of a board, and width of the gap between two boards (m).
pub(crate) const BOARD_WIDTH: f32 = 0.16;
pub(crate) const BOARD_LENGTH: f32 = 1.9;
pub(crate) const BOARD_GAP: f32 = 0.005;

/// By how much boards differ in their brightness, and how much darker gaps are, as shares.
pub(crate) const VARIETY: f32 = 0.28;
pub(crate) const GAP_SHADE: f32 = 0.45;

/// Distances (m from the eye, along the floor) between which the floor fades out.
pub(crate) const FADE: [f32; 2] = [7.0, 22.0];

/// The linear colour of the floor at a point (m, map frame), averaged where a pixel shows much
/// of it; `grain` is the size (m) of a pixel there.
pub(super) fn boards(point: &Vector3<f32>, grain: f32) -> Color {
    let across = point.y / BOARD_WIDTH;
    let row = floor(across);
    let along = point.x / BOARD_LENGTH + tone(row, 0.0);
    let column = floor(along);
    // The distance to the nearest gap.
    let inside = |part: f32, size: f32| part.min(1.0 - part) * size;
    let seam = inside(across - row, BOARD_WIDTH).min(inside(along - column, BOARD_LENGTH));
    let width = BOARD_GAP.max(grain);
    let fine = 1.0 - smooth(grain * (1.5 / BOARD_WIDTH));
    let mut light = 1.0 + (tone(row, column + 1.0) - 0.5) * VARIETY * fine;
    if seam < width {
        light *= 1.0 - (1.0 - seam / width) * (BOARD_GAP / width) * GAP_SHADE;
    }
    BOARD.map(|c| c * light)
}

/// How much (0..1) the floor has faded out at a point seen from an eye (m, map frame).
pub(super) fn faded(point: &Vector3<f32>, eye: &Vector3<f32>) -> f32 {
    let square = (point - eye).xy().norm_squared();
    match square > FADE[0] * FADE[0] {
        true => smooth((square.sqrt() - FADE[0]) / (FADE[1] - FADE[0])),
        false => 0.0,
    }
}

/// The greatest integer that is not above the number, of some thousands at most. The oldest processors
/// that programs are compiled for have no instruction for it, and a call would take longer.
fn floor(value: f32) -> f32 {
    let toward_zero = value as i32 as f32;
    toward_zero - if toward_zero > value { 1.0 } else { 0.0 }
}

/// A pseudo-random number in 0..1 that is always the same for a board.
fn tone(row: f32, column: f32) -> f32 {
    // Rows and columns are within some thousands.
    let part = |number: f32, factor: u32| (number as i32 as u32).wrapping_mul(factor);
    let mut bits = part(row, 0x9E37_79B1) ^ part(column, 0x85EB_CA77);
    bits ^= bits >> 15;
    bits = bits.wrapping_mul(0x2C1B_3C6D);
    bits ^= bits >> 12;
    bits = bits.wrapping_mul(0x297A_2D39);
    bits ^= bits >> 15;
    // Sixteen bits are exact in single precision.
    (bits & 0xFFFF) as f32 / 65535.0
}
