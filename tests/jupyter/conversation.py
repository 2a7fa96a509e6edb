"""What people do in notebooks, with the client library of Jupyter: restarts chosen in the next cell,
questions, interrupts, several clients, restarts of the kernel, and kernels that nobody ends.

    conversation.py [--interrupts N]
"""

import os
import pathlib
import random
import signal
import statistics
import subprocess
import sys
import tempfile
import time
import unittest

import client
from client import Client

PLAN = """(with-simulated-robot
  (loop
    (dolist (y '(1 0))
      (let ((?place (make-pose "map" (list (list 0 y 0) '(0 0 0 1)))))
        (perform (an action (type going) (target (a location (pose ?place)))))))))"""
SETTINGS = "%pictures off\n(in-package :pp-tut)"


def seconds(of):
    begin = time.perf_counter()
    of()
    return time.perf_counter() - begin


class Conversation(unittest.TestCase):
    """One kernel for all tests; each leaves it usable."""

    @classmethod
    def setUpClass(cls):
        cls.manager, cls.client = client.start()
        cls.run_cell = staticmethod(cls.client.run)
        assert cls.run_cell(SETTINGS).status == "ok"

    @classmethod
    def tearDownClass(cls):
        cls.client.client.stop_channels()
        cls.manager.shutdown_kernel(now=True)

    def tearDown(self):
        self.run_cell("q")
        self.assertEqual(self.run_cell("(+ 1 2)").value, "3")

    def test_a_restart_is_chosen_in_the_next_cell(self):
        stopped = self.run_cell('(+ 1 (restart-case (error "no ~s" :way) (seven () :report "Take 7." 7)))')
        self.assertEqual(stopped.status, "error")
        self.assertEqual((stopped.error["ename"], stopped.error["evalue"]), ("SIMPLE-ERROR", "no :WAY"))
        traceback = stopped.error["traceback"]
        self.assertIn(" 0: [SEVEN] Take 7.", traceback)
        self.assertIn("Frames:", traceback)
        self.assertTrue(traceback[-1].startswith("; the plan, :help"), traceback)
        self.assertEqual(self.run_cell("0").value, "8")

    def test_frames_can_be_looked_at_where_a_plan_stands_still(self):
        self.run_cell("(defun half (number) (/ number (- number number)))")
        self.assertEqual(self.run_cell("(half 8)").error["ename"], "DIVISION-BY-ZERO")
        self.assertIn("(HALF 8)", self.run_cell(":bt").text)
        self.assertEqual(self.run_cell("number").value, "8")
        self.run_cell(":frame 1")
        self.assertEqual(self.run_cell("number").error["ename"], "UNBOUND-VARIABLE")
        self.assertEqual(self.run_cell("q").status, "ok")

    def test_a_restart_asks_for_its_value(self):
        self.run_cell('(list (restart-case (error "no") (use-value (v) v)))')
        chosen = self.run_cell("0", answers=["(+ 40 2)"])
        self.assertEqual((len(chosen.questions), chosen.value), (1, "(42)"))

    def test_a_program_reads_what_is_typed(self):
        reading = """(progn (format t "One~%Name? ")
          (let ((name (read-line)))
            (format t "Hello, ~a!~%" name)
            (list name (read) (y-or-n-p "Sure?"))))"""
        read = self.run_cell(reading, answers=["Jo ü", "(1 2)", "y"])
        self.assertEqual(read.value, '("Jo ü" (1 2) T)')
        # What was printed long before it reads is output, and no question.
        shown = read.text + "".join(read.questions)
        for part in ["One\n", "Name? ", "Hello, Jo ü!\n", "Sure? (y or n) "]:
            self.assertEqual(shown.count(part), 1, shown)
        # What is left over was typed for that program.
        self.assertEqual(self.run_cell("(read-line)", answers=["a b"]).value, '"a b"\nNIL')
        # Nobody is there.
        self.assertEqual(self.run_cell("(read-line *standard-input* nil :end)", stdin=False).value, ":END\nT")

    def test_an_interrupt_ends_what_a_program_waits_for(self):
        number = self.client.send("(read-line)")
        self.client.client.stdin_channel.get_msg(timeout=client.PATIENCE)
        self.manager.interrupt_kernel()
        self.assertEqual(self.client.wait(number).status, "error")

    def test_an_interrupt_ends_a_question(self):
        self.run_cell('(list (restart-case (error "no") (use-value (v) v)))')
        number = self.client.send("0")
        self.client.client.stdin_channel.get_msg(timeout=client.PATIENCE)
        self.manager.interrupt_kernel()
        ended = self.client.wait(number)
        self.assertEqual(ended.error["ename"], "INTERRUPT")
        self.run_cell("q")

    def test_without_anybody_to_ask_conditions_abort(self):
        aborted = self.run_cell('(error "no")', stdin=False)
        lines = aborted.error["traceback"]
        self.assertEqual(lines[0], "no")
        self.assertTrue(lines[-1].startswith("; Evaluation aborted on #<SIMPLE-ERROR"), lines)
        self.assertEqual(self.run_cell("%debugger off").status, "ok")
        self.assertEqual(self.run_cell("(car 1)").status, "error")
        self.assertEqual(self.run_cell("1").value, "1")
        self.assertEqual(self.run_cell("%debugger on").status, "ok")

    def test_cells_that_wait_are_left_out_after_an_error(self):
        with tempfile.TemporaryDirectory() as folder:
            both_sent = pathlib.Path(folder, "both-sent")
            waiting = f'(loop until (probe-file "{both_sent}")) (car 1)'
            first = self.client.send(waiting, stdin=False)
            second = self.client.send("(defvar *left-out* 1)", stdin=False)
            time.sleep(0.5)  # It is sent by a thread of its own.
            both_sent.touch()
            self.assertEqual(self.client.wait(first).status, "error")
        # Both answers may have come already.
        self.assertFalse(self.client.wait(second).messages[1:-1])
        self.assertEqual(self.run_cell("(boundp '*left-out*)").value, "NIL")

    def test_another_client_is_not_disturbed(self):
        other = Client(self.manager.client())
        number = self.client.send("(loop repeat 3000000) (car 1)", stdin=False)
        self.assertEqual(other.run("(+ 3 4)").value, "7")
        self.assertEqual(self.client.wait(number).status, "error")
        other.client.stop_channels()

    def test_nothing_of_much_output_is_dropped(self):
        flood = self.run_cell("(dotimes (i 50000) (format t \"~d~%\" i))")
        self.assertEqual(flood.text, "".join(f"{i}\n" for i in range(50000)))
        self.assertLess(len(flood.of("stream")), 500)

    def test_output_streams_while_a_cell_runs(self):
        number = self.client.send('(format t "now~%") (loop)')
        self.assertEqual(self.client.wait_for(number, "stream")["text"], "now\n")
        self.manager.interrupt_kernel()
        self.assertEqual(self.client.wait(number).error["ename"], "INTERRUPT")

    def test_interrupts_end_any_cell_soon(self):
        cells = {
            "endless": "(loop)",
            "flood": '(loop (format t "much ~a~%" :output))',
            "plan": PLAN,
        }
        for name, cell in cells.items():
            times = []
            for _ in range(5):
                number = self.client.send(cell)
                self.client.wait_for(number, "execute_input")
                time.sleep(0.3)
                begin = time.monotonic()
                self.manager.interrupt_kernel()
                answer = self.client.wait(number)
                self.assertEqual(answer.error["ename"], "INTERRUPT")
                times.append(answer.ended_at - begin)
            print(f"interrupt of {name}: median {1000 * statistics.median(times):.0f} ms, "
                  f"most {1000 * max(times):.0f} ms", flush=True)

    def test_the_world_is_shown_after_it_has_changed(self):
        self.run_cell("%pictures follow 64x48")
        spawned = self.run_cell("(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))")
        self.assertEqual(len(spawned.of("display_data")), 1)
        self.assertIn("image/png", spawned.of("display_data")[0]["data"])
        self.assertFalse(self.run_cell("(+ 1 2)").of("display_data"))
        self.run_cell("%pictures off")
        moved = self.run_cell("(spawn-object '((-1.4 -0.9 0.82) (0 0 0 1)) :cup)")
        self.assertFalse(moved.of("display_data"))

    def test_questions_about_a_text_are_answered_in_characters(self):
        text = '(list "é😀" (multiple-value-bi'
        reply = self.client.ask(self.client.client.complete(text))
        self.assertEqual(reply["matches"], ["multiple-value-bind"])
        self.assertEqual((reply["cursor_start"], reply["cursor_end"]), (12, len(text)))
        reply = self.client.ask(self.client.client.inspect("(mapcar 'f xs)", 4))
        self.assertIn("(mapcar ", reply["data"]["text/plain"])

    def test_help_is_at_hand(self):
        self.assertIn("(mapcar ", self.run_cell("?mapcar").text)

    def test_a_pasted_session_is_evaluated(self):
        pasted = self.run_cell("CL-USER> (+ 1 1)\n2\n\nCL-USER> (+ 2 2)\n4\n")
        self.assertEqual(pasted.value, "4")

    def test_round_trips_are_short(self):
        ones = [seconds(lambda: self.run_cell("1")) for _ in range(60)]
        def complete():
            self.client.ask(self.client.client.complete("(multiple-value-b"))
        completions = [seconds(complete) for _ in range(60)]
        print(f"evaluation of 1: median {1000 * statistics.median(ones):.1f} ms; "
              f"completion: median {1000 * statistics.median(completions):.1f} ms", flush=True)


class Interrupts(unittest.TestCase):
    """Interrupts at random moments of a plan; afterwards the session is sane."""

    count = 5

    def test_interrupts_at_random_moments(self):
        manager, talk = client.start()
        try:
            talk.run(SETTINGS)
            moments = random.Random(7)
            times = []
            for at in range(self.count):
                number = talk.send(PLAN, stdin=at % 2 == 0)
                talk.wait_for(number, "execute_input")
                time.sleep(moments.random() ** 2)
                begin = time.monotonic()
                manager.interrupt_kernel()
                answer = talk.wait(number)
                times.append(answer.ended_at - begin)
                self.assertEqual(answer.error["ename"], "INTERRUPT", at)
                self.assertEqual(talk.run("(+ 1 2)").value, "3")
                self.assertEqual(talk.run("(with-simulated-robot (perform (a motion (type moving-torso) (joint-angle 0.1))) 2)").value, "2")
            print(f"{self.count} interrupts: median {1000 * statistics.median(times):.0f} ms, "
                  f"most {1000 * max(times):.0f} ms", flush=True)
        finally:
            talk.client.stop_channels()
            manager.shutdown_kernel(now=True)


class Lives(unittest.TestCase):
    """How kernels begin and end."""

    def test_a_restart_uses_the_same_ports(self):
        manager, talk = client.start()
        try:
            talk.run("(defvar *known* 1)")
            for _ in range(3):
                ports = manager.ports
                begin = time.monotonic()
                manager.restart_kernel()
                talk.client.wait_for_ready(timeout=client.PATIENCE)
                self.assertEqual(ports, manager.ports)
                self.assertLess(time.monotonic() - begin, 10)
            self.assertEqual(talk.run("(boundp '*known*)").value, "NIL")
        finally:
            talk.client.stop_channels()
            manager.shutdown_kernel(now=True)

    def test_a_kernel_ends_though_a_cell_has_no_end(self):
        manager, talk = client.start()
        process = manager.provisioner.process
        talk.send("(unwind-protect (loop) (loop))")
        time.sleep(0.5)
        talk.client.shutdown()
        self.assertEqual(process.wait(timeout=5), 0)
        talk.client.stop_channels()
        manager.shutdown_kernel(now=True)

    def test_quit_ends_the_kernel_with_its_status(self):
        manager, talk = client.start()
        process = manager.provisioner.process
        self.assertEqual(talk.run("(quit 3)").reply["payload"][0]["source"], "ask_exit")
        self.assertEqual(process.wait(timeout=5), 3)
        talk.client.stop_channels()
        manager.shutdown_kernel(now=True)

    def test_progress_is_shown_in_place(self):
        manager, talk = client.start(extra_arguments=["--realtime"])
        talk.run(SETTINGS)
        number = talk.send(PLAN)
        shown = talk.wait_for(number, "display_data")
        updated = talk.wait_for(number, "update_display_data")
        self.assertEqual(shown["transient"], updated["transient"])
        self.assertIn("driving", updated["data"]["text/plain"])
        manager.interrupt_kernel()
        talk.wait(number)
        talk.client.stop_channels()
        manager.shutdown_kernel(now=True)

    def test_ctrl_c_ends_no_kernel(self):
        manager, talk = client.start()
        process = manager.provisioner.process
        os.kill(process.pid, signal.SIGINT)
        # On a busy machine the signal comes late, and interrupts the first cell.
        values = [talk.run("(+ 1 2)").value for _ in range(2)]
        self.assertEqual(values[-1], "3")
        number = talk.send("(loop)")
        talk.wait_for(number, "execute_input")
        os.kill(process.pid, signal.SIGINT)
        self.assertEqual(talk.wait(number).error["ename"], "INTERRUPT")
        talk.client.stop_channels()
        manager.shutdown_kernel(now=True)

    def test_a_kernel_ends_with_the_program_that_started_it(self):
        program = (
            "import sys, os; sys.path.insert(0, sys.argv[1]); import client\n"
            "manager, talk = client.start()\n"
            "print(manager.provisioner.process.pid, flush=True)\n"
            "os.kill(os.getpid(), 9)\n"
        )
        here = os.path.dirname(os.path.abspath(__file__))
        child = subprocess.run([sys.executable, "-c", program, here], stdout=subprocess.PIPE, timeout=60)
        kernel = int(child.stdout)
        deadline = time.monotonic() + 10
        while time.monotonic() < deadline and is_running(kernel):
            time.sleep(0.1)
        is_left = is_running(kernel)
        if is_left:
            os.kill(kernel, signal.SIGKILL)
        self.assertFalse(is_left)


def is_running(process):
    try:
        with open(f"/proc/{process}/stat", encoding="ascii") as stat:
            return stat.read().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


if __name__ == "__main__":
    if "--interrupts" in sys.argv:
        at = sys.argv.index("--interrupts")
        Interrupts.count = int(sys.argv[at + 1])
        del sys.argv[at : at + 2]
    unittest.main()
