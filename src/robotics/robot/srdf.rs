//! What an SRDF says of a robot: pairs of links that are not checked, and postures.
//!
//! Two dialects are in use: `<disable_collisions link1 link2>`, and `<disable_self_collision link1 link2>`
//! with `<disable_all_collisions link>`.

use super::urdf_error::{Place, UrdfError};
use super::xml_elements::{Element, elements};

/// A named posture of a group of joints.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupState {
    /// Name of the posture.
    pub name: String,
    /// Name of the group.
    pub group: String,
    /// Names of joints with their positions (rad or m).
    pub positions: Vec<(String, f64)>,
}

/// The facts of an SRDF that have a use here.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Srdf {
    /// Pairs of different links that are not checked although they may touch, in the order of the file: what its author
    /// has found never to touch is not among them.
    pub pairs: Vec<(String, String)>,
    /// Those of them that, as its author says, touch as the robot is built, or nearly always.
    pub built: Vec<(String, String)>,
    /// Further pairs of different links, which are not checked since they touched in none of the random postures that
    /// its author tried.
    pub never: Vec<(String, String)>,
    /// Links that are never checked.
    pub links: Vec<String>,
    /// Postures.
    pub states: Vec<GroupState>,
}

impl Srdf {
    /// Reads the text of an SRDF; `file_name` is used only in errors. What has no use here, or lacks its
    /// names, is passed over.
    ///
    /// # Errors
    ///
    /// If the text is not well-formed.
    pub fn read(text: &str, file_name: &str) -> Result<Self, UrdfError> {
        let all = elements(text).map_err(|(offset, problem)| UrdfError {
            place: Place::at(file_name, text, offset),
            problem: Box::new(problem),
        })?;
        let value = |element: &Element<'_>, name: &str| {
            let attribute = element.attribute(name)?;
            Some(attribute.value.clone().into_owned())
        };
        let mut srdf = Self::default();
        for (place, element) in all.iter().enumerate() {
            match element.name {
                "disable_collisions" | "disable_self_collision" => {
                    let ends = (value(element, "link1"), value(element, "link2"));
                    let (Some(one), Some(other)) = ends else {
                        continue;
                    };
                    if one == other {
                        continue;
                    }
                    let reason = element.attribute("reason").map(|r| r.value.as_ref());
                    match reason {
                        Some("Never") => {
                            srdf.never.push((one, other));
                            continue;
                        }
                        Some("Adjacent" | "Default" | "AlmostAlways") => {
                            srdf.built.push((one.clone(), other.clone()));
                        }
                        _ => {}
                    }
                    srdf.pairs.push((one, other));
                }
                "disable_all_collisions" => srdf.links.extend(value(element, "link")),
                "group_state" => {
                    let inner = all
                        .iter()
                        .filter(|e| e.parent == Some(place) && e.name == "joint");
                    let position = |joint: &Element<'_>| {
                        let position = value(joint, "value")?.trim().parse().ok()?;
                        Some((value(joint, "name")?, position))
                            .filter(|(_, p): &(_, f64)| p.is_finite())
                    };
                    if let (Some(name), Some(group)) =
                        (value(element, "name"), value(element, "group"))
                    {
                        srdf.states.push(GroupState {
                            name,
                            group,
                            positions: inner.filter_map(position).collect(),
                        });
                    }
                }
                _ => {}
            }
        }
        Ok(srdf)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_dialects_are_read() {
        let text = r#"<robot name="r">
            <disable_collisions link1="a" link2="b" reason="Adjacent"/>
            <disable_self_collision link1="b" link2="c"/>
            <disable_self_collision link1="c" link2="c"/>
            <disable_collisions link1="a" link2="c" reason="Never"/>
            <disable_all_collisions link="d"/>
            <disable_collisions link1="a"/>
            <group_state name="ready" group="arm"><joint name="j" value=" -0.5"/><joint name="k" value="x"/></group_state>
        </robot>"#;
        let srdf = Srdf::read(text, "r.srdf").expect("it is well-formed");
        let pair = |a: &str, b: &str| (a.to_owned(), b.to_owned());
        assert_eq!(srdf.pairs, [pair("a", "b"), pair("b", "c")]);
        assert_eq!(srdf.built, [pair("a", "b")]);
        assert_eq!(srdf.never, [pair("a", "c")]);
        assert_eq!(srdf.links, ["d"]);
        let state = srdf.states.first().expect("there is one");
        assert_eq!(
            (state.name.as_str(), state.group.as_str()),
            ("ready", "arm")
        );
        assert_eq!(state.positions, [("j".to_owned(), -0.5)]);
        let error = Srdf::read("<robot><group_state></robot>", "r.srdf").expect_err("it is not");
        assert!(error.to_string().starts_with("r.srdf:1:"), "{error}");
    }
}
