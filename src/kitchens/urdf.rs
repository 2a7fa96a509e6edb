//! The text of a URDF, link by link.

use std::collections::BTreeSet;
use std::fmt::Write;

/// A box: its middle and its edges (m), and the name of its material.
pub(crate) type Block = ([f64; 3], [f64; 3], &'static str);

/// How a link moves.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Moves {
    /// Not at all.
    Fixed,
    /// Along its x axis, so far (m).
    Slides(f64),
    /// About its z axis, or the opposite one, so far (rad).
    Turns { is_left: bool, angle: f64 },
    /// About its y axis, downwards, so far (rad).
    Falls(f64),
}

/// How a link is joined to another one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Joint<'a> {
    /// The other link.
    pub(crate) parent: &'a str,
    /// Its place (m) and heading (rad) in the frame of that.
    pub(crate) at: [f64; 3],
    pub(crate) yaw: f64,
    pub(crate) moves: Moves,
}

impl<'a> Joint<'a> {
    /// One that does not move.
    pub(crate) fn fixed(parent: &'a str, at: [f64; 3], yaw: f64) -> Self {
        Self {
            parent,
            at,
            yaw,
            moves: Moves::Fixed,
        }
    }
}

/// Least edge (m) of a block: smaller ones are left out.
const LEAST: f64 = 1e-4;

/// The text of a URDF under construction.
pub(crate) struct Urdf {
    text: String,
    names: BTreeSet<String>,
    /// A name that two links have.
    doubled: Option<String>,
}

impl Urdf {
    /// An empty one, whose root is `world`.
    pub(crate) fn new(name: &str, materials: &[(&str, [f64; 3])]) -> Self {
        let mut urdf = Self {
            text: String::with_capacity(1 << 16),
            names: BTreeSet::new(),
            doubled: None,
        };
        urdf.line(format_args!("<?xml version=\"1.0\"?>"));
        urdf.line(format_args!("<robot name=\"{name}\">"));
        for (name, [red, green, blue]) in materials {
            urdf.line(format_args!(
                "  <material name=\"{name}\"><color rgba=\"{red} {green} {blue} 1\"/></material>"
            ));
        }
        urdf.line(format_args!("  <link name=\"world\"/>"));
        urdf
    }

    fn line(&mut self, text: impl std::fmt::Display) {
        // Writing into a text cannot fail.
        let _ = writeln!(self.text, "{text}");
    }

    /// Adds a link of blocks, at a joint.
    pub(crate) fn link(&mut self, name: &str, joint: Joint<'_>, blocks: &[Block]) {
        self.link_that_shows(name, joint, blocks, blocks);
    }

    /// The same for a link that shows other blocks than those that are solid.
    pub(crate) fn link_that_shows(
        &mut self,
        name: &str,
        joint: Joint<'_>,
        blocks: &[Block],
        shown: &[Block],
    ) {
        if !self.names.insert(name.to_owned()) {
            self.doubled.get_or_insert_with(|| name.to_owned());
        }
        self.line(format_args!("  <link name=\"{name}\">"));
        let both = [(shown, true), (blocks, false)];
        let both = both
            .into_iter()
            .flat_map(|(blocks, is_shown)| blocks.iter().map(move |block| (block, is_shown)));
        let both = both.filter(|((_, size, _), _)| size.iter().all(|edge| *edge >= LEAST));
        for (([x, y, z], [a, b, c], material), is_shown) in both {
            let shape = format!(
                "<origin xyz=\"{x:.4} {y:.4} {z:.4}\"/><geometry><box size=\"{a:.4} {b:.4} {c:.4}\"/></geometry>"
            );
            self.line(match is_shown {
                true => format!("    <visual>{shape}<material name=\"{material}\"/></visual>"),
                false => format!("    <collision>{shape}</collision>"),
            });
        }
        self.line(format_args!("  </link>"));
        let Joint {
            parent,
            at: [x, y, z],
            yaw,
            moves,
        } = joint;
        let (kind, axis, upper) = match moves {
            Moves::Fixed => ("fixed", None, 0.0),
            Moves::Slides(way) => ("prismatic", Some("1 0 0"), way),
            Moves::Turns { is_left, angle } => {
                let axis = if is_left { "0 0 -1" } else { "0 0 1" };
                ("revolute", Some(axis), angle)
            }
            Moves::Falls(angle) => ("revolute", Some("0 1 0"), angle),
        };
        self.line(format_args!(
            "  <joint name=\"{name}_joint\" type=\"{kind}\">"
        ));
        self.line(format_args!(
            "    <parent link=\"{parent}\"/><child link=\"{name}\"/>"
        ));
        self.line(format_args!(
            "    <origin xyz=\"{x:.4} {y:.4} {z:.4}\" rpy=\"0 0 {yaw}\"/>"
        ));
        if let Some(axis) = axis {
            self.line(format_args!(
                "    <axis xyz=\"{axis}\"/><limit lower=\"0\" upper=\"{upper}\" effort=\"100\" velocity=\"1\"/>"
            ));
        }
        self.line(format_args!("  </joint>"));
    }

    /// A name that two links have, which no reader would take.
    pub(crate) fn doubled(&self) -> Option<&str> {
        self.doubled.as_deref()
    }

    /// The whole text.
    pub(crate) fn finish(mut self) -> String {
        self.line(format_args!("</robot>"));
        self.text
    }
}
