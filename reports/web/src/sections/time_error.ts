// What the error costs: RMSE against time, with the Pareto front of those that nothing beats in both.
import type { ChartSpec, Line, Point } from "../chart_spec";
import { chartCard } from "../chart_card";
import { Choices, Hidden, legend, toolbar } from "../controls";
import { el } from "../dom";
import type { Figure, Page, Section } from "../page";
import type { Row, RunData } from "../run_data";
import { distinct, num, str } from "../run_data";
import { interval, number, slug } from "../text";
import { alike, chartGrid } from "./convergence";

/** From least time on, each point of less error than all before it. */
export function paretoFront(points: { x: number; y: number }[]): { x: number; y: number }[] {
  const front: { x: number; y: number }[] = [];
  let least = Infinity;
  for (const point of [...points].sort((a, b) => a.x - b.x || a.y - b.y)) {
    if (!(point.x > 0) || !(point.y > 0) || point.y >= least) continue;
    least = point.y;
    front.push({ x: point.x, y: point.y });
  }
  return front;
}

/** Rows with times: those of `moire bench` where a run has them, medians of repetitions, else the summary's. */
function timed(data: RunData): { rows: Row[]; column: string } {
  const bench = data.table("bench");
  if (bench?.columns.includes("time_render_pixel_ns")) return { rows: bench.rows, column: "time_render_pixel_ns" };
  return { rows: data.errors, column: "time_per_active_pixel_ns" };
}

function hasTimes(data: RunData): boolean {
  const { rows, column } = timed(data);
  return rows.some((row) => num(row, column) > 0 && num(row, "rmse_active") > 0);
}

function spec(data: RunData, scene: string, filter: string, hidden: Set<string>): ChartSpec {
  const { rows, column } = timed(data);
  const own = rows.filter((row) => str(row, "scene") === scene && str(row, "filter") === filter);
  const lines = distinct(own.map((row) => data.series(row)))
    .filter((key) => !hidden.has(key))
    .map((key): Line => {
      const points = own
        .filter((row) => data.series(row) === key && num(row, column) > 0)
        .sort((a, b) => num(a, "spp") - num(b, "spp"))
        .map((row): Point => {
          const micros = num(row, column) / 1000;
          const [lo, hi] = [num(row, "rmse_active_lo"), num(row, "rmse_active_hi")];
          const says = `${key}, ${str(row, "spp")} spp: ${number(micros)} µs, RMSE ${number(num(row, "rmse_active"))}`;
          const range = Number.isFinite(lo) ? { lo, hi } : {};
          return {
            x: micros,
            y: num(row, "rmse_active"),
            ...range,
            says: Number.isFinite(lo) ? `${says} ${interval(lo, hi)}` : says,
          };
        });
      return { key, dots: true, line: true, points: points.map(({ x, y, says }) => ({ x, y, says })) };
    });
  return {
    name: ["time-error", slug(scene), slug(filter)].join("_"),
    title: `${scene}, ${filter}`,
    x: { label: "time per active pixel, µs", column: "time_per_active_pixel_us", scale: "log10" },
    y: { label: "RMSE of active pixels", column: "rmse_active", scale: "log10" },
    lines,
    front: paretoFront(lines.flatMap((line) => line.points)),
  };
}

export const timeError: Section = {
  id: "time-error",
  title: () => "Time against error",
  lead: () => [
      "RMSE against the time to render one active pixel, measured on the machine named above: a point further left is " +
      "faster, a point further down more exact. Ringed points on the stepped line are the Pareto front: nothing else " +
      "is both faster and better.",
  ],
  present: (data) => hasTimes(data),

  render(host, page) {
    const { data, state } = page;
    const { rows } = timed(data);
    const all = {
      scenes: distinct(rows.map((row) => str(row, "scene"))),
      filters: distinct(rows.map((row) => str(row, "filter"))),
    };
    const scenes = new Choices(state, "te.scenes", "Scenes", all.scenes, 3);
    const filters = new Choices(state, "te.filters", "Filters", all.filters, 2);
    const grid = el("div", {});
    const draw = (): void => {
      const hidden = Hidden.of(state);
      const specs = scenes.values.flatMap((scene) => filters.values.map((filter) => spec(data, scene, filter, hidden)));
      grid.replaceChildren(
        chartGrid(alike(specs).map((one) => chartCard(one, { styles: page.styles, highlight: page.highlight }))),
      );
    };
    host.append(
      toolbar(
        all.scenes.length > 1 ? scenes.control(draw) : undefined,
        all.filters.length > 1 ? filters.control(draw) : undefined,
      ),
      legend(data.allSeries, page.styles, state, page.highlight, draw),
      grid,
    );
    draw();
  },

  figures(page: Page): Figure[] {
    const { rows } = timed(page.data);
    return distinct(rows.map((row) => str(row, "scene"))).flatMap((scene) =>
      distinct(rows.map((row) => str(row, "filter"))).map((filter) => ({
        spec: spec(page.data, scene, filter, new Set()),
        styles: page.styles,
      })),
    );
  },
};
