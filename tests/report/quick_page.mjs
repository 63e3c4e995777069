// The page of `quick` in a browser, its images section shown, and what its runs and its data say: for the tests of the
// image viewer.
import assert from "node:assert/strict";
import { after, before } from "node:test";
import { close, launch, open, section } from "./browser.mjs";
import { dataOf, idOf, pageOf, rowsOf } from "./runs.mjs";
import { settled } from "./viewer.mjs";

// A number of 11 significant binary digits is off by half a unit of the last: 2^-11 of its size at most; below the
// smallest normal one by 2^-25 of the image's scale.
export const kHalfUlp = 2 ** -11;
export const kHalfTiny = 2 ** -25;

export const rows = rowsOf("quick");
export const data = dataOf(pageOf("quick"));
export const images = new Map(data.runs[0].images.map((image) => [image.id, image]));
export const rowOf = (scene, pattern, spp, filter) =>
  rows.find((row) => row.scene === scene && row.pattern === pattern && row.spp === spp && row.filter === filter);
export const errorId = (row) => idOf("quick", row.image_error);
export const exactId = (row) => idOf("quick", row.image_exact);
export const near = (got, want, tolerance, what) =>
  assert.ok(Math.abs(got - want) <= tolerance, `${what}: ${got} instead of ${want} +- ${tolerance}`);

export const regular = rowOf("board", "regular", 4, "box");
export const zaremba = rowOf("board", "zaremba", 4, "box");
export const board = { w: 64, h: 48 };
export const kPair = { a: errorId(regular), b: errorId(zaremba) };

/** Opens the page before the tests of a file and closes it behind them: `tab.browser` and `tab.page`. */
export function quickPage() {
  const tab = {};
  before(async () => {
    tab.browser = await launch();
    tab.page = await open(tab.browser, pageOf("quick"));
    await section(tab.page, "images");
    await settled(tab.page);
  });
  after(async () => {
    await close(tab.page);
    await tab.browser.close();
  });
  return tab;
}
