// Files that the browser gets, and what is done with files; Python scripts.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { inflateRawSync } from "node:zlib";
import { downloaded, folder, fromMenu, isReady, isThere, onDisk, open, opened, page, pathOf, read, status, test, until, write } from "./studio_page.mjs";

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

const files = {
  "ball.vcad": "radius = 8;  // [2:20]\nsphere(radius, red);\n",
  "mine_2.scad": "cube(4);\n",
  "plain.scad": "cube(6);\ntranslate([9, 0, 0]) sphere(3);\n",
  "slow.py": "import time, ombre\nprint('begun')\ntime.sleep(1 if ombre.option('short', False) else 3600)\nroot = ombre.sphere(3, 'blue')\n",
  "quick.py": "import ombre\nprint('quick')\nroot = ombre.sphere(3, 'blue')\n",
};

await test({ files, place: folder, viewport: { width: 1280, height: 800 } }, {
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
    assert.ok(!isThere("ball.3mf") && !isThere("ball.stl"));
    await page.click("#tab-export");
    await page.selectOption(".panel .printer", "");
    await page.click("summary:has-text('More options')");
    await page.fill(".option-layer-height input", "1");
    await page.keyboard.press("Enter");
    await page.fill(".panel label:has-text('Folder') input", "few_slices");
    await page.waitForSelector(".panel:has-text('16 layers')");
    await page.click("button.main:has-text('Slice')");
    await page.waitForSelector("[data-folder=few_slices][data-state=done]");
    const zip = await downloaded(() => page.click("[data-folder=few_slices] >> text=Download as zip"));
    assert.equal(zip.name, "few_slices.zip");
    assert.deepEqual(namesIn(zip.bytes).sort(), readdirSync(pathOf("few_slices")).map((name) => `few_slices/${name}`).sort());
    assert.ok(memberOf(zip.bytes, "few_slices/job.json").equals(readFileSync(pathOf("few_slices/job.json"))));
    await page.fill(".option-layer-height input", "");
    await page.keyboard.press("Enter");
    await page.click("#tab-variables");
  },

  async "what is typed into a dialog stays while the page is drawn anew"() {
    await fromMenu("File", "Rename…");
    await page.fill("dialog[open] input", "other.vcad");
    write("ball.vcad", onDisk().replace("radius = 8", "radius = 9"));
    await page.waitForSelector(".cm-line:has-text('radius = 9')");
    await status("[data-old=false][data-busy=false]");
    assert.equal(await page.inputValue("dialog[open] input"), "other.vcad");
    await page.click("dialog[open] button:text-is('Cancel')");
  },

  async "renames, duplicates, deletes, and makes folders"() {
    const named = async (action, name, button) => {
      await fromMenu("File", action);
      if (name) await page.fill("dialog[open] input", name);
      await page.click(`dialog[open] button:text-is('${button}')`);
    };
    const isOpen = (name) => until(async () => (await opened()) === name, name);
    await named("New folder…", "parts", "Make");
    await until(() => isThere("parts"));
    await open("mine_2.scad");
    await named("Rename…", "parts/cube.scad", "Rename");
    await isOpen("parts/cube.scad");
    assert.ok(!isThere("mine_2.scad"));
    await named("Duplicate…", "parts/cube_copy", "Duplicate");
    await isOpen("parts/cube_copy.scad");
    assert.equal(read("parts/cube_copy.scad"), read("parts/cube.scad"));
    await named("Rename…", "ball.scad", "Rename");
    await isOpen("ball.scad");
    await named("Rename…", "plain.scad", "Rename");
    await page.waitForSelector(".problems:has-text('plain.scad is there already')");
    await named("Delete…", "", "Delete");
    await until(() => !isThere("ball.scad"));
    assert.equal(readdirSync(pathOf(".ombre-trash")).filter((name) => name.endsWith("ball.scad")).length, 1);
    await until(async () => !["", "ball.scad"].includes(await page.inputValue("select.file")));
  },

  async "examples have pictures"() {
    await page.click("#tab-examples");
    await page.waitForSelector(".examples .picture img");
    await until(() => page.evaluate(() => [...document.querySelectorAll(".examples .picture img")].some((image) => image.naturalWidth > 50)));
    await page.click("#tab-variables");
  },

  async "a Python script tells at once what it says, and can be stopped"() {
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
});
