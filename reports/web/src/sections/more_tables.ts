// Tables that no other section shows: estimators, correlations, times of a benchmark, and what later programs write.
import type { Section } from "../page";
import type { RunData, Table } from "../run_data";
import type { TableColumn } from "../table";
import { chosenColumns, narrowing, plainColumns, sortableTable, timeColumn } from "../table";

const kElsewhere = new Set([
  "summary",
  "ranking",
  "filters",
  "filter_ranking",
  "noise_ranking",
  "slopes",
  "stress",
  "growth",
]);
const kCaptions: Record<string, string> = {
  estimators: "Estimators at equal samples",
  correlations: "Which discrepancy foretells the error: correlations over patterns",
  bench: "Times and efficiencies",
  exponents: "How render time grows with samples",
  scaling: "Speed-up by threads",
};
const kNames = ["scene", "filter", "estimator", "pattern", "layout", "spp", "measure"];

/** What a benchmark is asked for; its CSV has the spreads of the times, too. */
function benchColumns(table: Table): TableColumn[] {
  const time = (name: string, title: string): TableColumn[] =>
    table.columns.includes(name) ? [timeColumn(table, name, title)] : [];
  return [
    ...chosenColumns(table, [["scene"], ["pattern"], ["layout"], ["filter"], ["spp"], ["rmse_active", "RMSE [95%]"]]),
    ...time("time_render_pixel_ns", "render, per active pixel"),
    ...time("time_generation_pixel_ns", "of it patterns"),
    ...time("time_evaluation_pixel_ns", "of it scene"),
    ...time("time_reconstruction_pixel_ns", "of it filter"),
    ...time("time_setup_ns", "setup, once"),
    ...chosenColumns(table, [
      ["time_efficiency", "efficiency, 1/(MSE s)"],
      ["time_front", "on the front"],
    ]),
  ];
}

function tablesOf(data: RunData): string[] {
  return data.tableNames.filter((name) => !kElsewhere.has(name));
}

export const moreTables: Section = {
  id: "more-tables",
  title: () => "More tables",
  lead: () => [],
  present: (data) => tablesOf(data).length > 0,

  render(host, page) {
    for (const name of tablesOf(page.data)) {
      const table = page.data.table(name);
      if (table === undefined) continue;
      const caption = kCaptions[name] ?? name;
      const columns = name === "bench" ? benchColumns(table) : plainColumns(table);
      host.append(sortableTable(table, { name, caption, columns, filters: narrowing(table, kNames) }));
    }
  },
};
