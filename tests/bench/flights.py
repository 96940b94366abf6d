"""What a flight costs in a browser, and how well it keeps the wall's time.

`python -m tests.bench.flights http://127.0.0.1:8000/ [seconds]` prints a JSON object. Kernels: of several designs
under moving set points and gusts, the share of real time that their ticks take on one core, microseconds of a tick,
and milliseconds of a frame's ticks and of a new controller. Pace: a flight of so many seconds (60 without a word) in
the view Fly while set points move and poles are dragged, with the scene's frame empty, without its drawing, and all
drawn (SCENES names fewer of these): how far its time is from the wall's at most, in ms, but for gaps of a quarter of
a second and more, and frames with no time for all that was due, which are told; frames' distances and work.
"""

from __future__ import annotations

import json
import os
import sys
from typing import Any

from playwright.sync_api import Page, sync_playwright

from tests.browser import EMPTY, FLAGS, SEEN, UNDRAWN, launched

KERNELS = """async (seconds) => {
  const { compiled, Flights, instantiated, MODULE } = await import('./static/kernel/index.js');
  const { Craft } = await import('./static/flight/craft.js');
  const { bodyOfFlight, Designs } = await import('./static/flight/designs.js');
  const { designOf } = await import('./static/model/index.js');
  const presets = await (await fetch('api/v1/presets')).json();
  const flights = new Flights(await instantiated(await compiled(await fetch(MODULE))));
  const designs = new Designs(flights, () => presets);
  const of = (name, scenario = {}, more = {}) => {
    const design = designOf(presets.find((preset) => preset.name === name));
    return { ...design, ...more, scenario: { ...design.scenario, ...scenario } };
  };
  const rotor = { tau: 0.1, curve: 'quadratic', dead_zone: 1 };
  const rubs = { coulomb: 0.02, static: 0.03 };
  const [rotors, friction] = [{ pitch: rotor, yaw: rotor }, { pitch: rubs, yaw: rubs }];
  const all = { measured: 'observer', noise: { theta: 1e-4, psi: 1e-4 }, digital: {} };
  const manual = 'quanser-2dof-manual';
  const cases = {
    'manual, continuous: ticks of 2 ms': of(manual),
    'manual, encoders and filtered rates, 2 ms': of(manual, { digital: {} }),
    'manual, 0.5 ms': of(manual, { digital: { sample_time: 0.0005 } }),
    'manual, 0.1 ms': of(manual, { digital: { sample_time: 0.0001 } }),
    'Aero 2, 2 ms': of('quanser-aero-2', { digital: {} }),
    'manual, rotors, friction, observer, noise, 2 ms': of(manual, all, { rotors, friction }),
  };
  const at = (sorted, share) => sorted[Math.min(Math.floor(share * sorted.length), sorted.length - 1)];
  const one = (design) => {
    const body = bodyOfFlight(design, presets);
    const preset = presets.find(({ name }) => name === design.preset);
    const made = [];
    for (let n = 0; n < 100; n++) {
      const begin = performance.now();
      flights.controller(design, preset);
      made.push(performance.now() - begin);
    }
    const craft = new Craft(flights, designs.here(body), 3);
    const ticks = Math.round(1 / 60 / craft.step);
    const times = [];
    for (let n = 0; craft.time < seconds && !craft.ended; n++) {
      if (n % 30 === 0) craft.do('reference', 0.3 * Math.sin(n), Math.cos(n));
      if (n % 50 === 0) craft.do('gust', 0.1, 0.1, Math.round(0.3 / craft.step));
      const begin = performance.now();
      craft.fly(ticks);
      times.push(performance.now() - begin);
    }
    const spent = times.reduce((sum, own) => sum + own, 0);
    times.sort((a, b) => a - b);
    made.sort((a, b) => a - b);
    return {
      percent_of_real_time: spent / 10 / craft.time, us_per_tick: (1000 * spent) / craft.tick,
      frame_p95_ms: at(times, 0.95), controller_ms: at(made, 0.5), flown_s: craft.time,
    };
  };
  for (const design of Object.values(cases)) one(design); // browsers compile what they run
  return Object.fromEntries(Object.entries(cases).map(([name, design]) => [name, one(design)]));
}"""
WATCH = """async () => {
  const { Flight } = await import('./static/flight/index.js');
  const { frame } = Flight.prototype;
  const seen = (window.seen = { gaps: [], work: [], apart: 0, holds: 0, slowed: 0, slow: 1, time: 0, last: NaN });
  let [anchor, slow] = [null, 1];
  Flight.prototype.frame = function (now) {
    window.flight = this;
    const begin = performance.now();
    frame.call(this, now);
    if (this.state.mode !== 'flying') return;
    seen.work.push(performance.now() - begin);
    const { time } = this.state;
    const gap = now - seen.last;
    const slowed = this.state.slow < slow; // there was no time for all that was due
    slow = this.state.slow;
    if (gap > 250) seen.holds += 1;
    if (slowed) seen.slowed += 1;
    if (!anchor || gap > 250 || slowed) anchor = { now, time };
    else {
      seen.gaps.push(gap);
      seen.apart = Math.max(seen.apart, Math.abs(now - anchor.now - 1000 * (time - anchor.time)));
    }
    [seen.last, seen.time] = [now, time];
    seen.slow = Math.min(seen.slow, this.state.slow);
  };
}"""
HAND = """(seconds) => new Promise((done) => {
  let frames = 0;
  const next = () => {
    const { flight } = window;
    if (flight.state.time >= seconds || flight.state.mode !== 'flying') return done(flight.state);
    frames += 1;
    if (frames % 60 === 0) flight.do('reference', 0.2 * Math.sin(frames), 0.5 * Math.cos(frames));
    if (frames % 90 === 0) flight.do('turn', 0.05, -0.1);
    if (frames % 240 < 60) flight.store.edit((design) => ({
      ...design, poles: design.poles.map(({ re, im }) => ({ re: re * (frames % 240 < 30 ? 1.003 : 0.997), im })),
    }), { gesture: 'bench' });
    requestAnimationFrame(next);
  };
  next();
})"""
TOLD = """() => {
  const { gaps, work, ...told } = window.seen;
  const sorted = (list) => [...list].sort((a, b) => a - b);
  const at = (list, share) => sorted(list)[Math.min(Math.floor(share * list.length), list.length - 1)];
  return {
    ...told, frames: gaps.length,
    frame_p50_ms: at(gaps, 0.5), frame_p95_ms: at(gaps, 0.95), frame_max_ms: at(gaps, 1),
    work_p50_ms: at(work, 0.5), work_p95_ms: at(work, 0.95), work_max_ms: at(work, 1),
    changes: window.flight.craft.takeovers.length,
  };
}"""


def pace(page: Page, address: str, seconds: float) -> dict[str, Any]:
    """A flight in the page, by a hand that never rests."""
    page.goto(f"{address}#v1&view=fly")
    page.wait_for_selector("[data-testid=fly]:visible", timeout=60_000)
    page.wait_for_function("() => document.documentElement.dataset.designs === 'ready'", timeout=60_000)
    page.evaluate(WATCH)
    page.click("[data-testid=fly]")
    page.wait_for_function("() => window.flight?.state.mode === 'flying'", timeout=60_000)
    state = page.evaluate(HAND, seconds)
    told = page.evaluate(TOLD)
    return {key: round(value, 3) if isinstance(value, float) else value for key, value in told.items()} | {
        "mode": state["mode"]
    }


SCENES = {"no scene": [EMPTY], "scene without its drawing": [UNDRAWN], "scene drawn by software": []}


def main(address: str, seconds: float) -> dict[str, Any]:
    """All of it."""
    found: dict[str, Any] = {}
    with sync_playwright() as playwright, launched(playwright.chromium, *FLAGS) as browser:
        page = browser.new_page()
        page.goto(address)
        kernels = page.evaluate(KERNELS, 20)
        found["kernels"] = {
            name: {key: round(value, 3) for key, value in own.items()} for name, own in kernels.items()
        }
        page.close()
        for name in os.environ.get("SCENES", ",".join(SCENES)).split(","):
            context = browser.new_context(viewport={"width": 1280, "height": 800})
            for script in (SEEN, *SCENES[name]):
                context.add_init_script(script)
            found[name] = pace(context.new_page(), address, seconds)
            context.close()
    return found


if __name__ == "__main__":
    print(json.dumps(main(sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 60.0), indent=2))
