// How the page writes numbers and names.

/** Four significant digits; below 1e-3 and from 1e6 on with an exponent. */
export function number(x: number): string {
  if (!Number.isFinite(x)) return "";
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size < 1e-3 || size >= 1e6) return x.toExponential(3).replace("e+", "e");
  if (size >= 1e4) return x.toFixed(0);
  return x.toPrecision(4);
}

/** An interval beside its value: the same digits. */
export function interval(lo: number, hi: number): string {
  return `[${number(lo)}, ${number(hi)}]`;
}

/** A power of ten for an axis: 1, 10, 0.1, and 10 with a raised exponent beyond. */
export function powerOfTen(exponent: number): string {
  if (exponent >= -2 && exponent <= 3) return String(Number(`1e${exponent}`));
  const raised = "⁰¹²³⁴⁵⁶⁷⁸⁹";
  const digits = [...String(Math.abs(exponent))].map((digit) => raised[Number(digit)] ?? "").join("");
  return `10${exponent < 0 ? "⁻" : ""}${digits}`;
}

/** A count with its noun: "1 scene", "3 scenes". */
export function count(n: number, noun: string, plural = `${noun}s`): string {
  return `${n.toLocaleString("en")} ${n === 1 ? noun : plural}`;
}

/** A name of [a-z0-9.=-] only, for a part of a file's name; parts are joined with "_". */
export function slug(name: string): string {
  return (
    name
      .toLowerCase()
      .replace(/[^a-z0-9.=-]+/g, "-")
      .replace(/^-+|-+$/g, "") || "x"
  );
}

const kWords: Record<string, string> = {
  rmse: "RMSE",
  rms: "RMS",
  csf: "CSF",
  ci: "CI",
  db: "dB",
  us: "µs",
  lo: "from",
  hi: "to",
};

/** A column's name as a heading: "rmse_active" -> "RMSE active", "n_trials" -> "trials". */
export function heading(column: string): string {
  const words = column.replace(/^n_(?=trials$|scenes$)/, "").split("_");
  return words.map((word) => kWords[word] ?? word).join(" ");
}
