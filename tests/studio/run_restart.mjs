// A server that is killed and started again.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { design, file, folder, isReady, page, pathOf, resetLayerHeight, slice, small, startServer, status, stopServer, test, type, untilOnDisk, untilOtherDesign, untilThere, url } from "./studio_page.mjs";
import { ombre, source, token } from "./studio_server.mjs";

const layerHeight = "0.0125"; // so thin that the job goes on until the server is killed

await test({ viewport: small }, {
  async "a server that is killed and started again loses nothing"() {
    const { port } = new URL(url);
    await isReady();
    const before = await design();
    await page.click("#tab-export");
    await page.selectOption(".panel .printer", "j750");
    await slice("again_slices", layerHeight);
    await untilThere("again_slices/journal.jsonl");
    await stopServer("SIGKILL");
    await status("[data-status=lost]");
    await type("// while it was away\n");
    await startServer("0".repeat(32), port, file);
    await status("[data-status=refused]");
    await stopServer("SIGINT");
    await startServer(token, port, file);
    await status("[data-status=open]");
    await untilOnDisk("// while it was away");
    await untilOtherDesign(before); // the picture of the text as it is now
    await status("[data-old=false][data-busy=false]");
    await page.selectOption(".surface .viewbar select >> nth=0", "top");
    await isReady();
    await page.click("[data-folder=again_slices][data-state=interrupted] >> text=Resume");
    await page.waitForSelector("[data-folder=again_slices][data-state=done]");
    await resetLayerHeight();
    const whole = spawn(ombre, ["slice", file, "--printer", "j750", "--layer-height", layerHeight, "-o", pathOf("whole_slices")], { env: { ...process.env, OMBRE_DATA: source }, stdio: "ignore" });
    assert.equal(await new Promise((resolve) => whole.once("exit", resolve)), 0);
    const [again, once] = ["again_slices", "whole_slices"].map((name) => readdirSync(join(folder, name)).filter((file) => file.startsWith("slice_")));
    assert.ok(once.length > 1990);
    assert.deepEqual(again, once);
    for (const name of once) assert.ok(readFileSync(join(folder, "again_slices", name)).equals(readFileSync(join(folder, "whole_slices", name))), name);
  },
});
