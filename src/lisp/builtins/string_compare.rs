//! Comparison of strings, with and without case.

use std::cmp::Ordering;
use std::rc::Rc;

use super::characters::upcase;
use super::strings::designated;
use crate::builtin::Builtin;
use crate::image::Image;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::raise::Raise;
use crate::value::sequence::{Bounds, Sequence};
use crate::value::string::LispString;

type Outcome = Result<Value, Box<Raise>>;

/// The bounds of the parts of two texts, as they are given.
type Given<'a> = [Option<&'a Value>; 4];

/// How two parts of texts compare, and the index in the first text where they differ.
fn compare(
    image: &Image,
    (string_1, string_2): (&Value, &Value),
    bounds: Given<'_>,
    fold: bool,
) -> Result<(Ordering, usize), Box<Raise>> {
    if let (Value::Str(a), Value::Str(b), [None, None, None, None], false) =
        (string_1, string_2, bounds, fold)
        && a.borrow().as_str() == b.borrow().as_str()
    {
        return Ok((Ordering::Equal, a.len()));
    }
    let [start1, end1, start2, end2] = bounds;
    let (from, first) = part(image, string_1, start1, end1)?;
    let (_, second) = part(image, string_2, start2, end2)?;
    let case = |c: char| if fold { upcase(c) } else { c };
    let mut index = from;
    let mut others = second.chars();
    for a in first.chars() {
        let ordering = match others.next() {
            Some(b) => case(a).cmp(&case(b)),
            None => Ordering::Greater,
        };
        if ordering != Ordering::Equal {
            return Ok((ordering, index));
        }
        index += 1;
    }
    let ordering = match others.next() {
        Some(_) => Ordering::Less,
        None => Ordering::Equal,
    };
    Ok((ordering, index))
}

fn part(
    image: &Image,
    designator: &Value,
    start: Option<&Value>,
    end: Option<&Value>,
) -> Result<(usize, String), Box<Raise>> {
    let text = designated(image, designator)?;
    if start.is_none() && end.is_none() {
        return Ok((0, text));
    }
    let string = Rc::new(LispString::new(text));
    let bounds = Bounds::new(&Sequence::Str(string.clone()), start, end)?;
    Ok((bounds.start, string.slice(bounds.start, bounds.end)))
}

/// A comparison of two texts, whose value is made of the ordering and the index in the first text
/// where they differ.
macro_rules! comparisons {
    ($table:ident: $($function:ident $name:literal $fold:literal $value:expr, $doc:literal $($example:literal)*;)*) => {
        $(
            #[doc = $doc]
            #[doc = ""]
            $(#[doc = $example])*
            #[builtin($name, "string-1 string-2 &key start1 end1 start2 end2")]
            fn $function(
                image: &mut Image,
                string_1: &Value,
                string_2: &Value,
                #[key] start1: Option<&Value>,
                #[key] end1: Option<&Value>,
                #[key] start2: Option<&Value>,
                #[key] end2: Option<&Value>,
            ) -> Outcome {
                let bounds = [start1, end1, start2, end2];
                let (ordering, index) = compare(image, (string_1, string_2), bounds, $fold)?;
                let value: fn(Ordering, usize) -> Value = $value;
                Ok(value(ordering, index))
            }
        )*

        /// Comparisons of strings.
        pub(crate) static $table: &[Builtin] = builtins![$($function),*];
    };
}

/// The index, if the texts are ordered so.
fn index_if(holds: bool, index: usize) -> Value {
    if holds { index.into() } else { Value::NIL }
}

comparisons! {
    TABLE:
    string_eq "STRING=" false |o, _| o.is_eq().into(), "Are two texts the same?" "`(string= 'foo \"FOO\")` => `T`" "`(string= \"foo\" \"foobar\" :end2 3)` => `T`";
    string_equal "STRING-EQUAL" true |o, _| o.is_eq().into(), "Are two texts the same, whatever their case?" "`(string-equal \"foo\" \"FOO\")` => `T`";
}

comparisons! {
    COMPARISONS:
    string_ne "STRING/=" false |o, i| index_if(o.is_ne(), i), "The index where two texts differ, or `NIL`." "`(string/= \"abc\" \"abd\")` => `2`";
    string_lt "STRING<" false |o, i| index_if(o.is_lt(), i), "The index where the first text differs if it comes before the second, or `NIL`." "`(string< \"abc\" \"abd\")` => `2`";
    string_gt "STRING>" false |o, i| index_if(o.is_gt(), i), "The index where the first text differs if it comes after the second, or `NIL`." "`(string> \"b\" \"a\")` => `0`";
    string_le "STRING<=" false |o, i| index_if(o.is_le(), i), "The index where the texts differ, or the length, unless the first comes after the second." "`(string<= \"a\" \"a\")` => `1`";
    string_ge "STRING>=" false |o, i| index_if(o.is_ge(), i), "The index where the texts differ, or the length, unless the first comes before the second." "`(string>= \"b\" \"a\")` => `0`";
    string_not_equal "STRING-NOT-EQUAL" true |o, i| index_if(o.is_ne(), i), "Like `string/=`, whatever the case." "`(string-not-equal \"a\" \"A\")` => `NIL`";
    string_lessp "STRING-LESSP" true |o, i| index_if(o.is_lt(), i), "Like `string<`, whatever the case." "`(string-lessp \"ABC\" \"abd\")` => `2`";
    string_greaterp "STRING-GREATERP" true |o, i| index_if(o.is_gt(), i), "Like `string>`, whatever the case." "`(string-greaterp \"b\" \"A\")` => `0`";
    string_not_greaterp "STRING-NOT-GREATERP" true |o, i| index_if(o.is_le(), i), "Like `string<=`, whatever the case." "`(string-not-greaterp \"a\" \"A\")` => `1`";
    string_not_lessp "STRING-NOT-LESSP" true |o, i| index_if(o.is_ge(), i), "Like `string>=`, whatever the case." "`(string-not-lessp \"a\" \"A\")` => `1`";
}
