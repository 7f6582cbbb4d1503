// Bundles, pictures and films.
import assert from "node:assert/strict";
import { rmSync } from "node:fs";
import { downloaded, drop, fromMenu, isReady, isThere, onDisk, open, opened, page, pathOf, read, small, test, until, write } from "./studio_page.mjs";

await test({ viewport: small }, {
  async "a bundle goes out and comes in again"() {
    await isReady();
    const made = await downloaded(() => fromMenu("Download", "Bundle"));
    assert.equal(made.name, "ball.ombre");
    const bundle = pathOf("ball.ombre");
    write("ball.ombre", made.bytes);
    await page.setInputFiles("[aria-label='Files to open']", bundle);
    await until(async () => (await opened()) === "ball/ball.vcad", "the bundle's design is open");
    assert.equal(read("ball/ball.vcad"), onDisk());
    // The same dropped on the page.
    await drop([["dropped.ombre", made.bytes]]);
    await until(async () => (await opened()) === "dropped/ball.vcad", "the dropped one is open");
    assert.equal(read("dropped/ball.vcad"), onDisk());
    await drop([["notes.txt", "hello"]]);
    await page.waitForSelector(".problems:has-text('notes.txt is no file that designs read')");
    write("ball.ombre", "no archive");
    await page.setInputFiles("[aria-label='Files to open']", bundle);
    await page.waitForSelector(".problems:has-text('this is no bundle')");
    assert.ok(!isThere("ball_2"));
    rmSync(bundle);
    await open("ball.vcad");
    await isReady();
  },

  async "makes pictures and turntables by keys"() {
    const bytesOf = (key) => downloaded(() => page.keyboard.press(key));
    const png = await bytesOf("Alt+p");
    assert.equal(png.name, "ball_surface.png");
    const stage = await page.locator(".surface canvas").boundingBox();
    assert.equal(png.bytes.readUInt32BE(16), Math.round(stage.width));
    await page.setViewportSize({ width: 900, height: 420 }); // small pictures are made soon
    const film = await bytesOf("Alt+t");
    assert.equal(film.name, "ball_turntable.webm");
    assert.equal(film.bytes.readUInt32BE(0), 0x1a45dfa3); // EBML
    assert.ok(film.bytes.length > 5000, `${film.bytes.length} bytes`);
    const gif = await bytesOf("Alt+g");
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
    await isReady();
  },
});
