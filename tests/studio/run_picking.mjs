// A click in the view chooses a part of a surface, and writes it into the call that takes it.
import assert from "node:assert/strict";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { copyFileSync } from "node:fs";
import { editor, folder, isReady, open, page, pathOf, picture, put, putCaret, status, test, text, textIs, until, violations } from "./studio_page.mjs";

// A cube from -5 to 5 as a mesh: each side is two triangles.
const corners = [[-5, -5, -5], [5, -5, -5], [5, 5, -5], [-5, 5, -5], [-5, -5, 5], [5, -5, 5], [5, 5, 5], [-5, 5, 5]];
const sides = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
const triangles = sides.flatMap(([a, b, c, d]) => [[a, b, c], [a, c, d]]);
const cube = `OFF\n8 12 0\n${corners.map((c) => c.join(" ")).join("\n")}\n${triangles.map((t) => `3 ${t.join(" ")}`).join("\n")}\n`;

const script = `// Cells on the top.
mesh("cube.off", material="red");
skin = surface_cells("cube.off", (5, 5, 1), height=1, normal=(0, 0, 1));  // two spaces stay
plates(skin, "cubic", 3, "blue");
`;
const cad = `cad("cylinder.step", "red");
plates(surface_cells("cylinder.step", (5, 5, 1), height=1, at=(0, 0, 20)), "cubic", 3, "blue");
`;

const repository = join(fileURLToPath(import.meta.url), "../../..");
copyFileSync(join(repository, "tests/cad/cylinder.step"), pathOf("cylinder.step"));

async function look(from) {
  await page.locator(".surface .viewbar select").first().selectOption(from);
  await isReady();
}
async function upToDate() {
  await status("[data-old=false][data-busy=false]");
  await isReady();
}
async function undo(wanted) {
  await editor().click();
  await page.keyboard.press("Control+z");
  await textIs(wanted);
  await upToDate();
}
// Clicks beside the middle of the view, in pixels.
async function click(dx, dy) {
  const box = await page.locator(".surface canvas").boundingBox();
  await page.mouse.click(box.x + box.width / 2 + dx, box.y + box.height / 2 + dy);
}
// Waits until a pick has written something, and has then removed the other condition.
const isWritten = (what) => until(async () => what.test(await text()) && !/normal/.test(await text()), String(what));
const said = () => page.textContent(".pickbar [role=status]");
const placeIn = (all) => all.match(/ at ?= ?\(([^)]*)\)/)[1].split(", ").map(Number);

await test({ files: { "cube.off": cube, "cube.vcad": script, "pipe.vcad": cad }, place: pathOf("cube.vcad"), viewport: { width: 1400, height: 860 } }, {
  async "a click on a side of a mesh writes its place and the greatest bend"() {
    await upToDate();
    await look("front");
    await putCaret("surface_cells(");
    await page.click("text=Pick at");
    assert.equal(await said(), "Click the surface that skin takes.");
    await click(30, 40);
    await isWritten(/at = /);
    const all = await text(), [x, y, z] = placeIn(all);
    // The front is at y = -5; x is to the right and z upward.
    assert.ok(Math.abs(y + 5) < 0.05, `y = ${y}`);
    assert.ok(x > 0.2 && x < 5 && z < 0 && z > -5, `${x}, ${z}`);
    assert.equal(all, script.replace("normal=(0, 0, 1))", `at = (${x}, ${y}, ${z}), angle = 20)`));
    await upToDate();
    await picture("picking_mesh");
    assert.deepEqual(await violations(), []);
  },

  async "it is one step for undo, to the byte"() {
    await undo(script);
  },

  async "a click in the moment in which the page says where to click picks"() {
    await putCaret("surface_cells(");
    await page.waitForSelector("text=Pick at");
    await page.evaluate(async () => {
      const said = () => document.querySelector(".pickbar [role=status]").textContent;
      document.querySelector(".pickbar button").click();
      while (!said().startsWith("Click")) await Promise.resolve(); // no frame is drawn meanwhile
      const canvas = document.querySelector(".surface canvas"), box = canvas.getBoundingClientRect();
      const at = { bubbles: true, button: 0, pointerId: 1, clientX: box.left + box.width / 2 + 30, clientY: box.top + box.height / 2 + 40 };
      for (const type of ["pointerdown", "pointerup"]) canvas.dispatchEvent(new PointerEvent(type, at));
    });
    await isWritten(/at = /);
    await undo(script);
  },

  async "a click counts if the page is drawn again while the button is down"() {
    await putCaret("surface_cells(");
    await page.click("text=Pick at");
    const box = await page.locator(".surface canvas").boundingBox();
    await page.mouse.move(box.x + box.width / 2 + 30, box.y + box.height / 2 + 40);
    await page.mouse.down();
    await put("Greatest bend, degrees", "35");
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => setTimeout(done, 100)))); // effects have run
    await page.mouse.up();
    await isWritten(/angle = 35/);
    await undo(script);
  },

  async "a turn of the view picks nothing, and neither does a click beside the part or Escape"() {
    await putCaret("surface_cells(");
    await page.click("text=Pick at");
    const box = await page.locator(".surface canvas").boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2, { steps: 3 });
    await page.mouse.up();
    await upToDate();
    assert.equal(await text(), script);
    await page.mouse.click(box.x + 30, box.y + box.height - 60);
    await until(async () => (await page.locator(".pickbar button[aria-pressed=true]").count()) === 1);
    await page.keyboard.press("Escape");
    await until(async () => (await page.locator(".pickbar button[aria-pressed=true]").count()) === 0);
    assert.equal(await text(), script);
  },

  async "a click on a face of a CAD file replaces the place, and writes no bend"() {
    await open("pipe.vcad");
    await upToDate();
    await look("front");
    await putCaret("surface_cells(");
    await page.waitForSelector("text=Pick at");
    assert.equal(await page.locator(".pickbar input").count(), 0);
    await page.click("text=Pick at");
    await click(0, 60);
    await until(async () => (await text()) !== cad);
    await upToDate();
    const all = await text(), [x, y, z] = placeIn(all);
    assert.ok(Math.abs(Math.hypot(x, y) - 5) < 0.1 && Math.abs(x) < 0.2 && y < 0, `${x}, ${y}`); // on the cylinder
    assert.ok(z > 0 && z < 20);
    assert.equal(all, cad.replace("at=(0, 0, 20)", `at=(${x}, ${y}, ${z})`));
    await undo(cad);
  },
});
