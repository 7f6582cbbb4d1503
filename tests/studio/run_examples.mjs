// From an empty folder to a sliced example; less motion.
import assert from "node:assert/strict";
import { editor, folder, isThere, page, picture, test } from "./studio_page.mjs";

await test({ files: {}, place: folder }, {
  async "from an empty folder to a sliced example, by keys and names that are seen"() {
    await page.click("text=See examples");
    await page.fill("input[type=search]", "knob");
    await page.click("[aria-label='Open a copy of knob']");
    await page.waitForSelector(".surface canvas[data-state=ready]");
    await picture("example");
    await page.keyboard.press("Alt+s");
    await page.click("button.main:has-text('Slice')");
    await page.waitForSelector(".job[data-state=done]");
    assert.ok(isThere("knob/knob_slices/job.json"));
  },

  async "nothing moves by itself for people who want less motion"() {
    const moving = () =>
      page.evaluate(() => {
        const moves = (style) => style.animationName !== "none" || style.transitionDuration.split(",").some((time) => parseFloat(time) > 0);
        const all = [...document.querySelectorAll("*")];
        return all.filter((e) => [undefined, "::before", "::after"].some((part) => moves(getComputedStyle(e, part)))).map((e) => `${e.tagName} ${e.className}`);
      });
    await page.emulateMedia({ reducedMotion: "no-preference" });
    await editor().click();
    assert.ok((await moving()).some((name) => name.includes("cm-cursorLayer"))); // the cursor blinks
    await page.emulateMedia({ reducedMotion: "reduce" });
    for (const tab of ["all", "materials", "export", "reference", "examples", "variables"]) {
      await page.click(`#tab-${tab}`);
      await editor().click();
      assert.deepEqual(await moving(), [], tab);
      assert.equal(await page.evaluate(() => document.getAnimations().length), 0);
    }
    await page.emulateMedia({ reducedMotion: null });
  },
});
