// Where the error lies in frequency: radial means of error spectra, what is noise and what is structure.
import type { ChartSpec, Line, Point, Ring } from "../chart_spec";
import { chartCard } from "../chart_card";
import { Choice, Choices, colourKey, options, toolbar } from "../controls";
import { el } from "../dom";
import type { Figure, Page, Section } from "../page";
import type { Row, RunData } from "../run_data";
import { distinct, num } from "../run_data";
import { RunData as Data } from "../run_data";
import type { RadialSpectrum, ReportImage } from "../schema";
import { chosenColumns, narrowing, plainColumns, sortableTable, textColumn } from "../table";
import { breakable, number, slug } from "../text";
import { mountViewer } from "../viewer/viewer";
import { chartGrid } from "./convergence";

const kParts: Record<string, { part: "main" | "second" | "third"; says: string }> = {
  noise: { part: "main", says: "noise" },
  structured: { part: "second", says: "structure" },
  expected: { part: "third", says: "expected noise" },
};
/** What the table shows, with headings; the CSV has all columns. */
const kRankingColumns = [
  ["filter"],
  ["spp"],
  ["rank_low_frequency", "rank"],
  ["relative_low_frequency", "low-frequency noise [95%]"],
  ["rank_rmse", "rank, RMSE"],
  ["relative_rmse", "RMSE [95%]"],
  ["structured_fraction", "structured share [95%]"],
  ["peaks", "significant peaks"],
] as const;
const kWellKnown = ["random", "jittered", "dart-throwing", "zaremba"];

function linesOf(data: RunData, spectrum: RadialSpectrum): Line[] {
  const key = data.series(spectrum);
  const { rows } = data.columns(spectrum.table);
  return Object.entries(kParts).flatMap(([column, { part, says }]): Line[] => {
    const points = rows.map((row): Point => {
      // Structure is a difference: below its standard error it is nothing.
      const y = column === "structured" && num(row, column) < num(row, "structured_error") ? NaN : num(row, column);
      const band = column === "noise" ? { lo: num(row, "noise_lo"), hi: num(row, "noise_hi") } : {};
      const at = `${key}, ${number(num(row, "frequency"))} cycles per pixel`;
      return { x: num(row, "frequency"), y, ...band, says: `${at}: ${says} ${number(y)}` };
    });
    if (!points.some((point) => point.y > 0)) return [];
    return [{ key, part, name: column, line: true, dots: column !== "expected", points }];
  });
}

/** At the radial mean of its frequency; its height, over the median power around it, is written beside it. */
function ringOf(data: RunData, spectrum: RadialSpectrum): Ring[] {
  const { peak } = spectrum;
  if (peak === undefined || !peak.significant) return [];
  const frequency = Math.hypot(peak.fx, peak.fy);
  const { rows } = data.columns(spectrum.table);
  const near = rows.reduce<Row | undefined>(
    (best, row) =>
      best === undefined || Math.abs(num(row, "frequency") - frequency) < Math.abs(num(best, "frequency") - frequency)
        ? row
        : best,
    undefined,
  );
  const level = near === undefined ? NaN : num(near, "total");
  if (!(level > 0)) return [];
  return [{ key: data.series(spectrum), x: frequency, y: level, label: `${peak.height_db.toFixed(1)} dB` }];
}

function powerSpec(data: RunData, spectra: RadialSpectrum[], scene: string, filter: string, spp: string): ChartSpec {
  return {
    name: ["spectrum", slug(scene), slug(filter), slug(spp)].join("_"),
    title: `${scene}, ${filter}, ${spp} spp: power`,
    x: { label: "frequency, cycles per pixel", column: "frequency", scale: "linear" },
    y: { label: "power", column: "power", scale: "log10" },
    lines: spectra.flatMap((spectrum) => linesOf(data, spectrum)),
    rules: [{ axis: "x", at: 0.125, label: "1/8" }],
    rings: spectra.flatMap((spectrum) => ringOf(data, spectrum)),
  };
}

function anisotropySpec(
  data: RunData,
  spectra: RadialSpectrum[],
  scene: string,
  filter: string,
  spp: string,
): ChartSpec {
  const lines = spectra.map((spectrum): Line => {
    const key = data.series(spectrum);
    const points = data.columns(spectrum.table).rows.map((row): Point => {
      const [x, y] = [num(row, "frequency"), num(row, "anisotropy_db")];
      return { x, y, says: `${key}, ${number(x)} cycles per pixel: anisotropy ${number(y)} dB` };
    });
    return { key, line: true, dots: true, points };
  });
  return {
    name: ["anisotropy", slug(scene), slug(filter), slug(spp)].join("_"),
    title: `${scene}, ${filter}, ${spp} spp: anisotropy`,
    x: { label: "frequency, cycles per pixel", column: "frequency", scale: "linear" },
    y: { label: "anisotropy, dB", column: "anisotropy_db", scale: "linear" },
    lines,
  };
}

function matching(spectra: RadialSpectrum[], scene: string, filter: string, spp: string): RadialSpectrum[] {
  return spectra.filter((one) => one.scene === scene && one.filter === filter && String(one.spp) === spp);
}

/** One of each well-known kind of pattern at first: more than a few bands hide one another. */
function patternChoices(page: Page, spectra: RadialSpectrum[]): Choices {
  const held = new Set(spectra.map((one) => page.data.series(one)));
  const keys = page.data.allSeries.filter((key) => held.has(key));
  const first = kWellKnown.flatMap((kind) => keys.filter((key) => key.split(/[:,]/)[0] === kind).slice(0, 1));
  const order = [...first, ...keys.filter((key) => !first.includes(key))];
  return new Choices(page.state, "sp.patterns", "Patterns", order, Math.max(first.length, Math.min(3, order.length)));
}

function chosenSpectra(page: Page, spectra: RadialSpectrum[], patterns: Choices): RadialSpectrum[] {
  return patterns.values.flatMap((key) => spectra.filter((one) => page.data.series(one) === key));
}

function peakTable(data: RunData, spectra: RadialSpectrum[]): HTMLElement | undefined {
  const rows = spectra.flatMap((one): Row[] => {
    if (one.peak === undefined) return [];
    const { fx, fy, height_db, p, significant } = one.peak;
    return [
      {
        pattern: data.series(one),
        fx,
        fy,
        frequency: Math.hypot(fx, fy),
        height_db,
        p,
        significant: significant ? "yes" : "no",
      },
    ];
  });
  if (rows.length === 0) return undefined;
  const table = { columns: Object.keys(rows[0] ?? {}), rows };
  // Chances are small numbers in earnest.
  const columns = plainColumns(table).map(({ number: _, ...column }, i) =>
    table.columns[i] === "p" || _ === undefined ? column : { ...column, number: _ },
  );
  return sortableTable(table, {
    name: "peaks",
    caption: "Highest peak of each spectrum: frequency in cycles per pixel, height over the median power around",
    columns,
  });
}

/** The viewer below shows what the charts show: of their first two patterns that have images. */
function leadViewer(page: Page, scene: string, filter: string, spp: string, patterns: string[]): void {
  const { data, state } = page;
  const fits = (image: ReportImage | undefined): boolean =>
    image !== undefined && image.scene === scene && image.filter === filter && String(image.spp) === spp;
  const own = data.run.images.filter((image) => image.kind === "spectrum" && fits(image));
  const order = [...patterns, ...distinct(own.map((image) => data.series(image)))];
  const wanted = distinct(order.flatMap((key) => own.filter((image) => data.series(image) === key).slice(0, 1)));
  for (const [i, side] of ["spectrum.a", "spectrum.b"].entries()) {
    const now = data.run.images.find((image) => image.id === state.get(side));
    const image = wanted[i] ?? wanted[0];
    if (!fits(now) && image !== undefined) state.set(side, image.id);
  }
}

/** The charts follow the viewer's first image to its scene, filter and samples, where they have them. */
function followViewer(
  page: Page,
  host: HTMLElement,
  choices: [string, Choice, (image: ReportImage) => string][],
): void {
  const { data, state } = page;
  const follow = (id: string | undefined): void => {
    const image = data.run.images.find((one) => one.id === id);
    if (image === undefined) return;
    for (const [key, choice, of] of choices) {
      const value = of(image);
      if (choice.value !== value && choice.choices.some((one) => one.value === value)) state.set(key, value);
    }
  };
  follow(state.get("spectrum.a"));
  const stop = state.onChange("spectrum.a", (id) => {
    if (host.isConnected) follow(id);
    else stop();
  });
}

async function renderRadial(host: HTMLElement, page: Page): Promise<void> {
  const { data, state } = page;
  const spectra = await data.spectra();
  if (spectra.length === 0) return;
  const scene = new Choice(state, "sp.scene", "Scene", options(distinct(spectra.map((s) => s.scene))));
  const filter = new Choice(state, "sp.filter", "Filter", options(distinct(spectra.map((s) => s.filter))));
  const spps = distinct(spectra.map((s) => s.spp)).sort((a, b) => a - b);
  const spp = new Choice(state, "sp.spp", "Samples per pixel", options(spps), String(spps.at(-1) ?? ""));
  const patterns = patternChoices(page, spectra);
  const body = el("div", {});
  const draw = (): void => {
    const all = matching(spectra, scene.value, filter.value, spp.value);
    const chosen = chosenSpectra(page, all, patterns);
    const styles = page.styles.among(patterns.values);
    const card = (spec: ChartSpec): HTMLElement => chartCard(spec, { styles, highlight: page.highlight });
    const cards = [powerSpec(data, chosen, scene.value, filter.value, spp.value)];
    const anisotropy = anisotropySpec(data, chosen, scene.value, filter.value, spp.value);
    if (anisotropy.lines.some((line) => line.points.some((point) => Number.isFinite(point.y)))) cards.push(anisotropy);
    body.replaceChildren(
      colourKey("Patterns shown", patterns.values, styles, page.highlight, false),
      chartGrid(cards.map(card)),
      ...[peakTable(data, all)].filter((table) => table !== undefined),
    );
  };
  const bar = toolbar(scene.control(draw), filter.control(draw), spp.control(draw), patterns.control(draw));
  const lead = (): void => leadViewer(page, scene.value, filter.value, spp.value, patterns.values);
  bar.addEventListener("change", lead); // the reader's own choice: one that a link or the viewer makes does not lead
  host.append(
    bar,
    el(
      "p",
      { class: "note" },
      "Solid with its 95% band: noise, which differs from trial to trial. Dashed: structure, the same in all trials, " +
        "drawn where it is above its standard error. Dotted: the noise that theory expects. Rings: frequencies of " +
        "significant peaks, with their height over the median power around.",
    ),
    body,
  );
  draw();
  if (state.get("spectrum.a") === undefined && state.get("spectrum.b") === undefined) lead();
  followViewer(page, body, [
    ["sp.scene", scene, (image) => image.scene],
    ["sp.filter", filter, (image) => image.filter],
    ["sp.spp", spp, (image) => String(image.spp)],
  ]);
}

export const spectra: Section = {
  id: "spectra",
  title: () => "Spectra",
  lead: () => [
    "Radial means of the power spectrum of the error image. Below 1/8 cycle per pixel the eye sees noise and " +
      "structure best; a peak far above what is around it is a moiré pattern.",
  ],
  present: (data) =>
    Data.holds(data.run.radial_spectra) ||
    data.table("noise_ranking") !== undefined ||
    data.run.images.some((image) => isSpectrum(image.kind)) ||
    data.leftOut("spectra").length > 0,

  async render(host, page) {
    const { data } = page;
    if (Data.holds(data.run.radial_spectra)) await renderRadial(host, page);
    const images = data.run.images.filter((image) => isSpectrum(image.kind));
    const left_out = data.leftOut("spectra");
    if (images.length > 0 || left_out.length > 0) {
      const frame = el("div", {});
      host.append(el("h3", {}, "Spectra in two dimensions"), frame);
      mountViewer(frame, images, { run: data.run, state: page.state, left_out });
    }
    const ranking = data.table("noise_ranking");
    if (ranking !== undefined) {
      const columns = [
        {
          ...textColumn("pattern"),
          sort: (row: Row) => data.series(row),
          cell: (row: Row) => breakable(data.series(row)),
        },
        ...chosenColumns(ranking, kRankingColumns),
      ];
      host.append(
        sortableTable(ranking, {
          name: "noise_ranking",
          caption: "Ranking by noise, over all scenes",
          columns,
          filters: narrowing(ranking, ["filter", "estimator", "spp", "pattern", "layout"]),
        }),
      );
    }
  },

  async figures(page: Page): Promise<Figure[]> {
    const all = Data.holds(page.data.run.radial_spectra) ? await page.data.spectra() : [];
    const patterns = patternChoices(page, all);
    const styles = page.styles.among(patterns.values);
    const keys = distinct(all.map((one) => [one.scene, one.filter, String(one.spp)].join("|")));
    return keys.flatMap((key): Figure[] => {
      const [scene, filter, spp] = key.split("|") as [string, string, string];
      const own = chosenSpectra(page, matching(all, scene, filter, spp), patterns);
      return [
        { spec: powerSpec(page.data, own, scene, filter, spp), styles },
        { spec: anisotropySpec(page.data, own, scene, filter, spp), styles },
      ];
    });
  },
};

function isSpectrum(kind: string): boolean {
  return kind === "spectrum" || kind === "structured" || kind === "noise";
}
