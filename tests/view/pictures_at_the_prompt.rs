//! Pictures that plans and people ask for: where they go, what they show, and what is wrong
//! with arguments that make no picture.

use std::fs;
use std::path::PathBuf;

use session::dialogue::{Evaluate, Event};
use session::{Session, SessionOptions};

/// A session, and a folder of its own.
struct Desk {
    session: Session,
    folder: PathBuf,
}

impl Desk {
    fn new(name: &str) -> Self {
        let folder = crate::tests::scratch_folder().join(name);
        fs::create_dir_all(&folder).unwrap();
        let session = Session::new(&SessionOptions::default()).unwrap();
        Self { session, folder }
    }

    /// What is printed and what the values are; `FOLDER` stands for the folder.
    fn evaluate(&mut self, text: &str) -> (String, usize) {
        let folder = self.folder.display().to_string();
        let text = text.replace("FOLDER", &folder);
        let (mut said, mut pictures) = (String::new(), 0);
        self.session
            .evaluate("test", &text, &mut |event| match event {
                Event::Output(text) => said.push_str(&text),
                Event::Values(values) => said.push_str(&values.join("\n")),
                Event::Aborted(abort) => said.push_str(&abort.report),
                Event::Picture(_) => pictures += 1,
                _ => {}
            });
        (said.replace(&folder, "FOLDER"), pictures)
    }

    /// Pixels per row, rows, and the pixels of a file.
    fn pixels(&self, file: &str) -> (u32, u32, Vec<u8>) {
        let file = fs::File::open(self.folder.join(file)).unwrap();
        let decoder = png::Decoder::new(std::io::BufReader::new(file));
        let mut reader = decoder.read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        (info.width, info.height, bytes)
    }
}

#[test]
fn a_picture_is_written_and_its_name_returned() {
    let mut desk = Desk::new("written");
    for view in ["", ":top", ":map", ":robot", ":table", ":island", ":follow"] {
        let (said, pictures) = desk.evaluate(&format!(
            "(picture \"FOLDER/a.png\" {view} :width 64 :height 48)"
        ));
        assert_eq!((said.as_str(), pictures), ("\"FOLDER/a.png\"", 1), "{view}");
        let (width, height, _) = desk.pixels("a.png");
        assert_eq!((width, height), (64, 48));
    }
}

#[test]
fn the_same_words_give_the_same_bytes() {
    let text = "(pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))
                (picture \"FOLDER/a.png\" :at 'bottle-1 :width 120 :height 90)";
    let bytes = |name| {
        let mut desk = Desk::new(name);
        desk.evaluate(text);
        fs::read(desk.folder.join("a.png")).unwrap()
    };
    assert!(bytes("same-1") == bytes("same-2"));
}

#[test]
fn coordinates_that_are_visualized_are_in_the_picture() {
    let mut desk = Desk::new("axes");
    let picture =
        "(picture \"FOLDER/a.png\" :from '(-3 -1 2) :at '(-1.4 1 1) :width 320 :height 240)";
    let green = |desk: &mut Desk| {
        desk.evaluate(picture);
        let (_, _, pixels) = desk.pixels("a.png");
        let is_green = |c: &&[u8]| c[1] > 60 && c[1] / 2 > c[0] && c[1] / 2 > c[2];
        pixels.chunks(3).filter(is_green).count()
    };
    assert_eq!(green(&mut desk), 0);
    desk.evaluate("(pp-tut:visualize-coordinates (cl-transforms:make-pose (cl-transforms:make-3d-vector -1.4 1 1) (cl-transforms:make-identity-rotation)) 0.6)");
    assert!(green(&mut desk) > 30);
}

#[test]
fn the_camera_s_picture_tells_how_much_is_in_sight() {
    let mut desk = Desk::new("camera");
    desk.evaluate("(pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))");
    let (said, pictures) = desk.evaluate("(camera-picture \"FOLDER/c.png\" :width 480)");
    assert_eq!(pictures, 1);
    assert!(
        said.starts_with("0 % of BOTTLE-1 is in sight, it reaches "),
        "{said}"
    );
    assert!(said.ends_with("\"FOLDER/c.png\""), "{said}");
    let (width, height, _) = desk.pixels("c.png");
    assert!(width == 480 && height > 200);
}

#[test]
fn the_map_is_green_and_red() {
    let mut desk = Desk::new("map");
    desk.evaluate("(map-picture \"FOLDER/m.png\" :width 160 :height 120)");
    let (_, _, pixels) = desk.pixels("m.png");
    let count = |is: &dyn Fn(&[u8]) -> bool| pixels.chunks(3).filter(|c| is(c)).count();
    assert!(count(&|c| c[1] > c[0].saturating_add(10) && c[1] > c[2].saturating_add(10)) > 3000);
    assert!(count(&|c| c[0] > c[1].saturating_add(40) && c[0] > c[2].saturating_add(40)) > 1500);
}

#[test]
fn wrong_arguments_end_in_one_clear_condition() {
    let mut desk = Desk::new("wrong");
    let views = ":kitchen, :top, :map, :robot, :table, :island, :follow";
    for (form, report) in [
        ("(picture :tabel)", format!(":TABEL is no view; did you mean :table? There are {views}.")),
        ("(picture 5)", format!("5 is no view; there are {views}.")),
        (
            "(picture \"FOLDER/nowhere/x.png\")",
            "The picture cannot be written to \"FOLDER/nowhere/x.png\": there is no such directory.".to_owned(),
        ),
        (
            "(picture \"x.png\" :width 0)",
            "0 is no width of a picture: a whole number of pixels from 16 to 4096 was expected.".to_owned(),
        ),
        (
            "(picture \"x.png\" :height 100000000000000000000)",
            "100000000000000000000 is no height of a picture: a whole number of pixels from 16 to 4096 was expected.".to_owned(),
        ),
        (
            "(picture \"x.png\" :width :wide)",
            ":WIDE is no width of a picture: a whole number of pixels from 16 to 4096 was expected.".to_owned(),
        ),
        (
            "(picture \"x.png\" :from '(1 2))",
            "(1 2) has 2 numbers but a position has 3: (x y z).".to_owned(),
        ),
        (
            "(picture \"x.png\" :from '(1 2 3) :at '(1 2 3))",
            "the view is from and at the same place, (1, 2, 3).".to_owned(),
        ),
        (
            "(picture \"x.png\" :top :at '(1 2 3))",
            "A picture is either of a named view or from a place: leave out the view's name, or :from and :at.".to_owned(),
        ),
        ("(picture :width)", ":width lacks its value.".to_owned()),
        (
            "(map-picture :top)",
            ":TOP is not understood by a picture: a file name and :width, :height are.".to_owned(),
        ),
        (
            "(camera-picture :object 'nobody)",
            "There is no object named NOBODY; there are none: use spawn-object.".to_owned(),
        ),
    ] {
        assert_eq!(desk.evaluate(form), (report, 0), "{form}");
    }
}

#[test]
fn a_narrower_field_of_view_shows_things_larger() {
    let mut desk = Desk::new("narrow");
    desk.evaluate("(pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))");
    let mut red = |angle: &str| {
        let (said, _) = desk.evaluate(&format!(
            "(picture \"FOLDER/a.png\" :at 'pp-tut::bottle-1 :width 96 :height 96 {angle})"
        ));
        assert_eq!(said, "\"FOLDER/a.png\"");
        let (_, _, pixels) = desk.pixels("a.png");
        let is_red = |p: &&[u8]| p[0] > 120 && p[1] < 60 && p[2] < 60;
        pixels
            .chunks(pixels.len() / (96 * 96))
            .filter(is_red)
            .count()
    };
    let (usual, narrow, wide) = (red(""), red(":fov 12"), red(":fov 110.5"));
    assert!(
        narrow > 2 * usual && usual > 2 * wide,
        "{narrow} {usual} {wide}"
    );
    for wrong in [":fov 0", ":fov 180", ":fov :wide", ":fov -20"] {
        let (said, pictures) = desk.evaluate(&format!("(picture {wrong})"));
        assert!(said.contains("is no field of view of a picture"), "{said}");
        assert_eq!(pictures, 0);
    }
}

#[test]
fn a_picture_that_cannot_show_what_it_is_meant_to_says_why() {
    let mut desk = Desk::new("hidden");
    let mut warning = |from: &str, at: &str| {
        let form =
            format!("(picture \"FOLDER/a.png\" :from '{from} :at '{at} :width 64 :height 48)");
        let (said, pictures) = desk.evaluate(&form);
        assert_eq!(pictures, 1, "{said}");
        said.strip_suffix("\"FOLDER/a.png\"")
            .unwrap()
            .trim_end()
            .to_owned()
    };
    let table = "(-1.5 -0.9 0.8)";
    assert_eq!(warning("(-1.5 -2.2 1.5)", table), "");
    assert_eq!(
        warning("(-1.4 -1 0.6)", table),
        "Warning: the eye is inside kitchen_wall_5; choose another :from."
    );
    assert_eq!(
        warning("(0 0 -1)", table),
        "Warning: the eye is under the floor; choose another :from."
    );
    let drawers = warning("(-0.6 1.5 0.5)", table);
    assert!(
        drawers.contains("% of the view is behind kitchen_island_left_upper_drawer_main, 0.33 m"),
        "{drawers}"
    );
}
