// Numbers in texts, and the geometry by which handles move them. Numbers come from geometry and from the texts themselves.
//
//     node tests/studio/run_places.mjs
import assert from "node:assert/strict";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const web = join(dirname(fileURLToPath(import.meta.url)), "../../apps/studio/web");
const { buildSync } = createRequire(join(web, "package.json"))("esbuild");
const folder = mkdtempSync(join(tmpdir(), "ombre-places-"));
const load = async (name) => {
  const outfile = join(folder, `${name}.mjs`);
  buildSync({ entryPoints: [join(web, `src/handles/${name}.ts`)], outfile, bundle: true, format: "esm" });
  return import(pathToFileURL(outfile));
};
const { readNumbers, roundedTo, withNumbers } = await load("numbers");
const { acrossTo, alongLine, inverseOf, lengthOf, mapPoint, onBall, onPlane, turnedAbout } = await load("space");
rmSync(folder, { recursive: true });

const near = (found, wanted) => found.forEach((v, n) => assert.ok(Math.abs(v - wanted[n]) < 1e-12, `${found}, expected ${wanted}`));

// Texts of numbers and of lists of them, and no others.
assert.deepEqual(readNumbers("5"), { value: 5, from: 0, to: 1 });
assert.deepEqual(readNumbers(" [ -1, .5e1 ,2 ]").map((n) => n.value), [-1, 5, 2]);
assert.deepEqual(readNumbers("((0,0),\n(1,2))").flat().map((n) => n.value), [0, 0, 1, 2]);
assert.deepEqual(readNumbers("[]"), []);
for (const bad of ["", "a", "[1,2", "1]", "[1 2]", "[,1]", "1,2", "size/2", "[1, x]", "5 6", "5mm", "[1,2]]", "--5", "[]1", '"5"']) assert.equal(readNumbers(bad), undefined, bad);

// What stands between the numbers stays.
const text = "[-10, 0,  0]", [x, , z] = readNumbers(text);
assert.equal(withNumbers(text, [{ at: x, value: 3.5 }, { at: z, value: -7 }]), "[3.5, 0,  -7]");
assert.deepEqual([roundedTo(0.07, 1.23456), roundedTo(30, 123.4), roundedTo(0.01, -0.001)], [1.23, 123, 0]);

// A map and its inverse; a map that flattens space has none.
const rows = [[0, -1, 0, 3], [2, 0, 0, 4], [0, 0, 1, 5]];
near(mapPoint(inverseOf(rows), mapPoint(rows, [1, 2, 3])), [1, 2, 3]);
assert.equal(inverseOf([[1, 0, 0, 0], [0, 1, 0, 0], [1, 1, 0, 0]]), undefined);

// A ray along y meets the plane y = 2 above where it begins, and runs along x = 0.
near(onPlane({ from: [5, -3, 7], along: [0, 9, 0] }, [0, 2, 0], [0, 1, 0]), [5, 2, 7]);
assert.equal(onPlane({ from: [5, -3, 7], along: [0, 9, 0] }, [0, 0, 0], [1, 0, 0]), undefined);

// Seen along y, a line is nearest where it is in x and z.
near([alongLine({ from: [5, -3, 7], along: [0, 9, 0] }, [1, 0, 0], [0.6, 0, 0.8])], [4 * 0.6 + 7 * 0.8]);
assert.equal(alongLine({ from: [5, -3, 7], along: [0, 9, 0] }, [0, 0, 0], [0, 1, 0]), undefined);

// A ball is met in front or behind, as before; a ray beside it meets its outline.
near(onBall({ from: [1.2, -9, 0], along: [0, 1, 0] }, [0, 0, 0], 2, [0, -1, 0]), [0.6, -0.8, 0]);
near(onBall({ from: [1.2, -9, 0], along: [0, 1, 0] }, [0, 0, 0], 2, [0, 1, 0]), [0.6, 0.8, 0]);
near(onBall({ from: [5, -9, 0], along: [0, 1, 0] }, [0, 0, 0], 2, [0, -1, 0]), [1, 0, 0]);

near(turnedAbout([1, 0, 0], [0, 0, 2], 90), [0, 1, 0]);
near(acrossTo([0, 0, 3], [1, 0, 1]), [1, 0, 0]);
near([lengthOf(acrossTo([1, 1, 1], [2, 2, 2]))], [1]);
console.log("handles: numbers and places are as geometry says");
