// Editing a script: mistakes, completion, help, forms of nodes, layout.
import assert from "node:assert/strict";
import { alphaInMiddle, ball, design, editor, holdRequests, isReady, page, picture, status, test, textIs, type, typeAll, untilOnDisk, untilOnDiskIs } from "./studio_page.mjs";

const script = ball(12);

await test({ files: { "ball.vcad": script } }, {
  async "opens the design and draws it"() {
    await isReady();
    assert.equal(new URL(page.url()).search, ""); // the token is not left in the address
    assert.equal((await alphaInMiddle("surface"))[3], 255);
    assert.match(await editor().innerText(), /graded from red to blue/);
  },

  async "tells mistakes while one types, and keeps the last picture"() {
    const before = await design();
    await type("spher(2);");
    await page.waitForSelector('.problems[data-errors="1"]');
    await status("[data-old=true]");
    assert.match(await page.innerText(".problems"), /did you mean "sphere"/);
    assert.match(await page.innerText(".problems .place"), /^4:1/);
    await page.waitForSelector(".cm-lintRange-error");
    await page.waitForSelector(".oldmark");
    assert.equal((await alphaInMiddle("surface"))[3], 255);
    assert.equal(await design(), before);
    await picture("error");
    await page.keyboard.press("Control+z");
    await page.waitForSelector('.problems[data-errors="0"]');
    await untilOnDiskIs(script);
    await status("[data-old=false][data-saved=saved]");
  },

  async "a mistake whose place is gone leads to the end of the text"() {
    await type("spher(2);");
    await page.waitForSelector('.problems[data-errors="1"]');
    await page.evaluate(holdRequests, ['"do":"load"']);
    await typeAll("// short");
    await page.click(".problems li button"); // until the text is evaluated, the list is that of the text before
    await page.keyboard.insertText(" text");
    await textIs("// short text");
    await page.evaluate(() => window.sendHeld());
    await typeAll(script);
    await untilOnDiskIs(script);
    await status("[data-old=false][data-saved=saved]");
  },

  async "completes names from the reference"() {
    await type("cyl");
    await page.keyboard.press("Control+Space");
    await page.waitForSelector(".cm-tooltip-autocomplete li:has-text('cylinder')");
    await page.waitForSelector(".cm-completionInfo:has-text('Cylinder along z')");
    await page.keyboard.press("Escape");
    for (let n = 0; n < 3; ++n) await page.keyboard.press("Backspace");
    await untilOnDiskIs(script);
    await status("[data-old=false][data-saved=saved]");
  },

  async "shows the reference's page of what the pointer is on"() {
    await editor().locator(".tok-typeName, .tok-keyword, span", { hasText: /^fgrade$/ }).first().hover();
    await page.waitForSelector(".cm-tooltip-hover:has-text('fgrade')");
    await page.mouse.move(5, 5);
    await page.waitForSelector(".cm-tooltip-hover", { state: "detached" });
  },

  async "writes a call of a node from its form"() {
    await page.click("#tab-reference");
    await page.click(".node-cylinder > summary");
    const field = (name) => page.locator(".node-cylinder .nodeform label", { has: page.locator(`span:text-matches("^${name}( |$)")`) });
    await field("radius").locator("input").fill("2");
    await field("height").locator("input").pressSequentially("7 + x");
    await field("material").locator("input").fill("red");
    await page.click(".node-cylinder .nodeform button");
    await untilOnDisk(`${script}\ncylinder(radius = 2, height = 7 + x, material = "red");\n`);
    assert.equal(await editor().evaluate((element) => element.ownerDocument.querySelectorAll(".node-sphere .nodeform").length), 0);
    await page.click("#tab-variables");
    await typeAll(script);
    await untilOnDiskIs(script);
    await status("[data-old=false][data-saved=saved]");
  },

  async "puts lines in their places"() {
    const crooked = "translate(30, 0, 0) union() {\nsphere(1, red);\n      }";
    await type(crooked);
    await untilOnDisk(crooked);
    await page.keyboard.press("Shift+Alt+F");
    await untilOnDisk("translate(30, 0, 0) union() {\n  sphere(1, red);\n}\n");
    await page.keyboard.press("Control+z"); // undoes the format alone
    await untilOnDisk(crooked);
    await typeAll(script);
    await untilOnDiskIs(script);
    await status("[data-old=false][data-saved=saved]");
  },
});
