// Scans in three planes.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { gunzipSync } from "node:zlib";
import { alphaInMiddle, ball, isReady, open, page, picture, small, test, until } from "./studio_page.mjs";
import { source } from "./studio_server.mjs";

const scan = readFileSync(join(source, "examples/models/two_lobes.nrrd"));

await test({ viewport: small, files: { "ball.vcad": ball(12.5), "two_lobes.nrrd": scan } }, {
  async "shows a scan in three planes, and what it makes of it"() {
    await open("two_lobes.nrrd");
    await page.waitForSelector(".plane canvas[data-state=ready] >> nth=2");
    await page.waitForSelector(".scaninfo:has-text('0 to 200, uint8')");
    // The crosshair begins in the middle, whose number ombre info and the file agree on.
    const here = () => page.getAttribute(".scaninfo dd[data-value]", "data-value").then(Number);
    await page.waitForSelector(".scaninfo:has-text('23, 18, 9')");
    const numbers = scan.subarray(scan.indexOf("\n\n") + 2); // 46 x 37 x 19 bytes, unless they are packed
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
    await until(async () => (await brightness()) > before, "a brighter picture");
    await picture("scan");
    await page.click("#tab-surface");
    await isReady();
    assert.equal((await alphaInMiddle("surface"))[3], 255);
  },
});
