//! Element types of arrays.

use super::standard::check;

#[test]
fn arrays_of_bytes_tell_their_element_type() {
    let bytes = "(make-array 3 :element-type '(unsigned-byte 8))";
    check(&[
        (
            &format!("(array-element-type {bytes})"),
            "(UNSIGNED-BYTE 8)",
        ),
        (
            &format!("(type-of {bytes})"),
            "(SIMPLE-ARRAY (UNSIGNED-BYTE 8) (3))",
        ),
        (
            &format!(
                "(mapcar (lambda (type) (typep {bytes} type)) '(vector (vector (unsigned-byte 8)) (array (integer 0 255) (3)) (vector (unsigned-byte 16)) simple-vector (vector t)))"
            ),
            "(T T T NIL NIL NIL)",
        ),
        (&format!("(aref {bytes} 1)"), "0"),
        (&format!("(equalp {bytes} #(0 0 0))"), "T"),
        (
            "(array-element-type (make-array '(2 2) :element-type '(signed-byte 16)))",
            "(SIGNED-BYTE 16)",
        ),
        (
            "(type-of (make-array 2 :element-type '(mod 256) :fill-pointer 0))",
            "(VECTOR (UNSIGNED-BYTE 8) 2)",
        ),
    ]);
}

#[test]
fn types_of_integers_are_upgraded_to_the_smallest_that_contains_them() {
    check(&[
        (
            "(mapcar #'upgraded-array-element-type '(bit (mod 5) (integer 0 100) (integer -1 100) (integer 0 (256)) (unsigned-byte 8) (unsigned-byte 9) (unsigned-byte 64) (unsigned-byte 65) (signed-byte 3) (signed-byte 33) fixnum integer))",
            "(BIT (UNSIGNED-BYTE 4) (UNSIGNED-BYTE 7) (SIGNED-BYTE 8) (UNSIGNED-BYTE 8) (UNSIGNED-BYTE 8) (UNSIGNED-BYTE 15) (UNSIGNED-BYTE 64) T (SIGNED-BYTE 8) FIXNUM FIXNUM T)",
        ),
        // Of two types one of which contains the other, the upgraded ones do so, too.
        (
            "(let ((types (append '(bit fixnum) (loop for n from 1 to 65 collect `(unsigned-byte ,n) collect `(signed-byte ,n))))) (loop for a in types nconc (loop for b in types when (and (subtypep a b) (not (subtypep (upgraded-array-element-type a) (upgraded-array-element-type b)))) collect (list a b))))",
            "NIL",
        ),
        (
            "(deftype octet () '(unsigned-byte 8)) (list (upgraded-array-element-type 'octet) (subtypep '(vector octet) '(vector (mod 256))) (subtypep '(vector octet) '(vector (unsigned-byte 16))) (subtypep '(vector octet) 'sequence))",
            "((UNSIGNED-BYTE 8) T NIL T)",
        ),
    ]);
}

#[test]
fn what_is_no_byte_is_not_stored_among_bytes() {
    let refused = |form: &str| {
        format!(
            "(let ((v (make-array 3 :element-type '(unsigned-byte 8) :fill-pointer 2))) (handler-case (progn {form} v) (type-error (e) (list (type-error-datum e) (type-error-expected-type e)))))"
        )
    };
    let error = "(300 (UNSIGNED-BYTE 8))";
    check(&[
        (&refused("(setf (aref v 0) 300)"), error),
        (&refused("(setf (elt v 0) 300)"), error),
        (&refused("(setf (row-major-aref v 0) 300)"), error),
        (&refused("(vector-push 300 v)"), error),
        (&refused("(vector-push-extend 300 v)"), error),
        (&refused("(fill v 300)"), error),
        (&refused("(replace v '(300))"), error),
        (&refused("(map-into v #'identity '(300))"), error),
        (
            &refused("(coerce '(300) '(vector (unsigned-byte 8)))"),
            error,
        ),
        (
            &refused("(make-array 2 :element-type '(unsigned-byte 8) :initial-element 300)"),
            error,
        ),
        (&refused("(setf (aref v 0) 255)"), "#(255 0)"),
    ]);
}

#[test]
fn sequences_of_bytes_are_made_of_sequences() {
    let is_of_bytes = |form: &str| format!("(array-element-type {form})");
    let byte = "(UNSIGNED-BYTE 8)";
    check(&[
        (
            &is_of_bytes("(coerce '(1 2) '(vector (unsigned-byte 8)))"),
            byte,
        ),
        (
            &is_of_bytes("(coerce #(1 2) '(simple-array (unsigned-byte 8) (*)))"),
            byte,
        ),
        (
            &is_of_bytes("(make-sequence '(simple-array (unsigned-byte 8) (2)) 2)"),
            byte,
        ),
        (
            &is_of_bytes("(concatenate '(vector (unsigned-byte 8)) '(1) #(2))"),
            byte,
        ),
        (
            &is_of_bytes("(map '(vector (unsigned-byte 8)) #'1+ '(1 2))"),
            byte,
        ),
        (
            &is_of_bytes("(merge '(vector (unsigned-byte 8)) (list 1) (list 2) #'<)"),
            byte,
        ),
        (
            &is_of_bytes("(copy-seq (coerce '(1 2) '(vector (unsigned-byte 8))))"),
            byte,
        ),
        (
            &is_of_bytes("(subseq (coerce '(1 2) '(vector (unsigned-byte 8))) 1)"),
            byte,
        ),
        (
            &is_of_bytes("(reverse (coerce '(1 2) '(vector (unsigned-byte 8))))"),
            byte,
        ),
        (
            &is_of_bytes("(remove 1 (coerce '(1 2) '(vector (unsigned-byte 8))))"),
            byte,
        ),
        (
            &is_of_bytes("(adjust-array (coerce '(1 2) '(vector (unsigned-byte 8))) 4)"),
            byte,
        ),
    ]);
}

#[test]
fn bytes_go_to_files_and_come_from_them() {
    let file = super::scratch_folder().join("bytes-of-arrays");
    let file = file.display();
    check(&[(
        &format!(
            "(with-open-file (s \"{file}\" :direction :output :if-exists :supersede :element-type '(unsigned-byte 8))
               (write-sequence (coerce '(1 200 3) '(vector (unsigned-byte 8))) s))
             (with-open-file (s \"{file}\" :element-type '(unsigned-byte 8))
               (let ((v (make-array 5 :element-type '(unsigned-byte 8))))
                 (list (read-sequence v s) v)))"
        ),
        "(3 #(1 200 3 0 0))",
    )]);
}

#[test]
fn an_element_type_that_does_not_exist_is_an_error() {
    let refusal = |form: &str| format!("(handler-case {form} (error (e) (princ-to-string e)))");
    let told = "\"unknown type specifier: (UNSIGNED-BYT 8). Did you mean UNSIGNED-BYTE?\"";
    check(&[
        (
            &refusal("(make-array 2 :element-type '(unsigned-byt 8))"),
            told,
        ),
        (
            &refusal("(upgraded-array-element-type '(unsigned-byt 8))"),
            told,
        ),
        (
            "(progn (defclass thing () ()) (array-element-type (make-array 2 :element-type 'thing)))",
            "T",
        ),
        (
            &refusal("(make-sequence '(vector (unsigned-byt 8)) 2)"),
            told,
        ),
        (&refusal("(typep #(1) '(vector (unsigned-byt 8)))"), told),
        (
            &refusal("(coerce '(1) '(simple-array (unsigned-byt 8) (*)))"),
            told,
        ),
        (
            &refusal("(typep 1 'intger)"),
            "\"unknown type specifier: INTGER. Did you mean INTEGER?\"",
        ),
        (
            &refusal("(typep 1 'zzyzx)"),
            "\"unknown type specifier: ZZYZX\"",
        ),
    ]);
}

#[test]
fn element_types_are_what_deftype_says() {
    check(&[
        (
            "(progn (deftype small (n) (list 'mod n)) (deftype row (kind n) `(simple-array ,kind (,n)))
                    (mapcar #'array-element-type
                            (list (make-array 2 :element-type '(small 3))
                                  (make-sequence '(vector (small 300)) 2)
                                  (make-sequence '(row (small 2) 3) 3)
                                  (coerce '(1 2) '(vector (small 16)))
                                  (concatenate '(vector (small 200)) '(1) '(2))
                                  (map '(vector (small 16)) #'1+ '(1))
                                  (merge '(vector (small 16)) (list 1) (list 2) #'<))))",
            "((UNSIGNED-BYTE 2) (UNSIGNED-BYTE 15) BIT (UNSIGNED-BYTE 4) (UNSIGNED-BYTE 8) (UNSIGNED-BYTE 4) (UNSIGNED-BYTE 4))",
        ),
        (
            "(list (upgraded-array-element-type '(small 200)) (typep (make-array 2 :element-type '(small 200)) '(vector (unsigned-byte 8)))
                   (typep #*01 '(row (small 2) 2)) (typep #*01 '(vector (small 200))))",
            "((UNSIGNED-BYTE 8) T T NIL)",
        ),
        (
            "(progn (deftype endless (n) `(endless ,n)) (handler-case (make-array 1 :element-type '(endless 1)) (error () :refused)))",
            ":REFUSED",
        ),
    ]);
}
