//! Trigonometry through `libm`, so that results have the same bits on every platform.

/// Sine and cosine of an angle (rad).
pub fn sin_cos(a: f64) -> (f64, f64) {
    libm::sincos(a)
}

/// Sine of an angle (rad).
pub fn sin(a: f64) -> f64 {
    libm::sin(a)
}

/// Cosine of an angle (rad).
pub fn cos(a: f64) -> f64 {
    libm::cos(a)
}

/// Angle (rad, in -π..π) of the vector (x, y).
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Arc cosine (rad); the argument is clamped to -1..1.
pub fn acos(x: f64) -> f64 {
    libm::acos(x.clamp(-1.0, 1.0))
}

/// Arc sine (rad); the argument is clamped to -1..1.
pub fn asin(x: f64) -> f64 {
    libm::asin(x.clamp(-1.0, 1.0))
}

/// The angle normalised to -π..π.
pub fn wrap(a: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    if (-PI..=PI).contains(&a) {
        return a;
    }
    let r = (a + PI).rem_euclid(TAU) - PI;
    if r < -PI { r + TAU } else { r }
}
