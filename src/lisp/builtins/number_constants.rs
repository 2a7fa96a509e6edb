//! Constants that say how numbers are represented.

use crate::image::Image;
use crate::value::Value;
use crate::value::known;
use crate::value::number;
use crate::value::package::PackageTable;

/// Constants of numbers, and the variable `*random-state*`.
pub(crate) fn define(image: &mut Image) {
    let constants: &[(&str, Value)] = &[
        (
            "MOST-POSITIVE-FIXNUM",
            Value::Int(number::MOST_POSITIVE_FIXNUM),
        ),
        (
            "MOST-NEGATIVE-FIXNUM",
            Value::Int(number::MOST_NEGATIVE_FIXNUM),
        ),
        ("MOST-POSITIVE-SINGLE-FLOAT", Value::Single(f32::MAX)),
        ("MOST-NEGATIVE-SINGLE-FLOAT", Value::Single(f32::MIN)),
        ("MOST-POSITIVE-SHORT-FLOAT", Value::Single(f32::MAX)),
        ("MOST-NEGATIVE-SHORT-FLOAT", Value::Single(f32::MIN)),
        ("MOST-POSITIVE-DOUBLE-FLOAT", Value::Double(f64::MAX)),
        ("MOST-NEGATIVE-DOUBLE-FLOAT", Value::Double(f64::MIN)),
        ("MOST-POSITIVE-LONG-FLOAT", Value::Double(f64::MAX)),
        ("MOST-NEGATIVE-LONG-FLOAT", Value::Double(f64::MIN)),
        (
            "LEAST-POSITIVE-SINGLE-FLOAT",
            Value::Single(f32::from_bits(1)),
        ),
        (
            "LEAST-NEGATIVE-SINGLE-FLOAT",
            Value::Single(-f32::from_bits(1)),
        ),
        (
            "LEAST-POSITIVE-SHORT-FLOAT",
            Value::Single(f32::from_bits(1)),
        ),
        (
            "LEAST-NEGATIVE-SHORT-FLOAT",
            Value::Single(-f32::from_bits(1)),
        ),
        (
            "LEAST-POSITIVE-DOUBLE-FLOAT",
            Value::Double(f64::from_bits(1)),
        ),
        (
            "LEAST-NEGATIVE-DOUBLE-FLOAT",
            Value::Double(-f64::from_bits(1)),
        ),
        (
            "LEAST-POSITIVE-LONG-FLOAT",
            Value::Double(f64::from_bits(1)),
        ),
        (
            "LEAST-NEGATIVE-LONG-FLOAT",
            Value::Double(-f64::from_bits(1)),
        ),
        (
            "LEAST-POSITIVE-NORMALIZED-SINGLE-FLOAT",
            Value::Single(f32::MIN_POSITIVE),
        ),
        (
            "LEAST-NEGATIVE-NORMALIZED-SINGLE-FLOAT",
            Value::Single(-f32::MIN_POSITIVE),
        ),
        (
            "LEAST-POSITIVE-NORMALIZED-SHORT-FLOAT",
            Value::Single(f32::MIN_POSITIVE),
        ),
        (
            "LEAST-NEGATIVE-NORMALIZED-SHORT-FLOAT",
            Value::Single(-f32::MIN_POSITIVE),
        ),
        (
            "LEAST-POSITIVE-NORMALIZED-DOUBLE-FLOAT",
            Value::Double(f64::MIN_POSITIVE),
        ),
        (
            "LEAST-NEGATIVE-NORMALIZED-DOUBLE-FLOAT",
            Value::Double(-f64::MIN_POSITIVE),
        ),
        (
            "LEAST-POSITIVE-NORMALIZED-LONG-FLOAT",
            Value::Double(f64::MIN_POSITIVE),
        ),
        (
            "LEAST-NEGATIVE-NORMALIZED-LONG-FLOAT",
            Value::Double(-f64::MIN_POSITIVE),
        ),
        // The smallest floats that change one when added to it or subtracted from it.
        (
            "SINGLE-FLOAT-EPSILON",
            Value::Single(f32::from_bits(0x3380_0001)),
        ),
        (
            "SINGLE-FLOAT-NEGATIVE-EPSILON",
            Value::Single(f32::from_bits(0x3300_0001)),
        ),
        (
            "SHORT-FLOAT-EPSILON",
            Value::Single(f32::from_bits(0x3380_0001)),
        ),
        (
            "SHORT-FLOAT-NEGATIVE-EPSILON",
            Value::Single(f32::from_bits(0x3300_0001)),
        ),
        (
            "DOUBLE-FLOAT-EPSILON",
            Value::Double(f64::from_bits(0x3CA0_0000_0000_0001)),
        ),
        (
            "DOUBLE-FLOAT-NEGATIVE-EPSILON",
            Value::Double(f64::from_bits(0x3C90_0000_0000_0001)),
        ),
        (
            "LONG-FLOAT-EPSILON",
            Value::Double(f64::from_bits(0x3CA0_0000_0000_0001)),
        ),
        (
            "LONG-FLOAT-NEGATIVE-EPSILON",
            Value::Double(f64::from_bits(0x3C90_0000_0000_0001)),
        ),
    ];
    let state = number::RandomState { generator: None };
    image.define_special(known::V_RANDOM_STATE, Value::foreign(state));
    for (name, value) in constants {
        let sym = image.export_symbol(PackageTable::CL, name);
        image.define_constant(sym, value.clone());
    }
}
