;;;; ALEXANDRIA-2: what it has beyond ALEXANDRIA is defined there, with its chapter.

(in-package :alexandria-2)

(do-external-symbols (symbol :alexandria)
  (import symbol :alexandria-2)
  (export symbol :alexandria-2))
