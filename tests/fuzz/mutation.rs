//! The generator of inputs.

use std::ops::Range;

use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

/// Maximum size (bytes) of an input.
const MAX_BYTES: usize = 4096;

/// Numbers at which something begins or ends.
const NUMBERS: &[&str] = &[
    "0",
    "-0",
    "1",
    "-1",
    "2",
    "63",
    "64",
    "65",
    "255",
    "256",
    "65536",
    "4294967296",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551616",
    "1e-320",
    "1e-7",
    "1e308",
    "1e309",
    "1d0",
    "-1d308",
    "1/2",
    "1/0",
    "0.1",
    "-0.0",
    "nan",
    "inf",
    ".5",
    "1.",
    "99999999999999999999999999999999",
];

/// Brackets of the languages read here.
const BRACKETS: &[(u8, u8)] = &[
    (b'(', b')'),
    (b'<', b'>'),
    (b'[', b']'),
    (b'{', b'}'),
    (b'"', b'"'),
];

/// Makes one input.
pub struct Mutation {
    random: Pcg64,
}

impl Mutation {
    /// For the input with that number.
    pub fn new(seed: u64, target: &str, number: u64) -> Self {
        let hash = target.bytes().fold(seed, |hash, byte| {
            hash.wrapping_mul(0x0100_0000_01b3) ^ u64::from(byte)
        });
        Self {
            random: Pcg64::new(u128::from(number), u128::from(hash)),
        }
    }

    /// A piece of the corpus, changed in a few places.
    pub fn input(&mut self, corpus: &[Vec<u8>], words: &[&str]) -> Vec<u8> {
        let mut input = self.one_of(corpus).clone();
        for _ in 0..=self.below(8) {
            self.change(&mut input, corpus, words);
        }
        input.truncate(MAX_BYTES);
        input
    }

    fn below(&mut self, limit: usize) -> usize {
        // The remainder favours small numbers by less than matters here.
        (self.random.next_u64() % limit.max(1) as u64) as usize
    }

    fn one_of<'a, T>(&mut self, all: &'a [T]) -> &'a T {
        &all[self.below(all.len())]
    }

    fn change(&mut self, input: &mut Vec<u8>, corpus: &[Vec<u8>], words: &[&str]) {
        let at = self.below(input.len() + 1);
        match self.below(13) {
            0 if at < input.len() => input[at] = self.below(256) as u8,
            1 if at < input.len() => input[at] ^= 1 << self.below(8),
            2 | 3 => {
                let word = self.one_of(words).as_bytes().to_vec();
                input.splice(at..at, word);
            }
            4 => drop(input.drain(self.range(input))),
            5 => {
                let copy = input[self.range(input)].to_vec();
                input.splice(at..at, copy);
            }
            6 => {
                let other = self.one_of(corpus);
                let piece = other[self.range(other)].to_vec();
                input.splice(at..at, piece);
            }
            7 | 8 => {
                let other = self.one_of(corpus);
                let piece = self.group(other).map(|group| other[group].to_vec());
                if let (Some(piece), Some(group)) = (piece, self.group(input)) {
                    input.splice(group, piece);
                }
            }
            9 => {
                if let Some(group) = self.group(input) {
                    input.drain(group);
                }
            }
            10 => {
                if let Some(number) = self.number(input) {
                    let other = self.one_of(NUMBERS).as_bytes().to_vec();
                    input.splice(number, other);
                }
            }
            11 => {
                let piece = self.one_of(words).as_bytes().repeat(1 << self.below(9));
                input.splice(at..at, piece);
            }
            12 if self.below(4) == 0 => input.truncate(at),
            _ => {}
        }
    }

    /// A short range.
    fn range(&mut self, of: &[u8]) -> Range<usize> {
        let from = self.below(of.len() + 1);
        let length = 1 << self.below(9);
        from..(from + self.below(length + 1)).min(of.len())
    }

    /// What is between two brackets that belong together, with them.
    fn group(&mut self, of: &[u8]) -> Option<Range<usize>> {
        let from = self.below(of.len() + 1);
        let opening = |byte: &u8| BRACKETS.iter().any(|(open, _)| open == byte);
        let begin = (from..of.len())
            .chain(0..from)
            .find(|at| opening(&of[*at]))?;
        let (open, close) = *BRACKETS.iter().find(|(open, _)| *open == of[begin])?;
        let mut depth = 0;
        for (at, byte) in of.iter().enumerate().skip(begin) {
            if *byte == close && at > begin {
                depth -= 1;
                if depth == 0 {
                    return Some(begin..at + 1);
                }
            } else if *byte == open {
                depth += 1;
            }
        }
        None
    }

    fn number(&mut self, of: &[u8]) -> Option<Range<usize>> {
        let from = self.below(of.len() + 1);
        let mut places = (from..of.len()).chain(0..from);
        let begin = places.find(|at| of[*at].is_ascii_digit())?;
        let is_part = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
        let length = of[begin..].iter().take_while(|byte| is_part(byte)).count();
        Some(begin..begin + length)
    }
}

#[cfg(test)]
#[test]
fn an_input_can_be_made_again_and_others_differ() {
    let corpus = [b"(list 1 (car '(2 3)) \"text\")".to_vec()];
    let input = |number| Mutation::new(1, "reader", number).input(&corpus, &["#'", "("]);
    assert_eq!(input(7), input(7));
    let inputs: std::collections::BTreeSet<_> = (0..1000).map(input).collect();
    assert!(inputs.len() > 900, "{}", inputs.len());
}
