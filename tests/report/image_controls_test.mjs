// Ways to move in the image viewer on a page of `quick`: wheel, drags, keys, choosers, links.
import assert from "node:assert/strict";
import { existsSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { close, open, section } from "./browser.mjs";
import { data, regular, zaremba, board, kPair, quickPage } from "./quick_page.mjs";
import { kRuns, pageOf, unpack, withData } from "./runs.mjs";
import { fingerprint, look, number, part, screenPlace, settled } from "./viewer.mjs";

const tab = quickPage();

test("the wheel keeps the pixel under the pointer, in and out, and then is the page's again", async () => {
  const { page } = tab;
  await look(page, kPair);
  const place = await screenPlace(page, "canvas-a", board, 50, 37);
  await page.mouse.move(place.x, place.y);
  let last = "";
  for (let i = 0; i < 30; ++i) {
    await page.mouse.wheel(0, i < 6 ? -120 : 120);
    await settled(page);
    const zoom = await part(page, "zoom").textContent();
    if (i > 6 && zoom === last) break;
    last = zoom;
    assert.equal(await part(page, "readout-place").textContent(), "Pixel 50, 37", `at ${zoom}`);
  }
  const scrolled = await page.evaluate(() => scrollY);
  await page.mouse.wheel(0, 120);
  await page.waitForFunction((before) => scrollY > before, scrolled);
  await part(page, "stage").scrollIntoViewIfNeeded();
});

test("drags and arrows move both images, + - 0 1 zoom, and the zoom is whole", async () => {
  const { page } = tab;
  await look(page, kPair);
  await part(page, "stage").focus();
  const seen = new Set();
  for (let i = 0; i < 8; ++i) {
    await page.keyboard.press("+");
    await settled(page);
    seen.add(await part(page, "zoom").textContent());
  }
  assert.ok(
    [...seen].every((text) => /^\d+:1$/.test(text)),
    [...seen].join(" "),
  );
  const before = await fingerprint(page, "canvas-b");
  await page.keyboard.press("ArrowRight");
  await settled(page);
  assert.notEqual(await fingerprint(page, "canvas-b"), before);
  await page.keyboard.press("ArrowLeft");
  await settled(page);
  assert.equal(await fingerprint(page, "canvas-b"), before);
  const box = await part(page, "canvas-a").boundingBox();
  await page.mouse.move(box.x + 200, box.y + 200);
  await settled(page);
  const pixel = await part(page, "readout-place").textContent();
  await page.mouse.down();
  await page.mouse.move(box.x + 260, box.y + 170, { steps: 5 });
  await page.mouse.up();
  await settled(page);
  assert.equal(await part(page, "readout-place").textContent(), pixel, "what is dragged stays under the pointer");
  assert.notEqual(await fingerprint(page, "canvas-b"), before);
  await page.keyboard.press("1");
  await settled(page);
  assert.equal(await part(page, "zoom").textContent(), "1:1");
  await page.keyboard.press("0");
  await settled(page);
  assert.ok(!(await page.evaluate(() => location.hash)).includes("zoom"));
});

test("choosers offer what there is, B follows A while linked, and a key brings the next pattern", async () => {
  const { page } = tab;
  await look(page, kPair);
  const values = (id) =>
    part(page, id)
      .locator("option")
      .evaluateAll((options) => options.map((option) => option.value));
  assert.deepEqual((await values("a-scene")).sort(), ["board", "disk", "edge"]);
  assert.deepEqual(await values("a-spp"), ["1", "4", "16"]);
  assert.deepEqual((await values("a-source")).sort(), [
    "exact",
    "hammersley",
    "jittered",
    "random",
    "regular",
    "zaremba",
  ]);
  await part(page, "a-scene").selectOption("disk");
  await settled(page);
  assert.equal(await part(page, "b-scene").inputValue(), "disk");
  assert.equal(await part(page, "b-source").inputValue(), "zaremba");
  await part(page, "link").uncheck();
  await part(page, "a-filter").selectOption("mitchell");
  await settled(page);
  assert.equal(await part(page, "b-filter").inputValue(), "box");
  await part(page, "a-source").selectOption("exact");
  await settled(page);
  assert.ok(await part(page, "a-spp").isDisabled());
  await part(page, "a-source").selectOption("random");
  await settled(page);
  assert.equal(await part(page, "a-spp").inputValue(), "4", "an exact image's successor has B's samples");
  await part(page, "swap").click();
  await settled(page);
  assert.equal(await part(page, "b-source").inputValue(), "random");
  await part(page, "stage").focus();
  const order = await values("b-source");
  await page.keyboard.press("n");
  await settled(page);
  assert.equal(await part(page, "b-source").inputValue(), order[(order.indexOf("random") + 1) % order.length]);
});

test("the keyboard alone moves the crosshair, is told the numbers, and finds the table of keys", async () => {
  const { page } = tab;
  await look(page, { ...kPair, at: "10,20" });
  await page.mouse.move(2, 2);
  await part(page, "stage").focus();
  for (const key of ["l", "l", "j", "k", "k", "h"]) await page.keyboard.press(key);
  await settled(page);
  assert.equal(await part(page, "readout-place").textContent(), "Pixel 11, 19");
  await page.waitForFunction(() =>
    document.querySelector('[data-testid="image-viewer"] [data-testid="live"]').textContent.startsWith("Pixel 11, 19"),
  );
  await page.keyboard.press("?");
  assert.ok(await part(page, "keys").isVisible());
  const keys = await part(page, "keys").locator("kbd").allTextContents();
  assert.equal(new Set(keys).size, keys.length, "one key does one thing");
  await page.keyboard.press("Escape");
  await part(page, "keys").waitFor({ state: "hidden" });
  await page.keyboard.press("Escape");
  await settled(page);
  assert.ok(Number.isNaN(await number(page, "readout-a-error")));
});

test("a link restores everything", async () => {
  const { page } = tab;
  await look(page, {
    ...kPair,
    "b-show": "error",
    mode: "swipe",
    wipe: "0.3",
    ev: "-1.5",
    map: "heat",
    zoom: "12",
    centre: "20.5,30.25",
    at: "21,31",
    region: "2,3,20,10",
    link: "no",
  });
  await part(page, "mode-side").check();
  await part(page, "mode-swipe").check();
  await page.waitForTimeout(300); // the address follows the choices a moment later
  const hash = await page.evaluate(() => location.hash);
  const other = await open(tab.browser, pageOf("quick"), { hash });
  await section(other, "images");
  await settled(other);
  for (const id of ["a-source", "b-source", "a-show", "b-show", "map", "exposure", "region-x", "region-w"]) {
    assert.equal(await part(other, id).inputValue(), await part(page, id).inputValue(), id);
  }
  for (const id of ["zoom", "readout-place", "region-caption", "exposure-value"]) {
    assert.equal(await part(other, id).textContent(), await part(page, id).textContent(), id);
  }
  for (const id of ["region-a-rmse", "region-difference-p99", "readout-b-value"]) {
    assert.equal(await number(other, id), await number(page, id), id);
  }
  assert.ok(await part(other, "mode-swipe").isChecked());
  assert.ok(!(await part(other, "link").isChecked()));
  assert.equal(await part(other, "wipe").getAttribute("aria-valuenow"), "30");
  assert.equal(await fingerprint(other, "canvas"), await fingerprint(page, "canvas"));
  await close(other);
});

test("links lead to EXR files that are there, and what the page left out is listed", async () => {
  const { page } = tab;
  await look(page, kPair);
  const links = await page
    .locator('[data-testid="side-b"] a')
    .evaluateAll((all) => all.map((link) => decodeURIComponent(new URL(link.href).pathname)));
  assert.equal(links.length, 2);
  for (const link of links) assert.ok(existsSync(link), link);
  assert.equal(unpack(data.runs[0].left_out).length, 0);
  assert.equal(await part(page, "left-out").count(), 0);
  const cut = structuredClone(data);
  const gone = cut.runs[0].images.filter((image) => image.kind === "error").slice(0, 3);
  cut.runs[0].left_out = gone.map(({ id, file }) => ({ file, label: id }));
  cut.runs[0].images = cut.runs[0].images.filter((image) => !gone.includes(image));
  const file = path.join(kRuns, "quick", "cut.html");
  writeFileSync(file, withData(pageOf("quick"), cut));
  const other = await open(tab.browser, file);
  await section(other, "images");
  await settled(other);
  await part(other, "left-out").locator("summary").click();
  assert.equal(await part(other, "left-out").locator("li").count(), 3);
  await close(other);
  rmSync(file);
});
