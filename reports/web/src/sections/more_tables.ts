// Tables that no other section shows: estimators, correlations, times of a benchmark, and what later programs write.
import type { Section } from "../page";
import type { RunData } from "../run_data";
import { narrowing, plainColumns, sortableTable } from "../table";

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

function tablesOf(data: RunData): string[] {
  return data.tableNames.filter((name) => !kElsewhere.has(name));
}

export const moreTables: Section = {
  id: "more-tables",
  title: () => "More tables",
  lead: () => "",
  present: (data) => tablesOf(data).length > 0,

  render(host, page) {
    for (const name of tablesOf(page.data)) {
      const table = page.data.table(name);
      if (table === undefined) continue;
      const caption = kCaptions[name] ?? name;
      host.append(
        sortableTable(table, { name, caption, columns: plainColumns(table), filters: narrowing(table, kNames) }),
      );
    }
  },
};
