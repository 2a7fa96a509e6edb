;;;; Locations: what programs define to resolve them.

(in-package :cram-designators)

(defmacro register-location-generator (priority function &optional documentation)
  "Lets a function of a location designator resolve locations; its name need not be quoted. Low
  priorities come first. It returns a list of poses, or a function without arguments that returns
  the next pose each time, at last NIL or a text that says why there are no more."
  `(system:add-location-generator ,priority ,(%function-designator function) ,documentation))

(defmacro register-location-validation-function (priority function &optional documentation)
  "Lets a function of a location designator and a pose judge solutions; its name need not be quoted. It
  returns :ACCEPT, :MAYBE-REJECT, :UNKNOWN, or NIL or a text that says why to reject."
  `(system:add-location-validator ,priority ,(%function-designator function) ,documentation))

(defun %function-designator (form)
  "The form of a function that is given by its name, or by a form."
  (if (and form (symbolp form) (not (keywordp form)))
      `',form
      form))
