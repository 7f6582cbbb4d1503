// A design made by the graph alone, from an empty page.
import assert from "node:assert/strict";
import { card, drag, editor, end, folder, isReady, page, picture, put, status, test, text, textIs, until, untilOnPage, violations } from "./studio_page.mjs";

async function choose(name) {
  await page.fill(".palette input[type=search]", name);
  await page.locator(`.palette [data-node="${name}"]`).click();
}

const use = "use <ombre/cellular.vcad>\n";

await test({ files: {}, place: folder, viewport: { width: 1600, height: 900 } }, {
  async "the palette puts calls into an empty script"() {
    await page.click("#tab-graph");
    await page.click("text=Add…");
    await choose("cylinder");
    await textIs("cylinder();\n");
    await choose("honeycomb_walls");
    await textIs(`${use}honeycomb_walls_values = honeycomb_walls();\ncylinder();\n`);
    await card("honeycomb_walls_values").waitFor();
    assert.deepEqual(await violations(), []);
  },

  async "values have names, numbers and formulas"() {
    await put("Name of honeycomb_walls_values", "walls");
    await textIs(`${use}walls = honeycomb_walls();\ncylinder();\n`);
    await choose("number");
    await put("Name of number", "cell");
    await put("value of cell", "6");
    await textIs(`${use}walls = honeycomb_walls();\ncell = 6;\ncylinder();\n`);
    await choose("formula");
    await put("Name of formula_values", "grade");
    await put("expression of grade", '"0.9 + x / 20"');
    await textIs(`${use}walls = honeycomb_walls();\ncell = 6;\ngrade = formula(expression = "0.9 + x / 20");\ncylinder();\n`);
  },

  async "wires are drawn from port to port"() {
    await page.click("text=Add…"); // closes the palette
    await card("walls").locator("button.more").click();
    await card("cylinder").locator("button.more").click();
    await page.click("text=Tidy");
    await drag(end("Output value of grade"), end("Input wall of walls"));
    await textIs(`${use}grade = formula(expression = "0.9 + x / 20");\nwalls = honeycomb_walls(wall = grade);\ncell = 6;\ncylinder();\n`);
    await drag(end("Output value of cell"), end("Input size of walls"));
    await textIs(`${use}grade = formula(expression = "0.9 + x / 20");\ncell = 6;\nwalls = honeycomb_walls(wall = grade, size = cell);\ncylinder();\n`);
    // Keys do the same: one end, then the other.
    await end("Output value of walls").press("Enter");
    await page.waitForSelector(".pending:has-text('A wire from walls')");
    await end("Input material of cylinder").press("Enter");
    await put("radius of cylinder", "15");
    await put("height of cylinder", "6");
    await textIs(`${use}grade = formula(expression = "0.9 + x / 20");\ncell = 6;\nwalls = honeycomb_walls(wall = grade, size = cell);\ncylinder(material = walls, radius = 15, height = 6);\n`);
  },

  async "the honeycomb is graded as the formula says"() {
    await status("[data-old=false][data-busy=false]");
    await page.click("[title='Show all']"); // pictures are made of what is seen
    await page.waitForSelector(".card img[alt='What cylinder makes']");
    assert.equal(await page.locator(".wire").count(), 3);
    await picture("graph_honeycomb");
    assert.deepEqual(await violations(), []);
    await page.click("#tab-surface");
    await isReady();
    await picture("graph_honeycomb_surface");
    await page.click("#tab-graph");
  },

  async "calls are wrapped, unwrapped, removed, and all is undone"() {
    const before = await text();
    await card("cylinder").locator(".title").click();
    await page.click("text=Add…");
    await page.selectOption(".palette select", "around");
    await choose("translate");
    await textIs(before.replace("cylinder(", "translate(by = 5) cylinder("));
    await put("by of translate", "[5, 0, 0]");
    await textIs(before.replace("cylinder(", "translate(by = [5, 0, 0]) cylinder("));
    await card("translate").focus();
    await page.keyboard.press("Shift+Delete");
    await textIs(before);
    await card("cylinder").focus();
    await page.keyboard.press("Delete");
    await textIs(before.replace(/cylinder.*\n/, ""));
    await page.locator(".stage.canvas").focus();
    for (let n = 0; n < 4; ++n) await page.keyboard.press("Control+z");
    await textIs(before);
    for (let n = 0; n < 16 && (await text()) !== ""; ++n) await page.keyboard.press("Control+z");
    await textIs("");
    for (let n = 0; n < 16 && (await text()) !== before; ++n) await page.keyboard.press("Control+y");
    await textIs(before);
  },

  async "an edit is of the card that was seen, though the text changes before it"() {
    const before = await text();
    await choose("number");
    await until(async () => (await text()) !== before, "a variable");
    const longer = await text();
    await card("cylinder").focus();
    await page.keyboard.press("Control+z");
    await textIs(before);
    await untilOnPage(() => !document.querySelector('.card[aria-label^="number,"]'));
    await card("cylinder").focus();
    await page.keyboard.press("Control+y"); // the cylinder has another number in the graph from here on
    await page.keyboard.press("Delete");
    await textIs(longer.replace(/cylinder.*\n/, ""));
    await page.locator(".stage.canvas").focus();
    for (let n = 0; n < 2; ++n) await page.keyboard.press("Control+z");
    await textIs(before);
  },

  async "calls become a module with parameters"() {
    await card("cylinder").locator(".title").click();
    await page.waitForSelector('.card.selected[aria-label^="cylinder,"]');
    await page.click("text=Group…");
    await page.fill("dialog input", "disc");
    await page.click("dialog button.main");
    await until(async () => (await text()).endsWith("disc();\n"), "the call of the module");
    assert.match(await text(), /module disc\(\n  radius = 15,\n  height = 6\n\) \{\n  cylinder\(material = walls, radius = radius, height = height\);\n\}\ndisc\(\);\n$/);
    await status("[data-old=false][data-busy=false]");
    await page.waitForSelector(".card:has-text('module disc')");
    assert.deepEqual(await violations(), []);
  },

  async "a module that needs the script stays in it"() {
    const before = await text();
    await page.locator(".card:has-text('module disc')").locator(".title").click();
    await page.click("text=Save as library…");
    await page.click("dialog button.main");
    await page.waitForSelector(".graphproblem:has-text('needs the variable \"walls\" of the script; make it a parameter')");
    await page.click(".graphproblem button");
    assert.equal(await text(), before);
  },

  async "arrows go from card to card, Enter into its fields"() {
    await card("walls").focus();
    await page.keyboard.press("ArrowLeft");
    await untilOnPage(() => /^(cell|grade),/.test(document.activeElement.getAttribute("aria-label")));
    await page.keyboard.press("Enter");
    await untilOnPage(() => document.activeElement.matches(".card .row input"));
    await page.keyboard.press("Escape");
    await untilOnPage(() => document.activeElement.matches(".card"));
    assert.ok((await editor().count()) === 1);
  },
});
