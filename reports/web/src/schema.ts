// The data of a report page: `moire.report/1`. reports/page*.cpp writes it, everything here reads it. A reader refuses
// another major version. Tables go by columns, and long ones are packed; images and curves are packed always.

/** A cell: what results.jsonl has there. NaN and infinities are null. */
export type Cell = number | string | boolean | null;

/** base64 of a gzip stream of UTF-8 JSON. */
export interface Packed {
  gz: string;
}

/** A table by columns: every column has `length` cells; a column of one value throughout is that value alone. */
export interface Columns {
  length: number;
  columns: Record<string, Cell[] | { all: Cell }>;
}

/** How pixels are stored: base64 of gzip (or nothing, where that is smaller) over values, their bytes in planes or not. */
export interface Pixels {
  w: number;
  h: number;
  type: "f32" | "f16"; // little-endian, row by row from the top
  shuffle: boolean; // byte planes: all low bytes first
  gzip: boolean;
  scale: number; // a power of two: value = stored * scale
  data: string; // base64
}

/**
 * "exact": the reference, f32. "error": got - exact, f16. "spectrum" | "structured" | "noise": power per frequency,
 * f16, frequency 0 in the middle at (w / 2, h / 2).
 */
export type ImageKind = "exact" | "error" | "spectrum" | "structured" | "noise";

export interface ReportImage {
  id: string; // unique in the page and stable across renderings: RUN/FILE without folder and ending
  kind: ImageKind;
  scene: string;
  filter: string;
  pattern?: string; // with layout and estimator, as tables write them; absent for "exact"
  layout?: string;
  estimator?: string;
  spp?: number;
  trial?: number;
  of?: string; // an error's exact image: id
  row?: number; // an error's row in `image_rows`
  file: string; // the EXR, relative to the page
  range?: number; // of a signed error: the 99.5 percentile of its absolute value over active pixels
  pixels: Pixels;
}

/** What the budget left out: the EXR holds it. */
export interface LeftOut {
  file: string; // relative to the page
  label: string;
}

/** One filter, drawn. x in pixels, f in cycles per pixel; all arrays of one pair have one length. */
export interface FilterCurves {
  filter: string;
  radial: boolean;
  radius: number;
  kernel: { x: number[]; k: number[] }; // k(x); of a radial filter k(r) at r = |x|
  response: { f: number[]; gain: number[] }; // Fourier transform, 1 at 0, signed; of a radial filter along any axis
  edge: { x: number[]; value: number[] }; // the filtered vertical edge at distance x from it: 0 to 1, ringing about it
}

/** Radial means of one error spectrum: columns of a .spectrum.csv (frequency in cycles per pixel, noise_lo, ...). */
export interface RadialSpectrum {
  scene: string;
  pattern: string;
  layout: string;
  spp: number;
  filter: string;
  estimator: string;
  table: Columns;
  peak?: { fx: number; fy: number; height_db: number; p: number; significant: boolean };
}

/** One set of a pattern in the unit square, y down. */
export interface PointSet {
  pattern: string;
  n: number;
  x: number[];
  y: number[];
  t?: number[]; // of three-dimensional patterns
}

export interface Run {
  id: string; // "quick", "quick-2" for another of that name
  folder: string; // relative to the page, "" when it is the page's own
  header: {
    schema: string;
    tool: { version: string; commit: string; build_type: string; compiler: string; flags: string };
    host: { cpu: string; cores: number; os: string };
    study: { name: string; sha256: string; text: string };
  };
  /** By name of the file without ending, where the run has it: summary, filters, filter_ranking, noise_ranking,
   * correlations, estimators, slopes, bench, exponents, scaling, stress, growth; `ranking` (written by the program for this page:
   * scene, filter, estimator, pattern, layout, spp, relative_rmse, relative_rmse_lo, relative_rmse_hi, rank, relative_at_equal_time, rank_at_equal_time);
   * `image_rows`: the raw rows of embedded images. `summary` has `time_render_ns` (median over trials) and
   * `time_per_active_pixel_ns`, too. */
  tables: Record<string, Columns | Packed>;
  /** What the run or its part of the page lacks (rows not run yet, files that are gone), a line of plain text each, to
   * be shown before anything else; absent when nothing is lacking. */
  notices?: string[];
  images: ReportImage[];
  left_out: LeftOut[] | Packed;
  filter_curves: FilterCurves[] | Packed;
  radial_spectra: RadialSpectrum[] | Packed;
  points: PointSet[] | Packed;
}

export interface Report {
  schema: "moire.report/1";
  title: string;
  runs: Run[];
}

/** The page holds one `<script type="application/json" id="moire-report">` with a Report. */
export const SCHEMA_MAJOR = "moire.report/1";
