"""The server of the workbench over HTTP: its address alone, its pages alone, its files alone; and how it ends."""

import http.client
import json
import os
import re
import socket
import subprocess
import sys
import threading
import time
import urllib.parse
import warnings

import pytest

import tabor as tb
from conftest import ROOT

pytest.importorskip("bokeh", reason="no Bokeh: the workbench is not served")

from tabor.view import cli
from tabor.view.answers import answer_of
from tabor.view.opening import Opened
from tabor.view.server import View
from tabor.view.state import State
from tabor.view.worker import Stopped, Worker
from tabor.view.written import Folder, scan_extensions, write_answer


@pytest.fixture(scope="module")
def view(levelled):
    found = View([Opened(levelled, State(""))], keep=True)
    yield found
    found.close()


def ask(view, path=None, method="GET", **headers):
    """(status, body) of a request to the port of the view; its page if no path is given."""
    address = urllib.parse.urlsplit(view.url)
    connection = http.client.HTTPConnection(address.hostname, address.port, timeout=60)
    headers = {name.replace("_", "-"): value for name, value in headers.items()}
    try:
        connection.request(method, address.path if path is None else path, headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.read().decode("utf-8", "replace")
    finally:
        connection.close()


def token(view):
    return urllib.parse.urlsplit(view.url).path.strip("/")


def test_the_page_is_served_with_its_own_resources(view):
    status, page = ask(view)
    assert status == 200 and "<title>tabor view: edt_before.x3p</title>" in page
    sources = re.findall(r'(?:src|href)="([^"]+)"', page)
    assert sources and all(source.startswith((f"/{token(view)}/static/", "static/", "data:")) for source in sources)
    assert "https://" not in page and "cdn" not in page
    assert ask(view, next(source for source in sources if ".js" in source))[0] == 200


@pytest.mark.parametrize("origin", ["http://evil.example", "http://127.0.0.1:1", "https://127.0.0.1", "null", "http://localhost"])
def test_another_origin_is_rejected(view, origin):
    assert ask(view, Origin=origin)[0] == 403


def test_its_own_origin_is_not(view):
    assert ask(view, Origin=view.url.split("/" + token(view))[0])[0] == 200


@pytest.mark.parametrize("host", ["evil.example", "localhost", "127.0.0.1", "127.0.0.1:1", "[::1]"])
def test_another_host_is_rejected(view, host):
    assert ask(view, Host=host)[0] == 403


@pytest.mark.parametrize("path", ["/", "/favicon.ico", "/static/js/bokeh.min.js", "/view", "/TOKEN", "/TOKEN/", "/TOKEN/ws", "//", "/%00"])
def test_a_wrong_token_is_rejected(view, path):
    wrong = token(view)[:-1] + ("a" if token(view)[-1] != "a" else "b")
    assert ask(view, path.replace("TOKEN", wrong))[0] == 403


@pytest.mark.parametrize("path", ["file/1/x.h5", "file//etc/passwd", "file/../../etc/passwd", "file/%2e%2e/%2e%2e/etc/passwd", "../etc/passwd",
                                  "nothing", "static/extensions/../../x", "static/../../../etc/passwd", "static/%2e%2e/%2e%2e/__init__.py"])
def test_a_path_outside_is_rejected(view, path):
    assert ask(view, f"/{token(view)}/{path}")[0] in (403, 404)
    status, body = ask(view, f"/{token(view)}/{path}")
    assert "root:" not in body and "import" not in body
    assert status == 403 or path.startswith("static/%2e") or path.startswith("static/extensions")


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "OPTIONS", "HEAD"])
def test_other_methods_do_nothing_without_the_token(view, method):
    assert ask(view, "/", method)[0] == 403


def handshake(view, **headers):
    """First line of the answer to a request for a websocket."""
    address = urllib.parse.urlsplit(view.url)
    given = {"Host": f"{address.hostname}:{address.port}", "Upgrade": "websocket", "Connection": "Upgrade",
             "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==", "Sec-WebSocket-Version": "13", "Sec-WebSocket-Protocol": "bokeh, x", **headers}
    with socket.create_connection((address.hostname, address.port), timeout=60) as line:
        line.sendall("".join([f"GET {address.path}ws HTTP/1.1\r\n", *(f"{name}: {value}\r\n" for name, value in given.items()), "\r\n"]).encode())
        return line.recv(200).decode().splitlines()[0]


def test_a_websocket_needs_the_origin_of_the_page(view):
    assert " 403 " in handshake(view)
    assert " 403 " in handshake(view, Origin="http://evil.example")
    assert " 101 " in handshake(view, Origin=view.url.split("/" + token(view))[0])


def test_it_listens_on_this_machine_alone(view):
    port = urllib.parse.urlsplit(view.url).port
    listening = [line.split() for name in ("tcp", "tcp6") if os.path.exists(f"/proc/net/{name}") for line in open(f"/proc/net/{name}").readlines()[1:]]
    if not listening:
        pytest.skip("no /proc/net/tcp: sockets are not looked at")
    places = [fields[1] for fields in listening if fields[3] == "0A" and int(fields[1].rsplit(":", 1)[1], 16) == port]
    assert places == [f"0100007F:{port:04X}"]


def test_tokens_differ(view, levelled):
    other = View([Opened(levelled, State(""))], keep=True)
    try:
        assert token(other) != token(view) and len(token(other)) >= 20
    finally:
        other.close()
    assert not other.is_open


def test_written_files_are_handed_out_by_their_names_alone(levelled):
    folder = Folder()
    try:
        answer = answer_of(levelled, State(""))
        scan, result = write_answer(folder, "scan", answer), write_answer(folder, "result", answer)
        assert tb.read(folder.file(scan)).shape == levelled.shape
        assert folder.file(result).stat().st_size > 1000
        assert folder.file("../" + scan) is None and folder.file("/etc/passwd") is None
        place = folder.file(scan).parents[1]
        folder.drop(result)
        assert folder.file(result) is None and not (place / result).exists()
    finally:
        folder.close()
    assert not place.exists()


@pytest.mark.parametrize("extension", [".h5", ".x3p", ".gwy", ".sdf", ".gsf", ".npy"])
def test_a_treated_scan_is_written_in_any_format(levelled, extension):
    assert extension in scan_extensions()
    folder = Folder()
    try:
        name = write_answer(folder, "scan", answer_of(levelled, State("")), extension)
        given = {"pixel": levelled.dx, "unit": "m"} if extension == ".npy" else {}
        assert name.endswith(extension) and tb.read(folder.file(name), **given).shape == levelled.shape
    finally:
        folder.close()


def test_a_new_task_stops_the_old_one():
    ended, told_of = threading.Event(), []
    worker = Worker(lambda stage, share: told_of.append(stage))

    def endless(told):
        try:
            while True:
                told("solve", 0.5, float("nan"))
                time.sleep(0.001)
        except Stopped:
            ended.set()
            raise

    try:
        worker.ask(endless)
        worker.ask(lambda told: told_of.append("second"))
        assert worker.wait(60) and told_of[-2:] == ["second", ""] or told_of[-1] == "second"
        worker.ask(endless)
        time.sleep(0.05)
        assert worker.stop() and ended.wait(60) and worker.wait(60)
        assert not worker.stop()
    finally:
        worker.close()


def test_a_computation_of_the_package_stops(levelled):
    done, began = [], threading.Event()
    worker = Worker(lambda stage, share: began.set())
    rough = tb.generate("self-affine", pixels=1024, pixel="1 um", rms_height="1 um", seed=1)

    def solve(told):
        told("begin", 0, 0)
        done.append(tb.rain(rough, "5 g/m^2", progress=told))

    try:
        worker.ask(solve)
        assert began.wait(60)
        assert worker.stop() and worker.wait(60) and not done
    finally:
        worker.close()


def test_doubts_of_what_the_page_computes_are_no_warnings(levelled):
    """Not even where the user makes errors of them: the page shows them."""
    found = []
    worker = Worker(lambda stage, share: None)
    with warnings.catch_warnings():
        warnings.simplefilter("error", tb.Doubt)
        try:
            worker.ask(lambda told: found.append(tb.contact(levelled, "7 MPa", "aluminium-6016")))
            assert worker.wait(60) and found and any(one.kind == "doubt" for one in found[0].warnings)
        finally:
            worker.close()
        with pytest.raises(tb.Doubt):
            tb.contact(levelled, "7 MPa", "aluminium-6016")


def started(*words, program=None):
    command = [sys.executable, "-m", "tabor.view"] if program is None else [program, "view"]
    environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
    return subprocess.Popen([*command, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            env={**environment, "TABOR_PYTHON": sys.executable})


ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+/[A-Za-z0-9]{20,}/")


@pytest.mark.parametrize("by", ["module", "program"])
def test_the_verb_prints_one_line_with_the_address_and_leaves_nothing(by, request, scan_file, tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    program = request.getfixturevalue("program") if by == "program" else None
    treated = ["--step", "level=plane"] if by == "module" else ["--recipe", "sheet"]
    process = started(scan_file, *treated, program=program)
    try:
        url = process.stdout.readline().strip()
        assert ADDRESS.fullmatch(url)
        process.url = url
        assert ask(process)[0] == 200
        process.terminate()
        assert process.wait(60) == 130 and not list(tmp_path.iterdir())
    finally:
        process.kill()
        process.communicate(timeout=60)


MOST_MEMORY = 150e6  #: of an idle server, beside the scan and what was computed of it [bytes]


@pytest.mark.skipif(not os.path.exists("/proc/self/status"), reason="no /proc: memory is not measured")
def test_an_idle_server_is_small(scan_file):
    process = started(scan_file, "--keep", "--no-browser")
    try:
        process.url = process.stdout.readline().strip()
        ask(process)  # a page, whose workbench computes
        time.sleep(5)
        with open(f"/proc/{process.pid}/status") as status:
            (resident,) = (1024 * int(line.split()[1]) for line in status if line.startswith("VmRSS:"))
        maps = 12  # of doubles: the scan, contact, film, friction
        assert resident < MOST_MEMORY + maps * tb.read(scan_file).height.nbytes
    finally:
        process.kill()
        process.communicate(timeout=60)


def test_with_json_the_address_is_a_key(program, scan_file):
    process = started(scan_file, "--level", "plane", "--json", "--no-browser", program=program)
    try:
        found = json.loads(process.stdout.readline())
        assert ADDRESS.fullmatch(found["url"]) and found["command"].startswith("tabor view ") and found["warnings"] == []
        assert found["tabor_version"] == tb.__version__
    finally:
        process.terminate()
        process.communicate(timeout=60)


@pytest.mark.parametrize("words, code, text", [
    (["nothing.x3p"], 3, "nothing.x3p: no such file"), (["SCAN", "--port", "99999"], 2, "--port"), (["SCAN", "--recipe", "shet"], 2, "sheet"),
    (["SCAN", "--level", "plain"], 2, "plane"), ([], 2, "SCAN"), (["SCAN", "--pixel", "3"], 2, "pixel"),
    (["SCAN", "--tool", "nothing.x3p"], 3, "nothing.x3p"), (["SCAN", "--tool", "grnd:Sa=1um"], 3, "ground"), (["SCAN", "--tool-repeats"], 2, "--tool")])
def test_what_is_wrong_is_said_in_one_line(program, scan_file, words, code, text):
    process = started(*(scan_file if word == "SCAN" else word for word in words), program=program)
    _, said = process.communicate(timeout=120)
    assert (process.returncode, said.count("\n")) == (code, 1) and said.startswith("tabor: ") and text in said


def test_without_bokeh_one_line_says_how_to_get_it(monkeypatch, capsys, scan_file):
    monkeypatch.setitem(sys.modules, "bokeh.server", None)
    assert cli.main([str(scan_file)]) == 3
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and "pip install 'bokeh" in said


def test_a_port_in_use_is_said(view, scan_file, capsys):
    assert cli.main([str(scan_file), "--port", str(urllib.parse.urlsplit(view.url).port), "--no-browser"]) == 3
    assert "in use" in capsys.readouterr().err


def test_view_takes_surfaces_and_nothing_else(levelled):
    with pytest.raises(TypeError, match="Surface"):
        tb.view("scan.x3p", browser=False)
    found = tb.view([levelled, levelled], browser=False, recipe="sheet")
    try:
        assert found.is_open and ask(found)[0] == 200 and found.url in repr(found)
    finally:
        found.close()
    assert found.wait(0) and "closed" in repr(found)


def test_every_file_of_the_package_is_short():
    for file in (ROOT / "python" / "tabor" / "view").glob("*.py"):
        assert len(file.read_text("utf-8").splitlines()) < 400, file.name
