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
                "--disable-gpu",
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

    def console(self):
        return [entry["message"] for entry in self._send("POST", "/se/log", {"type": "browser"})]

    def screenshot(self, path):
        size = self.devtools("Page.getLayoutMetrics")["cssContentSize"]
        shot = self.devtools(
            "Page.captureScreenshot",
            captureBeyondViewport=True,
            clip={"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1},
        )
        path.write_bytes(base64.b64decode(shot["data"]))
