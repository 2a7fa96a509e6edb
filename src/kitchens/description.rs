//! What the furniture of a generated kitchen is for, in the form of `world/kitchen.sexp`.

use std::fmt::Write;

use crate::furniture::Inventory;

/// The description of a kitchen with that inventory.
pub(crate) fn description(inventory: &Inventory) -> String {
    let mut text = String::new();
    let mut line = |form: String| {
        // Writing into a text cannot fail.
        let _ = writeln!(text, "{form}");
    };
    line(match &inventory.usual_joint {
        Some(joint) => format!("(kitchen kitchen :urdf-name kitchen :usual-joint {joint})"),
        None => "(kitchen kitchen :urdf-name kitchen)".to_owned(),
    });
    let counter = inventory.counters.first().map(|(_, name)| name.as_str());
    let others = inventory
        .counters
        .iter()
        .skip(1)
        .map(|(_, name)| name.as_str());
    let second = others
        .into_iter()
        .find(|name| Some(*name) != inventory.island.as_deref());
    let table = inventory
        .table
        .as_deref()
        .or(inventory.island.as_deref())
        .or(second)
        .or(counter);
    let mut places: Vec<&str> = Vec::new();
    let mut place = |name: &'static str, what: Option<String>| {
        if let Some(what) = what {
            line(format!("(place {name} {what})"));
            places.push(name);
        }
    };
    let on = |name: &str| format!(":on {name}");
    place("table", table.map(on));
    place("counter", counter.map(on));
    place("sink", inventory.sink.as_deref().map(on));
    place(
        "fridge",
        inventory
            .fridge
            .as_deref()
            .map(|name| format!(":in {name} :side front")),
    );
    // Cutlery is in the uppermost drawer, bowls and cups are in others that are high enough for them.
    let mut drawers: Vec<_> = inventory.drawers.iter().collect();
    drawers.sort_by(|a, b| b.1.total_cmp(&a.1));
    let inside = |name: &str| format!(":in {name} :side back");
    let cutlery = drawers.first().map(|(name, ..)| name.as_str());
    let others: Vec<&str> = drawers
        .iter()
        .filter(|(name, _, tall)| Some(name.as_str()) != cutlery && *tall > 0.17)
        .map(|(name, ..)| name.as_str())
        .collect();
    place("cutlery-drawer", cutlery.map(inside));
    place("bowl-drawer", others.first().map(|name| inside(name)));
    place(
        "cup-drawer",
        others.get(1).or(others.first()).map(|name| inside(name)),
    );
    let rules = [
        (
            "usually",
            "cutlery-drawer",
            "(table-setting)",
            "spoon knife fork cutlery",
        ),
        ("usually", "bowl-drawer", "(table-setting)", "bowl"),
        ("usually", "cup-drawer", "(table-setting)", "cup mug"),
        ("usually", "fridge", "(table-setting)", "milk buttermilk"),
        (
            "usually",
            "counter",
            "(table-setting table-setting-counter)",
            "bottle cereal breakfast-cereal plate",
        ),
        (
            "usually",
            "table",
            "(table-cleaning)",
            "plate bowl bottle mug milk cereal breakfast-cereal cup spoon knife fork cutlery",
        ),
        (
            "belongs",
            "table",
            "(table-setting table-setting-counter)",
            "",
        ),
        ("belongs", "cutlery-drawer", "(table-cleaning)", "spoon"),
        ("belongs", "bowl-drawer", "(table-cleaning)", "bowl cup"),
        ("belongs", "fridge", "(table-cleaning)", "milk buttermilk"),
        (
            "belongs",
            "counter",
            "(table-cleaning)",
            "cereal breakfast-cereal bottle",
        ),
        (
            "belongs",
            "sink",
            "(table-cleaning)",
            "plate mug knife fork cutlery",
        ),
    ];
    for (rule, of, contexts, types) in rules {
        if !places.contains(&of) {
            continue;
        }
        line(match types {
            "" => format!("({rule} {of} :contexts {contexts})"),
            types => format!("({rule} {of} :contexts {contexts} :types ({types}))"),
        });
    }
    if let Some(table) = table {
        line(format!(
            "(view table :link {table} :at (0 0 0) :eye (-1.75 -1.9 1.75))"
        ));
    }
    if let Some(island) = inventory.island.as_deref().or(counter) {
        line(format!(
            "(view island :link {island} :at (0 0 0) :eye (-2.0 -1.7 2.0))"
        ));
    }
    text
}
