// Jobs of every kind, from their forms.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { ball, isThere, job, open, page, pathOf, picture, read, resetLayerHeight, slice, small, startKind, status, test, until } from "./studio_page.mjs";

// A brick of 100 mm3, whose edges are shortest where it is a cube.
const brick = "a = 3;\nb = 8;\necho(edges = a + b + 100 / (a * b));\nrectprism([a, b, 100 / (a * b)], red);\n";
const lengthOf = (name) => (isThere(name) ? read(name).length : 0);
const untilLonger = (name, length) => until(() => lengthOf(name) > length, `${name} is longer than ${length}`);

await test({ viewport: small, files: { "ball.vcad": ball(12.5), "brick.vcad": brick } }, {
  async "what is typed stays while a job goes on"() {
    await page.click("#tab-export");
    await page.selectOption(".panel .printer", "j750");
    await slice("slow_slices", "0.0001");
    await job("slow_slices", "working");
    const share = () => page.getAttribute("[data-folder=slow_slices] progress", "value");
    const field = page.locator(".option-layer-height input");
    await field.fill("0.25"); // it counts once the field is left
    const before = await share();
    await until(async () => (await share()) !== before, "news of the job");
    assert.equal(await field.inputValue(), "0.25");
    await page.keyboard.press("Enter");
    await page.waitForSelector(".panel:has-text('100 layers')"); // 25 mm
    await page.click("[data-folder=slow_slices] >> text=Cancel");
    await job("slow_slices", "cancelled");
    await resetLayerHeight();
  },

  async "runs jobs of every kind"() {
    await page.click("#tab-jobs");
    await startKind("mesh", { output: "ball.3mf", tolerance: "0.2", by: "whole" });
    await job("ball.3mf", "done");
    assert.equal(readFileSync(pathOf("ball.3mf")).subarray(0, 2).toString(), "PK");
    await startKind("voxels", { output: "ball.nrrd", voxel: "1", what: "distance" });
    await job("ball.nrrd", "done");
    assert.match(readFileSync(pathOf("ball.nrrd"), "latin1").slice(0, 400), /type: float[^]*sizes: 2[4-9] 2[4-9] 2[4-9]/);
    const study = JSON.stringify({ materials: { red: { modulus_mpa: 2000, poissons_ratio: 0.3 }, blue: { modulus_mpa: 1000, poissons_ratio: 0.3 } },
      supports: [{ on: "zmin", fix: "xyz" }], loads: [{ on: "zmax", force_n: [0, 0, -10] }] });
    await startKind("fea", { output: "ball.vtu", study, cell: "3", solve: true });
    await job("ball.vtu", "done");
    assert.match(readFileSync(pathOf("ball.vtu"), "latin1").slice(0, 4000), /displacement/i);
    await startKind("probe", { at: "0,0,0" });
    await page.waitForSelector("[data-kind=probe][data-state=done] pre:has-text('inside: true')");
    await startKind("mesh", { output: "../out.stl", tolerance: "", by: "" });
    await page.waitForSelector(".panel .error[role=alert]");
    // A search of two variables.
    const search = JSON.stringify({ variables: { a: { from: 1, to: 10, start: 3 }, b: { from: 1, to: 10, start: 8 } },
      objectives: [{ minimise: "echo", name: "edges" }], evaluations: 200000, tolerance: 1e-9, method: "direct" });
    await page.click("#tab-jobs");
    await open("brick.vcad");
    await status("[data-old=false]");
    await startKind("optimise", { output: "found", study: search });
    await job("found", "working");
    await untilLonger("found/history.csv", 200);
    await page.click("[data-folder=found] >> text=Cancel");
    await job("found", "cancelled");
    const before = read("found/history.csv");
    await page.click("[data-folder=found] >> text=Resume");
    await job("found", "working");
    await untilLonger("found/history.csv", before.length);
    await page.click("[data-folder=found] >> text=Pause");
    await job("found", "paused");
    assert.ok(read("found/history.csv").startsWith(before));
    await page.click("[data-folder=found] >> text=Cancel");
    await open("ball.vcad");
    await status("[data-old=false]");
    await picture("jobs");
  },
});
