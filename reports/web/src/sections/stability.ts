// How exact the exact values are: the worst cases found, and how errors grow as a case is made harder.
import type { ChartSpec, Line, Point } from "../chart_spec";
import { chartCard } from "../chart_card";
import { colourKey } from "../controls";
import { chartGrid } from "./convergence";
import { el } from "../dom";
import type { Figure, Page, Section } from "../page";
import type { Row, RunData } from "../run_data";
import { distinct, num, str } from "../run_data";
import { SeriesStyles } from "../series_style";
import type { TableColumn } from "../table";
import { countColumn, narrowing, numberColumn, plainColumns, sortableTable, textColumn } from "../table";
import { number, slug } from "../text";

const kErrors: Record<string, string> = {
  error: "error",
  bound: "stated bound",
  naive_error: "error of the plain formula",
};
const kStyles = new SeriesStyles(Object.values(kErrors));

/** The middle of a bin of severities, on a log scale. */
function severity(row: Row): number {
  const [lo, hi] = [num(row, "severity_lo"), num(row, "severity_hi")];
  return lo > 0 ? Math.sqrt(lo * hi) : hi;
}

/** What makes this family's cases hard, in the words of its row. */
function severityName(data: RunData, family: string): string {
  const row = (data.table("stress")?.rows ?? []).find((one) => str(one, "family") === family);
  return row === undefined || str(row, "severity") === "" ? "severity" : str(row, "severity");
}

function growthSpec(data: RunData, family: string): ChartSpec {
  const rows = (data.table("growth")?.rows ?? [])
    .filter((row) => str(row, "family") === family)
    .sort((a, b) => severity(a) - severity(b));
  const lines = Object.entries(kErrors).map(([column, key]): Line => {
    const points = rows.map((row): Point => {
      const [x, y] = [severity(row), num(row, column)];
      return { x, y, says: `${family}, severity ${number(x)}: ${key} ${number(y)}` };
    });
    return { key, dots: true, line: true, points };
  });
  return {
    name: ["stress", slug(family)].join("_"),
    title: family,
    x: { label: severityName(data, family), column: "severity", scale: "log10" },
    y: { label: "absolute error", column: "error", scale: "log10" },
    lines: lines.filter((line) => line.points.some((point) => point.y > 0)),
  };
}

function families(data: RunData): string[] {
  return distinct((data.table("growth")?.rows ?? []).map((row) => str(row, "family")));
}

/** What the table shows; the CSV has all columns. */
function columnsOf(): TableColumn[] {
  const verdict: TableColumn = {
    title: "verdict",
    numeric: false,
    sort: (row) => str(row, "pass"),
    cell: (row) => (str(row, "pass") === "true" ? "pass" : el("strong", { class: "failed" }, "FAIL")),
  };
  return [
    textColumn("family"),
    countColumn("cases"),
    numberColumn("largest_error", "worst error"),
    numberColumn("largest_relative", "relative"),
    numberColumn("largest_ulps", "ulps"),
    numberColumn("error_over_bound", "of its bound"),
    numberColumn("bound", "bound there"),
    numberColumn("naive_error", "plain formula"),
    verdict,
  ];
}

/** What a family is, what it claims, and the case that came closest to its bound. */
function familyNotes(row: Row): HTMLElement {
  const command = `moire stress --family ${str(row, "family")} --case ${str(row, "case")} --seed ${str(row, "seed")}`;
  return el(
    "details",
    {},
    el("summary", {}, el("strong", {}, str(row, "family")), `: ${str(row, "title")}`),
    el("p", {}, `Value: ${str(row, "quantity")}. Bound: ${str(row, "claim")}.`),
    el("p", {}, "Closest to its bound: ", el("code", {}, command), ":"),
    el("p", {}, el("code", {}, str(row, "words"))),
  );
}

export const stability: Section = {
  id: "stability",
  title: () => "Stability",
  lead: () => [
      "Hard cases of everything that is computed, each against a computation in higher precision. " +
      "An error must stay within its stated bound; the plain formula in double arithmetic shows what care is worth.",
  ],
  present: (data) => data.table("stress") !== undefined || data.table("growth") !== undefined,

  render(host, page) {
    const { data } = page;
    const stress = data.table("stress");
    if (stress !== undefined) {
      host.append(
        sortableTable(stress, {
          name: "stress",
          caption: "Worst cases of each family",
          columns: columnsOf(),
          tiny: true,
        }),
        ...stress.rows.map(familyNotes),
      );
    }
    const growth = data.table("growth");
    if (growth === undefined) return;
    const charts = families(data).map((family) =>
      chartCard(growthSpec(data, family), { styles: kStyles, highlight: page.highlight }),
    );
    host.append(
      el("h3", {}, "How errors grow with severity"),
      colourKey("What the lines are", Object.values(kErrors), kStyles, page.highlight, true),
      chartGrid(charts),
      sortableTable(growth, {
        name: "growth",
        caption: "Errors by severity",
        columns: plainColumns(growth),
        filters: narrowing(growth, ["family"]),
        tiny: true,
      }),
    );
  },

  figures: (page: Page): Figure[] =>
    families(page.data).map((family) => ({ spec: growthSpec(page.data, family), styles: kStyles })),
};
