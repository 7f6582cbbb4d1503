// Starts studios, and browsers that use them, for tests.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

export const source = join(dirname(fileURLToPath(import.meta.url)), "../..");
export const require = createRequire(join(source, "apps/studio/web/package.json"));
const { chromium } = require("playwright-core");

export const [ombre, browserPath] = process.argv.slice(2);
export const token = "5eed".repeat(8);

// What the servers of a test keep between their starts.
export const stateFolder = mkdtempSync(join(tmpdir(), "ombre-state-"));
process.on("exit", () => rmSync(stateFolder, { recursive: true, force: true }));

// Starts a server for a folder or a file. Without a port it takes the one that belongs to the folder.
export async function serve(place, port, key) {
  const variables = { ...process.env, OMBRE_DATA: source, OMBRE_STUDIO_TOKEN: key, XDG_STATE_HOME: stateFolder };
  const child = spawn(ombre, ["studio", place, "--json", "--no-browser", "--port", String(port)], { env: variables, stdio: ["ignore", "pipe", "inherit"] });
  const url = await new Promise((resolve, reject) => {
    let text = "";
    child.once("exit", (code) => reject(new Error(`the server ended with ${code}`)));
    child.stdout.on("data", (data) => {
      text += data;
      const found = /"url": ?"([^"]+)"/.exec(text);
      if (found) resolve(found[1]);
    });
  });
  child.removeAllListeners("exit");
  return { child, url };
}

export function stop(child, signal) {
  const ended = new Promise((resolve) => child.once("exit", resolve));
  child.kill(signal);
  return ended;
}

// Software draws WebGL, so that the pictures do not depend on a graphics card.
export const launch = () => chromium.launch({ executablePath: browserPath, args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });

// Runs checks in order until one fails. Returns the number of failures.
export async function runChecks(checks, page) {
  for (const [name, check] of Object.entries(checks)) {
    const begun = performance.now();
    const watch = () => `${((performance.now() - begun) / 1000).toFixed(1)} s`;
    try {
      await check();
      console.log(`${name}: ${watch()}`);
    } catch (error) {
      console.log(`FAILED ${name} (${watch()})\n    ${String(error.stack).split("\n").slice(0, 12).join("\n    ")}`);
      const picture = join(tmpdir(), `ombre-${basename(process.argv[1], ".mjs")}-failed.png`);
      await page.screenshot({ path: picture }).catch(() => undefined);
      console.log(`    the page is in ${picture}`);
      return 1;
    }
  }
  return 0;
}
