#!/usr/bin/env python3
"""Opens a run.html in headless Chromium and checks that it plays, with WebGL2 and with the 2D fallback.

Usage: check.py RUN.html [--out DIR] [--any-renderer]      exit 0: all checks hold, 1: one does not, 2: no browser

Needs python3 and chromedriver with Chromium (Debian: chromium, chromium-driver); nothing else. It speaks the WebDriver
protocol over loopback. Screenshots go to DIR (default: beside the page).

Checked: the ready mark in the title; that moving the slider moves the time and the picture; play and pause by the space
key; that the console holds no error and nothing was requested but the page; that points of bodies are where the
recorded rotor puts them, by the geometric product and not by the viewer's quaternions; that particles are where they
were recorded, and that a click selects one.
"""

import argparse, base64, json, math, pathlib, re, shutil, socket, struct, subprocess, sys, tempfile, time
import urllib.error, urllib.request, zlib

FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--window-size=1280,860", "--force-device-scale-factor=1"]
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # the WebDriver standard's name for an element's reference
ANSWER_S = 60  # for one command; the protocol itself gives scripts 30 s
READY_S = 60  # software rendering of a large recording on a busy machine


class Failed(Exception):
    """A check that does not hold."""


class NoBrowser(Exception):
    """The browser is missing or does not answer: nothing is known about the page."""


def check(holds, text):
    if not holds:
        raise Failed(text)
    print(f"  ok    {text}", flush=True)


class Browser:
    """One chromedriver process and one session."""

    def __enter__(self):
        driver = shutil.which("chromedriver")
        if not driver:
            raise NoBrowser("chromedriver is missing: install Debian's chromium and chromium-driver")
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.process = subprocess.Popen([driver, f"--port={port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.base = f"http://127.0.0.1:{port}"
        options = {"args": FLAGS + [f"--user-data-dir={self.profile.name}"]}
        try:
            self.wait_for_driver()
            session = self.call("POST", "/session", {"capabilities": {"alwaysMatch": {
                "browserName": "chrome", "goog:chromeOptions": options,
                "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}}})
        except BaseException:
            self.stop()
            raise
        self.base += f"/session/{session['sessionId']}"
        # The browser's own start page asks for its parts: leave it, and forget what it asked for.
        self.call("POST", "/url", {"url": "about:blank"})
        self.log("performance")
        return self

    def wait_for_driver(self):
        for _ in range(100):
            try:
                if self.call("GET", "/status")["ready"]:
                    return
            except NoBrowser:
                pass
            time.sleep(0.1)
        raise NoBrowser("chromedriver did not start")

    def __exit__(self, *_):
        try:
            self.call("DELETE", "")
        except (Failed, NoBrowser):
            pass  # it is stopped next, whether it has let go of the session or not
        self.stop()

    def stop(self):
        self.process.terminate()
        self.process.wait()
        self.profile.cleanup()

    def call(self, method, path, body=None):
        data = json.dumps(body).encode() if body is not None else None
        request = urllib.request.Request(self.base + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=ANSWER_S) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise Failed(json.load(error)["value"]["message"]) from error
        except OSError as error:  # URLError and TimeoutError are OSErrors
            raise NoBrowser(f"{method} {path or 'session'}: {error}") from error

    def script(self, code, *arguments):
        return self.call("POST", "/execute/sync", {"script": code, "args": list(arguments)})

    def after_drawing(self):
        """Two frames: the change is asked for in the first and on the screen in the second."""
        self.call("POST", "/execute/async", {
            "script": "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => done()));", "args": []})

    def element(self, selector):
        return self.call("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def picture(self, selector):
        return base64.b64decode(self.call("GET", f"/element/{self.element(selector)}/screenshot"))

    def screenshot(self, path):
        path.write_bytes(base64.b64decode(self.call("GET", "/screenshot")))

    def log(self, kind):
        return self.call("POST", "/se/log", {"type": kind})

    def press(self, key):
        self.call("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": [
            {"type": "keyDown", "value": key}, {"type": "keyUp", "value": key}]}]})

    def drag(self, start, end):
        move = lambda at, ms: {"type": "pointerMove", "duration": ms, "x": round(at[0]), "y": round(at[1]), "origin": "viewport"}
        self.call("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": [
            move(start, 0), {"type": "pointerDown", "button": 0}, move(end, 150), {"type": "pointerUp", "button": 0}]}]})


def pixels(png):
    """The rows of an 8-bit RGB or RGBA picture, as lists of pixels (PNG specification, sections 9 and 10)."""
    at, data = 8, b""
    while at < len(png):
        size, kind = struct.unpack(">I4s", png[at:at + 8])
        body = png[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            step = {2: 3, 6: 4}[colour]
        data += body if kind == b"IDAT" else b""
        at += size + 12
    raw, rows, last = zlib.decompress(data), [], bytes(width * step)
    for y in range(height):
        start = y * (width * step + 1)
        method, line = raw[start], bytearray(raw[start + 1:start + 1 + width * step])
        for i in range(len(line)):
            left = line[i - step] if i >= step else 0
            corner = last[i - step] if i >= step else 0
            up = last[i]
            if method == 4:
                pa, pb, pc = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
                guess = left if pa <= pb and pa <= pc else up if pb <= pc else corner
            else:
                guess = (0, left, up, (left + up) // 2)[method]
            line[i] = (line[i] + guess) & 255
        rows.append([bytes(line[x:x + 3]) for x in range(0, len(line), step)])
        last = bytes(line)
    return rows


def changed_share(a, b):
    flat = lambda rows: [p for row in rows for p in row]
    pairs = list(zip(flat(pixels(a)), flat(pixels(b))))
    return sum(p != q for p, q in pairs) / len(pairs)


# The geometric product of G(3,0) on blades written as bit sets: e1 = 1, e2 = 2, e12 = 3, e3 = 4, e31 = -e13, ...
def product(a, b):
    out = [0.0] * 8
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            swaps = sum(bin(i >> k & j).count("1") for k in (1, 2))
            out[i ^ j] += (-1) ** swaps * x * y
    return out


def rotor_image(s, e23, e31, e12, v):
    """R v ~R"""
    norm = math.hypot(s, e23, e31, e12)
    s, e23, e31, e12 = (c / norm for c in (s, e23, e31, e12))
    rotor, reverse = [s, 0, 0, e12, 0, -e31, e23, 0], [s, 0, 0, -e12, 0, e31, -e23, 0]
    image = product(product(rotor, [0, v[0], v[1], 0, v[2], 0, 0, 0]), reverse)
    return [image[1], image[2], image[4]]


class Recording:
    """What the page holds, read here without the viewer."""

    def __init__(self, page):
        text = page.read_text(encoding="utf-8")
        block = lambda name: re.search(f'id="{name}">([^<]*)<', text).group(1)
        unpacked = lambda data, letter, size: struct.unpack(f"<{len(base64.b64decode(data)) // size}{letter}", base64.b64decode(data))
        numbers = lambda name, letter, size: unpacked(block(name), letter, size)
        self.index = json.loads(block("ga-index"))
        self.times = numbers("ga-times", "d", 8)
        self.poses = numbers("ga-poses", "f", 4)
        self.points = numbers("ga-points", "f", 4)
        self.particles = len(self.index["particles"]["names"])
        self.stretches = {entry["body"]: unpacked(entry["rows"], "f", 4) for entry in self.index["stretches"]}
        self.moving = [i for i, body in enumerate(self.index["bodies"]) if not body["fixed"]]

    def pose(self, frame, body):
        at = 7 * (frame * len(self.index["bodies"]) + body)
        return self.poses[at:at + 7]

    def image(self, frame, body, point):
        """Where a point of a body is: by its rotor, after what is left of a matrix beside it."""
        pose = self.pose(frame, body)
        if body in self.stretches:
            rows = self.stretches[body][9 * frame:9 * frame + 9]
            point = [sum(rows[3 * i + k] * point[k] for k in range(3)) for i in range(3)]
        return [p + t for p, t in zip(pose, rotor_image(*pose[3:], point))]


def check_poses(browser, recording):
    worst, seen = 0.0, 0
    for frame in {0, len(recording.times) // 2, len(recording.times) - 1}:
        browser.script("gaViewer.setTime(arguments[0])", recording.times[frame])
        for body in range(min(len(recording.index["bodies"]), 20)):
            pose = recording.pose(frame, body)
            if not all(map(math.isfinite, pose)):
                continue
            for point in ([1, 0, 0], [0, 1, 0], [0, 0, 1]):
                shown = browser.script("return gaViewer.worldPoint(arguments[0], arguments[1])", body, point)
                size = 1 + max(map(abs, pose[:3]))
                worst = max([worst] + [abs(s - p) / size for s, p in zip(shown, recording.image(frame, body, point))])
                seen += 1
    # Both compute in f64 from the same stored numbers: a few roundings of 1.1e-16 each.
    check(worst < 1e-14, f"{seen} points of bodies where R x ~R puts them (worst {worst:.1e})")


def check_links(browser, recording):
    """Joints and springs end where the points of their bodies are."""
    links = recording.index["links"]
    if not links:
        return
    worst, seen = 0.0, 0
    for frame in {0, len(recording.times) // 2, len(recording.times) - 1}:
        browser.script("gaViewer.setTime(arguments[0])", recording.times[frame])
        for i, link in enumerate(links):
            for k, end in enumerate(link["ends"]):
                shown = browser.script("return gaViewer.linkEnd(arguments[0], arguments[1])", i, k)
                point = recording.image(frame, end["body"], end["point"]) if "body" in end else end["point"]
                worst = max([worst] + [abs(s - p) / (1 + abs(p)) for s, p in zip(shown, point)])
                seen += 1
    check(worst < 1e-14, f"{seen} ends of joints and springs on their bodies (worst {worst:.1e})")


def check_particles(browser, recording):
    if recording.particles == 0:
        return
    worst, seen = 0.0, 0
    every = max(recording.particles // 20, 1)
    for frame in {0, len(recording.times) // 2, len(recording.times) - 1}:
        browser.script("gaViewer.setTime(arguments[0])", recording.times[frame])
        for particle in range(0, recording.particles, every):
            at = 3 * (frame * recording.particles + particle)
            stored = recording.points[at:at + 3]
            if not all(map(math.isfinite, stored)):
                continue
            shown = browser.script("return gaViewer.particlePoint(arguments[0])", particle)
            worst = max([worst] + [abs(s - p) for s, p in zip(shown, stored)])
            seen += 1
    # At a frame's own time nothing is mixed: the same f32.
    check(worst == 0.0, f"{seen} particles where they were recorded")


def check_picking(browser, recording, out, name):
    """A click on a particle selects it and says where it is."""
    if recording.particles == 0:
        return
    browser.script("gaViewer.setTime(arguments[0])", recording.times[0])
    browser.after_drawing()
    found = browser.script("""
        const box = document.getElementById('view').getBoundingClientRect();
        for (let i = arguments[0] - 1; i >= 0; i--) {
          const [x, y] = gaViewer.particlePixel(i);
          if (x > 5 && y > 5 && x < box.width - 5 && y < box.height - 5) return [box.left + x, box.top + y];
        }
        return null;""", recording.particles)
    check(found is not None, "a particle is in the picture")
    browser.drag(found, found)
    browser.after_drawing()
    text = browser.script("const r = document.getElementById('readout'); return r.hidden ? '' : r.textContent")
    check(any(particle and particle in text for particle in recording.index["particles"]["names"]), f"a click selects: {text!r}")
    browser.screenshot(out / f"{name}-picked.png")


def bodies_only(browser):
    """The picture without contact marks: they come and go with the time even if no body moves."""
    for _ in range(2):
        browser.script("document.getElementById('show-contacts').click()")
        browser.after_drawing()
        if not browser.script("return document.getElementById('show-contacts').checked"):
            picture = browser.picture("#view")
    return picture


def check_slider(browser, recording, out, name):
    before = bodies_only(browser)
    check(len({p for row in pixels(before) for p in row}) > 30, "the picture is not blank")
    browser.screenshot(out / f"{name}-start.png")
    box = browser.script("const r = document.querySelector('#time').getBoundingClientRect(); return [r.left, r.top, r.width, r.height]")
    left, middle, y = box[0] + 8, box[0] + box[2] / 2, box[1] + box[3] / 2
    start, end = recording.times[0], recording.times[-1]
    if end == start:
        print("  skip  one moment only: nothing to move to")
        return
    browser.drag((left, y), (middle, y))
    browser.after_drawing()
    now = browser.script("return gaViewer.time()")
    check(abs(now - (start + end) / 2) < 0.05 * (end - start), f"the slider's middle is the time {now:.4g} s of {start:.4g} to {end:.4g} s")
    after = bodies_only(browser)
    browser.screenshot(out / f"{name}-middle.png")
    if recording.moving or recording.particles:
        share = changed_share(before, after)
        check(share > 1e-4, f"the picture changed with the time ({100 * share:.2f} % of its pixels)")


def check_playing(browser, recording):
    if recording.times[0] == recording.times[-1]:
        return
    browser.script("document.activeElement.blur(); gaViewer.setTime(arguments[0])", recording.times[0])
    browser.press(" ")
    check(browser.script("return gaViewer.playing"), "the space key plays")
    time.sleep(0.5)
    if browser.script("return gaViewer.playing"):
        browser.press(" ")
    check(not browser.script("return gaViewer.playing"), "the space key pauses")
    check(browser.script("return gaViewer.time()") > recording.times[0], "playing moved the time")


def check_quiet(browser):
    errors = [entry["message"] for entry in browser.log("browser") if entry["level"] == "SEVERE"]
    check(not errors, f"no error in the console {errors or ''}")
    sent = [json.loads(entry["message"])["message"] for entry in browser.log("performance")]
    urls = [m["params"]["request"]["url"] for m in sent if m["method"] == "Network.requestWillBeSent"]
    outside = [url[:80] for url in urls if not url.startswith(("file:", "data:"))]
    check(any(url.startswith("file:") for url in urls), "the browser's log of requests is on")
    check(not outside, f"nothing was requested from a network {outside or ''}")


def check_renderer(page, recording, out, renderer, any_renderer):
    print(f"{page.name}, {renderer}")
    with Browser() as browser:
        fragment = "#canvas2d" if renderer == "canvas2d" else ""
        browser.call("POST", "/url", {"url": page.as_uri() + fragment})
        limit = time.monotonic() + READY_S
        while not (title := browser.call("GET", "/title")).startswith(("ready: ", "error: ")) and time.monotonic() < limit:
            time.sleep(0.05)
        shown = " ".join(recording.index["scene"].split())
        check(" ".join(title.replace("\0", "\ufffd").split()) == f"ready: {shown}".strip(), f"the title is {title!r}")
        check(browser.script("return gaViewer.ready && gaViewer.frameCount") == len(recording.times), f"{len(recording.times)} frames")
        used = browser.script("return gaViewer.renderer")
        check(used == renderer or any_renderer, f"drawn by {used}")
        check_slider(browser, recording, out, f"{page.stem}-{renderer}")
        if recording.moving:
            check_poses(browser, recording)
        check_links(browser, recording)
        check_particles(browser, recording)
        check_picking(browser, recording, out, f"{page.stem}-{renderer}")
        check_playing(browser, recording)
        check_quiet(browser)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, help="folder for the screenshots; default: beside the page")
    parser.add_argument("--any-renderer", action="store_true", help="accept the fallback where WebGL2 is not available")
    arguments = parser.parse_args()
    page = arguments.page.resolve()
    out = (arguments.out or page.parent).resolve()
    out.mkdir(parents=True, exist_ok=True)
    recording = Recording(page)
    try:
        for renderer in ("webgl2", "canvas2d"):
            check_renderer(page, recording, out, renderer, arguments.any_renderer)
    except Failed as failure:
        print(f"  FAIL  {failure}")
        return 1
    except NoBrowser as reason:
        print(f"  no browser: {reason}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
