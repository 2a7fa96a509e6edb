//! Targets that are descriptions of robots, kitchens and objects: URDF, SRDF, s-expressions and meshes.

use std::io;
use std::sync::{Arc, LazyLock};

use super::corpus;
use super::target::{Taken, Taker, Target};
use descriptions::{KITCHEN_DESCRIPTION, KITCHEN_URDF, PR2_DESCRIPTION, PR2_URDF};
use robotics::mesh::{MeshFiles, MeshLibrary, MeshPurpose, MeshRequest};
use robotics::robot::{KinematicTree, RobotDescription, Srdf};
use robotics::world::grasp_library::{GRASPS, GraspLibrary};
use robotics::world::object_library::{OBJECTS, ObjectLibrary};
use robotics::world::{KitchenDescription, Models, RobotConfiguration, World};

/// Words of XML.
const XML: &[&str] = &[
    "<",
    ">",
    "/>",
    "</",
    "\"",
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "<?",
    "?>",
    "&lt;",
    "&#0;",
    "&#x110000;",
    "<link name=\"x\"/>",
    "<joint",
    "</robot>",
    " xyz=\"",
    " rpy=\"",
    " size=\"",
    " radius=\"",
    " scale=\"",
    "<mimic joint=\"j\"/>",
    "<box ",
    "<cylinder radius=\"1\" length=\"1\"/>",
    "<sphere radius=\"",
    "type=\"fixed\"",
    "type=\"planar\"",
    "1e-6 ",
    "1e4 ",
    "\u{e4}",
    "\0",
];

/// Words of descriptions.
const DATA: &[&str] = &[
    "(",
    ")",
    "()",
    " . ",
    "'",
    "#",
    "#(",
    ";",
    "#;",
    "#|",
    "\"",
    "|",
    "\\",
    ":",
    "#:",
    "(object ",
    "(grasp ",
    "(arm ",
    "(available ",
    "(kinds ",
    "(order ",
    "(rotation ",
    "1e400",
    "-",
    "+inf.0",
    "#t",
    "nil",
    "\u{e4}",
];

/// Words of meshes.
const MESH: &[&str] = &[
    "solid ",
    "endsolid",
    " facet normal 0 0 0\n outer loop\n",
    "vertex ",
    "endloop",
    "endfacet\n",
    "v ",
    "f ",
    "vt ",
    "vn ",
    "o ",
    "usemtl ",
    "mtllib ",
    "-1",
    "/",
    "//",
    "1e39",
    "\0\0\u{80}?",
    "\u{1}\0\0\0",
    "<COLLADA>",
    "<node>",
    "</node>",
    "<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>",
    "<instance_node url=\"#n\"/>",
    "<float_array count=\"",
    "<p>",
    "<vcount>",
    "stride=\"",
    "offset=\"",
    "<triangles count=\"1\">",
];

pub(super) fn targets() -> Vec<Target> {
    let data = |name, share, corpus, open| Target {
        name,
        share,
        least_read: 90,
        words: DATA,
        corpus,
        open,
    };
    vec![
        Target {
            name: "urdf",
            share: 40,
            least_read: 90,
            words: XML,
            corpus: urdfs,
            open: urdf,
        },
        Target {
            name: "srdf",
            share: 10,
            least_read: 95,
            words: XML,
            corpus: || vec![SRDF.as_bytes().to_vec()],
            open: || {
                Box::new(|input| {
                    let text = String::from_utf8_lossy(input);
                    Ok(Taken::if_read(Srdf::read(&text, "r.srdf").is_ok()))
                })
            },
        },
        data("objects", 20, || records(OBJECTS), objects),
        data("grasps", 20, || records(GRASPS), grasps),
        data("robot", 20, || records(PR2_DESCRIPTION), robot),
        data("kitchen", 20, || records(KITCHEN_DESCRIPTION), kitchen),
        Target {
            name: "mesh",
            share: 30,
            least_read: 95,
            words: MESH,
            corpus: meshes,
            open: mesh,
        },
    ]
}

const SMALL_URDF: &str = "<?xml version=\"1.0\"?>\n<robot name=\"r\"><!-- three links -->\
    <material name=\"red\"><color rgba=\"1 0 0 1\"/></material>\
    <link name=\"a\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" \
    iyz=\"0\" izz=\"1\"/></inertial><visual><origin xyz=\"0 0 1\"/><geometry><box size=\"1 1 1\"/>\
    </geometry><material name=\"red\"/></visual>\
    <collision><geometry><cylinder radius=\"0.3\" length=\"1\"/></geometry></collision></link>\
    <link name=\"b\"><collision><origin xyz=\"0 0 1\" rpy=\"0 1 0\"/><geometry>\
    <sphere radius=\"0.2\"/></geometry></collision></link><link name=\"c\"><collision><geometry>\
    <box size=\"0.1 2 1\"/></geometry></collision></link>\
    <joint name=\"j\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0 1\"/>\
    <limit lower=\"-1\" upper=\"1\" velocity=\"1\" effort=\"3\"/></joint>\
    <joint name=\"k\" type=\"prismatic\"><origin xyz=\"1 2 0\"/><parent link=\"b\"/><child link=\"c\"/>\
    <axis xyz=\"1 0 0\"/><limit lower=\"0\" upper=\"0.5\" velocity=\"1\" effort=\"3\"/>\
    <mimic joint=\"j\" multiplier=\"2\" offset=\"1\"/></joint></robot>";

const SRDF: &str = "<robot name=\"r\">\n<disable_collisions link1=\"a\" link2=\"b\" reason=\"Adjacent\"/>\n\
    <disable_self_collision link1=\"b\" link2=\"c\"/>\n<disable_all_collisions link=\"d\"/>\n\
    <group_state name=\"ready\" group=\"arm\"><joint name=\"j\" value=\" -0.5\"/><joint name=\"k\" \
    value=\"x\"/></group_state>\n</robot>";

/// The elements of a file that begin with these characters, each to its end.
fn elements<'a>(text: &'a str, tag: &str) -> Vec<&'a str> {
    let begin = format!("<{tag} name=");
    let end = format!("</{tag}>");
    let mut found = Vec::new();
    for (at, _) in text.match_indices(&begin) {
        let rest = &text[at..];
        let opening = rest.find('>').unwrap_or(rest.len() - 1);
        let length = match rest[..opening].ends_with('/') {
            true => Some(opening + 1),
            false => rest.find(&end).map(|at| at + end.len()),
        };
        found.extend(length.map(|length| &rest[..length]));
    }
    found
}

/// What follows some characters, up to the next quote.
fn quoted<'a>(text: &'a str, before: &str) -> Option<&'a str> {
    text.split(before).nth(1)?.split('"').next()
}

/// A robot of two links for each joint of the project's files.
fn urdfs() -> Vec<Vec<u8>> {
    let mut pieces = Vec::new();
    for (_, text) in corpus::files("world", ".urdf") {
        let links = elements(&text, "link");
        let link = |name: &str| {
            let mut links = links.iter();
            links.find(|link| quoted(link, "name=\"") == Some(name))
        };
        let materials = text.lines().filter(|line| line.starts_with("  <material "));
        let materials: String = materials.collect::<Vec<_>>().join("\n");
        for joint in elements(&text, "joint") {
            let ends = ["parent", "child"].map(|end| {
                let name = quoted(joint, &format!("<{end} link=\""))?;
                link(name)
            });
            if let [Some(parent), Some(child)] = ends {
                let body = format!("{parent}\n{child}\n{joint}");
                // Those that have none need not have all of them.
                let materials = match body.contains("<material name") {
                    true => materials.as_str(),
                    false => "",
                };
                pieces
                    .push(format!("<robot name=\"r\">\n{materials}{body}\n</robot>").into_bytes());
            }
        }
    }
    let mut pieces = corpus::small(pieces.into_iter());
    pieces.extend(std::iter::repeat_n(
        SMALL_URDF.as_bytes().to_vec(),
        pieces.len() / 2 + 1,
    ));
    pieces
}

struct Pr2 {
    tree: KinematicTree,
    description: RobotDescription,
}

static PR2: LazyLock<Pr2> = LazyLock::new(|| {
    let tree = KinematicTree::from_urdf(PR2_URDF, "pr2.urdf").unwrap();
    let description = RobotDescription::from_sexp(PR2_DESCRIPTION, "pr2.sexp", &tree).unwrap();
    Pr2 { tree, description }
});

static KITCHEN: LazyLock<KinematicTree> =
    LazyLock::new(|| KinematicTree::from_urdf(KITCHEN_URDF, "kitchen.urdf").unwrap());

/// Reads a kitchen, and now and then builds a world with it and lets it take some steps.
fn urdf() -> Taker {
    let mut read = 0;
    Box::new(move |input| {
        let text = String::from_utf8_lossy(input);
        let Ok(kitchen) = KinematicTree::from_urdf(&text, "r.urdf") else {
            return Ok(Taken::Refused);
        };
        read += 1;
        if read % 100 == 0 {
            let objects = ObjectLibrary::from_sexp(OBJECTS, "objects.sexp").unwrap();
            let furnishing = KitchenDescription::built_in(&kitchen).unwrap();
            let models = Models::new(
                PR2.tree.clone(),
                PR2.description.clone(),
                kitchen,
                furnishing,
                objects,
            );
            let joints = models.description.start_positions(&models.robot);
            let base = spatial::Pose::identity();
            let mut world = World::new(Arc::new(models), RobotConfiguration { base, joints });
            for _ in 0..3 {
                world.step();
            }
        }
        Ok(Taken::Read)
    })
}

/// The records of a description: what begins with a parenthesis in the first column.
fn forms(text: &str) -> impl Iterator<Item = String> {
    let text = text.strip_prefix('(').unwrap_or(text);
    let forms = text.split("\n(").filter(|form| !form.starts_with(';'));
    forms.map(|form| {
        // A comment behind a record belongs to the next one.
        let lines = form.lines().take_while(|line| !line.starts_with(';'));
        format!("({}", lines.collect::<Vec<_>>().join("\n"))
    })
}

fn records(text: &str) -> Vec<Vec<u8>> {
    corpus::small(forms(text).map(String::into_bytes))
}

/// A description with another record in the place of the one that begins most like it.
fn replaced(description: &str, record: &str) -> String {
    let all: Vec<String> = forms(description).collect();
    let alike = |form: &String| {
        let pairs = form.bytes().zip(record.bytes());
        pairs.take_while(|(a, b)| a == b).count()
    };
    let place = (0..all.len()).max_by_key(|place| alike(&all[*place]));
    let others = all.iter().enumerate();
    let mut text = String::new();
    for (at, form) in others {
        text.push_str(if Some(at) == place { record } else { form });
        text.push('\n');
    }
    text
}

/// Reads records, each in the place of the one most like it, and alone.
fn described(description: &'static str, read: impl Fn(&str) -> bool + 'static) -> Taker {
    Box::new(move |input| {
        let text = String::from_utf8_lossy(input);
        let _ = read(&text);
        Ok(Taken::if_read(read(&replaced(description, &text))))
    })
}

fn objects() -> Taker {
    described(OBJECTS, |text| {
        ObjectLibrary::from_sexp(text, "objects.sexp").is_ok()
    })
}

fn grasps() -> Taker {
    described(GRASPS, |text| {
        GraspLibrary::from_sexp(text, "grasps.sexp").is_ok()
    })
}

fn robot() -> Taker {
    described(PR2_DESCRIPTION, |text| {
        RobotDescription::from_sexp(text, "pr2.sexp", &PR2.tree).is_ok()
    })
}

fn kitchen() -> Taker {
    described(KITCHEN_DESCRIPTION, |text| {
        KitchenDescription::from_sexp(text, "kitchen.sexp", &KITCHEN).is_ok()
    })
}

/// A mesh in memory, with the file of materials that it may name.
#[derive(Debug)]
struct OneMesh<'a>(&'a [u8]);

const MATERIALS: &[u8] = b"newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nd 0.5\n";

impl MeshFiles for OneMesh<'_> {
    fn length(&self, path: &str) -> Option<u64> {
        self.read(path).ok().map(|bytes| bytes.len() as u64)
    }

    fn read(&self, path: &str) -> io::Result<Vec<u8>> {
        match path.rsplit_once('.') {
            Some((_, "mtl")) => Ok(MATERIALS.to_vec()),
            Some(_) => Ok(self.0.to_vec()),
            None => Err(io::ErrorKind::NotFound.into()),
        }
    }

    fn folders(&self, _: &str) -> Vec<String> {
        Vec::new()
    }

    fn kept(&self, _: &str) -> Option<Vec<u8>> {
        None
    }

    fn keep(&self, _: &str, _: &[u8]) {}
}

/// The corners of a tetrahedron, and its triangles.
const CORNERS: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const TRIANGLES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

const DAE: &str = r##"<?xml version="1.0"?>
<COLLADA version="1.4.1">
  <asset><unit name="centimetre" meter="0.01"/><up_axis>Y_UP</up_axis></asset>
  <library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert>
    <diffuse><color>0.5 0.25 0 1</color></diffuse></lambert></technique></profile_COMMON></effect>
  </library_effects>
  <library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array count="12">0 0 0 9 0 0 0 9 0 0 0 9</float_array>
      <technique_common><accessor source="#a" count="4" stride="3"/></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <polylist material="f" count="4"><input semantic="VERTEX" source="#v" offset="0"/>
      <vcount>3 3 3 3</vcount><p>0 2 1 0 1 3 0 3 2 1 2 3</p></polylist>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s">
    <node><translate>0 0 1</translate><node><rotate>0 0 1 90</rotate><scale>1 2 1</scale>
        <instance_geometry url="#g"><bind_material><technique_common>
          <instance_material symbol="f" target="#m"/></technique_common></bind_material>
        </instance_geometry></node></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>"##;

fn meshes() -> Vec<Vec<u8>> {
    let mut ascii = "solid s\n".to_owned();
    let mut binary = vec![b' '; 80];
    binary.extend((TRIANGLES.len() as u32).to_le_bytes());
    let mut obj = "mtllib a.mtl\no one\n".to_owned();
    for [x, y, z] in CORNERS {
        obj.push_str(&format!("v {x} {y} {z}\n"));
    }
    for (number, triangle) in TRIANGLES.into_iter().enumerate() {
        ascii.push_str(" facet normal 0 0 0\n  outer loop\n");
        binary.extend([0; 12]);
        for [x, y, z] in triangle.map(|corner| CORNERS[corner]) {
            ascii.push_str(&format!("   vertex {x} {y} {z}\n"));
            binary.extend([x, y, z].map(f32::to_le_bytes).concat());
        }
        ascii.push_str("  endloop\n endfacet\n");
        binary.extend([0; 2]);
        let [a, b, c] = triangle.map(|corner| corner + 1);
        let group = ["usemtl red", "usemtl blue", "g two", "s 1"][number];
        obj.push_str(&format!("{group}\nf {a}/1/1 {b}//2 {c}\n"));
    }
    ascii.push_str("endsolid s\n");
    vec![
        ascii.into_bytes(),
        binary,
        obj.into_bytes(),
        DAE.as_bytes().to_vec(),
    ]
}

/// Reads a mesh by all names that it may have, for what collides and for what is looked at.
fn mesh() -> Taker {
    Box::new(|input| {
        let files = OneMesh(input);
        let library = MeshLibrary::new(&files, "/k/a.urdf", &[]);
        let purpose = match input.len() % 4 {
            0 => MeshPurpose::Solid,
            _ => MeshPurpose::Looks,
        };
        let request = |extension| MeshRequest {
            file: format!("a.{extension}"),
            scale: [1.0, 0.5, -2.0],
            purpose,
        };
        let found = library.load(&["stl", "obj", "dae"].map(request));
        Ok(Taken::if_read(found.iter().any(Result::is_ok)))
    })
}
