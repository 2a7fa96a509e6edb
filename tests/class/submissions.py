"""Makes the submissions of a class of thirty to the lesson bring-the-bottle: the same ones each time.

    submissions.py FOLDER
"""

import pathlib
import random
import sys

NAMES = """ada bela carl dora emil fran gero hana ivan jule karl lena milo nora otto
pia quin rosa sven tara udo vera wim xenia yara zeno anni bert cleo dirk""".split()

# How students write what works.
WHOLE = [
    """(defun bring-bottle ()
  (with-simulated-robot
    (get-ready-at *place-at-table*)
    (let (({bottle} (find-object :bottle)))
      (bring-to-island {bottle} (pick-up-object {bottle} :{arm})))))
""",
    """(defun fetch-it ()
  "Picks the bottle up; the arm."
  (get-ready-at *place-at-table*)
  (let* (({bottle} (find-object :bottle))
         (arm (pick-up-object {bottle} :{arm})))
    (values {bottle} arm)))

(defun bring-bottle ()
  (with-simulated-robot
    (multiple-value-bind ({bottle} arm) (fetch-it)
      (bring-to-island {bottle} arm))))
""",
    """(defun bring-bottle ()
  (with-simulated-robot
    (cpl:with-retry-counters ((again 2))
      (cpl:with-failure-handling
          ((cpl:plan-failure (failure)
             (declare (ignore failure))
             (cpl:do-retry again (cpl:retry))))
        (get-ready-at *place-at-table*)
        (let* (({bottle} (find-object :bottle))
               (arm (pick-up-object {bottle} :{arm})))
          (bring-to-island {bottle} arm))))))
""",
    """(defparameter *arm* :{arm})

(defun bring-bottle ()
  (with-simulated-robot
    (get-ready-at *place-at-table*)
    (let ({bottle} arm)
      (setf {bottle} (find-object :bottle))
      (setf arm (pick-up-object {bottle} *arm*))
      (bring-to-island {bottle} arm))))
""",
    """(defun bring-bottle ()
  (with-simulated-robot
    (perform (an action (type transporting)
                        (object (an object (type bottle)))
                        (target (a location (on (an object (urdf-name kitchen-island-surface)
                                                           (part-of kitchen)))))))))
""",
]

# What they get wrong: what to replace in the first way, and by what.
MISTAKES = [
    ("find-object", "find-objekt"),
    (":bottle", ":botle"),
    ("(get-ready-at *place-at-table*)", "nil"),
    ("(bring-to-island", "(list"),
    ("*place-at-table*", "*place-at-island*"),
    (")))))\n", "))))\n"),
    ("(bring-to-island", "(loop) (bring-to-island"),
    ("(defun bring-bottle ()", "(defun bring-botle ()"),
    ("(with-simulated-robot", "(progn"),
    ("(pick-up-object {bottle} :{arm})", ":{arm}"),
    ("(find-object :bottle)", "(find-object :cup)"),
    ("(get-ready-at", "(spawn-object '((-0.8 2 0.96) (0 0 0 1)) :bottle 'mine) (get-ready-at"),
]


def submission(number, draw):
    """The text of the submission with a number: the first twelve have a mistake each."""
    text = WHOLE[0] if number < len(MISTAKES) else WHOLE[number % len(WHOLE)]
    if number < len(MISTAKES):
        text = text.replace(*MISTAKES[number], 1)
    text = text.replace("{bottle}", draw.choice(["bottle", "it", "thing", "found"]))
    return ";; Exercise 1\n(in-package :pp-tut)\n\n" + text.replace("{arm}", draw.choice(["right", "right", "left"]))


def main(folder):
    draw = random.Random(1)
    names = NAMES[:]
    draw.shuffle(names)
    folder.mkdir(parents=True, exist_ok=True)
    for number, name in enumerate(names):
        (folder / f"{name}.plan").write_text(submission(number, draw))


main(pathlib.Path(sys.argv[1]))
