// Errors of a region in numbers, as the program defines them for whole images: sums in double, percentiles by nearest
// rank.
import type { Field } from "./field";

/** Whole pixels: x from `x` to x + w - 1, y likewise. */
export interface Region {
  x: number;
  y: number;
  w: number;
  h: number;
}

/** Of the values that are numbers; `bias` is their mean, the others are of their sizes. NaN where there are none. */
export interface Statistics {
  n: number;
  nans: number;
  bias: number;
  mae: number;
  rmse: number;
  max: number;
  maxX: number;
  maxY: number;
  p50: number;
  p95: number;
  p99: number;
}

/** Over the region, or the whole field. The first of several largest values, row by row, gives maxX and maxY. */
export function statisticsOf(field: Field, region?: Region): Statistics {
  const { x, y, w, h } = region ?? { x: 0, y: 0, w: field.w, h: field.h };
  const sizes = new Float64Array(w * h);
  const s: Statistics = {
    n: 0,
    nans: 0,
    bias: NaN,
    mae: NaN,
    rmse: NaN,
    max: NaN,
    maxX: NaN,
    maxY: NaN,
    p50: NaN,
    p95: NaN,
    p99: NaN,
  };
  let sum = 0;
  let sumAbs = 0;
  let sumSquares = 0;
  for (let row = y; row < y + h; ++row) {
    for (let i = x; i < x + w; ++i) {
      const value = field.at(row * field.w + i);
      if (!Number.isFinite(value)) {
        ++s.nans;
        continue;
      }
      const size = Math.abs(value);
      sizes[s.n++] = size;
      sum += value;
      sumAbs += size;
      sumSquares += value * value;
      if (!(size <= s.max)) [s.max, s.maxX, s.maxY] = [size, i, row];
    }
  }
  if (s.n === 0) return s;
  s.bias = sum / s.n;
  s.mae = sumAbs / s.n;
  s.rmse = Math.sqrt(sumSquares / s.n);
  const sorted = sizes.subarray(0, s.n).sort();
  const percentile = (percent: number) => sorted[Math.ceil((percent * s.n) / 100) - 1]!;
  s.p50 = percentile(50);
  s.p95 = percentile(95);
  s.p99 = percentile(99);
  return s;
}

/** The part of the region inside an image; none if that is nothing. */
export function clipped(region: Region, size: { w: number; h: number }): Region | undefined {
  const x = Math.max(0, region.x);
  const y = Math.max(0, region.y);
  const w = Math.min(size.w, region.x + region.w) - x;
  const h = Math.min(size.h, region.y + region.h) - y;
  return w > 0 && h > 0 ? { x, y, w, h } : undefined;
}
