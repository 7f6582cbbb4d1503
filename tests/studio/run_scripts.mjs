// Scripts of OpenSCAD and Python, results and tables.
import assert from "node:assert/strict";
import { appendFileSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { alphaInMiddle, ball, design, holdRequests, isReady, open, opened, page, pathOf, picture, small, test, untilOtherDesign } from "./studio_page.mjs";
import { source } from "./studio_server.mjs";

const models = join(source, "examples/models");
const files = {
  "ball.vcad": ball(12.5),
  "box.scad": 'width = 4; // [1:9]\ncolor("red") cube([width, 3, 2]);\n',
  "drop.py": "import ombre\nroot = ombre.sphere(3, 'blue')\n",
  "bent_beam.vtu": readFileSync(join(models, "bent_beam.vtu")),
  "history.csv": "round,elements,change,greatest von Mises stress [MPa]\n1,256,,13.5\n2,256,0.25,11.75\n3,256,0.03125,11.5\n",
};

await test({ viewport: small, files }, {
  async "shows OpenSCAD scripts, and Python scripts when they are run"() {
    await open("box.scad");
    await page.waitForSelector("#variable-width");
    await isReady();
    assert.equal((await alphaInMiddle("surface"))[3], 255);
    await open("drop.py");
    await page.waitForSelector(".cm-line:has-text('import ombre')");
    await page.waitForSelector(".tok-keyword:text-is('import')"); // which is a word of Python alone
    const before = await design();
    await page.click("button:has-text('Run')");
    await untilOtherDesign(before);
    await isReady();
    const [red, , blue] = await alphaInMiddle("surface");
    assert.ok(blue > red);
  },

  async "shows results in colours, and moved by their displacement"() {
    await open("bent_beam.vtu");
    await page.waitForSelector(".colours");
    await isReady();
    const [least, most] = (await page.getAttribute(".colours", "data-range")).split(",").map(Number);
    assert.ok(Math.abs(least - 1.1089) < 0.001 && Math.abs(most - 13.458) < 0.001, `${least} to ${most}`); // as ombre info says
    const before = await design();
    await page.fill("[aria-label='deform, exactly']", "10");
    await untilOtherDesign(before);
    await page.fill("[aria-label='Value of the last colour']", "8");
    await page.keyboard.press("Enter");
    await isReady();
    await picture("results");
  },

  async "shows tables as charts, and their news"() {
    await open("history.csv");
    await page.waitForSelector("[data-column=change][data-points='2']"); // of the first round there is none
    assert.match(await page.getAttribute("[data-column^=greatest] svg", "aria-label"), /by round: 3 points from 11\.5 to 13\.5, the last is 11\.5/);
    appendFileSync(pathOf("history.csv"), "4,256,0.015,11.4\n");
    await page.waitForSelector("[data-column=change][data-points='3']");
    await picture("charts");
    await open("ball.vcad");
    await page.click("#tab-surface");
    await isReady();
  },

  async "of two files that are asked for, the last one is shown"() {
    await page.evaluate(holdRequests, ['"do":"open"', "box.scad"]);
    await page.selectOption("select.file", "box.scad");
    await open("history.csv");
    await page.evaluate(() => window.sendHeld());
    await page.waitForTimeout(500); // the answer comes, and counts no longer
    assert.equal(await opened(), "history.csv");
  },

  async "what is at a point of another file is not shown"() {
    await open("ball.vcad");
    await page.click("#tab-slices");
    await isReady("slices");
    await page.evaluate(holdRequests, ['"do":"probe"']);
    await page.click(".slices canvas");
    await open("box.scad");
    await isReady("slices");
    await page.evaluate(() => window.sendHeld());
    await page.waitForTimeout(500); // the answer comes, and counts no longer
    assert.equal(await page.locator(".probe").count(), 0);
  },

  async "a file that is chosen while the page begins stays open"() {
    await page.addInitScript(holdRequests, ['"do":"jobs"']);
    await page.reload();
    await open("box.scad");
    await page.evaluate(() => window.sendHeld());
    await page.waitForTimeout(500); // the page would now open the file that was open last
    assert.equal(await opened(), "box.scad");
  },
});
