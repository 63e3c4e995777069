// Draws a chart's description with Observable Plot: bands, lines, points, slope guides, end labels.
import * as Plot from "@observablehq/plot";
import { commonDomain, makeScale } from "./axis";
import type { Scale } from "./axis";
import type { ChartSpec, Line, Point } from "./chart_spec";
import { shownPoints } from "./chart_spec";
import { spread } from "./end_labels";
import type { SeriesStyle, SeriesStyles } from "./series_style";

export interface Size {
  width: number;
  height: number;
}

/** A drawn point: where it is and what it says. */
export interface Spot {
  element: SVGElement | undefined; // none where only a line is drawn
  key: string;
  x: number; // pixels of the chart
  y: number;
  says: string;
}

export interface DrawnChart {
  svg: SVGSVGElement;
  spots: Spot[];
}

const kInk = "var(--text)";
const kMuted = "var(--muted)";
const kHalo = "var(--surface)";
const kLabelGap = 13; // pixels between end labels
const kDots = "dots-";

interface Frame {
  spec: ChartSpec;
  x: Scale;
  y: Scale;
  width: number; // of the inner area
  height: number;
  left: number;
  top: number;
}

function dash(line: Line, style: SeriesStyle): string | undefined {
  if (line.part === "second") return "5 3";
  if (line.part === "third") return "1.5 2.5";
  return style.dash;
}

function lineMarks(frame: Frame, line: Line, points: Point[], style: SeriesStyle, series: number): Plot.Markish[] {
  const marks: Plot.Markish[] = [];
  const className = `series-${series}`;
  const floor = frame.y.type === "log" ? frame.y.domain[0] : -Infinity;
  const banded = points.filter((point) => Number.isFinite(point.lo) && Number.isFinite(point.hi));
  const lower = (point: Point): number => Math.max(point.lo ?? NaN, floor);
  if (line.line && banded.length > 1) {
    marks.push(
      Plot.areaY(banded, { x: "x", y1: lower, y2: "hi", fill: style.color, fillOpacity: 0.14, className, clip: true }),
    );
  }
  if (!line.line || banded.length === 1) {
    marks.push(Plot.ruleX(banded, { x: "x", y1: lower, y2: "hi", stroke: style.color, strokeOpacity: 0.6, className }));
  }
  if (line.line) {
    const strokeWidth = frame.spec.front ? 1 : line.part ? 1.5 : 1.75;
    const stroke = { stroke: style.color, strokeWidth, strokeDasharray: dash(line, style) };
    // A gap where the axis cannot show a point: a line across it would say what nobody measured.
    const shown = new Set(points);
    const y = (point: Point): number => (shown.has(point) ? point.y : NaN);
    marks.push(Plot.line(line.points, { x: "x", y, ...stroke, className, clip: true }));
  }
  if (line.dots) {
    const many = line.points.length > (frame.spec.square ? 128 : 16);
    const r = frame.spec.square ? (many ? 1.5 : 2.5) : many ? 2 : 3.5;
    const look = {
      fill: style.color,
      stroke: kHalo,
      strokeWidth: 0.75,
      symbol: frame.spec.square ? "circle" : style.symbol,
    };
    marks.push(
      Plot.dot(points, { x: "x", y: "y", r, ...look, className: `${kDots}${series} ${className}` } as Plot.DotOptions),
    );
  }
  return marks;
}

/** A fan of slopes in the lower left, where falling errors leave room: a line falls as N^-1 that is parallel to it. */
function guideMarks(frame: Frame, slopes: number[]): Plot.Markish[] {
  const { x, y } = frame;
  const decades = Math.log(x.domain[1] / x.domain[0]) * 0.3;
  const x1 = x.domain[0] * Math.exp(decades * 0.14);
  const x2 = x1 * Math.exp(decades);
  const steepest = Math.max(...slopes.map(Math.abs));
  // The steepest ends a little above the axis.
  const foot = Math.exp(Math.log(y.domain[1] / y.domain[0]) * 0.05) * y.domain[0];
  const y1 = foot * Math.exp(steepest * decades);
  const names: Record<string, string> = { "-0.5": "slope −1/2", "-0.75": "slope −3/4", "-1": "slope −1" };
  const ends = slopes.map((slope) => y1 * Math.pow(x2 / x1, slope));
  const wanted = ends.map((end) => (1 - y.at(end)) * frame.height);
  const placed = spread(wanted, kLabelGap, 0, frame.height - 7);
  return slopes.flatMap((slope, i) => {
    const end = ends[i] ?? NaN;
    const text = names[String(slope)] ?? `slope ${slope}`;
    const dy = (placed[i] ?? 0) - (wanted[i] ?? 0);
    return [
      Plot.link([0], { x1, y1, x2, y2: end, stroke: kMuted, strokeDasharray: "3 3", strokeWidth: 1 }),
      Plot.text([text], { x: x2, y: end, dx: 4, dy, textAnchor: "start", fill: kMuted, fontSize: 11, stroke: kHalo }),
    ];
  });
}

function endText(line: Line): string {
  return line.end === undefined ? line.key : `${line.key} ${line.end}`;
}

/** What the longest end label needs beside the chart, in pixels, at most: 11 px letters, bold. */
export function endLabelWidth(spec: ChartSpec): number {
  return 24 + 6.7 * Math.max(...spec.lines.map((line) => endText(line).length), 0);
}

function endLabelMarks(frame: Frame, styles: SeriesStyles, series: Map<string, number>): Plot.Markish[] {
  const ends: { key: string; text: string; point: Point }[] = [];
  for (const line of frame.spec.lines) {
    const last = shownPoints(frame.spec, line).at(-1);
    if (last !== undefined && !ends.some((end) => end.key === line.key))
      ends.push({ key: line.key, text: endText(line), point: last });
  }
  const wanted = ends.map((end) => (1 - frame.y.at(end.point.y)) * frame.height);
  const placed = spread(wanted, kLabelGap, 0, frame.height);
  return ends.map((end, i) => {
    const dy = (placed[i] ?? 0) - (wanted[i] ?? 0);
    const dx = (1 - frame.x.at(end.point.x)) * frame.width + 10;
    return Plot.text([end.text], {
      x: end.point.x,
      y: end.point.y,
      dx,
      dy,
      textAnchor: "start",
      fill: styles.of(end.key).label,
      fontSize: 11,
      fontWeight: 600,
      className: `series-${series.get(end.key) ?? 0}`,
    });
  });
}

function ruleMarks(frame: Frame): Plot.Markish[] {
  return (frame.spec.rules ?? []).flatMap((rule) => {
    const stroke = { stroke: kMuted, strokeDasharray: "2 3" };
    const label = { fill: kMuted, fontSize: 11, stroke: kHalo };
    if (rule.axis === "x") {
      const text = Plot.text([rule.label ?? ""], {
        x: rule.at,
        frameAnchor: "top",
        dy: 3,
        dx: 4,
        textAnchor: "start",
        ...label,
      });
      return rule.label ? [Plot.ruleX([rule.at], stroke), text] : [Plot.ruleX([rule.at], stroke)];
    }
    const text = Plot.text([rule.label ?? ""], {
      y: rule.at,
      frameAnchor: "right",
      dy: -7,
      dx: -3,
      textAnchor: "end",
      ...label,
    });
    return rule.label ? [Plot.ruleY([rule.at], stroke), text] : [Plot.ruleY([rule.at], stroke)];
  });
}

function extraMarks(frame: Frame, styles: SeriesStyles, series: Map<string, number>): Plot.Markish[] {
  const marks: Plot.Markish[] = [];
  const front = frame.spec.front ?? [];
  if (front.length > 0) {
    const line = { stroke: kInk, strokeWidth: 2.5, curve: "step-after" } as const;
    marks.push(Plot.line(front, { x: "x", y: "y", ...line }));
    marks.push(Plot.dot(front, { x: "x", y: "y", r: 7, stroke: kInk, strokeWidth: 2, fill: "none" }));
  }
  const rings = frame.spec.rings ?? [];
  const wanted = rings.map((ring) => (1 - frame.y.at(ring.y)) * frame.height - 10);
  const placed = spread(wanted, kLabelGap, 6, frame.height);
  rings.forEach((ring, i) => {
    const className = `series-${series.get(ring.key) ?? 0}`;
    const { color, label } = styles.of(ring.key);
    const dy = (placed[i] ?? 0) - (1 - frame.y.at(ring.y)) * frame.height;
    const right = frame.x.at(ring.x) > 0.6;
    marks.push(
      Plot.dot([ring], { x: "x", y: "y", r: 5, stroke: color, strokeWidth: 2, fill: "none", className }),
      Plot.text([ring.label], {
        ...{ x: ring.x, y: ring.y, dx: right ? -9 : 9, dy, textAnchor: right ? "end" : "start" },
        ...{ fill: label, stroke: kHalo, fontSize: 11, fontWeight: 600, className },
      }),
    );
  });
  return marks;
}

function axisMarks(frame: Frame): Plot.Markish[] {
  if (frame.spec.square) return [Plot.frame({ stroke: kMuted })];
  const { x, y } = frame;
  const grid = { stroke: "var(--grid)", strokeOpacity: 1 };
  return [
    Plot.gridX(x.ticks, grid),
    Plot.gridY(y.ticks, grid),
    Plot.axisX(x.ticks, {
      text: x.label,
      label: x.title,
      labelAnchor: "center",
      labelArrow: "none",
      labelOffset: 36,
      color: kInk,
    }),
    Plot.axisY(y.ticks, {
      text: y.label,
      label: y.title,
      labelAnchor: "center",
      labelArrow: "none",
      labelOffset: 57,
      color: kInk,
    }),
  ];
}

/** The chart at that size, in the page's colours, and its points. Series are groups of the class `series-N`. */
export function drawChart(spec: ChartSpec, styles: SeriesStyles, size: Size): DrawnChart {
  const label_width = spec.end_labels ? endLabelWidth(spec) : 14;
  const margins = spec.square
    ? { left: 6, right: 6, top: 6, bottom: 6 }
    : { left: 68, right: label_width, top: 12, bottom: 44 };
  const width = size.width - margins.left - margins.right;
  const height = size.height - margins.top - margins.bottom;
  const frame: Frame = {
    spec,
    x: makeScale(spec.x, spec.x.domain ?? commonDomain([spec], "x") ?? [0.5, 1], width, "x"),
    y: makeScale(spec.y, spec.y.domain ?? commonDomain([spec], "y") ?? [0.5, 1], height, "y"),
    width,
    height,
    left: margins.left,
    top: margins.top,
  };
  const series = new Map<string, number>();
  for (const line of spec.lines) if (!series.has(line.key)) series.set(line.key, series.size);
  const shown = spec.lines.map((line) => ({ line, points: shownPoints(spec, line) }));
  const marks = [
    ...axisMarks(frame),
    ...ruleMarks(frame),
    ...(spec.guides ? guideMarks(frame, spec.guides) : []),
    ...shown.flatMap(({ line, points }) =>
      lineMarks(frame, line, points, styles.of(line.key), series.get(line.key) ?? 0),
    ),
    ...extraMarks(frame, styles, series),
    ...(spec.end_labels ? endLabelMarks(frame, styles, series) : []),
  ];
  const svg = Plot.plot({
    width: size.width,
    height: size.height,
    marginLeft: margins.left,
    marginRight: margins.right,
    marginTop: margins.top,
    marginBottom: margins.bottom,
    style: "background: none; font-family: system-ui, sans-serif; font-size: 12px; overflow: visible",
    x: { type: frame.x.type, domain: frame.x.domain, axis: null },
    // Squares have y down, as images have.
    y: { type: frame.y.type, domain: frame.y.domain, axis: null, reverse: spec.square ?? false },
    marks,
  }) as unknown as SVGSVGElement;
  // Plot names its groups by kind of mark; to a screen reader the points alone say something.
  for (const group of svg.children) {
    group.removeAttribute("aria-label");
    if (!group.getAttribute("class")?.startsWith(kDots)) group.setAttribute("aria-hidden", "true");
  }
  svg.setAttribute("role", "group");
  svg.setAttribute("aria-label", `${spec.title}: ${frame.y.title} against ${frame.x.title}`);
  return { svg, spots: spots(frame, svg, shown, series) };
}

function spots(
  frame: Frame,
  svg: SVGSVGElement,
  shown: { line: Line; points: Point[] }[],
  series: Map<string, number>,
): Spot[] {
  const groups = new Map<number, Element[]>();
  const out: Spot[] = [];
  for (const [key, index] of series) {
    svg.querySelectorAll(`.series-${index}`).forEach((group) => group.setAttribute("data-series", key));
    groups.set(index, [...svg.querySelectorAll(`.${kDots}${index}`)]);
  }
  for (const { line, points } of shown) {
    const group = line.dots && points.length > 0 ? groups.get(series.get(line.key) ?? 0)?.shift() : undefined;
    const elements = group ? [...group.children] : [];
    points.forEach((point, i) => {
      out.push({
        element: elements[i] as SVGElement | undefined,
        key: line.key,
        x: frame.left + frame.x.at(point.x) * frame.width,
        y: frame.top + (frame.spec.square ? frame.y.at(point.y) : 1 - frame.y.at(point.y)) * frame.height,
        says: point.says,
      });
    });
  }
  return out;
}
