//! Sizes of fixtures: as a layout says, as those of other fixtures, or usual ones where it leaves them to meshes.

use closest_name::closest_name;

use super::LayoutError;
use super::layout::Reader;
use super::node::{Data, Node};

/// Width, depth and height (m) of fixtures of a type. They are those that RoboCasa's registry scales its meshes
/// to; what it leaves to the mesh is that of a usual thing of the kind.
const SIZES: [(&str, [f64; 3]); 46] = [
    ("stove", [0.76, 0.66, 0.915]),
    ("stove_wide", [0.91, 0.70, 0.915]),
    ("stovetop", [0.76, 0.55, 0.03]),
    ("oven", [0.70, 0.60, 0.60]),
    ("microwave", [0.75, 0.45, 0.42]),
    ("hood", [0.76, 0.60, 0.60]),
    ("sink", [0.70, 0.53, 0.22]),
    ("fridge_french_door", [0.85, 0.80, 1.78]),
    ("fridge_side_by_side", [0.85, 0.80, 1.75]),
    ("fridge_bottom_freezer", [0.78, 0.80, 1.75]),
    ("dishwasher", [0.60, 0.60, 0.89]),
    ("stool", [0.42, 0.42, 0.66]),
    ("hinge_cabinet", [0.80, 0.40, 0.92]),
    ("single_cabinet", [0.50, 0.40, 0.92]),
    ("open_cabinet", [0.80, 0.40, 0.92]),
    ("panel_cabinet", [0.60, 0.60, 0.84]),
    ("drawer", [0.60, 0.60, 0.25]),
    ("counter", [0.72, 0.60, 0.60]),
    ("box", [0.50, 0.50, 0.50]),
    ("paper_towel", [0.17, 0.17, 0.33]),
    ("candle", [0.08, 0.08, 0.16]),
    ("turmeric", [0.05, 0.05, 0.15]),
    ("cinnamon", [0.05, 0.05, 0.13]),
    ("paprika", [0.05, 0.05, 0.12]),
    ("flower_vase", [0.18, 0.18, 0.40]),
    ("utensil_set", [0.14, 0.14, 0.35]),
    ("utensil_holder", [0.14, 0.14, 0.35]),
    ("plant", [0.18, 0.18, 0.24]),
    ("knife_block", [0.12, 0.18, 0.24]),
    ("soap_dispenser", [0.08, 0.08, 0.20]),
    ("fruit_bowl", [0.28, 0.28, 0.14]),
    ("oil_bottle", [0.07, 0.07, 0.21]),
    ("vinegar_bottle", [0.07, 0.07, 0.21]),
    ("salt_shaker", [0.05, 0.05, 0.11]),
    ("pepper_shaker", [0.05, 0.05, 0.11]),
    ("tiered_basket", [0.30, 0.30, 0.40]),
    ("digital_scale", [0.15, 0.20, 0.04]),
    ("glass_cup", [0.09, 0.09, 0.13]),
    ("jar", [0.10, 0.10, 0.14]),
    ("dish_rack", [0.42, 0.32, 0.18]),
    ("coffee_machine", [0.22, 0.32, 0.35]),
    ("toaster", [0.28, 0.18, 0.19]),
    ("toaster_oven", [0.46, 0.38, 0.27]),
    ("blender", [0.20, 0.20, 0.42]),
    ("stand_mixer", [0.22, 0.36, 0.33]),
    ("electric_kettle", [0.22, 0.16, 0.24]),
];

impl Reader {
    /// The usual size of a type; an error if there is no such type.
    pub(super) fn usual_size(&self, kind: &str, node: &Node) -> Result<[f64; 3], LayoutError> {
        usual_size(kind).ok_or_else(|| {
            let known = types().chain(["stack", "housing_cabinet", "wall", "floor"]);
            let near = closest_name(kind, known);
            let hint = near.map_or_else(String::new, |near| format!("; did you mean {near}?"));
            node.error(format!("there is no type of fixtures {kind}{hint}"))
        })
    }

    /// The size of a fixture of a type.
    pub(super) fn size(
        &self,
        kind: &str,
        group: &str,
        node: &Node,
    ) -> Result<[f64; 3], LayoutError> {
        let usual = match kind {
            "housing_cabinet" => [0.0; 3],
            _ => self.usual_size(kind, node)?,
        };
        let Some(given) = node.get("size").filter(|size| !size.is_null()) else {
            return match kind {
                "housing_cabinet" => self.housing_size([None; 3], group, node),
                _ => Ok(usual),
            };
        };
        let items = given.items("a size")?;
        let [width, depth, height] = items else {
            return Err(given.error("a size has three numbers: width, depth, height"));
        };
        let mut size = [None; 3];
        for (axis, item) in [width, depth, height].into_iter().enumerate() {
            size[axis] = match &item.data {
                _ if item.is_null() => None,
                // The size of another fixture.
                Data::Text(text) if text.parse::<f64>().is_err() => {
                    Some(self.named(text, group, item)?.size[axis])
                }
                _ => Some(item.number("a size")?),
            };
        }
        if let Some(whole) = node.get("stack_height").filter(|whole| !whole.is_null()) {
            let mut rest = whole.number("stack_height")?;
            let others = node.get("stack_fixtures");
            let others = others.map_or(Ok(&[][..]), |others| others.items("stack_fixtures"))?;
            for other in others {
                rest -= self.named(other.text("a fixture")?, group, other)?.size[2];
            }
            size[2] = Some(rest);
        }
        if kind == "housing_cabinet" {
            return self.housing_size(size, group, node);
        }
        let size = [0, 1, 2].map(|axis| size[axis].unwrap_or(usual[axis]));
        self.checked(size, given)
    }

    /// A size, unless nothing is as large or as small.
    pub(super) fn checked(&self, size: [f64; 3], node: &Node) -> Result<[f64; 3], LayoutError> {
        match size.iter().all(|length| (0.0005..=30.0).contains(length)) {
            true => Ok(size),
            false => Err(node.error(format!(
                "a fixture is between 0.001 and 30 m large, this one is {size:?}"
            ))),
        }
    }

    /// How thick a frame is around something at either end of an axis (m), where that is given.
    fn padding(&self, node: &Node) -> Result<[[Option<f64>; 2]; 3], LayoutError> {
        let mut padding = [[None; 2]; 3];
        let Some(given) = node.get("padding").filter(|given| !given.is_null()) else {
            return Ok(padding);
        };
        for (axis, pair) in given.items("padding")?.iter().enumerate().take(3) {
            if pair.is_null() {
                continue;
            }
            for (end, one) in pair.items("a padding")?.iter().enumerate().take(2) {
                if !one.is_null() {
                    padding[axis][end] = Some(one.number("a padding")?);
                }
            }
        }
        Ok(padding)
    }

    /// The size of a frame around something.
    fn housing_size(
        &self,
        given: [Option<f64>; 3],
        group: &str,
        node: &Node,
    ) -> Result<[f64; 3], LayoutError> {
        let inner = self.interior(group, node)?;
        let inner = inner.ok_or_else(|| node.error("a housing_cabinet has an interior_obj"))?;
        let padding = self.padding(node)?;
        let mut size = [0.0; 3];
        for axis in 0..3 {
            size[axis] = match (given[axis], padding[axis]) {
                (Some(size), _) => size,
                (None, [Some(low), Some(high)]) => low + inner.size[axis] + high,
                _ => {
                    return Err(node.error(
                        "a housing_cabinet has a size, or a padding at both ends of the axis",
                    ));
                }
            };
        }
        self.checked(size, node)
    }

    /// How thick a frame is on all sides.
    pub(super) fn frame(
        &self,
        group: &str,
        size: [f64; 3],
        node: &Node,
    ) -> Result<[[f64; 2]; 3], LayoutError> {
        let inner = self.interior(group, node)?;
        let inner = inner.ok_or_else(|| node.error("a housing_cabinet has an interior_obj"))?;
        let padding = self.padding(node)?;
        Ok([0, 1, 2].map(|axis| {
            let rest = size[axis] - inner.size[axis];
            match padding[axis] {
                [Some(low), Some(high)] => [low, high],
                [Some(low), None] => [low, rest - low],
                [None, Some(high)] => [rest - high, high],
                [None, None] => [rest / 2.0; 2],
            }
        }))
    }
}

/// The usual size of a fixture of a type; `None` if there is no such type.
fn usual_size(kind: &str) -> Option<[f64; 3]> {
    let found = SIZES.iter().find(|(name, _)| *name == kind);
    found.map(|(_, size)| *size)
}

/// The types of which it knows sizes.
fn types() -> impl Iterator<Item = &'static str> {
    SIZES.iter().map(|(name, _)| *name)
}
