// The page as a whole, on every kind of run: sections that are there and those that are not, no way out to the network,
// accessibility in both themes, print, tables, charts and what the reader takes away from them.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { close, kAxe, launch, open, section } from "./browser.mjs";
import { dataOf, kProgram, kRuns, pageOf, unpack, withData } from "./runs.mjs";

const kSections = {
  quick: ["overview", "convergence", "time-error", "images", "discrepancy"], // the last: points of its patterns
  noise: ["overview", "convergence", "time-error", "images", "spectra"],
  filters: ["overview", "convergence", "time-error", "images", "filters"],
  mitchell92: ["overview", "discrepancy"],
};
const kNeverThere = {
  quick: ["spectra", "stability"],
  noise: ["stability"],
  filters: ["spectra", "stability"],
  mitchell92: ["convergence", "images", "spectra", "filters", "stability"],
};
const axe = readFileSync(kAxe, "utf8");

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

/** Every section drawn, as before printing. */
async function drawAll(page) {
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  await page.waitForFunction(() => document.querySelector(".waiting, [aria-busy=true]") === null);
  await page.waitForTimeout(300); // charts draw themselves once they know their width
}

/** The rows of a CSV text without quotes. */
function csv(text) {
  const [head, ...lines] = text
    .trimEnd()
    .split("\n")
    .map((line) => line.split(","));
  return lines.map((cells) => {
    assert.equal(cells.length, head.length);
    return Object.fromEntries(head.map((name, i) => [name, cells[i]]));
  });
}

/** What pressing there saves. Chromium drops what a page saves beyond ten files a second. */
async function downloaded(page, press) {
  await page.waitForTimeout(110);
  const [file] = await Promise.all([page.waitForEvent("download"), press()]);
  return { name: file.suggestedFilename(), text: readFileSync(await file.path(), "utf8") };
}

/** It parses as SVG, has something drawn, and needs nothing of a page. */
async function checkSvg(page, text) {
  const found = await page.evaluate((source) => {
    const document = new DOMParser().parseFromString(source, "image/svg+xml");
    return {
      error: document.querySelector("parsererror")?.textContent,
      root: document.documentElement.tagName,
      drawn: document.querySelectorAll("path, circle, line, rect").length,
    };
  }, text);
  assert.equal(found.error, undefined);
  assert.equal(found.root, "svg");
  assert.ok(found.drawn > 0);
  assert.doesNotMatch(text, /var\(--|url\(http|href="http/);
}

/** What axe-core has to say against the page; `options` as axe.run takes them. */
async function violations(page, options = {}) {
  const found = await page.evaluate((o) => axe.run(document, { resultTypes: ["violations"], ...o }), options);
  return found.violations.map(
    ({ id, nodes }) =>
      `${id}: ${nodes
        .slice(0, 3)
        .map((node) => node.html)
        .join(" | ")}`,
  );
}

for (const [run, sections] of Object.entries(kSections)) {
  test(`the page of ${run} has its sections and stays on the disk; axe-core finds no fault`, async () => {
    const page = await open(browser, pageOf(run));
    await drawAll(page);
    const there = await page.locator("main > section").evaluateAll((all) => all.map((one) => one.id));
    for (const id of sections) assert.ok(there.includes(id), `${id} among ${there}`);
    for (const id of kNeverThere[run]) assert.ok(!there.includes(id), `${id} among ${there}`);
    assert.deepEqual(await page.locator("nav a").evaluateAll((all) => all.map((one) => one.dataset.section)), there);
    assert.equal(await page.locator(".failure").count(), 0);
    for (const id of there)
      assert.ok((await page.locator(`section[id="${id}"] .body > *`).count()) > 0, `${id} is not empty`);
    await page.evaluate(axe);
    assert.deepEqual(await violations(page), []);
    await page.emulateMedia({ colorScheme: "dark" });
    await page.waitForFunction(() => document.documentElement.dataset.theme === "dark");
    await page.waitForTimeout(300); // charts draw themselves again
    // Themes differ in nothing but colours.
    assert.deepEqual(await violations(page, { runOnly: ["color-contrast", "link-in-text-block"] }), []);
    await saveOneOfEach(page);
    await close(page);
  });
}

/** A chart of each kind as SVG and CSV, which follow no theme, and a table. */
async function saveOneOfEach(page) {
  const names = await page.getByTestId("chart").evaluateAll((all) => all.map((chart) => chart.dataset.name));
  const kinds = new Map(names.map((name) => [name.split("_")[0], name])); // names begin with it
  assert.ok(kinds.size > 0);
  for (const name of kinds.values()) {
    const chart = page.locator(`[data-testid="chart"][data-name="${name}"]`).first();
    await checkSvg(page, (await downloaded(page, () => chart.getByTestId("save-svg").click())).text);
    assert.match((await downloaded(page, () => chart.getByTestId("save-csv").click())).text, /^[^\n]+\n[^\n]+\n/, name);
  }
  const table = page.getByTestId("save-table").first();
  if ((await table.count()) > 0) assert.ok((await downloaded(page, () => table.click())).text.includes(","));
}

test("the theme follows the system until the reader chooses, and print is light with every section drawn", async () => {
  const page = await open(browser, pageOf("quick"), { scheme: "dark" });
  const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const dark = await ground();
  await page.getByTestId("theme").click();
  assert.notEqual(await ground(), dark);
  await page.getByTestId("theme").click();
  assert.equal(await ground(), dark);
  await page.emulateMedia({ media: "print" });
  assert.equal(await ground(), "rgb(255, 255, 255)");
  await page.emulateMedia({ media: "screen" });
  const pdf = await page.pdf();
  assert.equal(pdf.toString("latin1", 0, 5), "%PDF-");
  assert.equal(await page.locator(".waiting").count(), 0);
  await close(page);
});

test("a link to a section opens there, whatever is drawn around it meanwhile", async () => {
  const file = path.join(kRuns, "all.html");
  for (const [run, id] of [
    ["quick", "images"],
    ["quick", "time-error"],
    ["noise", "spectra"],
    ["filters", "filters"],
    ["mitchell92", "discrepancy"],
  ]) {
    const page = await open(browser, file, { hash: `#run=${run}&section=${id}` });
    await page.waitForFunction(() => document.querySelector(".waiting, [aria-busy=true]") === null);
    await page.waitForTimeout(700); // longer than the page waits for the last change of size
    const { top, end } = await page.locator(`section[id="${id}"] h2`).evaluate((h2) => ({
      top: h2.getBoundingClientRect().top,
      end: innerHeight + scrollY >= document.documentElement.scrollHeight - 2,
    }));
    // Below the bar of sections and within the section's own margin; a page that ends there cannot scroll as far.
    assert.ok(top > 30 && (top < 120 || (end && top < 900)), `${id} of ${run}: its heading is at ${top}`);
    await page.mouse.wheel(0, -300);
    await page.waitForTimeout(300);
    const later = await page.locator(`section[id="${id}"] h2`).evaluate((h2) => h2.getBoundingClientRect().top);
    assert.ok(later > top + 200, `${id} of ${run}: whoever scrolls stays there, ${later} after ${top}`);
    await close(page);
  }
});

test("images that found no room in the page are listed, even where it holds none at all", async () => {
  const folder = mkdtempSync(path.join(tmpdir(), "moire-report-"));
  const data = dataOf(pageOf("noise"));
  const [run] = data.runs;
  run.left_out = run.images
    .filter((image) => image.kind !== "exact")
    .map(({ file, kind, scene }) => ({ file, label: `${kind}: ${scene}` }));
  run.images = [];
  const file = path.join(folder, "index.html");
  writeFileSync(file, withData(pageOf("noise"), data));
  const page = await open(browser, file);
  for (const [id, own] of [
    ["images", (image) => image.endsWith(".error.exr")],
    ["spectra", (image) => /\.(spectrum|structured|noise)\.exr$/.test(image)],
  ]) {
    const links = (await section(page, id)).getByTestId("left-out").locator("a");
    await links.first().waitFor();
    const want = run.left_out.filter((one) => own(one.file)).map((one) => one.file);
    assert.ok(want.length > 0);
    const hrefs = await links.evaluateAll((all) => all.map((a) => decodeURIComponent(a.getAttribute("href"))));
    assert.deepEqual(hrefs, want);
  }
  await close(page);
  rmSync(folder, { recursive: true });
});

test("without an error at equal time there is a dash and a reason, and the best of one is not said to be best", async () => {
  const folder = mkdtempSync(path.join(tmpdir(), "moire-report-"));
  const data = dataOf(pageOf("quick"));
  const ranking = unpack(data.runs[0].tables.ranking);
  const column = (name) => {
    const cells = ranking.columns[name];
    return Array.isArray(cells) ? cells : new Array(ranking.length).fill(cells.all);
  };
  const [scenes, patterns] = [column("scene"), column("pattern")];
  // On "edge" all but one pattern are too slow, on "disk" one is.
  for (const name of ["relative_at_equal_time", "rank_at_equal_time"]) {
    ranking.columns[name] = column(name).map((_, i) => {
      const timed = scenes[i] === "edge" ? patterns[i] === "regular" : patterns[i] !== "regular";
      return timed ? 1 : null;
    });
  }
  data.runs[0].tables.ranking = ranking;
  const file = path.join(folder, "index.html");
  writeFileSync(file, withData(pageOf("quick"), data));
  const page = await open(browser, file);
  const cards = (await section(page, "overview")).getByTestId("ranking");
  const card = (scene) => cards.filter({ has: page.getByRole("heading", { name: scene, exact: true }) });
  assert.doesNotMatch(await card("edge").locator("p").first().textContent(), /equal time/);
  assert.match(await card("disk").locator("p").first().textContent(), /At equal time \S+ is best/);
  for (const [scene, dashes] of [
    ["edge", new Set(patterns).size - 1],
    ["disk", 1],
  ]) {
    const missing = card(scene).locator("tbody td:last-child", { hasText: "–" });
    assert.equal(await missing.count(), dashes, scene);
    assert.match(await missing.first().locator("[title]").getAttribute("title"), /takes longer/);
    assert.match(await card(scene).locator("p.note").textContent(), /takes longer/);
  }
  await close(page);
  rmSync(folder, { recursive: true });
});

test("a pattern has one colour in all runs of a page", async () => {
  const page = await open(browser, path.join(kRuns, "all.html"));
  const looks = new Map();
  for (const run of ["quick", "noise", "filters"]) {
    await page.getByTestId("choose-run").selectOption(run);
    const named = (await section(page, "overview")).getByTestId("ranking").locator(".named");
    for (const [name, look] of await named.evaluateAll((all) =>
      all.map((one) => [one.textContent, one.querySelector(".swatch").innerHTML]),
    )) {
      const plain = look.replace(/plot-[0-9a-z]+/g, "");
      assert.equal(plain, looks.get(name) ?? plain, `${name} in ${run}`);
      looks.set(name, plain);
    }
  }
  await close(page);
});

test("figures of several runs are named after their run and show their title", async () => {
  const file = path.join(kRuns, "all.html");
  const page = await open(browser, file, { hash: "#figures=1", ready: "#moire-figures" });
  const figures = JSON.parse(await page.locator("#moire-figures").textContent());
  assert.equal(new Set(figures.map((one) => one.name)).size, figures.length);
  for (const { name } of figures) assert.match(name, /^(quick|noise|filters|mitchell92)_[a-z0-9._=-]+$/);
  for (const name of ["quick_convergence_edge_box", "filters_kernel", "filters_edge-profile", "filters_response"]) {
    const figure = figures.find((one) => one.name === name);
    assert.ok(figure, `${name} among ${figures.map((one) => one.name)}`);
    const title = await page.evaluate((text) => {
      const svg = new DOMParser().parseFromString(text, "image/svg+xml");
      return [svg.querySelector("title").textContent, svg.querySelector("svg > text").textContent];
    }, figure.svg);
    assert.equal(title[0], title[1]);
    await checkSvg(page, figure.svg);
  }
  await close(page);
});

test("headings sort tables, by mouse and by keyboard, and say so", async () => {
  const page = await open(browser, pageOf("quick"));
  const overview = await section(page, "overview");
  const table = overview.getByTestId("ranking").first().locator("table");
  const heads = table.locator("th[aria-sort]");
  const numbers = () =>
    table
      .locator("tbody tr")
      .evaluateAll((rows) => rows.map((row) => parseFloat(row.querySelector("td.number").textContent)));
  const column = await heads.evaluateAll((all) => all.findIndex((th) => th.classList.contains("number")));
  const head = heads.nth(column);
  await head.locator("button").click();
  const once = await head.getAttribute("aria-sort");
  const first = await numbers();
  await head.locator("button").focus();
  await page.keyboard.press("Enter");
  const twice = await head.getAttribute("aria-sort");
  assert.deepEqual([once, twice].sort(), ["ascending", "descending"]);
  const ascending = [...first].sort((a, b) => a - b);
  const want = (sort) => (sort === "ascending" ? ascending : [...ascending].reverse());
  assert.deepEqual(first, want(once));
  assert.deepEqual(await numbers(), want(twice));
  assert.equal(await table.locator('th[aria-sort]:not([aria-sort="none"])').count(), 1);
  await close(page);
});

test("a convergence chart has a point for each row of summary.csv, reached by keyboard and read aloud", async () => {
  const summary = csv(readFileSync(path.join(kRuns, "quick", "summary.csv"), "utf8")).filter(
    (row) => row.scene === "edge" && row.filter === "box",
  );
  const page = await open(browser, pageOf("quick"));
  const convergence = await section(page, "convergence");
  const chart = convergence.locator('[data-testid="chart"][data-name="convergence_edge_box"]');
  await chart.locator("[tabindex]").first().waitFor();
  assert.equal(await chart.locator('[role="img"][tabindex]').count(), summary.length);
  assert.equal(await chart.locator('[tabindex="0"]').count(), 1);
  await chart.locator('[tabindex="0"]').focus();
  const label = () => page.evaluate(() => document.activeElement.getAttribute("aria-label"));
  const first = await label();
  await page.keyboard.press("ArrowRight");
  assert.notEqual(await label(), first);
  const saved = csv((await downloaded(page, () => chart.getByTestId("save-csv").click())).text);
  assert.equal(saved.length, summary.length);
  for (const row of summary) {
    const point = saved.find((other) => other.series === row.pattern && other.spp === row.spp);
    assert.equal(Number(point?.rmse_active), Number(row.rmse_active), `${row.pattern} at ${row.spp}`);
  }
  const svg = await downloaded(page, () => chart.getByTestId("save-svg").click());
  assert.equal(svg.name, "convergence_edge_box.svg");
  await checkSvg(page, svg.text);
  const legend = convergence.getByTestId("legend").locator("button").first();
  const before = await chart.locator('[role="img"][tabindex]').count();
  await legend.click();
  assert.equal(await legend.getAttribute("aria-pressed"), "false");
  await page.waitForFunction(
    (n) => document.querySelectorAll('[data-name="convergence_edge_box"] [role="img"][tabindex]').length < n,
    before,
  );
  await close(page);
});

test("the focus is seen at every stop of the tab key", async () => {
  const page = await open(browser, pageOf("quick"));
  await drawAll(page);
  await page.evaluate(() => scrollTo(0, 0));
  let stops = 0;
  for (let i = 0; i < 90; ++i) {
    await page.keyboard.press("Tab");
    const seen = await page.evaluate(() => {
      const focus = document.activeElement;
      if (focus === null || focus === document.body) return undefined;
      const marked = (element, pseudo) => {
        const style = getComputedStyle(element, pseudo);
        return (
          (style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 1.5) ||
          (pseudo !== undefined && style.boxShadow !== "none")
        );
      };
      // A radio's mark is on its label's text, a point's is its stroke, the swipe's is its grip.
      const seen =
        marked(focus) ||
        marked(focus, "::after") ||
        (focus.nextElementSibling && marked(focus.nextElementSibling)) ||
        (focus instanceof SVGElement && parseFloat(getComputedStyle(focus).strokeWidth) >= 2);
      return seen ? "" : focus.outerHTML.slice(0, 120);
    });
    if (seen === undefined) break;
    ++stops;
    assert.equal(seen, "");
  }
  assert.ok(stops > 30, `${stops} stops`);
  await close(page);
});

test("a page of several runs shows one at a time, and a link says which", async () => {
  const file = path.join(kRuns, "all.html");
  const page = await open(browser, file);
  const runs = await page
    .getByTestId("choose-run")
    .locator("option")
    .evaluateAll((all) => all.map((option) => option.value));
  assert.deepEqual(runs, ["quick", "noise", "filters", "mitchell92"]);
  await page.getByTestId("choose-run").selectOption("noise");
  await section(page, "spectra");
  await page.getByTestId("spectrum-viewer").waitFor();
  await page.waitForTimeout(300); // the address follows the choices a moment later
  const hash = await page.evaluate(() => location.hash);
  const other = await open(browser, file, { hash });
  assert.equal(await other.getByTestId("choose-run").inputValue(), "noise");
  assert.equal(await other.locator("section#spectra").count(), 1);
  await close(other);
  await page.getByTestId("choose-run").selectOption("mitchell92");
  await page.locator("section#discrepancy").waitFor();
  assert.equal(await page.locator("section#images").count(), 0);
  await close(page);
});

test("moire report --figures writes the charts of a run as SVG files, named after what they show", async () => {
  const folder = mkdtempSync(path.join(tmpdir(), "moire-report-"));
  const page = await open(browser, pageOf("quick"));
  for (const [run, wanted] of Object.entries({
    quick: ["convergence_edge_box.svg", "convergence_board_mitchell.svg", "time-error_edge_box.svg"],
    mitchell92: ["discrepancy_star-l2.svg", "points_zaremba_16.svg"],
  })) {
    const out = path.join(folder, run);
    execFileSync(kProgram, ["report", path.join(kRuns, run), "--figures", out], { stdio: ["ignore", "pipe", "pipe"] });
    const files = readdirSync(out);
    for (const name of wanted) assert.ok(files.includes(name), `${name} among ${files}`);
    for (const name of files) {
      assert.match(name, /^[a-z0-9._=-]+\.svg$/);
      await checkSvg(page, readFileSync(path.join(out, name), "utf8"));
    }
  }
  await close(page);
  rmSync(folder, { recursive: true });
});
