// The studio as people meet it in their first hour, in Chromium: nothing that they type is lost, and it opens what they
// have.
//
//     node tests/studio/run_first_hour.mjs build/release/apps/ombre/ombre chromium [--pictures FOLDER]
import assert from "node:assert/strict";
import { copyFileSync, existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { inflateRawSync } from "node:zlib";
import { launch, runChecks, serve, source, stop } from "./studio_server.mjs";

const folder = mkdtempSync(join(tmpdir(), "ombre-first-"));
const models = join(source, "examples/models");
const read = (name) => readFileSync(join(folder, name), "utf8");
const ball = "radius = 8;  // [2:20]\nsphere(radius, red);\n";
const keyOf = (day) => String(day).repeat(32);

let day = 1;
let server = await serve(folder, 0, keyOf(day));
const browser = await launch();
const pictures = process.argv.includes("--pictures") ? process.argv.at(-1) : "";

const newContext = async () => {
  const made = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  made.setDefaultTimeout(20000);
  return made;
};
let context = await newContext();
let page = await context.newPage();

const until = async (isSo, what = String(isSo)) => {
  for (let n = 0; n < 400; ++n) {
    if (await isSo()) return;
    await new Promise((done) => setTimeout(done, 50));
  }
  assert.fail(`in vain: ${what}`);
};
const editor = () => page.locator(".cm-content");
const text = () => editor().evaluate((element) => [...element.querySelectorAll(".cm-line")].map((line) => line.textContent).join("\n"));
const type = async (more) => {
  await editor().click();
  await page.keyboard.press("Control+End");
  await page.keyboard.insertText(more);
};
const write = async (all) => {
  await editor().click();
  await page.keyboard.press("Control+a");
  await page.keyboard.insertText(all);
};
const status = (what) => page.waitForSelector(`.status${what}`);
const isSaved = () => status("[data-saved=saved][data-status=open]");
const isReady = (view = "surface") => page.waitForSelector(`.${view} canvas[data-state=ready]`);
// The name of the file that the page has opened, also while another one is chosen.
const opened = () => page.getAttribute("select.file", "title");
// The list of files is read again when it gets the focus.
const open = async (name) => {
  await page.locator("select.file").blur();
  await page.focus("select.file");
  await page.waitForSelector(`select.file option[value='${name}']`, { state: "attached" });
  await page.selectOption("select.file", name);
  await until(async () => (await opened()) === name);
};
const fromMenu = async (menu, action) => {
  await page.click(`header summary:text-is('${menu}')`);
  await page.click(`header .actions button:text-is('${action}')`);
};
const downloaded = async (act) => {
  const [made] = await Promise.all([page.waitForEvent("download"), act()]);
  return { name: made.suggestedFilename(), bytes: readFileSync(await made.path()) };
};
// The place of what the canvas shows, in pixels of the page.
const shownBox = (view) =>
  page.evaluate((name) => {
    const canvas = document.querySelector(`.${name} canvas`);
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
    const [xs, ys] = [[], []];
    for (let n = 3, at = 0; n < data.length; n += 4, ++at) {
      if (data[n] < 128) continue;
      xs.push(at % canvas.width);
      ys.push(Math.floor(at / canvas.width));
    }
    if (xs.length === 0) return null;
    const range = (list) => list.reduce((most, v) => Math.max(most, v)) - list.reduce((least, v) => Math.min(least, v)) + 1;
    const scale = Math.min(canvas.clientWidth / canvas.width, canvas.clientHeight / canvas.height);
    return { width: range(xs) * scale, height: range(ys) * scale };
  }, view);
const drop = async (files) => {
  const transfer = await page.evaluateHandle((list) => {
    const made = new DataTransfer();
    for (const [name, bytes] of list) made.items.add(new File([Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0))], name));
    return made;
  }, files.map(([name, bytes]) => [name, Buffer.from(bytes).toString("base64")]));
  await page.dispatchEvent("main", "dragover", { dataTransfer: transfer });
  await page.dispatchEvent("main", "drop", { dataTransfer: transfer });
};
// The server is killed, and started again on another day, with another token.
const nextDay = async () => {
  await stop(server.child, "SIGKILL");
  server = await serve(folder, 0, keyOf(++day));
};
// Somebody else's browser, which has kept nothing.
const otherBrowser = async () => {
  await context.close();
  context = await newContext();
  page = await context.newPage();
  await page.goto(server.url);
};
// The names in a zip archive, and the bytes of one of its members.
const namesIn = (zip) => {
  const names = [];
  for (let at = zip.indexOf("PK\x01\x02"); at >= 0; at = zip.indexOf("PK\x01\x02", at + 4)) names.push(zip.toString("utf8", at + 46, at + 46 + zip.readUInt16LE(at + 28)));
  return names;
};
const memberOf = (zip, name) => {
  const entry = zip.lastIndexOf(name) - 46;
  const [packing, packed, offset] = [zip.readUInt16LE(entry + 10), zip.readUInt32LE(entry + 20), zip.readUInt32LE(entry + 42)];
  const begin = offset + 30 + zip.readUInt16LE(offset + 26) + zip.readUInt16LE(offset + 28);
  const bytes = zip.subarray(begin, begin + packed);
  return packing === 8 ? inflateRawSync(bytes) : bytes;
};

const checks = {
  async "text that is typed before a file is open becomes a new file"() {
    await page.goto(server.url);
    await page.waitForSelector(".bar:has-text('There is no design')");
    await type("sphere(7, blue);");
    await until(() => existsSync(join(folder, "untitled.vcad")) && read("untitled.vcad") === "sphere(7, blue);");
    assert.equal(await page.inputValue("select.file"), "untitled.vcad");
    await isReady();
    await page.reload();
    await isReady();
    assert.equal(await text(), "sphere(7, blue);");
  },

  async "the token is in no cookie"() {
    assert.deepEqual(await context.cookies(), []);
    assert.equal(new URL(page.url()).search, "");
  },

  async "text that is typed while the server is away comes back the next day"() {
    await page.keyboard.press("Control+Home");
    await stop(server.child, "SIGKILL");
    await status("[data-status=lost]");
    await type("\n// while it was away\n");
    await page.close();
    const before = server.url;
    server = await serve(folder, 0, keyOf(++day));
    assert.equal(new URL(server.url).port, new URL(before).port);
    page = await context.newPage();
    await page.goto(server.url);
    await until(() => read("untitled.vcad").includes("// while it was away"));
    assert.match(await text(), /while it was away/);
    await isSaved();
  },

  async "a page that stayed open finds the server with its new token"() {
    const before = await context.newPage();
    await before.goto(`${new URL(server.url).origin}/`);
    await nextDay();
    await page.goto(server.url);
    await before.waitForSelector(".status[data-status=open]");
    await before.close();
    await isSaved();
  },

  async "text that cannot be saved is kept by the server"() {
    writeFileSync(join(folder, "shared.vcad"), ball);
    await open("shared.vcad");
    await isReady();
    await page.evaluate(() => {
      const send = WebSocket.prototype.send;
      WebSocket.prototype.send = function (message) {
        if (!message.includes('"do":"save"')) send.call(this, message);
      };
    });
    await type("// mine\n");
    writeFileSync(join(folder, "shared.vcad"), `${ball}// theirs\n`);
    await page.waitForSelector(".bar.warning");
    await page.waitForTimeout(1500); // the draft is sent
    await nextDay();
    await otherBrowser();
    await open("shared.vcad");
    await page.waitForSelector(".bar.warning");
    assert.match(await text(), /mine/);
    await page.click("text=Take what is on the disk");
    await until(async () => /theirs/.test(await text()));
    await page.reload();
    await isReady();
    assert.match(await text(), /theirs/);
    assert.equal(await page.locator(".bar.warning").count(), 0);
  },

  async "jobs of a killed server are listed, and go on"() {
    writeFileSync(join(folder, "ball.vcad"), ball);
    await open("ball.vcad");
    await page.fill("[aria-label='radius, exactly']", "9");
    await status("[data-busy=false][data-old=false]");
    await page.click("#tab-export");
    await page.selectOption(".panel .printer", "j750");
    await page.click("summary:has-text('More options')");
    await page.fill(".option-layer-height input", "0.0002");
    await page.keyboard.press("Enter");
    await page.waitForSelector(".panel:has-text('90000 layers')"); // 18 mm
    await page.click("button.main:has-text('Slice')");
    await until(() => existsSync(join(folder, "ball_slices/journal.jsonl")));
    await nextDay();
    await otherBrowser();
    await page.click("#tab-export");
    const job = (state) => page.waitForSelector(`[data-folder=ball_slices][data-state=${state}]`);
    await job("interrupted");
    const before = readdirSync(join(folder, "ball_slices")).length;
    await page.click("[data-folder=ball_slices] >> text=Resume");
    await job("working");
    await until(() => readdirSync(join(folder, "ball_slices")).length > before);
    await page.click("[data-folder=ball_slices] >> text=Cancel");
    await job("cancelled");
    await page.click("#tab-variables");
  },

  async "undo survives a change of file"() {
    await open("ball.vcad");
    await type("// first\n");
    await isSaved();
    await open("shared.vcad");
    await open("ball.vcad");
    await editor().click();
    await page.keyboard.press("Control+z");
    await until(() => read("ball.vcad") === ball);
    await isSaved();
  },

  async "sliders and camera survive a reload"() {
    await page.fill("[aria-label='radius, exactly']", "12.5");
    await page.selectOption(".surface .viewbar select >> nth=0", "top");
    await page.selectOption(".surface .cut", "x>");
    await status("[data-busy=false][data-old=false]");
    await page.waitForTimeout(400);
    await page.reload();
    await isReady();
    assert.equal(await page.inputValue("[aria-label='radius, exactly']"), "12.5");
    assert.equal(await page.inputValue(".surface .cut"), "x>");
    const { width, height } = await shownBox("surface"); // half of the ball, from above
    assert.ok(Math.abs(height / width - 2) < 0.1, `${width} x ${height}`);
    await page.selectOption(".surface .cut", "");
    await page.click("button:text-is('Reset')");
  },

  async "a picture of another file does not stay"() {
    await isReady();
    assert.ok(await shownBox("surface"));
    writeFileSync(join(folder, "wrong.vcad"), "spher(3);\ncubee(4);\nx = foo(2);\n");
    await open("wrong.vcad");
    await status("[data-old=true]");
    assert.equal(await shownBox("surface"), null);
  },

  async "all mistakes are listed, and the header stays where it is"() {
    const size = () => page.locator("header").boundingBox();
    await open("ball.vcad");
    await isReady();
    const before = await size();
    await open("wrong.vcad");
    await page.waitForSelector('.problems[data-errors="3"]');
    assert.deepEqual(await page.locator(".problems .place").allInnerTexts(), ["1:1", "2:1", "3:5"]);
    assert.deepEqual(await size(), before);
    for (const width of [820, 1000, 1280, 1920]) {
      await page.setViewportSize({ width, height: 800 });
      const header = await page.locator("header").evaluate((element) => [element.scrollWidth, element.clientWidth, element.clientHeight]);
      assert.ok(header[0] <= header[1], `the header is ${header[0]} wide of ${width}`);
      assert.ok(header[2] <= 42, `the header is ${header[2]} high`);
    }
    await page.setViewportSize({ width: 1280, height: 800 });
    await open("ball.vcad");
    await isReady();
  },

  async "an OpenSCAD script without colours is shown"() {
    writeFileSync(join(folder, "plain.scad"), "cube(6);\ntranslate([9, 0, 0]) sphere(3);\n");
    await open("plain.scad");
    await isReady();
    assert.ok(await shownBox("surface"));
    assert.equal(await page.locator(".problems li.error").count(), 0);
  },

  async "opens what people have"() {
    const made = { "tetrahedron.off": "mesh(", "gear.stl": "mesh(", "textured_cube.obj": "mesh(", "wheel.3mf": "mesh(", "bracket.step": "cad(", "two_lobes.nrrd": "volume_solid(", "bent_beam.vtu": "results(", "leaf.png": "relief(" };
    for (const [name, call] of Object.entries(made)) {
      const design = name.replace(/\.\w+$/, ".vcad");
      await drop([[name, readFileSync(join(models, name))]]);
      await until(async () => (await opened()) === design, design);
      assert.ok(read(design).includes(`${call}"${name}"`), read(design));
      assert.ok(readFileSync(join(folder, name)).equals(readFileSync(join(models, name))));
      await page.waitForSelector(".surface canvas[data-design]", { state: "attached" });
    }
    await page.click("#tab-surface");
    await isReady();
    assert.ok(await shownBox("surface"));
    // Models that lie in the folder are listed, and shown by a script.
    await open("gear.stl");
    await page.waitForSelector(".bar:has-text('A script that shows gear.stl')");
    await isReady();
    await drop([["letter.docx", "x"]]);
    await page.waitForSelector(".problems:has-text('letter.docx is no file that designs read')");
    await page.setInputFiles("[aria-label='Files to open']", [{ name: "mine.scad", mimeType: "", buffer: Buffer.from("cube(3);\n") }]);
    await until(async () => (await opened()) === "mine.scad");
    await isReady();
  },

  async "opens folders, and never overwrites unasked"() {
    const given = mkdtempSync(join(tmpdir(), "ombre-given-"));
    mkdirSync(join(given, "kit/parts"), { recursive: true });
    writeFileSync(join(given, "kit/kit.vcad"), 'mesh("parts/body.off", blue);\n');
    copyFileSync(join(models, "tetrahedron.off"), join(given, "kit/parts/body.off"));
    await page.setInputFiles("[aria-label='Folder to open']", join(given, "kit"));
    await until(async () => (await opened()) === "kit/kit.vcad");
    await isReady();
    assert.ok(existsSync(join(folder, "kit/parts/body.off")));
    rmSync(given, { recursive: true });
    const scad = (side) => [["mine.scad", `cube(${side});\n`]];
    await drop(scad(4));
    await page.waitForSelector("dialog[open]:has-text('mine.scad is there already')");
    await page.click("dialog[open] button:text-is('Keep both')");
    await until(async () => (await opened()) === "mine_2.scad");
    assert.equal(read("mine.scad") + read("mine_2.scad"), "cube(3);\ncube(4);\n");
    await drop(scad(5));
    await page.click("dialog[open] button:text-is('Cancel')");
    assert.equal(read("mine.scad"), "cube(3);\n");
    await drop(scad(6));
    await page.click("dialog[open] button:text-is('Replace')");
    await until(() => read("mine.scad") === "cube(6);\n");
  },

  async "gives meshes, pictures and jobs to the browser"() {
    await open("ball.vcad");
    await isReady();
    const mesh = await downloaded(() => fromMenu("Download", "3MF"));
    assert.equal(mesh.name, "ball.3mf");
    assert.ok(namesIn(mesh.bytes).some((name) => name.endsWith(".model")));
    const stl = await downloaded(() => fromMenu("Download", "STL"));
    assert.equal(stl.name, "ball.stl");
    assert.equal(stl.bytes.length, 84 + 50 * stl.bytes.readUInt32LE(80));
    assert.equal((await downloaded(() => fromMenu("Download", "Picture (PNG)"))).bytes.toString("latin1", 1, 4), "PNG");
    assert.ok(!existsSync(join(folder, "ball.3mf")) && !existsSync(join(folder, "ball.stl")));
    await page.click("#tab-export");
    await page.selectOption(".panel .printer", "");
    await page.click("summary:has-text('More options')");
    await page.fill(".option-layer-height input", "1");
    await page.keyboard.press("Enter");
    await page.fill(".panel label:has-text('Folder') input", "few_slices");
    await page.waitForSelector(".panel:has-text('16 layers')");
    await page.click("button.main:has-text('Slice')");
    await page.waitForSelector("[data-folder=few_slices][data-state=done]");
    const job = await downloaded(() => page.click("[data-folder=few_slices] >> text=Download as zip"));
    assert.equal(job.name, "few_slices.zip");
    assert.deepEqual(namesIn(job.bytes).sort(), readdirSync(join(folder, "few_slices")).map((name) => `few_slices/${name}`).sort());
    assert.ok(memberOf(job.bytes, "few_slices/job.json").equals(readFileSync(join(folder, "few_slices/job.json"))));
    await page.fill(".option-layer-height input", "");
    await page.keyboard.press("Enter");
    await page.click("#tab-variables");
  },

  async "renames, duplicates, deletes, and makes folders"() {
    const named = async (action, name, button) => {
      await fromMenu("File", action);
      if (name) await page.fill("dialog[open] input", name);
      await page.click(`dialog[open] button:text-is('${button}')`);
    };
    const isOpen = (name) => until(async () => (await opened()) === name, name);
    await named("New folder…", "parts", "Make");
    await until(() => existsSync(join(folder, "parts")));
    await open("mine_2.scad");
    await named("Rename…", "parts/cube.scad", "Rename");
    await isOpen("parts/cube.scad");
    assert.ok(!existsSync(join(folder, "mine_2.scad")));
    await named("Duplicate…", "parts/cube_copy", "Duplicate");
    await isOpen("parts/cube_copy.scad");
    assert.equal(read("parts/cube_copy.scad"), read("parts/cube.scad"));
    await named("Rename…", "ball.scad", "Rename");
    await isOpen("ball.scad");
    await named("Rename…", "plain.scad", "Rename");
    await page.waitForSelector(".problems:has-text('plain.scad is there already')");
    await named("Delete…", "", "Delete");
    await until(() => !existsSync(join(folder, "ball.scad")));
    assert.equal(readdirSync(join(folder, ".ombre-trash")).filter((name) => name.endsWith("ball.scad")).length, 1);
    await until(async () => !["", "ball.scad"].includes(await page.inputValue("select.file")));
  },

  async "links lead to a file and to a state of it"() {
    await page.goto(`${new URL(server.url).origin}/?file=ball.vcad&view=surface&cut=x%3E0&D=radius%3D15`);
    await isReady();
    assert.equal(await page.inputValue("select.file"), "ball.vcad");
    assert.equal(await page.inputValue("[aria-label='radius, exactly']"), "15");
    assert.equal(await page.inputValue(".surface .cut"), "x>");
    assert.equal(await page.inputValue("[aria-label='Place of the cut, exactly']"), "0");
    await page.fill("[aria-label='Place of the cut, exactly']", "3");
    await page.keyboard.press("Enter");
    await context.grantPermissions(["clipboard-read", "clipboard-write"]);
    await fromMenu("File", "Copy link");
    let link = "";
    await until(async () => (link = await page.evaluate(() => navigator.clipboard.readText())).includes("file=ball.vcad"));
    const query = new URL(link).searchParams;
    assert.deepEqual([query.get("cut"), query.get("D"), query.get("view"), query.get("token")], ["x>3", "radius=15", "surface", null]);
    await page.click("button:text-is('Reset')");
    await page.selectOption(".surface .cut", "");
  },

  async "two fingers move and zoom a view, and a ball stays round when the view changes its size"() {
    const isRound = async () => {
      const { width, height } = await shownBox("surface");
      assert.ok(Math.abs(width / height - 1) < 0.04, `${width} x ${height}`);
      return width;
    };
    await isReady();
    const before = await isRound();
    await page.evaluate(() => {
      const canvas = document.querySelector(".surface canvas");
      canvas.setPointerCapture = () => undefined; // these fingers are none of the system
      const box = canvas.getBoundingClientRect();
      const finger = (type, id, x) => canvas.dispatchEvent(new PointerEvent(type, { pointerId: id, pointerType: "touch", buttons: 1, bubbles: true, clientX: box.left + x, clientY: box.top + 200 }));
      finger("pointerdown", 11, 200);
      finger("pointerdown", 12, 300);
      for (let n = 1; n <= 10; ++n) {
        finger("pointermove", 11, 200 + 2.5 * n);
        finger("pointermove", 12, 300 - 2.5 * n);
      }
      finger("pointerup", 11, 225);
      finger("pointerup", 12, 275);
    });
    await page.waitForSelector(".surface canvas:not([data-state=ready])");
    await isReady();
    const after = await isRound();
    assert.ok(Math.abs(after / before - 0.5) < 0.05, `${before} and ${after}`);
    for (const size of [{ width: 900, height: 800 }, { width: 1600, height: 500 }, { width: 1280, height: 800 }]) {
      await page.setViewportSize(size);
      await isRound(); // also before there is a new picture
      await isReady();
      await isRound();
    }
  },

  async "examples have pictures"() {
    await page.click("#tab-examples");
    await page.waitForSelector(".examples .picture img");
    await until(() => page.evaluate(() => [...document.querySelectorAll(".examples .picture img")].some((image) => image.naturalWidth > 50)));
    await page.click("#tab-variables");
  },

  async "a Python script tells at once what it says, and can be stopped"() {
    writeFileSync(join(folder, "slow.py"), "import time, ombre\nprint('begun')\ntime.sleep(1 if ombre.option('short', False) else 60)\nroot = ombre.sphere(3, 'blue')\n");
    writeFileSync(join(folder, "quick.py"), "import ombre\nprint('quick')\nroot = ombre.sphere(3, 'blue')\n");
    await open("slow.py");
    await page.click("button:text-is('Run')");
    await page.waitForSelector(".echo:has-text('begun')");
    await page.click("button:text-is('Stop')");
    await page.waitForSelector(".problems:has-text('The script was stopped')");
    await open("quick.py");
    await page.click("button:text-is('Run')");
    await isReady();
    assert.equal(await page.innerText(".echo"), "quick");
  },

  async "pictures of the page"() {
    await open("ball.vcad");
    await page.click("#tab-all");
    for (const width of pictures ? [820, 1280, 1920] : []) {
      await page.setViewportSize({ width, height: width === 1920 ? 1080 : 800 });
      for (const view of ["surface", "slices", "volume"]) await isReady(view);
      await page.screenshot({ path: join(pictures, `studio_${width}.png`) });
      await page.click("#tab-surface");
      await page.click("header summary:text-is('File')");
      await page.click("#tab-examples", { force: true });
      await page.waitForSelector(".examples .picture img");
      await isReady();
      await page.click("header summary:text-is('File')");
      await page.screenshot({ path: join(pictures, `studio_${width}_menu.png`) });
      await page.keyboard.press("Escape");
      await open("wrong.vcad");
      await page.waitForSelector('.problems[data-errors="3"]');
      await page.screenshot({ path: join(pictures, `studio_${width}_mistakes.png`) });
      await open("ball.vcad");
      await page.click("#tab-all");
    }
  },
};

const failed = await runChecks(checks, { screenshot: (options) => page.screenshot(options) });
await browser.close();
await stop(server.child, "SIGINT");
rmSync(folder, { recursive: true, force: true });
process.exit(failed);
