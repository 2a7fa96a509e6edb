//! The elementary functions of the C library, defined anew, so that the physics engine gets the same
//! bits on every system.
//!
//! `f64::sin` and its like become calls of symbols such as `sin`, which the linker would take from the
//! system's C library; their last bits differ between systems and versions. A program that contains
//! this crate takes them from here. Its own code calls `spatial::trig` instead; this is for what
//! dependencies call, such as `parry` when it calculates the axes of inertia.
//!
//! On WebAssembly, Rust brings such functions itself.
#![cfg(not(target_family = "wasm"))]

/// Defines functions of C's names and types by those of `libm`.
macro_rules! functions {
    ($($name:ident($($argument:ident),+);)+) => {
        $(
            #[doc = concat!("C's `", stringify!($name), "`.")]
            #[unsafe(no_mangle)]
            extern "C" fn $name($($argument: f64),+) -> f64 {
                libm::$name($($argument),+)
            }
        )+
    };
}

functions! {
    acos(x);
    asin(x);
    atan(x);
    atan2(y, x);
    cbrt(x);
    cos(x);
    cosh(x);
    exp(x);
    exp2(x);
    hypot(x, y);
    log(x);
    log10(x);
    log2(x);
    pow(x, y);
    sin(x);
    sinh(x);
    tan(x);
    tanh(x);
}

/// What the optimiser makes of a sine and a cosine of the same angle, where the C library is GNU's.
///
/// # Safety
///
/// Both pointers are valid for writing.
#[unsafe(no_mangle)]
unsafe extern "C" fn sincos(x: f64, sine: *mut f64, cosine: *mut f64) {
    let (s, c) = libm::sincos(x);
    // SAFETY: the caller passes places for both results.
    unsafe {
        *sine = s;
        *cosine = c;
    }
}

/// A sine and a cosine, in the registers in which Apple's function returns them.
#[cfg(target_vendor = "apple")]
#[repr(C)]
struct SineAndCosine {
    sine: f64,
    cosine: f64,
}

/// The same on Apple's systems.
#[cfg(target_vendor = "apple")]
#[unsafe(no_mangle)]
extern "C" fn __sincos_stret(x: f64) -> SineAndCosine {
    let (sine, cosine) = libm::sincos(x);
    SineAndCosine { sine, cosine }
}

#[cfg(test)]
mod tests {
    use std::hint::black_box;

    /// Points at which functions are compared.
    fn points() -> impl Iterator<Item = f64> {
        (1..2000).map(|i| f64::from(i) * 0.000_499_7)
    }

    /// A C library rounds some of so many results otherwise.
    #[test]
    fn the_methods_of_numbers_are_those_of_the_portable_library() {
        type Function = fn(f64) -> f64;
        let pairs: [(&str, Function, Function); 12] = [
            ("sin", f64::sin, libm::sin),
            ("cos", f64::cos, libm::cos),
            ("tan", f64::tan, libm::tan),
            ("asin", f64::asin, libm::asin),
            ("acos", f64::acos, libm::acos),
            ("atan", f64::atan, libm::atan),
            ("exp", f64::exp, libm::exp),
            ("ln", f64::ln, libm::log),
            ("log2", f64::log2, libm::log2),
            ("tanh", f64::tanh, libm::tanh),
            ("sin of both", |x| x.sin_cos().0, |x| libm::sincos(x).0),
            ("cbrt", f64::cbrt, libm::cbrt),
        ];
        for (name, method, portable) in pairs {
            for x in points() {
                let [one, other] = [method(black_box(x)), portable(black_box(x))];
                assert_eq!(one.to_bits(), other.to_bits(), "{name} of {x}");
            }
        }
        for x in points() {
            let [one, other] = [black_box(x).powf(1.7), libm::pow(black_box(x), 1.7)];
            assert_eq!(one.to_bits(), other.to_bits(), "{x} to the power of 1.7");
        }
    }
}
