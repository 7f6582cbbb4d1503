// `node bundle.mjs FOLDER` writes the page there: index.html, app.js, app.css, and the licences of the packages in
// app.js.
import { copyFileSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const to = process.argv[2];
mkdirSync(to, { recursive: true });
const { metafile } = await build({
  entryPoints: [join(here, "src/app.tsx")],
  metafile: true,
  outfile: join(to, "app.js"),
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  jsx: "automatic",
  jsxImportSource: "preact",
  legalComments: "none", // licences.txt has them whole
  logLevel: "warning",
});
await build({ entryPoints: [join(here, "src/app.css")], outfile: join(to, "app.css"), bundle: true, minify: true, logLevel: "warning" });
copyFileSync(join(here, "src/index.html"), join(to, "index.html"));

const packages = new Set();
for (const path of Object.keys(metafile.inputs)) {
  const found = /node_modules\/((@[^/]+\/)?[^/]+)\//.exec(path);
  if (found) packages.add(found[1]);
}
const licences = [...packages].sort().map((name) => {
  const folder = join(here, "node_modules", name);
  const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
  if (!file) throw new Error(`${name} comes without a licence`);
  return `${name} ${JSON.parse(readFileSync(join(folder, "package.json"))).version}\n\n${readFileSync(join(folder, file), "utf8").trim()}\n`;
});
writeFileSync(join(to, "licences.txt"), licences.join("\n----\n\n"));
