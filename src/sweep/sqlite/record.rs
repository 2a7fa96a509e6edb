//! Rows as SQLite stores them: a header of types, then the values.

use crate::line::Field;

/// What SQLite makes of values that are stored in a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Affinity {
    /// Nothing.
    Any,
    /// Whole numbers.
    Integer,
    /// Numbers, whole ones without a fraction.
    Numeric,
    /// Numbers.
    Real,
    /// Texts.
    Text,
}

impl Affinity {
    /// The type of a column in a CREATE TABLE statement.
    pub(super) fn declared(self) -> &'static str {
        match self {
            Affinity::Any => "",
            Affinity::Integer => " INTEGER",
            Affinity::Numeric => " NUMERIC",
            Affinity::Real => " REAL",
            Affinity::Text => " TEXT",
        }
    }

    /// The value as SQLite itself would store it in such a column.
    fn stored<'v>(self, value: &'v Field<'_>) -> Stored<'v> {
        let value = match value {
            Field::Null => return Stored::Null,
            Field::Bool(is) => Stored::Int(i64::from(*is)),
            Field::Int(int) => Stored::Int(*int),
            Field::Number(number) if number.is_finite() => Stored::Real(*number),
            Field::Number(_) => return Stored::Null,
            Field::Text(text) => Stored::Text(text.as_bytes().into()),
            Field::Nested(json) => Stored::Text(json.to_string().into_bytes().into()),
        };
        match (self, value) {
            (Affinity::Any, value) => value,
            (Affinity::Text, Stored::Int(int)) => Stored::Text(int.to_string().into_bytes().into()),
            (Affinity::Text, Stored::Real(number)) => {
                Stored::Text(format!("{number:?}").into_bytes().into())
            }
            (Affinity::Text, value) => value,
            (affinity, Stored::Text(text)) => match number_of(&text) {
                Some(number) => affinity.of_number(number),
                None => Stored::Text(text),
            },
            (affinity, value) => affinity.of_number(value),
        }
    }

    fn of_number<'v>(self, value: Stored<'v>) -> Stored<'v> {
        match (self, value) {
            (Affinity::Real, Stored::Int(int)) => Stored::Real(int as f64),
            (Affinity::Integer | Affinity::Numeric, Stored::Real(number))
                // Numbers with so many digits have no fraction in any case.
                if number.fract() == 0.0 && number.abs() < 9e15 =>
            {
                Stored::Int(number as i64)
            }
            (_, value) => value,
        }
    }
}

/// The number that a text looks like, if it does.
fn number_of(text: &[u8]) -> Option<Stored<'static>> {
    let text = std::str::from_utf8(text).ok()?;
    let text = text.trim_matches([' ', '\t', '\n', '\u{b}', '\u{c}', '\r']);
    if text.is_empty()
        || !text
            .bytes()
            .all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b))
    {
        return None;
    }
    if let Ok(int) = text.parse::<i64>() {
        return Some(Stored::Int(int));
    }
    let number = text.parse::<f64>().ok();
    number.filter(|number| number.is_finite()).map(Stored::Real)
}

/// A value as it is stored.
enum Stored<'v> {
    Null,
    Int(i64),
    Real(f64),
    Text(std::borrow::Cow<'v, [u8]>),
}

impl Stored<'_> {
    /// The number of its type, which tells its length, too.
    fn serial_type(&self) -> u64 {
        match self {
            Stored::Null => 0,
            Stored::Int(0) => 8,
            Stored::Int(1) => 9,
            Stored::Int(int) => match bytes_of(*int) {
                count @ 1..=4 => count as u64,
                6 => 5,
                _ => 6,
            },
            Stored::Real(_) => 7,
            Stored::Text(text) => 13 + 2 * text.len() as u64,
        }
    }

    fn write(&self, to: &mut Vec<u8>) {
        match self {
            Stored::Null | Stored::Int(0 | 1) => {}
            Stored::Int(int) => {
                let bytes = int.to_be_bytes();
                to.extend(bytes.iter().skip(8 - bytes_of(*int)));
            }
            Stored::Real(number) => to.extend(number.to_be_bytes()),
            Stored::Text(text) => to.extend_from_slice(text),
        }
    }
}

/// How many bytes a whole number takes.
fn bytes_of(int: i64) -> usize {
    [1, 2, 3, 4, 6]
        .into_iter()
        .find(|bytes| {
            let limit = 1_i64 << (8 * bytes - 1);
            (-limit..limit).contains(&int)
        })
        .unwrap_or(8)
}

/// Appends a number in as few groups of seven bits as it needs; of the ninth, all eight count.
pub(super) fn push_varint(to: &mut Vec<u8>, number: u64) {
    let groups = (1..9).find(|groups| number < 1 << (7 * groups));
    match groups {
        Some(groups) => {
            for group in (0..groups).rev() {
                let more = if group > 0 { 0x80 } else { 0 };
                to.push((number >> (7 * group)) as u8 & 0x7f | more);
            }
        }
        None => {
            for group in (0..8).rev() {
                to.push((number >> (7 * group + 8)) as u8 & 0x7f | 0x80);
            }
            to.push(number as u8);
        }
    }
}

/// Writes a row into an empty buffer: values, each with the affinity of its column, and whether it is a name, which is
/// stored in lower case.
pub(super) fn encode<'v>(
    to: &mut Vec<u8>,
    values: impl Iterator<Item = (Affinity, bool, &'v Field<'v>)>,
) {
    let stored = |(affinity, is_name, value): (Affinity, bool, &'v Field<'v>)| {
        let mut stored = affinity.stored(value);
        if let Stored::Text(text) = &mut stored
            && is_name
            && text.iter().any(u8::is_ascii_uppercase)
        {
            text.to_mut().make_ascii_lowercase();
        }
        stored
    };
    let values: Vec<Stored<'_>> = values.map(stored).collect();
    let mut types = Vec::with_capacity(2 * values.len());
    for value in &values {
        push_varint(&mut types, value.serial_type());
    }
    // The length of the header counts its own bytes.
    let own = (1..9).find(|own| types.len() as u64 + own < 1 << (7 * own));
    push_varint(to, types.len() as u64 + own.unwrap_or(9));
    to.append(&mut types);
    for value in &values {
        value.write(to);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::borrow::Cow;

    fn row(affinity: Affinity, value: Field<'_>) -> Vec<u8> {
        let mut to = Vec::new();
        encode(&mut to, [(affinity, false, &value)].into_iter());
        to
    }

    #[test]
    fn whole_numbers_take_as_few_bytes_as_they_need() {
        for (int, expected) in [
            (0, &[2, 8][..]),
            (1, &[2, 9]),
            (-1, &[2, 1, 0xff]),
            (128, &[2, 2, 0, 128]),
            (-32769, &[2, 3, 0xff, 0x7f, 0xff]),
            (1 << 40, &[2, 5, 1, 0, 0, 0, 0, 0]),
            ((1 << 53) + 1, &[2, 6, 0, 0x20, 0, 0, 0, 0, 0, 1]),
        ] {
            assert_eq!(row(Affinity::Integer, Field::Int(int)), expected, "{int}");
        }
    }

    #[test]
    fn values_are_stored_as_the_type_of_their_column_says() {
        let text = |text| Field::Text(Cow::Borrowed(text));
        assert_eq!(
            row(Affinity::Real, Field::Int(2)),
            [2, 7, 0x40, 0, 0, 0, 0, 0, 0, 0]
        );
        assert_eq!(row(Affinity::Numeric, Field::Number(3.0)), [2, 1, 3]);
        assert_eq!(row(Affinity::Integer, text(" 12 ")), [2, 1, 12]);
        assert_eq!(
            row(Affinity::Integer, text("12 m")),
            [2, 21, b'1', b'2', b' ', b'm']
        );
        assert_eq!(row(Affinity::Text, Field::Int(7)), [2, 15, b'7']);
        assert_eq!(row(Affinity::Any, text("7")), [2, 15, b'7']);
        assert_eq!(row(Affinity::Any, Field::Bool(true)), [2, 9]);
        assert_eq!(row(Affinity::Text, text("a\0b")), [2, 19, b'a', 0, b'b']);
    }

    #[test]
    fn lengths_are_written_in_groups_of_seven_bits() {
        let varint = |number| {
            let mut to = Vec::new();
            push_varint(&mut to, number);
            to
        };
        assert_eq!(varint(127), [0x7f]);
        assert_eq!(varint(128), [0x81, 0]);
        assert_eq!(varint(u64::MAX), [0xff; 9]);
        assert_eq!(
            varint(1 << 56),
            [0x80, 0xc0, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0]
        );
    }
}
