// Cuts through the surface and the volume.
import assert from "node:assert/strict";
import { alphaInMiddle, isReady, page, picture, small, test } from "./studio_page.mjs";

await test({ viewport: small }, {
  async "cuts open"() {
    await isReady();
    const whole = await alphaInMiddle("surface");
    await page.selectOption(".surface .cut", "y<");
    await isReady();
    await page.selectOption(".surface .cut", "box"); // the lower quarter: its corner is in the middle
    await isReady();
    await page.focus("[aria-label='Box, z to']");
    for (let n = 0; n < 40; ++n) await page.keyboard.press("ArrowLeft");
    await isReady();
    assert.equal((await alphaInMiddle("surface"))[3], 0);
    await page.selectOption(".surface .cut", "wedge"); // towards the eye: a face of the inside is seen
    await isReady();
    assert.notDeepEqual(await alphaInMiddle("surface"), whole);
    await picture("wedge");
    await page.check("text=Perspective");
    await isReady();
    assert.equal((await alphaInMiddle("surface"))[3], 255);
    await page.click("#tab-volume");
    await isReady("volume");
    await page.selectOption(".volume .cut", "box");
    assert.ok((await alphaInMiddle("volume"))[3] < 255);
    await page.selectOption(".volume .cut", "");
    await page.click("#tab-surface");
    await page.uncheck("text=Perspective");
  },

  async "shows the inside by rays"() {
    await page.click("#tab-volume");
    await isReady("volume");
    assert.ok((await alphaInMiddle("volume"))[3] > 200);
    await picture("volume");
  },
});
