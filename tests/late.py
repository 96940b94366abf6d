"""Answers, messages and frames late by random, seeded times: what a weak machine behind a bad network does to a page.

With LATE=<number> in the environment every page of the browser tests is delayed so (`make steady`). A test that fails
then has met a race, of the page or its own.
"""

from __future__ import annotations

import os
import zlib

ANSWER, MESSAGE, FRAME = 500, 250, 90
"""The longest delays, ms; most are much shorter. A late frame is a busy one, which holds all else up."""

DELAYS = """(() => {
  let state = SEED;
  const random = () => { // mulberry32
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
  // The machine's own clock: a test may have put the page's on.
  const [now, later] = [performance.now.bind(performance), window.setTimeout.bind(window)];
  const late = (most) => new Promise((go) => later(go, most * random() ** 3));

  const ask = window.fetch;
  window.fetch = async function (...all) {
    const answer = await ask.apply(this, all);
    await late(ANSWER);
    all[1]?.signal?.throwIfAborted();
    return answer;
  };

  // Messages keep their order, and the end comes after them.
  const held = (Own, kinds) => class extends Own {
    constructor(...all) {
      super(...all);
      let before = Promise.resolve();
      const own = new Set();
      for (const kind of kinds) super.addEventListener(kind, (event) => {
        if (own.has(event)) return;
        event.stopImmediatePropagation();
        before = before.then(() => late(MESSAGE)).then(() => {
          const again = new event.constructor(kind, event);
          own.add(again);
          this.dispatchEvent(again);
          own.delete(again);
        });
      });
    }
  };
  window.WebSocket = held(WebSocket, ["message", "close"]);
  window.Worker = held(Worker, ["message"]);

  if (window === window.top) {
    const busy = () => {
      const end = now() + (random() < 0.3 ? FRAME * random() ** 2 : 0);
      while (now() < end);
      requestAnimationFrame(busy);
    };
    requestAnimationFrame(busy);
  }
})();"""


def scripts() -> list[str]:
    """What each page runs first: the delays where they are wanted, another sequence for each test."""
    seed = os.environ.get("LATE")
    if not seed:
        return []
    test = os.environ.get("PYTEST_CURRENT_TEST", "").partition(" ")[0]
    values = {
        "SEED": zlib.crc32(f"{seed} {test}".encode()),
        "ANSWER": ANSWER,
        "MESSAGE": MESSAGE,
        "FRAME": FRAME,
    }
    script = DELAYS
    for name, value in values.items():
        script = script.replace(name, str(value))
    return [script]
