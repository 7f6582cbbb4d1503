// Takes the pictures of docs/user/studio.md: a knob (studio.png, studio_graph.png, studio_slices.png,
// studio_jobs.png), a scan and results of a simulation.
//
//     node tests/studio/take_pictures.mjs build/release/apps/ombre/ombre /usr/bin/chromium docs/user
import { copyFileSync, mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { launch, serve, source, stop, token } from "./studio_server.mjs";

const target = process.argv[4];
const above = mkdtempSync(join(tmpdir(), "ombre-"));
const folder = join(above, "my_parts");
mkdirSync(folder);
copyFileSync(join(source, "examples/knob.vcad"), join(folder, "knob.vcad"));
for (const name of ["head.nrrd", "bent_beam.vtu"]) copyFileSync(join(source, "examples/models", name), join(folder, name));

const { child: server, url } = await serve(join(folder, "knob.vcad"), 0, token);
const browser = await launch();
try {
  const page = await browser.newPage({ viewport: { width: 1360, height: 800 }, colorScheme: "light" });
  const isReady = (view) => page.waitForSelector(`.${view} canvas[data-state=ready]`);
  const take = async (name) => {
    await page.waitForTimeout(3000); // the pictures become as fine as the screen
    await page.screenshot({ path: join(target, name) });
  };
  await page.goto(url);
  await isReady("surface");
  await page.selectOption(".surface select.cut", "y<");
  await page.click("#tab-materials");
  await page.click("text=Measure volumes");
  await page.waitForSelector(".material .amount");
  await page.click("#tab-all");
  for (const view of ["surface", "slices", "volume"]) await isReady(view);
  await take("studio.png");

  await page.click("#tab-graph");
  await page.click("text=Add…");
  await page.click("[title='Show all']");
  await take("studio_graph.png");
  await page.click("text=Add…");

  await page.click("#tab-slices");
  await page.click("#tab-export");
  await page.selectOption(".slices .printer", "j750");
  await page.waitForSelector(".panel:has-text('926 layers')");
  await page.click(".panel button.main");
  await page.waitForSelector(".job[data-state=done]");
  await isReady("slices");
  await page.click(".slices button:has-text('fit')");
  await page.waitForTimeout(1000);
  const box = await page.locator(".slices canvas").boundingBox();
  await page.click(".slices canvas", { position: { x: 0.25 * box.width, y: 0.6 * box.height } });
  await page.waitForSelector(".probe .calls", { timeout: 8000 });
  await take("studio_slices.png");

  await page.click("#tab-surface");
  await page.click("#tab-jobs");
  const start = async (kind, options) => {
    await page.selectOption("select.kind", kind);
    for (const [name, value] of Object.entries(options)) await page.fill(`.panel .option-${name} input`, value);
    await page.keyboard.press("Tab");
    await page.click(".panel button[type=submit]");
    await page.waitForSelector(`[data-folder="${options.output}"][data-state=done]`);
  };
  await start("mesh", { output: "knob.3mf" });
  await start("voxels", { output: "knob.nrrd", voxel: "0.5" });
  await page.selectOption("select.kind", "fea");
  await take("studio_jobs.png");

  await page.selectOption("select.file", "head.nrrd");
  await page.waitForSelector(".plane canvas[data-state=ready] >> nth=2");
  await page.click("#tab-variables");
  await page.hover(".plane canvas >> nth=1");
  await page.waitForSelector(".scaninfo dt:has-text('pointer')");
  await take("studio_scan.png");

  await page.selectOption("select.file", "bent_beam.vtu");
  await page.waitForSelector(".colours");
  await page.click("#tab-surface");
  await page.click("#tab-variables");
  await page.fill("[aria-label='deform, exactly']", "10");
  await page.keyboard.press("Enter");
  await isReady("surface");
  await take("studio_results.png");
} catch (error) {
  console.log(String(error));
  process.exitCode = 1;
  await browser.contexts()[0].pages()[0].screenshot({ path: join(tmpdir(), "ombre-pictures-failed.png") });
} finally {
  await browser.close();
  const ended = new Promise((resolve) => server.once("exit", resolve));
  server.kill("SIGINT");
  await ended;
  rmSync(above, { recursive: true, force: true });
}
