// What the studio's page holds in memory after many edits, in Chromium.
//
//     node bench/studio_page.mjs build/release/apps/ombre/ombre chromium [EDITS]
//
// Each edit moves a slider and waits for the picture and the layer. Figures are bytes of JavaScript's heap after its garbage
// was collected, and nodes of the document. bench/results/studio.jsonl has them.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const source = join(dirname(fileURLToPath(import.meta.url)), "..");
const { chromium } = createRequire(join(source, "apps/studio/web/package.json"))("playwright-core");
const [ombre, browserPath, wanted = "300"] = process.argv.slice(2);
const edits = Number(wanted);
const folder = mkdtempSync(join(tmpdir(), "ombre-page-"));
writeFileSync(join(folder, "ball.vcad"), 'radius = 12;  // [5:0.01:20]\nfgrade(["0.5 + x / 40", "0.5 - x / 40"], [red, blue]) sphere(radius);\n');

const server = spawn(ombre, ["studio", folder, "--json", "--no-browser"], { env: { ...process.env, OMBRE_DATA: source }, stdio: ["ignore", "pipe", "inherit"] });
let failed = 0;
try {
  const url = await new Promise((resolve) => server.stdout.on("data", (data) => {
    const found = /"url": ?"([^"]+)"/.exec(data);
    if (found) resolve(found[1]);
  }));
  const browser = await chromium.launch({ executablePath: browserPath, args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
  const page = await browser.newPage({ viewport: { width: 1000, height: 600 } });
  const devtools = await page.context().newCDPSession(page);
  await devtools.send("Performance.enable");
  await page.goto(url);
  await page.click("#tab-all");
  await page.waitForSelector(".surface canvas[data-state=ready]");
  let design = await page.getAttribute(".surface canvas", "data-design");
  for (let n = 1; n <= edits; ++n) {
    await page.fill("[aria-label='radius, exactly']", String(8 + (n % 400) / 100));
    // All views show the same design before the next edit.
    await page.waitForSelector(`.surface canvas:not([data-design="${design}"])[data-state=ready]`);
    design = await page.getAttribute(".surface canvas", "data-design");
    await page.waitForSelector(`.slices canvas[data-design="${design}"][data-state=ready]`);
    if (![Math.ceil(edits / 3), Math.ceil((2 * edits) / 3), edits].includes(n)) continue;
    await devtools.send("HeapProfiler.collectGarbage");
    const { metrics } = await devtools.send("Performance.getMetrics");
    const of = (name) => metrics.find((m) => m.name === name).value;
    console.log(`${n} edits: ${(of("JSHeapUsedSize") / 1e6).toFixed(1)} MB, ${of("Nodes")} nodes`);
  }
  await browser.close();
} catch (error) {
  failed = 1;
  console.error(String(error).split("\n").slice(0, 6).join("\n"));
}
server.kill("SIGINT");
await new Promise((resolve) => server.once("exit", resolve));
rmSync(folder, { recursive: true, force: true });
process.exit(failed);
