//! Sizes of fixtures where a layout leaves them to meshes.

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

/// The usual size of a fixture of a type; `None` if there is no such type.
pub(super) fn usual_size(kind: &str) -> Option<[f64; 3]> {
    let found = SIZES.iter().find(|(name, _)| *name == kind);
    found.map(|(_, size)| *size)
}

/// The types of which it knows sizes.
pub(super) fn types() -> impl Iterator<Item = &'static str> {
    SIZES.iter().map(|(name, _)| *name)
}
