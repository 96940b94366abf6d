"""How smooth a drag is: a move sixty times a second, frame times and latency up to the plots as the page sees them.

`python -m tests.bench.drag_speed http://127.0.0.1:8000/ [runs]` prints one JSON object per run.
Aims: frames' p95 under 20 ms, median latency under 33 ms.
"""

from __future__ import annotations

import asyncio
import json
import os
import sys
import time
from itertools import pairwise
from typing import Any

from playwright.async_api import Page, async_playwright

from tests.browser import FLAGS, SEEN

MOVES = 300
RATE = 60.0
"""Moves per second: one for each frame of a usual screen."""

START = """() => {
  heli2dofStats.reset();
  const run = (window.dragRun = { on: true, frames: [], moves: 0 });
  addEventListener('pointermove', () => { run.moves += 1; }, { capture: true });
  const tick = (now) => {
    run.frames.push(now);
    if (run.on) requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
}"""
STOP = """() => {
  const { frames, moves } = window.dragRun;
  window.dragRun.on = false;
  return { frames, moves, stats: heli2dofStats.summary() };
}"""


def quantile(values: list[float], q: float) -> float:
    """The value below which a share q of them lies."""
    return sorted(values)[min(len(values) - 1, int(q * len(values)))]


async def drag(page: Page) -> dict[str, Any]:
    """Moves a real pole to and fro along its axis while frames are timed.

    The moves leave on a clock of their own, as a hand's do. Playwright's `mouse.move` would wait for each to be
    acknowledged and run scripts of its own in the page meanwhile, which halves the rate.
    """
    cdp = await page.context.new_cdp_session(page)
    box = await page.get_by_test_id("pole-0").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    await page.mouse.move(x, y)
    await page.mouse.down()
    await page.evaluate(START)
    begin = time.perf_counter()
    sent = []
    for k in range(MOVES):
        await asyncio.sleep(max(0.0, begin + k / RATE - time.perf_counter()))
        event = {
            "type": "mouseMoved",
            "button": "left",
            "buttons": 1,
            "x": x - 60 + abs((k % 120) - 60),
            "y": y,
        }
        sent.append(asyncio.ensure_future(cdp.send("Input.dispatchMouseEvent", event)))
    await asyncio.gather(*sent)
    found = await page.evaluate(STOP)
    await page.mouse.up()
    frames, stats = found["frames"], found["stats"]
    steps = [b - a for a, b in pairwise(frames)]
    return {
        "frames": len(steps),
        "moves": found["moves"],
        "frame_median": round(quantile(steps, 0.5), 1),
        "frame_p95": round(quantile(steps, 0.95), 1),
        "frame_max": round(max(steps), 1),
        "updates": stats["updates"],
        "updates_per_second": stats["perSecond"],
        "latency_median": stats["median"],
        "latency_p95": stats["p95"],
        "render_median": stats["render"],
    }


async def measure(url: str, runs: int = 1) -> list[dict[str, Any]]:
    """Opens the page at 1280×800 with its scene hidden and drags, each run on a page of its own. Milliseconds."""
    results = []
    async with async_playwright() as playwright:
        path = os.environ.get("CHROMIUM") or "/usr/bin/chromium"
        browser = await playwright.chromium.launch(executable_path=path, args=FLAGS)
        for _ in range(runs):
            page = await browser.new_page(viewport={"width": 1280, "height": 800})
            await page.route(
                "**/scene/*/", lambda route: route.fulfill(content_type="text/html", body="<title>-</title>")
            )
            await page.add_init_script(SEEN)
            await page.goto(url)
            await page.get_by_test_id("show-scene").uncheck()
            await page.wait_for_function(
                "() => JSON.parse(document.documentElement.dataset.state ?? '{}').settled"
            )
            results.append(await drag(page))
            await page.close()
        await browser.close()
    return results


if __name__ == "__main__":
    for result in asyncio.run(measure(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 1)):
        print(json.dumps(result))
