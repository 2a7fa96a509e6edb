"""A kernel and a client of it, for tests."""

import queue
import time

from jupyter_client import KernelManager

PATIENCE = 20


class Answer:
    """What came of a cell."""

    def __init__(self):
        self.reply = None
        self.messages = []
        self.questions = []
        self.ended_at = None

    def of(self, kind):
        return [content for found, content in self.messages if found == kind]

    @property
    def text(self):
        return "".join(content["text"] for content in self.of("stream"))

    @property
    def value(self):
        results = self.of("execute_result")
        return results[-1]["data"]["text/plain"] if results else None

    @property
    def error(self):
        errors = self.of("error")
        return errors[-1] if errors else None

    @property
    def status(self):
        return self.reply["status"]


class Client:
    """Sends cells and collects what comes of them."""

    def __init__(self, client):
        self.client = client
        client.start_channels()
        client.wait_for_ready(timeout=PATIENCE)

    def send(self, code, stdin=True, **options):
        return self.client.execute(code, allow_stdin=stdin, **options)

    def wait(self, number, answers=(), until_busy=False):
        """Collects until the request is answered and the kernel idle."""
        answer, answers = Answer(), list(answers)
        idle = False
        deadline = time.monotonic() + PATIENCE
        while not (idle and answer.reply):
            assert time.monotonic() < deadline, f"no end of {number}: {answer.messages[-3:]}"
            if not idle:
                idle = self.collect(number, answer)
            else:
                self.take_reply(number, answer, 1)
            try:
                question = self.client.stdin_channel.get_msg(timeout=0)
            except queue.Empty:
                continue
            answer.questions.append(question["content"]["prompt"])
            self.client.input(answers.pop(0))
        answer.ended_at = time.monotonic()
        return answer

    def collect(self, number, answer):
        try:
            message = self.client.iopub_channel.get_msg(timeout=0.05)
        except queue.Empty:
            return False
        if message["parent_header"].get("msg_id") != number:
            return False
        content = message["content"]
        answer.messages.append((message["msg_type"], content))
        return message["msg_type"] == "status" and content["execution_state"] == "idle"

    def take_reply(self, number, answer, timeout):
        try:
            message = self.client.shell_channel.get_msg(timeout=timeout)
        except queue.Empty:
            return
        if message["parent_header"].get("msg_id") == number:
            answer.reply = message["content"]

    def run(self, code, answers=(), **options):
        return self.wait(self.send(code, **options), answers)

    def ask(self, number):
        """The answer to a request that is no cell."""
        while True:
            message = self.client.shell_channel.get_msg(timeout=PATIENCE)
            if message["parent_header"].get("msg_id") == number:
                return message["content"]

    def wait_for(self, number, kind):
        """Waits for a message about a request."""
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            message = self.client.iopub_channel.get_msg(timeout=PATIENCE)
            if message["parent_header"].get("msg_id") == number and message["msg_type"] == kind:
                return message["content"]
        raise AssertionError(f"no {kind}")


def start(**options):
    """A kernel and its first client."""
    manager = KernelManager(kernel_name="planwright")
    manager.start_kernel(**options)
    try:
        return manager, Client(manager.client())
    except BaseException:
        manager.shutdown_kernel(now=True)
        raise
