//! Directives that print numbers: integers in a radix or in words, floats, and money.

use num_bigint::BigInt;

use super::arguments::{Arguments, Given, MAX_WIDTH, char_of, number_of, width_of};
use super::{Context, Interpreter, Result};
use crate::print::format::directive::Directive;
use crate::print::format::english;
use crate::print::format::error::Problem;
use crate::print::format::float::{self, FloatStyle};
use crate::print::format::integer::{IntegerStyle, integer};
use crate::value::Value;
use crate::value::known;
use crate::value::number;
use crate::value::raise::Raise;

impl Interpreter<'_> {
    pub(super) fn integer(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
        radix: u32,
    ) -> Result<()> {
        let given = self.parameters(c, d, args)?;
        let value = self.next(c, d, args)?;
        self.write_integer(d, &given, &value, radix)
    }

    /// Parameters: width, padding, comma character, comma interval.
    fn write_integer(
        &mut self,
        d: &Directive,
        given: &[Option<Given>],
        value: &Value,
        radix: u32,
    ) -> Result<()> {
        let comma = char_of(given, 2)?.unwrap_or(',');
        let interval = width_of(given, 3)?.unwrap_or(3);
        let style = IntegerStyle {
            radix,
            width: width_of(given, 0)?.unwrap_or(0),
            pad: char_of(given, 1)?.unwrap_or(' '),
            comma: d.colon.then_some((comma, interval)),
            sign: d.at,
        };
        match number::to_big(value) {
            Some(n) => self.output.push(&integer(&n, &style)),
            None => {
                let mut settings = self.settings.clone().with_escape(false);
                settings.base = radix;
                settings.radix = false;
                self.write(value, &settings);
            }
        }
        Ok(())
    }

    pub(super) fn radix(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
    ) -> Result<()> {
        let given = self.parameters(c, d, args)?;
        let value = self.next(c, d, args)?;
        if let Some(radix) = number_of(&given, 0)? {
            let radix = u32::try_from(radix).unwrap_or(0);
            if !(2..=36).contains(&radix) {
                let problem = Problem::Argument(format!("{radix} is not a radix from 2 to 36."));
                return Err(c.error(d, problem));
            }
            return self.write_integer(d, given.get(1..).unwrap_or(&[]), &value, radix);
        }
        let n: BigInt =
            number::to_big(&value).ok_or_else(|| Raise::type_error(&value, known::INTEGER))?;
        let words = match (d.colon, d.at) {
            (false, false) => english::cardinal(&n),
            (true, false) => english::ordinal(&n),
            (old, true) => english::roman(&n, old),
        };
        match words {
            Some(words) => self.output.push(&words),
            None => {
                let how = if d.at { "Roman numerals" } else { "English" };
                let problem = Problem::Argument(format!("Number out of range for {how}: {n}"));
                return Err(c.error(d, problem));
            }
        }
        Ok(())
    }

    /// The number that a float directive prints: rationals become single floats.
    fn float_argument(&mut self, value: &Value) -> Result<Option<Value>> {
        match value {
            Value::Single(x) if x.is_finite() => Ok(Some(value.clone())),
            Value::Double(x) if x.is_finite() => Ok(Some(value.clone())),
            rational if number::is_rational(rational) => number::to_single(rational)
                .or_else(|_| number::to_double(rational))
                .map(Some),
            _ => Ok(None),
        }
    }

    pub(super) fn float(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
    ) -> Result<()> {
        let given = self.parameters(c, d, args)?;
        let value = self.next(c, d, args)?;
        let at =
            |index| number_of(&given, index).map(|n| n.map(|n| n.clamp(-MAX_WIDTH, MAX_WIDTH)));
        let mut style = FloatStyle {
            width: at(0)?,
            places: at(1)?.map(|n| n.max(0)),
            sign: d.at,
            ..FloatStyle::default()
        };
        if d.letter == 'F' {
            style.scale = at(2)?;
            style.overflow = char_of(&given, 3)?;
            style.pad = char_of(&given, 4)?;
        } else {
            style.exponent = at(2)?;
            style.scale = at(3)?;
            style.overflow = char_of(&given, 4)?;
            style.pad = char_of(&given, 5)?;
            style.marker = char_of(&given, 6)?;
        }
        let Some(x) = self.float_argument(&value)? else {
            self.padded_left(&value, style.width.unwrap_or(0));
            return Ok(());
        };
        let text = match d.letter {
            'F' => float::fixed(&x, &style),
            'E' => float::exponential(&x, &style, self.settings.float_format),
            _ => float::general(&x, &style, self.settings.float_format),
        };
        self.output.push(&text);
        Ok(())
    }

    /// Prints a value that is not a number as by `princ`, right-aligned in its field.
    fn padded_left(&mut self, value: &Value, width: i64) {
        let settings = self.settings.clone().with_escape(false);
        let text = self.text_of(value, &settings);
        let width = usize::try_from(width).unwrap_or(0);
        self.output
            .repeat(' ', width.saturating_sub(text.chars().count()));
        self.output.push(&text);
    }

    pub(super) fn money(
        &mut self,
        c: Context<'_>,
        d: &Directive,
        args: &mut Arguments,
    ) -> Result<()> {
        let given = self.parameters(c, d, args)?;
        let value = self.next(c, d, args)?;
        let at = |index| number_of(&given, index).map(|n| n.map(|n| n.clamp(0, MAX_WIDTH)));
        let style = FloatStyle {
            width: at(2)?,
            pad: char_of(&given, 3)?,
            sign: d.at,
            ..FloatStyle::default()
        };
        let Some(x) = self.float_argument(&value)? else {
            self.padded_left(&value, style.width.unwrap_or(0));
            return Ok(());
        };
        let places = at(0)?.unwrap_or(2);
        let before = at(1)?.unwrap_or(1);
        self.output
            .push(&float::money(&x, places, before, &style, d.colon));
        Ok(())
    }
}
