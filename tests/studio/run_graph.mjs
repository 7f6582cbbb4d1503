// Opacity by an attribute, and the graph of nodes.
import assert from "node:assert/strict";
import { ball, isReady, open, page, picture, selected, small, test, until, untilOnPage, violations } from "./studio_page.mjs";

// From -10 on the left to 10 on the right.
const warm = 'attribute("heat", "x", unit="K") cube(20, red);\n';

await test({ viewport: small, files: { "ball.vcad": ball(12.5), "warm.vcad": warm } }, {
  async "opacity by an attribute shows what has a value"() {
    await open("warm.vcad");
    await page.click("#tab-volume");
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
    await until(async () => { // the picture follows the curve
      const [cold, hot] = await columns();
      return cold === 0 && hot > 200;
    }, "clear on the left, opaque on the right");
    await picture("transfer");
    await page.keyboard.press("Delete");
    assert.equal(await points.count(), 2);
    assert.deepEqual(await violations(), []);
    await page.selectOption("select.file", "ball.vcad");
    await isReady("volume", "[data-by='']");
  },

  async "the graph leads to the script"() {
    await page.click("#tab-graph");
    await page.waitForSelector(".graph img[alt='What sphere makes']");
    await untilOnPage(() => [...document.querySelectorAll(".graph img")].every((image) => image.naturalWidth >= 48));
    assert.equal(await page.innerText(".graph .node:has-text('fgrade') .outputs"), "→ solid");
    assert.equal(await page.innerText(".graph li:has(> .port) > .port >> nth=0"), "solid: solid");
    assert.match(await page.innerText(".graph li:has(> .node:has-text('sphere')) > ul .free >> nth=-1"), /radius: number or field/);
    await picture("graph");
    assert.deepEqual(await violations(), []);
    await page.click(".graph .node:has-text('sphere')");
    assert.equal(await selected(6), "sphere");
  },
});
