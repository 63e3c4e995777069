// The runs that the tests look at: folders that the program wrote, their rows, images, and the data of their pages.
import { readFileSync } from "node:fs";
import path from "node:path";
import { gunzipSync } from "node:zlib";
import { readExr } from "./exr.mjs";

/** The folder with a run folder for each study; make_runs.cmake fills it. */
export const kRuns = required("MOIRE_REPORT_RUNS");
/** The build folder of the page: has node_modules and src. */
export const kWeb = required("MOIRE_REPORT_WEB");
export const kProgram = required("MOIRE_REPORT_PROGRAM");

export function pageOf(run) {
  return path.join(kRuns, run, "index.html");
}

/** The rows of results.jsonl that have an error image. */
export function rowsOf(run) {
  const lines = readFileSync(path.join(kRuns, run, "results.jsonl"), "utf8")
    .trimEnd()
    .split("\n");
  return lines
    .map((line) => JSON.parse(line))
    .filter((row) => row.kind === "row" && typeof row.image_error === "string");
}

export function exrOf(run, file) {
  return readExr(path.join(kRuns, run, file));
}

/** The id that a page gives an image: the run and the file's name without its ending. */
export function idOf(run, file) {
  return `${run}/${path.basename(file, ".exr")}`;
}

/** The JSON of a page. */
export function dataOf(page) {
  const html = readFileSync(page, "utf8");
  const begin = html.indexOf(">", html.indexOf('id="moire-report"')) + 1;
  return JSON.parse(html.slice(begin, html.indexOf("</script>", begin)));
}

/** The page with other data. */
export function withData(page, data) {
  const html = readFileSync(page, "utf8");
  const begin = html.indexOf(">", html.indexOf('id="moire-report"')) + 1;
  return (
    html.slice(0, begin) +
    JSON.stringify(data).replaceAll("<", "\\u003c") +
    html.slice(html.indexOf("</script>", begin))
  );
}

export function unpack(value) {
  return typeof value?.gz === "string" ? JSON.parse(gunzipSync(Buffer.from(value.gz, "base64")).toString()) : value;
}

/** The numbers of an image of a page, in another way than the page's own: from bytes and by definition. */
export function pixelsOf({ w, h, type, shuffle, gzip, scale, data }) {
  const stored = Buffer.from(data, "base64");
  const bytes = gzip ? gunzipSync(stored) : stored;
  const size = type === "f16" ? 2 : 4;
  const value = Buffer.alloc(size);
  const out = new Float64Array(w * h);
  for (let i = 0; i < w * h; ++i) {
    for (let k = 0; k < size; ++k) value[k] = shuffle ? bytes[k * w * h + i] : bytes[i * size + k];
    out[i] = scale * (type === "f16" ? half(value.readUInt16LE(0)) : value.readFloatLE(0));
  }
  return out;
}

/** IEEE 754 binary16. */
function half(bits) {
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 1023;
  const sign = bits >> 15 ? -1 : 1;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent ? (1024 + fraction) * 2 ** (exponent - 25) : fraction * 2 ** -24);
}

function required(name) {
  const value = process.env[name];
  if (value === undefined || value === "") throw new Error(`${name} is not set; CTest sets it`);
  return value;
}
