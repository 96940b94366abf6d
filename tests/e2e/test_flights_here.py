"""A flight in a real browser: its log is what it flew, to the core's last digit, and it keeps the wall's time."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np
from playwright.sync_api import Page, expect

from heli2dof_core.flight import FlightLog, simulate_flight
from heli2dof_core.kernels.flight_layout import FLIGHT_ROW
from tests.browser import goto
from tests.e2e.conftest import App

WATCH = """async () => {
  const { Flight } = await import('./static/flight/index.js');
  const { frame } = Flight.prototype;
  const seen = (window.seen = { rows: [], apart: 0, frames: 0 });
  let anchor = null;
  Flight.prototype.frame = function (now) {
    if (!window.flight) {
      window.flight = this;
      this.addEventListener('frame', ({ detail }) => seen.rows.push(detail.rows));
    }
    frame.call(this, now);
    if (this.state.mode !== 'flying') return void (anchor = null);
    const { time, slow } = this.state;
    if (!anchor || slow < 1 || now - anchor.last > 250) anchor = { now, time };
    anchor.last = now;
    seen.frames += 1;
    seen.apart = Math.max(seen.apart, Math.abs((now - anchor.now) / 1000 - (time - anchor.time)));
  };
}"""
FLY = """(design) => {
  const { flight } = window;
  flight.do('reference', 0.1, 0.4);
  flight.do('gust', 0.2, -0.1, 150);
  flight.store.edit((own) => ({ ...own, ...design }));
}"""
TOLD = """() => {
  const { flight, seen } = window;
  flight.freeze();
  const all = new Uint8Array(seen.rows.reduce((sum, own) => sum + own.byteLength, 0));
  let at = 0;
  for (const own of seen.rows) {
    all.set(new Uint8Array(own.buffer, own.byteOffset, own.byteLength), at);
    at += own.byteLength;
  }
  let text = '';
  for (let k = 0; k < all.length; k += 8192) text += String.fromCharCode(...all.subarray(k, k + 8192));
  return { log: flight.log(), rows: btoa(text), apart: seen.apart, frames: seen.frames };
}"""
SLOW = [{"re": re, "im": 0} for re in (-7, -6, -5, -4)]
AFTER = "(time) => window.flight.state.time > time"


def test_a_flight_in_a_browser_is_the_cores(app: App, page: Page):
    goto(page, app.url + "#v1&view=fly")
    page.evaluate(WATCH)
    page.get_by_test_id("fly").click()
    page.wait_for_function("() => window.flight?.state.time > 0.3")
    page.evaluate(FLY, {"poles": SLOW})
    page.wait_for_function(AFTER, arg=1.0)
    page.evaluate(FLY, {"method": "lqr"})  # which only the server knows
    page.wait_for_function("() => window.flight.craft.takeovers.length === 2")
    page.wait_for_function(AFTER, arg=2.5)
    told: dict[str, Any] = page.evaluate(TOLD)
    course = simulate_flight(FlightLog.read(told["log"]))
    rows = np.frombuffer(base64.b64decode(told["rows"]), dtype="<f8").reshape(-1, FLIGHT_ROW)
    assert rows.shape == course.rows.shape
    assert np.abs(rows - course.rows).max() <= 1e-9 and course.apart <= 1e-9
    assert all(own.bumpless for own in course.takeovers) and len(course.takeovers) == 2
    assert [event[2].get("method") for event in told["log"]["events"] if event[1] == "design"][1] == "lqr"
    # half a tick from what is due at the most, now and where the measurement began, which is anew after a slow frame
    assert told["apart"] <= 0.002 + 1e-6 and told["frames"] > 10
    expect(page.get_by_test_id("fly")).to_be_hidden()
