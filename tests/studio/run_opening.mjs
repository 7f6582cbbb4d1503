// Files that people have are opened, and never overwritten unasked.
import assert from "node:assert/strict";
import { copyFileSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { drop, folder, isReady, isThere, open, opened, page, pathOf, read, shownBox, test, until, write } from "./studio_page.mjs";
import { source } from "./studio_server.mjs";

const models = join(source, "examples/models");

await test({ place: folder, viewport: { width: 1280, height: 800 } }, {
  async "an OpenSCAD script without colours is shown"() {
    write("plain.scad", "cube(6);\ntranslate([9, 0, 0]) sphere(3);\n");
    await open("plain.scad");
    await isReady();
    assert.ok(await shownBox("surface"));
    assert.equal(await page.locator(".problems li.error").count(), 0);
  },

  async "opens what people have"() {
    const made = { "tetrahedron.off": "mesh(", "gear.stl": "mesh(", "textured_cube.obj": "mesh(", "wheel.3mf": "mesh(", "bracket.step": "cad(", "two_lobes.nrrd": "volume_solid(", "bent_beam.vtu": "results(", "leaf.png": "relief(" };
    for (const [name, call] of Object.entries(made)) {
      const script = name.replace(/\.\w+$/, ".vcad");
      await drop([[name, readFileSync(join(models, name))]]);
      await until(async () => (await opened()) === script, script);
      assert.ok(read(script).includes(`${call}"${name}"`), read(script));
      assert.ok(readFileSync(pathOf(name)).equals(readFileSync(join(models, name))));
      await page.waitForSelector(".surface canvas[data-design]", { state: "attached" });
    }
    await page.click("#tab-surface");
    await isReady();
    assert.ok(await shownBox("surface"));
    // Models that lie in the folder are listed, and shown by a script.
    await open("gear.stl");
    await page.waitForSelector(".bar:has-text('A script that shows gear.stl')");
    await isReady();
    await drop([["letter.docx", "x"]]);
    await page.waitForSelector(".problems:has-text('letter.docx is no file that designs read')");
    await page.setInputFiles("[aria-label='Files to open']", [{ name: "mine.scad", mimeType: "", buffer: Buffer.from("cube(3);\n") }]);
    await until(async () => (await opened()) === "mine.scad");
    await isReady();
  },

  async "opens folders, and never overwrites unasked"() {
    const given = mkdtempSync(join(tmpdir(), "ombre-given-"));
    mkdirSync(join(given, "kit/parts"), { recursive: true });
    writeFileSync(join(given, "kit/kit.vcad"), 'mesh("parts/body.off", blue);\n');
    copyFileSync(join(models, "tetrahedron.off"), join(given, "kit/parts/body.off"));
    await page.setInputFiles("[aria-label='Folder to open']", join(given, "kit"));
    await until(async () => (await opened()) === "kit/kit.vcad");
    await isReady();
    assert.ok(isThere("kit/parts/body.off"));
    rmSync(given, { recursive: true });
    const scad = (side) => [["mine.scad", `cube(${side});\n`]];
    await drop(scad(4));
    await page.waitForSelector("dialog[open]:has-text('mine.scad is there already')");
    await page.click("dialog[open] button:text-is('Keep both')");
    await until(async () => (await opened()) === "mine_2.scad");
    assert.equal(read("mine.scad") + read("mine_2.scad"), "cube(3);\ncube(4);\n");
    await drop(scad(5));
    await page.click("dialog[open] button:text-is('Cancel')");
    assert.equal(read("mine.scad"), "cube(3);\n");
    await drop(scad(6));
    await page.click("dialog[open] button:text-is('Replace')");
    await until(() => read("mine.scad") === "cube(6);\n");
  },
});
