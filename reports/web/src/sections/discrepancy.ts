// How evenly points lie: discrepancies against the number of points, beside the paper's tables, and the points drawn.
import type { ChartSpec, Line, Point } from "../chart_spec";
import { chartCard } from "../chart_card";
import { Choice, Hidden, legend, options, toolbar } from "../controls";
import { el } from "../dom";
import type { Figure, Page, Section } from "../page";
import type { Row } from "../run_data";
import { distinct, num, RunData, str } from "../run_data";
import type { PointSet } from "../schema";
import type { TableColumn } from "../table";
import { chosenColumns, narrowing, sortableTable, textColumn } from "../table";
import { breakable, fixed, interval, number, slug } from "../text";
import { kSlopes } from "./convergence";

/** What the tables show, with headings; the CSV has all columns. */
const kSlopeColumns = [
  ["pattern"],
  ["measure"],
  ["dims", "dimensions"],
  ["slope"],
  ["known", "known slope"],
  ["known_is", "known for"],
  ["n_max", "N up to"],
  ["trials"],
  ["why"],
] as const;
const kSummaryColumns = [
  ["n", "N"],
  ["dims", "dimensions"],
  ["measure"],
  ["mean"],
  ["trials"],
  ["paper", "paper's"],
  ["paper_z", "z"],
  ["paper_doubt", "doubt about the paper's"],
] as const;

function measureLabel(measure: string, dims: string, several_dims: boolean): string {
  return several_dims ? `${measure}, ${dims}-D` : measure;
}

interface Measure {
  measure: string;
  dims: string;
}

function measuresOf(rows: Row[]): Measure[] {
  return distinct(rows.map((row) => `${str(row, "measure")}|${str(row, "dims")}`)).map((key) => {
    const [measure = "", dims = ""] = key.split("|");
    return { measure, dims };
  });
}

function spec(data: RunData, of: Measure, several_dims: boolean, hidden: Set<string>): ChartSpec {
  const rows = data.discrepancies.filter((row) => str(row, "measure") === of.measure && str(row, "dims") === of.dims);
  const lines = distinct(rows.map((row) => data.series(row)))
    .filter((key) => !hidden.has(key))
    .map((key): Line => {
      const own = rows.filter((row) => data.series(row) === key).sort((a, b) => num(a, "n") - num(b, "n"));
      const points = own.map((row): Point => {
        const [y, lo, hi] = [num(row, "mean"), num(row, "mean_lo"), num(row, "mean_hi")];
        const says = `${key}, ${str(row, "n")} points: ${number(y)}`;
        if (!Number.isFinite(lo)) return { x: num(row, "n"), y, says };
        return { x: num(row, "n"), y, lo, hi, says: `${says} ${interval(lo, hi)}` };
      });
      return { key, dots: true, line: true, points };
    });
  return {
    name: ["discrepancy", slug(of.measure), ...(of.dims === "2" ? [] : [`${slug(of.dims)}d`])].join("_"),
    title: measureLabel(of.measure, of.dims, several_dims),
    x: { label: "points in a set, N", column: "n", scale: "log2" },
    y: { label: "mean discrepancy", column: "mean", scale: "log10" },
    lines,
    guides: kSlopes,
  };
}

function allSpecs(data: RunData, hidden: Set<string>): ChartSpec[] {
  const measures = measuresOf(data.discrepancies);
  const several = distinct(measures.map((one) => one.dims)).length > 1;
  return measures
    .map((one) => spec(data, one, several, hidden))
    .filter((one) => one.lines.some((line) => line.points.length > 1) || hidden.size > 0);
}

/** One cell: what we measured over what the paper prints. */
function paperCell(row: Row): HTMLElement {
  const paper = num(row, "paper");
  const z = num(row, "paper_z");
  const said = el("span", { class: "paper" }, Number.isFinite(paper) ? number(paper) : "–");
  if (Number.isFinite(z)) said.append(` (z ${fixed(z, 1)})`);
  if (str(row, "paper_doubt") !== "") said.append(" ", el("abbr", { title: str(row, "paper_doubt") }, "doubt"));
  return el("span", { class: "beside" }, el("span", {}, number(num(row, "mean"))), said);
}

/** A table of the paper: a row for each pattern, a column for each N. */
function paperTable(page: Page, table: string, rows: Row[]): HTMLElement {
  const ns = distinct(rows.map((row) => num(row, "n"))).sort((a, b) => a - b);
  const by_measure = measuresOf(rows);
  const keys = distinct(rows.map((row) => `${page.data.series(row)}|${str(row, "measure")}`));
  const lines: Row[] = keys.map((key) => {
    const [pattern = "", measure = ""] = key.split("|");
    return { pattern, measure };
  });
  const find = (line: Row, n: number): Row | undefined =>
    rows.find(
      (row) => num(row, "n") === n && page.data.series(row) === line["pattern"] && row["measure"] === line["measure"],
    );
  const columns: TableColumn[] = [
    textColumn("pattern"),
    ...(by_measure.length > 1 ? [textColumn("measure")] : []),
    ...ns.map(
      (n): TableColumn => ({
        title: `N = ${n}`,
        numeric: true,
        sort: (line) => {
          const row = find(line, n);
          return row === undefined ? NaN : num(row, "mean");
        },
        cell: (line) => {
          const row = find(line, n);
          return row === undefined ? "" : paperCell(row);
        },
      }),
    ),
  ];
  return sortableTable(
    { columns: ["pattern", "measure"], rows: lines },
    {
      name: `paper_table_${slug(table)}`,
      caption: `Table ${table} of the paper: measured, and as printed below`,
      columns,
    },
  );
}

function pointsSpec(set: PointSet): ChartSpec {
  const points = set.x.map((x, i): Point => {
    const y = set.y[i] ?? NaN;
    const t = set.t?.[i];
    return {
      x,
      y,
      says:
        `${set.pattern}, point ${i + 1}: x ${number(x)}, y ${number(y)}` + (t === undefined ? "" : `, t ${number(t)}`),
    };
  });
  return {
    name: ["points", slug(set.pattern), String(set.n)].join("_"),
    title: set.pattern,
    x: { label: "x", column: "x", scale: "linear", domain: [0, 1] },
    y: { label: "y", column: "y", scale: "linear", domain: [0, 1] },
    lines: [{ key: set.pattern, dots: true, line: false, points }],
    square: true,
  };
}

async function renderPoints(host: HTMLElement, page: Page): Promise<void> {
  const sets = await page.data.points();
  if (sets.length === 0) return;
  const ns = distinct(sets.map((set) => set.n)).sort((a, b) => a - b);
  // The patterns that allow a number of points differ: the first choice is the number that most of them have.
  const most = ns.reduce(
    (best, n) =>
      having(sets, n) > having(sets, best) || (having(sets, n) === having(sets, best) && n <= 64) ? n : best,
    ns[0] ?? 0,
  );
  const n = new Choice(page.state, "pt.n", "Points in a set", options(ns), String(most));
  const grid = el("div", { class: "charts squares" });
  const draw = (): void => {
    const shown = sets.filter((set) => String(set.n) === n.value);
    grid.replaceChildren(
      ...shown.map((set) => chartCard(pointsSpec(set), { styles: page.styles, highlight: page.highlight })),
    );
  };
  if (page.data.discrepancies.length > 0) host.append(el("h3", {}, "Points of each pattern in one pixel"));
  host.append(toolbar(n.control(draw)), grid);
  draw();
}

function having(sets: PointSet[], n: number): number {
  return sets.filter((set) => set.n === n).length;
}

export const discrepancy: Section = {
  id: "discrepancy",
  title: (data) => (data.discrepancies.length > 0 ? "Discrepancy" : "Points"),
  lead: (data) => [
    data.discrepancies.length > 0
      ? "How far a set's share of points in a region may stray from the region's area: smaller is more even. " +
        (data.discrepancies.some((row) => Number.isFinite(num(row, "mean_lo")))
          ? "Bands are 95% confidence intervals over trials."
          : "")
      : "The points of each pattern in one pixel, x to the right and y down.",
  ],
  present: (data) => data.discrepancies.length > 0 || RunData.holds(data.run.points),

  async render(host, page) {
    const { data, state } = page;
    const rows = data.discrepancies;
    if (rows.length > 0) {
      const grid = el("div", {});
      const draw = (): void => {
        const options = { styles: page.styles, highlight: page.highlight };
        grid.replaceChildren(
          el("div", { class: "charts" }, ...allSpecs(data, Hidden.of(state)).map((one) => chartCard(one, options))),
        );
      };
      host.append(legend(data.allSeries, page.styles, state, page.highlight, draw), grid);
      draw();
      const tables = distinct(rows.map((row) => str(row, "table")).filter((table) => table !== "")).sort();
      if (tables.length > 0) {
        host.append(
          el("h3", {}, "Beside the paper's tables"),
          el(
            "p",
            { class: "note" },
            "D. P. Mitchell, “Ray tracing and irregularities of distribution”, 1992. " +
              "z: the difference from the paper's value over the standard errors of both.",
          ),
          ...tables.map((table) =>
            paperTable(
              page,
              table,
              rows.filter((row) => str(row, "table") === table),
            ),
          ),
        );
      }
      const slopes = data.table("slopes");
      if (slopes !== undefined) {
        host.append(
          sortableTable(slopes, {
            name: "slopes",
            caption: "Fitted slopes of log discrepancy against log N",
            columns: chosenColumns(slopes, kSlopeColumns),
            filters: narrowing(slopes, ["measure", "pattern", "dims"]),
          }),
        );
      }
      const summary = data.table("summary");
      if (summary !== undefined) {
        host.append(
          sortableTable(summary, {
            name: "summary",
            caption: "All discrepancies over trials",
            columns: [
              { ...textColumn("pattern"), sort: (row) => data.series(row), cell: (row) => breakable(data.series(row)) },
              ...chosenColumns(summary, kSummaryColumns),
            ],
            filters: narrowing(summary, ["pattern", "measure", "dims", "n", "table"]),
          }),
        );
      }
    }
    if (RunData.holds(data.run.points)) await renderPoints(host, page);
  },

  async figures(page: Page): Promise<Figure[]> {
    const charts = page.data.discrepancies.length > 0 ? allSpecs(page.data, new Set()) : [];
    const sets = RunData.holds(page.data.run.points) ? await page.data.points() : [];
    return [...charts, ...sets.map(pointsSpec)].map((one) => ({ spec: one, styles: page.styles }));
  },
};
