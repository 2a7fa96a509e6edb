//! Holds the sources against `docs/architecture.md` where the compiler does not: the table of
//! crates, the rooms inside a crate, and that no folders use each other in a circle.
//!
//! The paths in the sources are read as text, re-exports are followed, and code for tests is
//! passed over.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// A path of modules below the root of the crate.
type Module = Vec<String>;

/// The modules of a crate and what each names.
struct Sources {
    /// Every path that a module names, as written but made absolute.
    names: BTreeMap<Module, BTreeSet<Module>>,
    /// Where a re-exported name comes from, by module and name.
    exports: BTreeMap<Module, Module>,
    /// The text of each module.
    texts: BTreeMap<Module, String>,
}

impl Sources {
    /// The sources of the crate in a folder.
    fn of(folder: &str) -> Self {
        let mut sources = Self {
            names: BTreeMap::new(),
            exports: BTreeMap::new(),
            texts: BTreeMap::new(),
        };
        sources.read_folder(&root().join(folder), &[]);
        sources
    }

    fn read_folder(&mut self, folder: &Path, module: &[String]) {
        let entries = fs::read_dir(folder).expect("the folder can be read");
        for entry in entries {
            let path = entry.expect("the folder can be listed").path();
            let stem = path.file_stem().expect("entries have names");
            let stem = stem.to_string_lossy().into_owned();
            let mut inner = module.to_vec();
            if is_for_tests(&stem) {
                continue;
            }
            if path.is_dir() {
                inner.push(stem);
                self.read_folder(&path, &inner);
            } else if path.extension().is_some_and(|e| e == "rs") {
                if !matches!(stem.as_str(), "mod" | "lib" | "main") {
                    inner.push(stem);
                }
                let text = fs::read_to_string(&path).expect("the file can be read");
                self.read_file(inner, &text);
            }
        }
    }

    fn read_file(&mut self, module: Module, text: &str) {
        let tokens = without_tests(&tokens(text));
        let mut names = BTreeSet::new();
        let mut i = 0;
        while i < tokens.len() {
            let begins = matches!(tokens[i].as_str(), "crate" | "super" | "self" | "use");
            let follows = i > 0 && tokens[i - 1] == "::";
            if !begins || follows {
                i += 1;
                continue;
            }
            let is_use = tokens[i] == "use";
            let start = if is_use { i + 1 } else { i };
            let is_public = is_use && i > 0 && matches!(tokens[i - 1].as_str(), "pub" | ")");
            let mut found = Vec::new();
            let end = read_tree(&tokens, start, Vec::new(), &mut found);
            for (path, alias) in found {
                let Some(absolute) = absolute(&module, &path, is_use) else {
                    continue;
                };
                if is_public && let Some(name) = alias.or_else(|| path.last().cloned()) {
                    let mut exported = module.clone();
                    exported.push(name);
                    self.exports.insert(exported, absolute.clone());
                }
                names.insert(absolute);
            }
            i = end.max(i + 1);
        }
        self.names.entry(module.clone()).or_default().extend(names);
        self.texts.entry(module).or_default().push_str(text);
    }

    /// The module that a path leads to: the longest part of it that is one, re-exports
    /// followed.
    fn target(&self, path: &[String]) -> Module {
        let mut path = path.to_vec();
        'follow: for _ in 0..8 {
            for length in (1..=path.len()).rev() {
                let part = &path[..length];
                if self.names.contains_key(part) {
                    break;
                }
                if let Some(origin) = self.exports.get(part)
                    && origin.as_slice() != part
                {
                    path = [origin.as_slice(), &path[length..]].concat();
                    continue 'follow;
                }
            }
            break;
        }
        while !path.is_empty() && !self.names.contains_key(&path) {
            path.pop();
        }
        path
    }

    /// Which children of a module use which others, with a place that shows it.
    fn uses_between_children(&self, parent: &[String]) -> BTreeMap<(String, String), String> {
        let mut uses = BTreeMap::new();
        for (module, names) in &self.names {
            let Some(child) = child_of(parent, module) else {
                continue;
            };
            for name in names {
                let target = self.target(name);
                let Some(used) = child_of(parent, &target) else {
                    continue;
                };
                if used != child {
                    let shown = format!("{} names {}", module.join("::"), name.join("::"));
                    uses.entry((child.clone(), used)).or_insert(shown);
                }
            }
        }
        uses
    }
}

/// Files and folders that hold nothing but tests and what only they need.
fn is_for_tests(stem: &str) -> bool {
    stem == "tests" || stem.starts_with("test_") || stem == "testing"
}

fn child_of(parent: &[String], module: &[String]) -> Option<String> {
    (module.len() > parent.len() && module.starts_with(parent))
        .then(|| module[parent.len()].clone())
}

/// A path as written in a module, from the root; `None` for other crates' paths.
fn absolute(module: &[String], path: &[String], is_use: bool) -> Option<Module> {
    let (first, rest) = path.split_first()?;
    let mut base = match first.as_str() {
        "crate" => return Some(rest.to_vec()),
        "self" => module.to_vec(),
        "super" => module[..module.len().checked_sub(1)?].to_vec(),
        // `use child::Name` in the module that declares the child.
        _ if is_use => return Some([module, path].concat()),
        _ => return None,
    };
    let mut rest = rest;
    while let Some((next, more)) = rest.split_first()
        && next == "super"
    {
        base.pop()?;
        rest = more;
    }
    base.extend(rest.iter().cloned());
    Some(base)
}

/// Reads `a::b::{c, d as e}` from a token on; returns the index after it.
fn read_tree(
    tokens: &[String],
    mut i: usize,
    prefix: Module,
    found: &mut Vec<(Module, Option<String>)>,
) -> usize {
    let mut path = prefix;
    loop {
        match tokens.get(i).map(String::as_str) {
            Some("{") => {
                i += 1;
                while let Some(token) = tokens.get(i) {
                    match token.as_str() {
                        "}" => return i + 1,
                        "," => i += 1,
                        _ => i = read_tree(tokens, i, path.clone(), found).max(i + 1),
                    }
                }
                return i;
            }
            Some("*") => {
                found.push((path, None));
                return i + 1;
            }
            Some(word) if is_word(word) => {
                if word != "self" || path.is_empty() {
                    path.push(word.to_owned());
                }
                i += 1;
            }
            _ => break,
        }
        if tokens.get(i).is_some_and(|t| t == "::") {
            i += 1;
        } else {
            break;
        }
    }
    let mut alias = None;
    if tokens.get(i).is_some_and(|t| t == "as") {
        alias = tokens.get(i + 1).cloned();
        i += 2;
    }
    if !path.is_empty() {
        found.push((path, alias));
    }
    i
}

fn is_word(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// Words, `::` and single signs, without comments, strings and characters.
fn tokens(text: &str) -> Vec<String> {
    let chars: Vec<char> = text.chars().collect();
    let mut tokens = Vec::new();
    let mut i = 0;
    while i < chars.len() {
        let c = chars[i];
        let next = chars.get(i + 1).copied();
        if c == '/' && next == Some('/') {
            while i < chars.len() && chars[i] != '\n' {
                i += 1;
            }
        } else if c == '"' {
            i += 1;
            while i < chars.len() && chars[i] != '"' {
                i += if chars[i] == '\\' { 2 } else { 1 };
            }
            i += 1;
        } else if c == 'r' && (next == Some('"') || next == Some('#')) {
            let signs = chars[i + 1..].iter().take_while(|c| **c == '#').count();
            if chars.get(i + 1 + signs) != Some(&'"') {
                tokens.push(c.to_string());
                i += 1;
                continue;
            }
            i += signs + 2;
            let is_end =
                |i: usize| chars[i] == '"' && chars[i + 1..].iter().take(signs).all(|c| *c == '#');
            while i < chars.len() && !is_end(i) {
                i += 1;
            }
            i += signs + 1;
        } else if c == '\'' {
            // A character, or a lifetime, which has no closing quote.
            let length = if next == Some('\\') {
                chars[i + 3..]
                    .iter()
                    .position(|c| *c == '\'')
                    .map(|n| n + 4)
            } else {
                (chars.get(i + 2) == Some(&'\'')).then_some(3)
            };
            i += length.unwrap_or(1);
        } else if c.is_alphanumeric() || c == '_' {
            let start = i;
            while i < chars.len() && (chars[i].is_alphanumeric() || chars[i] == '_') {
                i += 1;
            }
            tokens.push(chars[start..i].iter().collect());
        } else if c == ':' && next == Some(':') {
            tokens.push("::".to_owned());
            i += 2;
        } else {
            if !c.is_whitespace() {
                tokens.push(c.to_string());
            }
            i += 1;
        }
    }
    tokens
}

/// The tokens without items behind `#[cfg(test)]`.
fn without_tests(tokens: &[String]) -> Vec<String> {
    const TEST: [&str; 7] = ["#", "[", "cfg", "(", "test", ")", "]"];
    let mut kept = Vec::new();
    let mut i = 0;
    while i < tokens.len() {
        if tokens[i..].len() < TEST.len() || !tokens[i..].iter().zip(TEST).all(|(a, b)| a == b) {
            kept.push(tokens[i].clone());
            i += 1;
            continue;
        }
        i += TEST.len();
        let mut depth = 0;
        while let Some(token) = tokens.get(i) {
            i += 1;
            match token.as_str() {
                "{" | "(" | "[" => depth += 1,
                "}" | ")" | "]" => {
                    depth -= 1;
                    if depth == 0 && token == "}" {
                        break;
                    }
                }
                ";" | "," if depth == 0 => break,
                _ => {}
            }
        }
    }
    kept
}

/// A circle in a graph, if there is one.
fn circle(uses: &BTreeMap<(String, String), String>) -> Option<Vec<String>> {
    fn visit<'a>(
        node: &'a str,
        uses: &'a BTreeMap<(String, String), String>,
        path: &mut Vec<&'a str>,
        done: &mut BTreeSet<&'a str>,
    ) -> Option<Vec<String>> {
        if let Some(start) = path.iter().position(|n| *n == node) {
            return Some(path[start..].iter().map(|n| (*n).to_owned()).collect());
        }
        if done.contains(node) {
            return None;
        }
        path.push(node);
        for (_, to) in uses.keys().filter(|(from, _)| from == node) {
            if let Some(found) = visit(to, uses, path, done) {
                return Some(found);
            }
        }
        path.pop();
        done.insert(node);
        None
    }
    let mut done = BTreeSet::new();
    uses.keys()
        .find_map(|(from, _)| visit(from, uses, &mut Vec::new(), &mut done))
}

/// The folder of the project.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The crates that have Rust code in rooms.
const CRATES: [&str; 11] = [
    "src/closest_name",
    "src/cram",
    "src/defect",
    "src/front",
    "src/lisp",
    "src/robotics",
    "src/ros",
    "src/session",
    "src/spatial",
    "src/sweep",
    "src/view",
];

/// What each row of a table in `docs/architecture.md` may use, by the heading of its section.
fn written(heading: &str) -> BTreeMap<String, BTreeSet<String>> {
    let text = fs::read_to_string(root().join("docs/architecture.md"));
    let text = text.expect("the architecture is written down");
    let names = |cell: &str| -> Vec<String> {
        let parts = cell.split('`').skip(1).step_by(2);
        parts.map(str::to_owned).collect()
    };
    let section = text.split(&format!("\n## {heading}\n")).nth(1);
    let section = section.expect("the section is there");
    let section = section.split("\n## ").next().unwrap_or_default();
    let rows = section.lines().filter(|line| line.starts_with("| `"));
    rows.map(|row| {
        let mut cells = row.trim_matches('|').split('|');
        let room = names(cells.next().unwrap_or_default()).remove(0);
        let uses = names(cells.next().unwrap_or_default());
        (room, uses.into_iter().collect())
    })
    .collect()
}

/// The crates of the project that a manifest names as dependencies of the library.
fn dependencies(manifest: &str) -> BTreeSet<String> {
    let section = manifest
        .split("\n[dependencies]\n")
        .nth(1)
        .unwrap_or_default();
    let lines = section.lines().take_while(|line| !line.starts_with('['));
    lines
        .filter_map(|line| line.strip_prefix("planwright-"))
        .filter_map(|line| line.split(['.', ' ']).next())
        .map(str::to_owned)
        .collect()
}

#[test]
fn crates_use_each_other_as_the_architecture_says() {
    let written = written("Who may use whom");
    let manifest = |folder: &str| {
        let text = fs::read_to_string(root().join(folder).join("Cargo.toml"));
        text.expect("the crate has a manifest")
    };
    let mut real = BTreeMap::from([("planwright".to_owned(), dependencies(&manifest(".")))]);
    let workspace = manifest(".");
    let members = workspace.split("\nmembers = [").nth(1).unwrap_or_default();
    let members = members.split(']').next().unwrap_or_default();
    for member in members.split('"').skip(1).step_by(2) {
        let text = manifest(member);
        let name = text
            .lines()
            .find_map(|line| line.strip_prefix("name = \"planwright-"));
        let name = name.expect("the package has a name").trim_end_matches('"');
        real.insert(name.to_owned(), dependencies(&text));
    }
    assert_eq!(real, written);
}

#[test]
fn rooms_use_each_other_as_the_architecture_says() {
    let mut wrong = Vec::new();
    let halves = [("src/robotics", ""), ("src/view", "")];
    let heading = "The rooms of the physical half and of the views";
    compare(heading, &halves, &mut wrong);
    let motion = [("src/robotics", "motion")];
    compare("The rooms of motion", &motion, &mut wrong);
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// Adds the differences between a table and the sources; a module of a crate is given by the folder
/// of the crate and its name, which is empty for the crate itself.
fn compare(heading: &str, modules: &[(&str, &str)], wrong: &mut Vec<String>) {
    let written = written(heading);
    let mut real: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (folder, module) in modules {
        let names = module.split("::").filter(|name| !name.is_empty());
        let module: Module = names.map(str::to_owned).collect();
        for ((from, to), shown) in Sources::of(folder).uses_between_children(&module) {
            if !written.get(&from).is_some_and(|uses| uses.contains(&to)) {
                wrong.push(format!("{from} must not use {to}: {shown}"));
            }
            real.entry(from).or_default().insert(to);
        }
    }
    for (room, uses) in &written {
        for used in uses {
            if !real.get(room).is_some_and(|real| real.contains(used)) {
                wrong.push(format!("{room} does not use {used}, as the table says"));
            }
        }
    }
}

#[test]
fn no_folders_use_each_other_in_a_circle() {
    let mut wrong = Vec::new();
    for folder in CRATES {
        circles(&Sources::of(folder), &mut wrong);
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// Adds the circles between the folders of a crate.
fn circles(sources: &Sources, wrong: &mut Vec<String>) {
    let folders: BTreeSet<&[String]> = (sources.names.keys())
        .map(|module| &module[..module.len().saturating_sub(1)])
        .collect();
    for folder in &folders {
        let mut uses = sources.uses_between_children(folder);
        let is_folder = |child: &String| {
            let path = [*folder, std::slice::from_ref(child)].concat();
            folders.contains(path.as_slice())
        };
        uses.retain(|(from, to), _| is_folder(from) && is_folder(to));
        if let Some(circle) = circle(&uses) {
            let steps = circle.iter().zip(circle.iter().cycle().skip(1));
            let shown: Vec<&str> = steps
                .filter_map(|(a, b)| uses.get(&(a.clone(), b.clone())))
                .map(String::as_str)
                .collect();
            wrong.push(format!("in {}: {}", folder.join("::"), shown.join("; ")));
        }
    }
}

/// Whatever a part needs of the session, it is given. Only the face for programs is the session's own.
#[test]
fn no_folder_of_the_session_names_the_session() {
    let sources = Sources::of("src/session");
    let folders: BTreeSet<&String> = (sources.names.keys())
        .filter(|module| module.len() > 1)
        .filter_map(|module| module.first())
        .filter(|folder| *folder != "face")
        .collect();
    let mut naming = BTreeSet::new();
    for (module, names) in &sources.names {
        let folder = module.first().filter(|folder| folders.contains(folder));
        // `pub(crate)` names the root, and nothing in it.
        let mut names = names.iter().filter(|name| !name.is_empty());
        if names.any(|name| sources.target(name).is_empty()) {
            naming.extend(folder);
        }
    }
    let naming: Vec<&str> = naming.into_iter().map(String::as_str).collect();
    assert_eq!(naming, [""; 0]);
}

#[test]
fn only_one_module_and_those_in_it_name_the_physics_engine() {
    let names_it = |text: &str| tokens(text).iter().any(|t| t.starts_with("rapier"));
    let mut named = Vec::new();
    for folder in CRATES {
        let texts = Sources::of(folder).texts;
        let modules = texts.iter().filter(|(_, text)| names_it(text));
        named.extend(modules.map(|(module, _)| module.join("::")));
    }
    let below = named
        .iter()
        .all(|module| module.starts_with("world::physics"));
    assert!(below && !named.is_empty(), "{named:?}");
}

#[test]
fn only_the_library_itself_has_examples_in_rust() {
    let mut found = Vec::new();
    // `cargo test` runs the examples of no other crate.
    for folder in CRATES.iter().filter(|folder| **folder != "src/front") {
        for (module, text) in Sources::of(folder).texts {
            let fences = text.lines().map(str::trim_start).filter_map(|line| {
                let comment = line.strip_prefix("///").or(line.strip_prefix("//!"))?;
                comment.trim_start().strip_prefix("```")
            });
            let languages = fences.step_by(2);
            let rust = |language: &str| !matches!(language, "lisp" | "text");
            if languages.into_iter().any(rust) {
                found.push(format!("{folder}: {}", module.join("::")));
            }
        }
    }
    assert!(found.is_empty(), "{found:?}");
}

/// The names of the links and joints of the built-in robot and the built-in kitchen, of several words.
fn described_names() -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for file in ["world/pr2.urdf", "world/kitchen.urdf"] {
        let text = fs::read_to_string(root().join(file)).expect("the file can be read");
        for element in ["<link name=\"", "<joint name=\""] {
            let after = text.split(element).skip(1);
            names.extend(after.filter_map(|rest| Some(rest.split_once('"')?.0.to_owned())));
        }
    }
    // A single word, such as the link map, means other things, too.
    names.retain(|name| name.contains('_'));
    names
}

/// The texts in quotes, each on one line, that are among some names; comments are passed over.
fn quoted<'a>(text: &'a str, comment: &str, names: &BTreeSet<String>) -> Vec<&'a str> {
    let lines = text
        .lines()
        .filter(|line| !line.trim_start().starts_with(comment));
    let parts = lines.flat_map(|line| line.split('"').skip(1).step_by(2));
    parts.filter(|part| names.contains(*part)).collect()
}

/// What is measured is the built-in robot, and a wrong URDF is told what a right one looks like.
const MAY_NAME_PARTS: [&str; 2] = ["measured", "urdf_schema"];

#[test]
fn only_descriptions_name_parts_of_robot_and_kitchen() {
    let names = described_names();
    assert!(names.contains("torso_lift_joint") && names.contains("kitchen_island_surface"));
    let mut found = Vec::new();
    for folder in CRATES {
        for (module, text) in Sources::of(folder).texts {
            if module
                .iter()
                .any(|part| MAY_NAME_PARTS.contains(&part.as_str()))
            {
                continue;
            }
            let text = text.split("#[cfg(test)]").next().unwrap_or_default();
            let named = quoted(text, "//", &names).into_iter();
            found.extend(named.map(|name| format!("{folder} {}: {name}", module.join("::"))));
        }
    }
    for entry in fs::read_dir(root().join("plans/lib")).expect("the folder can be read") {
        let path = entry.expect("the folder can be listed").path();
        let text = fs::read_to_string(&path).expect("the file can be read");
        let named = quoted(&text, ";", &names).into_iter();
        found.extend(named.map(|name| format!("{}: {name}", path.display())));
    }
    assert_eq!(found, Vec::<String>::new());
}
