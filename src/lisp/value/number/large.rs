//! Multiplication, division and digits of integers of any length, in steps between which an
//! interrupt is heard ([`guard::look`]). Integers of a few thousand digits go to the library
//! directly.
//!
//! Products are Karatsuba's. Quotients are found by Burnikel and Ziegler's recursion, which takes
//! not much longer than a multiplication; printing and reading divide and multiply by powers of
//! the radix, half the digits at a time.

use num_bigint::{BigInt, BigUint, Sign};
use num_integer::Integer;
use num_traits::{One, Zero};

use crate::guard;

/// Integers of so many bits are multiplied at once: it takes a millisecond.
const MULTIPLIED_AT_ONCE: u64 = 1 << 17;
/// Divisors of so many bits are divided by at once, in pieces as long.
const DIVIDED_AT_ONCE: u64 = 1 << 14;
/// Bits of integers whose digits are found, and whose common divisor is found, at once.
const CONVERTED_AT_ONCE: u64 = 1 << 14;
/// Steps of the search for a common divisor between two looks.
const STEPS: usize = 64;

/// The product.
pub(crate) fn multiply(a: &BigInt, b: &BigInt) -> BigInt {
    if a.bits().min(b.bits()) <= MULTIPLIED_AT_ONCE && a.bits().max(b.bits()) <= MULTIPLIED_AT_ONCE
    {
        return a * b;
    }
    let sign = a.sign() * b.sign();
    BigInt::from_biguint(sign, product(a.magnitude(), b.magnitude()))
}

fn product(a: &BigUint, b: &BigUint) -> BigUint {
    let (long, short) = if a.bits() < b.bits() { (b, a) } else { (a, b) };
    if long.bits() <= MULTIPLIED_AT_ONCE || short.bits() <= 64 {
        guard::look();
        return long * short;
    }
    let half = long.bits().div_ceil(2);
    let (high, low) = split(long, half);
    if short.bits() <= half {
        return (product(&high, short) << half) + product(&low, short);
    }
    let (other_high, other_low) = split(short, half);
    let top = product(&high, &other_high);
    let bottom = product(&low, &other_low);
    let middle = product(&(high + low), &(other_high + other_low)) - &top - &bottom;
    (((top << half) + middle) << half) + bottom
}

/// The bits from the given one on, and those below.
fn split(n: &BigUint, at: u64) -> (BigUint, BigUint) {
    let high = n >> at;
    let low = n - (&high << at);
    (high, low)
}

/// `base` to the power of `exponent`.
pub(crate) fn power(base: &BigInt, mut exponent: u64) -> BigInt {
    let mut result = BigInt::one();
    let mut square = base.clone();
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = multiply(&result, &square);
        }
        exponent >>= 1;
        if exponent > 0 {
            square = multiply(&square, &square);
        }
    }
    result
}

/// Quotient, rounded towards zero, and remainder. The divisor is not zero.
pub(crate) fn divide(a: &BigInt, b: &BigInt) -> (BigInt, BigInt) {
    if a.bits().saturating_sub(b.bits()).min(b.bits()) <= DIVIDED_AT_ONCE
        && a.bits() <= MULTIPLIED_AT_ONCE
    {
        return a.div_rem(b);
    }
    let (quotient, rest) = quotient(a.magnitude(), b.magnitude());
    (
        BigInt::from_biguint(a.sign() * b.sign(), quotient),
        BigInt::from_biguint(a.sign(), rest),
    )
}

/// Quotient, rounded downwards, and remainder. The divisor is not zero.
pub(crate) fn divide_down(a: &BigInt, b: &BigInt) -> (BigInt, BigInt) {
    let (quotient, rest) = divide(a, b);
    if rest.is_zero() || rest.sign() == b.sign() {
        (quotient, rest)
    } else {
        (quotient - 1, rest + b)
    }
}

fn quotient(a: &BigUint, b: &BigUint) -> (BigUint, BigUint) {
    if a < b {
        return (BigUint::zero(), a.clone());
    }
    // The divisor becomes one digit of so many bits, which halve evenly down to where the library
    // takes over, and the highest of which is set.
    let mut unit = b.bits();
    let mut halvings = 0_u32;
    while unit > DIVIDED_AT_ONCE {
        unit = unit.div_ceil(2);
        halvings += 1;
    }
    let size = unit << halvings;
    let shift = size - b.bits();
    let divisor = b << shift;
    let dividend = a << shift;
    let digits = dividend.bits() / size + 1;
    let mut quotient = BigUint::zero();
    let mut rest = BigUint::zero();
    for digit in (0..digits).rev() {
        let (_, next_digit) = split(&(&dividend >> (digit * size)), size);
        let (next, left) = two_by_one(&((rest << size) + next_digit), &divisor, size);
        quotient = (quotient << size) + next;
        rest = left;
    }
    (quotient, rest >> shift)
}

/// Divides two digits of `size` bits by one, whose highest bit is set and which is more than the
/// higher digit.
fn two_by_one(a: &BigUint, b: &BigUint, size: u64) -> (BigUint, BigUint) {
    if size <= DIVIDED_AT_ONCE {
        guard::look();
        return a.div_rem(b);
    }
    let half = size / 2;
    let (upper, lower) = split(a, size);
    let (third, fourth) = split(&lower, half);
    let parts = split(b, half);
    let (high, rest) = three_by_two(&((upper << half) + third), b, &parts, half);
    let (low, rest) = three_by_two(&((rest << half) + fourth), b, &parts, half);
    ((high << half) + low, rest)
}

/// Divides three digits of `size` bits by two, given as a whole and in parts.
fn three_by_two(
    a: &BigUint,
    b: &BigUint,
    (high, low): &(BigUint, BigUint),
    size: u64,
) -> (BigUint, BigUint) {
    let (upper, lower) = split(a, size);
    let (mut quotient, rest) = if &(&upper >> size) == high {
        // The quotient would have another digit: the largest with one is near enough.
        let largest = (BigUint::one() << size) - 1_u32;
        let rest = &upper - (high << size) + high;
        (largest, rest)
    } else {
        two_by_one(&upper, high, size)
    };
    let mut rest = (rest << size) + lower;
    let excess = product(&quotient, low);
    while rest < excess {
        quotient -= 1_u32;
        rest += b;
    }
    (quotient, rest - excess)
}

/// The largest integer whose square is not above `n`.
pub(crate) fn square_root(n: &BigUint) -> BigUint {
    if n.bits() <= CONVERTED_AT_ONCE {
        return n.sqrt();
    }
    // The root of the upper half of the bits is the upper half of the root; a step of Newton's
    // method gives the rest, or one too many.
    let quarter = n.bits() / 4;
    let upper = square_root(&(n >> (2 * quarter)));
    let near = &upper << quarter;
    let (quotient, _) = quotient(n, &near);
    let mut root: BigUint = (near + quotient) >> 1_u32;
    while &product(&root, &root) > n {
        root -= 1_u32;
    }
    root
}

/// The greatest common divisor.
pub(crate) fn common_divisor(a: &BigInt, b: &BigInt) -> BigInt {
    if a.bits().min(b.bits()) <= CONVERTED_AT_ONCE && a.bits().max(b.bits()) <= MULTIPLIED_AT_ONCE {
        return a.gcd(b);
    }
    let (mut a, mut b) = (a.magnitude().clone(), b.magnitude().clone());
    if a.bits().abs_diff(b.bits()) > DIVIDED_AT_ONCE {
        if a < b {
            std::mem::swap(&mut a, &mut b);
        }
        if !b.is_zero() {
            (_, a) = quotient(&a, &b);
        }
    }
    if a.is_zero() || b.is_zero() {
        return BigInt::from(a + b);
    }
    // Stein's algorithm: differences of odd numbers, halved until they are odd.
    let twos = |n: &BigUint| n.trailing_zeros().unwrap_or(0);
    let shared = twos(&a).min(twos(&b));
    a >>= twos(&a);
    for step in 0_usize.. {
        if step.is_multiple_of(STEPS) {
            guard::look();
        }
        b >>= twos(&b);
        if a > b {
            std::mem::swap(&mut a, &mut b);
        }
        b -= &a;
        if b.is_zero() {
            break;
        }
    }
    BigInt::from(a << shared)
}

/// The digits in a radix from 2 to 36, small letters among them, behind a minus sign if need be.
pub(crate) fn to_text(n: &BigInt, radix: u32) -> String {
    if n.bits() <= CONVERTED_AT_ONCE {
        return n.to_str_radix(radix);
    }
    let sign = if n.sign() == Sign::Minus { "-" } else { "" };
    let mut text = sign.to_owned();
    // The square of the last one is larger than the number.
    let enough = n.bits() / 2 + 2;
    let powers = powers(radix, |_, power| power.bits() >= enough);
    write_digits(n.magnitude(), radix, &powers, false, &mut text);
    text
}

/// The exponent of the smallest power of the radix by which numbers are taken apart.
const SMALLEST: usize = 1024;

/// Powers of the radix with their exponents, each the square of the one before, up to the first
/// that is enough.
fn powers(radix: u32, is_enough: impl Fn(usize, &BigUint) -> bool) -> Vec<(usize, BigUint)> {
    let mut exponent = SMALLEST;
    let mut power = BigUint::from(radix).pow(1024);
    let mut powers = Vec::new();
    while !is_enough(exponent, &power) {
        let square = product(&power, &power);
        powers.push((exponent, power));
        exponent *= 2;
        power = square;
    }
    powers.push((exponent, power));
    powers
}

/// Writes the digits of a number; with zeros in front, if it is no first one, twice as many as the
/// exponent of the last power.
fn write_digits(
    n: &BigUint,
    radix: u32,
    powers: &[(usize, BigUint)],
    is_padded: bool,
    text: &mut String,
) {
    let Some(((_, power), smaller)) = powers.split_last() else {
        let digits = n.to_str_radix(radix);
        if is_padded {
            text.extend(std::iter::repeat_n(
                '0',
                SMALLEST.saturating_sub(digits.len()),
            ));
        }
        text.push_str(&digits);
        return;
    };
    guard::look();
    if !is_padded && n < power {
        return write_digits(n, radix, smaller, false, text);
    }
    let (high, low) = quotient(n, power);
    write_digits(&high, radix, smaller, is_padded, text);
    write_digits(&low, radix, smaller, true, text);
}

/// The integer of digits in a radix from 2 to 36; the digits have been checked.
pub(crate) fn from_digits(digits: &str, radix: u32) -> BigUint {
    let powers = powers(radix, |exponent, _| 2 * exponent >= digits.len());
    read_digits(digits.as_bytes(), radix, &powers)
}

fn read_digits(digits: &[u8], radix: u32, powers: &[(usize, BigUint)]) -> BigUint {
    let Some(((exponent, power), smaller)) = powers.split_last() else {
        return BigUint::parse_bytes(digits, radix).unwrap_or_default();
    };
    let Some(at) = digits.len().checked_sub(*exponent).filter(|at| *at > 0) else {
        return read_digits(digits, radix, smaller);
    };
    guard::look();
    let (high, low) = digits.split_at(at);
    let high = read_digits(high, radix, powers);
    product(&high, power) + read_digits(low, radix, smaller)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Integers of so many bits without a pattern.
    fn number(bits: u64, seed: u32) -> BigUint {
        let mut words = Vec::new();
        let mut state = seed;
        for _ in 0..bits.div_ceil(32) {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            words.push(state ^ (state >> 15));
        }
        BigUint::new(words) >> (bits.div_ceil(32) * 32 - bits)
    }

    const SIZES: [u64; 7] = [1, 100, 16_000, 16_400, 40_001, 140_000, 300_003];

    #[test]
    fn products_and_quotients_are_those_of_the_library() {
        for (i, a) in SIZES.into_iter().enumerate() {
            for (j, b) in SIZES.into_iter().enumerate() {
                let x = number(a, 3 + i as u32);
                let y = number(b, 7 + j as u32) + 1_u32;
                assert_eq!(product(&x, &y), &x * &y, "{a} {b} bits");
                assert!(quotient(&x, &y) == x.div_rem(&y), "{a} {b} bits");
            }
        }
    }

    #[test]
    fn quotients_whose_digits_are_the_largest_possible() {
        for bits in [20_000_u64, 50_000, 131_072] {
            let ones = (BigUint::one() << (2 * bits)) - 1_u32;
            let divisor = (BigUint::one() << bits) - 1_u32;
            assert!(quotient(&ones, &divisor) == ones.div_rem(&divisor));
            let power = BigUint::one() << bits;
            assert!(
                quotient(&(&power * &power - 1_u32), &power)
                    == (&power * &power - 1_u32).div_rem(&power)
            );
        }
    }

    #[test]
    fn signs_of_quotients_follow_the_rounding() {
        let big = BigInt::from(number(40_000, 1));
        let small = BigInt::from(number(20_000, 2));
        for (a, b) in [
            (big.clone(), small.clone()),
            (-&big, small.clone()),
            (big.clone(), -&small),
            (-&big, -&small),
        ] {
            let (quotient, rest) = divide_down(&a, &b);
            assert_eq!(&quotient * &b + &rest, a);
            assert!(rest.is_zero() || rest.sign() == b.sign());
            assert!(divide(&a, &b) == a.div_rem(&b));
        }
    }

    #[test]
    fn roots_and_common_divisors() {
        for bits in SIZES {
            let root = number(bits, 5);
            let square = product(&root, &root);
            assert_eq!(square_root(&square), root);
            assert_eq!(square_root(&(&square + &root)), root);
            if !root.is_zero() {
                assert_eq!(square_root(&(&square - 1_u32)), &root - 1_u32);
            }
        }
        let shared = number(9_000, 4);
        let a = BigInt::from(&shared * number(20_000, 5));
        let b = BigInt::from(&shared * number(150_000, 6));
        assert_eq!(common_divisor(&a, &b), a.gcd(&b));
        assert_eq!(common_divisor(&a, &BigInt::zero()), a);
    }

    #[test]
    fn digits_are_written_and_read_back() {
        for radix in [2, 10, 36] {
            for bits in [16_000, 16_400, 100_000, 131_073] {
                for n in [
                    number(bits, 9),
                    BigUint::from(radix).pow(4096),
                    BigUint::from(radix).pow(2048) - 1_u32,
                ] {
                    let text = to_text(&BigInt::from(n.clone()), radix);
                    assert!(text == n.to_str_radix(radix), "{radix} {bits}");
                    assert!(from_digits(&text, radix) == n, "{radix} {bits}");
                }
            }
        }
        assert!(to_text(&-BigInt::from(number(20_000, 1)), 10).starts_with('-'));
    }
}
