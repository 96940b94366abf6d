"""A flight under a test's hands: what happens in it, as its log has it, and a gamepad that a test holds."""

from __future__ import annotations

from typing import Any

from playwright.sync_api import Page

from tests.browser import FRAME

# What happens in flights, as their logs have it; and the newest flight itself.
HEARD = """window.did = [];
const tell = EventTarget.prototype.dispatchEvent;
EventTarget.prototype.dispatchEvent = function (event) {
  if (event.type === "start") window.flight = this;
  if (event.type === "did") did.push([event.detail.word, ...event.detail.values]);
  return tell.call(this, event);
};"""
# A gamepad that a test holds: as in Chromium each look is a new snapshot, and there is none before a press.
PAD = """window.held = null;
navigator.getGamepads = () => {
  if (!held) return [null, null, null, null];
  const buttons = Array.from({ length: 17 }, (_, k) => {
    const pressed = held.down.includes(k);
    return { pressed, touched: pressed, value: Number(pressed) };
  });
  const id = "Scripted Pad (STANDARD GAMEPAD Vendor: 045e Product: 02ea)";
  return [null, { id, index: 1, connected: true, mapping: "standard", timestamp: performance.now(),
    axes: [...held.axes], buttons }, null, null];
};"""
FRAMES = f"async () => {{ for (let n = 0; n < 3; n++) await ({FRAME})(); }}"
CALL = "(act) => window.flight[act]()"


def fly(page: Page) -> None:
    page.get_by_test_id("fly").click()
    page.wait_for_function("() => window.flight?.state.mode === 'flying' && window.flight.craft.tick > 0")


def slowly(page: Page, speed: float) -> None:
    """Slows time, where what is tested takes less of it than a busy machine's round trips."""
    page.evaluate("(speed) => window.flight.setSpeed(speed)", speed)


def did(page: Page, word: str | None = None) -> list[list[Any]]:
    """What has happened since this was asked last, of one word or of all."""
    page.evaluate(FRAMES)
    events = page.evaluate("() => window.did.splice(0)")
    return [event for event in events if word in (None, event[0])]


def waits(page: Page, condition: str, arg: Any = None) -> None:
    page.wait_for_function(
        f"(arg) => {{ const {{ craft, state }} = window.flight; return {condition}; }}", arg=arg
    )
