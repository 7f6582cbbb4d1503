// Design files (JSON) are edited in the graph: each edit is one of the text, and is undone to the byte.
import assert from "node:assert/strict";
import { card, drag, end, isReady, page, pathOf, picture, put, status, test, text, textIs, until, violations } from "./studio_page.mjs";

const choose = (name) => card(name).locator(".title small").click({ position: { x: 2, y: 6 } });
const isUpToDate = () => status("[data-old=false][data-busy=false]");

const design = `{
  "format": "ombre-design",
  "version": 1,
  "materials": [{"name": "red", "r": 255, "g": 0, "b": 0, "a": 255}],
  "nodes": [
    {"id": "n1", "type": "cube", "parameters": {"side": 8,   "material": "red"}},
    {"id": "n2", "type": "translate", "parameters": {"by": [6, 0, 0]}, "inputs": ["n1"]},
    {"id": "n3", "type": "union", "inputs": ["n1", "n2"]}
  ],
  "parts": [{"name": "part", "node": "n3"}]
}
`;

async function add(name, where) {
  await page.click("text=Add…");
  await page.selectOption(".palette select", where);
  await page.fill(".palette input[type=search]", name);
  await page.locator(`.palette [data-node="${name}"]`).click();
  await page.click("text=Add…"); // closes the palette
}

await test({ files: { "part.json": design }, place: pathOf("part.json"), viewport: { width: 1600, height: 900 } }, {
  async "nodes and parts are cards, and one node goes into two"() {
    await isReady();
    await page.click("#tab-graph");
    await card("n3").waitFor();
    assert.equal(await page.locator(".card").count(), 4);
    assert.equal(await page.locator(".wire").count(), 4);
    await isUpToDate();
    await page.waitForSelector(".card img[alt='What union makes']");
    await picture("graph_json");
    assert.deepEqual(await violations(), []);
  },

  async "numbers, names and materials are edited as JSON"() {
    await put("side of n1", "9.5");
    await textIs(design.replace("8,   ", "9.5,   "));
    await put("side of n1", "nine");
    await page.waitForSelector(".graphproblem:has-text('\"nine\" is no value; write JSON')");
    await page.click(".graphproblem button");
    await put("Name of n1", "box");
    const renamed = design.replace("8,   ", "9.5,   ").replaceAll('"n1"', '"box"');
    await textIs(renamed);
    await page.locator(".stage.canvas").focus();
    for (let n = 0; n < 2; ++n) await page.keyboard.press("Control+z");
    await textIs(design);
    await isUpToDate();
  },

  async "nodes are added, connected and removed"() {
    await choose("n3");
    await add("sphere", "inside");
    const withBall = design.replace(`"inputs": ["n1", "n2"]}\n`, `"inputs": ["n1", "n2", "n4"]},\n    {"id": "n4", "type": "sphere"}\n`);
    await textIs(withBall);
    await add("noise", "end");
    const withNoise = withBall.replace(`"sphere"}\n`, `"sphere"},\n    {"id": "noise_values", "type": "noise"}\n`);
    await textIs(withNoise);
    await card("n4").locator("button.more").click();
    await page.click("text=Tidy");
    await drag(end("Output value of noise_values"), end("Input radius of n4"));
    const connected = withNoise
      .replace(`"version": 1`, `"version": 2`)
      .replace(`"type": "sphere"}`, `"type": "sphere", "parameters": {"radius": {"from": "noise_values", "output": "value"}}}`);
    await textIs(connected);
    await isUpToDate();
    assert.equal(await page.locator(".card").count(), 6);
    await card("noise_values").focus();
    await page.keyboard.press("Delete");
    await page.waitForSelector(".graphproblem:has-text('\"noise_values\" is used in line')");
    await page.click(".graphproblem button");
    await card("n2").focus();
    await page.keyboard.press("Delete");
    await textIs(connected.replace(/ +{"id": "n2".*\n/, "").replace(`["n1", "n2", "n4"]`, `["n1", "n4"]`));
    await page.locator(".stage.canvas").focus();
    for (let n = 0; n < 4; ++n) await page.keyboard.press("Control+z");
    await textIs(design);
    await isUpToDate();
  },

  async "handles move what a node of a design file is"() {
    await choose("n2");
    await page.click("#tab-surface");
    await isReady();
    const handle = page.locator("[data-handle='by 0']");
    await handle.waitFor();
    assert.equal(await handle.getAttribute("aria-label"), "by of n2: 6, 0, 0 mm");
    await page.locator(".surface .viewbar select").first().selectOption("front");
    await handle.focus();
    await page.keyboard.press("ArrowRight");
    await until(async () => (await text()) !== design);
    assert.match(await text(), /"by": \[(6\.\d+|[7-9]|1\d), 0, 0\]/);
    await page.keyboard.press("Control+z");
    await textIs(design);
  },
});
