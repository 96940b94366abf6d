"""How soon the cloud of uncertain rigs follows the hand: from a pole's move to its rigs' dots, as the page sees it.

`python -m tests.bench.cloud_speed http://127.0.0.1:8000/ [moves]` prints a JSON object, in milliseconds. Of single
moves: until the first dots are drawn (the page's own are of all rigs, with 200 responses; the server's of 200 rigs),
and until all is known. Then of a drag of a move each frame: clouds drawn in a second, and the page's frames.
"""

from __future__ import annotations

import asyncio
import json
import os
import sys
from typing import Any

from playwright.async_api import Page, async_playwright

from tests.bench.drag_speed import drag, quantile
from tests.browser import EMPTY, FLAGS, SEEN

WATCH = """() => {
  const { prototype } = CanvasRenderingContext2D;
  window.drawn = [];
  addEventListener('pointermove', ({ timeStamp }) => (window.moved = timeStamp), { capture: true });
  for (const name of ['putImageData', 'fillRect']) {
    const draw = prototype[name];
    prototype[name] = function (...all) {
      draw.apply(this, all);
      if (this.canvas.className !== 'cloud') return;
      const now = performance.now();
      const last = window.drawn.at(-1);
      if (last && now - last < 1) window.drawn[window.drawn.length - 1] = now; // of the same picture
      else window.drawn.push(now);
    };
  }
}"""
DRAWN = "(pictures) => window.drawn.length >= pictures && window.drawn.map((at) => at - window.moved)"

SETTLED = "() => JSON.parse(document.documentElement.dataset.state ?? '{}').settled"


async def single_moves(page: Page, moves: int, pictures: int) -> list[list[float]]:
    """When dots were drawn after each of some moves of a held pole, so many pictures of each."""
    box = await page.get_by_test_id("pole-0").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    await page.mouse.move(x, y)
    await page.mouse.down()
    found = []
    for k in range(moves):
        await page.evaluate("() => { window.drawn.length = 0; }")
        await page.mouse.move(x - 10 - abs((k + 30) % 60 - 30), y)
        found.append(await (await page.wait_for_function(DRAWN, arg=pictures)).json_value())
    await page.mouse.up()
    await page.wait_for_function(SETTLED)
    return found


KINDS = {
    "the page's own cloud": ("0.1", "", 2),
    "the server's": ("0.1", "delete window.WebAssembly", 1),
    "no cloud": ("0", "", 0),
}
"""How uncertain rigs are, what the page is deprived of, and how many pictures a single move gives."""


async def measure(url: str, moves: int) -> dict[str, Any]:
    """Opens the page at 1280×800, each kind on a page of its own."""
    async with async_playwright() as playwright:
        path = os.environ.get("CHROMIUM") or "/usr/bin/chromium"
        browser = await playwright.chromium.launch(executable_path=path, args=FLAGS)
        result: dict[str, Any] = {}
        for kind, (spread, missing, pictures) in KINDS.items():
            page = await browser.new_page(viewport={"width": 1280, "height": 800})
            for script in (SEEN, EMPTY, missing):
                await page.add_init_script(script)
            await page.goto(f"{url}#v1&spread={spread}")
            if missing:
                await page.wait_for_function(
                    "() => document.querySelector('[data-testid=cloud-words]')?.textContent.startsWith('2000')"
                )
            else:
                await page.wait_for_function("() => document.documentElement.dataset.rigs === 'ready'")
            await page.evaluate(WATCH)
            own: dict[str, Any] = {}
            found = await single_moves(page, moves, pictures) if pictures else []
            for i, name in enumerate(("first dots", "all known")[:pictures]):
                times = [drawn[i] for drawn in found if len(drawn) > i]
                own[name] = {"median": round(quantile(times, 0.5), 1), "p95": round(quantile(times, 0.95), 1)}
            await page.evaluate("() => { window.drawn.length = 0; }")
            own |= await drag(page)
            count, took = await page.evaluate(
                "() => [window.drawn.length, window.drawn.at(-1) - window.drawn[0]]"
            )
            result[kind] = own | (
                {"clouds_per_second": round(1e3 * (count - 1) / took, 1)} if count > 1 else {}
            )
            await page.close()
        await browser.close()
    return result


if __name__ == "__main__":
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 100
    print(json.dumps(asyncio.run(measure(sys.argv[1], count)), indent=1))
