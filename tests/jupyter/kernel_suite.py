"""The suite that Jupyter offers for kernels, with what planwright is to do.

Three of its tests are skipped: planwright has neither a pager nor a standard error, and clears
nothing.
"""

import unittest

import jupyter_kernel_test as suite


class PlanwrightTests(suite.KernelTests):
    kernel_name = "planwright"
    language_name = "plan"
    file_extension = ".plan"

    code_hello_world = '(format t "hello, world~%")'
    code_generate_error = '(error "no")'
    code_execute_result = [
        {"code": "(+ 1 2)", "result": "3"},
        {"code": "(values 1 :a)", "result": "1\n:A"},
    ]
    code_display_data = [
        {"code": "(picture :width 32 :height 24)", "mime": "image/png"},
        {"code": "(map-picture :width 32 :height 24)", "mime": "image/png"},
    ]
    code_inspect_sample = "mapcar"
    code_history_pattern = "(+ ? 2)"
    supported_history_operations = ("tail", "range", "search")
    completion_samples = [
        {"text": "(multiple-value-b", "matches": ["multiple-value-bind"]},
        {"text": "(an action (type goi", "matches": ["going"]},
    ]
    complete_code_samples = ["1", "(+ 1 2)", "(a) (b)", "; (", "PP-TUT> (a)"]
    incomplete_code_samples = ["(", "(defun f (x)", '"abc']
    invalid_code_samples = ["(a))", ")"]


class PlanwrightWelcomeTests(suite.IopubWelcomeTests):
    kernel_name = "planwright"
    support_iopub_welcome = True


if __name__ == "__main__":
    unittest.main()
