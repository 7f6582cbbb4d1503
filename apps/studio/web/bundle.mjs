// node bundle.mjs FOLDER: writes the page, index.html, app.js and app.css, there.
import { mkdirSync, copyFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const to = process.argv[2];
mkdirSync(to, { recursive: true });
await build({
  entryPoints: [join(here, "src/app.tsx")],
  outfile: join(to, "app.js"),
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  jsx: "automatic",
  jsxImportSource: "preact",
  legalComments: "eof",
  logLevel: "warning",
});
await build({ entryPoints: [join(here, "src/app.css")], outfile: join(to, "app.css"), bundle: true, minify: true, logLevel: "warning" });
copyFileSync(join(here, "src/index.html"), join(to, "index.html"));
