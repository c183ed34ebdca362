"""Steps of sliders on the page that calculates: a ten-speed, in headless Chromium.

A step is an event of a slider until numbers, pictures of the gear in sight and layout are there:
time by the clock, and of the processor in the thread of the page, which others do not disturb.
"""

import shutil
import statistics
import tempfile
from pathlib import Path
from typing import Any

from common import options, print_table
from playwright.sync_api import sync_playwright

from vstatics import load, solve
from vstatics.report import gather
from vstatics.report.asked import AskedPage
from vstatics.report.live.page import live_page

CASE = Path(__file__).parent.parent / "cases" / "ford-10r80.yaml"
CHROMIUM = shutil.which("chromium")
WARM = 20
"""Steps before those that count."""
STEP = """(n) => {
  const all = [...document.querySelectorAll(".slider")], one = all[n % all.length];
  const first = Number(one.defaultValue);
  one.value = one.step === "1" ? first + (n % 5) - 2 : first * (1 - (n % 7) / 100);
  const start = performance.now();
  one.dispatchEvent(new Event("input", { bubbles: true }));
  document.body.getBoundingClientRect();
  return performance.now() - start;
}"""


def measured(window: Any, count: int) -> list[tuple[float, float]]:
    """Of each step its time by the clock, and that of the processor [ms]."""
    session = window.context.new_cdp_session(window)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})

    def spent() -> float:
        metrics = session.send("Performance.getMetrics")["metrics"]
        return 1000 * float(next(one["value"] for one in metrics if one["name"] == "TaskDuration"))

    found = []
    for number in range(WARM + count):
        before = spent()
        clock = window.evaluate(STEP, number)
        found.append((clock, spent() - before))
    return found[WARM:]


def main() -> None:
    """Measure steps of all sliders in turn."""
    given = options(__doc__, peer=False)
    if CHROMIUM is None:
        print("There is no chromium to measure in.")
        return
    material = gather(solve(load(CASE)), has_marks=True, asked=AskedPage(prints_all=True))
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as driver:
        page = Path(folder) / "live.html"
        page.write_text(live_page(material), encoding="utf-8")
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        window = browser.new_page(viewport={"width": 1280, "height": 900})
        window.goto(page.as_uri())
        steps = measured(window, 20 if given.quick else 200)
        browser.close()
    rows = [
        (name, f"{statistics.median(times):.1f} ms", f"{max(times):.1f} ms")
        for name, times in zip(("clock", "processor"), zip(*steps, strict=True), strict=True)
    ]
    print_table(f"{len(steps)} steps of sliders, ten-speed", ("", "median", "worst"), rows)


if __name__ == "__main__":
    main()
