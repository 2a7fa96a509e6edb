//! Pathnames: names of files, taken apart. Directories are separated by slashes; there are no devices, and
//! hosts only as the first part of logical pathnames, whose directories are separated by semicolons.

use super::Value;
use super::copy::Copier;
use super::foreign::{Foreign, ForeignCopy, PrintContext};
use super::known;
use super::symbol::Sym;

/// The name of a file.
pub(crate) struct Pathname {
    /// The host of a logical pathname, a string; `NIL` for the name of a file of the machine.
    pub host: Value,
    /// `NIL`, or a list that begins with `:ABSOLUTE` or `:RELATIVE`, of strings, `:UP`, `:WILD` and
    /// `:WILD-INFERIORS`.
    pub directory: Value,
    /// A string, `:WILD` or `NIL`.
    pub name: Value,
    /// What stands after the last dot: a string, `:WILD` or `NIL`.
    pub kind: Value,
    /// Kept as it is given; it is no part of a file's name.
    pub version: Value,
}

impl Pathname {
    /// Takes a file's name apart.
    pub(crate) fn parse(text: &str) -> Pathname {
        let (folder, file) = match text.rfind('/') {
            Some(slash) => text.split_at(slash + 1),
            None => ("", text),
        };
        let (name, kind) = match file.rfind('.') {
            // A name may begin with a dot.
            Some(dot) if dot > 0 => (file.get(..dot), file.get(dot + 1..)),
            _ => (Some(file), None),
        };
        let part = |text: Option<&str>| match text {
            None => Value::NIL,
            Some("*") => known::K_WILD.into(),
            Some(text) => Value::string(text),
        };
        Pathname {
            host: Value::NIL,
            directory: directory(folder),
            name: part(name.filter(|name| !name.is_empty())),
            kind: part(kind),
            version: Value::NIL,
        }
    }

    /// The name of the file, put together.
    pub(crate) fn namestring(&self) -> String {
        if let Value::Str(host) = &self.host {
            return self.logical_namestring(&host.text());
        }
        let mut text = self.directory_text(known::K_ABSOLUTE, '/');
        text.push_str(&shown(&self.name));
        if self.kind.is_true() {
            text.push('.');
            text.push_str(&shown(&self.kind));
        }
        text
    }
}

impl Pathname {
    /// The directory, each part with a separator after it, and one in front of all for one of the two
    /// kinds of directories.
    fn directory_text(&self, with_first: Sym, separator: char) -> String {
        let mut text = String::new();
        for (index, part) in self.directory.iter_list().enumerate() {
            match (index, part) {
                (0, Value::Symbol(kind, ..)) if kind == with_first => text.push(separator),
                (0, _) => {}
                (_, part) => {
                    text.push_str(&shown(&part));
                    text.push(separator);
                }
            }
        }
        text
    }

    fn logical_namestring(&self, host: &str) -> String {
        let mut text = format!("{host}:");
        text.push_str(&self.directory_text(known::K_RELATIVE, ';'));
        text.push_str(&shown(&self.name));
        if self.kind.is_true() || self.version.is_true() {
            text.push('.');
            text.push_str(&shown(&self.kind));
        }
        if self.version.is_true() {
            text.push('.');
            text.push_str(&shown(&self.version));
        }
        text
    }
}

fn directory(folder: &str) -> Value {
    if folder.is_empty() {
        return Value::NIL;
    }
    let start = if folder.starts_with('/') {
        known::K_ABSOLUTE
    } else {
        known::K_RELATIVE
    };
    let parts = folder.split('/').filter(|part| !matches!(*part, "" | "."));
    let parts = parts.map(|part| match part {
        ".." => known::K_UP.into(),
        "*" => known::K_WILD.into(),
        "**" => known::K_WILD_INFERIORS.into(),
        name => Value::string(name),
    });
    let all: Vec<Value> = std::iter::once(start.into()).chain(parts).collect();
    // "./" is no directory at all.
    match all.as_slice() {
        [Value::Symbol(known::K_RELATIVE, ..)] => Value::NIL,
        _ => Value::list(all),
    }
}

/// A part as it stands in a name.
fn shown(part: &Value) -> String {
    match part {
        Value::Str(text) => text.text(),
        Value::Symbol(known::K_WILD, ..) => "*".to_owned(),
        Value::Symbol(known::K_WILD_INFERIORS, ..) => "**".to_owned(),
        Value::Symbol(known::K_UP | known::K_BACK, ..) => "..".to_owned(),
        Value::Symbol(known::K_NEWEST, ..) => "NEWEST".to_owned(),
        Value::Int(number) => number.to_string(),
        _ => String::new(),
    }
}

/// No version means the newest one.
fn is_newest(version: &Value) -> bool {
    matches!(version, Value::Symbol(known::NIL | known::K_NEWEST, ..))
}

impl Foreign for Pathname {
    fn copied(&self, copier: &mut Copier) -> ForeignCopy {
        ForeignCopy::New(Box::new(Pathname {
            host: copier.value(&self.host),
            directory: copier.value(&self.directory),
            name: copier.value(&self.name),
            kind: copier.value(&self.kind),
            version: copier.value(&self.version),
        }))
    }

    fn type_symbol(&self) -> Sym {
        match self.host {
            Value::Str(_) => known::LOGICAL_PATHNAME,
            _ => known::PATHNAME,
        }
    }

    fn print(&self, context: &dyn PrintContext, escape: bool) -> String {
        let name = self.namestring();
        if escape {
            format!("#P{}", context.text(&name.as_str().into(), true))
        } else {
            name
        }
    }

    // A name, a type or a directory may have characters that separate such parts.
    fn is_readable(&self) -> bool {
        let again = Pathname::parse(&self.namestring());
        let equal = super::equality::equal;
        self.host.is_true()
            || (is_newest(&self.version)
                && equal(&self.directory, &again.directory)
                && equal(&self.name, &again.name)
                && equal(&self.kind, &again.kind))
    }

    fn is_equal(&self, other: &Value) -> bool {
        let equal = super::equality::equal;
        other.as_foreign::<Pathname>().is_some_and(|other| {
            equal(&self.directory, &other.directory)
                && equal(&self.name, &other.name)
                && equal(&self.kind, &other.kind)
                && equal(&self.host, &other.host)
                && (equal(&self.version, &other.version)
                    || (is_newest(&self.version) && is_newest(&other.version)))
        })
    }
}

/// The name of a file that a value gives: a string, or a pathname.
pub fn file_name(value: &Value) -> Option<String> {
    match value.as_foreign::<Pathname>() {
        Some(pathname) => Some(pathname.namestring()),
        None => value.as_text(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_put_together_as_they_were() {
        for name in [
            "",
            "a",
            "a.lisp",
            ".profile",
            "plans/a.tar.gz",
            "/home/me/",
            "../*/x.*",
            "/**/a",
            "a.",
        ] {
            assert_eq!(Pathname::parse(name).namestring(), name);
        }
        assert_eq!(Pathname::parse("./a//b").namestring(), "a/b");
    }
}
