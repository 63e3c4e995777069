// What the image viewer shows on a page of `quick`, by colour: every mode, scales, orientation, the grid.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { test } from "node:test";
import { close, open, section } from "./browser.mjs";
import {
  rows,
  data,
  images,
  rowOf,
  errorId,
  exactId,
  regular,
  zaremba,
  board,
  kPair,
  quickPage,
} from "./quick_page.mjs";
import { exrOf, pageOf, pixelsOf, withData } from "./runs.mjs";
import {
  canvasSize,
  colourAt,
  fingerprint,
  fitted,
  look,
  number,
  part,
  pixels,
  screenPlace,
  settled,
  srgb,
} from "./viewer.mjs";

const tab = quickPage();

test("a swipe shows A left of its line and B right of it, by colour, wherever the line is", async () => {
  const { page } = tab;
  // A: coverage in greys. B: errors, whose 0 is the neutral (221, 221, 221). At these pixels A is black or white.
  await look(page, { ...kPair, "b-show": "error", mode: "swipe" });
  const exact = exrOf("quick", regular.image_exact);
  const error = exrOf("quick", zaremba.image_error);
  const flat = [...exact.y.keys()].filter((i) => (exact.y[i] === 0 || exact.y[i] === 1) && error.y[i] === 0);
  const far = (i, x) => Math.abs((i % 64) - x);
  const picks = [2, 20, 40, 61].map((x) => flat.reduce((best, i) => (far(i, x) < far(best, x) ? i : best)));
  const check = async (line) => {
    const { w } = await canvasSize(page, "canvas");
    const fit = fitted(await canvasSize(page, "canvas"), board);
    for (const i of picks) {
      const [x, y] = [i % 64, Math.floor(i / 64)];
      const middle = fit.x + (x + 0.5) * fit.zoom;
      const colour = await colourAt(page, "canvas", board, x, y);
      const grey = middle < line * w ? srgb(exact.y[i]) : 221;
      assert.deepEqual(colour, [grey, grey, grey], `pixel ${x}, ${y} with the line at ${line}`);
    }
  };
  await check(0.5);
  const handle = part(page, "wipe");
  await handle.focus();
  for (let i = 0; i < 2; ++i) await page.keyboard.press("PageUp");
  await page.keyboard.press("ArrowLeft");
  await settled(page);
  assert.equal(await handle.getAttribute("aria-valuenow"), "69");
  await check(0.69);
  await page.keyboard.press("Home");
  await settled(page);
  await check(0);
  await page.keyboard.press("End");
  await settled(page);
  await check(1);
  const frame = await part(page, "canvas").boundingBox();
  const grip = await handle.boundingBox();
  await page.mouse.move(grip.x + 5, grip.y + grip.height / 2);
  await page.mouse.down();
  await page.mouse.move(frame.x + 0.4 * frame.width, frame.y + 50, { steps: 3 });
  await page.mouse.up();
  await settled(page);
  assert.equal(await handle.getAttribute("aria-valuenow"), "40");
  await check(0.4);
});

test("F flips A and B in place and R shows the exact image, pixel for pixel as side by side", async () => {
  const { page } = tab;
  await look(page, { ...kPair, mode: "flip", front: "a" });
  const a = await fingerprint(page, "canvas");
  await part(page, "stage").focus();
  await page.keyboard.press("f");
  await settled(page);
  const b = await fingerprint(page, "canvas");
  await page.keyboard.press("r");
  await settled(page);
  const exact = await fingerprint(page, "canvas");
  await page.keyboard.press("r");
  await settled(page);
  assert.equal(await fingerprint(page, "canvas"), b);
  await page.keyboard.press("F");
  await settled(page);
  assert.equal(await fingerprint(page, "canvas"), a);
  assert.equal(new Set([a, b, exact]).size, 3);
  await look(page, { a: exactId(regular), b: kPair.b, mode: "flip", front: "a" });
  assert.equal(await fingerprint(page, "canvas"), exact);
});

test("B - A has a symmetric scale up to the 99.5th percentile, grey at 0, and its map is fixed", async () => {
  const { page } = tab;
  await look(page, { ...kPair, mode: "difference" });
  const a = pixelsOf(images.get(kPair.a).pixels);
  const b = pixelsOf(images.get(kPair.b).pixels);
  const difference = b.map((value, i) => value - a[i]);
  const sizes = [...difference]
    .map(Math.abs)
    .filter((size) => size > 0)
    .sort((p, q) => p - q);
  const range = sizes[Math.ceil(0.995 * sizes.length) - 1];
  const bar = part(page, "colour-bar");
  assert.equal(await bar.getAttribute("data-map"), "diverging");
  assert.equal(Number(await bar.getAttribute("data-hi")), range);
  assert.equal(Number(await bar.getAttribute("data-lo")), -range);
  assert.ok(await part(page, "map").isDisabled());
  const first = (wanted) => difference.findIndex(wanted);
  const colour = (i) => colourAt(page, "canvas", board, i % 64, Math.floor(i / 64));
  assert.deepEqual(await colour(first((d) => d === 0)), [221, 221, 221]);
  assert.deepEqual(await colour(first((d) => d >= range)), [180, 4, 38]);
  assert.deepEqual(await colour(first((d) => d <= -range)), [59, 76, 192]);
  await look(page, { a: kPair.b, b: kPair.a, mode: "difference" });
  assert.deepEqual(await colour(first((d) => d >= range)), [59, 76, 192]);
  await look(page, { a: errorId(rowOf("edge", "regular", 4, "box")), b: kPair.b, mode: "difference" });
  await page.getByText("A and B differ in size").waitFor();
});

test("signed errors share one range, that of the program, and exposure divides it", async () => {
  const { page } = tab;
  await look(page, { ...kPair, "a-show": "error", "b-show": "error" });
  const bar = part(page, "colour-bar");
  const range = Math.max(regular.p995_active, zaremba.p995_active);
  assert.equal(Number(await bar.getAttribute("data-hi")), range);
  await part(page, "stage").focus();
  for (const key of ["e", "e"]) await page.keyboard.press(key);
  await settled(page);
  assert.equal(Number(await bar.getAttribute("data-hi")), range / 2);
  assert.equal(await part(page, "exposure-value").textContent(), "+1 EV");
  for (const key of ["z", "d", "d"]) await page.keyboard.press(key);
  await settled(page);
  assert.equal(Number(await bar.getAttribute("data-hi")), range * 2);
  await look(page, { ...kPair, ev: "1" });
  assert.equal(Number(await bar.getAttribute("data-hi")), 0.5);
  const exact = exrOf("quick", regular.image_exact);
  const i = exact.y.findIndex(
    (value, k) => value > 0.05 && value < 0.4 && exrOf("quick", regular.image_error).y[k] === 0,
  );
  if (i >= 0) {
    const grey = srgb(2 * exact.y[i]);
    assert.deepEqual(await colourAt(page, "canvas-a", board, i % 64, Math.floor(i / 64)), [grey, grey, grey]);
  }
});

test("values stand in the pixels once these are large", async () => {
  const { page } = tab;
  const inside = async (zoom) => {
    await look(page, { a: exactId(regular), b: kPair.b, zoom, centre: "30.5,40.5" });
    const { w, h } = await canvasSize(page, "canvas-a");
    const colours = await pixels(page, "canvas-a", [Math.floor(w / 2) - 20, Math.floor(h / 2) - 12, 40, 24]);
    return new Set(colours.map(String)).size;
  };
  assert.equal(await inside("48"), 1);
  assert.ok((await inside("64")) > 1);
});

test("a marked corner is in that corner in every way to look, and what is no number is magenta", async () => {
  const { page } = tab;
  const marked = structuredClone(data);
  const run = marked.runs[0];
  const exact = run.images.find((image) => image.id === exactId(regular));
  const raw = (type, values) => {
    const bytes = Buffer.alloc(4 * values.length);
    values.forEach((value, i) => bytes.writeFloatLE(value, 4 * i));
    return { w: 4, h: 3, type, shuffle: false, gzip: false, scale: 1, data: bytes.toString("base64") };
  };
  // Corners: white upper left, middle grey upper right, no number lower left; black elsewhere.
  exact.pixels = raw("f32", [1, 0, 0, 0.25, 0, 0, 0, 0, NaN, 0, 0, 0]);
  const error = run.images.find((image) => image.id === kPair.a);
  error.pixels = raw("f32", new Array(12).fill(0));
  delete error.range;
  const folder = mkdtempSync(path.join(tmpdir(), "moire-report-"));
  const file = path.join(folder, "marked.html");
  writeFileSync(file, withData(pageOf("quick"), marked));
  const other = await open(tab.browser, file);
  await section(other, "images");
  const small = { w: 4, h: 3 };
  const grey = srgb(0.25);
  const corners = [
    [0, 0, [255, 255, 255]],
    [3, 0, [grey, grey, grey]],
    [0, 2, [255, 0, 255]],
    [3, 2, [0, 0, 0]],
  ];
  for (const [mode, canvas, extra] of [
    ["side", "canvas-a", {}],
    ["side", "canvas-b", {}],
    ["swipe", "canvas", { wipe: "0.5" }],
    ["swipe", "canvas", { wipe: "1" }],
    ["flip", "canvas", { front: "a" }],
    ["flip", "canvas", { front: "exact" }],
  ]) {
    await look(other, { a: exactId(regular), b: kPair.a, mode, ...extra });
    for (const [x, y, want] of corners) {
      assert.deepEqual(await colourAt(other, canvas, small, x, y), want, `${mode} ${canvas} at ${x}, ${y}`);
    }
  }
  // In B - A and in the grid the mark is an error.
  error.pixels = raw("f32", [0.5, 0, 0, -0.5, 0, 0, 0, 0, NaN, 0, 0, 0]);
  exact.pixels = raw("f32", new Array(12).fill(0));
  writeFileSync(file, withData(pageOf("quick"), marked));
  await other.reload();
  await section(other, "images");
  await look(other, { a: exactId(regular), b: kPair.a, mode: "difference" });
  for (const [x, y, colour] of [
    [0, 0, [180, 4, 38]],
    [3, 0, [59, 76, 192]],
    [0, 2, [255, 0, 255]],
    [3, 2, [221, 221, 221]],
  ]) {
    assert.deepEqual(await colourAt(other, "canvas", small, x, y), colour, `difference at ${x}, ${y}`);
  }
  // The other errors are not of the exact image's size any more: the viewer says so and shows the rest of the grid.
  await look(other, { a: kPair.a, b: kPair.a, mode: "grid" });
  await other.getByText("not of the size of").waitFor();
  const corner = (x, y) => colourAt(other, "thumb-regular", small, x, y);
  const [left, right] = [await corner(0, 0), await corner(3, 0)];
  assert.ok(left[0] > left[2] && right[0] < right[2], `${left} and ${right}`);
  assert.deepEqual(await corner(0, 2), [255, 0, 255]);
  assert.deepEqual(await corner(3, 2), [221, 221, 221]);
  await close(other);
  rmSync(folder, { recursive: true });
});

test("the grid shows every pattern of the case on one scale, and choosing one makes it B", async () => {
  const { page } = tab;
  await look(page, { ...kPair, mode: "grid" });
  const patterns = ["regular", "random", "jittered", "hammersley", "zaremba"];
  const alike = rows.filter((row) => row.scene === "board" && row.spp === 4 && row.filter === "box");
  assert.equal(await page.locator('[data-testid="image-viewer"] .v-pane').count(), patterns.length);
  const range = Math.max(...alike.map((row) => row.p995_active));
  assert.equal(Number(await part(page, "colour-bar").getAttribute("data-hi")), range);
  for (const row of alike) {
    const error = exrOf("quick", row.image_error);
    const i = error.y.findIndex((value) => value === 0);
    assert.deepEqual(await colourAt(page, `thumb-${row.pattern}`, board, i % 64, Math.floor(i / 64)), [221, 221, 221]);
  }
  assert.equal(await part(page, "pick-zaremba").getAttribute("aria-pressed"), "true");
  await part(page, "pick-random").focus();
  await page.keyboard.press("Enter");
  await settled(page);
  assert.equal(await part(page, "b-source").inputValue(), "random");
  assert.equal(await part(page, "pick-random").getAttribute("aria-pressed"), "true");
  const place = await screenPlace(page, "thumb-jittered", board, 30, 30);
  await page.mouse.click(place.x, place.y);
  await settled(page);
  assert.equal(await part(page, "b-source").inputValue(), "jittered");
  const before = await fingerprint(page, "thumb-zaremba");
  await page.mouse.wheel(0, -120);
  await settled(page);
  assert.notEqual(await fingerprint(page, "thumb-zaremba"), before, "zoom is linked");
});
