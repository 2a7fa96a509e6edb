;;; Time: chapter 25 of the standard. The clock is that of the simulation, so that a program does
;;; the same in every run. It begins at midnight, 1 January 2000, universal time.

(in-package :common-lisp)

(defun system:clock ()
  "Seconds since the clock began. A program that simulates puts its own clock in place of this one."
  0)

(defun %clock-start ()
  "The universal time at which the clock began."
  3155673600)

(defun get-internal-real-time ()
  "Simulated time since the session began, in INTERNAL-TIME-UNITS-PER-SECOND.
  Examples:
  (integerp (get-internal-real-time)) => T"
  (values (round (* (system:clock) internal-time-units-per-second))))

(defun get-internal-run-time ()
  "The same as GET-INTERNAL-REAL-TIME: computing takes no simulated time.
  Examples:
  (integerp (get-internal-run-time)) => T"
  (get-internal-real-time))

(defun get-universal-time ()
  "The present universal time in seconds: simulated time, which begins at midnight, 1 January 2000.
  Examples:
  (nth-value 5 (decode-universal-time (get-universal-time) 0)) => 2000"
  (+ (%clock-start) (floor (system:clock))))

(defun get-decoded-time ()
  "The present time, taken apart as by DECODE-UNIVERSAL-TIME.
  Examples:
  (nth-value 5 (get-decoded-time)) => 2000"
  (decode-universal-time (get-universal-time)))

(defun decode-universal-time (time &optional (zone 0))
  "A universal time, taken apart: second, minute, hour, day, month, year, day of the week (0 is
  Monday), whether it is daylight saving time, and time zone: hours west of Greenwich.
  Examples:
  (decode-universal-time 0 0) => 0 ; 0 ; 0 ; 1 ; 1 ; 1900 ; 0 ; NIL ; 0"
  (check-type time integer)
  (check-type zone rational)
  (multiple-value-bind (days seconds) (floor (- time (* zone 3600)) 86400)
    (multiple-value-bind (minutes second) (floor seconds 60)
      (multiple-value-bind (hour minute) (floor minutes 60)
        (multiple-value-bind (day month year) (%date days)
          (values second minute hour day month year (mod days 7) nil zone))))))

(defun encode-universal-time (second minute hour day month year &optional (zone 0))
  "The universal time of a date. A year of two digits is the one within fifty years from now.
  Examples:
  (encode-universal-time 0 0 0 1 1 2000 0) => 3155673600"
  (check-type second (integer 0 59))
  (check-type minute (integer 0 59))
  (check-type hour (integer 0 23))
  (check-type day (integer 1 31))
  (check-type month (integer 1 12))
  (check-type year (integer 0 *))
  (check-type zone rational)
  (let ((year (if (< year 100)
                  (let ((now (nth-value 5 (get-decoded-time))))
                    (+ now -50 (mod (- year now -50) 100)))
                  year)))
    (+ second
       (* 60 minute)
       (* 3600 (+ hour zone))
       (* 86400 (+ (%days-before-month month year) (1- day))))))

;;; Days are counted from 1 January 1900.

(defun %days-before-year (year)
  "Days from 1 January 1900 to 1 January of a year, in the Gregorian calendar."
  (let ((before (1- year)))
    (- (+ (* 365 year) (floor before 4) (- (floor before 100)) (floor before 400))
       693960)))

(defun %is-leap-year (year)
  "Has the year 366 days?"
  (and (zerop (mod year 4))
       (or (plusp (mod year 100)) (zerop (mod year 400)))))

(defun %days-before-month (month year)
  "Days from 1 January 1900 to the first of a month."
  (+ (%days-before-year year)
     (nth (1- month) '(0 31 59 90 120 151 181 212 243 273 304 334))
     (if (and (> month 2) (%is-leap-year year)) 1 0)))

(defun %date (days)
  "Day, month and year so many days after 1 January 1900."
  (let ((year (+ 1900 (floor (* days 400) 146097))))
    (loop while (< days (%days-before-year year)) do (decf year))
    (loop while (>= days (%days-before-year (1+ year))) do (incf year))
    (let ((month (loop for month from 12 downto 1
                       while (< days (%days-before-month month year))
                       finally (return month))))
      (values (1+ (- days (%days-before-month month year))) month year))))
