// How the error falls as samples are added: RMSE against samples per pixel, one chart for each scene and filter.
import type { Axis, ChartSpec, Line } from "../chart_spec";
import { commonDomain } from "../axis";
import { chartCard } from "../chart_card";
import { Choice, Choices, colourKey, Hidden, legend, options, toolbar } from "../controls";
import { el } from "../dom";
import type { Figure, Page, Section } from "../page";
import type { Row, RunData, Table } from "../run_data";
import { distinct, num, str } from "../run_data";
import { narrowing, numberColumn, sortableTable, textColumn } from "../table";
import { breakable, fixed, interval, number, slug } from "../text";

export const kSlopes = [-0.5, -0.75, -1];

const kMostLines = 8; // of a chart that shows all its series at first
const kFirstLines = 6; // of another: the best ones

const kMetrics: Record<string, string> = {
  rmse_active: "RMSE of active pixels",
  rmse_all: "RMSE of all pixels",
  max_abs_active: "largest error of an active pixel",
};

function pointOf(row: Row, series: string, metric: string): Line["points"][number] {
  const y = num(row, metric);
  const lo = num(row, `${metric}_lo`);
  const hi = num(row, `${metric}_hi`);
  const range = Number.isFinite(lo) ? { lo, hi } : {};
  const says = `${series}, ${str(row, "spp")} spp: ${number(y)}${Number.isFinite(lo) ? ` ${interval(lo, hi)}` : ""}`;
  return { x: num(row, "spp"), y, ...range, says };
}

/** One chart: the lines of that scene and filter. */
export function convergenceSpec(
  data: RunData,
  scene: string,
  filter: string,
  metric: string,
  hidden: Set<string>,
): ChartSpec {
  const rows = data.errors.filter((row) => str(row, "scene") === scene && str(row, "filter") === filter);
  const x: Axis = { label: "samples per pixel", column: "spp", scale: "log2" };
  const y: Axis = { label: kMetrics[metric] ?? metric, column: metric, scale: "log10" };
  const lines = distinct(rows.map((row) => data.series(row)))
    .filter((key) => !hidden.has(key))
    .map((key): Line => {
      const own = rows.filter((row) => data.series(row) === key).sort((a, b) => num(a, "spp") - num(b, "spp"));
      const slope = metric === "rmse_active" ? num(own[0] ?? {}, "slope") : NaN; // fitted to that error alone
      const end = Number.isFinite(slope) ? { end: fixed(slope, 2) } : {};
      return { key, dots: true, line: true, ...end, points: own.map((row) => pointOf(row, key, metric)) };
    });
  const name = ["convergence", slug(scene), slug(filter)].join("_");
  return { name, title: `${scene}, ${filter}`, x, y, lines, guides: kSlopes };
}

/** Series by their error, the best first: over scenes and filters in the logarithm, at the largest sample count. */
export function bestFirst(data: RunData): string[] {
  const most = data.spps.at(-1);
  const sums = new Map<string, [number, number]>();
  const cases = new Map<string, number>(); // the least error of each
  const rows = data.errors.filter((row) => num(row, "spp") === most && num(row, "rmse_active") > 0);
  const caseOf = (row: Row): string => `${str(row, "scene")}|${str(row, "filter")}`;
  for (const row of rows)
    cases.set(caseOf(row), Math.min(cases.get(caseOf(row)) ?? Infinity, num(row, "rmse_active")));
  for (const row of rows) {
    const [sum, n] = sums.get(data.series(row)) ?? [0, 0];
    sums.set(data.series(row), [sum + Math.log(num(row, "rmse_active") / (cases.get(caseOf(row)) ?? NaN)), n + 1]);
  }
  const mean = (key: string): number => {
    const [sum, n] = sums.get(key) ?? [Infinity, 1];
    return sum / n;
  };
  // Not the difference: of two infinite ones it is none.
  return [...data.allSeries].sort((a, b) => (mean(a) < mean(b) ? -1 : mean(a) > mean(b) ? 1 : 0));
}

/** Draws them all over one domain: charts side by side compare by height. */
export function alike(specs: ChartSpec[]): ChartSpec[] {
  const x = commonDomain(specs, "x");
  const y = commonDomain(specs, "y");
  return specs.map((spec) => ({
    ...spec,
    x: x === undefined ? spec.x : { ...spec.x, domain: x },
    y: y === undefined ? spec.y : { ...spec.y, domain: y },
  }));
}

/** The fitted slopes: one row for each line. */
function slopeTable(data: RunData): Table {
  const seen = new Set<string>();
  const rows = data.errors.filter((row) => {
    const key = [str(row, "scene"), str(row, "filter"), data.series(row)].join("|");
    if (seen.has(key) || !Number.isFinite(num(row, "slope"))) return false;
    seen.add(key);
    return true;
  });
  const columns = [
    "scene",
    "filter",
    "pattern",
    "layout",
    "estimator",
    "slope",
    "slope_lo",
    "slope_hi",
    "slope_spp_min",
    "slope_spp_max",
  ];
  return { columns: columns.filter((name) => data.table("summary")?.columns.includes(name)), rows };
}

/** The charts of the chosen scenes and filters, in a grid of as many columns as there is room for. */
export function chartGrid(cards: HTMLElement[]): HTMLElement {
  return el("div", { class: cards.length <= 2 || cards.length === 4 ? "charts large" : "charts" }, ...cards);
}

export const convergence: Section = {
  id: "convergence",
  title: () => "Convergence",
  lead: (data) => {
    const has = (column: string): boolean => data.errors.some((row) => Number.isFinite(num(row, column)));
    return [
      "Root mean square error against samples per pixel, N. The dashed fan shows how errors fall as N",
      el("sup", {}, "−1/2"),
      " (independent samples), N",
      el("sup", {}, "−3/4"),
      " and N",
      el("sup", {}, "−1"),
      "." +
        (has("rmse_active_lo") ? " Bands are 95% confidence intervals over trials." : "") +
        (has("slope") ? " Enlarged, a chart names its lines, with their fitted slopes; the table below has all." : ""),
    ];
  },
  present: (data) => data.errors.length > 0 && data.spps.length > 1,

  render(host, page) {
    const { data, state } = page;
    const scenes = new Choices(state, "cv.scenes", "Scenes", data.scenes, 3);
    const filters = new Choices(state, "cv.filters", "Filters", data.filters, 2);
    const columns = data.table("summary")?.columns ?? [];
    const metric = new Choice(
      state,
      "cv.metric",
      "Error",
      options(
        Object.keys(kMetrics).filter((name) => columns.includes(name)),
        (name) => kMetrics[name] ?? name,
      ),
    );
    const grid = el("div", {});
    // More than a few lines hide one another: the best are shown, the others by choice.
    const patterns =
      data.allSeries.length > kMostLines
        ? new Choices(state, "cv.patterns", "Patterns", bestFirst(data), kFirstLines)
        : undefined;
    const key = el("div", {});
    const draw = (): void => {
      const shown = patterns?.values;
      const hidden = shown ? new Set(data.allSeries.filter((name) => !shown.includes(name))) : Hidden.of(state);
      const styles = shown ? page.styles.among(shown) : page.styles;
      if (shown) key.replaceChildren(colourKey("Patterns shown", shown, styles, page.highlight, true));
      const specs = scenes.values.flatMap((scene) =>
        filters.values.map((filter) => convergenceSpec(data, scene, filter, metric.value, hidden)),
      );
      grid.replaceChildren(
        chartGrid(alike(specs).map((spec) => chartCard(spec, { styles, highlight: page.highlight }))),
      );
    };
    const slopes = slopeTable(data);
    host.append(
      toolbar(
        data.scenes.length > 1 ? scenes.control(draw) : undefined,
        data.filters.length > 1 ? filters.control(draw) : undefined,
        metric.control(draw),
        patterns?.control(draw),
      ),
      patterns ? key : legend(data.allSeries, page.styles, state, page.highlight, draw),
      grid,
    );
    draw();
    if (slopes.rows.length > 0) {
      host.append(
        sortableTable(slopes, {
          name: "slopes",
          caption: "Fitted slopes of log RMSE against log samples",
          columns: [
            textColumn("scene"),
            textColumn("filter"),
            { ...textColumn("pattern"), sort: (row) => data.series(row), cell: (row) => breakable(data.series(row)) },
            numberColumn("slope", "slope [95%]"),
            {
              title: "fitted over spp",
              numeric: true,
              sort: (row) => num(row, "slope_spp_min"),
              cell: (row) => `${str(row, "slope_spp_min")} to ${str(row, "slope_spp_max")}`,
            },
          ],
          filters: narrowing(slopes, ["scene", "filter", "pattern"]),
          sort: { column: 3, descending: false },
        }),
      );
    }
  },

  figures: (page: Page): Figure[] =>
    page.data.scenes.flatMap((scene) =>
      page.data.filters.map((filter) => ({
        spec: convergenceSpec(page.data, scene, filter, "rmse_active", new Set()),
        styles: page.styles,
      })),
    ),
};
