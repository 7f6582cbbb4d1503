// Sliders, presets and files for variables.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { ball, design, editor, holdRequests, isReady, isSaved, page, pathOf, picture, small, status, test, text, textIs, typeAll, untilOnDisk, untilOnDiskIs, untilOnPage, untilOtherDesign, write } from "./studio_page.mjs";

const solid = (side) => `OFF\n4 4 0\n0 0 0\n${side} 0 0\n0 ${side} 0\n0 0 ${side}\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n`;
const files = {
  "ball.vcad": ball(12),
  "small.off": solid(4),
  "picked.vcad": 'shape = "small.off";\nother = "";  // [*.off, *.obj]\nversion = "no.file";\nmesh(shape, red);\n',
};

await test({ viewport: small, files }, {
  async "a slider changes the design, and the camera stays"() {
    await isReady();
    const bar = await page.innerText(".surface .scalebar");
    const before = await design();
    await page.focus("#variable-radius");
    await page.keyboard.press("ArrowRight");
    await untilOtherDesign(before);
    assert.equal(await page.innerText(".surface .scalebar"), bar);
    await page.click("text=Write into the script");
    await untilOnDisk("radius = 13;");
    const exactly = page.locator("[aria-label='radius, exactly']");
    await exactly.press("Control+a");
    await exactly.pressSequentially("13.25");
    assert.equal(await exactly.inputValue(), "13.25");
    await page.click("text=Write into the script");
    await untilOnDisk("radius = 13.25;");
    await page.fill("[aria-label='radius, exactly']", "12.5");
    await page.click("text=Write into the script");
    await untilOnDisk("radius = 12.5;");
  },

  async "values are written where their variables are in the text as it is now"() {
    await isSaved();
    await status("[data-old=false][data-busy=false]");
    const before = await text();
    await page.fill("[aria-label='radius, exactly']", "7.25");
    await page.evaluate(holdRequests, ['"do":"load"']);
    await editor().click();
    await page.keyboard.press("Control+Home");
    await page.keyboard.insertText("// longer\n");
    await page.click("text=Write into the script");
    await page.evaluate(() => window.sendHeld());
    const after = `// longer\n${before.replace("12.5;", "7.25;")}`;
    await textIs(after);
    await untilOnDiskIs(after);
    await typeAll(before);
    await untilOnDiskIs(before);
  },

  async "keeps presets beside the script"() {
    const presetsFile = pathOf("ball.presets.json");
    const setRadius = (value) => page.fill("[aria-label='radius, exactly']", value);
    const radius = () => page.inputValue("[aria-label='radius, exactly']");
    const savePreset = async (name, button) => {
      await page.click("text=Save as a preset");
      await page.fill("[aria-label='Name of the preset']", name);
      await page.click(`.presets button:text-is('${button}')`);
      await page.waitForSelector("text=Save as a preset");
    };
    await setRadius("7");
    await savePreset("small", "Save");
    await setRadius("18.5");
    await page.waitForSelector(".preset option:has-text('small (changed)')", { state: "attached" });
    await savePreset("large", "Save");
    assert.deepEqual(JSON.parse(readFileSync(presetsFile)), { parameterSets: { small: { radius: "7" }, large: { radius: "18.5" } }, fileFormatVersion: "1" });
    const before = await design();
    await page.selectOption(".preset", "small");
    assert.equal(await radius(), "7");
    await untilOtherDesign(before);
    await setRadius("8");
    await savePreset("small", "Replace");
    assert.equal(JSON.parse(readFileSync(presetsFile)).parameterSets.small.radius, "8");
    await picture("presets");
    await page.selectOption(".preset", "large");
    assert.equal(await radius(), "18.5");
    await page.click("text=Delete preset");
    await untilOnPage(() => document.querySelectorAll(".preset option").length === 2);
    assert.equal(JSON.parse(readFileSync(presetsFile)).parameterSets.large, undefined);
    write("ball.presets.json", "mine");
    await page.reload();
    await page.waitForSelector(".presets:has-text('ball.presets.json is no file of presets')");
    assert.ok(await page.isDisabled("text=Save as a preset"));
    assert.equal(readFileSync(presetsFile, "utf8"), "mine");
    rmSync(presetsFile);
    await page.focus(".preset");
    await page.waitForSelector("button:not([disabled]):has-text('Save as a preset')");
    await isReady();
    assert.equal(await radius(), "18.5"); // what a slider says survives as well
    await page.click("button:text-is('Reset')");
    assert.equal(await radius(), "12.5");
    await status("[data-old=false][data-busy=false]");
    await isReady();
  },

  async "chooses files for variables"() {
    await page.selectOption("select.file", "picked.vcad");
    await page.waitForSelector("select#variable-shape");
    await isReady();
    assert.equal(await page.inputValue("#variable-shape"), "small.off");
    assert.deepEqual(await page.locator("#variable-other option").allInnerTexts(), ["choose…", "small.off"]);
    assert.equal(await page.getAttribute("#variable-version", "type"), "text"); // no file ends so
    mkdirSync(pathOf("more"));
    write("more/large.off", solid(8));
    await page.focus("#variable-shape");
    await page.waitForSelector("#variable-shape option[value='more/large.off']", { state: "attached" });
    const before = await design();
    await page.selectOption("#variable-shape", "more/large.off");
    await untilOtherDesign(before);
    await page.click("#tab-materials");
    await page.waitForSelector(".panel:has-text('8 × 8 × 8 mm')");
  },
});
