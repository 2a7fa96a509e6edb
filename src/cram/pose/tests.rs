//! Tests of poses: each evaluates a text and compares what is printed.

use crate::designator::tests::{evaluate_in, image};

fn check(cases: &[(&str, &str)]) {
    for (text, expected) in cases {
        assert_eq!(evaluate_in(&mut image(), text), *expected, "{text}");
    }
}

#[test]
fn poses_print_as_they_were_given() {
    check(&[
        (
            "(pp-tut:make-pose \"map\" '((0 1/2 -1.5d0) (0 0 -0.7071 0.7071)))",
            "#<\"map\" ((0.00000 0.50000 -1.50000) (0.00000 0.00000 -0.70710 0.70710))>",
        ),
        (
            "(cl-transforms:make-pose (cl-transforms:make-3d-vector 0 1 0) (cl-transforms:make-identity-rotation))",
            "#<POSE \n   #<3D-VECTOR (0.0d0 1.0d0 0.0d0)>\n   #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ),
        (
            "(cl-tf:make-transform-stamped \"map\" \"base_footprint\" 0.0 (cl-tf:make-identity-vector) (cl-tf:make-identity-rotation))",
            "#<\"map\" \"base_footprint\" ((0.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ),
    ]);
}

#[test]
fn wrong_poses_say_what_would_be_right() {
    check(&[
        (
            "(pp-tut:make-pose \"map\" '((0 1) (0 0 0 1)))",
            "!! (0 1) has 2 numbers but the position of a pose has 3: (x y z).",
        ),
        (
            "(pp-tut:make-pose \"map\" '((0 1 0) (0 0 1)))",
            "!! (0 0 1) has 3 numbers but the orientation of a pose has 4: (x y z w).",
        ),
        (
            "(pp-tut:make-pose \"map\" '(0 1 0))",
            "!! (0 1 0) is not a pose: a pose is a list of two lists, ((x y z) (x y z w)), as in ((1 0 0.8) (0 0 0 1)).",
        ),
        (
            "(pp-tut:make-pose '((0 1 0) (0 0 0 1)) \"map\")",
            "!! ((0 1 0) (0 0 0 1)) is not the name of a frame: a string such as \"map\" or \"base_footprint\" was expected.",
        ),
        (
            "(pp-tut:make-pose \"map\" '((a 1 0) (0 0 0 1)))",
            "!! A in (A 1 0) is not a number: the position of a pose is a list (x y z).",
        ),
        (
            "(cl-transforms:x (pp-tut:make-pose \"map\" '((0 1 0) (0 0 0 1))))",
            "!! #<\"map\" ((0.00000 1.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))> is a pose: take its ORIGIN or ORIENTATION first.",
        ),
    ]);
}

#[test]
fn stamped_poses_are_poses() {
    check(&[
        (
            "(let ((p (pp-tut:make-pose \"map\" '((0 1 0) (0 0 0 1)))))
               (list (typep p 'cl-transforms:pose) (typep p 'cl-transforms-stamped:pose-stamped)
                     (cl-transforms:y (cl-transforms:origin p)) (type-of p)))",
            "(T T 1.0d0 CL-TRANSFORMS-STAMPED:POSE-STAMPED)",
        ),
        (
            "(let ((p (pp-tut:make-pose \"map\" '((0 1 0) (0 0 0 1)))))
               (list (equal p (pp-tut:make-pose \"map\" '((0 1 0) (0 0 0 1))))
                     (equal p (pp-tut:make-pose \"odom\" '((0 1 0) (0 0 0 1))))))",
            "(T NIL)",
        ),
    ]);
}

#[test]
fn a_transform_and_its_inverse_cancel() {
    check(&[(
        "(let ((tf (cl-transforms:make-transform (cl-transforms:make-3d-vector 1 2 3) (cl-transforms:make-quaternion 0 0 1 0)))
               (p (pp-tut:make-pose \"map\" '((4 5 6) (0 0 0 1)))))
           (list (pp-tut:get-x-of-pose (pp-tut:apply-transformation tf p))
                 (pp-tut:get-y-of-pose (pp-tut:apply-transformation (pp-tut:inverse-transformation tf) (pp-tut:apply-transformation tf p)))))",
        "(-3.0d0 5.0d0)",
    )]);
}

#[test]
fn the_tutorials_matrix_is_a_rotation() {
    check(&[
        (
            "(cl-transforms:matrix->quaternion (make-array '(3 3) :initial-contents '((0 1 0) (-1 0 0) (0 0 1))))",
            "#<QUATERNION (0.0d0 0.0d0 -0.7071067811865475d0 0.7071067811865476d0)>",
        ),
        (
            "(cl-transforms:quaternion->euler (cl-transforms:euler->quaternion :az 0.0d0))",
            "(:AX 0.0d0 :AY 0.0d0 :AZ 0.0d0)",
        ),
    ]);
}
