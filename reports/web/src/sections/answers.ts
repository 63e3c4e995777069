// What came out of a run, in sentences: filters, discrepancies, times, and how well hard cases are computed.
import type { Row, RunData } from "../run_data";
import { distinct, num, str } from "../run_data";
import { number, samplesPerPixel } from "../text";

/** What comes of runs whose question is another than which pattern has the smallest error. */
export function answers(data: RunData): string[] {
  return [...stabilityAnswer(data), ...benchAnswers(data), ...filterAnswer(data), ...discrepancyAnswers(data)];
}

/** The number in the middle, the lower of two. */
function middle(numbers: number[]): number | undefined {
  const sorted = distinct(numbers).sort((a, b) => a - b);
  return sorted[Math.floor((sorted.length - 1) / 2)];
}

/** The row with the least finite number there; `sign` -1: the largest. */
function extreme(rows: Row[], column: string, sign = 1): Row | undefined {
  const known = rows.filter((row) => Number.isFinite(num(row, column)));
  return known.sort((a, b) => sign * (num(a, column) - num(b, column)))[0];
}

function stabilityAnswer(data: RunData): string[] {
  const rows = data.table("stress")?.rows ?? [];
  if (rows.length === 0) return [];
  const failed = rows.filter((row) => str(row, "pass") !== "true").map((row) => str(row, "family"));
  const closest = extreme(rows, "error_over_bound", -1);
  const margin =
    closest === undefined ? "" : `${str(closest, "family")} at ${number(num(closest, "error_over_bound"))} of it`;
  if (failed.length > 0) {
    const fail = failed.length === 1 ? "fails" : "fail";
    const verdict = `${failed.length} of ${rows.length} families of hard cases ${fail}`;
    return [`${verdict}: ${failed.join(", ")}.${margin === "" ? "" : ` Farthest over its bound: ${margin}.`}`];
  }
  const verdict = rows.length === 1 ? "The one family of hard cases passes" : `All ${rows.length} families pass`;
  return [margin === "" ? `${verdict}.` : `${verdict}; closest to its bound: ${margin}.`];
}

/** For each scene, at its first filter and the middle number of samples. */
function benchAnswers(data: RunData): string[] {
  const all = data.table("bench")?.rows ?? [];
  const spp = middle(all.map((row) => num(row, "spp")).filter(Number.isFinite));
  return distinct(all.map((row) => str(row, "scene"))).flatMap((scene) => {
    const here = all.filter((row) => str(row, "scene") === scene && num(row, "spp") === spp);
    const filter = str(here[0] ?? {}, "filter");
    const rows = here.filter((row) => str(row, "filter") === filter);
    const fastest = extreme(rows, "time_render_pixel_ns");
    const efficient = extreme(rows, "time_efficiency", -1);
    // Among one there is no fastest.
    if (rows.length < 2 || spp === undefined || fastest === undefined || efficient === undefined) return [];
    const time = `${number(num(fastest, "time_render_pixel_ns") / 1000)} µs per active pixel`;
    const both = data.series(fastest) === data.series(efficient);
    const rest = both ? "and the most efficient, too" : `most efficient is ${data.series(efficient)}`;
    return [`${scene}, ${filter}, ${samplesPerPixel([spp])}: fastest is ${data.series(fastest)}, ${time}; ${rest}.`];
  });
}

function filterAnswer(data: RunData): string[] {
  const all = data.table("filter_ranking")?.rows ?? [];
  const spp = middle(all.map((row) => num(row, "spp")));
  if (spp === undefined) return [];
  return distinct(all.map((row) => data.series(row))).flatMap((pattern) => {
    const rows = all.filter((row) => num(row, "spp") === spp && data.series(row) === pattern);
    const first = (rank: string): string => str(rows.find((row) => num(row, rank) === 1) ?? {}, "filter");
    if (rows.length < 2 || first("rank_total") === "" || first("rank_sampling") === "") return [];
    return [
      `Of ${rows.length} filters, with ${pattern} at ${samplesPerPixel([spp])} ${first("rank_total")} comes nearest ` +
        `to exact coverage, and ${first("rank_sampling")} suffers least from sampling.`,
    ];
  });
}

function discrepancyAnswers(data: RunData): string[] {
  const rows = data.discrepancies;
  const out = distinct(rows.map((row) => `${str(row, "measure")}|${str(row, "dims")}`)).flatMap((key) => {
    const own = rows.filter(
      (row) => `${str(row, "measure")}|${str(row, "dims")}` === key && Number.isFinite(num(row, "mean")),
    );
    const n = Math.max(...own.map((row) => num(row, "n")));
    const [best, ...rest] = own.filter((row) => num(row, "n") === n).sort((a, b) => num(a, "mean") - num(b, "mean"));
    const worst = rest.at(-1);
    if (best === undefined || worst === undefined) return [];
    const named = `${str(best, "measure")} in ${str(best, "dims")} dimensions, N = ${n}`;
    const times = number(num(worst, "mean") / num(best, "mean"));
    return [
      `${named}: ${data.series(best)} has the smallest, ${number(num(best, "mean"))}; ` +
        `${data.series(worst)} the largest, ${times} times that.`,
    ];
  });
  const printed = rows.filter((row) => Number.isFinite(num(row, "paper_z")) && str(row, "paper_doubt") === "");
  if (printed.length > 0) {
    const near = printed.filter((row) => Math.abs(num(row, "paper_z")) <= 2).length;
    out.push(
      `Of ${printed.length} values of the paper that vary between trials and leave no doubt about how they were ` +
        `found, ${near} lie within 2 standard errors of ours.`,
    );
  }
  return out;
}
