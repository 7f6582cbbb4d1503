// Opacity by an attribute, and the graph of nodes.
import assert from "node:assert/strict";
import { ball, isReady, open, page, picture, read, selected, small, status, test, text, until, untilOnPage, untilThere, violations } from "./studio_page.mjs";

// From -10 on the left to 10 on the right.
const warm = 'attribute("heat", "x", unit="K") cube(20, red);\n';

// A module, which becomes a library.
const discs = "module disc(radius = 5) {\n  cylinder(radius, 2);\n}\ndisc();\n";

// A variable and an argument that calls of functions give.
const walls = `use <ombre/cellular.vcad>
function stripes(n) = mix(red, blue, 0.5 + 0.5 * sin(36 * n * formula("x")));
walls = honeycomb_walls(5, 0.8, "red", "white");
cylinder(10, 4, walls);
translate(25, 0, 0) cylinder(10, 4, stripes(4));
`;

const loop = "// Three cubes.\nfor (i = [0 : 2]) cube(3 + i);\n";

// Lets the answer to the first request of a kind arrive after that to the second one, though the server sent it before.
async function swapAnswers(kind) {
  const membersOf = (message) => JSON.parse(typeof message === "string" ? message : message.subarray(4, 4 + message.readUInt32LE(0)));
  await page.routeWebSocket(/api/, (socket) => {
    const server = socket.connectToServer(), ids = [];
    let first, second;
    socket.onMessage((message) => {
      const { do: what, id } = membersOf(message);
      if (what === kind) ids.push(id);
      if (id === ids[1] && !first) second = message;
      else server.send(message);
    });
    server.onMessage((message) => {
      const { id } = membersOf(message);
      if (id !== undefined && id === ids[0]) {
        first = message;
        if (second) server.send(second);
        return;
      }
      socket.send(message);
      if (id !== undefined && id === ids[1]) socket.send(first);
    });
  });
}

await test({ viewport: small, files: { "ball.vcad": ball(12.5), "warm.vcad": warm, "loop.vcad": loop, "ball.scad": "sphere(5);\n", "discs.vcad": discs, "walls.vcad": walls } }, {
  async "what is chosen last is shown, whichever answer comes first"() {
    await swapAnswers("volume");
    await page.reload();
    await open("warm.vcad");
    await isReady(); // so the first volume is that of this design
    await page.click("#tab-volume");
    await page.waitForSelector(".volume select option[value=heat]", { state: "attached" });
    await page.selectOption(".volume select:has(option[value=heat])", "heat");
    await isReady("volume", "[data-by=heat]");
    await page.waitForTimeout(300); // the first answer comes, and counts no longer
    await isReady("volume", "[data-by=heat]");
    assert.equal(await page.locator(".transfer [role=slider]").count(), 2);
    await page.selectOption(".volume select:has(option[value=heat])", "");
  },

  async "opacity by an attribute shows what has a value"() {
    await page.selectOption(".volume select:has(option[value='32'])", "32");
    await page.selectOption(".volume select:has(option[value=heat])", "heat");
    await isReady("volume", "[data-by=heat]");
    await page.selectOption(".volume .viewbar select >> nth=0", "front");
    const columns = () =>
      page.evaluate(() => {
        const canvas = document.querySelector(".volume canvas");
        const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
        copy.drawImage(canvas, 0, 0);
        return [-0.25, 0.25].map((share) => copy.getImageData((canvas.width >> 1) + share * canvas.height, canvas.height >> 1, 1, 1).data[3]);
      });
    const points = page.locator(".transfer [role=slider]");
    assert.equal(await points.count(), 2);
    await points.nth(0).focus();
    await page.keyboard.press("Shift+ArrowDown"); // cold is clear
    assert.match(await points.nth(0).getAttribute("aria-valuetext"), /, opacity 0\.00$/);
    await points.nth(1).focus();
    await page.keyboard.press("Shift+ArrowUp"); // hot is opaque
    await page.click("text=Add a point");
    assert.equal(await points.count(), 3);
    const box = await page.locator(".transfer svg").boundingBox();
    await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.4 * box.width, box.y + box.height);
    await page.mouse.up();
    assert.match(await points.nth(1).getAttribute("aria-valuetext"), /^heat -(1\.9|2\.0).*, opacity 0\.00$/); // what is colder is clear
    await until(async () => { // the picture follows the curve
      const [cold, hot] = await columns();
      return cold === 0 && hot > 200;
    }, "clear on the left, opaque on the right");
    await picture("transfer");
    await page.keyboard.press("Delete");
    assert.equal(await points.count(), 2);
    assert.deepEqual(await violations(), []);
    await page.selectOption("select.file", "ball.vcad");
    await isReady("volume", "[data-by='']");
  },

  async "a module becomes a library beside the script"() {
    await open("discs.vcad");
    await page.click("#tab-graph");
    for (const name of ["module", "disc"]) await page.waitForSelector(`.card img[alt='What ${name} makes']`);
    await picture("graph_module");
    await page.locator(".card:has-text('module disc')").locator(".title").click();
    await page.click("text=Save as library…");
    await until(async () => (await page.inputValue("dialog input")) === "disc.vcad", "the name of the module");
    await page.click("dialog button.main");
    await untilThere("disc.vcad");
    await until(async () => (await text()) === "use <disc.vcad>\ndisc();\n", "the script uses the library");
    assert.equal(read("disc.vcad"), "/// Disc, from discs.vcad.\nmodule disc(radius = 5) {\n  cylinder(radius, 2);\n}\n");
    await page.waitForSelector(".card[aria-label^='disc,']");
    await status("[data-old=false][data-busy=false]");
    assert.deepEqual(await violations(), []);
    await page.click("#tab-surface");
    await page.selectOption("select.file", "ball.vcad");
    await isReady();
  },

  async "the graph leads to the script"() {
    await page.click("#tab-graph");
    await page.waitForSelector(".card img[alt='What sphere makes']");
    await untilOnPage(() => [...document.querySelectorAll(".card img")].every((image) => image.naturalWidth >= 48));
    assert.equal(await page.inputValue("[aria-label='radius of sphere']"), "radius");
    assert.equal(await page.locator(".wire.type-solid").count(), 1);
    assert.equal(await page.locator(".wire.type-number").count(), 1);
    await picture("graph");
    assert.deepEqual(await violations(), []);
    await page.click(".card:has-text('sphere') .line");
    assert.equal(await selected(6), "sphere");
  },

  async "what a loop makes is a group, which leads to its line"() {
    await open("loop.vcad");
    const group = page.locator(".card:has-text('for')");
    await page.waitForSelector(".card img[alt='What for makes']");
    await picture("graph_loop");
    await page.waitForSelector(".card:has-text('1 inside')");
    await group.locator(".fold").click();
    const cube = page.locator(".card:has-text('cube')");
    assert.match(await cube.getAttribute("aria-label"), /made by a loop/);
    assert.ok(await cube.locator("[aria-label='side of cube']").isDisabled());
    await cube.focus();
    await page.keyboard.press("Delete");
    await page.waitForSelector(".graphproblem:has-text('this is made by a loop; edit line 2')");
    assert.deepEqual(await violations(), []);
    await page.click(".graphproblem button");
  },

  async "values of functions have pictures"() {
    await open("walls.vcad");
    for (const name of ["honeycomb_walls", "stripes"]) await page.waitForSelector(`.card img[alt='What ${name} makes']`);
    await untilOnPage(() => [...document.querySelectorAll(".card img")].every((image) => image.naturalWidth >= 48));
    await picture("graph_values");
  },

  async "scripts of other languages show the nodes of the design"() {
    await open("ball.scad");
    await page.waitForSelector(".tree .node");
    assert.deepEqual(await violations(), []);
  },
});
