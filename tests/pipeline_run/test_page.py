# SPDX-License-Identifier: AGPL-3.0-or-later
"""The report in a browser (chromium without a screen): no error on the console, the picture that turns answers to each
control, the page fits a phone, and is light. Skipped where there is no chromium."""
import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from cutwater import RUN, fresh

MOST_BYTES = 25e6
# Before all scripts of the page: faults are kept, and what was drawn can be read.
BEFORE = """<script>
const faults = [];
addEventListener("error", (event) => faults.push(String(event.message)));
addEventListener("unhandledrejection", (event) => faults.push(String(event.reason)));
console.error = console.warn = (...words) => faults.push(words.join(" "));
window.requestAnimationFrame = (call) => setTimeout(call, 16); // without a screen there are no frames
const plain = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, options) {
  return plain.call(this, kind, {...options, preserveDrawingBuffer: true});
};
</script>"""
# Behind them: uses the controls, and tells what the picture was after each.
BEHIND = """<script>
addEventListener("load", async () => {
  const figure = document.getElementById("view"), canvas = figure.querySelector("canvas"), told = {};
  const one = (selector) => figure.querySelector(selector);
  const gl = canvas.getContext("webgl");
  async function look(name) {
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    const pixels = new Uint8Array(4 * canvas.width * canvas.height);
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let ink = 0, sum = 0;
    for (let k = 0; k < pixels.length; k += 4) {
      ink += pixels[k] < 255 || pixels[k + 1] < 255 || pixels[k + 2] < 255;
      sum = (sum * 31 + pixels[k] + 7 * pixels[k + 1] + 61 * pixels[k + 2]) % 2147483647;
    }
    told[name] = {ink: 4 * ink / pixels.length, sum};
  }
  const put = (selector, value) => {
    const box = one(selector);
    if (box.type === "checkbox") box.checked = value; else box.value = value;
    box.dispatchEvent(new Event(box.dataset.part ? "change" : "input"));
  };
  const point = (kind, x, y, more) => canvas.dispatchEvent(
    new PointerEvent(kind, {clientX: x, clientY: y, pointerId: 1, buttons: 1, ...more}));
  const drag = (more) => {
    point("pointerdown", 100, 100);
    point("pointermove", 160, 130, more);
    point("pointerup", 160, 130);
  };
  const home = () => one("[data-view=home]").click();
  const finish = () => {
    document.body.insertAdjacentHTML("beforeend", "<pre id=told></pre>");
    document.getElementById("told").textContent = JSON.stringify({told, faults, width: innerWidth,
      needed: document.documentElement.scrollWidth});
  };
  addEventListener("unhandledrejection", finish);
  await look("home");
  for (const view of ["suction", "back", "side"]) { one(`[data-view=${view}]`).click(); await look(view); }
  home(); await look("home again");
  drag(); await look("turned"); home();
  drag({shiftKey: true}); await look("shifted"); home();
  canvas.dispatchEvent(new WheelEvent("wheel", {deltaY: 400, cancelable: true})); await look("farther"); home();
  canvas.dispatchEvent(new KeyboardEvent("keydown", {key: "ArrowLeft"})); await look("key"); home();
  point("pointerdown", 100, 100); point("pointerdown", 200, 100, {pointerId: 2});
  point("pointermove", 130, 100, {pointerId: 1}); point("pointermove", 170, 100, {pointerId: 2});
  point("pointerup", 130, 100); point("pointerup", 170, 100, {pointerId: 2}); await look("pinched"); home();
  put("[name=cut]", "z"); await look("cut");
  put("[name=flip]", true); await look("other side");
  put("[name=place]", "0"); await look("cut at the end");
  put("[name=cut]", ""); await look("whole again");
  put("[data-part]", false); await look("part off");
  put("[data-part]", true); await look("part on");
  for (const zone of figure.querySelectorAll("[data-zone]")) {
    zone.click();
    if ([...zone.closest("fieldset").querySelectorAll("[data-part]")].some((box) => box.checked)) zone.click();
  }
  await look("all off");
  finish();
});
</script>"""


def browse(page, width):
    """What the page tells of itself in a window of that width."""
    with tempfile.TemporaryDirectory() as home:
        result = subprocess.run(
            ["chromium", "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
             f"--user-data-dir={home}", f"--window-size={width},900", "--virtual-time-budget=60000",
             "--enable-logging=stderr", "--dump-dom", page.as_uri()],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=300, check=False)
    found = re.search(r'<pre id="told">(.*?)</pre>', result.stdout, re.S)
    if not found:
        raise AssertionError(f"the page did not come to its end: {result.stderr[-2000:]}")
    return json.loads(html.unescape(found[1])), re.findall(r".*CONSOLE.*", result.stderr)


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.source = RUN / "report/index.html"
        text = cls.source.read_text()
        page = fresh("page") / "index.html"
        page.write_text(text.replace("<style>", BEFORE + "<style>", 1).replace("</body>", BEHIND + "</body>"))
        cls.page = page
        cls.all, cls.console = browse(page, 1400)

    def test_no_fault(self):
        self.assertEqual(self.all["faults"], [])
        self.assertEqual(self.console, [])

    def test_the_picture_answers_to_each_control(self):
        told = self.all["told"]
        home = told["home"]
        self.assertGreater(home["ink"], 0.1)
        self.assertEqual(told["home again"], home)
        for name in ("suction", "back", "side", "turned", "shifted", "farther", "key", "pinched", "cut", "part off"):
            self.assertNotEqual(told[name]["sum"], home["sum"], name)
        for name in ("farther", "pinched", "cut"):
            self.assertLess(told[name]["ink"], home["ink"], name)
        self.assertNotEqual(told["cut"]["sum"], told["other side"]["sum"])
        self.assertAlmostEqual(told["cut at the end"]["ink"], home["ink"], delta=0.01)  # all lies on its other side
        self.assertEqual(told["whole again"], home)
        self.assertEqual(told["part on"], home)
        self.assertEqual(told["all off"]["ink"], 0)

    def test_it_fits_a_phone(self):
        narrow, _ = browse(self.page, 390)
        self.assertEqual(narrow["faults"], [])
        self.assertLessEqual(narrow["width"], 500)
        self.assertLessEqual(narrow["needed"], narrow["width"])
        self.assertGreater(narrow["told"]["home"]["ink"], 0.03)

    def test_it_is_light(self):
        self.assertLess(os.path.getsize(self.source), MOST_BYTES)


if __name__ == "__main__":
    if not shutil.which("chromium"):
        print("skipped: no chromium (Debian: apt-get install chromium)")
        sys.exit(77)
    unittest.main()
