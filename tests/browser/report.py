#!/usr/bin/env python3
"""Looks at reports in a headless Chromium: drawn, hovered, toggled, zoomed, printed; no name becomes a script.

report.py PROGRAM SOURCE: with the command, and the folder of the sources. Ends with 77 where there is no Chromium.
"""

from __future__ import annotations

import base64
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable

from devtools import Browser

SKIPPED = 77
CHROMIUM = ("chromium", "chromium-browser", "google-chrome")
LARGEST_REPORT = 600_000  # bytes, of the paper's curves, peaks and optimum
MOST_MS = {"first draw": 200, "pointer to value at 50 000 points": 16}
PATIENCE = 5  # times as much where other programs work, too

# Of the first curve of a figure: the place of a point in the middle of its first part, in the window.
PLACE = """(() => {
  const figure = document.querySelectorAll("figure.curve")[%d];
  figure.scrollIntoView({block: "center"});
  const path = figure.querySelector("path.line"), at = path.getPointAtLength(path.getTotalLength() * 0.4);
  const shown = at.matrixTransform(path.getScreenCTM());
  return [shown.x, shown.y];
})()"""

TINY = {
    "format": "arcslip-scene-2",
    "structure": {"dofs": ["a"], "masses": [{"name": "m", "at": "a", "value": 1}],
                  "springs": [{"name": "k", "at": "a", "value": 4000}],
                  "dampers": [{"name": "c", "at": "a", "value": 1}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "a", "stiffness": 1000, "friction_coefficient": 0.5,
                  "normal_load": 3}],
    "excitation": [{"name": "f", "at": "a", "cosine": 5}], "harmonics": {"order": 3}, "response": {"at": "a"},
    "studies": [{"name": "one", "kind": "frf", "from": 5, "to": 16}],
}


def hostile_names() -> list[str]:
    """Return a hundred texts that try to become markup or script, from what the tests of the library have."""
    cores = ["</script><script>alert(1)</script>", "<img src=x onerror=alert(1)>", '" onmouseover="alert(1)',
             "' onmouseover='alert(1)", "</style><style>*{display:none}", "</title><body onload=alert(1)>",
             "<!--<script>", "--></script>", "]]><svg/onload=alert(1)>", "javascript:alert(1)",
             "&lt;script&gt;alert(1)&lt;/script&gt;", "&#60;img src=x onerror=alert(1)&#62;",
             "</td></tr></table><iframe src=//x>", "\\u003cscript\\u003e", '\\"><script>', "`${alert(1)}`",
             "a\u2028alert(1)\u2029", "\u202egnp.exe", '<a href="data:text/html,x">',
             "{{constructor.constructor('alert(1)')()}}"]
    return [before + core for core in cores for before in ("", "x", '"', "'>", "</text></svg>")]


class Looking:
    """What is looked at, with the command, a browser and a folder for pages."""

    def __init__(self, program: str, source: str, browser: Browser, folder: str) -> None:
        self.program, self.source, self.browser, self.folder = program, source, browser, folder
        self.problems: list[str] = []

    def check(self, holds: bool, what: str) -> None:
        """Record what does not hold."""
        if not holds:
            self.problems.append(what)

    def page_of(self, scene: str, *more: str) -> str:
        """Return the path of the report of a scene."""
        out = os.path.join(self.folder, "out")
        subprocess.run([self.program, "run", scene, "--out", out, "--figures", "none", "--quiet", *more], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return os.path.join(out, "report.html")

    def count(self, selector: str) -> int:
        """Return how many elements there are."""
        return self.browser.value(f"document.querySelectorAll({json.dumps(selector)}).length")

    def within(self, what: str, milliseconds: float) -> None:
        """Print a time, and record one that is far too long."""
        print(f"{what}: {milliseconds:.1f} ms, wanted {MOST_MS[what]} ms")
        self.check(milliseconds < PATIENCE * MOST_MS[what], f"{what} takes {milliseconds:.0f} ms")


def look_at_paper(look: Looking) -> None:
    """Draw, hover, choose, toggle, zoom, sort and print the report of the paper's oscillator."""
    page = look.page_of(os.path.join(look.source, "examples/al_sayed_2011/scene.json"))
    size = os.path.getsize(page)
    print(f"report: {size / 1000:.0f} kB, wanted {LARGEST_REPORT / 1000:.0f} kB")
    look.check(size <= LARGEST_REPORT, f"the report has {size} bytes")
    browser = look.browser
    browser.open(page)
    if browser.value("typeof d3") == "undefined":
        print("the command was built without D3: curves are plain")
        look.check(look.count("svg.plain") > 0, "there are no plain curves")
        return
    look.within("first draw", browser.value(
        "(e => e.loadEventEnd - e.responseEnd)(performance.getEntriesByType('navigation')[0])"))
    look.check(look.count("figure.curve") > 5 and look.count("svg.live") == look.count("figure.curve"),
               "not every figure is drawn")
    look.check(look.count("svg.plain") == 0, "plain curves are left")

    browser.move(*browser.value(PLACE % 0))
    values = browser.value("document.querySelector('.values:not([hidden])')?.innerText || ''")
    look.check("frequency (Hz)" in values and "amplitude (mm)" in values, f"the pointer shows {values!r}")
    browser.click(*browser.value(PLACE % 0))
    look.check(look.count(".motions figure.motion") == 2, "a click shows no motion and loop")
    loop = browser.value("document.querySelectorAll('.motions svg')[1].textContent")
    look.check("displacement (mm)" in loop and "force (mN)" in loop, f"the axes of the loop are {loop!r}")
    browser.value("document.querySelector('.motions button').click()")
    look.check(look.count(".motions") == 0, "the motion is not hidden")
    browser.value("document.querySelector('svg.live').focus()")
    for name in ("ArrowDown", "ArrowRight", "Enter"):
        browser.key(name, "\r" if name == "Enter" else "")
    look.check(look.count(".motions figure.motion") == 2, "Enter shows no motion")

    shown = "[...document.querySelectorAll('svg.live')[0].querySelectorAll('path.line')]" \
            ".filter(path => path.getAttribute('display') !== 'none').length"
    before = browser.value(shown)
    browser.value("document.querySelector('.key li button').click()")
    look.check(browser.value(shown) < before, "a button of the key hides no curve")
    browser.value("document.querySelector('.key li button').click()")
    look.check(browser.value(shown) == before, "a button of the key shows no curve")

    ticks = "[...document.querySelectorAll('svg.live')[0].querySelectorAll('.tick text')].map(t => t.textContent).join()"
    before = browser.value(ticks)
    browser.value("document.querySelector('.tools button').click()")
    look.check(browser.value(ticks) != before, "a zoom leaves the axes as they are")
    browser.value("document.querySelectorAll('.tools button')[2].click()")
    look.check(browser.value(ticks) == before, "there is no way back from a zoom")

    table = "document.querySelector('section.study table.sortable')"
    at = browser.value(f"[...{table}.tHead.rows[0].cells].findIndex(cell => cell.textContent.startsWith('frequency'))")
    browser.value(f"{table}.tHead.rows[0].cells[{at}].querySelector('button').click()")
    order = browser.value(f"[...{table}.tBodies[0].rows].map(row => Number(row.cells[{at}].textContent))")
    look.check(len(order) > 5 and order == sorted(order), f"a table is not sorted: {order}")

    pdf = base64.b64decode(browser.call("Page.printToPDF", printBackground=True)["data"])
    look.check(pdf.startswith(b"%PDF") and len(re.findall(rb"/Type\s*/Page\b", pdf)) >= 4,
               "studies are not printed on pages of their own")


def look_at_many_points(look: Looking) -> None:
    """Measure the pointer over a page whose curves have fifty thousand points."""
    page = os.path.join(look.folder, "out", "report.html")
    with open(page, encoding="utf-8") as file:
        text = file.read()
    begin = text.index('id="data">') + len('id="data">')
    end = text.index("</script>", begin)
    data = json.loads(text[begin:end])
    lines = data["studies"][0][0]["lines"]
    points = sum(len(part["columns"][0]) for line in lines for part in line["parts"])
    lines *= -(-50_000 // points)
    large = os.path.join(look.folder, "large.html")
    with open(large, "w", encoding="utf-8") as file:
        file.write(text[:begin] + json.dumps(data).replace("<", "\\u003c") + text[end:])
    look.browser.open(large)
    if look.browser.value("typeof d3") == "undefined":
        return
    look.within("pointer to value at 50 000 points", look.browser.value("""(() => {
      const svg = document.querySelector("svg.live"), box = svg.getBoundingClientRect();
      const times = [];
      for (let i = 0; i < 40; ++i) {
        const begin = performance.now();
        svg.dispatchEvent(new PointerEvent("pointermove",
          {clientX: box.left + box.width * (0.2 + 0.015 * i), clientY: box.top + box.height * 0.6}));
        times.push(performance.now() - begin);
      }
      return times.sort((a, b) => a - b)[20];
    })()"""))


def look_at_hostile_names(look: Looking) -> None:
    """Open pages whose titles and names try to become markup or script."""
    path = os.path.join(look.folder, "hostile.json")
    shape = "JSON.stringify([...document.querySelectorAll('*')].map(each => each.localName).filter(" \
            "name => ['script', 'iframe', 'img', 'body', 'style', 'a'].includes(name)))"
    harmless = None
    for name in ["harmless", *hostile_names()]:
        scene = json.loads(json.dumps(TINY))
        scene["title"] = name
        named = json.loads(json.dumps(scene))
        named["elements"][0]["name"] = name
        for each in (named, scene):  # a name that the format refuses: a title alone
            with open(path, "w", encoding="utf-8") as file:
                json.dump(each, file)
            try:
                page = look.page_of(path)
                break
            except subprocess.CalledProcessError:
                pass
        look.browser.open(page)
        look.browser.value("document.querySelectorAll('*').forEach(each => each.dispatchEvent(new Event('mouseover')))")
        found = look.browser.value(shape)
        harmless = harmless or found
        look.check(found == harmless, f"the name {name!r} changes the elements of the page")


def main() -> int:
    """Look at all, and return the exit code."""
    program, source = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    chromium = next((path for path in map(shutil.which, CHROMIUM) if path), None)
    if chromium is None:
        print("skipped: Chromium is not there (Debian package chromium)")
        return SKIPPED
    looks: list[Callable[[Looking], None]] = [look_at_paper, look_at_many_points, look_at_hostile_names]
    with tempfile.TemporaryDirectory() as folder:
        browser = Browser(chromium)
        try:
            look = Looking(program, source, browser, folder)
            for each in looks:
                each(look)
                look.problems += [f"{each.__name__}: the page says {error}" for error in browser.errors]
                browser.errors.clear()
        finally:
            browser.close()
    for problem in look.problems:
        print(f"wrong: {problem}")
    return 1 if look.problems else 0


if __name__ == "__main__":
    sys.exit(main())
