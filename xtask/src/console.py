"""Opens the console in Chromium, as its users do, and prints what is wrong with it.

`python console.py CHROMIUM AXE PROGRAM [PICTURES]`: starts `PROGRAM serve`, and looks at each view at two
sizes, light and dark: errors of scripts, addresses of other hosts, pages wider than the window, and
violations of accessibility that axe calls serious or critical. Then it moves sliders by the keyboard and
compares the page with what the program prints for the command under the answer. With a folder for
pictures it writes one of each view. The last line has the counts.
"""

import html
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from playwright.sync_api import sync_playwright

VIEWS = ("heading", "wheel", "drive", "scene", "hand", "mission", "map", "design", "campaigns", "fit", "log")
#: The sessions that views are looked at with, where they show little by themselves.
SEEN = {
    "map": "view=map&at=10,20&from=-35,-35&to=35,35",
    "scene": "view=drive&seen=scene",
    "hand": "view=drive&mission=by+hand&soil=toyoura&seen=scene",
    "mission": "view=drive&mission=switchbacks-15-deg",
    "design": "view=design&belief=nominal",
    "campaigns": "view=campaigns&runs=2000&out=looked",
    "fit": "view=fit&soil=toyoura&belief=nominal&data=tests.csv",
    "log": "view=log&soil=toyoura&belief=nominal&log=drive.csv",
}
#: What the first look at a view has besides, which takes long, and without which there is no picture.
PICTURED = {
    "design": "&trade=energy_j_per_m,wheel_mass_kg",
    "fit": "&belief=samples&fit=soil.shear.longitudinal_m,soil.friction_angle_deg",
}
#: From where on a picture shows the page, where that is not its top.
TOPS = {"fit": "#fits"}
SIZES = [(1280, 720), (820, 1180)]
THEMES = ("light", "dark")
IMPACTS = ("serious", "critical")
#: A name that would do harm as markup.
HOSTILE = "<img src=x onerror=alert(1)>"

AXE = """async (impacts) => {
  const result = await axe.run(document, { resultTypes: ['violations'] });
  return result.violations.filter(one => impacts.includes(one.impact)).map(one =>
    `${one.id} (${one.impact}), ${one.nodes.length} times: ${one.nodes[0].target.join(' ')}`);
}"""


#: How far the arrows of a scene, as three.js loads it, are from the forces of the records of its run on a
#: plane, over the largest force: of the slope, then the yaw, the steering and the wheel's own frame.
ARROWS = r"""async ([asked, slope]) => {
  const [THREE, { GLTFLoader }] = await Promise.all([import('three'), import('three/addons/loaders/GLTFLoader.js')]);
  const reply = await fetch('/api/traverse', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(asked) });
  const [run, { scene: content }] = (await reply.text()).trim().split('\n').map((line) => JSON.parse(line));
  const bytes = Uint8Array.from(atob(content), (letter) => letter.charCodeAt(0));
  const { scene, animations: [clip] } = await new GLTFLoader().parseAsync(bytes.buffer, '');
  const mixer = new THREE.AnimationMixer(scene);
  const action = mixer.clipAction(clip).setLoop(THREE.LoopOnce, 1);
  action.clampWhenFinished = true;
  action.play();
  let [apart, largest, compared] = [0, 0, 0];
  for (const record of run.samples) {
    action.reset();
    mixer.setTime(record.time_s / clip.userData.run_seconds_per_second);
    scene.updateMatrixWorld(true);
    for (const wheel of record.wheels) {
      const arrow = scene.getObjectByName(`force_${wheel.wheel}`);
      const [tail, tip] = [0, 1].map((z) => arrow.localToWorld(new THREE.Vector3(0, 0, z)));
      const force = tip.sub(tail).multiplyScalar(clip.userData.newtons_per_metre);
      const angle = Math.PI / 180;
      const expected = new THREE.Vector3(wheel.drawbar_pull_n, wheel.side_force_n, wheel.normal_force_n)
        .applyAxisAngle(new THREE.Vector3(0, 0, 1), angle * (record.yaw_deg + (wheel.steering_deg ?? 0)))
        .applyAxisAngle(new THREE.Vector3(1, 0, 0), angle * (slope - 90));
      apart = Math.max(apart, force.distanceTo(expected));
      largest = Math.max(largest, expected.length());
      compared += 1;
    }
  }
  return [apart / largest, compared];
}"""


#: Tables that are cut off where nothing scrolls, and names of columns that stand as labels.
UNREADABLE = r"""() => [...document.querySelectorAll('#answer table')].flatMap((table) => {
  const around = table.closest('.wide, .card, figure');
  const cut = around && !around.matches('.wide') && table.getBoundingClientRect().right > around.getBoundingClientRect().right + 1.5;
  const isRaw = (cell) => /^[a-z0-9.]+_[a-z0-9_.]+$/.test(cell.innerText);
  const raw = [...table.querySelectorAll('th, td')].filter(isRaw).map((cell) => `shows the name ${cell.innerText}`);
  return [...cut ? [`cuts off ${table.caption?.innerText}`] : [], ...raw];
})"""


class Server:
    """`grouser serve` in a folder of its own, until the end of a block."""

    def __init__(self, program):
        self.program = program

    def __enter__(self):
        self.place = tempfile.TemporaryDirectory()
        sand = subprocess.run([self.program, "presets", "toyoura", "--kind", "soil"], capture_output=True, text=True, check=True)
        hostile = sand.stdout.replace('"Toyoura sand"', json.dumps(HOSTILE))
        Path(self.place.name, "hostile.toml").write_text(hostile, encoding="utf-8")
        moon = ["terrain", "moon", "--ground", "highlands", "--size-m", "100", "--seed", "3", "--out", "hills.tif"]
        subprocess.run([self.program, *moon], cwd=self.place.name, capture_output=True, check=True)
        stand = ["wheel-test", "--slip-ratio", "-0.6:0.8:0.2", "--trials", "3", "--noise-n", "0.3", "--format", "csv"]
        tests = subprocess.run([self.program, *stand], capture_output=True, text=True, check=True)
        Path(self.place.name, "tests.csv").write_text(tests.stdout, encoding="utf-8")
        drive = ["traverse", "--soil", "toyoura", "--slope-deg", "8", "--telemetry", "drive.csv"]
        subprocess.run([self.program, *drive], cwd=self.place.name, capture_output=True, check=True)
        self.process = subprocess.Popen(
            [self.program, "serve", ".", "--no-open"], cwd=self.place.name, stdout=subprocess.PIPE, text=True
        )
        self.address = self.process.stdout.readline().strip()
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(10)
        self.place.cleanup()

    def run(self, command):
        """What the program prints for a command of the page, as JSON."""
        # A folder is written once.
        shutil.rmtree(Path(self.place.name, "map"), ignore_errors=True)
        words = command.replace("grouser ", f"'{self.program}' ", 1) + " --format json"
        done = subprocess.run(words, shell=True, cwd=self.place.name, capture_output=True, text=True, check=True)
        return json.loads(done.stdout)


class Looks:
    """Claims about the page, and how many of them hold."""

    def __init__(self):
        self.passed = self.failed = 0

    def claim(self, what, flaws):
        """Counts a claim, which holds if it has no flaws."""
        for flaw in flaws:
            print(f"console, {what}: {flaw}")
        self.passed, self.failed = self.passed + (not flaws), self.failed + bool(flaws)


def opened(browser, server, fragment="", size=SIZES[0], theme="light", bypass=False):
    """A page, and a list of what goes wrong on it from now on."""
    # Scripts from outside, as axe and the driver's waiting are, pass no strict policy.
    context = browser.new_context(
        viewport={"width": size[0], "height": size[1]}, color_scheme=theme, bypass_csp=bypass
    )
    page = context.new_page()
    flaws = []
    own = server.address.split("?")[0]
    page.on("pageerror", lambda error: flaws.append(f"error of a script: {error}"))
    page.on("console", lambda line: line.type == "error" and flaws.append(f"says {line.text}"))
    page.on("dialog", lambda dialog: (flaws.append("opens a dialog"), dialog.dismiss()))
    page.on(
        "request",
        lambda request: request.url.startswith((own, "data:", "blob:")) or flaws.append(f"asks another host: {request.url}"),
    )
    page.goto(f"{server.address}#{fragment}")
    settled(page)
    return page, flaws


def started(browser, server, fragment, *how, **more):
    """The same, where a study that starts by hand has its answer."""
    page, flaws = opened(browser, server, fragment, *how, **more)
    if page.locator("#start").count():
        page.locator("#start").click()
        settled(page)
    return page, flaws


def settled(page):
    """Waits until the answer is there."""
    page.wait_for_timeout(100)
    for _ in range(300):
        said = page.locator("#busy").inner_text()
        if said and not said.startswith("computing") and page.locator(".stale, [aria-busy='true']").count() == 0:
            # Charts come a little later.
            page.wait_for_timeout(300)
            return
        page.wait_for_timeout(100)
    raise AssertionError("there is no answer after half a minute")


def four(value):
    """A number as the page's tables have it."""
    if value is None:
        return "–"
    text = f"{value:.4g}"
    return text if "e" in text else f"{value:#.4g}".rstrip("0").rstrip(".")


def shown(page, column):
    """The number that the page has in a column."""
    return page.locator(f"article [data-column='{column}']").first.inner_text()


def numbers_differ(page, server):
    """Where the page has another number than its command."""
    row = server.run(page.locator("#command").inner_text())["rows"][0]
    flaws = []
    large = page.locator("article .number").first.inner_text().split("°")[0]
    if large != f"{abs(row['yaw_deg']):.1f}":
        flaws.append(f"the heading is {large}, the program has {row['yaw_deg']}")
    for column in ("yaw_deg_p2_5", "yaw_deg_p97_5", "slip_ratio_p2_5", "slip_ratio_p97_5", "sinkage_mm_p2_5", "sinkage_mm_p97_5"):
        if shown(page, column) != four(row[column]):
            flaws.append(f"{column} is {shown(page, column)}, the program has {row[column]}")
    for column in ("slip_ratio", "sinkage_mm"):
        if shown(page, column) != four(row[column]):
            flaws.append(f"{column} is {shown(page, column)}, the program has {row[column]}")
    verdict = page.locator(".verdict").first.get_attribute("class").split()[-1]
    if verdict != row["verdict"]:
        flaws.append(f"the verdict is {verdict}, the program has {row['verdict']}")
    return flaws


def unreached(page):
    """Controls that the Tab key does not reach."""
    page.evaluate("document.activeElement.blur()")
    wanted = """[...document.querySelectorAll('input, select, button, summary, a[href], [tabindex="0"]')]
      .filter(one => one.checkVisibility() && !one.disabled)"""
    count = page.evaluate(f"{wanted}.length")
    page.evaluate("window.reached = new Set()")
    for _ in range(count + 5):
        page.keyboard.press("Tab")
        page.evaluate("window.reached.add(document.activeElement)")
    return page.evaluate(f"{wanted}.filter(one => !window.reached.has(one)).map(one => one.outerHTML.slice(0, 80))")


def places_differ(page, server):
    """Where the map has another number at its place than the heading on that slope."""
    place = page.locator("#place")
    slope = float(place.locator("[data-column='slope_deg']").inner_text())
    # A place has the verdict of the whole degree above its slope.
    row = server.run(f"grouser heading --soil toyoura-uncertain --slope-deg {math.ceil(slope)} --samples 200")["rows"][0]
    flaws = []
    verdict = place.locator(".verdict").get_attribute("class").split()[-1]
    if verdict != row["verdict"]:
        flaws.append(f"the verdict is {verdict}, the heading on {math.ceil(slope)}° has {row['verdict']}")
    row = server.run(f"grouser heading --soil toyoura-uncertain --slope-deg {slope} --nominal")["rows"][0]
    slip = float(place.locator("[data-column='slip_ratio']").inner_text())
    if abs(slip - row["slip_ratio"]) > 0.005:
        flaws.append(f"the slip ratio is {slip}, the heading has {row['slip_ratio']}")
    return flaws


def way_differs(page, server):
    """Where the way has another number than its command."""
    row = server.run(page.locator("#way-command").inner_text())
    flaws = []
    for column in ("time_s", "energy_j", "length_m", "probability_no_go", "probability_completed"):
        number = page.locator(f"#way [data-column='{column}']").inner_text()
        if number != four(row[column]):
            flaws.append(f"{column} is {number}, the program has {row[column]}")
    return flaws


def use_map(looks, browser, server):
    page, flaws = opened(browser, server, "view=map&at=10,20")
    shares = server.run(page.locator("#command").inner_text())["verdicts"]
    known = sum(shares.values()) - shares["unknown"]
    words = page.locator("#map-words").inner_text()
    go = f"go {round(1000 * shares['go'] / known) / 10:g} %"
    looks.claim("the map's verdicts are the program's", [] if words.startswith(go) else [f"{words}, the program has {shares}"])
    looks.claim("a place agrees with the heading", places_differ(page, server))
    labels = page.locator("#place th").all_inner_texts()
    has_both = any("on the map" in it for it in labels) and any("offset from the contour" in it for it in labels)
    rule = page.locator("#place [data-column='rule']").inner_text()
    looks.claim("a heading of the map is no offset, and a verdict has its thresholds", [] if has_both and "0.3" in rule else [*labels, rule])
    before = page.locator("#place caption").inner_text()
    page.locator(".marks").focus()
    for _ in range(4):
        page.keyboard.press("Shift+ArrowLeft")
    settled(page)
    moved = [] if page.locator("#place caption").inner_text() != before else ["it stays"]
    looks.claim("keys move the place", moved + places_differ(page, server))
    box = page.locator(".marks").bounding_box()
    page.get_by_role("button", name="start", exact=True).click()
    page.mouse.click(box["x"] + 0.2 * box["width"], box["y"] + 0.65 * box["height"])
    page.get_by_role("button", name="goal", exact=True).click()
    page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 0.3 * box["height"])
    said = page.locator("#busy").inner_text()
    looks.claim("a way that is computed is not up to date", [] if said == "computing the way …" else [said])
    settled(page)
    page.wait_for_selector("#way-command", timeout=60000)
    settled(page)
    looks.claim("a way has the program's numbers", way_differs(page, server))
    time = page.locator("#way [data-column='time_s']").inner_text()
    page.get_by_label("Goal, x in m").fill("30")
    page.get_by_label("Goal, x in m").press("Tab")
    page.wait_for_timeout(500)
    settled(page)
    other = page.locator("#way [data-column='time_s']").inner_text()
    looks.claim("a goal that moves moves the way", ["it stays"] if other == time else way_differs(page, server))
    picture = page.locator(".picture img").get_attribute("src")
    page.get_by_role("button", name="slip ratio").click()
    settled(page)
    is_other = page.locator(".picture img").get_attribute("src") != picture
    looks.claim("a layer changes the picture", [] if is_other else ["it stays"])
    page.get_by_role("slider", name="Course").focus()
    page.keyboard.press("PageUp")
    settled(page)
    has = "--course-deg 15 " in page.locator("#command").inner_text()
    looks.claim("the dial sets the course", [] if has else ["it does not"])
    looks.claim("the keyboard reaches everything about a map", unreached(page))
    looks.claim("nothing goes wrong on the map", flaws)
    page.context.close()


def ends_differ(page, server):
    """Where the run ends otherwise than the program's."""
    run = server.run(page.locator("#command").inner_text())
    flaws = []
    if page.locator("#outcome").inner_text().split()[-1] != run["outcome"]:
        flaws.append(f"the outcome is {page.locator('#outcome').inner_text()}, the program has {run['outcome']}")
    for column in ("time_s", "x_m", "y_m", "yaw_deg", "energy_j"):
        number = page.locator(f"[data-column='final-{column}']").inner_text()
        if number != four(run["final"][column]):
            flaws.append(f"{column} is {number}, the program has {run['final'][column]}")
    return flaws + records_differ(page, run, -1)


def records_differ(page, run, place):
    """Where the wheels have other numbers than a record of the program's."""
    flaws = []
    for wheel in run["samples"][place]["wheels"]:
        for column in ("slip_ratio", "sinkage_mm", "load_n"):
            number = page.locator(f"#now [data-column='{wheel['wheel']}-{column}']").inner_text()
            if number != four(wheel[column]):
                flaws.append(f"{column} of {wheel['wheel']} is {number}, the program has {wheel[column]}")
    return flaws


def place_in_scene(page):
    """Where the rover is in three dimensions, by the words below it."""
    return [page.locator(f"[data-column='scene-{axis}_m']").inner_text() for axis in "xyz"]


def scene_differs(page):
    """Where the scene has other wheels, or at the end of the run another place of the rover, than the
    page's tables."""
    flaws = []
    wheels = page.locator("[data-column='scene-wheels']").inner_text()
    rows = page.locator("#now tbody tr").count()
    if wheels != str(rows):
        flaws.append(f"there are {wheels} wheels, the table has {rows}")
    for axis, at in zip("xyz", place_in_scene(page), strict=True):
        # On a plane the height has no column.
        cell = page.locator(f"[data-column='final-{axis}_m']")
        if cell.count() and cell.inner_text() != at:
            flaws.append(f"{axis} is {at}, the table has {cell.inner_text()}")
    return flaws


def pixels(page):
    """The picture in three dimensions, once it is drawn."""
    page.wait_for_timeout(300)
    return page.locator(".stage canvas").screenshot()


def seen(page, how):
    """Shows the drive in another way, by the keyboard."""
    page.locator(f"#seen-{how}").press("Enter")
    settled(page)


def use_scene(looks, browser, server):
    page, flaws = opened(browser, server, "view=drive")
    page.on("console", lambda line: "WebGL contexts" in line.text and flaws.append(f"says {line.text}"))
    loaded = "performance.getEntriesByType('resource').filter(it => it.name.includes('/three/')).length"
    early = page.evaluate(loaded)
    seen(page, "scene")
    blank = [] if len(pixels(page)) > 8000 else ["the picture is blank"]
    lazy = ["three is loaded before it is asked for"] if early or not page.evaluate(loaded) else []
    looks.claim("a drive ends in three dimensions where its table says", blank + lazy + scene_differs(page))
    asked = {"soil": "toyoura", "slope_deg": 12, "yaw_deg": 20, "duration_s": 5, "scene": True}
    apart, compared = page.evaluate(ARROWS, [asked, 12])
    far = [] if apart < 1e-4 and compared == 4 * 51 else [f"{compared} of them are up to {apart} of the largest force apart"]
    looks.claim("arrows are the forces of the records to another reader of the scene", far)
    shown, scale = pixels(page), page.locator("#force-scale").inner_text()
    page.locator("#forces").press("Space")
    bare, without = pixels(page), page.locator("#force-scale").inner_text()
    page.locator("#forces").press("Space")
    back = [] if pixels(page) == shown != bare else ["the picture does not say so"]
    words = [] if re.search(r"1 m of arrow = [\d.]+ N", scale) and not without else [f"it says {scale}, then {without}"]
    looks.claim("a box shows and hides the forces, and their scale", back + words)
    end = place_in_scene(page)
    page.locator("#time").focus()
    page.keyboard.press("Home")
    for _ in range(7):
        page.keyboard.press("ArrowRight")
    record = server.run(page.locator("#command").inner_text())["samples"][7]
    # Between its pictures the scene goes evenly.
    apart = [abs(float(at) - record[f"{axis}_m"]) for axis, at in zip("xy", place_in_scene(page), strict=False)]
    there = [] if max(apart) < 1e-3 and place_in_scene(page) != end else [f"it is {apart} m from the record"]
    looks.claim("keys scrub the drive in three dimensions", there)
    page.locator("#play").press("Enter")
    page.wait_for_timeout(11500)
    looks.claim("a drive plays to its end in three dimensions", scene_differs(page))
    before = pixels(page)
    page.locator("#follow").press("Enter")
    whole = pixels(page)
    page.locator(".stage canvas").focus()
    for key in ("ArrowLeft", "ArrowUp", "+"):
        page.keyboard.press(key)
    turned = pixels(page)
    box = page.locator(".stage canvas").bounding_box()
    page.mouse.move(box["x"] + 100, box["y"] + 100)
    page.mouse.down()
    page.mouse.move(box["x"] + 180, box["y"] + 120, steps=3)
    page.mouse.up()
    views = [before, whole, turned, pixels(page)]
    still = [what for what, one, other in zip(("the button", "keys", "the mouse"), views, views[1:], strict=False) if one == other]
    looks.claim("keys and the mouse turn the view", [f"{what} leaves it as it was" for what in still])
    looks.claim("the keyboard reaches everything about a drive in three dimensions", unreached(page))
    for mission in (False, True):
        if mission:
            page.locator("#mission").select_option("switchbacks-15-deg")
        else:
            page.locator("#ground").select_option("hills.tif")
        settled(page)
        what = "a mission" if mission else "a drive on a map"
        looks.claim(f"{what} ends in three dimensions where its table says", scene_differs(page))
    link = page.url.split("#")[1]
    for _ in range(20):
        seen(page, "plan")
        seen(page, "scene")
    seen(page, "plan")
    left = page.locator("canvas").count()
    looks.claim("a picture that is closed leaves nothing", flaws + ([f"there are {left}"] if left else []))
    page.context.close()
    page, flaws = opened(browser, server, link)
    looks.claim("a link restores a drive in three dimensions", flaws + scene_differs(page))
    page.context.close()
    page, _ = opened(browser, server, "view=drive&seen=scene&set.soil.friction_angle_deg=99")
    said = page.locator("main").inner_text()
    looks.claim("a drive that fails says why", [] if "it must be 5 to 60" in said else [f"there is {said}"])
    page.context.close()


def use_without_depth(looks, browser, server):
    page, flaws = opened(browser, server, "view=heading")
    page.evaluate("HTMLCanvasElement.prototype.getContext = () => null")
    page.get_by_role("button", name="Drive", exact=True).click()
    settled(page)
    seen(page, "scene")
    said = page.get_by_text("WebGL 2 is missing").count()
    stays = page.get_by_role("img", name=re.compile("The track from above")).is_visible()
    looks.claim("without WebGL a sentence says so and the plan stays", flaws + ([] if said and stays else ["it does not"]))
    page.context.close()


def live(page, column):
    """A number of the drive by hand, now."""
    return float(page.locator(f"[data-column='live-{column}']").inner_text())


def place_by_hand(page):
    """Where the rover is: x, y and yaw, by the words over the numbers."""
    return [float(it) for it in re.findall(r"(?:x|y|yaw) (-?[\d.e-]+)", page.locator("#live caption").inner_text())]


def held(page, key, time):
    """Holds a key, and waits until the rover stands."""
    page.keyboard.down(key)
    page.wait_for_timeout(time)
    page.keyboard.up(key)
    page.locator("#outcome", has_text=re.compile("ready|immobilised|sliding|tipped|map")).wait_for(timeout=30000)


def asked_steps(page):
    """Counts the steps that the page asks from now on."""
    steps = []
    page.on("request", lambda request: request.url.endswith("/api/drive-step") and steps.append(request))
    return steps


def use_hand(looks, browser, server):
    page, flaws = opened(browser, server, "view=drive&mission=by+hand&soil=toyoura&slope=0&seen=scene")
    steps = asked_steps(page)
    start = place_by_hand(page)
    page.wait_for_timeout(500)
    looks.claim("a rover that nobody drives asks nothing", [f"it asks {len(steps)} times"] if steps else [])
    held(page, "ArrowUp", 1500)
    ahead = place_by_hand(page)
    scene = [float(it) for it in place_in_scene(page)]
    apart = max(abs(scene[0] - ahead[0]), abs(scene[1] - ahead[1]))
    moved = [] if 0.005 < ahead[0] - start[0] < 0.3 else [f"it is at {ahead}"]
    there = [] if apart < 1e-3 else [f"in three dimensions it is {apart} m from there"]
    looks.claim("a held key drives, in three dimensions too", moved + there)
    scale = page.locator("#force-scale").inner_text()
    looks.claim("a drive by hand has its forces", [] if " N" in scale else [f"it says {scale}"])
    page.locator("#pace").select_option("4")
    page.evaluate("document.activeElement.blur()")
    held(page, "ArrowUp", 2500)
    page.locator("#pace").select_option("1")
    for how in ("plan", "scene"):
        seen(page, how)
    with page.expect_download(timeout=20000) as saved:
        page.locator("#save-drive").press("Enter")
    log = Path(server.place.name, "drive-by-hand.csv")
    saved.value.save_as(log)
    replayed = server.run(page.locator("#drive-command code").inner_text().replace("drive.csv", log.name))
    agrees = [] if "point to nothing" in " ".join(replayed["points_to"]) else replayed["points_to"]
    times = [float(line.split(",")[0]) for line in log.read_text(encoding="utf-8").splitlines()[1:]]
    tenths = [round(0.1 * place, 6) for place in range(len(times))]
    rows = [] if [round(it, 6) for it in times] == tenths and len(times) > 10 else [f"its times are {times}"]
    looks.claim("a drive by hand is saved as a log, which the program replays", agrees + rows)
    log.unlink()
    page.evaluate("document.activeElement.blur()")
    ahead = place_by_hand(page)
    held(page, "ArrowLeft", 1500)
    turned = place_by_hand(page)
    looks.claim("a key turns the rover to the left", [] if turned[2] > ahead[2] + 0.3 else [f"it is at {turned}, it was at {ahead}"])
    count = len(steps)
    for field in ("Slope, in °", "Gravity, in m/s²"):
        page.get_by_label(field).first.focus()
        page.keyboard.down("ArrowUp")
        page.wait_for_timeout(250)
        page.keyboard.up("ArrowUp")
        page.keyboard.press("ArrowDown")
        page.evaluate("document.activeElement.blur()")
        settled(page)
    # What was moved begins a drive anew, with one step, and drives nowhere.
    still = place_by_hand(page)[0]
    looks.claim("keys of a field do not drive", [] if abs(still) < 0.01 and len(steps) > count else [f"it is at x {still} m"])
    page.get_by_role("button", name="Forward").focus()
    held(page, "Enter", 800)
    by_button = place_by_hand(page)
    box = page.get_by_role("button", name="Backward").bounding_box()
    page.mouse.move(box["x"] + 5, box["y"] + 5)
    page.mouse.down()
    page.wait_for_timeout(800)
    page.mouse.up()
    page.locator("#outcome", has_text="ready").wait_for(timeout=30000)
    back = place_by_hand(page)
    looks.claim("buttons drive, by a key and by the mouse", [] if by_button[0] > 0.002 and back[0] < by_button[0] else [f"{by_button}, then {back}"])
    charts = page.locator(".figures .picked").count()
    page.locator(".figures .picked").first.click(position={"x": 60, "y": 60})
    early = page.locator("#clock").inner_text()
    looks.claim("a drive by hand has its charts and its time line", [] if charts == 6 and float(early.split()[0]) < 0.7 else [f"{charts} charts, at {early}"])
    looks.claim("the keyboard reaches everything about a drive by hand", unreached(page))
    page.get_by_label("Slope, in °").last.fill("32")
    page.get_by_label("Yaw at the start", exact=False).last.fill("90")
    page.evaluate("document.activeElement.blur()")
    settled(page)
    page.locator("#pace").select_option("4")
    page.evaluate("document.activeElement.blur()")
    held(page, "ArrowUp", 4000)
    said = page.locator("#outcome").inner_text().split()[-1]
    count = len(steps)
    page.keyboard.down("ArrowUp")
    page.wait_for_timeout(500)
    page.keyboard.up("ArrowUp")
    over = [] if said in ("immobilised", "sliding") and len(steps) == count else [f"it is {said}"]
    looks.claim("a drive by hand ends as the engine says, and why", over + ([] if "start anew" in page.locator("#why-ended").inner_text() else ["no reason"]))
    page.locator("#simulation").select_option("quasi-steady")
    page.locator("#outcome", has_text="ready").wait_for(timeout=30000)
    said = page.locator("#why-ended").inner_text()
    looks.claim("another simulation begins a drive by hand anew", [] if "quasi steady" in said else [said])
    page.locator("#simulation").select_option("")
    page.locator("#anew").press("Enter")
    page.locator("#outcome", has_text="ready").wait_for(timeout=30000)
    page.locator("#ground").select_option("hills.tif")
    settled(page)
    page.evaluate("document.activeElement.blur()")
    held(page, "ArrowUp", 1500)
    on_map = place_by_hand(page)
    looks.claim("a rover is driven over a map", [] if abs(on_map[0]) > 0.01 else [f"it is at {on_map}"])
    looks.claim("nothing goes wrong by hand", flaws)
    page.context.close()


def use_mission(looks, page, server):
    """Drives a mission, another leg of it, and a place that is dragged, and compares each."""

    def legs_differ():
        settled(page)
        legs = server.run(page.locator("#command").inner_text())["legs"]
        ends = [row.locator("[data-column='x_m']").inner_text() for row in page.locator(".wide tbody tr").all()]
        expected = [four(leg["x_m"]) for leg in legs]
        return [] if ends == expected else [f"the legs end at x {ends}, the program has {expected}"]

    page.locator("#mission").select_option("switchbacks-15-deg")
    looks.claim("a mission is the program's", legs_differ())
    page.get_by_label("Leg 1 goto y_m").fill("0.5")
    page.get_by_label("Leg 1 goto y_m").press("Tab")
    looks.claim("a leg that is changed is driven", legs_differ())
    page.get_by_label("Remove leg 3").press("Enter")
    flaws = legs_differ()
    page.locator(".goal").first.scroll_into_view_if_needed()
    box = page.locator(".goal").first.bounding_box()
    before = page.get_by_label("Leg 1 goto x_m").input_value()
    page.mouse.move(box["x"] + 8, box["y"] + 8)
    page.mouse.down()
    page.mouse.move(box["x"] - 20, box["y"] + 8, steps=4)
    page.mouse.up()
    moved = page.get_by_label("Leg 1 goto x_m").input_value()
    looks.claim("a place is dragged", flaws + legs_differ() + ([] if moved != before else ["it stays"]))
    page.locator("#track").focus()
    for key in ("ArrowLeft", "ArrowLeft", "ArrowUp"):
        page.keyboard.press(key)
    legs = page.locator("#legs li").count()
    looks.claim("arrow keys drive", legs_differ() + ([] if legs == 4 else [f"there are {legs} legs"]))
    kinds = page.locator("#limit-kind option").count()
    page.locator("#limit-kind").select_option("mission.stop.sinkage_over_radius.above")
    page.locator("#limit-above").fill("0.01")
    page.locator("#add-limit").press("Enter")
    flaws = legs_differ()
    stopped = [] if "sinkage" in page.locator("#answer").inner_text().lower() and page.locator("#limit-kind option").count() == kinds - 1 else ["nothing stops it"]
    looks.claim("a kind of limit is added, and stops the rover", flaws + stopped)
    page.get_by_label("Remove the limit: sinkage over radius").press("Enter")
    looks.claim("a limit is taken away", legs_differ() + ([] if page.locator("#limit-kind option").count() == kinds else ["it stays"]))
    looks.claim("the keyboard reaches everything about a mission", unreached(page))
    page.locator("#mission").select_option("blank")
    settled(page)
    page.locator("#rover").select_option("rashid")
    flaws = legs_differ()
    setup = page.locator(".setup").first.inner_text()
    looks.claim("a blank mission has the rover of the session", flaws + ([] if setup.startswith("Rashid") else [setup]))


def use_drive(looks, browser, server):
    page, flaws = opened(browser, server, "view=drive")
    looks.claim("a run ends as the program's", ends_differ(page, server))
    page.locator("#time").focus()
    page.keyboard.press("Home")
    for _ in range(7):
        page.keyboard.press("ArrowRight")
    run = server.run(page.locator("#command").inner_text())
    looks.claim("keys scrub to a record", records_differ(page, run, 7))
    page.locator(".figures .picked").first.scroll_into_view_if_needed()
    box = page.locator(".figures .picked").first.bounding_box()
    page.mouse.click(box["x"] + (52 + 0.5 * 350) / 420 * box["width"], box["y"] + 0.5 * box["height"])
    time = float(page.locator("#clock").inner_text().split()[0])
    place = min(range(len(run["samples"])), key=lambda at: abs(run["samples"][at]["time_s"] - time))
    middle = run["samples"][-1]["time_s"] / 2
    looks.claim("a click on a chart leads to its time", records_differ(page, run, place) + ([] if abs(time - middle) < 0.3 else [f"it is at {time} s"]))
    page.get_by_label("Slope, in °").focus()
    for _ in range(5):
        page.keyboard.press("ArrowRight")
    settled(page)
    page.get_by_role("button", name="Play").click()
    page.wait_for_timeout(11500)
    ended = page.locator("#clock").inner_text()
    looks.claim("a run plays to its end", ([] if ended == "20 s" else [f"it is at {ended}"]) + ends_differ(page, server))
    page.locator("#ground").select_option("hills.tif")
    settled(page)
    looks.claim("a run on a map ends as the program's", ends_differ(page, server))
    looks.claim("the keyboard reaches everything about a run", unreached(page))
    use_mission(looks, page, server)
    looks.claim("nothing goes wrong on the way", flaws)
    page.context.close()


def design_differs(page, server):
    """Where the limits and the designs have other numbers than the program's."""
    found = server.run(page.locator("#command").inner_text())
    flaws = []
    for at, rows in enumerate([found["constraints"], found["designs"]]):
        lines = page.locator(".wide table").nth(at).locator("tbody tr")
        if lines.count() != len(rows):
            flaws.append(f"there are {lines.count()} rows, the program has {len(rows)}")
            continue
        for place, row in enumerate(rows):
            for cell in lines.nth(place).locator("td").all():
                column = cell.get_attribute("data-column")
                own = four(row[column]) if isinstance(row[column], (int, float)) else str(row[column])
                # A name in words has itself for a title.
                if (cell.get_attribute("title") or cell.inner_text()) != own:
                    flaws.append(f"{column} is {cell.inner_text()}, the program has {own}")
    return flaws


def use_design(looks, browser, server):
    page, flaws = opened(browser, server, "view=design&belief=nominal")
    page.get_by_role("spinbutton", name=re.compile("At least: the steepest slope", re.IGNORECASE)).fill("20")
    settled(page)
    page.locator("#start").press("Enter")
    settled(page)
    looks.claim("a design is the program's", design_differs(page, server))
    page.locator("#belief").select_option("samples")
    page.locator("#design").select_option("design-climbing-wheels")
    settled(page)
    page.locator("#start").press("Enter")
    page.locator("#progress-words", has_text="measured").wait_for(timeout=60000)
    page.keyboard.press("Enter")
    settled(page)
    is_over = page.locator("#progress").is_hidden() and page.locator("#start").is_enabled()
    looks.claim("a search is stopped by the keyboard", [] if is_over else ["it goes on"])
    end = page.locator("#bounds").get_by_role("spinbutton", name=re.compile("radius.*at most", re.IGNORECASE))
    usual = end.input_value()
    end.fill("0.01")
    wrong = page.locator("#bounds .error:not(:empty)")
    wrong.wait_for()
    flaws_of_end = [] if end.get_attribute("aria-invalid") and "below the second" in wrong.inner_text() else [wrong.inner_text()]
    looks.claim("an end of what is free is refused beside its field", flaws_of_end)
    page.get_by_role("button", name="Wheel", exact=True).click()
    settled(page)
    page.get_by_role("button", name="Design", exact=True).click()
    wrong.wait_for()
    kept = end.input_value()
    end.fill(usual)
    page.wait_for_selector("#bounds .error:not(:empty)", state="detached")
    looks.claim("what is refused has its field after another view, too", [] if kept == "0.01" else [f"it has {kept}"])
    looks.claim("the keyboard reaches everything about a design", unreached(page))
    looks.claim("nothing goes wrong about a design", [it for it in flaws if "422" not in it])
    page.context.close()


def summary_differs(page, server):
    """Where the means have other numbers than the program's."""
    rows = server.run(page.locator("#command").inner_text())["rows"]
    lines = page.locator(".wide table").nth(1).locator("tbody tr")
    flaws = [] if lines.count() == len(rows) else [f"there are {lines.count()} rows, the program has {len(rows)}"]
    for place, row in enumerate(rows):
        mean = lines.nth(place).locator("[data-column='mean']").inner_text()
        if mean not in (four(row["mean"]), "-"):
            flaws.append(f"the mean of {row['quantity']} is {mean}, the program has {row['mean']}")
    return flaws


def use_campaigns(looks, browser, server):
    page, flaws = opened(browser, server, "view=campaigns&out=sand")
    page.get_by_label("Runs", exact=True).fill("60000")
    page.get_by_label("Runs", exact=True).press("Tab")
    page.locator("#start").press("Enter")
    page.locator("#progress-words", has_text=re.compile(r"\d{5} of 60000 runs")).wait_for(timeout=60000)
    page.keyboard.press("Enter")
    row = page.locator("[data-campaign='sand']")
    row.get_by_role("button", name="Go on sand").wait_for(timeout=60000)
    text = row.inner_text()
    looks.claim("a campaign is stopped by the keyboard", [] if " of 60000" in text else [f"there is {text}"])
    row.get_by_role("button", name="Go on sand").press("Enter")
    page.locator("[data-campaign='sand']", has_text="finished").wait_for(timeout=180000)
    settled(page)
    page.get_by_role("button", name="Look sand").press("Enter")
    settled(page)
    looks.claim("a campaign that goes on has the program's numbers", summary_differs(page, server))
    looks.claim("the keyboard reaches everything about campaigns", unreached(page))
    looks.claim("nothing goes wrong about campaigns", flaws)
    page.context.close()


def use_fits(looks, page, server):
    """Fits beside each other: the one that is shown, and one with all trials and another number."""
    first = page.locator("#command").inner_text()
    page.locator("#all-trials").press("Enter")
    page.get_by_role("checkbox", name=re.compile("angle of internal friction", re.IGNORECASE)).check()
    page.locator("#start").press("Enter")
    settled(page)
    second = page.locator("#command").inner_text()
    rows = [{row["key"]: row for row in server.run(command)["rows"]} for command in (first, second)]
    beside = page.locator("#fits table").nth(1).locator("tbody tr")
    cells = {line.locator("td").first.inner_text(): line.locator("td").all_inner_texts()[1:] for line in beside.all()}
    shear = next(cells[name] for name in cells if "shear longitudinal" in name)
    friction = next(cells[name] for name in cells if "friction angle" in name)
    flaws = [] if "as it was" in friction[0] else [f"friction was not fitted at first, and is {friction[0]}"]
    for cell, row in zip(shear, [one["soil.shear.longitudinal_m"] for one in rows], strict=True):
        if not cell.startswith(four(row["fit"])):
            flaws.append(f"it is {cell}, the program has {row['fit']}")
    errors = [name for name in cells if "RMSE" in name]
    looks.claim("two fits stand beside each other", flaws + ([] if errors else ["errors are missing"]))
    page.locator("#show-1").press("Enter")
    shown = page.locator("#command").inner_text()
    current = page.locator("#fits tr[aria-current]").inner_text()
    looks.claim("an earlier fit is shown again", [] if shown == first and current.startswith("1 (shown)") else [shown, current])
    page.locator("#take-up-1").press("Enter")
    settled(page)
    said = page.locator("#trial-count").inner_text()
    again = page.locator("#command").inner_text()
    taken = "without 2 of" in said and "without=" in page.url and again == first
    looks.claim("a fit that is taken up brings its settings back", [] if taken else [said, page.url, again])
    words = [page.locator(it).inner_text() for it in ("#busy", "#found")]
    focused = page.evaluate("document.activeElement.id")
    looks.claim("it is what the status line says, and keeps the focus", [] if words[0] == words[1] and focused == "take-up-1" else [*words, focused])


def use_corner(looks, browser, server):
    """The posterior of two numbers in a picture, and in words."""
    page, flaws = opened(browser, server, "view=fit&soil=toyoura&data=tests.csv&fit=soil.shear.longitudinal_m,soil.friction_angle_deg")
    page.locator("#start").press("Enter")
    page.locator("#found").wait_for(timeout=120000)
    settled(page)
    table = page.locator("table", has_text="Correlation of what is fitted")
    between = table.locator("tbody tr").first.locator("td").nth(2).inner_text()
    said = page.locator("#answer .figures .across img").get_attribute("alt")
    right = "95 % interval" in said and f"{float(between):.2f}" in said
    looks.claim("a posterior is drawn, and its correlation said", [] if right else [between, said])
    looks.claim("nothing goes wrong about a posterior", flaws)
    page.context.close()


def use_fit(looks, browser, server):
    page, flaws = opened(browser, server, "view=fit&soil=toyoura&data=tests.csv&set.soil.shear.longitudinal_m=0.1")
    page.locator("#start").press("Enter")
    page.locator("#progress-words", has_text="posterior").wait_for(timeout=60000)
    page.keyboard.press("Enter")
    settled(page)
    looks.claim("a fit is stopped by the keyboard", [] if page.locator("#start").is_enabled() else ["it goes on"])
    page.locator("#belief").select_option("nominal")
    trials = page.locator("#trials .trial").count()
    page.locator("#trials").scroll_into_view_if_needed()
    box = page.locator("#trials .trial").nth(3).bounding_box()
    page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"])
    page.locator("#trials").focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    said = page.locator("#trial-count").inner_text()
    left_out = [] if said == f"The fit goes without 2 of {trials} trials." else [said]
    page.locator("#start").press("Enter")
    settled(page)
    command = page.locator("#command").inner_text()
    words = f"without 2 of {trials} trials, by their lines"
    left_out += [] if words in page.locator("#answer").inner_text() and "line!=" in command else [command]
    looks.claim("trials are left out by the mouse and by keys", left_out)
    row = server.run(command)["rows"][0]
    shown = page.locator(".wide [data-column='fit']").first.inner_text()
    looks.claim("a fit is the program's", [] if shown == four(row["fit"]) else [f"it is {shown}, the program has {row['fit']}"])
    use_fits(looks, page, server)
    looks.claim("the keyboard reaches everything about a fit", unreached(page))
    page.locator("#where").fill("slip_ratio=7")
    page.locator("#where").press("Tab")
    page.locator("#start").press("Enter")
    settled(page)
    is_none = page.locator("#why-none").count() == 1 and page.locator("#fits tr[aria-current]").count() == 0
    looks.claim("a fit that fails is none of the list", [] if is_none else [page.locator("#fits").inner_text()])
    lacking = page.locator("#data option[value='hakuto-slope']")
    said = lacking.inner_text() if lacking.is_disabled() else "it is offered"
    looks.claim("a data set without loads is not offered, and says why", [] if "load is missing" in said else [said])
    page.locator("#data").select_option("cmu-single-wheel")
    settled(page)
    taken = [page.locator(it).input_value() for it in ("#wheel", "#soil")]
    looks.claim("a data set takes its wheel and its soil", [] if taken[0] == "cmu-smooth" and taken[1] != "toyoura" else [f"it has {taken}"])
    looks.claim("nothing goes wrong about a fit", [it for it in flaws if "422" not in it])
    page.context.close()


def use_part_of_log(looks, page, server):
    """A time of a log that is replayed, and a part of it."""
    rows = server.run(page.locator("#command").inner_text())["stretches"]
    chart = page.locator("#answer .figures .picked").first
    box = chart.bounding_box()
    chart.click(position={"x": 0.5 * box["width"], "y": 0.5 * box["height"]})
    shown = page.locator("#at-time caption").inner_text()
    row = next((it for it in rows if f" {four(it['time_s'])} s" in shown), None)
    middle = [] if row and 0.3 < row["time_s"] / rows[-1]["time_s"] < 0.7 else [f"it is at {shown}"]
    cells = {it.get_attribute("data-column"): it.inner_text() for it in page.locator("#at-time td[data-column]").all()}
    other = [f"{name} is {text}, the program has {row[name]}" for name, text in cells.items() if row and text != ("–" if row[name] is None else four(row[name]))]
    looks.claim("a click on a chart leads to its time, and to its values", middle + other + ([] if len(cells) > 20 else [f"{len(cells)} cells"]))
    page.locator("#stretch").press("Home")
    first = page.locator("#stretch-clock").inner_text()
    looks.claim("the keyboard goes over a log, too", [] if first == f"{four(rows[0]['time_s'])} s" else [first])
    chart.scroll_into_view_if_needed()
    box = chart.bounding_box()
    page.mouse.move(box["x"] + 0.4 * box["width"], box["y"] + 60)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.8 * box["width"], box["y"] + 60, steps=4)
    page.mouse.up()
    drawn = part_differs(page, server)
    page.locator("#part-of").select_option(index=3)
    looks.claim("a part that is drawn or chosen is explained as by the program", drawn + part_differs(page, server))
    page.locator("#part-of").select_option(index=1)
    first = part_differs(page, server)
    command = page.locator("#part-command").inner_text()
    looks.claim("the first part begins where the log does", first + ([command] if "--from-s" in command else []))
    page.locator("#from").fill("3")
    page.locator("#to").fill("3.01")
    page.locator("#explain").press("Enter")
    page.locator("#part-error").wait_for(timeout=30000)
    said = page.locator("#part-error").inner_text()
    looks.claim("of a part that is too short nothing is told", [] if "nothing can be told from 1 record" in said else [said])


def part_differs(page, server):
    """Where what is said of a part of a log is not what its command says."""
    page.locator("#why-part:not(.stale) #part-command").wait_for(timeout=30000)
    command = page.locator("#part-command").inner_text()
    found = server.run(command)
    ends = [found["inputs"][key] for key in ("from_s", "to_s")]
    written = [page.locator(f"#{name}").input_value() for name in ("from", "to")]
    fields = [float(it) if it else None for it in written]
    flaws = [] if ends == fields and (ends[0] is None or ends[0] < ends[1]) else [f"{command} has the ends {ends}, the fields {fields}"]
    flaws += [] if page.locator("#part-found").inner_text() == "; ".join(found["points_to"]) else ["it says something else"]
    causes = [(it.get_attribute("data-cause"), it.locator("strong").inner_text()) for it in page.locator("#causes li").all()]
    share = {it["cause"]: it["share_alone"] for it in found["findings"]}
    expected = [(cause, f"{math.floor(100 * share[cause] + 0.5)} %") for cause in found["best_causes"]]
    return flaws + ([] if causes == expected else [f"causes are {causes}, not {expected}"])


def use_log(looks, browser, server):
    page, flaws = opened(browser, server, "view=log&soil=toyoura&log=drive.csv")
    page.locator("#start").press("Enter")
    settled(page)
    command = page.locator("#command").inner_text()
    points = [f"finding: {it}" for it in server.run(command)["points_to"]]
    found = page.locator("#found").inner_text()
    looks.claim("a log points to what the program says", [] if found == points[0] else [f"{found}, the program has {points}"])
    use_part_of_log(looks, page, server)
    page.get_by_role("spinbutton", name=re.compile("Angle of internal friction")).fill("30")
    page.locator("#start").press("Enter")
    settled(page)
    found = page.locator("#found").inner_text()
    looks.claim("another soil is found out by a log", [] if "soil" in found else [f"it is {found}"])
    page.locator("#part-of").select_option(index=4)
    other = part_differs(page, server)
    best = page.locator("#causes li").first.get_attribute("data-cause") if page.locator("#causes li").count() else None
    looks.claim("and by a part of it", other + ([] if best else ["it has no cause"]))
    looks.claim("the keyboard reaches everything about a log", unreached(page))
    page.locator("#log").select_option("tests.csv")
    page.locator("#start").press("Enter")
    settled(page)
    said = page.locator("#why-none").inner_text()
    looks.claim("what is no log is refused in the engine's words", [] if "wheel_speed_rad_s" in said or "time" in said else [said])
    looks.claim("nothing goes wrong about a log", [it for it in flaws if "422" not in it])
    page.context.close()


def use_locked(looks, browser, server):
    context = browser.new_context()
    page = context.new_page()
    page.goto(server.address.split("?")[0] + "#soil=toyoura")
    text = page.locator("body").inner_text()
    looks.claim("a link without the token says what is missing", [] if "The token is missing" in text else [text])
    context.close()


def card_differs(page, server):
    """What is wrong with the card that a button saves."""
    with page.expect_download(timeout=120000) as saved:
        page.locator("#card-pdf").click()
    command = page.locator(".export pre", has_text="grouser card").inner_text()
    words = command.replace("grouser ", f"'{server.program}' ", 1)
    subprocess.run(words, shell=True, cwd=server.place.name, capture_output=True, check=True)
    drawn = Path(server.place.name, "card.pdf").read_bytes()
    is_same = Path(saved.value.path()).read_bytes() == drawn and drawn.startswith(b"%PDF")
    return [] if is_same else [f"it is not that of {command}"]


def slide_differs(page):
    """What is wrong with the picture that a key saves."""
    page.evaluate("document.activeElement.blur()")
    with page.expect_download(timeout=60000) as saved:
        page.keyboard.press("i")
    svg = Path(saved.value.path()).read_text(encoding="utf-8")
    settled(page)
    command = page.locator("#command").inner_text()
    flaws = [] if re.search(r'width="320mm" height="180mm"|viewBox="0 0 320 180"', svg) else ["it is not 16 to 9"]
    # A long command has several lines.
    words = html.unescape(" ".join(re.findall(r"<text[^>]*>([^<]*)</text>", svg)))
    return flaws + ([] if command in words else [f"it has {words}, and not {command}"])


def look_at_views(looks, browser, server, axe, pictures):
    for view in VIEWS:
        for size in SIZES:
            for theme in THEMES:
                is_first = (size, theme) == (SIZES[0], "light")
                fragment = SEEN.get(view, f"view={view}") + (PICTURED.get(view, "") if is_first else "")
                page, flaws = started(browser, server, fragment, size, theme)
                if page.evaluate("document.documentElement.scrollWidth > document.documentElement.clientWidth"):
                    flaws.append("wider than the window")
                flaws += page.evaluate(UNREADABLE)
                if "token" in page.url:
                    flaws.append("the address keeps the token")
                if is_first and view == "hand":
                    held(page, "ArrowUp", 3000)
                if is_first and view != "hand":
                    looks.claim(f"a key saves a slide of {view}", slide_differs(page))
                if pictures and is_first:
                    page.evaluate("(top) => top && document.querySelector(top).scrollIntoView()", TOPS.get(view))
                    page.screenshot(path=str(Path(pictures, f"{view}.png")))
                page.context.close()
                page, _ = started(browser, server, SEEN.get(view, f"view={view}"), size, theme, bypass=True)
                page.evaluate(axe)
                flaws += page.evaluate(AXE, list(IMPACTS))
                page.context.close()
                looks.claim(f"{view} at {size[0]} px, {theme}", flaws)


def use(looks, browser, server):
    page, flaws = opened(browser, server)
    looks.claim("numbers are the program's", numbers_differ(page, server))
    rule = page.locator("article [data-column='rule']").inner_text()
    looks.claim("a verdict has its thresholds beside it", [] if "0.3" in rule and "95 %" in rule and "0.6" in rule else [rule])
    before = page.locator("article .number").first.inner_text()
    page.get_by_label("Slope, in °").focus()
    for _ in range(5):
        page.keyboard.press("ArrowRight")
    settled(page)
    moved = page.locator("article .number").first.inner_text()
    looks.claim("a slider moves the answer", ["it stays"] if moved == before else numbers_differ(page, server))
    friction = page.get_by_role("spinbutton", name=re.compile("Angle of internal friction"))
    friction.fill("34.5")
    settled(page)
    looks.claim("a number of the soil moves the answer", numbers_differ(page, server))
    looks.claim("a button saves the card of the program", card_differs(page, server))
    # As a server answers that draws no cards.
    page.route("**/api/questions", lambda route: route.fulfill(json={"rows": [{"name": "heading"}]}))
    page.reload()
    settled(page)
    is_said = page.locator("#card-pdf").count() == 0 and "run the command" in page.locator("#no-card").inner_text()
    looks.claim("where no cards are drawn there is no button for them", [] if is_said else ["it is there"])
    page.unroute("**/api/questions")
    page.reload()
    settled(page)
    link = page.url.split("#")[1]
    friction.fill("99")
    page.wait_for_timeout(1000)
    said = page.locator(".slider .error:not(:empty)").all_inner_texts()
    looks.claim("an error stands beside its cause", [] if said and "it must be 5 to 60" in said[0] else [f"there is {said}"])
    friction.fill("")
    said = page.locator(".slider .error:not(:empty)").all_inner_texts()
    looks.claim("what is no number is said", [] if said and "it must be a number" in said[0] else [f"there is {said}"])
    friction.blur()
    said = page.locator(".slider .error:not(:empty)").all_inner_texts()
    is_back = friction.input_value() == "99" and said and "it must be 5 to 60" in said[0]
    looks.claim("and gives way to the last one, and to what is wrong with it", [] if is_back else [friction.input_value(), *said])
    friction.fill("38")
    settled(page)
    looks.claim("an error goes with its cause", page.locator(".slider .error:not(:empty)").all_inner_texts())
    page.evaluate("document.activeElement.blur()")
    page.keyboard.press("p")
    settled(page)
    looks.claim("a key pins a set-up", [] if page.locator("article").count() == 2 else ["there is none beside"])
    looks.claim("the keyboard reaches everything", unreached(page))
    looks.claim("nothing goes wrong meanwhile", [it for it in flaws if "422" not in it])
    page.context.close()
    page, flaws = opened(browser, server, link)
    text = page.locator(".setup").first.inner_text()
    restored = numbers_differ(page, server) + ([] if "34.5" in text else [f"it has {text}"])
    looks.claim("a link restores a session", flaws + restored)
    page.context.close()
    page, flaws = opened(browser, server, "soil=hostile.toml")
    there = page.locator("summary").first.inner_text()
    looks.claim("a hostile name is text", flaws + ([] if HOSTILE in there else [f"there is {there}"]))
    page.context.close()
    page, flaws = opened(browser, server, "view=wheel")
    row = next(it for it in server.run(page.locator("#command").inner_text())["rows"] if it["slip_ratio"] == 0.2)
    large = page.locator(".number").first.inner_text().split(" ")[0]
    pull = four(row["drawbar_pull_n"])
    looks.claim("the pull is the program's", flaws + ([] if large == pull else [f"{large}, the program has {pull}"]))
    looks.claim("the wheel is drawn", [] if page.locator("figure img").count() == 3 else ["it is not"])
    looks.claim("the keyboard reaches everything about a wheel", unreached(page))
    page.context.close()
    page, flaws = opened(browser, server, "view=heading&rover=viper")
    page.get_by_role("button", name="Wheel", exact=True).click()
    settled(page)
    command = page.locator("#command").inner_text()
    looks.claim("the wheel is that of the rover", flaws + ([] if "--wheel viper-engineering" in command else [command]))
    page.context.close()
    use_drive(looks, browser, server)
    use_hand(looks, browser, server)
    use_scene(looks, browser, server)
    use_without_depth(looks, browser, server)
    use_design(looks, browser, server)
    use_campaigns(looks, browser, server)
    use_fit(looks, browser, server)
    use_corner(looks, browser, server)
    use_log(looks, browser, server)
    use_locked(looks, browser, server)
    use_map(looks, browser, server)


def main(chromium, axe, program, pictures=None):
    looks = Looks()
    script = Path(axe).read_text(encoding="utf-8")
    with Server(program) as server, sync_playwright() as playwright:
        # Without a sandbox it also runs as root, as in a container; it shows our own pages only. WebGL
        # is drawn by the processor, for lack of another.
        flags = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
        browser = playwright.chromium.launch(executable_path=chromium, args=flags)
        look_at_views(looks, browser, server, script, pictures)
        use(looks, browser, server)
        browser.close()
    print(f"{looks.passed} passed, {looks.failed} failed")
    return int(looks.failed > 0)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
