"""Opens pages in Chromium, as their readers see them, and prints what is wrong with them.

`python pages.py CHROMIUM AXE FOLDER PAGE…`: the pages, from the folder, at two widths, light and dark.
Looked for are pages wider than the window, clipped text, text outside its picture, errors of scripts,
addresses of other hosts, links that lead nowhere, and violations of accessibility that axe calls serious
or critical. The last line has the counts.
"""

import functools
import http.server
import sys
import threading
from concurrent.futures import ProcessPoolExecutor
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from playwright.sync_api import sync_playwright

VIEWS = [(400, "light"), (400, "dark"), (1280, "light"), (1280, "dark")]
#: Where axe looks too: once at each width, once in each theme. It takes longer than all else together.
AXE_VIEWS = [(400, "light"), (1280, "dark")]
#: Impacts that fail.
IMPACTS = ("serious", "critical")

#: What is cut off on a page as it is shown.
CLIPPED = """() => {
  const found = [];
  const root = document.documentElement;
  if (root.scrollWidth > root.clientWidth + 1) {
    let widest = null, right = root.clientWidth + 1;
    for (const one of document.body.querySelectorAll('*')) {
      const box = one.getBoundingClientRect();
      if (box.right > right && box.width > 0) { right = box.right; widest = one; }
    }
    found.push(`wider than the window, ${root.scrollWidth} px: ${describe(widest)}`);
  }
  for (const one of document.body.querySelectorAll('*')) {
    if (one.closest('svg') || !one.textContent.trim()) continue;
    const style = getComputedStyle(one);
    const hides = ['hidden', 'clip'].includes(style.overflowX);
    if (!hides || style.visibility !== 'visible' || one.clientWidth < 4 || one.clientHeight < 4) continue;
    if (one.scrollWidth > one.clientWidth + 1) found.push(`clipped text: ${describe(one)}`);
  }
  for (const picture of document.querySelectorAll('svg')) {
    const frame = picture.getBoundingClientRect();
    if (!frame.width || getComputedStyle(picture).overflow === 'visible') continue;
    for (const text of picture.querySelectorAll('text')) {
      const box = text.getBoundingClientRect();
      if (!box.width) continue;
      const out = Math.max(frame.left - box.left, box.right - frame.right, frame.top - box.top, box.bottom - frame.bottom);
      if (out > 1.5) found.push(`text outside its picture by ${out.toFixed(0)} px: ${describe(text)}`);
    }
  }
  return found;
  function describe(one) {
    if (!one) return '?';
    const name = typeof one.className === 'string' ? one.className : one.className.baseVal;
    const text = one.textContent.trim().replace(/\\s+/g, ' ').slice(0, 50);
    return `<${one.tagName.toLowerCase()} class="${name}"> "${text}"`;
  }
}"""

#: What axe finds, with the first of the elements.
AXE = """async (impacts) => {
  const result = await axe.run(document, { resultTypes: ['violations'] });
  return result.violations.filter(one => impacts.includes(one.impact)).map(one =>
    `${one.id} (${one.impact}), ${one.nodes.length} times: ${one.nodes[0].target.join(' ')}`
    + (one.nodes[0].any[0] ? `: ${one.nodes[0].any[0].message}` : ''));
}"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *arguments):
        pass


def serve(folder):
    """An address below which the folder is."""
    server = http.server.ThreadingHTTPServer(("localhost", 0), functools.partial(Quiet, directory=folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return f"http://localhost:{server.server_port}"


def looked_at(chromium, axe, folder, width, theme, pages):
    """The flaws of each page at a width and in a theme, after which it is named."""
    script = Path(axe).read_text(encoding="utf-8")
    address = serve(folder)
    found = {}
    with sync_playwright() as playwright:
        # Without a sandbox it also runs as root, as in a container; it shows our own files only.
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=theme)
        for name in pages:
            page = context.new_page()
            flaws = []
            page.on("pageerror", lambda error, to=flaws: to.append(f"error of a script: {error}"))
            page.on("requestfailed", lambda request, to=flaws: to.append(f"does not load {request.url}"))
            page.on(
                "request",
                lambda request, to=flaws: request.url.startswith((address, "data:", "blob:"))
                or to.append(f"asks another host: {request.url}"),
            )
            answer = page.goto(f"{address}/{name}", wait_until="load")
            if not answer.ok:
                flaws.append(f"is not there: {answer.status}")
            flaws += page.evaluate(CLIPPED)
            if (width, theme) in AXE_VIEWS:
                page.evaluate(script)
                flaws += page.evaluate(AXE, list(IMPACTS))
            found[name] = flaws
            page.close()
        browser.close()
    return width, theme, found


class Links(HTMLParser):
    """Where a page leads, and where it can be entered."""

    def __init__(self, text):
        super().__init__()
        self.targets, self.anchors = set(), set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.anchors |= {attributes[key] for key in ("id", "name") if attributes.get(key)}
        target = attributes.get("href") if tag in ("a", "link") else attributes.get("src")
        if target:
            self.targets.add(target)


def broken_links(folder):
    """Links of all pages of a folder that lead nowhere in it."""
    root = Path(folder).resolve()
    files = [path for path in sorted(root.rglob("*.html")) if "_static" not in path.parts]
    pages = {path: Links(path.read_text(encoding="utf-8")) for path in files}
    for path, links in pages.items():
        for target in sorted(links.targets):
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                continue
            other = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not other.exists():
                yield path.relative_to(root), f"the link {target} leads to no file"
            elif parts.fragment and other in pages and unquote(parts.fragment) not in pages[other].anchors:
                yield path.relative_to(root), f"the link {target} leads to no place of that page"


def main(chromium, axe, folder, *pages):
    passed = failed = 0
    with ProcessPoolExecutor(2) as pool:
        running = [pool.submit(looked_at, chromium, axe, folder, *view, pages) for view in VIEWS]
        for width, theme, found in (one.result() for one in running):
            for name, flaws in found.items():
                for flaw in dict.fromkeys(flaws):
                    print(f"{name} at {width} px, {theme}: {flaw}")
                passed, failed = passed + (not flaws), failed + bool(flaws)
    broken = list(broken_links(folder))
    for name, flaw in broken:
        print(f"{name}: {flaw}")
    passed, failed = passed + (not broken), failed + bool(broken)
    print(f"{passed} passed, {failed} failed")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
