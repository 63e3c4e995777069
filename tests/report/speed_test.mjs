// 60 images of 256 x 256 are decoded within a second, and a page with them is ready soon after it is opened.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import path from "node:path";
import { test } from "node:test";
import { close, launch, open, section } from "./browser.mjs";
import { dataOf, kWeb, pageOf } from "./runs.mjs";
import { settled } from "./viewer.mjs";

const { buildSync } = createRequire(path.join(kWeb, "package.json"))("esbuild");

test("60 images of 256 x 256 are decoded within a second, and looked at soon after the page is opened", async (t) => {
  const images = dataOf(pageOf("quick")).runs[0].images.filter(
    (image) => image.kind === "error" && image.pixels.w === 256,
  );
  assert.ok(images.length >= 60);
  const { outputFiles } = buildSync({
    entryPoints: [path.join(kWeb, "src/decode.ts")],
    bundle: true,
    write: false,
    format: "iife",
    globalName: "decode",
  });
  const browser = await launch();
  const begin = performance.now();
  const page = await open(browser, pageOf("quick"));
  await section(page, "images");
  await settled(page);
  const ready = performance.now() - begin;
  // The best of three: other work on the machine only ever adds.
  const decoding = await page.evaluate(`(async () => {
    ${outputFiles[0].text}
    const { runs } = JSON.parse(document.getElementById("moire-report").textContent);
    const images = runs[0].images.filter((image) => image.kind === "error" && image.pixels.w === 256).slice(0, 60);
    let best = Infinity;
    for (let i = 0; i < 3; ++i) {
      const begin = performance.now();
      await Promise.all(images.map((image) => decode.decodePixels(image.pixels)));
      best = Math.min(best, performance.now() - begin);
    }
    return best;
  })()`);
  t.diagnostic(`page ready after ${ready.toFixed(0)} ms, 60 images decoded in ${decoding.toFixed(0)} ms`);
  assert.ok(decoding < 1000, `${decoding} ms`);
  assert.ok(ready < 10000, `${ready} ms: a start of the tab, of the page and of its viewer, on a busy machine`);
  await close(page);
  await browser.close();
});
