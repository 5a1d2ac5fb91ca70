#!/usr/bin/env python3
"""Makes the pictures of docs/view.md: the workbench on the sample sheet, in a headless Chromium.

usage: PYTHONPATH=build/PRESET/python build/venv/bin/python tools/pictures/view.py     from the project's root
Needs Bokeh, plotly and Playwright (tools/check/setup.sh) and Debian's chromium; writes docs/images/view_*.png."""

import pathlib
import shutil
import sys

import numpy as np
from PIL import Image
from playwright.sync_api import sync_playwright

import tabor as tb
from tabor.view.opening import Opened
from tabor.view.server import View
from tabor.view.state import State, Step

ROOT = pathlib.Path(__file__).resolve().parents[2]
IMAGES = ROOT / "docs" / "images"
COLOURS = 256  # of a picture, which then takes half of the room
NAMED = """(name) => { let found = false
    const walk = (one) => { if (one.model.name == name) { one.el.setAttribute("data-control", name); found = true }
        for (const child of one.child_views ?? []) walk(child) }
    for (const view of Object.values(Bokeh.index)) walk(view)
    return found }"""


def control(page, name, kind):
    """The element of a control, once it is there."""
    page.wait_for_function(NAMED, arg=name)
    return page.locator(f"[data-control='{name}'] {kind}").first


def settled(page):
    """Waits until the full answer and the roughness parameters are shown."""
    page.wait_for_selector("[data-name=whole]")
    page.wait_for_selector("[data-name=idle]", state="attached")
    page.wait_for_selector("[data-name=Sdq]")
    page.wait_for_timeout(700)  # ms: what is drawn follows


def keep(page, name, height, top=0):
    """Writes a part of the page, `height` pixels from `top`."""
    page.set_viewport_size({"width": 1280, "height": top + height})
    page.evaluate("document.scrollingElement.scrollTo(0, 0)")
    page.wait_for_timeout(300)
    file = IMAGES / f"view_{name}.png"
    page.screenshot(path=file, clip={"x": 0, "y": top, "width": 1280, "height": height})
    Image.open(file).convert("RGB").quantize(COLOURS, Image.Quantize.FASTOCTREE).save(file, optimize=True)
    print(file.relative_to(ROOT), file.stat().st_size // 1000, "kB")


def tab(page, title):
    """Looks at what stands under this title."""
    page.locator(".bk-tab:visible", has_text=title).first.click()


def walk(page):
    """The two minutes of docs/view.md, with one scan."""
    settled(page)
    keep(page, "loaded", 720)
    control(page, "recipe", "select").select_option("sheet")
    settled(page)
    field = control(page, "pressure_field", "input")
    field.fill("12 MPa")
    field.press("Enter")
    settled(page)
    control(page, "draw", "button").click()
    page.wait_for_selector("[data-name=busy]")
    settled(page)
    keep(page, "moved", 1240)
    control(page, "add", "select").select_option("lowpass=gauss:8um")
    page.wait_for_function("Bokeh.documents[0].get_model_by_name('spectrum_source').data.density.length > 0")
    page.wait_for_timeout(5000)  # ms: the spectrum before the filter may come first
    settled(page)
    keep(page, "filtered", 1000)
    control(page, "undo", "button").click()
    page.get_by_text("3-D", exact=True).click()
    settled(page)
    page.frame_locator("iframe").locator("canvas").first.wait_for()
    page.wait_for_timeout(3000)  # ms: a software renderer draws
    keep(page, "relief", 940)
    page.get_by_text("Histogram and section", exact=True).click()
    control(page, "trapped", "input").check()
    page.get_by_text("pressure", exact=True).click()
    tab(page, "Python")
    settled(page)
    button = control(page, "write_scan", "button")
    page.evaluate("document.scrollingElement.scrollTo(0, 0)")  # a click scrolls; the box counts from what is shown
    keep(page, "elsewhere", 340, int(button.bounding_box()["y"]) - 40)


def beside(page):
    """Two scans and their difference."""
    settled(page)
    tab(page, "Side by side")
    page.wait_for_selector("[data-name=worn]:visible")
    page.wait_for_timeout(700)
    keep(page, "difference", 1000)


def worn(surface):
    """The same place after a groove was worn into it, moved by some pixels and mounted with a tilt: a scan that is made up."""
    ny, nx = surface.shape
    x = np.arange(nx) * surface.dx
    groove = 1.5e-6 * np.exp(-(((x - 0.6 * surface.lengths[0]) / 20e-6) ** 2))
    heights = np.roll(np.maximum(surface.height - groove, np.nanmin(surface.height)), (3, 8), (0, 1)) + 1e-3 * x
    heights += np.random.default_rng(1).normal(0, 10e-9, heights.shape)  # of an instrument [m]
    return tb.Surface(heights[4:, 10:], pixel=surface.pixel, name="after.x3p")


def pictures(browser, opened, walk):
    """Walks through a workbench of its own."""
    view = View(opened)
    try:
        page = browser.new_page(viewport={"width": 1280, "height": 720})
        page.set_default_timeout(120_000)
        page.goto(view.url)
        walk(page)
        page.close()
    finally:
        view.close()


def main():
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    if chromium is None:
        sys.exit("pictures: no chromium; apt install chromium")
    scan = "surfaces/edt_before.x3p"
    surface = tb.read(ROOT / scan)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox", "--enable-unsafe-swiftshader"])
        pictures(browser, [Opened(surface, State(scan))], walk)
        level = (Step("level=plane"),)
        pictures(browser, [Opened(surface, State("before.x3p", steps=level)), Opened(worn(surface), State("after.x3p", steps=level))], beside)
        browser.close()


if __name__ == "__main__":
    main()
