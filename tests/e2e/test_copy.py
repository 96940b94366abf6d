"""Copying out: matrices and formulas through the clipboard, plots as files; reading values off the plots."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from tests.browser import state, view
from tests.e2e.conftest import App
from tests.e2e.test_permalink import clipboard


def copied(page: Page, menu: str, item: str) -> str:
    page.get_by_test_id(f"copy-{menu}").first.click()
    page.get_by_test_id(f"copy-{item}").click()
    expect(page.get_by_test_id("copied")).to_contain_text("copied as")
    text = page.evaluate("() => navigator.clipboard.readText()")
    page.keyboard.press("Escape")
    return text


def test_matrices_are_copied_at_full_precision(page: Page, app: App):
    clipboard(page, app)
    names: dict = {}
    exec(copied(page, "k-matrix", "all-Python"), names)
    reply = page.request.post(app.url + "api/v1/gains", data={}).json()
    for name in ("K", "A", "B"):
        np.testing.assert_array_equal(names[name], reply[name])
    assert names["K"].tolist() == state(page)["K"]
    assert len(names["loop_poles"]) == 6
    assert copied(page, "k-matrix", "RGA-LaTeX").startswith("\\mathrm{RGA} = \\begin{bmatrix}")
    assert "RGA = [ ..." in copied(page, "k-matrix", "RGA-MATLAB")


def test_copying_works_where_the_browser_gives_no_clipboard(page: Page, app: App):
    """As on plain HTTP in a laboratory."""
    clipboard(page, app)
    page.evaluate(
        """() => {
          window.kept = navigator.clipboard;
          Object.defineProperty(navigator, "clipboard", { value: undefined });
        }"""
    )
    page.get_by_test_id("copy-k-matrix").click()
    page.get_by_test_id("copy-K-Text").click()
    expect(page.get_by_test_id("copied")).to_have_text("K copied as Text.")
    expect(page.get_by_test_id("copy-K-Text")).to_be_focused()
    text = page.evaluate("() => window.kept.readText()")
    assert [float(v) for v in text.split("\n")[1].split()] == state(page)["K"][0]


def test_formulas_are_copied(page: Page, app: App):
    clipboard(page, app)
    view(page, "derivation")
    page.get_by_test_id("formulas").locator("math").first.wait_for()
    names: dict = {}
    exec(copied(page, "formula-RGA", "RGA-Python"), names)
    assert names["RGA"].shape == (2, 2)
    assert copied(page, "formula-k_11", "k_11-LaTeX").startswith("k_{11} = ")


def test_the_copy_menu_works_by_keyboard(page: Page, app: App):
    clipboard(page, app)
    page.get_by_test_id("copy-k-matrix").focus()
    page.keyboard.press("Enter")
    expect(page.get_by_test_id("copy-K-LaTeX")).to_be_focused()
    page.keyboard.press("ArrowDown")
    page.keyboard.press("ArrowRight")
    expect(page.get_by_test_id("copy-RGA-Python")).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.get_by_test_id("copied")).to_have_text("RGA copied as Python.")
    page.keyboard.press("Escape")
    expect(page.get_by_test_id("copy-k-matrix")).to_be_focused()


def saved(page: Page, signal: str, kind: str) -> Path:
    page.get_by_test_id(f"save-{signal}").click()
    with page.expect_download() as download:
        page.get_by_test_id(f"save-{signal}-{kind}").click()
    page.keyboard.press("Escape")
    return Path(download.value.path())


def test_plots_are_saved_as_numbers_with_units(page: Page, app: App):
    scenario = {"duration": 3.0, "samples": 501, "rtol": 1e-5}
    body = {"scenario": scenario, "each_axis": True}
    reply = page.request.post(app.url + "api/v1/evaluate", data=body).json()
    for signal, unit, factor in (("theta", "deg", 180 / np.pi), ("V_y", "V", 1.0)):
        text = saved(page, signal, "CSV").read_text(encoding="utf-8")
        head, *rows = list(csv.reader(io.StringIO(text)))
        assert head[:2] == ["t [s]", f"{signal}, pitch step [{unit}]"]
        assert f"{signal}, yaw step, linear [{unit}]" in head
        table = np.array(rows, dtype=float)
        step = reply["axis_steps"]["theta"]["nonlinear"]
        np.testing.assert_allclose(table[:, 0], step["t"], atol=1e-6)
        np.testing.assert_allclose(table[:, 1], np.array(step[signal]) * factor, atol=1e-4)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_plots_picture_is_on_white_in_both_themes(page: Page, scheme: str):
    page.emulate_media(color_scheme=scheme)  # pyright: ignore[reportArgumentType]
    data = saved(page, "V_p", "PNG").read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = (int.from_bytes(data[i : i + 4], "big") for i in (16, 20))
    assert width == 1600 and height >= 900
    corner, colours = page.evaluate(
        """async (bytes) => {
          const bitmap = await createImageBitmap(new Blob([new Uint8Array(bytes)], { type: "image/png" }));
          const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
          context.drawImage(bitmap, 0, 0);
          const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
          const seen = new Set();
          for (let i = 0; i < data.length; i += 4) seen.add(`${data[i]},${data[i + 1]},${data[i + 2]}`);
          return [[...data.slice(0, 4)], [...seen]];
        }""",
        list(data),
    )
    assert corner == [255, 255, 255, 255]
    assert {"185,74,44", "36,104,155", "179,38,30"} <= set(colours)  # pitch, yaw, the limit


def test_the_cursor_is_shared_and_tells_time_and_values(page: Page, app: App):
    body = {"scenario": {"samples": 501, "rtol": 1e-5}, "each_axis": True}
    step = page.request.post(app.url + "api/v1/evaluate", data=body).json()["axis_steps"]["theta"][
        "nonlinear"
    ]
    box = page.locator("[data-testid=plot-V_y] .u-over").bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + box["width"] / 3, box["y"] + 20)
    time = page.get_by_test_id("plot-time")
    expect(time).to_have_text("at 1.00 s, both steps in 3D")
    i = min(range(501), key=lambda k: abs(step["t"][k] - 1.0))
    for signal, unit, factor in (("theta", "°", 180 / np.pi), ("V_y", " V", 1)):
        shown = page.locator(f"[data-testid=plot-{signal}] .at.pitch").inner_text().replace("−", "-")
        assert shown.endswith(unit)
        assert float(shown.removesuffix(unit)) == pytest.approx(step[signal][i] * factor, abs=0.1)


def test_zoom_by_mouse_and_by_keyboard(page: Page):
    box = page.locator("[data-testid=plot-theta] .u-over").bounding_box()
    assert box is not None
    unzoom = page.get_by_test_id("unzoom")
    page.mouse.move(box["x"] + 20, box["y"] + 20)
    page.mouse.down()
    page.mouse.move(box["x"] + 120, box["y"] + 20, steps=4)
    page.mouse.up()
    expect(unzoom).to_be_visible()
    unzoom.click()
    expect(unzoom).to_be_hidden()
    page.locator("[data-testid=plot-psi] .plot-body").focus()
    page.keyboard.press("+")
    expect(unzoom).to_be_visible()
    page.keyboard.press("Escape")
    expect(unzoom).to_be_hidden()


def test_a_plots_drawing_is_its_picture(page: Page):
    """The SVG, drawn by the browser, beside the picture of the same plot."""
    picture, drawing = saved(page, "V_p", "PNG").read_bytes(), saved(page, "V_p", "SVG").read_text("utf-8")
    for text in ("<script", "href=", "url(http"):
        assert text not in drawing
    page.context.clear_cookies()
    blank = page.context.new_page()  # whose policy lets pictures in
    found = blank.evaluate(
        """async ([bytes, text]) => {
          const height = new DataView(new Uint8Array(bytes).buffer).getUint32(20);
          const drawn = async (source) => {
            const image = new Image();
            image.src = source;
            await image.decode();
            const context = new OffscreenCanvas(1600, height).getContext("2d");
            context.drawImage(image, 0, 0, 1600, height);
            return context.getImageData(0, 0, 1600, height).data;
          };
          const png = await drawn("data:image/png;base64," + btoa(String.fromCharCode(...bytes)));
          const svg = await drawn("data:image/svg+xml," + encodeURIComponent(text));
          const colours = [[185, 74, 44], [36, 104, 155], [179, 38, 30]];
          return colours.map((colour) => {
            const is = (data, i) => colour.every((part, k) => Math.abs(data[i + k] - part) < 40);
            let [all, both] = [0, 0];
            for (let i = 0; i < png.length; i += 4)
              if (is(png, i)) {
                all += 1;
                both += is(svg, i);
              }
            return [all, both];
          });
        }""",
        [list(picture), drawing],
    )
    blank.close()
    for all_of_them, both in found:  # pitch, yaw, the limit
        assert all_of_them > 1000 and both > 0.8 * all_of_them, found


def test_all_plots_are_saved_as_one_drawing(page: Page):
    page.get_by_test_id("save-theta").click()
    with page.expect_download() as download:
        page.get_by_test_id("save-all-SVG").click()
    assert download.value.suggested_filename == "heli2dof-plots.svg"
    drawing = Path(download.value.path()).read_text("utf-8")
    for title in ("Pitch", "Yaw", "Pitch motor", "Yaw motor"):
        assert f"<title>{title}" in drawing, title


def test_numbers_are_copied_with_four_digits_where_that_is_chosen(page: Page, app: App):
    clipboard(page, app)
    page.get_by_test_id("copy-k-matrix").click()
    page.get_by_test_id("copy-digits-4").check()
    page.get_by_test_id("copy-K-MATLAB").click()
    expect(page.get_by_test_id("copied")).to_have_text("K copied as MATLAB.")
    text = page.evaluate("() => navigator.clipboard.readText()")
    assert "rounded to 4 digits" in text and "51.17," in text
    page.reload()
    page.get_by_test_id("copy-k-matrix").click()
    expect(page.get_by_test_id("copy-digits-4")).to_be_checked()
    page.get_by_test_id("copy-digits-all").check()
    page.get_by_test_id("copy-K-MATLAB").click()
    expect(page.get_by_test_id("copied")).to_have_text("K copied as MATLAB.")
    assert "rounded" not in page.evaluate("() => navigator.clipboard.readText()")
