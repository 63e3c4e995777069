// Bundles src/main.ts and style.css into OUTDIR/template.html, the page without its data: `node build.mjs OUTDIR`.
// The program puts the JSON where @MOIRE_REPORT_DATA@ stands and the title where @MOIRE_TITLE@ stands. The same sources
// and the same package-lock.json give the same bytes.
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, readdirSync, renameSync, writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = path.dirname(fileURLToPath(import.meta.url));
const outdir = process.argv[2];
if (outdir === undefined) {
  process.stderr.write("usage: node build.mjs OUTDIR\n");
  process.exit(2);
}

const bundle = await build({
  absWorkingDir: here,
  entryPoints: ["src/main.ts"],
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2020",
  charset: "ascii",
  legalComments: "none", // the notices stand in the page's head, see below
  metafile: true,
  write: false,
});
const script = bundle.outputFiles[0].text.trim();
const style = await build({
  absWorkingDir: here,
  entryPoints: ["style.css"],
  bundle: true,
  minify: true,
  target: "es2020",
  charset: "ascii",
  write: false,
});

/** The licences of what the bundle holds, each text once, with the packages and the copyright lines that it covers. */
function notices(inputs) {
  const folders = new Set();
  for (const [input, { bytesInOutput }] of Object.entries(inputs)) {
    const match = /^(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(input);
    if (match && bytesInOutput > 0) folders.add(match[1]);
  }
  const texts = new Map();
  for (const folder of [...folders].sort()) {
    const file = readdirSync(path.join(here, folder)).find((name) => /^licen[cs]e/i.test(name));
    if (file === undefined) throw new Error(`${folder} has no licence file`);
    const lines = readFileSync(path.join(here, folder, file), "utf8").split(/\r?\n/);
    const holders = lines.filter((line) => /^Copyright/.test(line.trim())).map((line) => line.trim());
    const text = lines
      .filter((line) => !/^Copyright/.test(line.trim()))
      .join(" ")
      .replace(/\s+/g, " ")
      .trim();
    const name = folder.replace(/^.*node_modules\//, "");
    const entry = texts.get(text) ?? [];
    entry.push(`${name}: ${holders.join("; ")}`);
    texts.set(text, entry);
  }
  return [...texts]
    .map(([text, packages]) => `${packages.join("\n")}\n\n${text}`)
    .join("\n\n")
    .replaceAll("--", "- -");
}

const hash = createHash("sha256").update(script).digest("base64");
const parts = {
  "@CSP_SCRIPT@": `'sha256-${hash}'`,
  "@NOTICES@": notices(Object.values(bundle.metafile.outputs)[0].inputs),
  "@STYLE@": style.outputFiles[0].text.trim(),
  "@SCRIPT@": script,
};
let page = readFileSync(path.join(here, "template.html"), "utf8");
for (const [mark, text] of Object.entries(parts)) {
  if (page.split(mark).length !== 2) throw new Error(`template.html must hold ${mark} once`);
  page = page.replace(mark, () => text); // a function: `$&` may stand in the text
}
for (const mark of ["@MOIRE_REPORT_DATA@", "@MOIRE_TITLE@"]) {
  if (page.split(mark).length !== 2) throw new Error(`the page must hold ${mark} once`);
}
if (/<\/script/i.test(script)) throw new Error("the bundle holds </script");

mkdirSync(outdir, { recursive: true });
const target = path.join(outdir, "template.html");
writeFileSync(`${target}.part`, page);
renameSync(`${target}.part`, target);
