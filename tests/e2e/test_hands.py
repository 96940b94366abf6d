"""Hands on a flight in a real browser: keys, sticks under two fingers, a scripted gamepad, pushes, weather."""

from __future__ import annotations

import math
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import EMPTY, FRAME, opened
from tests.e2e.conftest import App
from tests.e2e.flying import CALL, FRAMES, HEARD, PAD, did, fly, slowly, waits
from tests.e2e.test_axe import violations


@pytest.fixture
def page(chromium: Browser, app: App) -> Iterator[Page]:
    """The view Fly, its scene's frame empty, before the first flight."""
    with opened(chromium, f"{app.url}#fly", scene=HEARD + PAD + EMPTY) as page:
        expect(page.get_by_test_id("fly")).to_be_visible()
        yield page


def test_arrows_move_the_set_points_finely_at_first_and_nothing_is_written_while_one_is_held(page: Page):
    fly(page)
    slowly(page, 0.1)  # to the stop it is a second
    did(page)
    page.keyboard.down("ArrowUp")
    waits(page, "craft.reference[0] > 0.1")
    # a frame of a busy machine may be longer than a tap
    whole = ["turn", 0.6, 0]
    assert did(page) in ([["turn", 0.12, 0], whole], [whole])
    page.keyboard.down("KeyD")
    waits(page, "craft.u[6] === 1.2")
    whole = ["turn", 0.6, 1.2]
    assert did(page) in ([["turn", 0.6, 0.24], whole], [whole])
    page.keyboard.up("ArrowUp")
    page.keyboard.up("KeyD")
    assert did(page)[-1] == ["turn", 0, 0]
    here = page.evaluate("() => window.flight.craft.reference")
    assert here[0] > 0.05 and here[1] > 0
    page.evaluate(FRAMES)
    assert page.evaluate("() => window.flight.craft.reference") == here


def test_pitchs_set_point_ends_at_the_stop(page: Page):
    fly(page)
    slowly(page, 0.25)  # it ends with the frame in which it is there
    page.keyboard.down("ArrowUp")
    waits(page, "craft.u[5] === 0 && craft.reference[0] >= craft.travel")
    assert page.evaluate("() => window.flight.craft.reference[0] - window.flight.craft.travel") < 0.1
    page.keyboard.up("ArrowUp")
    page.keyboard.down("ArrowDown")
    waits(page, "craft.reference[0] < craft.travel - 0.05")


def test_hands_on_the_sticks_are_the_voltages_at_the_next_sample(page: Page):
    fly(page)
    page.keyboard.press("h")
    expect(page.get_by_test_id("fly-hands")).to_have_attribute("aria-pressed", "true")
    [sticks, hands] = [event for event in did(page) if event[0] in ("sticks", "hands")]
    assert hands == ["hands", 1]
    hover = sticks[1:]
    assert 5 < hover[0] < 20  # about what holds the nose up
    page.keyboard.down("w")
    waits(page, "craft.u[1] === 24")
    page.keyboard.up("w")
    waits(page, "craft.u[1] !== 24")
    *fine, whole, back = did(page, "sticks")
    tap = ["sticks", pytest.approx(hover[0] + 0.2 * (24 - hover[0]), abs=1e-3), hover[1]]
    assert [whole, back] == [["sticks", 24, hover[1]], ["sticks", *hover]] and fine in ([tap], [])
    # in the course: the motors have it a sample after the stick was moved at the latest
    late = page.evaluate("""() => {
      const { craft } = window.flight;
      const [asked] = craft.events.filter(([, word, V]) => word === "sticks" && V === 24);
      const { rows, firstTick, count } = window.flight.lastRows(60);
      const width = rows.length / count;
      const found = Array.from({ length: count }, (_, n) => n).find((n) => rows[n * width + 8] === 24);
      return [firstTick + found - asked[0], craft.ticksPerSample];
    }""")
    assert 0 <= late[0] <= late[1]
    page.keyboard.press("h")
    expect(page.get_by_test_id("fly-hands")).to_have_attribute("aria-pressed", "false")


def test_a_press_is_flown_and_seen_two_frames_later_at_the_latest(page: Page):
    fly(page)
    # As a key comes between two frames; the pose that is handed to the scene stands in the read-outs of that frame.
    frames = page.evaluate(f"""async () => {{
      await ({FRAME})();
      const before = flight.craft.tick;
      const until = (what) => new Promise((done) => {{
        let n = 0;
        const look = () => {{ n += 1; if (what()) done(n); else requestAnimationFrame(look); }};
        requestAnimationFrame(look);
      }});
      const key = {{ key: "ArrowRight", code: "ArrowRight", bubbles: true }};
      document.body.dispatchEvent(new KeyboardEvent("keydown", key));
      const flown = await until(() => did.some(([word, , psi]) => word === "turn" && psi > 0));
      return [flown, flight.craft.tick > before];
    }}""")
    assert frames == [frames[0], True] and frames[0] <= 2


def test_keys_that_belong_to_the_page_do_not_fly(page: Page):
    fly(page)
    did(page)
    # a field, a slider, the s-plane
    for where in (".poles input.number", ".poles input[type=range]", "#splane [tabindex]"):
        page.locator(where).first.focus()
        page.keyboard.press("ArrowUp")
        page.keyboard.press("h")
        assert [event for event in did(page) if event[0] in ("turn", "hands", "sticks")] == [], where
    page.evaluate("() => document.activeElement.blur()")
    # with Ctrl; and a letter after G goes to a view
    page.keyboard.press("Control+h")
    page.keyboard.press("g")
    page.keyboard.press("d")
    page.wait_for_function("() => document.documentElement.dataset.view === 'design'")
    assert did(page, "turn") == []
    # where its view is not seen, no key flies
    page.keyboard.press("h")
    page.keyboard.press("ArrowUp")
    assert [event for event in did(page) if event[0] in ("turn", "hands")] == []


def test_space_is_the_buttons_that_has_the_focus(page: Page):
    fly(page)
    page.get_by_test_id("fly-push").focus()
    page.keyboard.press("Space")
    expect(page.get_by_test_id("fly-push")).to_have_attribute("aria-pressed", "true")
    assert page.evaluate("() => window.flight.state.mode") == "flying"
    page.evaluate("() => document.activeElement.blur()")
    page.keyboard.press("Space")
    waits(page, "state.mode === 'frozen'")


def test_a_flight_by_keys_alone(page: Page):
    page.keyboard.press("Enter")
    page.wait_for_function("() => window.flight?.state.mode === 'flying'")
    page.evaluate("() => document.activeElement.blur()")
    waits(page, "state.time > 1")
    page.keyboard.press("b")
    assert did(page, "gust") != []
    page.keyboard.press(",")
    waits(page, "state.speed === 0.5")
    for _ in range(3):
        page.keyboard.press(",")
    waits(page, "state.speed === 1")
    page.keyboard.press("Space")
    waits(page, "state.mode === 'frozen'")
    before = page.evaluate("() => window.flight.craft.tick")
    page.keyboard.press(".")
    waits(page, "craft.tick === arg + craft.ticksPerSample", before)
    wanted = page.evaluate("() => Math.max(window.flight.craft.time - 5, 0)")
    page.keyboard.press("Backspace")
    waits(page, "Math.abs(craft.time - arg) <= craft.step", wanted)
    page.keyboard.press("Space")
    waits(page, "state.mode === 'flying'")
    page.keyboard.press("k")
    expect(page.get_by_test_id("fly-legend")).to_be_visible()
    assert violations(page) == []
    page.keyboard.press("k")
    expect(page.get_by_test_id("fly-legend")).to_be_hidden()
    page.keyboard.press("x")
    waits(page, "state.mode === 'ended'")
    page.keyboard.press("r")
    waits(page, "state.mode === 'flying'")


def test_a_held_key_is_let_go_when_the_window_loses_the_focus(page: Page):
    fly(page)
    page.keyboard.down("ArrowLeft")
    waits(page, "craft.u[6] < 0")
    page.evaluate("() => window.dispatchEvent(new Event('blur'))")
    waits(page, "craft.u[6] === 0")


def test_a_gamepad_flies(page: Page):
    lamp = page.get_by_test_id("fly-pad")
    fly(page)
    slowly(page, 0.1)
    expect(lamp).to_have_text("Gamepad: press any button on it.")
    did(page)

    def hold(*axes: float, down: tuple[int, ...] = ()) -> None:
        page.evaluate("(held) => { window.held = held; }", {"axes": axes, "down": down})

    hold(0, 0, 0, 0, down=(0,))  # the press that makes it known freezes nothing
    expect(lamp).to_have_text("Gamepad: Scripted Pad")
    assert page.evaluate("() => window.flight.state.mode") == "flying"
    hold(0.05, -0.1, 0, 0)  # the dead middle
    assert did(page) == []
    hold(0.56, -1, 0, 0)
    assert did(page) == [["turn", 0.6, 0.6]]
    hold(0.563, -1, 0, 0)  # its noise
    assert did(page) == []
    hold(0, 0, 0, 0, down=(2,))
    expect(page.get_by_test_id("fly-hands")).to_have_attribute("aria-pressed", "true")
    did(page)
    hold(0, 1, -1, 0)  # left y and right x
    waits(page, "craft.u[1] === -24 && craft.u[2] === -15")
    hold(0, 0, 0, 0, down=(0,))
    waits(page, "state.mode === 'frozen'")
    hold(0, 0, 0, 0)
    page.evaluate(FRAMES)
    hold(0, 0, 0, 0, down=(0,))
    waits(page, "state.mode === 'flying'")
    hold(0, 0, 0, 0, down=(1,))
    waits(page, "craft.u[13] > 0")  # a gust
    assert did(page, "gust") != []
    # one that is pulled out lets go
    hold(0, -1, 0, 0)
    waits(page, "craft.u[1] === 24")
    page.evaluate("() => { window.held = null; }")
    waits(page, "craft.u[1] !== 24")
    expect(lamp).to_have_text("Gamepad: press any button on it.")


@pytest.mark.parametrize("size", [(390, 844), (820, 1180)])
def test_two_thumbs_fly(chromium: Browser, app: App, size: tuple[int, int]):
    with opened(
        chromium, f"{app.url}#fly", scene=HEARD + EMPTY, size=size, has_touch=True, is_mobile=True
    ) as page:
        fly(page)
        slowly(page, 0.1)
        page.get_by_test_id("stick-pitch").scroll_into_view_if_needed()
        boxes = [page.get_by_test_id(f"stick-{axis}").bounding_box() for axis in ("pitch", "yaw")]
        pitch, yaw = (box for box in boxes if box)
        assert pitch["x"] + pitch["width"] < yaw["x"]  # a thumb each
        assert min(pitch["width"], yaw["height"]) >= 44 and yaw["x"] + yaw["width"] <= size[0]
        up = {"x": pitch["x"] + pitch["width"] / 2, "y": pitch["y"] + 2, "id": 1}
        right = {"x": yaw["x"] + yaw["width"] - 2, "y": yaw["y"] + yaw["height"] / 2, "id": 2}
        did(page)
        screen = page.context.new_cdp_session(page)

        def touch(kind: str, *points: dict[str, float]) -> None:
            screen.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": list(points)})

        touch("touchStart", up)
        waits(page, "craft.u[5] === 0.6 && craft.u[6] === 0")
        touch("touchStart", up, right)
        waits(page, "craft.u[5] === 0.6 && craft.u[6] === 1.2")
        scrolled = page.evaluate("() => scrollY")
        touch("touchMove", up, right | {"x": yaw["x"] + yaw["width"] / 2, "y": yaw["y"] - 200})
        waits(page, "craft.u[5] === 0.6 && craft.u[6] === 0")
        assert page.evaluate("() => scrollY") == scrolled
        touch("touchEnd")
        waits(page, "craft.u[5] === 0 && craft.u[6] === 0")
        for name in ("fly-hands", "fly-push", "fly-keys"):
            box = page.get_by_test_id(name).bounding_box()
            assert box and min(box["height"], box["width"]) >= 44


def test_a_stick_follows_a_mouse_and_springs_back(page: Page):
    fly(page)
    did(page)
    stick = page.get_by_test_id("stick-yaw")
    box = stick.bounding_box()
    assert box
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    assert did(page) == []
    page.mouse.move(box["x"] - 300, box["y"])  # beyond its end
    expect(stick).to_have_attribute("aria-valuenow", "-100")
    assert did(page)[-1] == ["turn", 0, -1.2]
    page.mouse.up()
    expect(stick).to_have_attribute("aria-valuenow", "0")
    assert did(page)[-1] == ["turn", 0, 0]
    # by keys, too, while it has the focus, and it says what that means
    stick.focus()
    page.keyboard.down("ArrowRight")
    expect(stick).to_have_attribute("aria-valuetext", "set point moves by 69° per second")
    page.keyboard.up("ArrowRight")
    expect(stick).to_have_attribute("aria-valuetext", "the set point rests")


def test_keys_push_the_nose(page: Page):
    fly(page)
    did(page)
    page.keyboard.down("Shift")
    page.keyboard.down("ArrowUp")
    waits(page, "craft.u[8] > 0")
    [first, *_] = did(page, "push")
    assert first[1] == pytest.approx(2.0 * 0.19685, abs=1e-3) and first[2] == 0
    expect(page.get_by_test_id("fly-told")).to_have_text("You push with 2.0 N.")
    page.keyboard.up("ArrowUp")
    page.keyboard.up("Shift")
    waits(page, "craft.u[8] === 0")
    assert did(page, "turn") == []


def test_what_was_held_before_a_rewind_is_not_held_after_it(page: Page):
    fly(page)
    waits(page, "state.time > 0.3")
    page.keyboard.down("ArrowUp")
    waits(page, "craft.u[5] === 0.6")
    held = page.evaluate("() => window.flight.craft.events.at(-1)[0] * window.flight.craft.step")
    waits(page, "craft.time > arg + 0.6", held)
    page.keyboard.press("Space")
    waits(page, "state.mode === 'frozen'")
    page.keyboard.up("ArrowUp")
    page.evaluate("(held) => window.flight.rewind(window.flight.craft.time - held - 0.3)", held)
    waits(page, "craft.u[5] === 0.6")
    page.keyboard.press("Space")
    waits(page, "craft.u[5] === 0")


def test_weather_and_faults_act_and_are_shown(page: Page):
    fly(page)
    page.evaluate(CALL, "freeze")
    did(page)
    page.get_by_test_id("gust-large").click()
    [gust] = did(page, "gust")
    assert math.hypot(*gust[1:3]) == pytest.approx(0.6 * 4 * 0.19685, abs=2e-3) and gust[3] > 1
    expect(page.get_by_test_id("gust-large")).to_have_class("acts")
    told = page.get_by_test_id("weather-told")
    page.get_by_test_id("weather-mass").select_option(label="200 g")
    page.get_by_test_id("weather-yaw").select_option("0.5")
    page.get_by_test_id("weather-stuck-psi").check()
    assert did(page)[-3:] == [["hung", 0.2, 0.197], ["thrust", 1, 0.5], ["stuck", 0, 1]]
    expect(told).to_contain_text(
        "200 g at the nose, yaw rotor at 50 % of its thrust, the encoder of ψ sticks"
    )
    page.evaluate(CALL, "go")
    waits(page, "craft.tick > craft.u[12] + craft.u[13]")
    expect(page.get_by_test_id("gust-large")).not_to_have_class("acts")
    # back in time they have not happened
    page.evaluate("() => window.flight.rewind(60)")
    expect(told).to_have_text("")
    expect(page.get_by_test_id("weather-mass")).to_have_value("0")
    expect(page.get_by_test_id("weather-stuck-psi")).not_to_be_checked()
    page.get_by_test_id("weather-pitch").select_option("0.2")
    did(page)
    page.get_by_test_id("weather-calm").click()
    assert did(page) == [["thrust", 1, 1]]
    assert violations(page) == []


def test_the_same_seed_brings_the_same_weather(page: Page):
    fly(page)
    page.get_by_test_id("weather-random").check()

    def weather() -> list[list[float]]:
        page.evaluate(CALL, "freeze")
        page.evaluate("() => window.did.splice(0)")
        page.keyboard.press("r")
        page.wait_for_function("() => window.did.filter(([word]) => word === 'gust').length > 1")
        return did(page, "gust")[:2]

    page.evaluate("() => document.activeElement.blur()")
    first, second = weather(), weather()
    assert first == second
    page.get_by_test_id("weather-seed").fill("2")
    page.evaluate("() => document.activeElement.blur()")
    assert weather() != first
