// The studio as people use it, in Chromium.
//
//     node tests/studio/run_studio.mjs build/release/apps/ombre/ombre chromium [--pictures FOLDER]
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { appendFileSync, copyFileSync, existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, realpathSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { gunzipSync, inflateSync } from "node:zlib";
import { launch, ombre, require, runChecks, serve, source, stop, token } from "./studio_server.mjs";

const axeSource = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

const folder = mkdtempSync(join(tmpdir(), "ombre-studio-"));
const file = join(folder, "ball.vcad");
const script = `// A ball, graded from red to blue.
radius = 12;  // [5:20]
fgrade(["0.5 + x / 40", "0.5 - x / 40"], [red, blue]) sphere(radius);
`;
writeFileSync(file, script);
writeFileSync(join(folder, "box.scad"), "width = 4; // [1:9]\ncolor(\"red\") cube([width, 3, 2]);\n");
for (const name of ["bent_beam.vtu", "two_lobes.nrrd"]) copyFileSync(join(source, "examples/models", name), join(folder, name));
writeFileSync(join(folder, "history.csv"), "round,elements,change,greatest von Mises stress [MPa]\n1,256,,13.5\n2,256,0.25,11.75\n3,256,0.03125,11.5\n");
writeFileSync(join(folder, "drop.py"), "import ombre\nroot = ombre.sphere(3, 'blue')\n");

// A brick of 100 mm3, whose edges are shortest where it is a cube.
writeFileSync(join(folder, "brick.vcad"), "a = 3;\nb = 8;\necho(edges = a + b + 100 / (a * b));\nrectprism([a, b, 100 / (a * b)], red);\n");

// From -10 on the left to 10 on the right.
writeFileSync(join(folder, "warm.vcad"), 'attribute("heat", "x", unit="K") cube(20, red);\n');

const solid = (side) => `OFF\n4 4 0\n0 0 0\n${side} 0 0\n0 ${side} 0\n0 0 ${side}\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n`;
writeFileSync(join(folder, "small.off"), solid(4));
writeFileSync(join(folder, "picked.vcad"), 'shape = "small.off";\nother = "";  // [*.off, *.obj]\nversion = "no.file";\nmesh(shape, red);\n');

let server;
async function startServer(port = 0, key = token) {
  const started = await serve(file, port, key);
  server = started.child;
  return started.url;
}
const stopServer = (signal) => stop(server, signal);

const url = await startServer();
const port = new URL(url).port;
const browser = await launch().catch(async (error) => {
  await stopServer("SIGINT");
  rmSync(folder, { recursive: true, force: true });
  console.log(String(error).split("\n").slice(0, 4).join("\n"));
  process.exit(1);
});
const context = await browser.newContext({ viewport: { width: 1400, height: 860 } });
context.setDefaultTimeout(120000); // what hangs ends at last; a busy machine is no failure
const page = await context.newPage();
const complaints = [];
page.on("pageerror", (error) => complaints.push(error.message));
await context.route("**", (route) => {
  const { hostname } = new URL(route.request().url());
  if (hostname !== "127.0.0.1") complaints.push(`the page sent a request to ${hostname}`);
  route.continue();
});

const pictures = process.argv.includes("--pictures") ? process.argv.at(-1) : "";
const picture = (name, of = page) => pictures && of.screenshot({ path: join(pictures, `${name}.png`) });
const status = (what, of = page) => of.waitForSelector(`.status${what}`);
// Playwright's own way evaluates texts, which the page's policy forbids.
const until = async (isSo, argument) => {
  for (let n = 0; n < 2400; ++n) {
    if (await page.evaluate(isSo, argument)) return;
    await page.waitForTimeout(50);
  }
  assert.fail(`in vain: ${isSo}`);
};
const editor = page.locator(".cm-content");
const isReady = (view, more = "") => page.waitForSelector(`.${view} canvas[data-state=ready]${more}`);
const onDisk = () => readFileSync(file, "utf8");
const untilOnDisk = async (part) => {
  for (let n = 0; n < 2400 && !onDisk().includes(part); ++n) await new Promise((done) => setTimeout(done, 50));
  assert.ok(onDisk().includes(part), `${part} is not in ${onDisk()}`);
};
const fromMenu = async (menu, action, of = page) => {
  await of.click(`header summary:text-is('${menu}')`);
  await of.click(`header .actions button:text-is('${action}')`);
};
const openInList = (name) => page.selectOption("select.file", name);
const untilLonger = async (path, size) => {
  const length = () => (existsSync(path) ? readFileSync(path).length : 0);
  for (let n = 0; n < 2400 && length() <= size; ++n) await new Promise((done) => setTimeout(done, 50));
  assert.ok(length() > size, `${path} has ${length()} bytes`);
};
const untilOnDiskIs = async (text) => {
  for (let n = 0; n < 2400 && onDisk() !== text; ++n) await new Promise((done) => setTimeout(done, 50));
  assert.equal(onDisk(), text);
};
const type = async (text, of = page) => {
  await of.locator(".cm-content").click();
  await of.keyboard.press("Control+End");
  await of.keyboard.insertText(text);
};
const alphaInMiddle = (view) =>
  page.evaluate((name) => {
    const canvas = document.querySelector(`.${name} canvas`);
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
    copy.drawImage(canvas, 0, 0);
    return [...copy.getImageData(canvas.width >> 1, canvas.height >> 1, 1, 1).data];
  }, view);

// Starts a job of the design for the printer that is chosen, in layers so thin that it goes on until it is stopped.
async function startLongJob(name, height) {
  const heightInput = page.locator(".option-layer-height input");
  if (!(await heightInput.isVisible())) await page.click("summary:has-text('More options')");
  await heightInput.fill(height);
  await page.keyboard.press("Enter");
  await page.fill(".panel label:has-text('Folder') input", name);
  await page.click("button.main");
}
async function resetLayerHeight() {
  await page.fill(".option-layer-height input", "");
  await page.keyboard.press("Enter");
}
async function untilFile(path) {
  for (let n = 0; n < 24000 && !existsSync(path); ++n) await new Promise((done) => setTimeout(done, 5));
  assert.ok(existsSync(path), `in vain: ${path}`);
}

// What axe finds, a line for each rule.
async function violations() {
  await page.evaluate(axeSource);
  const found = await page.evaluate(() => axe.run());
  return found.violations.map((v) => `${v.id} at ${v.nodes.map((n) => n.html.slice(0, 120)).join(" and ")}`);
}

// The pixels of a PNG of 8 bits, RGBA; what the printer of this test gets.
function pixelsOf(path) {
  const bytes = readFileSync(path);
  const width = bytes.readUInt32BE(16), height = bytes.readUInt32BE(20);
  assert.deepEqual([bytes[24], bytes[25]], [8, 6]);
  const parts = [];
  for (let at = 8; at < bytes.length; at += 12 + bytes.readUInt32BE(at))
    if (bytes.toString("latin1", at + 4, at + 8) === "IDAT") parts.push(bytes.subarray(at + 8, at + 8 + bytes.readUInt32BE(at)));
  const raw = inflateSync(Buffer.concat(parts)), stride = 4 * width, rows = Buffer.alloc(stride * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (stride + 1)];
    for (let x = 0; x < stride; ++x) {
      const a = x < 4 ? 0 : rows[y * stride + x - 4], b = y === 0 ? 0 : rows[(y - 1) * stride + x], c = x < 4 || y === 0 ? 0 : rows[(y - 1) * stride + x - 4];
      const p = a + b - c, pa = Math.abs(p - a), pb = Math.abs(p - b), pc = Math.abs(p - c);
      const guess = [0, a, b, (a + b) >> 1, pa <= pb && pa <= pc ? a : pb <= pc ? b : c][filter];
      rows[y * stride + x] = raw[y * (stride + 1) + 1 + x] + guess;
    }
  }
  return { width, height, at: (x, y) => [...rows.subarray(y * stride + 4 * x, y * stride + 4 * x + 4)] };
}

const checks = {
  async "opens the design and draws it"() {
    await page.goto(url);
    await isReady("surface");
    assert.equal(new URL(page.url()).search, ""); // the token is not left in the address
    assert.equal((await alphaInMiddle("surface"))[3], 255);
    assert.match(await editor.innerText(), /graded from red to blue/);
  },

  async "tells mistakes while one types, and keeps the last picture"() {
    const before = await page.getAttribute(".surface canvas", "data-design");
    await type("spher(2);");
    await page.waitForSelector('.problems[data-errors="1"]');
    await status("[data-old=true]");
    assert.match(await page.innerText(".problems"), /did you mean "sphere"/);
    assert.match(await page.innerText(".problems .place"), /^4:1/);
    await page.waitForSelector(".cm-lintRange-error");
    await page.waitForSelector(".oldmark");
    assert.equal((await alphaInMiddle("surface"))[3], 255);
    assert.equal(await page.getAttribute(".surface canvas", "data-design"), before);
    await picture("error");
    await page.keyboard.press("Control+z");
    await page.waitForSelector('.problems[data-errors="0"]');
    await untilOnDiskIs(script);
    await status("[data-old=false][data-saved=saved]");
  },

  async "completes names from the reference"() {
    await type("cyl");
    await page.keyboard.press("Control+Space");
    await page.waitForSelector(".cm-tooltip-autocomplete li:has-text('cylinder')");
    await page.waitForSelector(".cm-completionInfo:has-text('Cylinder along z')");
    await page.keyboard.press("Escape");
    for (let n = 0; n < 3; ++n) await page.keyboard.press("Backspace");
    await untilOnDiskIs(script);
    await status("[data-old=false][data-saved=saved]");
  },

  async "shows the reference's page of what the pointer is on"() {
    await editor.locator(".tok-typeName, .tok-keyword, span", { hasText: /^fgrade$/ }).first().hover();
    await page.waitForSelector(".cm-tooltip-hover:has-text('fgrade')");
    await page.mouse.move(5, 5);
    await page.waitForSelector(".cm-tooltip-hover", { state: "detached" });
  },

  async "writes a call of a node from its form"() {
    await page.click("#tab-reference");
    await page.click(".node-cylinder > summary");
    const field = (name) => page.locator(".node-cylinder .nodeform label", { has: page.locator(`span:text-matches("^${name}( |$)")`) });
    await field("radius").locator("input").fill("2");
    await field("height").locator("input").fill("7 + x");
    await field("material").locator("input").fill("red");
    await page.click(".node-cylinder .nodeform button");
    await untilOnDisk(`${script}\ncylinder(radius = 2, height = 7 + x, material = "red");\n`);
    assert.equal(await editor.evaluate((element) => element.ownerDocument.querySelectorAll(".node-sphere .nodeform").length), 0);
    await page.click("#tab-variables");
    await editor.click();
    await page.keyboard.press("Control+a");
    await page.keyboard.insertText(script);
    await untilOnDiskIs(script);
    await status("[data-old=false][data-saved=saved]");
  },

  async "puts lines in their places"() {
    const crooked = "translate(30, 0, 0) union() {\nsphere(1, red);\n      }";
    await type(crooked);
    await untilOnDisk(crooked);
    await page.keyboard.press("Shift+Alt+F");
    await untilOnDisk("translate(30, 0, 0) union() {\n  sphere(1, red);\n}\n");
    await page.keyboard.press("Control+z"); // undoes the format alone
    await untilOnDisk(crooked);
    await page.keyboard.press("Control+a");
    await page.keyboard.insertText(script);
    await untilOnDiskIs(script);
    await status("[data-old=false][data-saved=saved]");
  },

  async "a slider changes the design, and the camera stays"() {
    const bar = await page.innerText(".surface .scalebar");
    const before = await page.getAttribute(".surface canvas", "data-design");
    await page.focus("#variable-radius");
    await page.keyboard.press("ArrowRight");
    await until((old) => document.querySelector(".surface canvas").dataset.design !== old, before);
    assert.equal(await page.innerText(".surface .scalebar"), bar);
    await page.click("text=Write into the script");
    await untilOnDisk("radius = 13;");
    await page.fill("[aria-label='radius, exactly']", "12.5");
    await page.click("text=Write into the script");
    await untilOnDisk("radius = 12.5;");
  },

  async "keeps presets beside the script"() {
    const presetsFile = join(folder, "ball.presets.json");
    const setRadius = (value) => page.fill("[aria-label='radius, exactly']", value);
    const radius = () => page.inputValue("[aria-label='radius, exactly']");
    const savePreset = async (name, button) => {
      await page.click("text=Save as a preset");
      await page.fill("[aria-label='Name of the preset']", name);
      await page.click(`.presets button:text-is('${button}')`);
      await page.waitForSelector("text=Save as a preset");
    };
    await setRadius("7");
    await savePreset("small", "Save");
    await setRadius("18.5");
    await page.waitForSelector(".preset option:has-text('small (changed)')", { state: "attached" });
    await savePreset("large", "Save");
    assert.deepEqual(JSON.parse(readFileSync(presetsFile)), { parameterSets: { small: { radius: "7" }, large: { radius: "18.5" } }, fileFormatVersion: "1" });
    const before = await page.getAttribute(".surface canvas", "data-design");
    await page.selectOption(".preset", "small");
    assert.equal(await radius(), "7");
    await until((old) => document.querySelector(".surface canvas").dataset.design !== old, before);
    await setRadius("8");
    await savePreset("small", "Replace");
    assert.equal(JSON.parse(readFileSync(presetsFile)).parameterSets.small.radius, "8");
    await picture("presets");
    await page.selectOption(".preset", "large");
    assert.equal(await radius(), "18.5");
    await page.click("text=Delete preset");
    await until(() => document.querySelectorAll(".preset option").length === 2);
    assert.equal(JSON.parse(readFileSync(presetsFile)).parameterSets.large, undefined);
    writeFileSync(presetsFile, "mine");
    await page.reload();
    await page.waitForSelector(".presets:has-text('ball.presets.json is no file of presets')");
    assert.ok(await page.isDisabled("text=Save as a preset"));
    assert.equal(readFileSync(presetsFile, "utf8"), "mine");
    rmSync(presetsFile);
    await page.focus(".preset");
    await page.waitForSelector("button:not([disabled]):has-text('Save as a preset')");
    await isReady("surface");
    assert.equal(await radius(), "18.5"); // what a slider says survives as well
    await page.click("button:text-is('Reset')");
    assert.equal(await radius(), "12.5");
    await status("[data-old=false][data-busy=false]");
    await isReady("surface");
  },

  async "opacity shows through"() {
    await page.click("#tab-materials");
    await isReady("surface");
    for (const name of ["red", "blue"]) {
      await page.focus(`#opacity-${name}`);
      await page.keyboard.press("Home");
    }
    await until(() => document.querySelector(".surface canvas").dataset.state === "ready");
    assert.ok((await alphaInMiddle("surface"))[3] < 30);
    await page.click("text=Reset opacities");
    await page.click("text=Measure volumes");
    await page.waitForSelector(".material .amount");
    assert.match(await page.innerText(".panel"), /8\.1\d\d cm³ in all/); // 4/3 pi 12.5^3 is 8181 mm³
  },

  async "compares with a marked version"() {
    await page.click("text=Mark this version");
    await page.click("#tab-variables");
    const before = await page.getAttribute(".surface canvas", "data-design");
    await page.fill("[aria-label='radius, exactly']", "13.5");
    await until((old) => document.querySelector(".surface canvas").dataset.design !== old, before);
    await page.click("#tab-materials");
    await page.click("text=Compare");
    await page.waitForSelector(".versions table");
    const cells = await page.locator(".versions td").allInnerTexts(); // 4/3 pi (13.5^3 - 12.5^3) is 2125 mm³
    assert.match(cells[0], /^2\.1\d\d cm³/);
    assert.match(cells[1], /^0(\.0*)? mm³/);
    assert.match(cells[3], /cm³/);
    await page.click("text=Forget the mark");
    await page.click("#tab-variables");
    await page.click("button:text-is('Reset')");
    await page.click("#tab-materials");
  },

  async "cuts open"() {
    const whole = await alphaInMiddle("surface");
    await page.selectOption(".surface .cut", "y<");
    await isReady("surface");
    await page.selectOption(".surface .cut", "box"); // the lower quarter: its corner is in the middle
    await isReady("surface");
    await page.focus("[aria-label='Box, z to']");
    for (let n = 0; n < 40; ++n) await page.keyboard.press("ArrowLeft");
    await isReady("surface");
    assert.equal((await alphaInMiddle("surface"))[3], 0);
    await page.selectOption(".surface .cut", "wedge"); // towards the eye: a face of the inside is seen
    await isReady("surface");
    assert.notDeepEqual(await alphaInMiddle("surface"), whole);
    await picture("wedge");
    await page.check("text=Perspective");
    await isReady("surface");
    assert.equal((await alphaInMiddle("surface"))[3], 255);
    await page.click("#tab-volume");
    await isReady("volume");
    await page.selectOption(".volume .cut", "box");
    assert.ok((await alphaInMiddle("volume"))[3] < 255);
    await page.selectOption(".volume .cut", "");
    await page.click("#tab-surface");
    await page.uncheck("text=Perspective");
    await isReady("surface");
  },

  async "shows the inside by rays"() {
    await page.click("#tab-volume");
    await isReady("volume");
    assert.ok((await alphaInMiddle("volume"))[3] > 200);
    await picture("volume");
  },

  async "opacity by an attribute shows what has a value"() {
    await page.selectOption("select.file", "warm.vcad");
    await page.waitForSelector(".volume select option[value=heat]", { state: "attached" });
    await page.selectOption(".volume select:has(option[value='32'])", "32");
    await page.selectOption(".volume select:has(option[value=heat])", "heat");
    await isReady("volume", "[data-by=heat]");
    await page.selectOption(".volume .viewbar select >> nth=0", "front");
    const columns = () =>
      page.evaluate(() => {
        const canvas = document.querySelector(".volume canvas");
        const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
        copy.drawImage(canvas, 0, 0);
        return [-0.25, 0.25].map((share) => copy.getImageData((canvas.width >> 1) + share * canvas.height, canvas.height >> 1, 1, 1).data[3]);
      });
    const points = page.locator(".transfer [role=slider]");
    assert.equal(await points.count(), 2);
    await points.nth(0).focus();
    await page.keyboard.press("Shift+ArrowDown"); // cold is clear
    assert.match(await points.nth(0).getAttribute("aria-valuetext"), /, opacity 0\.00$/);
    await points.nth(1).focus();
    await page.keyboard.press("Shift+ArrowUp"); // hot is opaque
    await page.click("text=Add a point");
    assert.equal(await points.count(), 3);
    const box = await page.locator(".transfer svg").boundingBox();
    await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.4 * box.width, box.y + box.height);
    await page.mouse.up();
    assert.match(await points.nth(1).getAttribute("aria-valuetext"), /^heat -(1\.9|2\.0).*, opacity 0\.00$/); // what is colder is clear
    let [cold, hot] = [255, 0];
    for (let n = 0; n < 2400 && !(cold === 0 && hot > 200); ++n) {
      await page.waitForTimeout(50); // the picture follows the curve
      [cold, hot] = await columns();
    }
    assert.ok(cold === 0 && hot > 200, `${cold} and ${hot}`);
    await picture("transfer");
    await page.keyboard.press("Delete");
    assert.equal(await points.count(), 2);
    assert.deepEqual(await violations(), []);
    await page.selectOption("select.file", "ball.vcad");
    await isReady("volume", "[data-by='']");
    await page.selectOption(".volume select:has(option[value='32'])", "64");
  },

  async "the graph leads to the script"() {
    await page.click("#tab-graph");
    await page.waitForSelector(".graph img[alt='What sphere makes']");
    await until(() => [...document.querySelectorAll(".graph img")].every((image) => image.naturalWidth >= 48));
    assert.equal(await page.innerText(".graph .node:has-text('fgrade') .outputs"), "→ solid");
    assert.equal(await page.innerText(".graph li:has(> .port) > .port >> nth=0"), "solid: solid");
    assert.match(await page.innerText(".graph li:has(> .node:has-text('sphere')) > ul .free >> nth=-1"), /radius: number or field/);
    await picture("graph");
    assert.deepEqual(await violations(), []);
    await page.click(".graph .node:has-text('sphere')");
    assert.equal(await page.evaluate(() => getSelection().toString().slice(0, 6)), "sphere");
  },

  async "slides through layers, and probes pixels"() {
    await page.click("#tab-slices");
    await page.selectOption(".slices .printer", "j750");
    await isReady("slices");
    await page.focus(".slices input[type=range]");
    for (let n = 0; n < 5; ++n) await page.keyboard.press("ArrowRight");
    const layer = await page.inputValue(".slices input[type=range]");
    await isReady("slices", `[data-layer="${layer}"]`);
    await page.focus(".slices canvas");
    for (let n = 0; n < 8 && (await page.getAttribute(".slices canvas", "data-level")) !== "0"; ++n) {
      await page.keyboard.press("+");
      await isReady("slices");
    }
    for (let n = 0; n < 5; ++n) await page.keyboard.press("+"); // so that a voxel is several pixels of the screen
    await isReady("slices");
    const box = await page.locator(".slices canvas").boundingBox();
    for (let n = 0; n < 12; ++n) {
      const place = { x: box.width * (0.3 + 0.03 * n), y: box.height * (0.7 - 0.03 * n) };
      await page.click(".slices canvas", { position: place });
      await until((old) => ![undefined, old].includes(document.querySelector(".probe")?.dataset.voxel), probed.at(-1)?.voxel);
      const { voxel, material } = await page.evaluate(() => ({ ...document.querySelector(".probe").dataset }));
      const shown = await page.evaluate(({ x, y }) => {
        const canvas = document.querySelector(".slices canvas");
        const scale = canvas.width / canvas.clientWidth;
        const around = canvas.getContext("2d").getImageData(Math.floor(x * scale) - 1, Math.floor(y * scale) - 1, 3, 3).data;
        return Array.from({ length: 9 }, (_, k) => around.slice(4 * k, 4 * k + 4).join());
      }, place);
      probed.push({ voxel, material, shown });
    }
    await picture("slices");
    assert.match(await page.innerText(".probe .calls"), /^sphere line 3\s+fgrade line 3$/);
    await page.click(".probe .calls button:has-text('fgrade')");
    assert.equal(await page.evaluate(() => getSelection().toString().slice(0, 6)), "fgrade");
  },

  async "estimates jobs, also in the middle of the tray"() {
    await page.click("#tab-export");
    await page.selectOption(".place", "center");
    await page.waitForSelector(".panel:has-text('926 layers of 11575 × 4606 pixels')");
    await page.selectOption(".place", "");
    await page.waitForSelector(".panel:has-text('926 layers of 591')"); // 25 mm
    await page.click("summary:has-text('More options')");
    await page.fill(".option-layer-height input", "0.5");
    await page.keyboard.press("Enter");
    await page.waitForSelector(".panel:has-text('50 layers of 591')");
    assert.match(await page.textContent(".panel details:has-text('command line') pre"), / --printer=j750 --layer-height=0\.5 /);
    assert.deepEqual(await violations(), []);
    await picture("options");
    await page.fill(".option-layer-height input", "thin");
    await page.keyboard.press("Enter");
    await page.waitForSelector(".panel .error:has-text('thin')");
    await page.fill(".option-layer-height input", "");
    await page.keyboard.press("Enter");
    await page.waitForSelector(".panel:has-text('926 layers of 591')");
    await page.click("text=Estimate");
    await page.waitForSelector(".estimate");
    assert.match(await page.innerText(".estimate"), /^About .* s, .* of images, at most .* of memory$/);
    await picture("estimate");
  },

  async "slices for a printer, pauses and goes on"() {
    await page.click("#tab-export");
    const slow = (state) => page.waitForSelector(`[data-folder=slow_slices][data-state=${state}]`);
    await startLongJob("slow_slices", "0.0001");
    await slow("working");
    await page.click("[data-folder=slow_slices] >> text=Pause");
    await slow("paused");
    assert.ok(existsSync(join(folder, "slow_slices/job.json")));
    await page.click("[data-folder=slow_slices] >> text=Resume");
    await slow("working");
    await page.click("[data-folder=slow_slices] >> text=Pause");
    await slow("paused");
    await resetLayerHeight();
    await page.fill(".panel label:has-text('Folder') input", "ball_slices");
    await page.click("button.main");
    await page.waitForSelector("[data-folder=ball_slices][data-state=done]");
    const job = JSON.parse(readFileSync(join(folder, "ball_slices/job.json"), "utf8"));
    assert.ok(job.totals);
    const [z] = [...new Set(probed.map((p) => p.voxel.split(",")[2]))];
    const layer = pixelsOf(join(folder, "ball_slices", `slice_${z.padStart(5, "0")}.png`));
    const colours = { red: [255, 0, 0, 255], blue: [0, 80, 255, 255], void: [0, 0, 0, 0] };
    for (const { voxel, material, shown } of probed) {
      const [i, j] = voxel.split(",").map(Number);
      assert.deepEqual(layer.at(i, layer.height - 1 - j), colours[material], `voxel ${voxel}`);
      assert.ok(shown.includes(colours[material].join()), `the page shows voxel ${voxel} as ${shown[4]}`);
    }
    assert.ok(new Set(probed.map((p) => p.material)).size > 1);
    await picture("job");
  },

  async "runs jobs of every kind"() {
    await page.click("#tab-jobs");
    const job = (name, state) => page.waitForSelector(`[data-folder="${name}"][data-state=${state}]`);
    const option = async (name, value) => {
      const input = page.locator(`.panel .option-${name} input, .panel .option-${name} select`);
      if (!(await input.isVisible())) await page.click(".panel summary:has-text('More options')");
      if ((await input.getAttribute("type")) === "checkbox") return input.check();
      if ((await input.evaluate((element) => element.tagName)) === "SELECT") return input.selectOption(value);
      await input.fill(value);
      await input.press("Tab");
    };
    const start = async (kind, options) => {
      await page.selectOption("select.kind", kind);
      await page.waitForSelector(`.panel button[type=submit]:has-text("Start ${kind}")`);  // the form is the kind's
      for (const [name, value] of Object.entries(options)) await option(name, value);
      await page.click(".panel button[type=submit]");
    };
    await start("mesh", { output: "ball.3mf", tolerance: "0.2", by: "whole" });
    await job("ball.3mf", "done");
    assert.equal(readFileSync(join(folder, "ball.3mf")).subarray(0, 2).toString(), "PK");
    await start("voxels", { output: "ball.nrrd", voxel: "1", what: "distance" });
    await job("ball.nrrd", "done");
    assert.match(readFileSync(join(folder, "ball.nrrd"), "latin1").slice(0, 400), /type: float[^]*sizes: 2[4-9] 2[4-9] 2[4-9]/);
    const study = JSON.stringify({ materials: { red: { modulus_mpa: 2000, poissons_ratio: 0.3 }, blue: { modulus_mpa: 1000, poissons_ratio: 0.3 } },
      supports: [{ on: "zmin", fix: "xyz" }], loads: [{ on: "zmax", force_n: [0, 0, -10] }] });
    await start("fea", { output: "ball.vtu", study, cell: "3", solve: true });
    await job("ball.vtu", "done");
    assert.match(readFileSync(join(folder, "ball.vtu"), "latin1").slice(0, 4000), /displacement/i);
    await start("probe", { at: "0,0,0" });
    await page.waitForSelector("[data-kind=probe][data-state=done] pre:has-text('inside: true')");
    await start("mesh", { output: "../out.stl", tolerance: "", by: "" });
    await page.waitForSelector(".panel .error[role=alert]");
    // A search of two variables.
    const search = JSON.stringify({ variables: { a: { from: 1, to: 10, start: 3 }, b: { from: 1, to: 10, start: 8 } },
      objectives: [{ minimise: "echo", name: "edges" }], evaluations: 200000, tolerance: 1e-9, method: "direct" });
    await page.click("#tab-jobs");
    await openInList("brick.vcad");
    await status("[data-old=false]");
    await start("optimise", { output: "found", study: search });
    await job("found", "working");
    await untilLonger(join(folder, "found/history.csv"), 200);
    await page.click("[data-folder=found] >> text=Cancel");
    await job("found", "cancelled");
    const before = readFileSync(join(folder, "found/history.csv"), "utf8");
    await page.click("[data-folder=found] >> text=Resume");
    await job("found", "working");
    await untilLonger(join(folder, "found/history.csv"), before.length);
    await page.click("[data-folder=found] >> text=Pause");
    await job("found", "paused");
    assert.ok(readFileSync(join(folder, "found/history.csv"), "utf8").startsWith(before));
    await page.click("[data-folder=found] >> text=Cancel");
    await openInList("ball.vcad");
    await status("[data-old=false]");
    await picture("jobs");
  },

  async "turns the part on the tray"() {
    await page.click("#tab-export");
    await page.click("[aria-label='90 degrees more about y']");
    await page.waitForSelector("summary:has-text('command line')");
    await page.click("summary:has-text('command line')");
    await page.waitForSelector("pre:has-text('--rotate 0,90,0')");
    await status("[data-old=false][data-busy=false]");
    await page.fill("[aria-label='Turn about y']", "0");
    await page.keyboard.press("Enter");
    await status("[data-old=false][data-busy=false]");
    assert.equal(await page.innerText(".job[data-state=done] .path"), join(realpathSync(folder), "ball_slices"));
  },

  async "a reload loses nothing"() {
    await page.reload();
    await isReady("slices");
    assert.equal(await page.inputValue(".slices .printer"), "j750");
    assert.match(await editor.innerText(), /radius = 12\.5/);
    await page.waitForSelector(".job[data-state=done]");
    await page.click("#tab-surface");
    await isReady("surface");
  },

  async "two windows show the same text"() {
    const other = await context.newPage();
    await other.goto(`http://127.0.0.1:${port}/`);
    await status("[data-saved=saved]", other);
    await type("// seen by both\n");
    await other.waitForSelector(".cm-line:has-text('seen by both')");
    await other.close();
  },

  async "changes on the disk are taken, and never overwritten"() {
    await status("[data-saved=saved]");
    writeFileSync(file, onDisk() + "// by another program\n");
    await page.waitForSelector(".cm-line:has-text('by another program')");
    await page.evaluate(() => {
      window.sent = WebSocket.prototype.send;
      WebSocket.prototype.send = function (text) {
        if (!text.includes('"do":"save"')) window.sent.call(this, text);
      };
    });
    await type("// the same\n"); // here and on the disk: no conflict
    writeFileSync(file, onDisk() + "// the same\n");
    await status("[data-saved=saved]");
    assert.equal(await page.locator(".bar.warning").count(), 0);
    await type("// mine\n"); // cannot be saved in time
    writeFileSync(file, onDisk() + "// theirs\n");
    await page.waitForSelector(".bar.warning");
    await page.evaluate(() => (WebSocket.prototype.send = window.sent));
    await page.reload(); // what was typed is a draft, the conflict is found again
    await page.waitForSelector(".bar.warning");
    assert.match(await editor.innerText(), /mine/);
    assert.match(onDisk(), /theirs/);
    await page.click("text=Keep what is here");
    await untilOnDisk("// mine");
    assert.doesNotMatch(onDisk(), /theirs/);
  },

  async "a server that is killed and started again loses nothing"() {
    await page.click("#tab-export");
    await startLongJob("again_slices", "0.003");
    await untilFile(join(folder, "again_slices/journal.jsonl"));
    await stopServer("SIGKILL");
    await status("[data-status=lost]");
    await type("// while it was away\n");
    await startServer(port, "0".repeat(32));
    await status("[data-status=refused]");
    await stopServer("SIGINT");
    await startServer(port);
    await status("[data-status=open]");
    await untilOnDisk("// while it was away");
    await status("[data-old=false][data-busy=false]");
    await page.selectOption(".surface .viewbar select >> nth=0", "top");
    await isReady("surface");
    await page.click("[data-folder=again_slices][data-state=interrupted] >> text=Resume");
    await page.waitForSelector("[data-folder=again_slices][data-state=done]");
    await resetLayerHeight();
    const whole = spawn(ombre, ["slice", file, "--printer", "j750", "--layer-height", "0.003", "-o", join(folder, "whole_slices")], { env: { ...process.env, OMBRE_DATA: source }, stdio: "ignore" });
    assert.equal(await new Promise((resolve) => whole.once("exit", resolve)), 0);
    const [again, once] = ["again_slices", "whole_slices"].map((name) => readdirSync(join(folder, name)).filter((file) => file.startsWith("slice_")));
    assert.ok(once.length > 8000);
    assert.deepEqual(again, once);
    for (const name of once) assert.ok(readFileSync(join(folder, "again_slices", name)).equals(readFileSync(join(folder, "whole_slices", name))), name);
  },

  async "shows OpenSCAD scripts, and Python scripts when they are run"() {
    await page.click("#tab-variables");
    await page.selectOption("select.file", "box.scad");
    await page.waitForSelector("#variable-width");
    await isReady("surface");
    assert.equal((await alphaInMiddle("surface"))[3], 255);
    await page.selectOption("select.file", "drop.py");
    await page.waitForSelector(".cm-line:has-text('import ombre')");
    await page.waitForSelector(".tok-keyword:text-is('import')"); // which is a word of Python alone
    const before = await page.getAttribute(".surface canvas", "data-design");
    await page.click("button:has-text('Run')");
    await until((old) => document.querySelector(".surface canvas").dataset.design !== old, before);
    await isReady("surface");
    const [red, , blue] = await alphaInMiddle("surface");
    assert.ok(blue > red);
    await page.selectOption("select.file", "ball.vcad");
    await isReady("surface");
  },

  async "chooses files for variables"() {
    await page.selectOption("select.file", "picked.vcad");
    await page.waitForSelector("select#variable-shape");
    await isReady("surface");
    assert.equal(await page.inputValue("#variable-shape"), "small.off");
    assert.deepEqual(await page.locator("#variable-other option").allInnerTexts(), ["choose…", "small.off"]);
    assert.equal(await page.getAttribute("#variable-version", "type"), "text"); // no file ends so
    mkdirSync(join(folder, "more"));
    writeFileSync(join(folder, "more/large.off"), solid(8));
    await page.focus("#variable-shape");
    await page.waitForSelector("#variable-shape option[value='more/large.off']", { state: "attached" });
    const before = await page.getAttribute(".surface canvas", "data-design");
    await page.selectOption("#variable-shape", "more/large.off");
    await until((old) => document.querySelector(".surface canvas").dataset.design !== old, before);
    await page.click("#tab-materials");
    await page.waitForSelector(".panel:has-text('8 × 8 × 8 mm')");
    await page.click("#tab-variables");
    await page.selectOption("select.file", "ball.vcad");
    await isReady("surface");
  },

  async "shows a scan in three planes, and what it makes of it"() {
    await page.selectOption("select.file", "two_lobes.nrrd");
    await page.waitForSelector(".plane canvas[data-state=ready] >> nth=2");
    await page.waitForSelector(".scaninfo:has-text('0 to 200, uint8')");
    // The crosshair begins in the middle, whose number ombre info and the file agree on.
    const here = () => page.getAttribute(".scaninfo dd[data-value]", "data-value").then(Number);
    await page.waitForSelector(".scaninfo:has-text('23, 18, 9')");
    const bytes = readFileSync(join(source, "examples/models/two_lobes.nrrd"));
    const numbers = bytes.subarray(bytes.indexOf("\n\n") + 2); // 46 x 37 x 19 bytes, unless they are packed
    const unpacked = numbers.length === 46 * 37 * 19 ? numbers : gunzipSync(numbers);
    assert.equal(await here(), unpacked[(9 * 37 + 18) * 46 + 23]);
    await page.focus(".plane canvas >> nth=0");
    await page.keyboard.press("Shift+ArrowRight");
    await page.waitForSelector(".scaninfo:has-text('33, 18, 9')");
    assert.equal(await here(), unpacked[(9 * 37 + 18) * 46 + 33]);
    await page.hover(".plane canvas >> nth=1");
    await page.waitForSelector(".scaninfo dt:has-text('pointer')");
    const brightness = () =>
      page.evaluate(() => {
        const canvas = document.querySelector(".plane canvas");
        const data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
        return data.reduce((sum, v, n) => (n % 4 === 1 ? sum + v : sum), 0);
      });
    const before = await brightness();
    await page.focus("#scan-level");
    await page.keyboard.press("Home"); // a low level is bright
    await page.waitForTimeout(100);
    assert.ok((await brightness()) > before);
    await picture("scan");
    await page.click("#tab-surface");
    await isReady("surface");
    assert.equal((await alphaInMiddle("surface"))[3], 255);
  },

  async "shows results in colours, and moved by their displacement"() {
    await page.selectOption("select.file", "bent_beam.vtu");
    await page.waitForSelector(".colours");
    await isReady("surface");
    const [least, most] = (await page.getAttribute(".colours", "data-range")).split(",").map(Number);
    assert.ok(Math.abs(least - 1.1089) < 0.001 && Math.abs(most - 13.458) < 0.001, `${least} to ${most}`); // as ombre info says
    const before = await page.getAttribute(".surface canvas", "data-design");
    await page.click("#tab-variables");
    await page.fill("[aria-label='deform, exactly']", "10");
    await until((old) => document.querySelector(".surface canvas").dataset.design !== old, before);
    await page.fill("[aria-label='Value of the last colour']", "8");
    await page.keyboard.press("Enter");
    await isReady("surface");
    await picture("results");
  },

  async "shows tables as charts, and their news"() {
    await page.selectOption("select.file", "history.csv");
    await page.waitForSelector("[data-column=change][data-points='2']"); // of the first round there is none
    assert.match(await page.getAttribute("[data-column^=greatest] svg", "aria-label"), /by round: 3 points from 11\.5 to 13\.5, the last is 11\.5/);
    appendFileSync(join(folder, "history.csv"), "4,256,0.015,11.4\n");
    await page.waitForSelector("[data-column=change][data-points='3']");
    await picture("charts");
    await page.selectOption("select.file", "ball.vcad");
    await page.click("#tab-surface");
    await isReady("surface");
  },

  async "a bundle goes out and comes in again"() {
    const [made] = await Promise.all([page.waitForEvent("download"), fromMenu("Download", "Bundle")]);
    assert.equal(made.suggestedFilename(), "ball.ombre");
    const bundle = join(folder, "ball.ombre");
    await made.saveAs(bundle);
    await page.setInputFiles("[aria-label='Files to open']", bundle);
    await status("[data-old=false][data-busy=false]");
    await page.waitForSelector("option[value='ball/ball.vcad']", { state: "attached" });
    assert.equal(await page.inputValue("select.file"), "ball/ball.vcad");
    assert.equal(readFileSync(join(folder, "ball/ball.vcad"), "utf8"), onDisk());
    // The same dropped on the page.
    const drop = async (name, text) => {
      const files = await page.evaluateHandle(([name, text]) => {
        const transfer = new DataTransfer();
        transfer.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
        return transfer;
      }, [name, text]);
      await page.dispatchEvent("main", "dragover", { dataTransfer: files });
      await page.dispatchEvent("main", "drop", { dataTransfer: files });
    };
    await drop("dropped.ombre", readFileSync(bundle).toString("base64"));
    await page.waitForSelector("option[value='dropped/ball.vcad']", { state: "attached" });
    await status("[data-old=false][data-busy=false]");
    assert.equal(await page.inputValue("select.file"), "dropped/ball.vcad");
    assert.equal(readFileSync(join(folder, "dropped/ball.vcad"), "utf8"), onDisk());
    await drop("notes.txt", "aGVsbG8=");
    await page.waitForSelector(".problems:has-text('notes.txt is no file that designs read')");
    writeFileSync(bundle, "no archive");
    await page.setInputFiles("[aria-label='Files to open']", bundle);
    await page.waitForSelector(".problems:has-text('this is no bundle')");
    assert.ok(!existsSync(join(folder, "ball_2")));
    rmSync(bundle);
    await page.selectOption("select.file", "ball.vcad");
    await isReady("surface");
  },

  async "makes pictures and turntables by keys"() {
    const bytesOf = async (key) => {
      const [made] = await Promise.all([page.waitForEvent("download", { timeout: 120000 }), page.keyboard.press(key)]);
      return { name: made.suggestedFilename(), bytes: readFileSync(await made.path()) };
    };
    const png = await bytesOf("Alt+p");
    assert.equal(png.name, "ball_surface.png");
    const stage = await page.locator(".surface canvas").boundingBox();
    assert.equal(png.bytes.readUInt32BE(16), Math.round(stage.width));
    await page.setViewportSize({ width: 900, height: 420 }); // small pictures are made soon
    const film = await bytesOf("Alt+t");
    await page.setViewportSize({ width: 1400, height: 860 });
    assert.equal(film.name, "ball_turntable.webm");
    assert.equal(film.bytes.readUInt32BE(0), 0x1a45dfa3); // EBML
    assert.ok(film.bytes.length > 5000, `${film.bytes.length} bytes`);
    await page.setViewportSize({ width: 900, height: 420 });
    const gif = await bytesOf("Alt+g");
    await page.setViewportSize({ width: 1400, height: 860 });
    assert.equal(gif.name, "ball_turntable.gif");
    assert.equal(gif.bytes.toString("latin1", 0, 6), "GIF89a");
    assert.equal(gif.bytes.at(-1), 0x3b); // the end of a GIF
    assert.equal(gif.bytes.toString("latin1").split("\x21\xf9\x04").length - 1, 60, "frames");
    await page.keyboard.press("Alt+k");
    await page.waitForSelector("dialog[open]");
    await page.keyboard.press("Escape");
    await page.keyboard.press("Alt+2");
    await isReady("slices");
    await page.keyboard.press("Alt+1");
    await isReady("surface");
  },

  async "from an empty folder to a sliced example, by keys and names that are seen"() {
    const empty = mkdtempSync(join(tmpdir(), "ombre-studio-new-"));
    const { child, url: other } = await serve(empty, 0, token);
    const fresh = await (await browser.newContext({ viewport: { width: 1400, height: 860 } })).newPage();
    await fresh.goto(other);
    await fresh.click("text=See examples");
    await fresh.fill("input[type=search]", "knob");
    await fresh.click("[aria-label='Open a copy of knob']");
    await fresh.waitForSelector(".surface canvas[data-state=ready]");
    await picture("example", fresh);
    await fresh.keyboard.press("Alt+s");
    await fresh.click("button.main:has-text('Slice')");
    await fresh.waitForSelector(".job[data-state=done]");
    assert.ok(existsSync(join(empty, "knob/knob_slices/job.json")));
    await fresh.context().close();
    child.kill("SIGINT");
    await new Promise((resolve) => child.once("exit", resolve));
    rmSync(empty, { recursive: true, force: true });
  },

  async "nothing moves by itself for people who want less motion"() {
    const moving = () =>
      page.evaluate(() => {
        const moves = (style) => style.animationName !== "none" || style.transitionDuration.split(",").some((time) => parseFloat(time) > 0);
        const all = [...document.querySelectorAll("*")];
        return all.filter((e) => [undefined, "::before", "::after"].some((part) => moves(getComputedStyle(e, part)))).map((e) => `${e.tagName} ${e.className}`);
      });
    await page.emulateMedia({ reducedMotion: "no-preference" });
    await editor.click();
    assert.ok((await moving()).some((name) => name.includes("cm-cursorLayer"))); // the cursor blinks
    await page.emulateMedia({ reducedMotion: "reduce" });
    for (const tab of ["all", "materials", "export", "reference", "examples", "variables"]) {
      await page.click(`#tab-${tab}`);
      await editor.click();
      assert.deepEqual(await moving(), [], tab);
      assert.equal(await page.evaluate(() => document.getAnimations().length), 0);
    }
    await page.emulateMedia({ reducedMotion: null });
  },

  async "axe finds nothing"() {
    await page.click("#tab-all");
    await isReady("slices");
    await page.click(".slices canvas");
    await page.waitForSelector(".probe .calls");
    for (const theme of ["light", "dark"]) {
      await page.selectOption("header select >> nth=1", theme);
      for (const tab of theme === "light" ? ["reference", "examples", "variables", "materials", "export"] : ["export"]) {
        await page.click(`#tab-${tab}`);
        if (tab === "variables") await page.click("text=Save as a preset");
        assert.deepEqual(await violations(), [], `${theme} ${tab}`);
      }
      await page.waitForTimeout(pictures ? 2500 : 0);
      await picture(`all_${theme}`);
    }
  },

  async "nothing went wrong unseen"() {
    assert.deepEqual(complaints, []);
  },
};

const probed = [];
const failed = await runChecks(checks, page);
await browser.close();
await stopServer("SIGINT");
rmSync(folder, { recursive: true, force: true });
process.exit(failed);
