//! A data file as a sequence of values with places.

use lexpr::Parser;
use lexpr::datum::Datum;
use lexpr::parse::{KeywordSyntax, Options};

use super::{DataError, DataProblem, Node};

/// The values of a data file.
#[derive(Clone, Debug)]
pub struct DataFile {
    name: String,
    values: Vec<Datum>,
}

impl DataFile {
    /// Reads a text; `file_name` is used only in errors.
    pub fn read(text: &str, file_name: &str) -> Result<Self, DataError> {
        let options = Options::new().with_keyword_syntax(KeywordSyntax::ColonPrefix);
        // From a reader, not from the string: the former counts lines as it goes, while the
        // parser of strings counts them from the start for every single value.
        let mut parser = Parser::from_reader_custom(text.as_bytes(), options);
        let mut values = Vec::new();
        loop {
            match parser.next_datum() {
                Ok(Some(datum)) => values.push(datum),
                Ok(None) => break,
                Err(error) => {
                    let place = error.location();
                    return Err(DataError {
                        file: file_name.to_owned(),
                        line: place.map_or(1, |p| p.line()),
                        column: place.map_or(1, |p| p.column().max(1)),
                        problem: Box::new(DataProblem::Syntax(error.to_string())),
                    });
                }
            }
        }
        Ok(Self {
            name: file_name.to_owned(),
            values,
        })
    }

    /// The values in order.
    pub fn nodes(&self) -> impl Iterator<Item = Node<'_>> {
        self.values
            .iter()
            .map(|d| Node::new(d.as_ref(), &self.name))
    }

    /// An error about the file as a whole.
    pub fn error(&self, problem: DataProblem) -> DataError {
        DataError {
            file: self.name.clone(),
            line: 1,
            column: 1,
            problem: Box::new(problem),
        }
    }
}
