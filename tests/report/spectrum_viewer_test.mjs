// The viewer of two-dimensional spectra on a page of `noise`: powers, frequencies, and the peaks that it marks.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { close, launch, open, section } from "./browser.mjs";
import { dataOf, exrOf, pageOf, unpack } from "./runs.mjs";
import { canvasSize, colourAt, fitted, look, number, part, pixels, screenPlace, settled } from "./viewer.mjs";

const run = dataOf(pageOf("noise")).runs[0];
const spectra = run.images.filter((image) => image.kind === "spectrum");
const size = { w: 32, h: 32 };
const radial = unpack(run.radial_spectra);
const keys = ["scene", "pattern", "layout", "spp", "filter", "estimator"];
const peakOf = (image) => radial.find((r) => keys.every((key) => r[key] === image[key]))?.peak;

let browser;
let page;
before(async () => {
  browser = await launch();
  page = await open(browser, pageOf("noise"));
  await section(page, "spectra");
  await settled(page, "spectrum");
});
after(async () => {
  await close(page);
  await browser.close();
});

test("powers are those of the EXR files, and B over A is in decibels", async () => {
  assert.ok(spectra.length >= 8);
  const [a, b] = [spectra[0], spectra[3]];
  const [one, two] = [a, b].map((image) => exrOf("noise", image.file).y);
  for (const [x, y] of [
    [0, 0],
    [16, 16],
    [17, 16],
    [31, 31],
    [3, 20],
  ]) {
    await look(page, { a: a.id, b: b.id, at: `${x},${y}` }, "spectrum");
    const i = x + 32 * y;
    const shown = [
      await number(page, "readout-a-power", "spectrum"),
      await number(page, "readout-b-power", "spectrum"),
    ];
    // Kept with 11 digits of two, as errors are.
    for (const [got, want, image] of [
      [shown[0], one[i], a],
      [shown[1], two[i], b],
    ]) {
      const slack = 2 ** -11 * Math.abs(want) + 2 ** -25 * image.pixels.scale;
      assert.ok(Math.abs(got - want) <= slack, `${image.id} at ${x}, ${y}: ${got} instead of ${want} +- ${slack}`);
    }
    // Both are far above the foot of the scale here, but at the mean; 1e-12: rounding of the logarithm.
    if (x !== 16 || y !== 16) {
      const decibels = 10 * Math.log10(shown[1] / shown[0]);
      assert.ok(Math.abs((await number(page, "readout-difference-power", "spectrum")) - decibels) < 1e-12);
    }
  }
});

test("frequency 0 is the middle pixel and the last to the right and below is just under half a cycle", async () => {
  await look(page, { at: "16,16" }, "spectrum");
  assert.equal(await part(page, "readout-place", "spectrum").textContent(), "Frequency 0, 0: 0.0000 cycles per pixel");
  await look(page, { at: "31,0" }, "spectrum");
  assert.equal(
    await part(page, "readout-place", "spectrum").textContent(),
    "Frequency 0.4688, \u22120.5: 0.6854 cycles per pixel",
  );
});

test("a peak and its conjugate are ringed, and a power scale is logarithmic", async () => {
  const image = spectra.find((s) => peakOf(s)?.significant) ?? spectra.find((s) => peakOf(s));
  assert.ok(image, "a peak among the spectra");
  const peak = peakOf(image);
  await look(page, { a: image.id, b: image.id }, "spectrum");
  const { zoom, x: left, y: top } = fitted(await canvasSize(page, "canvas-a", "spectrum"), size);
  const kAround = Math.ceil(0.9 * zoom + 10); // the ring's radius in pixels of the canvas, and its line
  for (const sign of [1, -1]) {
    // 1/2 is also -1/2: the first column or row.
    const [column, row] = [peak.fx, peak.fy].map((f) => (16 + sign * f * 32 + 32) % 32);
    const [x, y] = [Math.round(left + (column + 0.5) * zoom), Math.round(top + (row + 0.5) * zoom)];
    const colours = await pixels(page, "canvas-a", [x - kAround, y - kAround, 2 * kAround, 2 * kAround], "spectrum");
    assert.ok(
      colours.some((c) => String(c) === "255,255,255"),
      "white of a ring",
    );
    assert.ok(
      colours.some((c) => String(c) === "0,0,0"),
      "within black",
    );
  }
  assert.match(
    await page.locator('[data-testid="spectrum-viewer"] figcaption').first().textContent(),
    /strongest peak/,
  );
  assert.match(await part(page, "colour-bar", "spectrum").textContent(), /log scale/);
});

test("equal spectra are 0 dB apart, the neutral grey, in every part that was split", async () => {
  for (const show of ["spectrum", "structured", "noise"]) {
    await look(
      page,
      { a: spectra[1].id, b: spectra[1].id, "a-show": show, "b-show": show, mode: "difference" },
      "spectrum",
    );
    assert.deepEqual(await colourAt(page, "canvas", size, 5, 9, "spectrum"), [221, 221, 221], show);
  }
});

test("a spectrum's choices are not those of an image", async () => {
  await look(page, { a: spectra[0].id, b: spectra[2].id }, "spectrum");
  const place = await screenPlace(page, "canvas-b", size, 20, 10, "spectrum");
  await page.mouse.click(place.x, place.y);
  await settled(page, "spectrum");
  await page.waitForTimeout(300); // the address follows the choices a moment later
  const hash = await page.evaluate(() => location.hash);
  assert.match(hash, /spectrum\.at=20,10/);
  assert.ok(!hash.includes("image.at"));
});
