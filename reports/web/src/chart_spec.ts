// What a chart shows, without how it is drawn: screen, SVG and CSV are made from the same description.

export interface Axis {
  label: string; // with the unit; what the scale is, is added where it is not linear
  column: string; // the name in the CSV
  scale: "linear" | "log2" | "log10";
  domain?: [number, number]; // else what the points and bands need
  ticks?: number[];
}

export interface Point {
  x: number;
  y: number;
  lo?: number; // the interval of y
  hi?: number;
  says: string; // the point in words, for the tip and for screen readers
}

export interface Line {
  key: string; // the series: colour, marker, and what is highlighted together
  part?: "main" | "second" | "third"; // drawn through, dashed, dotted: several lines of one series
  name?: string; // of the part, in the CSV
  end?: string; // said beside its name at the line's end: its slope
  points: Point[]; // in order of x where a line is drawn
  dots: boolean;
  line: boolean;
}

/** A straight line across the chart at one place of an axis. */
export interface Rule {
  axis: "x" | "y";
  at: number;
  label?: string;
}

/** A mark that stands out: an overshoot, a peak. */
export interface Ring {
  key: string;
  x: number;
  y: number;
  label: string;
}

export interface ChartSpec {
  name: string; // of the figure's file: [a-z0-9._=-]+
  title: string;
  x: Axis;
  y: Axis;
  lines: Line[];
  guides?: number[]; // slopes of a log-log chart, drawn in its lower left
  rules?: Rule[];
  rings?: Ring[];
  front?: { x: number; y: number }[]; // the Pareto front, in order of x
  square?: boolean; // a unit square: no axes but a frame
  end_labels?: boolean; // the series' names at the lines' right ends
}

/** Points that a logarithmic axis cannot show are left out, here and nowhere else. */
export function shownPoints(spec: ChartSpec, line: Line): Point[] {
  const fits = (value: number, axis: Axis): boolean => Number.isFinite(value) && (axis.scale === "linear" || value > 0);
  return line.points.filter((point) => fits(point.x, spec.x) && fits(point.y, spec.y));
}

/** All points of the chart, as CSV: series, part where there is one, x, y and the interval. */
export function chartCsv(spec: ChartSpec): (string | number)[][] {
  const parts = spec.lines.some((line) => line.name !== undefined);
  const intervals = spec.lines.some((line) => line.points.some((point) => point.lo !== undefined));
  const head = ["series", ...(parts ? ["part"] : []), spec.x.column, spec.y.column];
  if (intervals) head.push(`${spec.y.column}_lo`, `${spec.y.column}_hi`);
  const rows: (string | number)[][] = [head];
  for (const line of spec.lines) {
    for (const point of line.points) {
      const row: (string | number)[] = [line.key, ...(parts ? [line.name ?? ""] : []), point.x, point.y];
      if (intervals) row.push(point.lo ?? "", point.hi ?? "");
      rows.push(row);
    }
  }
  return rows;
}
