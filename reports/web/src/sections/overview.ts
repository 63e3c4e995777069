// What was run and what came out: the ranking of patterns first, then every number.
import { Choice, options, toolbar } from "../controls";
import { el } from "../dom";
import type { Child } from "../dom";
import type { Page, Section } from "../page";
import type { Row, RunData } from "../run_data";
import { distinct, num, str } from "../run_data";
import { swatch } from "../series_style";
import type { TableColumn } from "../table";
import {
  countColumn,
  narrowing,
  numberColumn,
  plainColumns,
  sortableTable,
  textColumn,
  valueWithInterval,
} from "../table";
import { breakable, count, number, samplesPerPixel } from "../text";
import { answers } from "./answers";

/** The study's own seed: the first `seed = N` before its first table. */
function seedOf(study: string): string | undefined {
  const head = study.split(/^\s*\[/m)[0] ?? "";
  return /^seed\s*=\s*(\S+)/m.exec(head)?.[1];
}

/** The study in a line. */
function gist(data: RunData): string {
  const trials = Math.max(
    0,
    ...(data.table("summary")?.rows ?? []).map((row) => num(row, "n_trials") || num(row, "trials") || 0),
  );
  const parts: string[] = [];
  if (data.scenes.length > 0) {
    parts.push(
      count(data.scenes.length, "scene"),
      count(data.allSeries.length, "pattern"),
      count(data.filters.length, "filter"),
    );
    parts.push(samplesPerPixel(data.spps));
  } else if (data.discrepancies.length > 0) {
    const ns = distinct(data.discrepancies.map((row) => num(row, "n"))).sort((a, b) => a - b);
    const measures = distinct(data.discrepancies.map((row) => str(row, "measure")));
    parts.push(count(data.allSeries.length, "pattern"), count(measures.length, "discrepancy", "discrepancies"));
    parts.push(`sets of ${ns[0] ?? 0} to ${ns.at(-1) ?? 0} points`);
  }
  if (trials > 0) parts.push(trials === 1 ? "one trial" : `up to ${trials.toLocaleString("en")} trials`);
  return `Study “${data.run.header.study.name}”${parts.length > 0 ? `: ${parts.join("; ")}` : ""}.`;
}

function facts(data: RunData): HTMLElement {
  const { tool, host, study } = data.run.header;
  const list = el("dl", { class: "facts" });
  const fact = (name: string, ...value: Child[]): void => {
    list.append(el("div", {}, el("dt", {}, name), el("dd", {}, ...value)));
  };
  const seed = seedOf(study.text);
  if (seed !== undefined) fact("Seed", seed);
  fact("Program", `moire ${tool.version}${tool.commit ? `, commit ${tool.commit.slice(0, 10)}` : ""}`);
  fact("Build", [tool.build_type, tool.compiler, tool.flags].filter((part) => part).join(", "));
  fact("Machine", `${host.cpu}, ${count(host.cores, "core")}, ${host.os}`);
  fact("Study hash", el("code", {}, study.sha256.slice(0, 16)));
  return list;
}

/** How many times the best error, as a bar on a log scale: 1 has none, the worst of the table has all of it. */
function bar(ratio: number, worst: number, color: string): HTMLElement {
  const share = worst > 1 ? Math.log(Math.max(ratio, 1)) / Math.log(worst) : 0;
  const inner = el("span", {});
  inner.style.width = `${(2 + 98 * share).toFixed(1)}%`;
  inner.style.background = color;
  return el("span", { class: "bar", "aria-hidden": true }, inner);
}

function ratio(value: number, lo: number, hi: number, worst: number, color: string): Child {
  // The best is 1 by definition: no interval.
  const text = lo === value && hi === value ? number(value) : valueWithInterval(value, lo, hi);
  return el("span", { class: "ratio" }, bar(value, worst, color), el("span", { class: "grow" }, text));
}

/** Why a pattern has no error at equal time. */
const kTimeless = "even its smallest number of samples takes longer than the time at which patterns are compared";

function sceneCard(page: Page, scene: string, rows: Row[]): HTMLElement {
  const { data, styles } = page;
  const worst = (column: string): number => Math.max(1, ...rows.map((row) => num(row, column)).filter(Number.isFinite));
  const [worst_samples, worst_time] = [worst("relative_rmse"), worst("relative_at_equal_time")];
  const color = (row: Row): string => styles.of(data.series(row)).color;
  const columns: TableColumn[] = [
    { title: "#", numeric: true, sort: (row) => num(row, "rank"), cell: (row) => str(row, "rank") },
    {
      title: "pattern",
      numeric: false,
      sort: (row) => data.series(row),
      cell: (row) =>
        el(
          "span",
          { class: "named" },
          swatch(styles.of(data.series(row))),
          el("span", {}, breakable(data.series(row))),
        ),
    },
    {
      title: "at equal samples",
      hint: "RMSE of active pixels over the best pattern's, with its 95% interval",
      numeric: true,
      sort: (row) => num(row, "relative_rmse"),
      cell: (row) =>
        ratio(
          num(row, "relative_rmse"),
          num(row, "relative_rmse_lo"),
          num(row, "relative_rmse_hi"),
          worst_samples,
          color(row),
        ),
    },
  ];
  const timeless = (row: Row): boolean => !Number.isFinite(num(row, "relative_at_equal_time"));
  const has_times = !rows.every(timeless);
  if (has_times) {
    columns.push({
      title: "at equal time",
      hint: "RMSE over the best pattern's, each at the sample count that the same time allows",
      numeric: true,
      sort: (row) => num(row, "relative_at_equal_time"),
      cell: (row) =>
        timeless(row)
          ? el("span", { title: kTimeless }, "–")
          : ratio(num(row, "relative_at_equal_time"), NaN, NaN, worst_time, color(row)),
    });
  }
  return el(
    "article",
    { class: "card", "data-testid": "ranking" },
    el("h3", {}, scene),
    el("p", {}, answer(data, rows)),
    sortableTable(
      { columns: Object.keys(rows[0] ?? {}), rows },
      {
        name: `ranking_${scene}`,
        caption: `Ranking of patterns: ${scene}`,
        columns,
        sort: { column: 0, descending: false },
        plain: true,
      },
    ),
    has_times && rows.some(timeless) && el("p", { class: "note" }, `–: ${kTimeless}.`),
  );
}

/** The ranking in a sentence. */
function answer(data: RunData, rows: Row[]): string {
  const by = (column: string): Row[] =>
    rows.filter((row) => Number.isFinite(num(row, column))).sort((a, b) => num(a, column) - num(b, column));
  const samples = by("relative_rmse");
  const [first, second] = samples;
  const last = samples.at(-1);
  if (first === undefined || last === undefined) return "No pattern has an error to rank by.";
  if (second === undefined) return `Only ${data.series(first)} has an error to rank by.`;
  let text = `At equal samples ${data.series(first)} is best`;
  text += `; next is ${data.series(second)} with ${number(num(second, "relative_rmse"))} times its error`;
  const open = num(second, "relative_rmse_lo") <= num(first, "relative_rmse_hi");
  if (open) text += " (their intervals overlap)";
  if (last !== second) text += `, last ${data.series(last)} with ${number(num(last, "relative_rmse"))} times`;
  const timed = by("relative_at_equal_time");
  const [time] = timed;
  // The best of one is no news.
  return time === undefined || timed.length < 2 ? `${text}.` : `${text}. At equal time ${data.series(time)} is best.`;
}

function rankings(host: HTMLElement, page: Page): void {
  const ranking = page.data.table("ranking");
  if (ranking === undefined) return;
  const { rows } = ranking;
  const spps = distinct(rows.map((row) => str(row, "spp")));
  const middle = spps[Math.floor((spps.length - 1) / 2)];
  const filter = new Choice(
    page.state,
    "ov.filter",
    "Filter",
    options(distinct(rows.map((row) => str(row, "filter")))),
  );
  const spp = new Choice(page.state, "ov.spp", "Samples per pixel", options(spps), middle);
  const cards = el("div", { class: "cards" });
  const draw = (): void => {
    const own = rows.filter((row) => str(row, "filter") === filter.value && str(row, "spp") === spp.value);
    const scenes = distinct(own.map((row) => str(row, "scene")));
    cards.replaceChildren(
      ...scenes.map((scene) =>
        sceneCard(
          page,
          scene,
          own.filter((row) => str(row, "scene") === scene),
        ),
      ),
    );
    if (scenes.length === 0)
      cards.append(el("p", { class: "note" }, "No scene has rows for this filter and number of samples."));
  };
  host.append(
    el("h3", {}, "Which pattern has the smallest error?"),
    el(
      "p",
      { class: "note" },
      "1 marks the pattern with the smallest error, 2 means twice that error. Bars are on a log scale; brackets hold " +
        "95% intervals.",
    ),
    toolbar(filter.control(draw), spp.control(draw)),
    cards,
  );
  draw();
}

/** Every row of the summary, the columns that most readers look for; the CSV has them all. */
function everything(data: RunData): HTMLElement | undefined {
  const summary = data.table("summary");
  if (summary === undefined || data.errors.length === 0) return undefined;
  const has = (name: string): boolean => summary.columns.includes(name);
  const series: TableColumn = {
    ...textColumn("pattern"),
    sort: (row) => data.series(row),
    cell: (row) => data.series(row),
  };
  const columns = [
    textColumn("scene"),
    textColumn("filter"),
    series,
    countColumn("spp", "spp"),
    numberColumn("rmse_active", "RMSE, active [95%]"),
    numberColumn("rmse_all", "RMSE, all [95%]"),
    numberColumn("max_abs_active", "largest error"),
    numberColumn("bias_active", "bias"),
    ...(has("slope") ? [numberColumn("slope", "slope [95%]")] : []),
    ...(has("time_per_active_pixel_ns")
      ? [numberColumn("time_per_active_pixel_ns", "time per active pixel, µs", 1e-3)]
      : []),
    countColumn("n_trials", "trials"),
  ];
  return sortableTable(summary, {
    name: "summary",
    caption: "All results over trials",
    columns,
    filters: narrowing(summary, ["scene", "filter", "spp", "pattern", "layout", "estimator"]),
  });
}

export const overview: Section = {
  id: "overview",
  title: () => "Overview",
  lead: () => [],
  present: () => true,

  render(host, page) {
    const { data } = page;
    host.append(el("p", { class: "lead" }, gist(data)));
    for (const notice of data.run.notices ?? []) host.append(el("p", { class: "note", role: "note" }, notice));
    const said = answers(data);
    if (said.length > 0)
      host.append(el("h3", {}, "What comes out"), el("ul", {}, ...said.map((text) => el("li", {}, text))));
    rankings(host, page);
    const table = everything(data);
    if (table !== undefined) host.append(table);
    const other = data.table("summary");
    if (other !== undefined && data.errors.length === 0 && data.discrepancies.length === 0) {
      host.append(sortableTable(other, { name: "summary", caption: "All results", columns: plainColumns(other) }));
    }
    host.append(
      el("h3", {}, "What was run"),
      facts(data),
      el(
        "details",
        { class: "study" },
        el("summary", {}, "The study's text"),
        el("pre", { tabindex: 0 }, data.run.header.study.text),
      ),
    );
  },
};
