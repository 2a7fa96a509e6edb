//! What can be wrong with a text.

use thiserror::Error;

use super::char_name::char_name;
use crate::source::Place;
use crate::value::known;
use crate::value::raise::Raise;

/// Why a text cannot be read, and where.
#[derive(Clone, PartialEq, Debug, Error)]
#[error("{kind}{}", swallowed(comment.as_deref()))]
pub struct ReadError {
    /// What is wrong.
    pub kind: ReadErrorKind,
    /// If a comment may have swallowed parentheses: where, and what.
    pub comment: Option<Box<str>>,
    /// First byte of the wrong text.
    pub start: usize,
    /// Byte after the wrong text.
    pub end: usize,
    /// The same as a place; none if the text belongs to no registered source.
    pub place: Place,
}

/// What is wrong with a text.
#[derive(Clone, PartialEq, Debug, Error)]
pub enum ReadErrorKind {
    /// The text ends inside something.
    #[error("end of file{}", inside(what, *line))]
    EndOfFile {
        /// What is unfinished: `a list`, `a string`, …; none before any form.
        what: Option<&'static str>,
        /// Line where that begins, from one.
        line: usize,
        /// Byte where that begins.
        opened_at: usize,
    },
    /// A `)` closes nothing.
    #[error("unmatched close parenthesis")]
    UnmatchedClose,
    /// `foo:bar`, but there is no package `FOO`.
    #[error("Package {name} does not exist.{}", did_you_mean(nearest.as_deref()))]
    NoPackage {
        name: String,
        /// A similar name that exists.
        nearest: Option<String>,
    },
    /// `package:symbol`, but the package has no such symbol.
    #[error("Symbol \"{name}\" not found in the {package} package.{}", did_you_mean(nearest.as_deref()))]
    NoSymbol {
        /// The symbol's name.
        name: String,
        /// The package's name.
        package: String,
        /// A similar external symbol.
        nearest: Option<String>,
    },
    /// `package:symbol`, but the symbol is internal.
    #[error("The symbol \"{name}\" is not external in the {package} package.")]
    NotExternal {
        /// The symbol's name.
        name: String,
        /// The package's name.
        package: String,
    },
    /// More package markers than a symbol can have.
    #[error("too many colons in \"{token}\"")]
    TooManyColons {
        /// The token.
        token: String,
    },
    /// A character that symbols and numbers cannot have unless it is escaped.
    #[error("invalid constituent character: #\\{}", named(*.0))]
    InvalidConstituent(char),
    /// `package:` without a name.
    #[error("illegal terminating character after a colon in \"{token}\"")]
    NoNameAfterColon {
        /// The token.
        token: String,
    },
    /// `.` where no dotted pair can be.
    #[error("dot context error")]
    DotContext,
    /// `..` or longer.
    #[error("too many dots")]
    TooManyDots,
    /// `( . x)`.
    #[error("Nothing appears before . in list.")]
    NothingBeforeDot,
    /// `(x . )`.
    #[error("Nothing appears after . in list.")]
    NothingAfterDot,
    /// `(x . y z)`.
    #[error("More than one object follows . in list.")]
    MoreAfterDot,
    /// A `)` where a quote waits for its object.
    #[error("nothing appears after {prefix} before the closing parenthesis")]
    NothingAfterPrefix {
        /// The quote character or dispatch macro.
        prefix: String,
    },
    /// `,x` outside backquote.
    #[error("Comma not inside a backquote.")]
    CommaOutsideBackquote,
    /// `0,9` outside backquote.
    #[error("{written} has a decimal comma; Lisp writes {instead}")]
    DecimalComma {
        written: String,
        /// What to write.
        instead: String,
    },
    /// A number with a dash that is no minus sign of Lisp.
    #[error("{written} is written with {dash}, which is no minus sign of Lisp; write {instead}")]
    Dash {
        written: String,
        /// The dash, with its code.
        dash: String,
        /// What to write.
        instead: String,
    },
    /// `,@x` right after a backquote, or in place of a dotted tail.
    #[error("{prefix} after {before}: there is no list to splice into")]
    NothingToSpliceInto {
        /// `,@` or `,.`
        prefix: &'static str,
        /// `backquote` or `dot`.
        before: &'static str,
    },
    /// `#<`, which nothing can read back.
    #[error("illegal sharp macro character: #\\{}", named(*.0))]
    IllegalDispatch(char),
    /// A letter after `#` that means nothing.
    #[error("no dispatch function defined for #\\{}", named(*.0))]
    UnknownDispatch(char),
    /// `#'` and the like with an unexpected or missing number.
    #[error("#{letter} needs a number before the letter: {reason}")]
    DispatchArgument {
        letter: char,
        /// What the number must be.
        reason: &'static str,
    },
    /// A character name that does not exist.
    #[error("unrecognized character name: {0}")]
    UnknownCharacter(String),
    /// A token of digits that is not a number in the radix.
    #[error("#{letter} value is not a rational: \"{token}\" (radix {radix})")]
    NotRational {
        /// The letter after `#`.
        letter: char,
        token: String,
        radix: u32,
    },
    /// A ratio with the denominator zero.
    #[error("failed to build a number from {0}: division by zero")]
    ZeroDenominator(String),
    /// A float outside the range of its format.
    #[error("floating-point-{direction} reading {token}")]
    FloatRange {
        token: String,
        /// `overflow` or `underflow`.
        direction: &'static str,
    },
    /// `#*` with something other than bits, or with too many.
    #[error("illegal bit vector: {0}")]
    BadBits(String),
    /// More elements than the number before `#(` says.
    #[error("Vector is longer than the specified length: {given} elements, {length} expected.")]
    VectorTooLong {
        /// Elements given.
        given: usize,
        /// The number before the parenthesis.
        length: usize,
    },
    /// A number before `#(` beyond reason.
    #[error("a vector of {length} elements is too large")]
    VectorTooLarge {
        /// The number before the parenthesis.
        length: usize,
    },
    /// `#3()`: no element to repeat.
    #[error("Vector of length {0} can't be initialized from an empty list.")]
    VectorEmpty(usize),
    /// The contents of `#nA` do not make a rectangle.
    #[error("the contents of #{rank}A do not have {rank} dimensions of equal lengths")]
    NotRectangular {
        /// Number of dimensions.
        rank: u32,
    },
    /// `#S` of something that is not a structure.
    #[error("#S: {0}")]
    BadStructure(String),
    /// A feature expression that means nothing.
    #[error("illegal feature expression")]
    BadFeature,
    /// `#.` while `*read-eval*` is false.
    #[error("can't read #. while *READ-EVAL* is NIL")]
    ReadEvalDisabled,
    /// `#.` where evaluation is not possible.
    #[error("#. cannot be evaluated here")]
    CannotEvaluate,
    /// `#n=` of a label that is taken, or `#n#` of one that does not exist.
    #[error("{0}")]
    BadLabel(String),
    /// `#C` of something other than two real numbers.
    #[error("#C: {0}")]
    BadComplex(&'static str),
    /// `#A` without a number, and not before what it needs.
    #[error("#A without the number of dimensions needs (DIMENSIONS TYPE . CONTENTS): {0}")]
    BadArray(&'static str),
    /// A quotation mark of a word processor.
    #[error("{mark} is a typographic quotation mark; Lisp text uses {instead}")]
    SmartQuote {
        mark: char,
        /// What to write.
        instead: &'static str,
    },
}

fn inside(what: &Option<&'static str>, line: usize) -> String {
    match what {
        Some(what) => format!(" in {what} that starts on line {line}"),
        None => String::new(),
    }
}

fn swallowed(comment: Option<&str>) -> String {
    match comment {
        Some(comment) => format!(". {comment}"),
        None => String::new(),
    }
}

fn did_you_mean(nearest: Option<&str>) -> String {
    match nearest {
        Some(name) => format!(" Did you mean {name}?"),
        None => String::new(),
    }
}

impl ReadError {
    /// Would more text help?
    pub fn is_end_of_file(&self) -> bool {
        matches!(self.kind, ReadErrorKind::EndOfFile { .. })
    }

    /// The error as a condition: `END-OF-FILE` or `READER-ERROR`.
    pub fn raise(&self) -> Box<Raise> {
        let class = if self.is_end_of_file() {
            known::END_OF_FILE
        } else {
            known::READER_ERROR
        };
        Raise::new(class, self.to_string()).at(self.place)
    }
}

/// What is written after `#\` for a character.
fn named(c: char) -> String {
    char_name(c).unwrap_or_else(|| c.to_string())
}
