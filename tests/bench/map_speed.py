"""How soon a map is there: designs in the page's workers, what is seen of them, and what a drag pays for it.

`python -m tests.bench.map_speed http://127.0.0.1:8000/ [rounds] [computed|seen|dragged …]` prints a JSON object for
each part as soon as it is measured, in milliseconds; nine rounds of all take two to three minutes. Computed: 64 × 48
cells of nonlinear settling times, 3,185 designs, by one worker and by two, and the coarse map before. Seen: from a
choice in the bar until these are painted. Dragged: frames of a drag of the other pair with the map and without, in
turns, and how many maps were painted meanwhile.
"""

from __future__ import annotations

import asyncio
import json
import os
import statistics
import sys
from collections.abc import AsyncIterator, Sequence
from typing import Any

from playwright.async_api import Browser, Page, async_playwright

from tests.bench.drag_speed import drag
from tests.browser import EMPTY, FLAGS, SEEN
from tests.patience import PATIENCE

MAP = "#v1&map=settling_time,yaw-pair"
COARSE, WHOLE, FINEST = 17 * 13, 65 * 49, 129 * 97
READY = "() => document.documentElement.dataset.designs === 'ready'"
PAINTED = f"() => document.querySelector('canvas.map')?.dataset.nodes === '{FINEST}'"
COMPUTED = """async ([stops, rounds, workers]) => {
  const { AT, compiled, fill, loadDesigns, MODULE, sizeOf } = await import('./static/kernel/index.js');
  const { designOf } = await import('./static/model/index.js');
  const preset = (await (await fetch('api/v1/presets')).json())[0];
  const design = designOf(preset);
  const numbers = new Float64Array(AT.NUMBERS);
  fill(numbers, design, preset);
  const designs = await loadDesigns(await compiled(await fetch(MODULE)), undefined, workers);
  const lane = designs.lane();
  const [columns, rows] = [65, 49];
  const nodes = Array.from({ length: columns * rows }, (_, i) => [i % columns, Math.floor(i / columns)]);
  const rank = ([x, y]) => (x % 4 || y % 4 ? 1 : 0);
  nodes.sort((a, b) => rank(a) - rank(b)); // the coarse map first
  const values = Float64Array.from(nodes.flatMap(([x, y]) => {
    const [re, im] = [-16 + (16 * x) / columns, (7 * y) / (rows - 1)];
    return [re, im, re, -im];
  }));
  const task = {
    numbers, values, stops, size: sizeOf(design, preset), at: [0, 1, 2, 3].map((k) => AT.POLES + k),
    measures: [{ name: 'settling_time', axis: 'theta', model: 'nonlinear' }],
  };
  const once = () => new Promise((done) => {
    const [begin, told] = [performance.now(), []];
    lane.ask(task, (found) => {
      told.push(performance.now() - begin);
      if (found.done === nodes.length) done([told[0], told.at(-1)]);
    });
  });
  for (let k = 0; k < 3; k++) await once(); // browsers compile what they run
  const all = [];
  for (let k = 0; k < rounds; k++) all.push(await once());
  return all;
}"""
CHOSEN = """(name) => new Promise((done) => {
  const told = {};
  const canvas = document.querySelector('canvas.map');
  const begin = performance.now();
  const watch = new MutationObserver(() => {
    told[canvas.dataset.nodes] ??= performance.now() - begin;
    if (!told[FINEST]) return;
    watch.disconnect();
    done(told);
  });
  watch.observe(canvas, { attributes: true, attributeFilter: ['data-nodes'] });
  const select = document.querySelector('[data-testid=map-name]');
  select.value = name;
  select.dispatchEvent(new Event('change'));
})""".replace("FINEST", str(FINEST))
COUNT = """() => {
  window.maps = 0;
  const canvas = document.querySelector('canvas.map');
  const { prototype } = CanvasRenderingContext2D;
  const clear = prototype.clearRect;
  prototype.clearRect = function (...all) {
    if (this.canvas === canvas) window.maps += 1;
    clear.apply(this, all);
  };
}"""


async def evaluated(page: Page, script: str, *given: Any) -> Any:
    """What a script's promise comes to, for which `evaluate` itself would wait for ever."""
    async with asyncio.timeout(PATIENCE):
        return await page.evaluate(script, *given)


def spread(values: list[float]) -> dict[str, float]:
    ordered = sorted(values)
    return {"median": round(statistics.median(ordered), 1), "best": round(ordered[0], 1)}


async def opened(browser: Browser, url: str) -> Page:
    page = await browser.new_page(viewport={"width": 1280, "height": 800})
    for script in (SEEN, EMPTY):
        await page.add_init_script(script)
    await page.goto(url)
    await page.wait_for_function(READY)
    return page


async def computed(browser: Browser, url: str, rounds: int) -> dict[str, Any]:
    page = await opened(browser, url)
    result: dict[str, Any] = {}
    for workers in (1, 2):
        all_of = await evaluated(page, COMPUTED, [[COARSE], rounds, workers])
        result[f"{workers} worker{'s' if workers > 1 else ''}"] = {
            "coarse": spread([first for first, _ in all_of]),
            "64 x 48": spread([last for _, last in all_of]),
        }
    await page.close()
    return result


async def seen(browser: Browser, url: str, rounds: int) -> dict[str, Any]:
    page = await opened(browser, url + MAP)
    await page.wait_for_function(PAINTED)
    told = [
        await evaluated(page, CHOSEN, name)
        for _ in range(rounds)
        for name in ("V_peak", "overshoot", "settling_time")
    ]
    await page.close()
    return {
        name: spread([own[str(nodes)] for own in told if str(nodes) in own])
        for name, nodes in (("coarse", COARSE), ("64 x 48", WHOLE), ("128 x 96", FINEST))
        if any(str(nodes) in own for own in told)
    }


async def dragged(browser: Browser, url: str, rounds: int) -> dict[str, Any]:
    """A drag of pitch's pole, over the map of yaw's places."""
    kinds = {"with the map": MAP, "without": "#v1"}
    found: dict[str, list[dict[str, Any]]] = {kind: [] for kind in kinds}
    for _ in range(max(2, rounds // 3)):
        for kind, link in kinds.items():
            page = await opened(browser, url + link)
            if kind == "with the map":
                await page.wait_for_function(PAINTED)
                await page.evaluate(COUNT)
            own = await drag(page)
            if kind == "with the map":
                own["maps"] = await page.evaluate("() => window.maps")
            found[kind].append(own)
            await page.close()
    return found


PARTS = {"computed": computed, "seen": seen, "dragged": dragged}


async def measured(url: str, rounds: int, names: Sequence[str]) -> AsyncIterator[dict[str, Any]]:
    """One part after the other, each as soon as it is known."""
    async with async_playwright() as playwright:
        path = os.environ.get("CHROMIUM") or "/usr/bin/chromium"
        browser = await playwright.chromium.launch(executable_path=path, args=FLAGS)
        for name in names:
            yield {name: await PARTS[name](browser, url, rounds)}
        await browser.close()


async def main(url: str, rounds: str = "9", *names: str) -> None:
    async for part in measured(url, int(rounds), names or [*PARTS]):
        print(json.dumps(part, indent=1), flush=True)


if __name__ == "__main__":
    asyncio.run(main(*sys.argv[1:]))
