// Domains, ticks and tick labels of the charts' axes.
import type { Axis, ChartSpec } from "./chart_spec";
import { shownPoints } from "./chart_spec";
import { number, powerOfTen } from "./text";

export interface Scale {
  type: "linear" | "log";
  domain: [number, number];
  ticks: number[];
  label: (tick: number) => string;
  title: string;
  /** From 0 at the start of the domain to 1 at its end. */
  at: (value: number) => number;
}

function extent(values: number[]): [number, number] {
  let lo = Infinity;
  let hi = -Infinity;
  for (const value of values) {
    if (value < lo) lo = value;
    if (value > hi) hi = value;
  }
  return lo <= hi ? [lo, hi] : [NaN, NaN];
}

function padded(axis: Axis, lo: number, hi: number): [number, number] {
  if (!Number.isFinite(lo)) return axis.scale === "linear" ? [0, 1] : [0.1, 1];
  if (axis.scale === "linear") {
    const pad = lo === hi ? Math.abs(lo) * 0.1 || 0.5 : (hi - lo) * 0.04;
    return [lo - pad, hi + pad];
  }
  const pad = lo === hi ? 2 : Math.pow(hi / lo, 0.04);
  return [lo / pad, hi * pad];
}

/** The domain that all these charts need, to draw them alike. Bands count where they are above 0. */
export function commonDomain(specs: ChartSpec[], which: "x" | "y"): [number, number] | undefined {
  const values: number[] = [];
  for (const spec of specs) {
    const log = spec[which].scale !== "linear";
    for (const line of spec.lines) {
      for (const point of shownPoints(spec, line)) {
        values.push(point[which]);
        if (which === "x") continue;
        for (const end of [point.lo, point.hi]) {
          if (end === undefined || !Number.isFinite(end)) continue;
          // A lower end far below its point would flatten every chart: the band goes on past the frame.
          if (log && end < point.y / 10) continue;
          values.push(end);
        }
      }
    }
  }
  const first = specs[0];
  if (first === undefined || values.length === 0) return undefined;
  return padded(first[which], ...extent(values));
}

function linearTicks(lo: number, hi: number, most: number): number[] {
  const step0 = Math.pow(10, Math.floor(Math.log10((hi - lo) / most)));
  const step =
    [1, 2, 5, 10].map((factor) => factor * step0).find((candidate) => (hi - lo) / candidate <= most) ?? step0;
  const ticks: number[] = [];
  for (let i = Math.ceil(lo / step); i * step <= hi * (1 + 1e-12); ++i) ticks.push(Number((i * step).toPrecision(12)));
  return ticks;
}

function log2Ticks(lo: number, hi: number, most: number): number[] {
  const first = Math.ceil(Math.log2(lo) - 1e-9);
  const last = Math.floor(Math.log2(hi) + 1e-9);
  const step = Math.max(1, Math.ceil((last - first + 1) / most));
  const ticks: number[] = [];
  for (let i = first; i <= last; i += step) ticks.push(2 ** i);
  return ticks;
}

/** Powers of ten; with fewer than two in sight 1, 2, 5 of each decade; with none of those a few round numbers. */
function log10Ticks(lo: number, hi: number, most: number): number[] {
  const first = Math.ceil(Math.log10(lo) - 1e-9);
  const last = Math.floor(Math.log10(hi) + 1e-9);
  if (last - first >= 2) {
    const step = Math.max(1, Math.ceil((last - first + 1) / most));
    const ticks: number[] = [];
    for (let i = Math.ceil(first / step) * step; i <= last; i += step) ticks.push(Number(`1e${i}`));
    return ticks;
  }
  const ticks: number[] = [];
  for (let i = first - 1; i <= last; ++i) {
    for (const digit of [1, 2, 5]) {
      const tick = Number(`${digit}e${i}`);
      if (tick >= lo && tick <= hi) ticks.push(tick);
    }
  }
  return ticks.length >= 2 ? ticks : linearTicks(lo, hi, most);
}

/** Powers of ten among themselves with raised exponents; where other ticks stand between them, all as decimals. */
function logLabel(ticks: number[]): (tick: number) => string {
  const whole = (tick: number): boolean => Math.abs(Math.log10(tick) - Math.round(Math.log10(tick))) < 1e-9;
  if (ticks.every(whole)) return (tick) => powerOfTen(Math.round(Math.log10(tick)));
  return (tick) => (tick >= 1e-3 && tick < 1e5 ? String(tick) : tick.toExponential().replace("e+", "e"));
}

/** The axis as drawn in `pixels` pixels. */
export function makeScale(axis: Axis, domain: [number, number], pixels: number, which: "x" | "y"): Scale {
  const [lo, hi] = domain;
  const log = axis.scale !== "linear";
  const spacing = which === "y" ? 34 : axis.scale === "log2" ? 38 : 52;
  const most = Math.max(2, Math.floor(pixels / spacing));
  const make = axis.scale === "linear" ? linearTicks : axis.scale === "log2" ? log2Ticks : log10Ticks;
  const ticks = axis.ticks ?? make(lo, hi, most);
  const label = axis.scale === "log10" ? logLabel(ticks) : axis.scale === "log2" ? String : linearLabel;
  const at = log
    ? (value: number): number => Math.log(value / lo) / Math.log(hi / lo)
    : (value: number): number => (value - lo) / (hi - lo);
  return { type: log ? "log" : "linear", domain, ticks, label, at, title: axis.label + scaleName(axis) };
}

function linearLabel(tick: number): string {
  if (Math.abs(tick) >= 1e4 || (tick !== 0 && Math.abs(tick) < 1e-3)) return number(tick);
  return String(tick).replace("-", "−");
}

function scaleName(axis: Axis): string {
  if (axis.scale === "linear") return "";
  return axis.scale === "log2" ? " (log2 scale)" : " (log scale)";
}
