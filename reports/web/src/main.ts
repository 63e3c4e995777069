// The report page: reads the data that the page holds, chooses the run, and builds the sections that it has data for.
import { button, el } from "./dom";
import { writeFigures } from "./figures";
import { Highlight } from "./highlight";
import { Shell } from "./shell";
import type { Page, Section } from "./page";
import { distinct, RunData } from "./run_data";
import { SCHEMA_MAJOR } from "./schema";
import type { Report } from "./schema";
import { convergence } from "./sections/convergence";
import { discrepancy } from "./sections/discrepancy";
import { filters, wellKnownFirst } from "./sections/filters";
import { images } from "./sections/images";
import { moreTables } from "./sections/more_tables";
import { overview } from "./sections/overview";
import { spectra } from "./sections/spectra";
import { stability } from "./sections/stability";
import { timeError } from "./sections/time_error";
import { SeriesStyles } from "./series_style";
import { PageState } from "./state";
import { Theme } from "./theme";

const kSections: Section[] = [
  overview,
  convergence,
  timeError,
  images,
  spectra,
  filters,
  discrepancy,
  stability,
  moreTables,
];

function readReport(): Report {
  const report = JSON.parse(document.getElementById("moire-report")?.textContent ?? "") as Report;
  if (report.schema !== SCHEMA_MAJOR) {
    throw new Error(`this page reads data of the form ${SCHEMA_MAJOR}, but it holds ${report.schema}`);
  }
  if (report.runs.length === 0) throw new Error("this page holds no run");
  return report;
}

/** A page for each run. A pattern, and a filter, has one look in all of them: readers switch between runs. */
async function pagesOf(report: Report, state: PageState, theme: Theme, root: HTMLElement): Promise<Page[]> {
  const runs = await Promise.all(report.runs.map((run) => RunData.load(run)));
  const styles = new SeriesStyles(runs.flatMap((data) => data.allSeries));
  const filter_styles = new SeriesStyles(wellKnownFirst(distinct(runs.flatMap((data) => data.filters))));
  const highlight = new Highlight(root);
  return runs.map((data) => ({ data, state, theme, styles, filter_styles, highlight }));
}

async function start(): Promise<void> {
  const report = readReport();
  const state = new PageState();
  const theme = new Theme();
  const root = el("main", { id: "main" });
  if (state.get("figures") === "1") {
    await writeFigures(await pagesOf(report, state, theme, root), kSections);
    return;
  }
  const shell = new Shell(report, root, state, theme, kSections);
  document.body.prepend(shell.header, shell.nav, root);
  const pages = await pagesOf(report, state, theme, root);
  const show = (): void => {
    const page = pages.find((one) => one.data.run.id === state.get("run")) ?? pages[0];
    if (page !== undefined) shell.show(page);
  };
  state.onChange("run", show);
  show();
}

/** What went wrong, in the page: a blank one says nothing. */
function fail(error: unknown): void {
  const text = error instanceof Error ? error.message : String(error);
  const again = button("Reload without the link's choices", {}, () => {
    location.hash = "";
    location.reload();
  });
  document.body.prepend(el("p", { class: "failure", role: "alert" }, `The report cannot be shown: ${text}. `, again));
  console.error(error);
}

start().catch(fail);
