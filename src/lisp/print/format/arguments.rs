//! How many arguments a control string takes.

use super::directive::{Clause, Directive, Parameter, Piece};

/// Fewest and most arguments, as far as a control string alone decides that.
#[derive(Clone, Copy, Default)]
struct Range {
    min: usize,
    /// `None` if there is no limit.
    max: Option<usize>,
    /// Whether what follows may be left out.
    is_open: bool,
}

/// It depends on the arguments themselves.
struct Undecided;

/// Fewest and most arguments of a control string; `None` where it does not decide that.
pub(super) fn count(pieces: &[Piece]) -> Option<(usize, Option<usize>)> {
    let mut range = Range {
        max: Some(0),
        ..Range::default()
    };
    match range.add_pieces(pieces) {
        Ok(()) => Some((range.min, range.max)),
        Err(Undecided) => None,
    }
}

impl Range {
    fn take(&mut self, min: usize, max: Option<usize>) {
        if !self.is_open {
            self.min += min;
        }
        self.max = self.max.zip(max).map(|(one, other)| one + other);
    }

    fn add_pieces(&mut self, pieces: &[Piece]) -> Result<(), Undecided> {
        pieces.iter().try_for_each(|piece| match piece {
            Piece::Text(_) => Ok(()),
            Piece::Directive(directive) => self.add(directive),
        })
    }

    fn add(&mut self, directive: &Directive) -> Result<(), Undecided> {
        let parameters = directive.parameters.iter();
        let given = parameters.filter(|p| **p == Parameter::Argument).count();
        self.take(given, Some(given));
        match directive.letter {
            'P' if directive.colon => {}
            'A' | 'S' | 'D' | 'B' | 'O' | 'X' | 'R' | 'F' | 'E' | 'G' | '$' | 'C' | 'W' | 'P'
            | '/' => self.take(1, Some(1)),
            '%' | '&' | '|' | '~' | 'T' | '_' | 'I' => {}
            '?' if !directive.at => self.take(2, Some(2)),
            '^' => self.is_open = true,
            '(' => return self.add_clauses(&directive.clauses),
            '<' if !directive.is_logical_block() => {
                let was_open = self.is_open;
                self.add_clauses(&directive.clauses)?;
                self.is_open = was_open;
            }
            '<' | '{' if !directive.at => {
                let is_empty = directive.letter == '{' && directive.is_empty();
                self.take(1 + usize::from(is_empty), Some(1 + usize::from(is_empty)));
            }
            '<' | '{' => self.max = None,
            '[' => return self.add_choice(directive),
            _ => return Err(Undecided),
        }
        Ok(())
    }

    fn add_clauses(&mut self, clauses: &[Clause]) -> Result<(), Undecided> {
        let mut clauses = clauses.iter();
        clauses.try_for_each(|clause| self.add_pieces(&clause.pieces))
    }

    fn add_choice(&mut self, directive: &Directive) -> Result<(), Undecided> {
        let mut least = None;
        let mut most = Some(0);
        for clause in &directive.clauses {
            let mut range = Range {
                max: Some(0),
                ..Range::default()
            };
            range.add_pieces(&clause.pieces)?;
            if range.is_open {
                return Err(Undecided);
            }
            least = Some(least.map_or(range.min, |least: usize| least.min(range.min)));
            most = most.zip(range.max).map(|(one, other)| one.max(other));
        }
        let least = least.unwrap_or(0);
        match (
            directive.at,
            directive.colon,
            directive.parameters.as_slice(),
        ) {
            // The argument is left to the clause if it is true.
            (true, ..) => self.take(1, most.map(|most| most.max(1))),
            (_, true, _) => self.take(1 + least, most.map(|most| most + 1)),
            (_, _, []) => self.take(1, most.map(|most| most + 1)),
            _ => return Err(Undecided),
        }
        Ok(())
    }
}
