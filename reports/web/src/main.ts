// The report page: reads the data that the page holds, chooses the run, and builds the sections that it has data for.
import { button, el } from "./dom";
import { writeFigures } from "./figures";
import { Highlight } from "./highlight";
import { Shell } from "./shell";
import type { Page, Section } from "./page";
import { RunData } from "./run_data";
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

async function pageOf(run: Report["runs"][number], state: PageState, theme: Theme, root: HTMLElement): Promise<Page> {
  const data = await RunData.load(run);
  return {
    data,
    state,
    theme,
    styles: new SeriesStyles(data.allSeries),
    filter_styles: new SeriesStyles(wellKnownFirst(data.filters)),
    highlight: new Highlight(root),
  };
}

async function start(): Promise<void> {
  const report = readReport();
  const state = new PageState();
  const theme = new Theme();
  const root = el("main", { id: "main" });
  if (state.get("figures") === "1") {
    const pages = await Promise.all(report.runs.map((run) => pageOf(run, state, theme, root)));
    await writeFigures(pages, kSections);
    return;
  }
  const shell = new Shell(report, root, state, theme, kSections);
  document.body.prepend(shell.header, shell.nav, root);
  const show = async (): Promise<void> => {
    const run = report.runs.find((one) => one.id === state.get("run")) ?? report.runs[0];
    if (run !== undefined) shell.show(await pageOf(run, state, theme, root));
  };
  state.onChange("run", () => void show().catch(fail));
  await show();
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
