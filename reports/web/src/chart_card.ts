// A chart in the page: its title, its drawing in the width there is, values under the pointer and the focus, its files.
import type { ChartSpec, Line } from "./chart_spec";
import { chartCsv } from "./chart_spec";
import { drawChart, endLabelWidth } from "./chart";
import type { Spot } from "./chart";
import { button, el } from "./dom";
import type { Highlight } from "./highlight";
import { csvText, download, standaloneSvg } from "./save";
import type { SeriesStyles } from "./series_style";
import { breakable } from "./text";
import { hideTip, showTip } from "./tip";

/** The size in which charts leave the page, whatever the window; end labels stand beside it. */
const kFigureSize = { width: 580, height: 460 };
const kSquareSize = { width: 360, height: 360 };

export interface CardOptions {
  styles: SeriesStyles;
  highlight: Highlight;
  aspect?: number; // height over width, 0.72 without it
}

const kTitleHeight = 28; // above the chart, in a file

const kDense = 16; // points of a curve that needs no markers in print
const kReach = 40; // pixels from the pointer to a point that it names

/** The figure as a file: the same drawing with end labels. */
export function figureSvg(spec: ChartSpec, styles: SeriesStyles): string {
  // Markers of a dense curve only thicken it; the second part of a series may be single points.
  const dense = (line: Line): boolean => line.line && line.part !== "second" && line.points.length > kDense;
  const lines = spec.lines.map((line) => (dense(line) ? { ...line, dots: false } : line));
  const figure = { ...spec, lines, end_labels: !spec.square };
  const width = kFigureSize.width + Math.ceil(endLabelWidth(figure));
  const { svg } = drawChart(figure, styles, spec.square ? kSquareSize : { ...kFigureSize, width });
  return standaloneSvg(svg, spec.title, kTitleHeight);
}

/** Draws itself again whenever its width changes, so that text keeps its size. */
export function chartCard(spec: ChartSpec, options: CardOptions): HTMLElement {
  const plot = el("div", { class: "plot" });
  const enlarge = button(
    "Enlarge",
    { class: "quiet", "aria-pressed": "false", "aria-label": `Enlarge ${spec.title}` },
    () => {
      enlarge.setAttribute("aria-pressed", String(card.classList.toggle("enlarged")));
    },
  );
  const tools = el(
    "span",
    { class: "tools" },
    !spec.square && enlarge,
    button("SVG", { class: "quiet", "aria-label": `Save ${spec.title} as SVG`, "data-testid": "save-svg" }, () =>
      download(`${spec.name}.svg`, "image/svg+xml", figureSvg(spec, options.styles)),
    ),
    button("CSV", { class: "quiet", "aria-label": `Save ${spec.title} as CSV`, "data-testid": "save-csv" }, () =>
      download(`${spec.name}.csv`, "text/csv", csvText(chartCsv(spec))),
    ),
  );
  const caption = el("figcaption", {}, el("span", { class: "chart-title" }, breakable(spec.title)), tools);
  const card = el("figure", { class: "chart", "data-testid": "chart", "data-name": spec.name }, caption, plot);
  let width = 0;
  const draw = (): void => {
    const wanted = Math.floor(plot.clientWidth);
    if (wanted < 40 || wanted === width) return;
    width = wanted;
    const wide = width >= 560 && endLabelWidth(spec) <= 0.4 * width;
    const height = spec.square ? width : Math.round(Math.min(460, Math.max(240, width * (options.aspect ?? 0.72))));
    const labelled = { ...spec, end_labels: spec.end_labels ?? (wide && !spec.square) };
    const { svg, spots } = drawChart(labelled, options.styles, { width, height });
    plot.replaceChildren(svg);
    makeReadable(svg, spots, options.highlight);
    options.highlight.apply(card.parentNode ?? card);
  };
  new ResizeObserver(draw).observe(plot);
  return card;
}

/** The pointer names the nearest point; one tab stop a chart, then the arrow keys walk along and between series. */
function makeReadable(svg: SVGSVGElement, spots: Spot[], highlight: Highlight): void {
  svg.addEventListener("pointermove", (event) => {
    const box = svg.getBoundingClientRect();
    const scale = box.width / svg.width.baseVal.value;
    const x = (event.clientX - box.left) / scale;
    const y = (event.clientY - box.top) / scale;
    let nearest: Spot | undefined;
    let least = kReach;
    for (const spot of spots) {
      const distance = Math.hypot(spot.x - x, spot.y - y);
      if (distance < least) [nearest, least] = [spot, distance];
    }
    highlight.set(nearest?.key);
    if (nearest === undefined) hideTip();
    else showTip(nearest.says, box.left + nearest.x * scale, box.top + nearest.y * scale);
  });
  svg.addEventListener("pointerleave", () => {
    highlight.set(undefined);
    hideTip();
  });
  const stops = spots.filter((spot): spot is Spot & { element: SVGElement } => spot.element !== undefined);
  stops.forEach((spot, i) => {
    spot.element.setAttribute("tabindex", i === 0 ? "0" : "-1");
    spot.element.setAttribute("role", "img");
    spot.element.setAttribute("aria-label", spot.says);
    spot.element.addEventListener("focus", () => {
      const box = svg.getBoundingClientRect();
      highlight.set(spot.key);
      showTip(spot.says, box.left + spot.x, box.top + spot.y);
    });
    spot.element.addEventListener("blur", () => {
      highlight.set(undefined);
      hideTip();
    });
    spot.element.addEventListener("keydown", (event) => {
      const next = neighbour(stops, i, event.key);
      if (next === undefined) return;
      event.preventDefault();
      spot.element.setAttribute("tabindex", "-1");
      next.element.setAttribute("tabindex", "0");
      next.element.focus();
    });
  });
}

/** Left and right stay on the series, up and down go to the nearest point of the next series. */
function neighbour<S extends Spot>(stops: S[], from: number, key: string): S | undefined {
  const here = stops[from];
  if (here === undefined) return undefined;
  const own = stops.filter((stop) => stop.key === here.key);
  const at = own.indexOf(here);
  if (key === "ArrowRight") return own[at + 1];
  if (key === "ArrowLeft") return own[at - 1];
  if (key === "Home") return own[0];
  if (key === "End") return own.at(-1);
  if (key !== "ArrowUp" && key !== "ArrowDown") return undefined;
  const keys = [...new Set(stops.map((stop) => stop.key))];
  const next = keys[keys.indexOf(here.key) + (key === "ArrowDown" ? 1 : -1)];
  const others = stops.filter((stop) => stop.key === next);
  return others.reduce<S | undefined>(
    (best, stop) => (best === undefined || Math.abs(stop.x - here.x) < Math.abs(best.x - here.x) ? stop : best),
    undefined,
  );
}
