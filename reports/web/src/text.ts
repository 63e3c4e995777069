// How the page writes numbers and names.

const kMinus = "\u2212";

/** So many significant digits, with a true minus sign; below 1e-4 and from 1e6 on with an exponent. Finite numbers. */
export function written(x: number, digits: number): string {
  if (x === 0) return "0";
  const size = Math.abs(x);
  let text = size.toPrecision(digits);
  if (size < 1e-4 || size >= 1e6) text = size.toExponential(digits - 1).replace("e+", "e");
  else if (size >= 10 ** digits) text = size.toFixed(0);
  return (x < 0 ? kMinus : "") + text.replace("e-", `e${kMinus}`);
}

/** Without zeros that end the fraction: where no other number stands below. */
export function trimmed(text: string): string {
  return text.replace(/(\.\d*?)0+(?=e|$)/, "$1").replace(/\.(?=e|$)/, "");
}

/** Four significant digits; nothing for what is no number. */
export function number(x: number): string {
  return Number.isFinite(x) ? written(x, 4) : "";
}

/** So many decimals, with a true minus sign. */
export function fixed(x: number, decimals: number): string {
  return x.toFixed(decimals).replace("-", kMinus);
}

/** What values of order 1 differ by through rounding alone. */
const kRounding = 1e-12;

/**
 * How a column writes its numbers: where they are of like size, with as many decimals each, so that points stand below
 * each other; else with four digits. Of a column whose numbers are not all tiny, what is rounding of numbers of order 1
 * is 0, unless `tiny` ones count.
 */
export function columnFormat(values: readonly number[], tiny = false): (x: number) => string {
  const sizes = values.filter(Number.isFinite).map(Math.abs);
  const most = sizes.reduce((a, b) => Math.max(a, b), 0);
  const nothing = !tiny && most > 1e6 * kRounding ? kRounding : 0;
  const least = sizes.filter((size) => size > nothing).reduce((a, b) => Math.min(a, b), most);
  const alike = least >= 1e-3 && most < 1e4 && most < 30 * least;
  const decimals = alike ? Math.max(0, 3 - Math.floor(Math.log10(least))) : 0;
  return (x) => {
    if (!Number.isFinite(x)) return "";
    if (Math.abs(x) <= nothing) return "0";
    return alike ? fixed(x, decimals) : number(x);
  };
}

/** "1 sample per pixel", "1, 4, 16 samples per pixel". */
export function samplesPerPixel(spps: readonly number[]): string {
  return `${spps.join(", ")} ${spps.length === 1 && spps[0] === 1 ? "sample" : "samples"} per pixel`;
}

/** A name that lines may break behind its signs, and nowhere in its words. */
export function breakable(name: string): DocumentFragment {
  const parts = name.split(/(?<=[:=,/])(?! )/);
  const out = document.createDocumentFragment();
  parts.forEach((part, i) => out.append(...(i === 0 ? [] : [document.createElement("wbr")]), part));
  return out;
}

/** An interval beside its value: the same digits. */
export function interval(lo: number, hi: number, write: (x: number) => string = number): string {
  return `[${write(lo)}, ${write(hi)}]`;
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
