// The image viewer's numbers on a page of `quick`: read-outs, statistics, regions.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  kHalfUlp,
  kHalfTiny,
  rows,
  images,
  rowOf,
  errorId,
  exactId,
  near,
  regular,
  zaremba,
  board,
  kPair,
  quickPage,
} from "./quick_page.mjs";
import { exrOf, pixelsOf } from "./runs.mjs";
import { look, number, part, pixels, screenPlace, settled } from "./viewer.mjs";

const tab = quickPage();

test("read-outs at the worst pixel are what results.jsonl and the EXR files say", async () => {
  const { page } = tab;
  assert.ok(rows.length >= 60);
  for (const row of rows.filter((_, i) => i % 7 === 0)) {
    const [x, y] = [row.max_x_active, row.max_y_active];
    await look(page, { a: exactId(row), b: errorId(row), at: `${x},${y}` });
    assert.equal(await part(page, "readout-place").textContent(), `Pixel ${x}, ${y}`);
    const exact = exrOf("quick", row.image_exact);
    const error = exrOf("quick", row.image_error);
    const i = x + exact.w * y;
    const slack = kHalfUlp * Math.abs(error.y[i]) + kHalfTiny * images.get(errorId(row)).pixels.scale;
    assert.equal(await number(page, "readout-a-value"), exact.y[i]);
    assert.equal(await number(page, "readout-b-exact"), exact.y[i]);
    near(exact.y[i], row.max_want_active, 2 ** -24 * Math.abs(exact.y[i]), "the EXR is the float next to the row's");
    near(await number(page, "readout-b-error"), error.y[i], slack, `${row.image_error}: error`);
    near(await number(page, "readout-b-value"), row.max_got_active, slack + 2 ** -23, `${row.image_error}: got`);
    assert.equal(await number(page, "readout-difference-error"), await number(page, "readout-b-error"));
    assert.equal(await number(page, "readout-a-error"), 0);
  }
});

test("a pixel under the pointer is read as at the crosshair, and leaving the image ends it", async () => {
  const { page } = tab;
  await look(page, { ...kPair, at: "40,20" });
  const atCrosshair = await number(page, "readout-b-value");
  await look(page, kPair);
  assert.ok(Number.isNaN(await number(page, "readout-b-value")));
  for (const [x, y] of [
    [40, 20],
    [0, 0],
    [63, 47],
  ]) {
    const place = await screenPlace(page, "canvas-b", board, x, y);
    await page.mouse.move(place.x, place.y);
    await settled(page);
    assert.equal(await part(page, "readout-place").textContent(), `Pixel ${x}, ${y}`);
    if (x === 40) assert.equal(await number(page, "readout-b-value"), atCrosshair);
  }
  await page.mouse.move(2, 2);
  await settled(page);
  assert.ok(Number.isNaN(await number(page, "readout-b-value")));
});

test("statistics of the whole image are those of the row, and their places are right", async () => {
  const { page } = tab;
  for (const row of [regular, zaremba, rowOf("edge", "jittered", 16, "mitchell"), rowOf("disk", "random", 1, "box")]) {
    await look(page, { a: exactId(row), b: errorId(row) });
    const tiny = kHalfTiny * images.get(errorId(row)).pixels.scale;
    near(await number(page, "region-b-rmse"), row.rmse_all, kHalfUlp * row.rmse_all + tiny, "rmse");
    near(await number(page, "region-b-mae"), row.mae_all, kHalfUlp * row.mae_all + tiny, "mae");
    near(await number(page, "region-b-bias"), row.bias_all, kHalfUlp * row.mae_all + tiny, "bias");
    for (const key of ["max", "p50", "p95", "p99"]) {
      const want = row[key === "max" ? "max_abs_all" : `${key}_all`];
      near(await number(page, `region-b-${key}`), want, kHalfUlp * want + tiny, key);
    }
    assert.equal(await number(page, "region-a-rmse"), 0);
    assert.equal(await number(page, "region-difference-rmse"), await number(page, "region-b-rmse"));
    await part(page, "worst-b").click();
    await settled(page);
    // Other pixels may be as bad once errors have 11 digits: the value counts.
    near(
      Math.abs(await number(page, "readout-b-error")),
      row.max_abs_all,
      kHalfUlp * row.max_abs_all + tiny,
      "worst pixel",
    );
  }
});

test("a region's RMSE is the direct sum: of the page's numbers to the bit, of the EXR's to 11 digits", async () => {
  const { page } = tab;
  const [x, y, w, h] = [11, 13, 29, 17];
  await look(page, { ...kPair, region: [x, y, w, h].join(",") });
  const a = pixelsOf(images.get(kPair.a).pixels);
  const b = pixelsOf(images.get(kPair.b).pixels);
  const exr = exrOf("quick", zaremba.image_error);
  const rmse = (at) => {
    let sum = 0;
    for (let j = y; j < y + h; ++j) for (let i = x; i < x + w; ++i) sum += at(i + 64 * j) ** 2;
    return Math.sqrt(sum / (w * h));
  };
  assert.equal(
    await number(page, "region-a-rmse"),
    rmse((i) => a[i]),
  );
  assert.equal(
    await number(page, "region-b-rmse"),
    rmse((i) => b[i]),
  );
  assert.equal(
    await number(page, "region-difference-rmse"),
    rmse((i) => b[i] - a[i]),
  );
  near(
    await number(page, "region-b-rmse"),
    rmse((i) => exr.y[i]),
    kHalfUlp * rmse((i) => exr.y[i]),
    "EXR",
  );
  assert.match(await part(page, "region-caption").textContent(), /^Region: 493 pixels$/);
});

test("a region comes from the number fields and from Shift and drag alike", async () => {
  const { page } = tab;
  await look(page, kPair);
  for (const [side, value] of [
    ["x", 5],
    ["y", 6],
    ["w", 7],
    ["h", 8],
  ])
    await part(page, `region-${side}`).fill(String(value));
  await part(page, "region-h").press("Tab");
  await settled(page);
  const typed = await number(page, "region-a-mae");
  await part(page, "region-all").click();
  await settled(page);
  assert.match(await part(page, "region-caption").textContent(), /^Whole image: 3,072 pixels$/);
  const from = await screenPlace(page, "canvas-a", board, 5, 6);
  const to = await screenPlace(page, "canvas-a", board, 11, 13);
  await page.keyboard.down("Shift");
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(to.x, to.y, { steps: 4 });
  await page.mouse.up();
  await page.keyboard.up("Shift");
  await settled(page);
  assert.equal(await number(page, "region-a-mae"), typed);
  assert.equal(await part(page, "region-w").inputValue(), "7");
});
