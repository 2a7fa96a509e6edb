//! Does a condition match a handler's type?

use crate::evaluator::nested;
use crate::image::Image;
use crate::types::specifier::{Answers, Stop};
use crate::types::typep_with;
use crate::value::Value;
use crate::value::raise::Raise;

pub fn is_of_type(
    image: &mut Image,
    condition: &Value,
    specifier: &Value,
) -> Result<bool, Box<Raise>> {
    if let (Value::Instance(instance), Value::Symbol(name, ..)) = (condition, specifier)
        && instance.is_a(*name)
    {
        return Ok(true);
    }
    let mut answers = Answers::default();
    loop {
        match typep_with(image, condition, specifier, &mut answers) {
            Ok(answer) => return Ok(answer),
            Err(Stop::Raise(raise) | Stop::UnknownType(raise)) => return Err(raise),
            Err(Stop::Call { function, args }) => {
                answers.add(nested::call_nested(image, function, args)?);
            }
        }
    }
}
