//! Files are read back by a small reader of the format; `tests/sqlite/run` has SQLite itself read others.

use std::collections::BTreeMap;
use std::io::Cursor;

use super::Sqlite;
use super::pages::PAGE;

/// A value that was read.
#[derive(Debug, PartialEq)]
enum Read {
    Null,
    Int(i64),
    Real(f64),
    Text(String),
}

/// A file of rows of a relation, with the numbers of rows of its tables.
fn file(lines: impl Iterator<Item = (&'static str, String)>) -> (Vec<u8>, BTreeMap<String, u64>) {
    let mut sqlite = Sqlite::begin(Cursor::new(Vec::new())).unwrap();
    for (relation, line) in lines {
        sqlite.add_line(relation, &line).unwrap();
    }
    let (file, counts) = sqlite.finish().unwrap();
    (file.into_inner(), counts.into_iter().collect())
}

fn number(bytes: &[u8]) -> usize {
    bytes
        .iter()
        .fold(0, |sum, byte| sum << 8 | usize::from(*byte))
}

fn varint(bytes: &[u8], at: &mut usize) -> usize {
    let mut value = 0;
    for group in 0..9 {
        let byte = usize::from(bytes[*at]);
        *at += 1;
        if group == 8 {
            return value << 8 | byte;
        }
        value = value << 7 | byte & 0x7f;
        if byte < 0x80 {
            break;
        }
    }
    value
}

/// The rows of the table whose root is a page, with their numbers.
fn rows(file: &[u8], root: usize) -> Vec<(usize, Vec<Read>)> {
    let page = &file[(root - 1) * PAGE..root * PAGE];
    let start = if root == 1 { 100 } else { 0 };
    let count = number(&page[start + 3..start + 5]);
    let cells = |first: usize| (0..count).map(move |i| number(&page[first + 2 * i..][..2]));
    if page[start] == 5 {
        let mut all = Vec::new();
        for cell in cells(start + 12) {
            let below = rows(file, number(&page[cell..cell + 4]));
            let last = below.last().unwrap().0;
            assert_eq!(
                varint(page, &mut (cell + 4)),
                last,
                "the last row below page {root}"
            );
            all.extend(below);
        }
        all.extend(rows(file, number(&page[start + 8..start + 12])));
        return all;
    }
    assert_eq!(page[start], 13, "page {root}");
    let leaf = |mut at: usize| {
        let length = varint(page, &mut at);
        let own = varint(page, &mut at);
        let (most, least) = (PAGE - 35, (PAGE - 12) * 32 / 255 - 23);
        let fitting = least + length.saturating_sub(least) % (PAGE - 4);
        let local = match (length <= most, fitting <= most) {
            (true, _) => length,
            (false, true) => fitting,
            (false, false) => least,
        };
        let mut row = page[at..at + local].to_vec();
        let mut next = if local < length {
            number(&page[at + local..][..4])
        } else {
            0
        };
        while next != 0 {
            let more = &file[(next - 1) * PAGE..next * PAGE];
            let part = (PAGE - 4).min(length - row.len());
            row.extend(&more[4..4 + part]);
            next = number(&more[..4]);
        }
        assert_eq!(row.len(), length);
        (own, values(&row))
    };
    cells(start + 8).map(leaf).collect()
}

fn values(row: &[u8]) -> Vec<Read> {
    let mut at = 0;
    let header = varint(row, &mut at);
    let mut body = header;
    let mut values = Vec::new();
    while at < header {
        let serial = varint(row, &mut at);
        let length = match serial {
            0 | 8 | 9 => 0,
            1..=4 => serial,
            5 => 6,
            6 | 7 => 8,
            text => (text - 13) / 2,
        };
        let bytes = &row[body..body + length];
        body += length;
        values.push(match serial {
            0 => Read::Null,
            8 => Read::Int(0),
            9 => Read::Int(1),
            7 => Read::Real(f64::from_be_bytes(bytes.try_into().unwrap())),
            1..=6 => {
                let sign = if bytes[0] < 0x80 { 0 } else { -1 };
                Read::Int(
                    bytes
                        .iter()
                        .fold(sign, |sum, byte| sum << 8 | i64::from(*byte)),
                )
            }
            _ => Read::Text(String::from_utf8(bytes.to_vec()).unwrap()),
        });
    }
    assert_eq!(body, row.len());
    values
}

/// The rows of a table, and its statement.
fn table(file: &[u8], name: &str) -> (Vec<(usize, Vec<Read>)>, String) {
    assert_eq!(&file[..16], b"SQLite format 3\0");
    assert_eq!(number(&file[28..32]) * PAGE, file.len());
    let schema = rows(file, 1);
    let found = schema
        .iter()
        .find(|(_, row)| row[1] == Read::Text(name.to_owned()));
    match &found.unwrap().1[..] {
        [_, _, _, Read::Int(root), Read::Text(sql)] => (rows(file, *root as usize), sql.clone()),
        other => panic!("{other:?}"),
    }
}

#[test]
fn rows_are_read_back_in_order_from_trees_of_several_levels() {
    let count = 40_000;
    let lines = (0..count).map(|i| {
        let text = format!("{i} ").repeat(20);
        (
            "param",
            format!("{{\"run\":{i},\"task\":{},\"text\":{text:?}}}", i % 7),
        )
    });
    let (file, counts) = file(lines);
    assert_eq!(counts["param"], count);
    let (rows, sql) = table(&file, "param");
    assert_eq!(
        sql,
        "CREATE TABLE \"param\"(\"run\" INTEGER,\"task\" INTEGER,\"key\" TEXT,\"text\" TEXT,\"num\" NUMERIC)"
    );
    assert_eq!(rows.len() as u64, count);
    for (i, (own, row)) in rows.iter().enumerate() {
        assert_eq!(*own, i + 1);
        assert_eq!(row[0], Read::Int(i as i64));
        assert_eq!(row[3], Read::Text(format!("{i} ").repeat(20)));
    }
}

#[test]
fn rows_that_are_longer_than_a_page_go_on_on_others() {
    // Around the length at which a row does not fit, at which one page more is needed, and much more.
    let lengths: Vec<usize> = (4030..4070).chain(8120..8170).chain([1 << 20]).collect();
    let lines = lengths.iter().map(|length| {
        (
            "log",
            format!("{{\"time\":1.5,\"text\":\"{}\"}}", "x".repeat(*length)),
        )
    });
    let (file, _) = file(lines.collect::<Vec<_>>().into_iter());
    let (rows, _) = table(&file, "log");
    for (length, (_, row)) in lengths.iter().zip(&rows) {
        let expected = [
            Read::Int(0),
            Read::Real(1.5),
            Read::Null,
            Read::Null,
            Read::Text("x".repeat(*length)),
        ];
        assert_eq!(row[..], expected, "{length}");
    }
}

#[test]
fn a_schema_that_fills_more_than_a_page_has_a_tree_of_its_own() {
    let names: Vec<String> = (0..1500)
        .map(|i| format!("a column with number {i}"))
        .collect();
    let fields: Vec<String> = names.iter().map(|name| format!("{name:?}:1")).collect();
    let (file, counts) = file([("wide", format!("{{{}}}", fields.join(",")))].into_iter());
    assert_eq!(counts["wide"], 1);
    let (rows, sql) = table(&file, "wide");
    assert!(sql.contains("\"a column with number 1499\""));
    assert_eq!(rows[0].1.len(), 1500);
    assert_eq!(table(&file, "task").0, []);
}

#[test]
fn strange_names_and_values_are_kept() {
    let lines = [
        (
            "task",
            r#"{"task":9007199254740993,"result":"a\u0000b \"c\" äß 🤖","Type":"GOING"}"#,
        ),
        ("task", r#"{"task":-9223372036854775808,"created":"12"}"#),
        ("param", r#"{"num":18446744073709551615,"text":12}"#),
        (
            "sqlite_master",
            r#"{"a\"b":true,"A\"B":null,"c-d":[1,"x"],"e\u0000":{}}"#,
        ),
        ("empty", "{}"),
    ];
    let lines = lines
        .into_iter()
        .map(|(name, line)| (name, line.to_owned()));
    let (file, counts) = file(lines);
    let (tasks, _) = table(&file, "task");
    let text = |text: &str| Read::Text(text.to_owned());
    assert_eq!(tasks[0].1[1], Read::Int(9_007_199_254_740_993));
    assert_eq!(tasks[0].1[5], text("going"));
    assert_eq!(tasks[0].1[12], text("a\0b \"c\" äß 🤖"));
    assert_eq!(tasks[1].1[1], Read::Int(i64::MIN));
    assert_eq!(tasks[1].1[8], Read::Real(12.0));
    let (params, _) = table(&file, "param");
    assert_eq!(
        params[0].1[3..],
        [text("12"), Read::Real(18_446_744_073_709_551_615.0)]
    );
    let (own, sql) = table(&file, "_sqlite_master");
    assert_eq!(
        sql,
        "CREATE TABLE \"_sqlite_master\"(\"a\"\"b\",\"c_d\",\"e\u{fffd}\")"
    );
    assert_eq!(own[0].1, [Read::Null, text("[1,\"x\"]"), text("{}")]);
    assert_eq!(counts["empty"], 0);
    assert!(
        !rows(&file, 1)
            .iter()
            .any(|(_, row)| row[1] == text("empty"))
    );
}

#[test]
fn more_columns_than_sqlite_reads_are_refused() {
    let mut sqlite = Sqlite::begin(Cursor::new(Vec::new())).unwrap();
    let fields: Vec<String> = (0..2001).map(|i| format!("\"c{i}\":1")).collect();
    let error = sqlite.add_line("wide", &format!("{{{}}}", fields.join(",")));
    assert_eq!(
        error.unwrap_err().to_string(),
        "the rows of wide have more than 2000 different columns, which SQLite has not"
    );
    assert!(sqlite.add_line("task", "[1]").is_err());
}
