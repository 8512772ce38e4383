"""A headless Chromium, driven through chromedriver's WebDriver protocol with the standard library."""

import base64
import json
import re
import shutil
import subprocess
import urllib.error
import urllib.request


def available():
    return shutil.which("chromium") and shutil.which("chromedriver")


# Copies what a canvas shows into `window.pictures`, for `changed` and `colours`.
COPY = """
const canvas = document.querySelector(arguments[0]);
const pen = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
pen.drawImage(canvas, 0, 0);
window.pictures ??= [];
return window.pictures.push(pen.getImageData(0, 0, canvas.width, canvas.height).data) - 1;
"""

CHANGED = """
const [a, b] = [...arguments].map((i) => window.pictures[i]);
if (a.length !== b.length) return 1;
let count = 0;
for (let i = 0; i < a.length; i += 4) if ([0, 1, 2].some((k) => Math.abs(a[i + k] - b[i + k]) > 8)) ++count;
return 4 * count / a.length;
"""

COLOURS = """
const data = window.pictures[arguments[0]], seen = new Set();
for (let i = 0; i < data.length; i += 4) seen.add(data[i] << 16 | data[i + 1] << 8 | data[i + 2]);
return seen.size;
"""


class Browser:
    def __init__(self, profile):
        self.driver = subprocess.Popen(
            ["chromedriver", "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        )
        try:
            self.url = None
            for line in self.driver.stdout:
                if started := re.search(r"started successfully on port (\d+)", line):
                    self.url = f"http://127.0.0.1:{started[1]}/session"
                    break
            arguments = [
                "--headless=new",
                "--no-sandbox",  # root has no other way
                "--use-angle=swiftshader",  # WebGL without a graphics card
                "--enable-unsafe-swiftshader",
                "--disable-dev-shm-usage",
                "--mute-audio",
                "--autoplay-policy=no-user-gesture-required",
                f"--user-data-dir={profile}",
            ]
            answer = self._send(
                "POST",
                "",
                {
                    "capabilities": {
                        "alwaysMatch": {
                            "goog:chromeOptions": {"binary": shutil.which("chromium"), "args": arguments},
                            "goog:loggingPrefs": {"browser": "ALL"},
                        }
                    }
                },
            )
            self.url += "/" + answer["sessionId"]
        except BaseException:
            self.driver.kill()
            self.driver.wait()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self._send("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait()

    def _send(self, method, path, body=None):
        data = json.dumps(body).encode() if body is not None else None
        request = urllib.request.Request(
            self.url + path, data, {"Content-Type": "application/json"}, method=method
        )
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"].splitlines()[0]) from error

    def devtools(self, command, **parameters):
        return self._send("POST", "/goog/cdp/execute", {"cmd": command, "params": parameters})

    def open(self, path, width, height, dark=False, touch=False):
        self.devtools(
            "Emulation.setDeviceMetricsOverride",
            width=width, height=height, deviceScaleFactor=1, mobile=touch,
        )
        self.devtools(
            "Emulation.setEmulatedMedia",
            features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}],
        )
        self._send("POST", "/url", {"url": "file://" + str(path)})

    def run(self, script, *arguments):
        """What `script` returns; `done(value)` in a script that waits."""
        if "done(" in script:
            script = "const done = arguments[arguments.length - 1];" + script
            return self._send("POST", "/execute/async", {"script": script, "args": list(arguments)})
        return self._send("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def _element(self, selector):
        found = self._send("POST", "/element", {"using": "css selector", "value": selector})
        return next(iter(found.values()))

    def bring(self, selector):
        self.run(
            f"(e => e.closest('svg') ?? e)(document.querySelector({json.dumps(selector)}))"
            ".scrollIntoView({block: 'center', behavior: 'instant'})"
        )

    def click(self, selector):
        self.bring(selector)
        self._send("POST", f"/element/{self._element(selector)}/click", {})

    def hover(self, selector):
        element = {"element-6066-11e4-a52e-4f735466cecf": self._element(selector)}
        self.bring(selector)
        move = {"type": "pointerMove", "origin": element, "x": 0, "y": 0, "duration": 0}
        self._send("POST", "/actions", {"actions": [
            {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": [move]}
        ]})

    def keys(self, selector, text):
        self._send("POST", f"/element/{self._element(selector)}/value", {"text": text})

    def press_at(self, selector, moves, pointer="mouse"):
        """Presses one or two pointers in the middle of an element and moves each along its `moves`, (x, y) pairs
        relative to the middle, in steps."""
        element = {"element-6066-11e4-a52e-4f735466cecf": self._element(selector)}
        self.bring(selector)
        sources = []
        for number, path in enumerate(moves):
            actions = [
                {"type": "pointerMove", "origin": element, "x": x, "y": y, "duration": 20} for x, y in path
            ]
            actions.insert(1, {"type": "pointerDown", "button": 0})
            actions.append({"type": "pointerUp", "button": 0})
            sources.append({"type": "pointer", "id": f"{pointer} {number}",
                            "parameters": {"pointerType": pointer}, "actions": actions})
        self._send("POST", "/actions", {"actions": sources})

    def scroll_at(self, selector, down):
        element = {"element-6066-11e4-a52e-4f735466cecf": self._element(selector)}
        scroll = {"type": "scroll", "origin": element, "x": 0, "y": 0, "deltaX": 0, "deltaY": down, "duration": 0}
        self._send("POST", "/actions", {"actions": [{"type": "wheel", "id": "wheel", "actions": [scroll]}]})

    def console(self):
        """Messages on the console, without those of the software renderer about its own speed."""
        messages = [entry["message"] for entry in self._send("POST", "/se/log", {"type": "browser"})]
        return [message for message in messages if "GPU stall due to ReadPixels" not in message]

    def settle(self):
        """Waits until the page has drawn what it was asked to."""
        self.run("requestAnimationFrame(() => requestAnimationFrame(() => done(0)))")

    def picture(self, selector):
        """The number of a picture of what a canvas shows."""
        self.bring(selector)
        self.settle()
        return self.run(COPY, selector)

    def changed(self, before, after):
        """The share of pixels that differ by more than 8 of 255 in a channel."""
        return self.run(CHANGED, before, after)

    def colours(self, picture):
        return self.run(COLOURS, picture)

    def screenshot(self, path):
        size = self.devtools("Page.getLayoutMetrics")["cssContentSize"]
        shot = self.devtools(
            "Page.captureScreenshot",
            captureBeyondViewport=True,
            clip={"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1},
        )
        path.write_bytes(base64.b64decode(shot["data"]))
