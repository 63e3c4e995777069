// What every section is given, and what a section is.
import type { ChartSpec } from "./chart_spec";
import type { Child } from "./dom";
import type { Highlight } from "./highlight";
import type { RunData } from "./run_data";
import type { SeriesStyles } from "./series_style";
import type { PageState } from "./state";
import type { Theme } from "./theme";

export interface Page {
  data: RunData;
  state: PageState;
  theme: Theme;
  styles: SeriesStyles; // of patterns; both are the same for all runs of the page
  filter_styles: SeriesStyles;
  highlight: Highlight;
}

/** A chart of a paper, with the colours that it is drawn in. */
export interface Figure {
  spec: ChartSpec;
  styles: SeriesStyles;
}

export interface Section {
  id: string;
  title: (data: RunData) => string;
  lead: (data: RunData) => Child[]; // a few sentences, or none: what is to be seen
  present: (data: RunData) => boolean;
  render: (host: HTMLElement, page: Page) => Promise<void> | void;
  figures?: (page: Page) => Promise<Figure[]> | Figure[];
}
