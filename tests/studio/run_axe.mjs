// What people with other eyes and hands need, judged by axe.
import assert from "node:assert/strict";
import { isReady, job, page, picture, resetLayerHeight, slice, startKind, test, violations } from "./studio_page.mjs";

await test({}, {
  async "axe finds nothing"() {
    await page.click("#tab-export");
    await page.selectOption(".panel .printer", "j750");
    await slice("ball_slices", "0.5");
    await job("ball_slices", "done");
    await slice("slow_slices", "0.0001");
    await job("slow_slices", "working");
    await page.click("[data-folder=slow_slices] >> text=Pause");
    await job("slow_slices", "paused");
    await resetLayerHeight();
    await page.click("#tab-jobs");
    await startKind("probe", { at: "0,0,0" });
    await page.waitForSelector("[data-kind=probe][data-state=done]");
    await page.click("#tab-all");
    await isReady("slices");
    await page.click(".slices canvas");
    await page.waitForSelector(".probe .calls");
    for (const theme of ["light", "dark"]) {
      await page.selectOption("header select >> nth=1", theme);
      for (const tab of theme === "light" ? ["reference", "examples", "variables", "materials", "export"] : ["export"]) {
        await page.click(`#tab-${tab}`);
        if (tab === "variables") await page.click("text=Save as a preset");
        assert.deepEqual(await violations(), [], `${theme} ${tab}`);
      }
      await picture(`all_${theme}`);
    }
  },
});
