// Handles in the views from outside and of the inside: a drag changes the number in the text by what the projection says.
import assert from "node:assert/strict";
import { editor, isReady, open, page, pathOf, picture, putCaret, small, status, test, text, textIs, until, violations } from "./studio_page.mjs";

let view = "surface";
const handle = (key) => page.locator(`.${view} [data-handle="${key}"]`);
const label = (key) => handle(key).getAttribute("aria-label");

// The numbers that a handle tells, and where it is seen, in pixels.
async function numbers(key) {
  return (await label(key)).replace(/^.*: /, "").replace(" mm", "").split(", ").map(Number);
}
async function seen(key) {
  const box = await handle(key).boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
}

// With one step the text changes once, to the last place.
async function drag(key, dx, dy, steps = 1) {
  const [x, y] = await seen(key);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps });
  await page.mouse.up();
}

async function look(from) {
  await page.locator(`.${view} .viewbar select`).first().selectOption(from);
  await isReady(view);
}

async function upToDate() {
  await status("[data-old=false][data-busy=false]");
  await isReady(view);
}

async function undo(wanted) {
  await editor().click();
  await page.keyboard.press("Control+z");
  await textIs(wanted);
  await upToDate();
}

const close = (found, wanted, within, what) => assert.ok(Math.abs(found - wanted) <= within, `${what}: ${found}, expected ${wanted} within ${within}`);

const script = `// Places.
strut([-10, 0,  0], [10, 0, 4], 1);  // two spaces stay
translate([0, 5, 0])
  sphere();
rotate([0, 0, 90]) translate(12, 0, 0) sphere(radius = 2);
path = [[-10, 8, -8], [0, 8, -8],
  [10, 8, -4]];
tube(path, 0.5);
intersection() { cube(6); half_space(normal = [0, 0, 1], offset = 2); }
`;

const regions = `use <ombre/regions.vcad>
translate([0, 0, 6])
  cube(16, assign(in_sphere(5, origin = [3, 0, 0]), "red", "blue"));
`;

const viewport = { width: 1400, height: 860 };
let pixelMm; // of the view from the front

// The end of the strut goes as far as the pointer.
async function followsThePointer() {
  const before = await seen("end 0");
  await drag("end 0", 35, 20);
  await until(async () => (await text()) !== script);
  await upToDate();
  const after = await seen("end 0");
  close(after[0] - before[0], 35, 1.2, "pixels to the right");
  close(after[1] - before[1], 20, 1.2, "pixels downward");
  await undo(script);
}

await test({ files: { "places.vcad": script, "regions.vcad": regions }, place: pathOf("places.vcad"), viewport }, {
  async "the handles of a call lie where its numbers are"() {
    await isReady();
    await look("front");
    await page.waitForTimeout(100);
    assert.equal(await page.locator(".handle").count(), 0);
    await putCaret("strut(");
    await handle("start 0").waitFor();
    assert.deepEqual([await label("start 0"), await label("end 0")], ["start of strut: -10, 0, 0 mm", "end of strut: 10, 0, 4 mm"]);
    const [start, end] = [await seen("start 0"), await seen("end 0")];
    pixelMm = 20 / (end[0] - start[0]);
    close((start[1] - end[1]) * pixelMm, 4, 0.6 * pixelMm, "z upward"); // from the front, x is to the right and z upward
    await picture("handles_strut");
    assert.deepEqual(await violations(), []);
  },

  async "a drag changes the number by what the projection says, and is one step for undo"() {
    await drag("start 0", 30, -50);
    await until(async () => (await text()) !== script);
    await upToDate();
    const [x, y, z] = await numbers("start 0");
    close(x, -10 + 30 * pixelMm, 1.1 * pixelMm, "x");
    assert.equal(y, 0);
    close(z, 50 * pixelMm, 1.1 * pixelMm, "z");
    await textIs(script.replace("[-10, 0,  0]", `[${x}, 0,  ${z}]`));
    await undo(script);
  },

  async "a number that is missing is added, and lies in the frame of the call"() {
    await putCaret("  sphere(");
    await handle("radius 0").waitFor();
    assert.deepEqual(await numbers("radius 0"), [5]);
    await drag("radius 0", 40, 25, 4); // along the line of the radius alone
    await until(async () => Math.abs((await numbers("radius 0"))[0] - 5 - 40 * pixelMm) <= 1.1 * pixelMm, "radius");
    await upToDate();
    const [radius] = await numbers("radius 0");
    await textIs(script.replace("  sphere()", `  sphere(radius = ${radius})`));
    await undo(script);
  },

  async "numbers given one by one, in a frame that is turned"() {
    await look("right"); // y is to the right; the call's x points there
    await putCaret("translate(");
    assert.equal(await label("by 0"), "by of translate: 0, 5, 0 mm");
    const [fromMiddle] = await seen("by 0");
    await putCaret("translate(12");
    await until(async () => (await label("by 0")) === "by of translate: 12, 0, 0 mm");
    const [begin] = await seen("by 0");
    const mm = 7 / (begin - fromMiddle); // y = 12 and y = 5
    close(mm, pixelMm, 0.01 * pixelMm, "the same scale from all sides");
    await drag("by 0", -40, 0);
    await until(async () => (await text()) !== script);
    await upToDate();
    const [x, y, z] = await numbers("by 0");
    close(x, 12 - 40 * mm, 1.1 * mm, "x");
    assert.deepEqual([y, z], [0, 0]);
    await textIs(script.replace("translate(12,", `translate(${x},`));
    await undo(script);
    await putCaret("translate(12, 0, 0) sphere(");
    await until(async () => (await label("radius 0")) === "radius of sphere: 2 mm");
    close(((await seen("radius 0"))[0] - begin) * mm, 2, 0.6 * mm, "the radius points along the turned x");
  },

  async "points of a curve, in the variable that holds them"() {
    await look("front");
    await putCaret("tube(");
    await handle("points 2").waitFor();
    assert.equal(await page.locator(".handle").count(), 3);
    assert.equal(await label("points 1"), "points 2 of tube: 0, 8, -8 mm");
    await picture("handles_curve");
    await drag("points 1", 0, -30);
    await until(async () => (await text()) !== script);
    await upToDate();
    const [x, y, z] = await numbers("points 1");
    assert.deepEqual([x, y], [0, 8]);
    close(z, -8 + 30 * pixelMm, 1.1 * pixelMm, "z");
    await textIs(script.replace("[0, 8, -8],\n", `[0, 8, ${z}],\n`));
    await undo(script);
  },

  async "a plane has a direction and an offset, which keys move"() {
    await putCaret("half_space(");
    await handle("offset 0").waitFor();
    await handle("normal 0").focus();
    await page.keyboard.press("ArrowRight");
    const tilted = [Math.sin(Math.PI / 36), 0, Math.cos(Math.PI / 36)].map((v) => +v.toFixed(3));
    await textIs(script.replace("normal = [0, 0, 1]", `normal = [${tilted.join(", ")}]`));
    assert.equal(await page.textContent(".surface .handlestatus"), `normal of half_space: ${tilted.join(", ")}`);
    await page.keyboard.press("Control+z");
    await textIs(script);
    await handle("offset 0").focus();
    await page.keyboard.press("ArrowUp");
    await until(async () => (await text()) !== script);
    const [up] = await numbers("offset 0");
    assert.ok(up > 2 && /^[125]0*$/.test(String(Math.round((up - 2) * 1e6))), `a step from 2 to ${up}`);
    await page.keyboard.press("ArrowDown");
    await textIs(script);
    await page.keyboard.press("Shift+ArrowDown");
    await until(async () => (await text()) !== script);
    close((await numbers("offset 0"))[0], 2 - 10 * (up - 2), 1e-9, "ten steps");
    await page.keyboard.press("Control+z");
    await textIs(script);
  },

  async "with perspective, a place follows the pointer"() {
    await page.check("text=Perspective");
    await upToDate();
    await putCaret("strut(");
    await handle("end 0").waitFor();
    await followsThePointer();
    await page.uncheck("text=Perspective");
  },

  async "in the volume, handles lie on what is seen, and follow the pointer"() {
    await page.setViewportSize(small); // drawn soon
    await page.click("#tab-volume");
    view = "volume";
    await isReady(view);
    await page.selectOption(".volume select:has(option[value='32'])", "32");
    await look("front");
    await putCaret("strut(");
    await handle("end 0").waitFor();
    await picture("handles_volume");
    assert.deepEqual(await violations(), []);
    // How much is seen beside the end of the strut, to the right by some pixels.
    const opacityBeside = async (right) => {
      const box = await page.locator(".volume canvas").boundingBox(), [x, y] = await seen("end 0");
      return page.evaluate(([x, y]) => {
        const canvas = document.querySelector(".volume canvas"), copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
        copy.drawImage(canvas, 0, 0);
        return copy.getImageData(Math.round(x), Math.round(y), 1, 1).data[3];
      }, [x - box.x + right, y - box.y]);
    };
    const lieOnTheStrut = async () => {
      const millimetre = ((await seen("end 0"))[0] - (await seen("start 0"))[0]) / 20;
      assert.ok((await opacityBeside(-millimetre)) > 0 && (await opacityBeside(4 * millimetre)) === 0);
    };
    await lieOnTheStrut();
    await page.check("text=Perspective");
    await lieOnTheStrut();
    await followsThePointer();
    await page.uncheck("text=Perspective");
    await page.uncheck("text=Handles");
    assert.equal(await page.locator(".handle").count(), 0);
    await page.check("text=Handles");
    await page.click("#tab-surface");
    await page.setViewportSize(viewport);
    view = "surface";
    await isReady();
  },

  async "a card of the graph is chosen, and its handles are seen"() {
    await page.click("#tab-graph");
    await page.locator(".card[aria-label^='tube,']").locator(".title").click();
    await page.click("#tab-surface");
    await isReady();
    await handle("points 0").waitFor();
    await page.uncheck("text=Handles");
    assert.equal(await page.locator(".handle").count(), 0);
    await page.check("text=Handles");
    await handle("points 0").waitFor();
  },

  async "an operator's places lie in the frame of the solid that it is for"() {
    await open("regions.vcad");
    await upToDate();
    await look("front");
    await putCaret("translate(");
    await handle("by 0").waitFor();
    const moved = await seen("by 0");
    await putCaret("in_sphere(");
    await handle("radius 0").waitFor();
    const [origin, radius] = [await seen("origin 0"), await seen("radius 0")];
    close((radius[0] - origin[0]) / (origin[0] - moved[0]), 5 / 3, 0.02, "the radius beside the way to the origin");
    close(origin[1], moved[1], 0.6, "the height of the origin");
    await drag("origin 0", 0, 40);
    await until(async () => (await text()) !== regions);
    await upToDate();
    const [x, y, z] = await numbers("origin 0");
    assert.deepEqual([x, y], [3, 0]);
    close(z, (-40 * 3) / (origin[0] - moved[0]), 0.1, "z, downward");
    await textIs(regions.replace("[3, 0, 0]", `[3, 0, ${z}]`));
    await undo(regions);
  },

  async "nothing is shown for numbers that are computed, made by loops, or below a warp"() {
    const other = `size = 4;
sphere(size / 2);
for (n = [0:1]) translate([n, 0, 0]) sphere(1);
twist(rate = 5) strut([0, 0, 0], [0, 0, 5], 1);
`;
    await editor().click();
    await page.keyboard.press("Control+a");
    await page.keyboard.insertText(other);
    await upToDate();
    for (const part of ["\nsphere(", "translate(", "strut("]) {
      await putCaret(part);
      await upToDate();
      assert.equal(await page.locator(".handle").count(), 0, part);
    }
  },
});
