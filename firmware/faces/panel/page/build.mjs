// Bundles the page's sources into ../bundle, which the program is built with. `node build.mjs --to DIR` writes elsewhere.
import { build } from "esbuild";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const at = process.argv.indexOf("--to");
const to = at > 0 ? process.argv[at + 1] : join(here, "..", "bundle");
mkdirSync(to, { recursive: true });

const common = { bundle: true, minify: true, legalComments: "inline", charset: "utf8", target: "es2022", logLevel: "warning" };
await build({ ...common, entryPoints: [join(here, "src/main.ts")], outfile: join(to, "panel.js"), format: "esm" });
await build({ ...common, entryPoints: [join(here, "src/style.css")], outfile: join(to, "panel.css") });
for (const name of ["index.html", "icon.svg"]) writeFileSync(join(to, name), readFileSync(join(here, "src", name)));
