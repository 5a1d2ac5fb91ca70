#!/usr/bin/env python3
"""Makes the pictures of docs/view.md: the workbench on the sample sheet, in a headless Chromium.

usage: PYTHONPATH=build/PRESET/python build/venv/bin/python tools/pictures/view.py     from the project's root
Needs Bokeh and Playwright (tools/check/setup.sh) and Debian's chromium; writes docs/images/view_*.png."""

import pathlib
import shutil
import sys

from PIL import Image
from playwright.sync_api import sync_playwright

import tabor as tb
from tabor.view.page import Opened
from tabor.view.server import View
from tabor.view.state import State

ROOT = pathlib.Path(__file__).resolve().parents[2]
IMAGES = ROOT / "docs" / "images"
COLOURS = 128  # of a picture, which then takes a third of the room
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


def keep(page, name, height):
    """Writes the top of the page."""
    page.set_viewport_size({"width": 1280, "height": height})
    page.evaluate("document.scrollingElement.scrollTo(0, 0)")
    page.wait_for_timeout(300)
    file = IMAGES / f"view_{name}.png"
    page.screenshot(path=file)
    Image.open(file).convert("RGB").quantize(COLOURS).save(file, optimize=True)
    print(file.relative_to(ROOT), file.stat().st_size // 1000, "kB")


def walk(page):
    """The two minutes of docs/view.md."""
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
    control(page, "trapped", "input").check()
    page.get_by_text("pressure", exact=True).click()
    page.locator(".bk-tab", has_text="Python").click()
    settled(page)
    keep(page, "elsewhere", 1560)


def main():
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    if chromium is None:
        sys.exit("pictures: no chromium; apt install chromium")
    scan = "surfaces/edt_before.x3p"
    view = View([Opened(tb.read(ROOT / scan), State(scan))])
    try:
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
            page = browser.new_page(viewport={"width": 1280, "height": 720})
            page.set_default_timeout(120_000)
            page.goto(view.url)
            walk(page)
            browser.close()
    finally:
        view.close()


if __name__ == "__main__":
    main()
