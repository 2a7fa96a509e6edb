//! Reading other names of links and joints from s-expressions.

use super::{Alias, AliasedPart, KinematicTree};
use crate::sexp::{DataError, DataProblem, Record};
use closest_name::closest_name;

/// The aliases that records `(alias NAME LINK-OR-JOINT)` give to links and joints of a tree.
pub(crate) fn aliases<'a>(
    tree: &KinematicTree,
    records: impl Iterator<Item = &'a Record<'a>>,
) -> Result<Vec<Alias>, DataError> {
    let mut aliases: Vec<Alias> = Vec::new();
    for record in records {
        let [name_node, part_node] = record.things() else {
            return Err(record.node().expected("(alias NAME LINK-OR-JOINT)"));
        };
        let (name, part) = (name_node.symbol()?, part_node.symbol()?);
        let is_alias = aliases.iter().any(|alias| alias.name == name);
        if is_alias || tree.link_named(name).is_some() || tree.joint_named(name).is_some() {
            return Err(name_node.error(DataProblem::Repeated(format!("the name {name}"))));
        }
        let link = tree.link_named(part).map(AliasedPart::Link);
        let part = link.or_else(|| tree.joint_named(part).map(AliasedPart::Joint));
        let part = part.ok_or_else(|| {
            let links = tree.links().map(|(_, link)| link.name.as_str());
            let joints = tree.joints().map(|(_, joint)| joint.name.as_str());
            let wanted = part_node.symbol().unwrap_or_default();
            part_node.unknown(
                "link or joint",
                wanted,
                closest_name(wanted, links.chain(joints)),
            )
        })?;
        aliases.push(Alias {
            name: name.to_owned(),
            part,
        });
    }
    Ok(aliases)
}
