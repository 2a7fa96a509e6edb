//! What the robot's own camera sees, drawn for users: colours, distances, and which pixels
//! count as which body. The object that is sought is outlined even where something hides it,
//! which explains why it is not seen.
//!
//! Distances and segmentation come from the same picture that perception uses.

use nalgebra::Point3;

use super::image::{Image, Rgb};
use super::lettering::Line;
use super::looks::Looks;
use super::render::render;
use robotics::perception::mesh::Mesh;
use robotics::perception::{Camera, Picture, Sight, Visibility};
use robotics::world::{Object, PartKey, World};

/// Width of the picture (pixels) by default.
pub const WIDTH: usize = 960;

/// Minimum width (pixels) that leaves room for three panels.
pub(crate) const MIN_WIDTH: usize = 240;

/// Colours of the background and the text of the strip below the panels.
const PAPER: Rgb = [24, 26, 30];
const INK: Rgb = [226, 228, 232];

/// Outline of an object that is seen, and of one that is not.
const SEEN: Rgb = [64, 235, 120];
const UNSEEN: Rgb = [255, 96, 208];

/// Colours of objects in the segmentation, in the order in which the objects appeared.
const OBJECT_COLORS: [Rgb; 12] = [
    [230, 70, 60],
    [70, 150, 240],
    [250, 190, 50],
    [90, 200, 110],
    [190, 110, 230],
    [240, 130, 40],
    [60, 200, 200],
    [240, 120, 170],
    [150, 110, 70],
    [170, 200, 60],
    [120, 120, 230],
    [200, 190, 170],
];
const ROBOT_COLOR: Rgb = [222, 220, 210];
const NOTHING_COLOR: Rgb = [14, 15, 18];

/// Number of columns in the list of objects.
const LIST_COLUMNS: usize = 3;

/// Distances (m) at which the colours of the depth panel start and end.
const DEPTHS: [f64; 2] = [0.4, 3.0];

/// Colours from near to far.
const DEPTH_COLORS: [[f64; 3]; 6] = [
    [250.0, 235.0, 120.0],
    [245.0, 150.0, 60.0],
    [205.0, 70.0, 85.0],
    [120.0, 45.0, 120.0],
    [50.0, 35.0, 100.0],
    [18.0, 18.0, 48.0],
];

/// The picture of the robot's camera.
#[derive(Clone, Debug)]
pub struct CameraPicture {
    /// Three panels with a legend below them.
    pub image: Image,
    /// How much of each sought object is in sight, in the order given.
    pub sought: Vec<Visibility>,
}

impl CameraPicture {
    /// What the camera sees now, about `width` pixels wide, with the objects of these names
    /// sought. Names of objects that do not exist are ignored.
    pub fn take(world: &World, looks: &Looks, sought: &[String], width: usize) -> Self {
        let sight = Sight::of_robot(world);
        let through = world.models().description.camera();
        let native = *sight.picture().camera();
        let unit = width.max(MIN_WIDTH) / 3;
        let small = [unit, unit * native.height / native.width.max(1)];
        let large = [small[0] * 2, small[1] * 2];
        let seen: Vec<_> = sought
            .iter()
            .filter_map(|name| sight.visibility(name).ok())
            .collect();

        let mut strip = Strip::new(unit);
        seen.iter().for_each(|v| strip.tell(v));
        strip.list(world, sight.picture());
        let mut image = Image::filled(3 * unit, large[1] + strip.height(3 * unit), PAPER);
        let resized = |[width, height]: [usize; 2]| Camera {
            width,
            height,
            ..Camera::new(through, native.pose)
        };
        let mut panels = [
            (
                render(&looks.scene(world), &resized(large)),
                [0, 0],
                "Colour",
            ),
            (depths(sight.picture(), small), [large[0], 0], "Depth"),
            (
                segments(world, sight.picture(), small),
                [large[0], small[1]],
                "Segments",
            ),
        ];
        for (panel, [left, top], title) in &mut panels {
            let camera = resized([panel.width(), panel.height()]);
            // Names are written once, in the large panel.
            let mut names = ([*left, *top] == [0, 0]).then(Vec::new);
            for one in &seen {
                // A visibility always belongs to an object of the world.
                if let Ok(object) = world.object(&one.object) {
                    let color = if one.is_seen() { SEEN } else { UNSEEN };
                    outline(panel, world, object, &camera, color, names.as_mut());
                }
            }
            let title = Line {
                text: title,
                size: unit / 20,
                color: INK,
            };
            title.draw_on_plate(panel, 0, 0);
            image.paste(panel, *left, *top);
        }
        strip.draw(&mut image, large[1]);
        Self {
            image,
            sought: seen,
        }
    }
}

/// The pixel of the picture shown by a pixel of a panel of this size.
fn shown(picture: &Picture, size: [usize; 2], column: usize, row: usize) -> [usize; 2] {
    let camera = picture.camera();
    [
        column * camera.width / size[0].max(1),
        row * camera.height / size[1].max(1),
    ]
}

fn panel(size: [usize; 2], color: impl Fn(usize, usize) -> Rgb) -> Image {
    let mut image = Image::filled(size[0], size[1], NOTHING_COLOR);
    for row in 0..size[1] {
        for column in 0..size[0] {
            image.set(column, row, color(column, row));
        }
    }
    image
}

fn depths(picture: &Picture, size: [usize; 2]) -> Image {
    let mut image = panel(size, |column, row| {
        let [column, row] = shown(picture, size, column, row);
        picture
            .depth(column, row)
            .map_or(NOTHING_COLOR, depth_color)
    });
    let text = format!("{} to {} m", DEPTHS[0], DEPTHS[1]);
    let legend = Line {
        text: &text,
        size: size[0] / 20,
        color: INK,
    };
    let [width, height] = legend.plate();
    if size[0] > width && size[1] > 2 * height + 6 {
        let (left, top) = (size[0] - width, size[1] - height);
        legend.draw_on_plate(&mut image, left, top);
        for column in left..size[0] {
            let share = (column - left) as f64 / width as f64;
            let color = depth_color(DEPTHS[0] + share * (DEPTHS[1] - DEPTHS[0]));
            image.fill([column, top - 6], [1, 6], color);
        }
    }
    image
}

fn depth_color(depth: f64) -> Rgb {
    let share = ((depth - DEPTHS[0]) / (DEPTHS[1] - DEPTHS[0])).clamp(0.0, 1.0);
    let place = share * (DEPTH_COLORS.len() - 1) as f64;
    // The share is within the table; the last colour is its own neighbour.
    let first = (place as usize).min(DEPTH_COLORS.len() - 2);
    let (near, far) = (DEPTH_COLORS[first], DEPTH_COLORS[first + 1]);
    let mix = |i: usize| near[i] + (far[i] - near[i]) * (place - first as f64);
    [0, 1, 2].map(|i| mix(i) as u8)
}

fn segments(world: &World, picture: &Picture, size: [usize; 2]) -> Image {
    panel(size, |column, row| {
        let [column, row] = shown(picture, size, column, row);
        let place = row * picture.camera().width + column;
        segment_color(world, picture.keys().get(place).copied().flatten())
    })
}

fn segment_color(world: &World, key: Option<PartKey>) -> Rgb {
    match key {
        None | Some(PartKey::Floor) => NOTHING_COLOR,
        Some(PartKey::Robot(_)) => ROBOT_COLOR,
        // Greys that distinguish a link from its neighbours.
        Some(PartKey::Furniture(link)) => {
            let shade = 54 + (link.wrapping_mul(47) % 80) as u8;
            [shade, shade + 4, shade + 12]
        }
        Some(key) => {
            let place = world.objects().position(|object| object.key() == key);
            // A remainder is always within the table.
            OBJECT_COLORS[place.unwrap_or(0) % OBJECT_COLORS.len()]
        }
    }
}

/// Outlines the object as it would appear with nothing in front of it, or draws an arrow at the
/// border if it is outside.
fn outline(
    image: &mut Image,
    world: &World,
    object: &Object,
    camera: &Camera,
    color: Rgb,
    names: Option<&mut Vec<Plate>>,
) {
    let Ok(pose) = world.object_pose(object.name()) else {
        return;
    };
    let mut alone = Picture::new(*camera);
    for placed in object.shapes() {
        alone.draw(
            object.key(),
            &(pose * placed.pose),
            &Mesh::of(&placed.shape),
        );
    }
    let (width, height) = (camera.width, camera.height);
    let covered = |column: usize, row: usize| {
        column < width && alone.keys().get(row * width + column) == Some(&Some(object.key()))
    };
    let thickness = 1 + width / 500;
    for row in 0..height {
        for column in 0..width {
            if covered(column, row) {
                continue;
            }
            let near = |distance: usize| {
                covered(column + distance, row)
                    || covered(column, row + distance)
                    || (column >= distance && covered(column - distance, row))
                    || (row >= distance && covered(column, row - distance))
            };
            if (1..=thickness).any(near) {
                image.set(column, row, color);
            }
        }
    }
    let middle = Point3::from(pose.translation.vector);
    let name = Line {
        text: object.name(),
        size: width / 40,
        color,
    };
    let at = match camera.pixel_of(&middle) {
        Some([x, y]) if is_within(x, width) && is_within(y, height) => {
            let top = (0..height).find(|row| (0..width).any(|column| covered(column, *row)));
            let top = top.unwrap_or(y as usize);
            let above = top.saturating_sub(name.height() * 5 / 4);
            let left = (x as usize).saturating_sub(name.width() / 2);
            Some([left, above])
        }
        _ => arrow(image, camera, &middle, &name),
    };
    if let (Some(at), Some(names)) = (at, names) {
        let size = name.plate();
        let plate = free_place(names, Plate { at, size });
        name.draw_on_plate(image, plate.at[0], plate.at[1]);
        names.push(plate);
    }
}

/// Where a name is written.
#[derive(Clone, Copy)]
struct Plate {
    at: [usize; 2],
    size: [usize; 2],
}

impl Plate {
    fn overlaps(&self, other: &Self) -> bool {
        let apart = |i: usize| {
            self.at[i] >= other.at[i] + other.size[i] || other.at[i] >= self.at[i] + self.size[i]
        };
        !apart(0) && !apart(1)
    }
}

/// The place moved up until it covers no other name, if there is room.
fn free_place(others: &[Plate], wanted: Plate) -> Plate {
    let mut plate = wanted;
    while let Some(other) = others.iter().find(|other| other.overlaps(&plate)) {
        match other.at[1].checked_sub(plate.size[1] + 1) {
            Some(row) => plate.at[1] = row,
            None => return wanted,
        }
    }
    plate
}

fn is_within(place: f64, end: usize) -> bool {
    (0.0..end as f64).contains(&place)
}

/// Draws an arrow at the border that points to a place outside the picture; returns where the
/// name goes.
fn arrow(
    image: &mut Image,
    camera: &Camera,
    point: &Point3<f64>,
    name: &Line<'_>,
) -> Option<[usize; 2]> {
    let there = camera.pose.inverse_transform_point(point);
    let reach = libm::hypot(there.x, there.y);
    if reach < 1e-9 {
        return None;
    }
    let (x, y) = (there.x / reach, there.y / reach);
    let size = name.height() as f64 / 2.0;
    let half = [
        camera.width as f64 / 2.0 - size,
        camera.height as f64 / 2.0 - size,
    ];
    // As far from the middle as the nearer pair of borders allows.
    let far = (half[0] / x.abs().max(1e-9)).min(half[1] / y.abs().max(1e-9));
    let tip = [
        half[0] + size + x * far + x * size * 0.8,
        half[1] + size + y * far + y * size * 0.8,
    ];
    let steps = (size * 2.0) as usize;
    for back in 0..steps {
        let back = back as f64;
        let aside = (back / 2.0) as i32;
        for aside in -aside..=aside {
            let aside = f64::from(aside);
            let column = tip[0] - x * back - y * aside;
            let row = tip[1] - y * back + x * aside;
            if column >= 0.0 && row >= 0.0 {
                image.set(column as usize, row as usize, name.color);
            }
        }
    }
    let text = [
        tip[0] - x * size * 2.0 - name.width() as f64 * (0.5 + 0.5 * x),
        tip[1] - y * size * 2.0 - name.height() as f64 * (0.5 + 0.5 * y),
    ];
    // Casts saturate at zero; both borders are far below the largest number.
    let plate = name.plate();
    let ends = [camera.width, camera.height];
    Some([0, 1].map(|axis| (text[axis] as usize).min(ends[axis].saturating_sub(plate[axis]))))
}

/// The legend below the panels.
struct Strip {
    /// Height of a line and distance between letters (pixels).
    height: usize,
    advance: usize,
    /// Lines about the sought objects.
    lines: Vec<(Rgb, String)>,
    /// Objects in the picture.
    seen: Vec<(Rgb, String)>,
}

impl Strip {
    fn new(unit: usize) -> Self {
        let line = Line {
            text: "",
            size: unit / 16,
            color: INK,
        };
        Self {
            height: line.height(),
            advance: line.advance(),
            lines: Vec::new(),
            seen: Vec::new(),
        }
    }

    fn tell(&mut self, visibility: &Visibility) {
        let (color, verdict) = match visibility.is_seen() {
            true => (SEEN, "seen"),
            false => (UNSEEN, "not seen"),
        };
        let needed = (visibility.needed_share * 100.0).round();
        let text = format!("{verdict}: {visibility} ({needed} % needed)");
        self.lines.push((color, text));
    }

    /// Adds the objects of which the camera sees anything, in the colours of the segmentation.
    fn list(&mut self, world: &World, picture: &Picture) {
        for object in world.objects() {
            let count = picture.count(object.key());
            if count > 0 {
                let color = segment_color(world, Some(object.key()));
                let name = object.name();
                self.seen.push((color, format!("{name}: {count} pixels")));
            }
        }
    }

    /// The lines, cut into pieces that fit.
    fn pieces(&self, width: usize) -> Vec<(Option<Rgb>, String)> {
        let fits = (width / self.advance).saturating_sub(4).max(8);
        let mut pieces = Vec::new();
        for (color, text) in &self.lines {
            // Only the first piece of a line has its colour beside it.
            let mut square = Some(*color);
            let mut piece = String::new();
            for word in text.split(' ') {
                let is_full = piece.chars().count() + 1 + word.chars().count() > fits;
                if is_full && !piece.is_empty() {
                    let whole = std::mem::replace(&mut piece, "  ".to_owned());
                    pieces.push((square.take(), whole));
                }
                if !piece.trim().is_empty() {
                    piece.push(' ');
                }
                piece.push_str(word);
            }
            pieces.push((square.take(), piece));
        }
        pieces
    }

    fn line_height(&self) -> usize {
        self.height + self.height / 4
    }

    /// Number of rows in the list of objects.
    fn rows(&self) -> usize {
        self.seen.len().div_ceil(LIST_COLUMNS)
    }

    fn height(&self, width: usize) -> usize {
        match self.pieces(width).len() + self.rows() {
            0 => 0,
            count => count * self.line_height() + self.height / 2,
        }
    }

    fn draw(&self, image: &mut Image, top: usize) {
        let pieces = self.pieces(image.width());
        let top = top + self.height / 4;
        for (place, (color, text)) in pieces.iter().enumerate() {
            self.entry(image, [0, top + place * self.line_height()], *color, text);
        }
        let column = image.width() / LIST_COLUMNS;
        for (place, (color, text)) in self.seen.iter().enumerate() {
            let row = top + (pieces.len() + place / LIST_COLUMNS) * self.line_height();
            let left = place % LIST_COLUMNS * column;
            self.entry(image, [left, row], Some(*color), text);
        }
    }

    fn entry(&self, image: &mut Image, [left, top]: [usize; 2], color: Option<Rgb>, text: &str) {
        if let Some(color) = color {
            let (inset, size) = (self.height / 8, self.height * 3 / 4);
            image.fill([left + self.advance, top + inset], [size; 2], color);
        }
        let line = Line {
            text,
            size: self.height,
            color: INK,
        };
        line.draw(image, left + 3 * self.advance, top);
    }
}
