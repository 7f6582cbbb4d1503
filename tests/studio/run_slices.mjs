// Layers and their pixels, estimates, jobs for a printer.
import assert from "node:assert/strict";
import { readFileSync, realpathSync } from "node:fs";
import { join } from "node:path";
import { inflateSync } from "node:zlib";
import { folder, isReady, isThere, page, picture, read, resetLayerHeight, selected, slice, status, test, untilOnPage, violations } from "./studio_page.mjs";

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

const probed = []; // places in a layer, what is there, and what the page shows

await test({}, {
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
      await untilOnPage((old) => ![undefined, old].includes(document.querySelector(".probe")?.dataset.voxel), probed.at(-1)?.voxel);
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
    assert.equal(await selected(6), "fgrade");
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
    const slow = (state) => page.waitForSelector(`[data-folder=slow_slices][data-state=${state}]`);
    await slice("slow_slices", "0.0001");
    await slow("working");
    await page.click("[data-folder=slow_slices] >> text=Pause");
    await slow("paused");
    assert.ok(isThere("slow_slices/job.json"));
    await page.click("[data-folder=slow_slices] >> text=Resume");
    await slow("working");
    await page.click("[data-folder=slow_slices] >> text=Pause");
    await slow("paused");
    await resetLayerHeight();
    await page.fill(".panel label:has-text('Folder') input", "ball_slices");
    await page.click(".panel button.main");
    await page.waitForSelector("[data-folder=ball_slices][data-state=done]");
    const written = JSON.parse(read("ball_slices/job.json"));
    assert.ok(written.totals);
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

  async "shows layers coarsely first, and then as the printer gets them"() {
    await page.click(".slices button:has-text('fit')");
    await isReady("slices");
    const level = await page.getAttribute(".slices canvas", "data-level");
    const first = [];
    for (let n = 0; n < 6; ++n) {
      await page.focus(".slices input[type=range]");
      await page.keyboard.press("ArrowLeft");
      const layer = await page.inputValue(".slices input[type=range]");
      await isReady("slices", `[data-layer="${layer}"]`);
      const levels = (await page.getAttribute(".slices canvas", "data-levels")).split(" ");
      assert.ok(levels.includes(level));
      first.push(Number(levels[0]) - Number(level));
    }
    assert.ok(first.includes(3), `none of six layers began with voxels 8 times as long: ${first}`);
  },

  async "turns the part on the tray"() {
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
});
