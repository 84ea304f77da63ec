# SPDX-License-Identifier: AGPL-3.0-or-later
"""Pages in chromium without a screen: their controls are used, and what was seen is told."""
import html
import json
import re
import shutil
import subprocess
import tempfile

MOST_BYTES = 25e6  # of a page
THERE = shutil.which("chromium") is not None
MISSING = "no chromium (Debian: apt-get install chromium)"
# Before all scripts of the page: faults and pictures that cannot be shown are kept, and what was drawn can be read.
BEFORE = """<script>
const faults = [];
addEventListener("error", (event) => faults.push(String(event.message)));
addEventListener("unhandledrejection", (event) => faults.push(String(event.reason)));
console.error = console.warn = (...words) => faults.push(words.join(" "));
const broken = () => [...document.images].filter((image) => !image.naturalWidth).map((image) => image.alt);
window.requestAnimationFrame = (call) => setTimeout(call, 16); // without a screen there are no frames
const plain = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, options) {
  return plain.call(this, kind, {...options, preserveDrawingBuffer: true});
};
</script>"""
# Behind them: what the page tells of itself where it has no picture that turns.
END = """<script>
addEventListener("load", () => {
  document.body.insertAdjacentHTML("beforeend", "<pre id=told></pre>");
  document.getElementById("told").textContent = JSON.stringify({faults, broken: broken(), width: innerWidth,
    needed: document.documentElement.scrollWidth});
});
</script>"""
# The same where it has one: uses the controls, and tells what the picture was after each.
PICTURE = """<script>
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
    document.getElementById("told").textContent = JSON.stringify({told, faults, broken: broken(), width: innerWidth,
      needed: document.documentElement.scrollWidth});
  };
  addEventListener("unhandledrejection", finish);
  // steps
  finish();
});
</script>"""
# All its controls but that of colours, and the colours, which a solved flow has.
HANDS = PICTURE.replace("  // steps\n", """  await look("home");
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
""")
COLOURS = PICTURE.replace("  // steps\n", """  for (const choice of one("[name=colour]")?.options ?? []) {
    put("[name=colour]", choice.value);
    await look(choice.textContent);
    told[choice.textContent].bars = figure.querySelectorAll("[data-bar]:not([hidden])").length;
  }
""")


def watched(source, page, behind):
    """Writes a page with what watches it into the file `page`."""
    page.write_text(source.read_text().replace("<style>", BEFORE + "<style>", 1).replace("</body>", behind + "</body>"))
    return page


def browse(page, width):
    """What a page that is watched tells of itself in a window of that width; what it wrote on the console."""
    with tempfile.TemporaryDirectory() as home:
        result = subprocess.run(
            ["chromium", "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
             f"--user-data-dir={home}", f"--window-size={width},900", "--virtual-time-budget=5000",
             "--enable-logging=stderr", "--dump-dom", page.as_uri()],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=300, check=False)
    found = re.search(r'<pre id="told">(.*?)</pre>', result.stdout, re.S)
    if not found:
        raise AssertionError(f"the page did not come to its end: {result.stderr[-2000:]}")
    return json.loads(html.unescape(found[1])), re.findall(r".*CONSOLE.*", result.stderr)


def fits_a_phone(test, source, page, behind):
    """A page that has no fault, is light and fits a phone's width; what it tells of itself there."""
    told, console = browse(watched(source, page, behind), 390)
    test.assertEqual((told["faults"], told["broken"], console), ([], [], []))
    test.assertLessEqual(told["width"], 500)
    test.assertLessEqual(told["needed"], told["width"])
    test.assertLess(source.stat().st_size, MOST_BYTES)
    return told
