// What a pane shows: a number for each pixel, taken from one picture or from two. All in double.
import { shows, type Show } from "./catalogue";
import type { Picture } from "./pictures";

/**
 * value: coverage, 0 to 1 and a little beyond. error: signed. difference: B - A. power: of a spectrum; decibels: of B's
 * power over A's.
 */
export type Kind = "value" | "error" | "difference" | "power" | "decibels";

export interface Field {
  key: string; // the same for the same numbers
  kind: Kind;
  w: number;
  h: number;
  at(i: number): number; // pixel i = x + w y
}

/** Reconstruction = exact + error, or the exact image itself. */
export function valueAt(picture: Picture, i: number): number {
  return picture.exact === undefined ? NaN : picture.exact[i]! + errorAt(picture, i);
}

/** got - exact; that of an exact image is 0. */
export function errorAt(picture: Picture, i: number): number {
  return picture.error === undefined ? 0 : picture.error[i]!;
}

export function fieldOf(picture: Picture, show: Show): Field {
  const { w, h } = picture;
  const key = `${picture.shot.id} ${show}`;
  if (show === "value") return { key, kind: "value", w, h, at: (i) => valueAt(picture, i) };
  if (show === "error") return { key, kind: "error", w, h, at: (i) => errorAt(picture, i) };
  const power = picture[show];
  return { key, kind: "power", w, h, at: (i) => power?.[i] ?? NaN };
}

/** The exact image under the same filter; none where the page does not hold it. */
export function exactOf(picture: Picture): Field | undefined {
  const exact = picture.exact;
  if (exact === undefined) return undefined;
  return { key: `${picture.shot.id} exact`, kind: "value", w: picture.w, h: picture.h, at: (i) => exact[i]! };
}

/**
 * B - A; of spectra the ratio of powers in decibels. Where A and B have one exact image their errors are subtracted:
 * they are small numbers stored with 11 digits of two, and what was added to both would cost digits. None for different
 * sizes.
 */
export function differenceOf(a: Picture, b: Picture, showA: Show, showB: Show): Field | undefined {
  if (a.w !== b.w || a.h !== b.h) return undefined;
  const { w, h } = a;
  const key = `${b.shot.id} ${showB} - ${a.shot.id} ${showA}`;
  if (isPower(showA) || isPower(showB)) {
    if (!isPower(showA) || !isPower(showB)) return undefined;
    const over = fieldOf(b, showB);
    const under = fieldOf(a, showA);
    const { foot } = powerRange([over, under]);
    const at = (i: number) => 10 * Math.log10(Math.max(over.at(i), foot) / Math.max(under.at(i), foot));
    return { key, kind: "decibels", w, h, at };
  }
  const bothErrors = showA === "error" && showB === "error";
  const at =
    bothErrors || a.shot.exact === b.shot.exact
      ? (i: number) => errorAt(b, i) - errorAt(a, i)
      : (i: number) => valueAt(b, i) - valueAt(a, i);
  return { key, kind: "difference", w, h, at };
}

export function isPower(show: Show): boolean {
  return show !== "value" && show !== "error";
}

/** What "value" would be for this shot: the first thing that can be shown of it, unless `show` can be. */
export function shownOf(picture: { shot: Picture["shot"] }, show: Show | undefined): Show {
  const list = shows(picture.shot);
  return show !== undefined && list.includes(show) ? show : list[0]!;
}

const ranges = new WeakMap<object, number>();

/**
 * The 99.5th percentile (nearest rank) of |at| over pixels where it is not 0: pixels that are exact by definition would
 * hide the others. Where all are 0: 0. `owner` remembers it.
 */
export function signedRange(field: Field, owner: object = field): number {
  const known = ranges.get(owner);
  if (known !== undefined) return known;
  const sizes: number[] = [];
  for (let i = 0; i < field.w * field.h; ++i) {
    const size = Math.abs(field.at(i));
    if (size > 0 && size < Infinity) sizes.push(size);
  }
  const sorted = Float64Array.from(sizes).sort();
  const range = sorted[Math.max(0, Math.ceil(0.995 * sorted.length) - 1)] ?? 0;
  ranges.set(owner, range);
  return range;
}

/** No power scale goes further down than 60 dB from its top. */
const kDecades = 6;

/**
 * From the 0.5th percentile of what is above 0 to the largest power; frequency 0, the mean, does not count.
 * hi / 10^kDecades is the foot for powers that are 0, or below it as an unbiased estimate can be.
 */
export function powerRange(fields: readonly Field[]): { lo: number; hi: number; foot: number } {
  const powers: number[] = [];
  for (const field of fields) {
    const dc = Math.floor(field.h / 2) * field.w + Math.floor(field.w / 2);
    for (let i = 0; i < field.w * field.h; ++i) {
      const power = field.at(i);
      if (i !== dc && power > 0 && power < Infinity) powers.push(power);
    }
  }
  const sorted = Float64Array.from(powers).sort();
  const hi = sorted[sorted.length - 1] ?? 1;
  const foot = hi / 10 ** kDecades;
  const low = sorted[Math.max(0, Math.ceil(0.005 * sorted.length) - 1)] ?? foot;
  return { lo: Math.max(foot, Math.min(low, hi / 10)), hi, foot };
}
