// Numbers as a reader of images sees them: written as on all of the page, with no more digits than are known.
import { fixed, trimmed, written } from "../text";

const kMinus = "\u2212";

/** Six significant digits: what a single-precision number can bear. */
export function precise(value: number): string {
  return said(value) ?? trimmed(written(value, 6));
}

/** No digit beyond those that the uncertainty leaves; six significant ones where there is none. */
export function known(value: number, uncertainty: number): string {
  if (!(uncertainty > 0) || !Number.isFinite(value)) return precise(value);
  const decimals = Math.floor(-Math.log10(uncertainty));
  if (decimals > 8) return rounded(value);
  return fixed(value, Math.max(0, decimals));
}

/** Four: for tables of statistics. */
export function rounded(value: number): string {
  return said(value) ?? written(value, 4);
}

/** The same for numbers that stand alone: colour bars, frequencies. */
export function short(value: number): string {
  return trimmed(rounded(value));
}

/** At most seven characters, for the inside of a pixel; errors carry their sign. */
export function tiny(value: number, signed: boolean): string {
  if (!Number.isFinite(value)) return "NaN";
  const size = Math.abs(value);
  const sign = value < 0 ? kMinus : signed && value > 0 ? "+" : "";
  if (size === 0) return "0";
  if (size >= 1000 || size < 0.0005) return sign + size.toExponential(1).replace("e+", "e").replace("e-", `e${kMinus}`);
  return sign + (size >= 10 ? size.toFixed(2) : size.toFixed(4));
}

/** What is no finite number, in words. */
function said(value: number): string | undefined {
  if (Number.isFinite(value)) return undefined;
  return Number.isNaN(value) ? "not a number" : value > 0 ? "infinite" : `${kMinus}infinite`;
}
