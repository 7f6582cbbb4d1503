// Cuts through the surface and the volume.
import assert from "node:assert/strict";
import { alphaInMiddle, isReady, page, picture, small, test, until } from "./studio_page.mjs";

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

  async "layers are cut open at the printer's resolution"() {
    await page.click("#tab-slices");
    await isReady("slices");
    // Whether something is seen a little to the left or right of the middle, and above or below it.
    const seen = (right, above) =>
      page.evaluate(([x, y]) => {
        const canvas = document.querySelector(".slices canvas"), step = canvas.height / 8;
        return canvas.getContext("2d").getImageData(canvas.width / 2 + x * step, canvas.height / 2 - y * step, 1, 1).data[3] > 0;
      }, [right, above]);
    const quarters = async () => [await seen(-1, -1), await seen(1, -1), await seen(-1, 1), await seen(1, 1)].map(Number).join("");
    const areSeen = (wanted) => until(async () => (await quarters()) === wanted, wanted);
    await page.selectOption(".slices .cut", "");
    await areSeen("1111");
    await page.selectOption(".slices .cut", "x>");
    await areSeen("1010");
    await page.selectOption(".slices .cut", "wedge"); // towards the eye, which looks from the left and from before
    await areSeen("0111");
    await picture("slices_wedge");
    await page.selectOption(".slices .cut", "box"); // the lower quarter
    await page.focus(".slices canvas");
    for (let n = 0; n < 5; ++n) await page.keyboard.press("PageDown");
    await areSeen("1000");
    for (let n = 0; n < 10; ++n) await page.keyboard.press("PageUp"); // above the box
    await areSeen("0000");
    await page.selectOption(".slices .cut", "");
    await areSeen("1111");
  },

  async "faces of cuts show the voxels of the job"() {
    await page.click("#tab-surface");
    assert.equal(await page.locator("text=Voxels").count(), 0); // nothing is cut
    await page.selectOption(".surface .viewbar select >> nth=0", "front");
    await page.selectOption(".surface .cut", "y<");
    await isReady();
    const canvas = page.locator(".surface canvas"), box = await canvas.boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    for (let n = 0; n < 5; ++n) await page.mouse.wheel(0, -300); // voxels become larger than pixels
    await isReady();
    // The shares of pixels around the middle that have hardly any of the other material's colour: red, and blue.
    const pure = () =>
      page.evaluate(() => {
        const canvas = document.querySelector(".surface canvas"), side = 120;
        const { data } = canvas.getContext("2d").getImageData((canvas.width - side) / 2, (canvas.height - side) / 2, side, side);
        let [red, blue] = [0, 0];
        for (let n = 0; n < data.length; n += 4) {
          if (data[n] > 4 * data[n + 2]) ++red;
          if (data[n + 2] > 4 * data[n]) ++blue;
        }
        return [red / side / side, blue / side / side];
      });
    const share = (await pure()).reduce((a, b) => a + b);
    assert.ok(share < 0.1, `mixtures are mixed: ${share}`);
    // Nobody sees that the picture before is ready.
    const stateAfterClick = await page.evaluate(async () => {
      [...document.querySelectorAll(".surface label")].find((label) => label.textContent.includes("Voxels")).click();
      for (let n = 0; n < 5; ++n) await undefined; // the page is drawn anew after the event, before any other one
      return document.querySelector(".surface canvas").dataset.state;
    });
    assert.equal(stateAfterClick, "drawing");
    await isReady();
    const [red, blue] = await pure();
    assert.ok(red > 0.25 && blue > 0.25, `as much red as blue: ${red}, ${blue}`);
    await picture("face_voxels");
    await page.selectOption(".surface .cut", "wedge");
    await isReady();
    await picture("face_voxels_wedge");
    await page.uncheck("text=Voxels");
    await page.selectOption(".surface .cut", "");
    await isReady();
  },

  async "shows the inside by rays"() {
    await page.click("#tab-volume");
    await isReady("volume");
    assert.ok((await alphaInMiddle("volume"))[3] > 200);
    await picture("volume");
  },
});
