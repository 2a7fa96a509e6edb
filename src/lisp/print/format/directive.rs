//! From a control string to directives.

use super::error::{FormatError, Problem};

/// The deepest nesting of directives.
const MAX_DEPTH: usize = 100;

/// What is wrong with directives for the pretty printer beside justification.
const JUSTIFIED_LAYOUT: &str = "~W, ~_, ~I, ~:T and ~<...~:> cannot be inside ~<...~>, nor in a control string with ~<...~:;...~>.";

/// A part of a control string.
pub(super) enum Piece {
    Text(String),
    Directive(Directive),
}

/// A parameter of a directive.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Parameter {
    /// Not given.
    None,
    Number(i64),
    Char(char),
    /// `v`: the next argument.
    Argument,
    /// `#`: the number of arguments left.
    Count,
}

/// One directive.
pub(super) struct Directive {
    /// In upper case.
    pub(super) letter: char,
    pub(super) colon: bool,
    pub(super) at: bool,
    pub(super) parameters: Vec<Parameter>,
    /// The index of its letter in the control string.
    pub(super) position: usize,
    /// What it encloses, split at `~;`.
    pub(super) clauses: Vec<Clause>,
    /// The directive that closes it, of those that enclose something.
    pub(super) close: Option<Close>,
    /// The name of `~/name/`.
    pub(super) name: String,
}

/// A part of an enclosing directive, and the `~;` after it.
pub(super) struct Clause {
    pub(super) pieces: Vec<Piece>,
    /// The colon, at sign and parameters of the `~;` after it, if there is one.
    pub(super) separator: Option<(bool, bool, Vec<Parameter>)>,
}

/// Modifiers of a closing directive.
#[derive(Clone, Copy)]
pub(super) struct Close {
    pub(super) colon: bool,
    pub(super) at: bool,
}

struct Parser<'t> {
    control: &'t str,
    chars: Vec<char>,
    next: usize,
    /// The number of directives for the pretty printer so far.
    layouts: usize,
    /// The index of the first `~<…~:;…~>`.
    overflow: Option<usize>,
}

impl Directive {
    /// Is it for the pretty printer? Then it does not go together with justification.
    fn is_for_layout(&self) -> bool {
        match self.letter {
            'W' | '_' | 'I' => true,
            'T' => self.colon,
            '<' => self.is_logical_block(),
            _ => false,
        }
    }

    /// Does it enclose nothing?
    pub(super) fn is_empty(&self) -> bool {
        self.clauses.iter().all(|clause| clause.pieces.is_empty())
    }

    /// Is it `~<…~:>`?
    pub(super) fn is_logical_block(&self) -> bool {
        self.close.is_some_and(|close| close.colon)
    }
}

/// How a sequence of pieces ended.
enum End {
    Text,
    Clause(Directive),
    Close(Directive),
}

pub(super) fn parse(control: &str) -> Result<Vec<Piece>, FormatError> {
    let mut parser = Parser {
        control,
        chars: control.chars().collect(),
        next: 0,
        layouts: 0,
        overflow: None,
    };
    let (pieces, end) = parser.pieces(0)?;
    if let Some(position) = parser.overflow.filter(|_| parser.layouts > 0) {
        return Err(parser.error(Problem::Clauses(JUSTIFIED_LAYOUT), position));
    }
    match end {
        End::Text => Ok(pieces),
        End::Clause(directive) => Err(parser.error(Problem::StrayClause, directive.position)),
        End::Close(directive) => {
            let name = bracket_name(directive.letter);
            Err(parser.error(Problem::NotOpened(name), directive.position))
        }
    }
}

fn bracket_name(letter: char) -> &'static str {
    match letter {
        '{' | '}' => "brace",
        '[' | ']' => "bracket",
        '(' | ')' => "parenthesis",
        _ => "bracket of a justification or logical block",
    }
}

/// The most parameters of a directive that encloses nothing, by its letter.
fn most_parameters(letter: char) -> Option<usize> {
    Some(match letter {
        'A' | 'S' | 'D' | 'B' | 'O' | 'X' | '$' => 4,
        'R' | 'F' => 5,
        'E' | 'G' => 7,
        'T' => 2,
        '^' => 3,
        '%' | '&' | '|' | '~' | '*' | 'I' => 1,
        '<' => 4,
        '{' | '[' => 1,
        'C' | 'P' | 'W' | '_' | '?' | '\n' | '(' | ')' | '}' | ']' | '>' => 0,
        ';' => 2,
        '/' => usize::MAX,
        _ => return None,
    })
}

fn closing(letter: char) -> Option<char> {
    Some(match letter {
        '{' => '}',
        '[' => ']',
        '(' => ')',
        '<' => '>',
        _ => return None,
    })
}

impl Parser<'_> {
    fn error(&self, problem: Problem, position: usize) -> FormatError {
        FormatError {
            problem,
            control: self.control.to_owned(),
            position,
        }
    }

    fn pieces(&mut self, depth: usize) -> Result<(Vec<Piece>, End), FormatError> {
        let mut pieces = Vec::new();
        let mut text = String::new();
        let mut leaves_out = false;
        while let Some(c) = self.chars.get(self.next).copied() {
            self.next += 1;
            if c != '~' {
                text.push(c);
                continue;
            }
            let directive = self.directive()?;
            if directive.letter == '\n' {
                self.skip_newline(&directive, &mut text);
                leaves_out = true;
                continue;
            }
            if !text.is_empty() {
                pieces.push(Piece::Text(std::mem::take(&mut text)));
            } else if leaves_out && pieces.is_empty() {
                // What holds a newline that is left out is not empty: `~{~}` without a body would
                // take an argument as its body.
                pieces.push(Piece::Text(String::new()));
            }
            match directive.letter {
                ';' => return Ok((pieces, End::Clause(directive))),
                '}' | ']' | ')' | '>' => return Ok((pieces, End::Close(directive))),
                letter => {
                    let layouts = self.layouts;
                    let directive = match closing(letter) {
                        Some(close) => self.enclosing(directive, close, depth + 1)?,
                        None => directive,
                    };
                    if letter == '<' && !directive.is_logical_block() {
                        self.check_justification(&directive, layouts)?;
                    }
                    self.layouts += usize::from(directive.is_for_layout());
                    pieces.push(Piece::Directive(directive));
                }
            }
        }
        if !text.is_empty() {
            pieces.push(Piece::Text(text));
        }
        Ok((pieces, End::Text))
    }

    /// A tilde before a newline leaves out the newline and the blanks after it; a colon
    /// keeps the blanks, an at sign the newline.
    fn skip_newline(&mut self, directive: &Directive, text: &mut String) {
        if directive.at {
            text.push('\n');
        }
        if !directive.colon {
            while let Some(c) = self.chars.get(self.next)
                && c.is_whitespace()
                && *c != '\n'
            {
                self.next += 1;
            }
        }
    }

    fn enclosing(
        &mut self,
        mut directive: Directive,
        close: char,
        depth: usize,
    ) -> Result<Directive, FormatError> {
        if depth > MAX_DEPTH {
            return Err(self.error(Problem::TooDeep(MAX_DEPTH), directive.position));
        }
        loop {
            let (pieces, end) = self.pieces(depth)?;
            match end {
                End::Clause(separator) if matches!(close, ']' | '>') => {
                    directive.clauses.push(Clause {
                        pieces,
                        separator: Some((separator.colon, separator.at, separator.parameters)),
                    });
                }
                End::Clause(separator) => {
                    return Err(self.error(Problem::StrayClause, separator.position));
                }
                End::Close(end) if end.letter == close => {
                    directive.clauses.push(Clause {
                        pieces,
                        separator: None,
                    });
                    directive.close = Some(Close {
                        colon: end.colon,
                        at: end.at,
                    });
                    return Ok(directive);
                }
                End::Close(end) => {
                    let name = bracket_name(end.letter);
                    return Err(self.error(Problem::NotOpened(name), end.position));
                }
                End::Text => {
                    let name = bracket_name(directive.letter);
                    return Err(self.error(Problem::NotClosed(name), directive.position));
                }
            }
        }
    }

    /// Justification can hold nothing for the pretty printer; before it there were so many directives
    /// for that.
    fn check_justification(
        &mut self,
        directive: &Directive,
        layouts: usize,
    ) -> Result<(), FormatError> {
        if self.layouts > layouts {
            return Err(self.error(Problem::Clauses(JUSTIFIED_LAYOUT), directive.position));
        }
        let first = directive.clauses.first();
        if let Some((true, ..)) = first.and_then(|clause| clause.separator.as_ref()) {
            self.overflow.get_or_insert(directive.position);
        }
        Ok(())
    }

    /// Parameters, modifiers and letter, after the tilde.
    fn directive(&mut self) -> Result<Directive, FormatError> {
        let mut parameters = Vec::new();
        loop {
            let parameter = self.parameter();
            let has_comma = self.chars.get(self.next) == Some(&',');
            if has_comma || parameter != Parameter::None {
                parameters.push(parameter);
            } else if !parameters.is_empty() {
                // A comma before the letter: one more parameter that is not given.
                parameters.push(Parameter::None);
            }
            if !has_comma {
                break;
            }
            self.next += 1;
        }
        let (mut colon, mut at) = (false, false);
        loop {
            match self.chars.get(self.next) {
                Some(':') if !colon => colon = true,
                Some('@') if !at => at = true,
                _ => break,
            }
            self.next += 1;
        }
        let Some(letter) = self.chars.get(self.next).copied() else {
            let last = self.chars.len().saturating_sub(1);
            return Err(self.error(Problem::Unfinished, last));
        };
        let position = self.next;
        self.next += 1;
        let letter = letter.to_ascii_uppercase();
        let Some(most) = most_parameters(letter) else {
            return Err(self.error(Problem::Unknown(letter), position));
        };
        let given = parameters
            .iter()
            .rposition(|p| *p != Parameter::None)
            .map_or(0, |i| i + 1);
        if given > most {
            return Err(self.error(Problem::TooManyParameters { most, given }, position));
        }
        let mut name = String::new();
        if letter == '/' {
            let rest = self.chars.get(self.next..).unwrap_or(&[]);
            let Some(length) = rest.iter().position(|c| *c == '/') else {
                return Err(self.error(Problem::NotClosed("slash"), position));
            };
            name = rest.iter().take(length).collect();
            self.next += length + 1;
        }
        Ok(Directive {
            letter,
            colon,
            at,
            parameters,
            position,
            clauses: Vec::new(),
            close: None,
            name,
        })
    }

    fn parameter(&mut self) -> Parameter {
        match self.chars.get(self.next).copied() {
            Some('\'') => match self.chars.get(self.next + 1).copied() {
                Some(c) => {
                    self.next += 2;
                    Parameter::Char(c)
                }
                None => Parameter::None,
            },
            Some('v' | 'V') => {
                self.next += 1;
                Parameter::Argument
            }
            Some('#') => {
                self.next += 1;
                Parameter::Count
            }
            Some(c) if c.is_ascii_digit() => self.number(1),
            Some(c @ ('+' | '-')) if self.is_digit_at(self.next + 1) => {
                self.next += 1;
                self.number(if c == '-' { -1 } else { 1 })
            }
            _ => Parameter::None,
        }
    }

    fn is_digit_at(&self, index: usize) -> bool {
        self.chars.get(index).is_some_and(char::is_ascii_digit)
    }

    fn number(&mut self, sign: i64) -> Parameter {
        let mut number: i64 = 0;
        while let Some(digit) = self.chars.get(self.next).and_then(|c| c.to_digit(10)) {
            number = number.saturating_mul(10).saturating_add(i64::from(digit));
            self.next += 1;
        }
        Parameter::Number(sign * number)
    }
}
