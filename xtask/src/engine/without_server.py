"""Uses the page without a server in Chromium, as readers of the site do, and prints what is wrong with it.

`python without_server.py CHROMIUM AXE PROGRAM SITE`: serves the folder SITE as files, and compares what its page
`console/` shows with what PROGRAM prints for the command under the answer. Times are printed, and none is asked
for. The last line has the counts.
"""

import json
import subprocess
import sys
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread

from console import AXE, IMPACTS, SIZES, THEMES, Looks, four, numbers_differ, opened, settled, shown, unreached
from playwright.sync_api import sync_playwright

VIEWS = ("heading", "wheel")

#: Counts what the page shows of its progress, and measures how long an answer takes: a number changes, samples
#: are counted, and the band is there.
WATCH = """() => {
  const seen = window.seen = { start: performance.now(), progress: [] };
  const article = document.querySelector('article'), begun = document.querySelector('#begun');
  const look = () => {
    const caption = article.querySelector('caption')?.textContent ?? '';
    const time = performance.now() - seen.start;
    if (caption !== seen.caption) (seen.captions ??= []).push([caption, time]);
    seen.caption = caption;
    if (!begun.hidden) seen.progress.push(begun.textContent.trim());
  };
  seen.caption = article.querySelector('caption')?.textContent ?? '';
  new MutationObserver(look).observe(document.body, { subtree: true, childList: true, attributes: true, characterData: true });
}"""


class Silent(SimpleHTTPRequestHandler):
    """Files, without a line for each."""

    def log_message(self, *_):
        pass


class Files(ThreadingHTTPServer):
    """A server of files, which is silent where a page goes away early."""

    def handle_error(self, *_):
        pass


class Site:
    """The site as files, and the program that commands are compared with."""

    def __init__(self, program, folder):
        self.program = program
        self.server = Files(("127.0.0.1", 0), partial(Silent, directory=folder))
        self.address = f"http://127.0.0.1:{self.server.server_port}/console/"

    def __enter__(self):
        Thread(target=self.server.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *_):
        self.server.shutdown()

    def run(self, command):
        """What the program prints for a command of the page, as JSON."""
        words = command.replace("grouser ", f"'{self.program}' ", 1) + " --format json"
        return json.loads(subprocess.run(words, shell=True, capture_output=True, text=True, check=True).stdout)


def look(looks, browser, axe, site):
    """Looks at each view at two sizes, light and dark."""
    for view in VIEWS:
        for size in SIZES:
            for theme in THEMES:
                page, flaws = opened(browser, site, f"view={view}", size, theme, bypass=True)
                if page.evaluate("document.documentElement.scrollWidth > innerWidth"):
                    flaws.append("is wider than the window")
                page.evaluate(axe)
                flaws += page.evaluate(AXE, list(IMPACTS))
                looks.claim(f"the view {view} at {size[0]} pixels, {theme}", flaws)
                page.context.close()


def use_heading(looks, browser, site):
    page, flaws = opened(browser, site)
    looks.claim("the heading has the program's numbers", numbers_differ(page, site))
    views = page.locator("nav button:visible").all_inner_texts()
    looks.claim("views that need the program are not there", [] if views == ["Heading and card", "Wheel"] else [f"there are {views}"])
    words = page.locator("#remark").inner_text()
    looks.claim("a sentence says how to start the program", [] if "grouser serve" in words else [words])
    before = shown(page, "slip_ratio")
    page.evaluate(WATCH)
    page.get_by_role("slider", name="Slope").focus()
    page.evaluate("window.seen.start = performance.now()")
    page.keyboard.press("ArrowRight")
    settled(page)
    seen = page.evaluate("window.seen")
    moved = [] if shown(page, "slip_ratio") != before else ["it stays"]
    looks.claim("a slider moves the number to the program's", moved + numbers_differ(page, site))
    looks.claim("samples are counted on the way", [] if seen["progress"] else ["nothing is counted"])
    for caption, time in seen["captions"]:
        print(f"{caption}: after {time:.0f} ms")
    counted = list(dict.fromkeys(seen["progress"]))
    print(f"shown on the way: {len(counted)} counts, from {counted[0]} to {counted[-1]}" if counted else "nothing was shown on the way")
    page.keyboard.down("ArrowRight")
    page.wait_for_timeout(1500)
    page.keyboard.up("ArrowRight")
    settled(page)
    looks.claim("a slider that moves on ends with the program's numbers", numbers_differ(page, site))
    page.get_by_role("slider", name="Course").focus()
    page.keyboard.press("PageUp")
    settled(page)
    row = site.run(page.locator("#command").inner_text())["rows"][0]
    wrong = [f"{name} is {shown(page, name)}, the program has {row[name]}" for name in ("slip_ratio_p2_5", "sinkage_mm_p97_5") if shown(page, name) != four(row[name])]
    looks.claim("a course has the program's numbers", wrong)
    looks.claim("the keyboard reaches everything about a heading", unreached(page))
    looks.claim("nothing goes wrong with the heading", flaws)
    page.context.close()


def use_wheel(looks, browser, site):
    page, flaws = opened(browser, site, "view=wheel")
    slip = page.get_by_role("slider", name="Slip ratio")
    slip.focus()
    slip.press("ArrowRight")
    settled(page)
    at = float(slip.input_value())
    rows = site.run(page.locator("#command").inner_text())["rows"]
    row = next(row for row in rows if row["slip_ratio"] == at)
    cells = page.locator("td[data-column='drawbar_pull_n'] ~ td").all_inner_texts()
    expected = [four(row[f"drawbar_pull_n_{end}"]) for end in ("p2_5", "p97_5")]
    looks.claim("a wheel has the program's band", [] if cells == expected else [f"it is {cells}, the program has {expected}"])
    drawn = page.locator("figure img").count()
    looks.claim("the wheel is drawn", [] if drawn else ["there is no drawing"])
    page.get_by_label("Load on the wheel", exact=True).fill("-5")
    page.wait_for_timeout(400)
    said = page.locator(".slider .error").all_inner_texts()
    looks.claim("the engine refuses in its words", [] if any("must be from" in one for one in said) else [f"it says {said}"])
    looks.claim("the keyboard reaches everything about a wheel", unreached(page))
    looks.claim("nothing goes wrong with the wheel", flaws)
    page.context.close()


def embedded(looks, browser, site):
    """Looks at the guide that has the page in it, if the site was built."""
    page, flaws = opened_guide(browser, site)
    if page is None:
        return
    inside = page.frame_locator("iframe").locator(".verdict").first
    inside.wait_for(timeout=60000)
    looks.claim("the guide has the page in it", flaws)
    page.context.close()


def opened_guide(browser, site):
    page = browser.new_context(viewport={"width": SIZES[0][0], "height": SIZES[0][1]}).new_page()
    flaws = []
    page.on("pageerror", lambda error: flaws.append(f"error of a script: {error}"))
    answer = page.goto(site.address.replace("console/", "guide/try.html"))
    if answer.ok:
        return page, flaws
    print("the guide is not looked at, since the site was not built")
    page.context.close()
    return None, flaws


def main(chromium, axe, program, folder):
    looks = Looks()
    with open(axe, encoding="utf-8") as file:
        script = file.read()
    with sync_playwright() as driver, Site(program, folder) as site:
        browser = driver.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        use_heading(looks, browser, site)
        use_wheel(looks, browser, site)
        look(looks, browser, script, site)
        embedded(looks, browser, site)
        browser.close()
    print(f"{looks.passed} passed, {looks.failed} failed")
    return int(looks.failed > 0)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
