"""Runs a small experiment and opens its report in a headless Chromium, wide and as a phone, light
and dark. The console has no message, everything is loaded, the heatmap shows a cell's numbers, and
drops seek the video.

The replay turns, zooms, plays, and its time is that of the curves.

    report_test.py TOUCHDOWN [--report REPORT.html] [--screenshots FOLDER]

Exit code 77: there is no Chromium here.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

import browser

SCENARIO = """name: step
terrain:
  pieces:
    - flat: {length: 3.0}
    - stairs: {count: 1, run: 3.0, rise: 0.25, nosing_radius: 0.025}
start: {x: 0.7}
velocity: [{time: 0.3, velocity: 0.5}]
end: {duration: 2.5}
perturbation: {velocity: 0.1, yaw: 0.05}
"""
EXPERIMENT = """name: "tiny"
seed: 3
simulators: [mujoco, bullet]
estimators: [robust, measurement_only]
fit: {scenarios: [step.yaml]}
test: {scenarios: [step.yaml], runs: 2}
noise: {torque: [0.0, 1.0], accelerometer: [0.0, 5.0]}
highlights: [{torque: 1.0, accelerometer: 5.0}]
intervals: {resamples: 50}
video: {enabled: true, width: 640, estimators: [robust, measurement_only]}
"""

LOADED = """
const waits = [];
for (const image of document.images) { image.loading = 'eager'; waits.push(image.decode()); }
for (const video of document.querySelectorAll('video')) {
  if (video.readyState < 2) waits.push(new Promise((good, bad) => {
    video.onloadeddata = good; video.onerror = () => bad(video.error.message);
  }));
}
Promise.all(waits).then(() => done('loaded'), (error) => done(String(error)));
"""

ACCESSIBLE = """
const wrong = [];
for (const image of document.images) if (!image.alt) wrong.push('image without alternative text');
for (const table of document.querySelectorAll('table')) {
  if (!table.caption) wrong.push('table without caption');
  for (const header of table.querySelectorAll('th')) if (!header.scope) wrong.push('header without scope');
  for (const row of table.tBodies[0].rows) if (!row.querySelector('th')) wrong.push('row without header');
}
const ids = [...document.querySelectorAll('[id]')].map((element) => element.id);
if (new Set(ids).size !== ids.length) wrong.push('an id twice');
for (const link of document.querySelectorAll('a[href^="#"]'))
  if (!document.getElementById(link.hash.slice(1))) wrong.push('a link to nowhere: ' + link.hash);
if (document.querySelectorAll('h1').length !== 1) wrong.push('not one main heading');
return wrong;
"""

# The contrast of every text with its background (WCAG: 4.5 for normal text).
CONTRAST = """
const canvas = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
const rgb = (colour) => { canvas.clearRect(0, 0, 1, 1); canvas.fillStyle = colour; canvas.fillRect(0, 0, 1, 1);
  return [...canvas.getImageData(0, 0, 1, 1).data]; };
const light = (c) => c.slice(0, 3).map((v) => v / 255).map((v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
  .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
const behind = (element) => { for (let e = element; e; e = e.parentElement) {
  const c = rgb(getComputedStyle(e).backgroundColor); if (c[3] > 0) return c; } return [255, 255, 255, 255]; };
const poor = new Set();
for (const element of document.querySelectorAll('p, a, h1, h2, h3, th, td, dt, dd, caption span, figcaption, button, small, summary, label, code, .interval, text')) {
  const style = getComputedStyle(element);
  const a = light(rgb(element instanceof SVGElement ? style.fill : style.color));
  const b = light(behind(element));
  const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  if (contrast < 4.5) poor.add(element.tagName + '.' + element.getAttribute('class') + ' ' + contrast.toFixed(2));
}
return [...poor];
"""

SEEK = """
const film = document.querySelector('.film'), video = film.querySelector('video'), drop = film.querySelector('.drop');
video.onseeked = () => done([video.currentTime, Number(drop.dataset.seek), video.duration]);
drop.click();
"""


def check(condition, message):
    if not condition:
        raise AssertionError(message)


def check_replay(page, touch):
    view, curves, overview = ".replay .view", ".replay .curves", ".replay .overview"
    set_time = ("const slider = document.querySelector('.replay .time'); slider.value = arguments[0];"
                "slider.dispatchEvent(new Event('input'));")

    def time():
        page.settle()
        return float(page.run("return document.querySelector('.replay .time').value"))

    def state():
        page.settle()
        return page.run("return document.querySelector('.replay .state').textContent")

    page.run("const poll = () => performance.getEntriesByName('replay').length ? done(0) : setTimeout(poll, 50); poll()")
    page.run(set_time, 0.2)
    first = page.picture(view)
    check(page.colours(first) > 200, "the view is one flat colour")
    check("ON THE GROUND" in state(), f"the run begins on the ground, not '{state()}'")
    first_curves = page.picture(curves)

    # The film's drops are found by other code: at the middle of each, the robot is in the air.
    for seek, end in page.run("return [...document.querySelectorAll('.drops ol:first-of-type .drop')]"
                              ".map((drop) => [drop.dataset.seek, drop.dataset.end])"):
        page.run(set_time, (float(seek) + 0.4 + float(end) - 0.4) / 2)
        later = page.picture(view)
        check("IN THE AIR" in state(), f"at {time()} s the view shows '{state()}'")
        check(page.changed(first, later) > 0.02, "another time, the same view")
        check(page.changed(first_curves, page.picture(curves)) > 0.02, "another time, the same curves")
    page.run(set_time, 0.2)
    check(page.changed(first, page.picture(view)) == 0, "the view at a time depends on earlier ones")

    page.press_at(view, [[(0, 0), (30, 4), (60, 8), (90, 10)]], "touch" if touch else "mouse")
    turned = page.picture(view)
    check(page.changed(first, turned) > 0.1, "dragging does not turn the view")
    page.click(".replay .reset")
    check(page.changed(first, page.picture(view)) == 0, "the view is not reset")
    if touch:
        page.press_at(view, [[(-20, 0), (-60, 0), (-110, 0)], [(20, 0), (60, 0), (110, 0)]], "touch")
    else:
        page.click(view)
        page.scroll_at(view, -300)
    check(page.changed(first, page.picture(view)) > 0.05, "pinch or wheel do not zoom")
    page.keys(view, "\ue011")  # Home
    check(page.changed(first, page.picture(view)) == 0, "Home does not reset the view")
    for key in ("\ue012", "\ue014", "\ue013", "\ue015", "+", "-"):  # arrow keys
        page.keys(view, key)
        check(page.changed(first, page.picture(view)) > 0.01, f"the key {key!r} does nothing")
        page.keys(view, "\ue011")

    page.run("document.querySelector('.replay select').value = '2';"
             "document.querySelector('.replay select').dispatchEvent(new Event('change'))")
    page.keys(view, " ")
    page.run("const poll = () => document.querySelector('.replay .time').value > 0.3 ? done(0) : setTimeout(poll, 50);"
             "poll()")
    page.click(".replay .play")
    stopped = time()
    page.run("setTimeout(() => done(0), 200)")
    check(time() == stopped, "a paused replay plays")

    page.run(set_time, 0)
    page.click('.replay [data-jump="flight"][data-step="1"]')
    takeoff = time()
    check(takeoff > 0, "no jump to a flight")

    def jumps(step):
        times = [time()]
        while len(times) < 100:
            page.click(f'.replay [data-jump="error"][data-step="{step}"]')
            if time() == times[-1]:
                break
            times.append(time())
        return times[1:]

    page.run(set_time, 0)
    errors = jumps(1)
    check(errors and errors == sorted(errors), f"jumps to errors lead to {errors}")
    back = jumps(-1)
    check(back[: len(errors) - 1] == errors[-2::-1], f"jumps back lead to {back}, not to {errors}")
    page.run(set_time, 1.2)
    before = page.picture(curves)
    page.press_at(curves, [[(0, 0), (20, 0), (40, 0)]], "touch" if touch else "mouse")
    check(page.changed(before, page.picture(curves)) > 0.01, "dragging the curves does nothing")
    before = page.picture(curves)
    page.click(".replay .estimators-shown label:nth-of-type(1) input")
    check(page.changed(before, page.picture(curves)) > 0, "an estimator cannot be hidden")
    page.click(".replay .estimators-shown label:nth-of-type(1) input")
    check(page.changed(before, page.picture(curves)) == 0, "a hidden estimator does not return")
    before = page.picture(overview)
    page.click(".replay .engines label:nth-of-type(2) input")
    check(page.changed(before, page.picture(overview)) > 0, "both engines have the same overview")
    page.click(".replay .engines label:nth-of-type(1) input")


def check_page(page, report, name, width, height, dark, touch, screenshots, must_be_filmed):
    page.open(report, width, height, dark, touch)
    check(page.run(LOADED) == "loaded", "not everything was loaded")
    check(page.run("return document.images.length") > 0, "no figure")
    filmed = page.run("return document.querySelectorAll('.film video').length") == 1
    check(filmed or not must_be_filmed, "no video")
    check(page.run(ACCESSIBLE) == [], page.run(ACCESSIBLE))
    check(page.run(CONTRAST) == [], f"poor contrast: {page.run(CONTRAST)}")
    overflow = page.run("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
    check(overflow <= 0, f"the page is {overflow} pixels wider than the window")

    readout = "return document.querySelector('.readout').textContent"
    before = page.run(readout)
    cell = ".map .cell"
    if touch:
        page.click(cell)
    else:
        page.hover(cell)
    text = page.run(readout)
    check(text != before and "success rate 0." in text and "[" in text, f"the heatmap shows '{text}'")
    page.keys(".map", "\ue014")  # arrow right
    check(page.run(readout) not in (text, before), "the arrow keys chose nothing")
    beside = page.run(
        "return [...document.querySelectorAll('.map')].filter((map) => {"
        "const picture = map.querySelector('img').getBoundingClientRect(), box = map.getBoundingClientRect();"
        "return ['left', 'top', 'width', 'height'].some((side) => Math.abs(picture[side] - box[side]) > 1.5);"
        "}).length")
    check(beside == 0, f"the cells of {beside} maps are not over their pictures")

    if filmed:
        at, asked, duration = page.run(SEEK)
        check(
            abs(at - asked) < 0.5 and 0 < asked < duration,
            f"seek to {asked} of {duration} s ended at {at} s",
        )
        page.run("document.querySelector('video').pause()")
    if page.run("return document.querySelectorAll('.replay').length"):
        check_replay(page, touch)
    else:
        check(not must_be_filmed, "no replay")
    overflow = page.run("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
    check(overflow <= 0, f"after the replay the page is {overflow} pixels wider than the window")
    if screenshots:
        page.run("scrollTo({top: 0, behavior: 'instant'})")
        page.screenshot(screenshots / f"report_{name}.png")
    messages = page.console()
    check(not messages, f"{name}: messages on the console: {messages}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("touchdown", type=pathlib.Path)
    parser.add_argument("--report", type=pathlib.Path)
    parser.add_argument("--screenshots", type=pathlib.Path)
    asked = parser.parse_args()
    if not browser.available():
        print("skipped: chromium and chromium-driver are not installed")
        return 77
    with tempfile.TemporaryDirectory(prefix="touchdown_") as scratch:
        folder = pathlib.Path(scratch)
        report = asked.report
        if report is None:
            (folder / "step.yaml").write_text(SCENARIO)
            (folder / "tiny.yaml").write_text(EXPERIMENT)
            subprocess.run(
                [asked.touchdown.resolve(), "run", "tiny.yaml", "--out", "run"], cwd=folder, check=True
            )
            report = folder / "run" / "report.html"
        with browser.Browser(folder / "profile") as page:
            for name, width, height, dark, touch in [
                ("desktop_light", 1400, 900, False, False),
                ("desktop_dark", 1400, 900, True, False),
                ("phone_light", 400, 844, False, True),
                ("phone_dark", 400, 844, True, True),
            ]:
                check_page(page, report.resolve(), name, width, height, dark, touch, asked.screenshots, not asked.report)
                print(name, "is good")
    return 0


if __name__ == "__main__":
    sys.exit(main())
