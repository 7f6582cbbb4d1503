// The studio's formatter on all scripts of this repository: nothing but spaces changes, what is formatted stays, and
// examples are as it writes them.
//
//     node tests/studio/run_format.mjs
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const root = join(dirname(fileURLToPath(import.meta.url)), "../..");
const web = join(root, "apps/studio/web");
const { transformSync } = createRequire(join(web, "package.json"))("esbuild");
const folder = mkdtempSync(join(tmpdir(), "ombre-format-"));
writeFileSync(join(folder, "format.mjs"),
  transformSync(readFileSync(join(web, "src/format.ts"), "utf8"), { loader: "ts", format: "esm" }).code);
const { formatted } = await import(pathToFileURL(join(folder, "format.mjs")));
rmSync(folder, { recursive: true });

function* scriptsIn(path) {
  for (const entry of readdirSync(path, { withFileTypes: true })) {
    if (entry.isDirectory()) yield* scriptsIn(join(path, entry.name));
    else if (/\.(vcad|scad)$/.test(entry.name)) yield join(path, entry.name);
  }
}

let count = 0;
for (const part of ["examples", "tests"])
  for (const file of scriptsIn(join(root, part))) {
    const text = readFileSync(file, "utf8"), once = formatted(text);
    const bare = (script) => script.replace(/\s+/g, "");
    assert.equal(bare(once), bare(text), `${file}: more than spaces changed`);
    assert.equal(formatted(once), once, `${file}: it changes again`);
    if (part === "examples") assert.equal(once, text, `${file} is not as the formatter writes it`);
    ++count;
  }
assert.ok(count > 400, `${count} scripts`);

const cases = [
  ["", ""],
  ["\n\n a=1;  \n\n\n\n\nb=2;", "a=1;\n\n\nb=2;\n"],
  ["module m(x){\nsphere(x);\n\ttranslate(1,2,3)\nrotate(4)\ncube(2);\n}", "module m(x){\n  sphere(x);\n  translate(1,2,3)\n    rotate(4)\n    cube(2);\n}\n"],
  ["if (a) {\ncube(1);\n  }\nelse {\ncube(2);\n}", "if (a) {\n  cube(1);\n}\nelse {\n  cube(2);\n}\n"],
  // Texts and long comments keep all of their spaces, and braces in them open nothing.
  ['  s = "{  \n  {  ";\n /* {\n  } */\n// {\nt = 1;', 's = "{  \n  {  ";\n/* {\n  } */\n// {\nt = 1;\n'],
  // What is aligned moves as a whole.
  ["    x = [1,\n         2];\n", "x = [1,\n     2];\n"],
  ["union() {\nm(\n  1,\n);\n}", "union() {\n  m(\n    1,\n  );\n}\n"],
  ["use <a.scad>\n b = 1;", "use <a.scad>\nb = 1;\n"],
  ["}}\n  a = 1;", "}}\na = 1;\n"],
];
for (const [text, wanted] of cases) assert.equal(formatted(text), wanted);
console.log(`${count} scripts, ${cases.length} cases`);
