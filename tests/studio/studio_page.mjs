// A studio of a test: a folder with designs, a server for it, a browser with its page, and what people do with them.
//
//     node tests/studio/run_THEME.mjs build/release/apps/ombre/ombre /usr/bin/chromium [--pictures FOLDER]
//
// With OMBRE_LATE=SEED in the environment the page is as slow as on a busy machine.
//
// Tests may run side by side: each has a folder, a server, kept state and a browser of its own.
import assert from "node:assert/strict";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { launch, require, runChecks, serve, stop, token } from "./studio_server.mjs";

export const folder = mkdtempSync(join(tmpdir(), "ombre-studio-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));

// A ball that most tests open, graded from red to blue; its file, and what is in it.
export const ball = (radius) => `// A ball, graded from red to blue.
radius = ${radius};  // [5:20]
fgrade(["0.5 + x / 40", "0.5 - x / 40"], [red, blue]) sphere(radius);
`;
export const file = join(folder, "ball.vcad");

export const pathOf = (name) => join(folder, name);
export const read = (name) => readFileSync(pathOf(name), "utf8");
export const write = (name, content) => writeFileSync(pathOf(name), content);
export const isThere = (name) => existsSync(pathOf(name));
export const onDisk = () => readFileSync(file, "utf8");

export let server, url, browser, context, page;
let size;
const complaints = [];

// Starts the server again, at the port that belongs to the folder unless another one is given.
export async function startServer(key = token, port = 0, place = folder) {
  const started = await serve(place, port, key);
  server = started.child;
  url = started.url;
}
export const stopServer = (signal) => stop(server, signal);

// What hangs ends at last; a busy machine is no failure.
const longestWait = 1200000;

async function openContext() {
  context = await browser.newContext({ viewport: size });
  context.setDefaultTimeout(longestWait);
  if (process.env.OMBRE_LATE) await context.addInitScript(beLate, Number(process.env.OMBRE_LATE));
  await context.route("**", (route) => {
    const { hostname } = new URL(route.request().url());
    if (hostname !== "127.0.0.1") complaints.push(`the page sent a request to ${hostname}`);
    route.continue();
  });
  await openWindow();
}

export async function openWindow() {
  page = await context.newPage();
  page.on("pageerror", (error) => complaints.push(error.message));
}

// Somebody else's browser, which has kept nothing.
export async function otherBrowser() {
  await context.close();
  await openContext();
  await page.goto(url);
}

// A window whose views are drawn soon.
export const small = { width: 1020, height: 600 };

// Writes the files and runs the checks in order, in a page that has opened `place`, or the folder without one.
export async function test({ files = { "ball.vcad": ball(12.5) }, place = file, key = token, viewport = { width: 1400, height: 860 }, opens = true }, checks) {
  for (const [name, content] of Object.entries(files)) write(name, content);
  size = viewport;
  const all = { ...checks, "nothing went wrong unseen": () => assert.deepEqual(complaints, []) };
  let failed = 1;
  try {
    await startServer(key, 0, place);
    browser = await launch();
    await openContext();
    if (opens) await page.goto(url);
    failed = await runChecks(all, { screenshot: (options) => page.screenshot(options) });
  } catch (error) {
    console.log(String(error).split("\n").slice(0, 4).join("\n"));
  }
  await browser?.close();
  if (server) await stopServer("SIGINT");
  process.exit(failed);
}

export const pictures = process.argv.includes("--pictures") ? process.argv.at(-1) : "";
export const picture = (name, of = page) => pictures && of.screenshot({ path: join(pictures, `${name}.png`) });

export const pause = () => new Promise((done) => setTimeout(done, 25));
export async function until(isSo, what = String(isSo)) {
  const begun = performance.now();
  while (!(await isSo())) {
    assert.ok(performance.now() - begun < longestWait, `in vain: ${what}`);
    await pause();
  }
}
// Playwright's own way evaluates texts, which the page's policy forbids.
export const untilOnPage = (isSo, argument) => until(() => page.evaluate(isSo, argument), String(isSo));
export const untilOnDisk = (part) => until(() => onDisk().includes(part), part);
export const untilOnDiskIs = (text) => until(() => onDisk() === text, text);
export const untilThere = (name) => until(() => isThere(name), name);

// The state that the page shows, in words and in its attributes.
export const status = (what, of = page) => of.waitForSelector(`.status${what}`);
export const isSaved = () => status("[data-saved=saved][data-status=open]");
export const isReady = (view = "surface", more = "") => page.waitForSelector(`.${view} canvas[data-state=ready]${more}`);
export const design = () => page.getAttribute(".surface canvas", "data-design");
export const untilOtherDesign = (before) => untilOnPage((old) => document.querySelector(".surface canvas").dataset.design !== old, before);

// In the page, lets half of all answers, frames, timers and fetches come up to a second late, those of the socket in their
// order: what a person does in between must count, and so must what the page had asked for.
function beLate(seed) {
  const random = () => (seed = (seed * 1664525 + 1013904223) % 2 ** 32) / 2 ** 32;
  const delay = () => (random() < 0.5 ? 0 : 1000 * random());
  const { setTimeout, requestAnimationFrame, fetch } = window;
  window.setTimeout = (act, after = 0, ...more) => setTimeout(act, after + delay(), ...more);
  window.requestAnimationFrame = (act) => requestAnimationFrame(() => setTimeout(() => act(performance.now()), delay()));
  window.fetch = (...request) => new Promise((done) => setTimeout(done, delay())).then(() => fetch(...request));
  const messages = Object.getOwnPropertyDescriptor(WebSocket.prototype, "onmessage");
  Object.defineProperty(WebSocket.prototype, "onmessage", {
    set(hear) {
      let last = Promise.resolve();
      messages.set.call(this, (message) => {
        const own = new Promise((done) => setTimeout(done, delay()));
        last = last.then(() => own).then(() => void setTimeout(() => hear(message)));
      });
    },
  });
}

// In the page, holds requests whose text has all of the parts back until `sendHeld()`, after which none are held.
export function holdRequests(parts) {
  const send = WebSocket.prototype.send, held = [];
  WebSocket.prototype.send = function (text) {
    if (parts.every((part) => text.includes(part))) held.push(() => send.call(this, text));
    else send.call(this, text);
  };
  window.sendHeld = () => {
    WebSocket.prototype.send = send;
    held.forEach((go) => go());
  };
}

// Puts the caret behind the first place of a text.
export async function putCaret(part) {
  const all = await text(), at = all.indexOf(part) + part.length;
  assert.ok(at >= part.length, part);
  await editor().click();
  await page.keyboard.press("Control+Home");
  for (let n = 0; n < at; ++n) await page.keyboard.press("ArrowRight");
}

// The name of the file that the page has opened, also while another one is chosen.
export const opened = () => page.getAttribute("select.file", "title");
// The list of files is read again when it gets the focus.
export async function open(name) {
  await page.locator("select.file").blur();
  await page.focus("select.file");
  await page.waitForSelector(`select.file option[value='${name}']`, { state: "attached" });
  await page.selectOption("select.file", name);
  await until(async () => (await opened()) === name, `${name} is open`);
}

export const editor = () => page.locator(".cm-content");
export const text = () => editor().evaluate((element) => [...element.querySelectorAll(".cm-line")].map((line) => line.textContent).join("\n"));
export async function type(more) {
  await editor().click();
  await page.keyboard.press("Control+End");
  await page.keyboard.insertText(more);
}
export async function typeAll(all) {
  await editor().click();
  await page.keyboard.press("Control+a");
  await page.keyboard.insertText(all);
}
export const selected = (count) => page.evaluate((n) => getSelection().toString().slice(0, n), count);

export async function fromMenu(menu, action) {
  await page.click(`header summary:text-is('${menu}')`);
  await page.click(`header .actions button:text-is('${action}')`);
}
export async function downloaded(act) {
  const [made] = await Promise.all([page.waitForEvent("download"), act()]);
  return { name: made.suggestedFilename(), bytes: readFileSync(await made.path()) };
}
export async function drop(files) {
  const transfer = await page.evaluateHandle((list) => {
    const made = new DataTransfer();
    for (const [name, bytes] of list) made.items.add(new File([Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0))], name));
    return made;
  }, files.map(([name, bytes]) => [name, Buffer.from(bytes).toString("base64")]));
  await page.dispatchEvent("main", "dragover", { dataTransfer: transfer });
  await page.dispatchEvent("main", "drop", { dataTransfer: transfer });
}

export const alphaInMiddle = (view) =>
  page.evaluate((name) => {
    const canvas = document.querySelector(`.${name} canvas`);
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
    copy.drawImage(canvas, 0, 0);
    return [...copy.getImageData(canvas.width >> 1, canvas.height >> 1, 1, 1).data];
  }, view);

// The size of what the canvas shows and of one of its pixels, in pixels of the page.
export const shownBox = (view) =>
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
    return { width: range(xs) * scale, height: range(ys) * scale, pixel: scale };
  }, view);

// Starts a job of the design for the printer that is chosen, in the panel of slices.
export async function slice(name, height) {
  const input = page.locator(".option-layer-height input");
  if (!(await input.isVisible())) await page.click("summary:has-text('More options')");
  await input.fill(height);
  await page.keyboard.press("Enter");
  await page.fill(".panel label:has-text('Folder') input", name);
  await page.click(".panel button.main");
}
export async function resetLayerHeight() {
  await page.fill(".option-layer-height input", "");
  await page.keyboard.press("Enter");
}
export const job = (name, state) => page.waitForSelector(`[data-folder="${name}"][data-state=${state}]`);

// Fills the form of a kind of job and starts it.
export async function startKind(kind, options) {
  await page.selectOption("select.kind", kind);
  await page.waitForSelector(`.panel button[type=submit]:has-text("Start ${kind}")`); // the form is the kind's
  for (const [name, value] of Object.entries(options)) await fillOption(name, value);
  await page.click(".panel button[type=submit]");
}
async function fillOption(name, value) {
  const input = page.locator(`.panel .option-${name} input, .panel .option-${name} select`);
  if (!(await input.isVisible())) await page.click(".panel summary:has-text('More options')");
  if ((await input.getAttribute("type")) === "checkbox") return input.check();
  if ((await input.evaluate((element) => element.tagName)) === "SELECT") return input.selectOption(value);
  await input.fill(value);
  await input.press("Tab");
}

const axeSource = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

// What axe finds, a line for each rule.
export async function violations() {
  await page.evaluate(axeSource);
  const found = await page.evaluate(() => axe.run());
  return found.violations.map((v) => `${v.id} at ${v.nodes.map((n) => n.html.slice(0, 120)).join(" and ")}`);
}

// The graph: cards, the ends of their wires, and fields.
export const textIs = (wanted) => until(async () => (await text()) === wanted, wanted);
export const card = (name) => page.locator(`.card[aria-label^="${name},"]`);
export const end = (label) => page.locator(`.dot[aria-label="${label}"]`);

async function middle(of) {
  const box = await of.boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
}

export async function drag(from, to) {
  await page.mouse.move(...(await middle(from)));
  await page.mouse.down();
  await page.mouse.move(...(await middle(to)), { steps: 4 });
  await page.mouse.up();
}

export async function put(label, value) {
  await page.fill(`[aria-label="${label}"]`, value);
  await page.keyboard.press("Enter");
}
