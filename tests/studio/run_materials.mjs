// Opacities of materials, amounts, and what a version has gained and lost.
import assert from "node:assert/strict";
import { alphaInMiddle, design, isReady, page, small, test, untilOtherDesign } from "./studio_page.mjs";

await test({ viewport: small }, {
  async "opacity shows through"() {
    await page.click("#tab-materials");
    await isReady();
    for (const name of ["red", "blue"]) {
      await page.focus(`#opacity-${name}`);
      await page.keyboard.press("Home");
    }
    await isReady();
    assert.ok((await alphaInMiddle("surface"))[3] < 30);
    await page.click("text=Reset opacities");
    await page.click("text=Measure volumes");
    await page.waitForSelector(".material .amount");
    assert.match(await page.innerText(".panel"), /8\.1\d\d cm³ in all/); // 4/3 pi 12.5^3 is 8181 mm³
  },

  async "compares with a marked version"() {
    await page.click("text=Mark this version");
    await page.click("#tab-variables");
    const before = await design();
    await page.fill("[aria-label='radius, exactly']", "13.5");
    await untilOtherDesign(before);
    await page.click("#tab-materials");
    await page.click("text=Compare");
    await page.waitForSelector(".versions table");
    const cells = await page.locator(".versions td").allInnerTexts(); // 4/3 pi (13.5^3 - 12.5^3) is 2125 mm³
    assert.match(cells[0], /^2\.1\d\d cm³/);
    assert.match(cells[1], /^0(\.0*)? mm³/);
    assert.match(cells[3], /cm³/);
    await page.click("text=Forget the mark");
  },
});
