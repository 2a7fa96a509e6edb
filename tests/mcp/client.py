"""Uses `planwright mcp` as assistants do, through the SDK of the protocol: over standard input and output, and over
HTTP."""

import asyncio
import base64
import subprocess
import sys

from mcp import ClientSession, StdioServerParameters
from mcp.client import streamable_http
from mcp.client.stdio import stdio_client

SPAWN = "(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))"
BRING = """(with-simulated-robot
  (perform (an action (type transporting)
                      (object (an object (type bottle)))
                      (target (a location (on (an object (urdf-name kitchen-island-surface)
                                                         (part-of kitchen))))))))"""
SWEEP = "(defsweep s () (vary (x (uniform 0 1))) (run x) (expect (small (< x 0.9))))"

# A call of each tool, and what its answer has to say.
CALLS = [
    ("list_actions", {}, "transporting"),
    ("list_motions", {}, "moving-torso"),
    ("list_object_types", {}, "bottle"),
    ("list_furniture", {}, "kitchen-island-surface"),
    ("describe", {"name": "transporting"}, "(an action (type transporting)"),
    ("check_plan", {"plan": BRING.replace("transporting", "transportin")}, "did you mean TRANSPORTING?"),
    ("run_plan", {"plan": SPAWN}, "ended without a failure"),
    ("run_plan", {"plan": BRING, "in": "continue"}, "action transporting succeeded"),
    ("query_world", {"form": "(pw:on-surface-p 'bottle-1 'kitchen-island-surface)"}, "T"),
    ("sweep_plan", {"plan": SWEEP, "worlds": 5}, "5 worlds"),
    ("compare_plans", {"first": SWEEP, "second": SWEEP.replace("0.9", "0.1"), "worlds": 5}, "5 worlds in both"),
    ("read_document", {"name": "plans/lessons/see-more.lesson"}, "(deflesson see-more"),
]


def field(result, name):
    """A field, which older versions of the SDK name in camel case."""
    first, *others = name.split("_")
    return getattr(result, name, None) or getattr(result, first + "".join(map(str.capitalize, others)), None)


def text(result):
    return "".join(part.text for part in result.content if part.type == "text")


async def use(session):
    """Uses each tool and the resources; how many there are."""
    begun = await session.initialize()
    assert field(begun, "server_info").name == "planwright", begun
    tools = {tool.name for tool in (await session.list_tools()).tools}
    used = {name for name, _, _ in CALLS} | {"picture"}
    assert tools == used, tools ^ used
    for name, arguments, expected in CALLS:
        result = await session.call_tool(name, arguments)
        assert not field(result, "is_error") and expected in text(result), (name, text(result))
    checked = await session.call_tool("check_plan", {"plan": "(with-simulated-robot (park-amr :left))"})
    (finding,) = field(checked, "structured_content")["findings"]
    expected = {"line": 1, "column": 24, "wrong": "park-amr", "replacement": "park-arm"}
    assert finding["suggestion"] == expected, finding
    endless = await session.call_tool("run_plan", {"plan": "(loop)", "view": "none"})
    assert field(endless, "is_error") and "It was ended" in text(endless), endless
    picture = (await session.call_tool("picture", {"view": "island"})).content[0]
    assert base64.b64decode(picture.data).startswith(b"\x89PNG"), picture
    resources = (await session.list_resources()).resources
    for resource in resources[:6]:
        contents = (await session.read_resource(resource.uri)).contents
        assert contents[0].text, resource
    return f"{len(tools)} tools and {len(resources)} resources are as they should be"


async def over_standard_streams(program):
    server = StdioServerParameters(command=program, args=["mcp"])
    async with stdio_client(server) as (read, write), ClientSession(read, write) as session:
        print(await use(session))


async def over_http(program):
    server = subprocess.Popen([program, "mcp", "--http"], stdout=subprocess.PIPE, text=True)
    try:
        address = server.stdout.readline().split()[-1]
        # The newest versions of the SDK have another name for it, and two streams instead of three.
        names = ("streamable_http_client", "streamablehttp_client")
        client = next(getattr(streamable_http, name) for name in names if hasattr(streamable_http, name))
        async with client(address) as (read, write, *_), ClientSession(read, write) as session:
            print("over HTTP:", await use(session))
    finally:
        server.kill()
        server.wait()


async def main(program):
    await over_standard_streams(program)
    await over_http(program)


asyncio.run(main(sys.argv[1]))
