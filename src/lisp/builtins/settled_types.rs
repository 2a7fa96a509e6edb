//! Operations on types within builtins that cannot wait: the calls that they ask for are made at once.

use crate::evaluator::nested::call_nested;
use crate::image::Image;
use crate::types::parse;
use crate::types::sequence_types::SequenceType;
use crate::types::specifier::{Answers, Stop};
use crate::value::Value;
use crate::value::element_type::ElementType;
use crate::value::raise::Raise;

/// The actual element type of an array that is made for elements of a type.
pub(super) fn element_type(
    image: &mut Image,
    specifier: &Value,
) -> Result<ElementType, Box<Raise>> {
    settle(image, |image, answers| {
        parse::element_type(image, specifier, answers)
    })
}

/// The sequence type that a type specifier denotes; an error if it is not a kind of sequence.
pub(super) fn sequence_type(
    image: &mut Image,
    specifier: &Value,
) -> Result<SequenceType, Box<Raise>> {
    settle(image, |image, answers| {
        SequenceType::new(image, specifier, answers)
    })
}

fn settle<T>(
    image: &mut Image,
    operation: impl Fn(&Image, &mut Answers) -> Result<T, Stop>,
) -> Result<T, Box<Raise>> {
    let mut answers = Answers::default();
    loop {
        match operation(image, &mut answers) {
            Ok(value) => return Ok(value),
            Err(Stop::Raise(raise) | Stop::UnknownType(raise)) => return Err(raise),
            Err(Stop::Call { function, args }) => {
                let answer = call_nested(image, function, args)?;
                answers.add(answer);
            }
        }
    }
}
