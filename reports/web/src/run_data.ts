// One run's tables as rows, unpacked when first asked for, and what its rows are about: scenes, filters, series.
import { unpack } from "./decode";
import type { Cell, Columns, FilterCurves, LeftOut, PointSet, RadialSpectrum, Run } from "./schema";

export type Row = Record<string, Cell>;

/** The cell as a number; NaN where it is missing or not a number. */
export function num(row: Row, column: string): number {
  const cell = row[column];
  return typeof cell === "number" ? cell : NaN;
}

/** The cell as text; "" where it is missing. */
export function str(row: Row, column: string): string {
  const cell = row[column];
  return cell === null || cell === undefined ? "" : String(cell);
}

export interface Table {
  columns: string[];
  rows: Row[];
}

function toTable(data: Columns): Table {
  const columns = Object.keys(data.columns);
  const rows: Row[] = Array.from({ length: data.length }, () => ({}));
  for (const name of columns) {
    const cells = data.columns[name];
    if (cells === undefined) continue;
    for (let i = 0; i < rows.length; ++i) {
      const row = rows[i];
      if (row !== undefined) row[name] = (Array.isArray(cells) ? cells[i] : cells.all) ?? null;
    }
  }
  return { columns, rows };
}

/** Values in the order of their first appearance. */
export function distinct<T>(values: Iterable<T>): T[] {
  return [...new Set(values)];
}

export class RunData {
  readonly #tables = new Map<string, Table>();
  #curves: Promise<FilterCurves[]> | undefined;
  #spectra: Promise<RadialSpectrum[]> | undefined;
  #points: Promise<PointSet[]> | undefined;
  #left_out: LeftOut[] = [];
  #several_estimators = false;

  private constructor(readonly run: Run) {}

  /** Unpacks every table but the raw rows of images. */
  static async load(run: Run): Promise<RunData> {
    const data = new RunData(run);
    const names = Object.keys(run.tables).filter((name) => name !== "image_rows");
    const tables = await Promise.all(names.map((name) => unpack<Columns>(run.tables[name] as Columns)));
    names.forEach((name, i) => {
      const table = tables[i];
      if (table !== undefined && table.length > 0) data.#tables.set(name, toTable(table));
    });
    data.#left_out = await unpack(run.left_out);
    data.#several_estimators =
      distinct((data.table("summary")?.rows ?? []).map((row) => str(row, "estimator"))).length > 1;
    return data;
  }

  get tableNames(): string[] {
    return [...this.#tables.keys()];
  }

  table(name: string): Table | undefined {
    return this.#tables.get(name);
  }

  /** Rows of errors: a summary by scene. A study of discrepancies alone has none. */
  get errors(): Row[] {
    const summary = this.table("summary");
    return summary?.columns.includes("rmse_active") ? summary.rows : [];
  }

  /** Rows of discrepancies: a summary by measure. */
  get discrepancies(): Row[] {
    const summary = this.table("summary");
    return summary?.columns.includes("measure") ? summary.rows : [];
  }

  get scenes(): string[] {
    return distinct(this.errors.map((row) => str(row, "scene")));
  }

  get filters(): string[] {
    return distinct(this.errors.map((row) => str(row, "filter")));
  }

  get spps(): number[] {
    return distinct(this.errors.map((row) => num(row, "spp"))).sort((a, b) => a - b);
  }

  /** What one line of a chart is: a pattern, with its layout where that is not by pixel, and the estimator where the
   * study has several. */
  series(row: { pattern?: Cell; layout?: Cell; estimator?: Cell }): string {
    let name = String(row.pattern ?? "");
    if (typeof row.layout === "string" && row.layout !== "" && row.layout !== "pixel") name += `, ${row.layout} layout`;
    if (this.#several_estimators && typeof row.estimator === "string") name += `, ${row.estimator}`;
    return name;
  }

  /** Every series of the run, in the study's order. */
  get allSeries(): string[] {
    const rows = this.table("summary")?.rows ?? this.table("bench")?.rows ?? [];
    return distinct(rows.map((row) => this.series(row)));
  }

  /** Images that the page has no room for: spectra, or all others. */
  leftOut(of: "spectra" | "images"): LeftOut[] {
    return this.#left_out.filter(({ file }) => /\.(spectrum|structured|noise)\.exr$/.test(file) === (of === "spectra"));
  }

  curves(): Promise<FilterCurves[]> {
    return (this.#curves ??= unpack<FilterCurves[]>(this.run.filter_curves));
  }

  spectra(): Promise<RadialSpectrum[]> {
    return (this.#spectra ??= unpack<RadialSpectrum[]>(this.run.radial_spectra));
  }

  points(): Promise<PointSet[]> {
    return (this.#points ??= unpack<PointSet[]>(this.run.points));
  }

  /** Whether an array or its packed form holds anything. */
  static holds(list: unknown[] | { gz: string } | undefined): boolean {
    return list !== undefined && (!Array.isArray(list) || list.length > 0);
  }

  columns(data: Columns): Table {
    return toTable(data);
  }
}
