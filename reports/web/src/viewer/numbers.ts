// Numbers as a reader sees them: decimal, with a true minus sign, and no more digits than are known.

const kMinus = "\u2212";

/** Six significant digits: what a single-precision number can bear. */
export function precise(value: number): string {
  return written(value, 6);
}

/** No digit beyond those that the uncertainty leaves; six significant ones where there is none. */
export function known(value: number, uncertainty: number): string {
  if (!(uncertainty > 0) || !Number.isFinite(value)) return precise(value);
  const decimals = Math.floor(-Math.log10(uncertainty));
  if (decimals > 8) return rounded(value);
  const text = Math.abs(value).toFixed(Math.max(0, decimals));
  return (value < 0 ? kMinus : "") + text;
}

/** Four: for tables of statistics and colour bars. */
export function rounded(value: number): string {
  return written(value, 4);
}

/** At most seven characters, for the inside of a pixel; errors carry their sign. */
export function tiny(value: number, signed: boolean): string {
  if (!Number.isFinite(value)) return "NaN";
  const size = Math.abs(value);
  const sign = value < 0 ? kMinus : signed && value > 0 ? "+" : "";
  if (size === 0) return "0";
  if (size >= 1000 || size < 0.0005) return sign + size.toExponential(1);
  return sign + (size >= 10 ? size.toFixed(2) : size.toFixed(4));
}

function written(value: number, digits: number): string {
  if (!Number.isFinite(value))
    return Number.isNaN(value) ? "not a number" : value > 0 ? "infinite" : kMinus + "infinite";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text =
    size >= 1e-4 && size < 1e6
      ? size
          .toPrecision(digits)
          .replace(/(\.\d*?)0+$/, "$1")
          .replace(/\.$/, "")
      : size
          .toExponential(digits - 1)
          .replace(/\.?0+e/, "e")
          .replace("e+", "e")
          .replace("e-", `e${kMinus}`);
  return (value < 0 ? kMinus : "") + text;
}
