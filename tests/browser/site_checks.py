"""What the tests of the site share: waiting for a page, and what holds for every page."""

import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "page"))
from browser import check, test  # noqa: E402

__all__ = ["check", "fits", "quiet", "test", "until"]
SIZES = ((1366, 768), (1920, 1080), (360, 740))


def until(page, expression, what, seconds=120):
    """Waits for a JavaScript expression to hold."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if page.evaluate(expression):
            return
        time.sleep(0.1)
    check(False, f"{what}: {page.evaluate('document.body.innerText')[-600:]}")


def quiet(page, what):
    """The page complains of nothing, and asks the network for nothing."""
    check(not page.complaints, f"{what}: {page.complaints}")
    asked = [url for url in page.requests if not url.startswith(("file:", "data:", "about:", "blob:"))]
    check(not asked, f"{what} asks for {asked}")


def fits(page, what, pictures=None):
    """The page scrolls sideways at no size; `pictures` is a folder for a screenshot of each."""
    for width, height in SIZES:
        page.resize(width, height)
        wide = page.evaluate("document.documentElement.scrollWidth - window.innerWidth")
        check(wide <= 0, f"{what} is {wide} pixels too wide at {width} x {height}")
        if pictures:
            time.sleep(1)
            page.screenshot(os.path.join(pictures, f"{what}_{width}.png"))
    page.resize(*SIZES[0])
