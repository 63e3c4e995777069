// The filters themselves: kernels, frequency responses, the edge that each makes, and their numbers.
import type { ChartSpec, Line, Point, Ring } from "../chart_spec";
import { chartCard } from "../chart_card";
import { Choices, colourKey, toolbar } from "../controls";
import { el } from "../dom";
import type { Figure, Page, Section } from "../page";
import { RunData } from "../run_data";
import type { FilterCurves } from "../schema";
import { chosenColumns, narrowing, sortableTable } from "../table";
import { number, slug } from "../text";
import { chartGrid } from "./convergence";

const kWellKnown = ["box", "tent", "mitchell", "gaussian", "lanczos"];
const kFloor = -80; // dB: below it responses are left out

/** What the tables show, with headings; the CSV has all columns. */
const kKernelColumns = [
  ["filter"],
  ["radius", "radius, pixels"],
  ["variance", "variance, pixels²"],
  ["nyquist_response", "gain at Nyquist"],
  ["smoothing"],
  ["postaliasing"],
  ["overshoot_percent", "overshoot, %"],
  ["noise_gain", "noise gain"],
  ["anisotropy"],
] as const;
const kRankingColumns = [
  ["filter"],
  ["pattern"],
  ["spp"],
  ["rank_total", "rank"],
  ["relative_total", "total error [95%]"],
  ["rank_sampling", "rank, sampling"],
  ["relative_sampling", "error of sampling [95%]"],
] as const;

function line(key: string, xs: number[], ys: number[], unit: string): Line {
  const points = xs.map((x, i): Point => {
    const y = ys[i] ?? NaN;
    return { x, y, says: `${key} at ${number(x)}: ${number(y)}${unit}` };
  });
  return { key, line: true, dots: false, points };
}

function kernelSpec(curves: FilterCurves[], name: string): ChartSpec {
  return {
    name,
    title: "Kernel",
    x: { label: "distance from the pixel's centre, pixels", column: "x", scale: "linear" },
    y: { label: "weight", column: "k", scale: "linear" },
    lines: curves.map((one) => line(one.filter, one.kernel.x, one.kernel.k, "")),
    rules: [{ axis: "y", at: 0 }],
  };
}

const kFrequency: ChartSpec["x"] = { label: "frequency, cycles per pixel", column: "f", scale: "linear" };
const kFrequencyRules: ChartSpec["rules"] = [
  { axis: "y", at: 0 },
  { axis: "x", at: 0.5, label: "Nyquist" },
];

function responseSpec(curves: FilterCurves[], name: string): ChartSpec {
  return {
    name,
    title: "Frequency response",
    x: kFrequency,
    y: { label: "gain", column: "gain", scale: "linear" },
    lines: curves.map((one) => line(one.filter, one.response.f, one.response.gain, "")),
    rules: kFrequencyRules,
  };
}

function decibelSpec(curves: FilterCurves[], name: string): ChartSpec {
  const decibels = (gain: number): number => Math.max(20 * Math.log10(Math.abs(gain)), kFloor);
  return {
    name,
    title: "Frequency response, dB",
    x: kFrequency,
    y: { label: "gain, dB", column: "gain_db", scale: "linear", domain: [kFloor, 6] },
    lines: curves.map((one) => line(one.filter, one.response.f, one.response.gain.map(decibels), " dB")),
    rules: kFrequencyRules,
  };
}

/** The overshoot, where a filter has one: above 1 by more than rounding. */
function overshoot(curves: FilterCurves): Ring[] {
  let best = 0;
  curves.edge.value.forEach((value, i) => {
    if (value > (curves.edge.value[best] ?? 0)) best = i;
  });
  const value = curves.edge.value[best] ?? 0;
  if (!(value > 1 + 1e-6)) return [];
  return [{ key: curves.filter, x: curves.edge.x[best] ?? 0, y: value, label: `+${(100 * (value - 1)).toFixed(1)}%` }];
}

function edgeSpec(curves: FilterCurves[], name: string): ChartSpec {
  return {
    name,
    title: "Edge profile",
    x: { label: "distance from the edge, pixels", column: "x", scale: "linear" },
    y: { label: "value", column: "value", scale: "linear" },
    lines: curves.map((one) => line(one.filter, one.edge.x, one.edge.value, "")),
    rules: [
      { axis: "y", at: 0 },
      { axis: "y", at: 1 },
    ],
    rings: curves.flatMap(overshoot),
  };
}

/** The four charts; names without a filter are of the chosen few, as the page shows them. */
function specs(curves: FilterCurves[], of?: string): ChartSpec[] {
  const name = (kind: string): string => (of === undefined ? kind : `${kind}_${slug(of)}`);
  const all = [
    kernelSpec(curves, name("kernel")),
    edgeSpec(curves, name("edge-profile")),
    responseSpec(curves, name("response")),
    decibelSpec(curves, name("response-db")),
  ];
  return of === undefined ? all : all.map((spec) => ({ ...spec, title: `${spec.title}: ${of}` }));
}

/** The order of choice, and of colours: those shown at first differ most. */
export function wellKnownFirst(names: string[]): string[] {
  return [...kWellKnown.filter((name) => names.includes(name)), ...names.filter((name) => !kWellKnown.includes(name))];
}

async function renderCurves(host: HTMLElement, page: Page): Promise<void> {
  const curves = await page.data.curves();
  const names = curves.map((one) => one.filter);
  const chosen = new Choices(page.state, "fl.filters", "Filters", wellKnownFirst(names), kWellKnown.length);
  const body = el("div", {});
  const draw = (): void => {
    const shown = chosen.values.flatMap((name) => curves.filter((one) => one.filter === name));
    const options = { styles: page.filter_styles, highlight: page.highlight };
    body.replaceChildren(
      colourKey(
        "Filters shown",
        shown.map((one) => one.filter),
        page.filter_styles,
        page.highlight,
        false,
      ),
      chartGrid(specs(shown).map((spec) => chartCard({ ...spec, end_labels: false }, options))),
    );
  };
  host.append(toolbar(chosen.control(draw)), body);
  draw();
}

export const filters: Section = {
  id: "filters",
  title: () => "Filters",
  lead: () => [
      "Kernels as they weigh samples, what they pass of each frequency, and what they make of a vertical edge: " +
      "values above 1 or below 0 ring, and the largest overshoot is marked.",
  ],
  present: (data) =>
    RunData.holds(data.run.filter_curves) ||
    data.table("filters") !== undefined ||
    data.table("filter_ranking") !== undefined,

  async render(host, page) {
    if (RunData.holds(page.data.run.filter_curves)) await renderCurves(host, page);
    for (const [name, caption, columns] of [
      ["filters", "Numbers of the kernels", kKernelColumns],
      ["filter_ranking", "Ranking of filters, over all scenes: errors over the best one's", kRankingColumns],
    ] as const) {
      const table = page.data.table(name);
      if (table === undefined) continue;
      const filters = narrowing(table, ["pattern", "spp", "estimator", "layout"]);
      host.append(sortableTable(table, { name, caption, columns: chosenColumns(table, columns), filters }));
    }
  },

  async figures(page: Page): Promise<Figure[]> {
    if (!RunData.holds(page.data.run.filter_curves)) return [];
    const curves = await page.data.curves();
    const styles = page.filter_styles;
    // Those that the page shows at first, together; then each by itself.
    const names = wellKnownFirst(curves.map((one) => one.filter)).slice(0, kWellKnown.length);
    const few = names.flatMap((name) => curves.filter((one) => one.filter === name));
    const together = few.length > 1 ? specs(few) : [];
    return [...together, ...curves.flatMap((one) => specs([one], one.filter))].map((spec) => ({ spec, styles }));
  },
};
