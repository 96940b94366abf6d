"""An LMS for tests: a package unpacked behind a plain file server, and a page that launches it by scorm-again.

Its page keeps what it is told over reloads, as an LMS does over sessions, and writes down every call. scorm-again has
room for more suspended data than SCORM 1.2 (findings/scorm_again_keeps_too_much.sh), so that is counted here.
"""

from __future__ import annotations

import functools
import io
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import Any

from playwright.sync_api import Frame, Page

PLAYER = Path(__file__).parents[1] / "node_modules/scorm-again/dist/scorm12.min.js"

_PAGE = """<!doctype html>
<meta charset="utf-8"><title>A course</title>
<style>body { margin: 0 } iframe { display: block; width: 100vw; height: 100vh; border: 0 }</style>
<script src="scorm12.min.js"></script><script src="course.js"></script>
<iframe></iframe>"""

_COURSE = """
const kept = JSON.parse(localStorage.getItem('cmi') ?? 'null');
const asked = new URLSearchParams(location.search);
const lms = new Scorm12API({ autocommit: false, logLevel: 5 });
lms.loadFromJSON({
  ...kept,
  core: {
    ...kept?.core,
    student_id: asked.get('student') ?? 's1',
    student_name: 'Lovelace, Ada',
    lesson_mode: asked.get('mode') ?? 'normal',
    credit: 'credit',
    entry: kept ? 'resume' : 'ab-initio',
    session_time: undefined,
  },
}, 'cmi');
window.calls = [];
const keep = () => localStorage.setItem('cmi', JSON.stringify(lms.renderCommitCMI(true).cmi));
const api = {};
for (const name of ['Initialize', 'Finish', 'GetValue', 'SetValue', 'Commit', 'GetLastError', 'GetErrorString',
  'GetDiagnostic']) {
  api[`LMS${name}`] = (...all) => {
    if (all[0] === 'cmi.suspend_data' && all[1]?.length > 4096) return 'false';
    const answer = lms[`LMS${name}`](...all);
    window.calls.push([name, ...all, answer]);
    if (name === 'Commit' || name === 'Finish') keep();
    return answer;
  };
}
if (!asked.has('none')) window.API = api;
window.kept = () => JSON.parse(localStorage.getItem('cmi'));
addEventListener('DOMContentLoaded', () => { document.querySelector('iframe').src = `index.html`; });
window.leave = () => new Promise((gone) => {
  const frame = document.querySelector('iframe');
  frame.addEventListener('load', () => gone(), { once: true });
  frame.src = 'about:blank';
});
"""


class Course:
    """A package in an LMS.

    Attributes:
        url: of the page that launches it.
    """

    def __init__(self, folder: Path, port: int) -> None:
        self.folder, self.url = folder, f"http://127.0.0.1:{port}/lms.html"

    def launched(self, page: Page, query: str = "") -> Frame:
        """Opens the LMS's page, and the package in it, its first numbers drawn."""
        page.goto(f"{self.url}?{query}")
        page.wait_for_function(
            "() => frames[0]?.document.documentElement.dataset.state?.includes('\"settled\":true')"
        )
        return page.frames[1]


class _Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *_: Any) -> None:
        pass


@contextmanager
def course(package: bytes, folder: Path) -> Iterator[Course]:
    """The package behind a server that knows nothing but files."""
    with zipfile.ZipFile(io.BytesIO(package)) as zipped:
        zipped.extractall(folder)
    (folder / "lms.html").write_text(_PAGE)
    (folder / "course.js").write_text(_COURSE)
    (folder / PLAYER.name).write_bytes(PLAYER.read_bytes())
    handler = functools.partial(_Quiet, directory=str(folder))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        Thread(target=server.serve_forever, daemon=True).start()
        try:
            yield Course(folder, server.server_port)
        finally:
            server.shutdown()
