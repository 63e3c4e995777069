// Chromium for the tests: pages from files, and everything a page must not do noted down.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { kWeb } from "./runs.mjs";

const requireFromWeb = createRequire(path.join(kWeb, "package.json"));
const { chromium } = requireFromWeb("playwright-core");
export const kAxe = requireFromWeb.resolve("axe-core/axe.min.js");

/** `also`: more flags. */
export function launch(also = []) {
  const args = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-background-networking",
    "--no-first-run",
    ...also,
  ];
  return chromium.launch({ executablePath: process.env.MOIRE_CHROMIUM, args });
}

/** A tab with that file, once `ready` is there. `page.faults` has requests that leave the disk, errors and refusals. */
export async function open(browser, file, options = {}) {
  const { hash = "", scheme = "light", width = 1280, height = 900, ready = "main section" } = options;
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: scheme, acceptDownloads: true });
  const page = await context.newPage();
  page.faults = [];
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) page.faults.push(`request of ${request.url()}`);
  });
  page.on("requestfailed", (request) => page.faults.push(`failed: ${request.url()}`));
  page.on("pageerror", (error) => page.faults.push(`exception: ${error.message}`));
  page.on("console", (message) => {
    if (message.type() === "error" || message.type() === "warning") page.faults.push(`console: ${message.text()}`);
  });
  await page.goto(pathToFileURL(file).href + hash);
  await page.locator(ready).first().waitFor({ state: "attached" });
  return page;
}

/** The page did nothing that it must not do; closes it. */
export async function close(page) {
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

/** The section, drawn. */
export async function section(page, id) {
  await page.locator(`nav a[data-section="${id}"]`).click();
  const found = page.locator(`section[id="${id}"]`);
  await found.locator(".body:not(.waiting)").waitFor();
  return found;
}
