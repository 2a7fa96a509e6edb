;;;; Systems that published code depends on and that are not here, with what stands in their place.

(in-package :asdf)

(defvar system::%*absent-systems*
  '(("there is no action server to call; motions are carried out by PERFORM"
     "actionlib" "actionlib_lisp" "cram-simple-actionlib-client")
    ("arms are moved by the plans that are built in"
     "giskard" "cram-giskard" "cram-moveit" "cram-ik-interface")
    ("(prolog …) asks the facts that are here"
     "json_prolog" "json-prolog" "cram-json-prolog" "cram-knowrob-pick-place" "cram-knowrob-assembly"
     "cram-knowrob-cloud")
    ("--record keeps what happens, and EXPORT-EPISODE writes it down"
     "cram-cloud-logger" "cram-task-tree-exporter")
    ("objects are perceived by the motion DETECTING"
     "cram-robosherlock" "cram-robokudo" "cram-perception")
    ("(list-containers) and the questions of Prolog tell of the kitchen"
     "cram-semantic-map" "cram-semantic-map-cache" "cram-semantic-map-costmap")
    ("the world is simulated by what is built in"
     "cl-bullet" "cl-bullet-vis" "cram-physics-utils-assimp"))
  "Lists of what stands in the place of systems, and of their names.")

(defvar system::%*told-absent-systems* '()
  "The names of the absent systems of which was said that they are not here.")

(defun %ros-name (name)
  "A name of a system as ROS writes it."
  (substitute #\_ #\- (string-downcase name)))

(defun %in-place-of (name)
  "What stands in the place of a system that is not here; NIL for any other."
  (first (find-if (lambda (row)
                    (member (%ros-name name) (rest row) :key #'%ros-name :test #'string=))
                  %*absent-systems*)))

(defun %tell-absent (name dependent)
  "Says, once, that a system is not here on which another one depends."
  (unless (member name %*told-absent-systems* :test #'string=)
    (push name %*told-absent-systems*)
    (warn "The system ~a, on which ~a depends, is not here: ~a. What calls it will say so."
          name dependent (%in-place-of name))))

(defun %message-package-name (name)
  "The name of the package with the types of messages that a system of ROS has, such as STD_MSGS-MSG for
std_msgs-msg; NIL if it is no such system."
  (when (or (alexandria:ends-with-subseq "-msg" name)
            (alexandria:ends-with-subseq "-srv" name))
    (string-upcase name)))

(defun %provide-messages (name)
  "Makes the package of a system with types of messages, if there is none: messages have no types here, so every
name in it is one."
  (let ((package-name (%message-package-name name)))
    (when package-name
      (system:open-package package-name)
      t)))
