//! The text of a URDF from the bytes of a file.

/// The encodings other than UTF-8 that are read.
const LATIN_1: [&str; 3] = ["iso-8859-1", "latin-1", "latin1"];

/// The text of a URDF, or of another XML file: UTF-8, or ISO-8859-1 where the file declares it.
///
/// # Errors
///
/// What is wrong with the encoding, and what would be right.
pub fn urdf_text(bytes: &[u8]) -> Result<String, String> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let error = match std::str::from_utf8(bytes) {
        Ok(text) => return Ok(text.to_owned()),
        Err(error) => error,
    };
    let valid = String::from_utf8_lossy(bytes.get(..error.valid_up_to()).unwrap_or_default());
    if declared(&valid).is_some() {
        return Ok(bytes.iter().copied().map(char::from).collect());
    }
    let line = valid.matches('\n').count() + 1;
    let last = valid.rsplit_once('\n').map_or(&*valid, |(_, last)| last);
    let column = last.chars().count() + 1;
    let byte = bytes.get(error.valid_up_to()).copied().unwrap_or_default();
    Err(format!(
        "it is not UTF-8 at line {line}, column {column}: byte {byte:#04x}; save the file as UTF-8, or declare \
         what it is: <?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>"
    ))
}

/// The encoding that a text declares, if it is one of those that are read.
pub(super) fn declared(text: &str) -> Option<&'static str> {
    let declaration = text.trim_start().strip_prefix("<?xml")?;
    let declaration = declaration.get(..declaration.find("?>")?)?;
    let encoding = declaration.split_once("encoding")?.1;
    let name = encoding.trim_start().strip_prefix('=')?.trim_start();
    let quote = name
        .chars()
        .next()
        .filter(|letter| ['"', '\''].contains(letter))?;
    let name = name.get(1..)?.split(quote).next()?.to_ascii_lowercase();
    LATIN_1.contains(&name.as_str()).then_some("ISO-8859-1")
}
