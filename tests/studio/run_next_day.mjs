// What people typed and started is there the next day, whatever happens to the server.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { context, folder, holdRequests, isReady, isSaved, isThere, job, open, openWindow, otherBrowser, page, pathOf, read, startServer, status, stopServer, test, text, type, until, url, write } from "./studio_page.mjs";
import { stateFolder } from "./studio_server.mjs";

const script = "radius = 8;  // [2:20]\nsphere(radius, red);\n";
const keyOf = (day) => String(day).repeat(32);
let day = 1;

// The server is killed, and started again on another day, with another token.
async function nextDay() {
  await stopServer("SIGKILL");
  await startServer(keyOf(++day));
}

// Returns true if the server keeps a draft with these words. One that it is writing still has another ending.
const hasDraft = (words) => {
  const kept = readdirSync(stateFolder, { recursive: true, withFileTypes: true });
  return kept.some((entry) => entry.isFile() && entry.name.endsWith(".json") && entry.parentPath.endsWith("drafts") && readFileSync(join(entry.parentPath, entry.name), "utf8").includes(words));
};

await test({ files: {}, place: folder, key: keyOf(day), viewport: { width: 1280, height: 800 } }, {
  async "text that is typed before a file is open becomes a new file"() {
    await page.waitForSelector(".bar:has-text('There is no design')");
    await type("sphere(7, blue);");
    await until(() => isThere("untitled.vcad") && read("untitled.vcad") === "sphere(7, blue);");
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
    await stopServer("SIGKILL");
    await status("[data-status=lost]");
    await type("\n// while it was away\n");
    await page.close();
    const before = url;
    await startServer(keyOf(++day));
    assert.equal(new URL(url).port, new URL(before).port);
    await openWindow();
    await page.goto(url);
    await until(() => read("untitled.vcad").includes("// while it was away"));
    assert.match(await text(), /while it was away/);
    await isSaved();
  },

  async "a page that stayed open finds the server with its new token"() {
    const before = await context.newPage();
    await before.goto(`${new URL(url).origin}/`);
    await nextDay();
    await page.goto(url);
    await before.waitForSelector(".status[data-status=open]");
    await before.close();
    await isSaved();
  },

  async "a page that lost the server while it began opens its file when the server is back"() {
    const before = await context.newPage();
    await before.addInitScript(holdRequests, ['"do":"jobs"']);
    await before.goto(url);
    await before.waitForSelector(".status[data-status=open]", { state: "attached" });
    await stopServer("SIGKILL");
    await before.waitForSelector(".status[data-status=lost]");
    await before.evaluate(() => window.sendHeld());
    await startServer(keyOf(day));
    await before.waitForSelector("select.file[title='untitled.vcad']");
    await before.close();
  },

  async "a page that is about to open its file offers no other start"() {
    const other = await context.newPage();
    await other.addInitScript(holdRequests, ['"do":"open"']);
    await other.goto(url);
    await other.waitForSelector(".status[data-status=open]", { state: "attached" });
    assert.equal(await other.locator("text=Begin with a ball").count(), 0);
    await other.evaluate(() => window.sendHeld());
    await other.waitForSelector("select.file[title='untitled.vcad']");
    await other.close();
  },

  async "text that cannot be saved is kept by the server"() {
    write("shared.vcad", script);
    await open("shared.vcad");
    await isReady();
    await page.evaluate(() => {
      const send = WebSocket.prototype.send;
      WebSocket.prototype.send = function (message) {
        send.call(this, message.replace('"do":"save"', '"do":"no_save"')); // which fails
      };
    });
    await type("// mine\n");
    write("shared.vcad", `${script}// theirs\n`);
    await page.waitForSelector(".bar.warning");
    await until(() => hasDraft("// mine"), "a draft");
    await nextDay();
    await otherBrowser();
    await page.waitForSelector("select.file[title='shared.vcad']"); // the first one of the folder
    await page.waitForSelector(".bar.warning");
    assert.match(await text(), /mine/);
    await page.click("text=Take what is on the disk");
    await until(async () => /theirs/.test(await text()));
    await until(() => !hasDraft("// mine"), "the draft is gone");
    await page.reload();
    await isReady();
    assert.match(await text(), /theirs/);
    assert.equal(await page.locator(".bar.warning").count(), 0);
  },

  async "jobs of a killed server are listed, and go on"() {
    write("ball.vcad", script);
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
    await until(() => isThere("ball_slices/journal.jsonl"));
    await nextDay();
    await otherBrowser();
    await page.click("#tab-export");
    await job("ball_slices", "interrupted");
    const before = readdirSync(pathOf("ball_slices")).length;
    await page.click("[data-folder=ball_slices] >> text=Resume");
    await job("ball_slices", "working");
    await until(() => readdirSync(pathOf("ball_slices")).length > before);
    await page.click("[data-folder=ball_slices] >> text=Cancel");
    await job("ball_slices", "cancelled");
  },
});
