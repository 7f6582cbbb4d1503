// Saving: reloads, two windows, changes on the disk.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { context, editor, file, isReady, job, onDisk, page, slice, small, status, test, type, untilOnDisk, url } from "./studio_page.mjs";

await test({ viewport: small }, {
  async "a reload loses nothing"() {
    await page.click("#tab-slices");
    await page.selectOption(".slices .printer", "j750");
    await page.click("#tab-export");
    await slice("ball_slices", "0.5");
    await job("ball_slices", "done");
    await page.reload();
    await isReady("slices");
    assert.equal(await page.inputValue(".slices .printer"), "j750");
    assert.match(await editor().innerText(), /radius = 12\.5/);
    await page.waitForSelector(".job[data-state=done]");
    await page.click("#tab-surface");
    await isReady();
  },

  async "two windows show the same text"() {
    const other = await context.newPage();
    await other.goto(new URL(url).origin);
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
      const send = WebSocket.prototype.send;
      let held = []; // saves that have not gone out; undefined while all go out at once
      WebSocket.prototype.send = function (text) {
        if (held && text.includes('"do":"save"')) held.push(() => send.call(this, text));
        else send.call(this, text);
      };
      window.holdSaves = (holds) => {
        for (const go of held ?? []) go();
        held = holds ? [] : undefined;
      };
    });
    const holdSaves = (holds) => page.evaluate((value) => window.holdSaves(value), holds);
    await type("// the same\n"); // here and on the disk: no conflict
    writeFileSync(file, onDisk() + "// the same\n");
    await holdSaves(false);
    await status("[data-saved=saved]");
    assert.equal(await page.locator(".bar.warning").count(), 0);
    await holdSaves(true);
    await type("// mine\n"); // is not saved in time
    writeFileSync(file, onDisk() + "// theirs\n");
    await holdSaves(false);
    await page.waitForSelector(".bar.warning");
    await page.reload(); // what was typed is a draft, the conflict is found again
    await page.waitForSelector(".bar.warning");
    assert.match(await editor().innerText(), /mine/);
    assert.match(onDisk(), /theirs/);
    await page.click("text=Keep what is here");
    await untilOnDisk("// mine");
    assert.doesNotMatch(onDisk(), /theirs/);
  },
});
