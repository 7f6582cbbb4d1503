// What people see: views that survive a reload, mistakes, links, fingers.
import assert from "node:assert/strict";
import { join } from "node:path";
import { context, editor, folder, fromMenu, isReady, isSaved, onDisk, open, page, pictures, shownBox, status, test, type, until, untilOnPage, url } from "./studio_page.mjs";

const script = "radius = 8;  // [2:20]\nsphere(radius, red);\n";
const files = { "ball.vcad": script, "shared.vcad": `${script}// theirs\n`, "wrong.vcad": "spher(3);\ncubee(4);\nx = foo(2);\n" };

await test({ files, place: folder, viewport: { width: 1280, height: 800 } }, {
  async "undo survives a change of file"() {
    await open("ball.vcad");
    await type("// first\n");
    await isSaved();
    await open("shared.vcad");
    await open("ball.vcad");
    await editor().click();
    await page.keyboard.press("Control+z");
    await until(() => onDisk() === script);
    await isSaved();
  },

  async "sliders and camera survive a reload"() {
    await page.fill("[aria-label='radius, exactly']", "12.5");
    await page.selectOption(".surface .viewbar select >> nth=0", "top");
    await page.selectOption(".surface .cut", "x>");
    await status("[data-busy=false][data-old=false]");
    await untilOnPage(() => Object.values(localStorage).some((kept) => kept.includes('"side":">"'))); // how the file is seen is kept
    await page.reload();
    await isReady();
    assert.equal(await page.inputValue("[aria-label='radius, exactly']"), "12.5");
    assert.equal(await page.inputValue(".surface .cut"), "x>");
    const { width, height } = await shownBox("surface"); // half of the ball, from above
    assert.ok(Math.abs(height / width - 2) < 0.1, `${width} x ${height}`);
    await page.selectOption(".surface .cut", "");
    await page.click("button:text-is('Reset')");
  },

  async "a picture of another file does not stay"() {
    await isReady();
    assert.ok(await shownBox("surface"));
    await open("wrong.vcad");
    await status("[data-old=true]");
    assert.equal(await shownBox("surface"), null);
  },

  async "all mistakes are listed, and the header stays where it is"() {
    const size = () => page.locator("header").boundingBox();
    await open("ball.vcad");
    await isReady();
    const before = await size();
    await open("wrong.vcad");
    await page.waitForSelector('.problems[data-errors="3"]');
    assert.deepEqual(await page.locator(".problems .place").allInnerTexts(), ["1:1", "2:1", "3:5"]);
    assert.deepEqual(await size(), before);
    for (const width of [820, 1000, 1280, 1920]) {
      await page.setViewportSize({ width, height: 800 });
      const header = await page.locator("header").evaluate((element) => [element.scrollWidth, element.clientWidth, element.clientHeight]);
      assert.ok(header[0] <= header[1], `the header is ${header[0]} wide of ${width}`);
      assert.ok(header[2] <= 42, `the header is ${header[2]} high`);
    }
    await page.setViewportSize({ width: 1280, height: 800 });
    await open("ball.vcad");
    await isReady();
  },

  async "links lead to a file and to a state of it"() {
    await page.goto(`${new URL(url).origin}/?file=ball.vcad&view=surface&cut=x%3E0&D=radius%3D15`);
    await isReady();
    assert.equal(await page.inputValue("select.file"), "ball.vcad");
    assert.equal(await page.inputValue("[aria-label='radius, exactly']"), "15");
    assert.equal(await page.inputValue(".surface .cut"), "x>");
    assert.equal(await page.inputValue("[aria-label='Place of the cut, exactly']"), "0");
    await page.fill("[aria-label='Place of the cut, exactly']", "3");
    await page.keyboard.press("Enter");
    await context.grantPermissions(["clipboard-read", "clipboard-write"]);
    await fromMenu("File", "Copy link");
    let link = "";
    await until(async () => (link = await page.evaluate(() => navigator.clipboard.readText())).includes("file=ball.vcad"));
    const query = new URL(link).searchParams;
    assert.deepEqual([query.get("cut"), query.get("D"), query.get("view"), query.get("token")], ["x>3", "radius=15", "surface", null]);
    await page.click("button:text-is('Reset')");
    await page.selectOption(".surface .cut", "");
  },

  async "two fingers move and zoom a view, and a ball stays round when the view changes its size"() {
    const isRound = async () => {
      let shown;
      await until(async () => {
        shown = await shownBox("surface"); // the first pictures are coarse
        return Math.abs(shown.width - shown.height) < Math.max(0.04 * shown.height, 2.5 * shown.pixel);
      }, "a round ball");
      return shown.width;
    };
    await isReady();
    const before = await isRound();
    await page.evaluate(() => {
      const canvas = document.querySelector(".surface canvas");
      canvas.setPointerCapture = () => undefined; // these fingers are none of the system
      const box = canvas.getBoundingClientRect();
      const finger = (type, id, x) => canvas.dispatchEvent(new PointerEvent(type, { pointerId: id, pointerType: "touch", buttons: 1, bubbles: true, clientX: box.left + x, clientY: box.top + 200 }));
      finger("pointerdown", 11, 200);
      finger("pointerdown", 12, 300);
      for (let n = 1; n <= 10; ++n) {
        finger("pointermove", 11, 200 + 2.5 * n);
        finger("pointermove", 12, 300 - 2.5 * n);
      }
      finger("pointerup", 11, 225);
      finger("pointerup", 12, 275);
    });
    await page.waitForSelector(".surface canvas:not([data-state=ready])");
    await isReady();
    const after = await isRound();
    assert.ok(Math.abs(after / before - 0.5) < 0.05, `${before} and ${after}`);
    for (const size of [{ width: 900, height: 800 }, { width: 1600, height: 500 }, { width: 1280, height: 800 }]) {
      await page.setViewportSize(size);
      await isRound(); // also before there is a new picture
      await isReady();
      await isRound();
    }
  },

  async "pictures of the page"() {
    await open("ball.vcad");
    await page.click("#tab-all");
    for (const width of pictures ? [820, 1280, 1920] : []) {
      await page.setViewportSize({ width, height: width === 1920 ? 1080 : 800 });
      for (const view of ["surface", "slices", "volume"]) await isReady(view);
      await page.screenshot({ path: join(pictures, `studio_${width}.png`) });
      await page.click("#tab-surface");
      await page.click("header summary:text-is('File')");
      await page.click("#tab-examples", { force: true });
      await page.waitForSelector(".examples .picture img");
      await isReady();
      await page.click("header summary:text-is('File')");
      await page.screenshot({ path: join(pictures, `studio_${width}_menu.png`) });
      await page.keyboard.press("Escape");
      await open("wrong.vcad");
      await page.waitForSelector('.problems[data-errors="3"]');
      await page.screenshot({ path: join(pictures, `studio_${width}_mistakes.png`) });
      await open("ball.vcad");
      await page.click("#tab-all");
    }
  },
});
