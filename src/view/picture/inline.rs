//! Pictures between the lines of a terminal, by the three protocols in use.

use std::io::{self, Write};

use super::image::Image;
use super::palette::Palette;

/// The protocol by which a terminal shows pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InlinePictures {
    /// Kitty's graphics protocol: PNG in base 64, in chunks.
    Kitty,
    /// iTerm's inline images: PNG in base 64.
    Iterm,
    /// Sixel: six rows of pixels at a time, from a palette.
    Sixel,
}

/// Maximum number of base-64 bytes in one of Kitty's chunks.
const CHUNK: usize = 4096;

/// Number of colours that every terminal with sixels has.
const SIXEL_COLORS: usize = 255;

impl InlinePictures {
    /// The protocol that the terminal understands, as far as its environment variables tell.
    pub fn detect(variable: impl Fn(&str) -> Option<String>) -> Option<Self> {
        let value = |name: &str| variable(name).unwrap_or_default().to_lowercase();
        let (term, program) = (value("TERM"), value("TERM_PROGRAM"));
        // A multiplexer swallows escape sequences that it does not know.
        if term.starts_with("screen") || term.starts_with("tmux") || !value("TMUX").is_empty() {
            return None;
        }
        if !value("KITTY_WINDOW_ID").is_empty() || term.contains("kitty") || program == "ghostty" {
            return Some(Self::Kitty);
        }
        if program == "iterm.app" || program == "wezterm" || value("LC_TERMINAL") == "iterm2" {
            return Some(Self::Iterm);
        }
        let has_sixels = ["sixel", "foot", "mlterm", "yaft", "contour"];
        let is_one = has_sixels.iter().any(|known| term.contains(known));
        is_one.then_some(Self::Sixel)
    }

    /// The bytes that show the picture at the cursor, which is below it afterwards. Empty if
    /// the picture cannot be encoded.
    pub fn encoded(self, picture: &Image) -> Vec<u8> {
        let mut bytes = Vec::new();
        let written = match self {
            Self::Kitty => kitty(picture, &mut bytes),
            Self::Iterm => iterm(picture, &mut bytes),
            Self::Sixel => sixel(picture, &mut bytes),
        };
        if written.is_err() {
            bytes.clear();
        }
        bytes
    }
}

fn kitty(picture: &Image, to: &mut Vec<u8>) -> io::Result<()> {
    let text = base_64(&picture.to_png()?);
    let mut chunks = text.as_bytes().chunks(CHUNK).peekable();
    let mut head = "a=T,f=100,q=2,";
    while let Some(chunk) = chunks.next() {
        let more = u8::from(chunks.peek().is_some());
        write!(to, "\x1b_G{head}m={more};")?;
        to.write_all(chunk)?;
        to.write_all(b"\x1b\\")?;
        head = "";
    }
    Ok(())
}

fn iterm(picture: &Image, to: &mut Vec<u8>) -> io::Result<()> {
    let png = picture.to_png()?;
    let (size, width) = (png.len(), picture.width());
    write!(
        to,
        "\x1b]1337;File=inline=1;size={size};width={width}px:{}\x07",
        base_64(&png)
    )
}

fn sixel(picture: &Image, to: &mut Vec<u8>) -> io::Result<()> {
    let palette = Palette::of([picture].into_iter(), SIXEL_COLORS);
    let places = palette.places(picture);
    let (width, height) = (picture.width(), picture.height());
    write!(to, "\x1bPq\"1;1;{width};{height}")?;
    for (place, color) in palette.colors().iter().enumerate() {
        let [r, g, b] = color.map(|c| (u32::from(c) * 100 + 127) / 255);
        write!(to, "#{place};2;{r};{g};{b}")?;
    }
    for rows in places.chunks(width.max(1) * 6) {
        let mut used = rows.to_vec();
        used.sort_unstable();
        used.dedup();
        for place in used {
            write!(to, "#{place}")?;
            let mut run = (0u8, 0usize);
            for column in 0..width {
                let pixels = rows.iter().skip(column).step_by(width).enumerate();
                let bits = pixels
                    .filter(|(_, p)| **p == place)
                    .fold(0u8, |bits, (row, _)| bits | 1 << row);
                if bits == run.0 {
                    run.1 += 1;
                } else {
                    write_run(to, run)?;
                    run = (bits, 1);
                }
            }
            write_run(to, run)?;
            to.push(b'$');
        }
        to.push(b'-');
    }
    to.write_all(b"\x1b\\")
}

fn write_run(to: &mut Vec<u8>, (bits, count): (u8, usize)) -> io::Result<()> {
    // Six bits added to the question mark give a printable ASCII character.
    let letter = char::from(b'?' + bits);
    match count {
        0 => Ok(()),
        1..4 => to.write_all(letter.to_string().repeat(count).as_bytes()),
        _ => write!(to, "!{count}{letter}"),
    }
}

fn base_64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let bits = [0, 1, 2].map(|i| u32::from(group.get(i).copied().unwrap_or(0)));
        let bits = bits[0] << 16 | bits[1] << 8 | bits[2];
        for digit in 0..4 {
            // Six bits are a valid index into the table.
            let place = (bits >> (18 - 6 * digit) & 63) as usize;
            text.push(match digit <= group.len() {
                true => char::from(DIGITS[place]),
                false => '=',
            });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use crate::picture::inline::*;

    fn detect(variables: &[(&str, &str)]) -> Option<InlinePictures> {
        InlinePictures::detect(|name| {
            let found = variables.iter().find(|(known, _)| *known == name);
            found.map(|(_, value)| (*value).to_owned())
        })
    }

    #[test]
    fn terminals_are_known_by_their_variables() {
        assert_eq!(detect(&[]), None);
        assert_eq!(detect(&[("TERM", "xterm-256color")]), None);
        assert_eq!(
            detect(&[("TERM", "xterm-kitty")]),
            Some(InlinePictures::Kitty)
        );
        assert_eq!(
            detect(&[("TERM", "xterm-256color"), ("TERM_PROGRAM", "iTerm.app")]),
            Some(InlinePictures::Iterm)
        );
        assert_eq!(detect(&[("TERM", "foot")]), Some(InlinePictures::Sixel));
        let hidden = [("TERM", "tmux-256color"), ("KITTY_WINDOW_ID", "1")];
        assert_eq!(detect(&hidden), None);
    }

    #[test]
    fn base_64_is_padded() {
        let texts = ["", "f", "fo", "foo", "foob"].map(|text| base_64(text.as_bytes()));
        assert_eq!(texts, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg=="]);
    }

    #[test]
    fn a_picture_of_one_colour_is_one_run_of_sixels_per_six_rows() {
        let picture = Image::filled(9, 7, [255, 0, 0]);
        let text = String::from_utf8(InlinePictures::Sixel.encoded(&picture)).unwrap();
        assert_eq!(text, "\x1bPq\"1;1;9;7#0;2;100;0;0#0!9~$-#0!9@$-\x1b\\");
    }

    #[test]
    fn kitty_gets_a_png_in_chunks() {
        let mut picture = Image::filled(80, 80, [0; 3]);
        for i in 0..6400 {
            let [a, b, ..] = (i as u32).wrapping_mul(2_654_435_761).to_le_bytes();
            picture.set(i % 80, i / 80, [a, b, a ^ b]);
        }
        let bytes = InlinePictures::Kitty.encoded(&picture);
        let text = String::from_utf8(bytes).unwrap();
        assert!(text.starts_with("\x1b_Ga=T,f=100,q=2,m=1;iVBORw0KGgo"));
        assert!(text.ends_with("\x1b\\") && text.contains("\x1b_Gm=0;"));
        let iterm = String::from_utf8(InlinePictures::Iterm.encoded(&picture)).unwrap();
        assert!(iterm.starts_with("\x1b]1337;File=inline=1;size="));
        assert!(iterm.ends_with('\x07'));
    }
}
