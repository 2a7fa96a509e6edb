//! One value of a data file with its place.

use lexpr::datum::Ref;

use super::{DataError, DataProblem};

/// A value and its place.
#[derive(Clone, Copy, Debug)]
pub struct Node<'a> {
    datum: Ref<'a>,
    file: &'a str,
}

impl<'a> Node<'a> {
    pub(super) fn new(datum: Ref<'a>, file: &'a str) -> Self {
        Self { datum, file }
    }

    /// An error about this value.
    pub fn error(&self, problem: DataProblem) -> DataError {
        let start = self.datum.span().start();
        DataError {
            file: self.file.to_owned(),
            line: start.line(),
            column: start.column(),
            problem: Box::new(problem),
        }
    }

    /// The error that a value of another kind was expected.
    pub fn expected(&self, expected: &str) -> DataError {
        self.error(DataProblem::Unexpected {
            expected: expected.to_owned(),
            found: self.datum.value().to_string(),
        })
    }

    /// The error that there is no such `kind` of thing; `closest` is the nearest known name.
    pub fn unknown(&self, kind: &str, name: &str, closest: Option<&str>) -> DataError {
        self.error(DataProblem::UnknownName {
            kind: kind.to_owned(),
            name: name.to_owned(),
            closest: closest.map(str::to_owned),
        })
    }

    /// The name of a symbol.
    pub fn symbol(&self) -> Result<&'a str, DataError> {
        let value = self.datum.value();
        value.as_symbol().ok_or_else(|| self.expected("a name"))
    }

    /// A text between quotes.
    pub fn text(&self) -> Result<&'a str, DataError> {
        let text = self.datum.value().as_str();
        text.ok_or_else(|| self.expected("a text between quotes"))
    }

    /// The name of a keyword without its colon.
    pub(crate) fn as_keyword(&self) -> Option<&'a str> {
        self.datum.value().as_keyword()
    }

    /// A finite number.
    pub fn number(&self) -> Result<f64, DataError> {
        let number = self.datum.value().as_f64().filter(|n| n.is_finite());
        number.ok_or_else(|| self.expected("a number"))
    }

    /// A finite number greater than zero.
    pub fn positive(&self) -> Result<f64, DataError> {
        let number = self.number().ok().filter(|n| *n > 0.0);
        number.ok_or_else(|| self.expected("a number above 0"))
    }

    /// A whole number greater than zero.
    pub fn count(&self) -> Result<usize, DataError> {
        let count = self.datum.value().as_u64().filter(|n| *n > 0);
        let count = count.and_then(|n| usize::try_from(n).ok());
        count.ok_or_else(|| self.expected("a whole number above 0"))
    }

    /// The elements of a list.
    pub fn list(&self) -> Result<Vec<Node<'a>>, DataError> {
        if !self.datum.value().is_list() {
            return Err(self.expected("a list"));
        }
        // In lexpr, the empty list has no list iterator.
        let items = self.datum.list_iter().into_iter().flatten();
        Ok(items.map(|d| Node::new(d, self.file)).collect())
    }

    /// A list of exactly `N` finite numbers.
    pub fn numbers<const N: usize>(&self) -> Result<[f64; N], DataError> {
        let wrong = || self.expected(&format!("a list of {N} numbers"));
        let items = self.list().map_err(|_| wrong())?;
        let numbers: Vec<f64> = items.iter().map(Node::number).collect::<Result<_, _>>()?;
        numbers.try_into().map_err(|_| wrong())
    }

    /// A linear colour: red, green, blue and optionally alpha, from 0 to 1.
    pub fn color(&self) -> Result<[f32; 4], DataError> {
        let wrong = || self.expected("three or four numbers from 0 to 1 (red green blue alpha)");
        let parts = self.list().map_err(|_| wrong())?;
        let mut color = [1.0; 4];
        if parts.len() < 3 || parts.len() > 4 {
            return Err(wrong());
        }
        for (channel, part) in color.iter_mut().zip(parts) {
            let value = part.number()?;
            if !(0.0..=1.0).contains(&value) {
                return Err(part.expected("a number from 0 to 1"));
            }
            *channel = value as f32;
        }
        Ok(color)
    }

    /// A list of names.
    pub fn symbols(&self) -> Result<Vec<&'a str>, DataError> {
        self.list()?.iter().map(Node::symbol).collect()
    }

    /// The head of a record: the symbol that its list begins with.
    pub fn head(&self) -> Result<&'a str, DataError> {
        let wrong = || self.expected("a record (name … :key value …)");
        let items = self.list().map_err(|_| wrong())?;
        let head = items.first().ok_or_else(wrong)?;
        head.symbol().map_err(|_| wrong())
    }
}
