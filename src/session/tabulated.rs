//! Lists of designators as tables.

use super::dialogue::Table;
use crate::printing::on_one_line;
use cram::designator::value::as_designator;
use lisp::image::Image;
use lisp::image::identity::aside;
use lisp::print;
use lisp::value::Value;

/// Maximum number of rows of a table.
const MAX_ROWS: usize = 500;

/// The table of a list of designators, a row for each and a column for each of their keys, in the order
/// in which these come first. None for other values and for lists with very many elements.
pub(super) fn table_of(image: &Image, value: &Value) -> Option<Table> {
    let rows: Vec<Value> = value.iter_list().take(MAX_ROWS + 1).collect();
    if rows.is_empty() || rows.len() > MAX_ROWS {
        return None;
    }
    let mut head: Vec<String> = Vec::new();
    let mut described: Vec<Vec<(String, String)>> = Vec::new();
    for row in &rows {
        let properties = as_designator(row)?.properties().into_iter();
        let texts = properties.map(|(key, values)| {
            let key = aside(image, || print::to_string(image, &key, false)).to_lowercase();
            let value = aside(image, || {
                print::to_string(image, &values.car_or_nil(), true)
            });
            (key, on_one_line(&value))
        });
        let texts: Vec<(String, String)> = texts.collect();
        for (key, _) in &texts {
            if !head.contains(key) {
                head.push(key.clone());
            }
        }
        described.push(texts);
    }
    let rows = described.iter().map(|texts| {
        let text = |key| texts.iter().find(|(name, _)| name == key);
        let cells = head
            .iter()
            .map(|key| text(key).map_or_else(String::new, |(_, t)| t.clone()));
        cells.collect()
    });
    Some(Table {
        rows: rows.collect(),
        head,
    })
}

#[cfg(test)]
mod tests {
    use super::table_of;
    use crate::dialogue::Evaluate;
    use crate::{Session, SessionOptions};
    use lisp::value::known;

    #[test]
    fn lists_of_designators_are_tables() {
        let mut session = Session::new(&SessionOptions::default()).unwrap();
        let mut table = |form: &str| {
            session.evaluate("test", form, &mut |_| {});
            table_of(session.image(), session.image().special(known::TIMES))
        };
        let found = table(
            "(list (desig:an object (type cup) (name a)) (desig:an object (name b) (colour \"<\")))",
        );
        let found = found.expect("a table");
        assert_eq!(found.head, ["type", "name", "colour"]);
        assert_eq!(found.rows, [[":CUP", ":A", ""], ["", ":B", "\"<\""]]);
        for other in [
            "5",
            "nil",
            "'(1 2)",
            "(list (desig:an object) 1)",
            "\"text\"",
        ] {
            assert_eq!(table(other), None, "{other}");
        }
        let endless = "(let ((list (list (desig:an object)))) (setf (cdr list) list) (setf *print-circle* t) list)";
        assert_eq!(table(endless), None);
    }
}
