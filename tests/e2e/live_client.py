"""Asks a running `kagefude live` as its page does, and as nobody should: live_client.py URL LOOK."""
import http.client
import json
import os
import struct
import sys
import urllib.parse

url, look = urllib.parse.urlparse(sys.argv[1]), sys.argv[2]
HOST, BASE = url.netloc, url.path


def ask(method, path, body=None, headers=None, host=HOST):
    connection = http.client.HTTPConnection(HOST, timeout=60)
    connection.putrequest(method, path, skip_host=True)
    connection.putheader("Host", host)
    for name, value in (headers or {}).items():
        connection.putheader(name, value)
    if body is not None:
        connection.putheader("Content-Length", str(len(body)))
    connection.endheaders(body)
    answer = connection.getresponse()
    return answer.status, answer.read()


def picture(seen=0, stage="result"):
    status, body = ask("GET", f"{BASE}picture?seen={seen}&stage={stage}")
    assert status == 200, body
    length, = struct.unpack("<I", body[:4])
    return json.loads(body[4:4 + length]), body[4 + length:]


def turn(*overrides):
    status, body = ask("POST", BASE + "change", json.dumps({"overrides": overrides}).encode(),
                       {"Origin": f"http://{HOST}", "Content-Type": "application/json"})
    assert status == 200, body
    return sharp(json.loads(body)["change"])


def sharp(wanted):
    """The answer to a change, with all pixels: while the hand moves there may be fewer."""
    state, pixels = picture()
    made = []
    while state["change"] < wanted or state.get("step") != 1 or "size" not in state:
        made = made + state["made"] if state["change"] == wanted and "made" in state else []
        state, pixels = picture(state["version"])
    made += state["made"]
    return state | {"made": made}, pixels


def expect(what, got, wanted):
    assert got == wanted, f"{what}: {str(got)[:200]}, not {str(wanted)[:200]}"


state, before = sharp(0)
expect("pixels", len(before), 4 * state["size"][0] * state["size"][1])
assert "result" in state["stages"] and "visibility.Key" in state["stages"], state["stages"]

turned, after = turn("brush.contrast=0.05")
assert after != before, "a turned knob shows nothing"
assert not any(name.startswith(("read", "shadow", "tone")) for name in turned["made"]), turned["made"]
expect("turned back", turn()[1], before)
expect("a wrong key's picture", turn("brush.contrst=1")[1], before)
assert "contrast" in turn("brush.contrst=1")[0]["error"], "the nearest key is not named"
turn()

# As nobody should. Nothing of it may change the look on disk.
disk = open(look, "rb").read()
change = json.dumps({"overrides": ["brush.contrast=0.9"]}).encode()
for what, wanted, got in (
        ("another host", 403, ask("GET", BASE, host="evil.example")),
        ("a name that resolves here", 403, ask("GET", BASE, host=f"evil.example:{url.port}")),
        ("another origin", 403, ask("POST", BASE + "change", change, {"Origin": "http://evil.example"})),
        ("a save from another origin", 403, ask("POST", BASE + "save", change, {"Origin": "http://evil.example"})),
        ("a save of a wrong key", 400, ask("POST", BASE + "save", b'{"overrides": ["brush.contrst=1"]}')),
        ("a save of a foreign file", 400, ask("POST", BASE + "save", b'{"overrides": ["colour.config=/etc/passwd"]}')),
        ("no token", 403, ask("GET", "/")),
        ("a wrong token", 403, ask("GET", "/" + "0" * 32 + "/")),
        ("a path out", 400, ask("GET", BASE + "../../etc/passwd")),
        ("a spelled path out", 400, ask("GET", BASE + "%2e%2e/%2e%2e/etc/passwd")),
        ("a file of the folder", 404, ask("GET", BASE + os.path.basename(look))),
        ("a method", 405, ask("PUT", BASE + "change", change)),
        ("a gigabyte", 413, ask("POST", BASE + "change", None, {"Content-Length": str(1 << 30)})),
        ("a strip from another origin", 403, ask("POST", BASE + "strip?name=a.png", b"x", {"Origin": "http://evil.example"})),
        ("a strip of a gigabyte", 413, ask("POST", BASE + "strip?name=a.png", None, {"Content-Length": str(1 << 30)})),
        ("a strip that is none", 400, ask("POST", BASE + "strip?name=a.png", b"x")),
        ("a strip over the look", 400, ask("POST", BASE + "strip?name=" + os.path.basename(look), b"x")),
        ("a strip elsewhere", 400, ask("POST", BASE + "strip?name=..%2Fa.png", b"x")),
        ("a strip in another folder", 400, ask("POST", BASE + "strip?name=%2Ftmp%2Fa.png", b"x")),
        ("a strip painted elsewhere", 400, ask("POST", BASE + "paint?name=..%2Fa.png", b'{"preset": "soft", "settings": []}')),
        ("a strip too large to paint", 400, ask("POST", BASE + "paint", b'{"preset": "soft", "settings": ["width=16384", "height=16384"]}')),
        ("a save of other entries", 400, ask("POST", BASE + "save", b'{"overrides": ["brush.contrast=0.9"], "onDisk": {"style": [], "light": ["Key"]}}')),
        ("an input that is none", 400, ask("POST", BASE + "change", b'{"overrides": [], "input": 1e30}')),
        ("an input below none", 400, ask("POST", BASE + "change", b'{"overrides": [], "input": -1}')),
        ("an exposure that is none", 400, ask("GET", BASE + "picture?exposure=nan")),
        ("a save of two values", 400, ask("POST", BASE + "save", b'{"overrides": ["brush.contrast=1\\nx=2"]}')),
        ("no JSON", 400, ask("POST", BASE + "change", b"overrides"))):
    expect(what, got[0], wanted)
for strip in ("/etc/passwd", "../strip.png"):
    refused, pixels = turn(f"style[0].strip={strip}")
    assert strip in refused["error"], refused["error"]
    expect(strip, pixels, before)
expect("the look on disk", open(look, "rb").read(), disk)
expect("files beside it", os.listdir(os.path.dirname(look)), [os.path.basename(look)])
turn()

# Save: what was turned, and nothing else.
status, body = ask("POST", BASE + "save", change, {"Origin": f"http://{HOST}"})
expect("save", (status, json.loads(body)), (200, {"before": ["brush.contrast=1"]}))
expect("the saved look", open(look, "rb").read(), disk + b"\n[brush]\ncontrast = 0.9\n")
state, pixels = picture()
while state["values"]["look"]["brush"]["contrast"] == 1:
    state, pixels = picture(state["version"])
assert pixels != before, "the saved look is not shown"
print("live: every answer as it should be")
