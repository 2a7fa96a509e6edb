//! Checksums of requests, by which an answer is assigned to its request.

use cram::pose::value::{as_placement, frame_of};
use lisp::image::Image;
use lisp::value::Value;

/// Number of elements of a list that count.
const MOST_ELEMENTS: usize = 32;
/// How deeply lists count.
const DEEPEST: usize = 4;

/// A checksum of the request with that name and these arguments. Of values without a content of
/// their own, only the kind counts.
pub fn checksum(image: &Image, name: &str, args: &[Value]) -> u32 {
    let mut sum = crc32fast::Hasher::new();
    sum.update(name.as_bytes());
    for arg in args {
        add(image, &mut sum, arg, DEEPEST);
    }
    sum.finalize()
}

fn add(image: &Image, sum: &mut crc32fast::Hasher, value: &Value, depth: usize) {
    let mut tagged = |tag: u8, bytes: &[u8]| {
        sum.update(&[tag]);
        sum.update(bytes);
    };
    match value {
        Value::Symbol(sym, ..) => tagged(b's', image.name(*sym).as_bytes()),
        Value::Int(number) => tagged(b'i', &number.to_le_bytes()),
        Value::Single(number) => tagged(b'f', &number.to_bits().to_le_bytes()),
        Value::Double(number) => tagged(b'd', &number.to_bits().to_le_bytes()),
        Value::Char(c) => tagged(b'c', &u32::from(*c).to_le_bytes()),
        Value::Str(text) => tagged(b't', text.borrow().as_bytes()),
        Value::Cons(_) if depth > 0 => {
            tagged(b'(', &[]);
            for item in value.iter_list().take(MOST_ELEMENTS) {
                add(image, sum, &item, depth - 1);
            }
            sum.update(b")");
        }
        Value::Foreign(_) => match as_placement(value) {
            Some(placement) => {
                let numbers = placement.position.0.iter().chain(&placement.orientation.0);
                tagged(b'p', frame_of(value).unwrap_or_default().as_bytes());
                for number in numbers {
                    sum.update(&number.to_bits().to_le_bytes());
                }
            }
            None => tagged(b'o', &[]),
        },
        _ => tagged(b'?', &[]),
    }
}
