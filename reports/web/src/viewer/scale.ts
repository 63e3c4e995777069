// From numbers to colours: the range of a colour bar, its map, and a picture made with both.
import { kEntries, kNanColour, tableOf, type MapName, type Rgb } from "./colours";
import { powerRange, signedRange, type Field } from "./field";

export interface Scale {
  key: string; // the same for the same colours
  title: string; // of the colour bar
  map: MapName;
  lo: number;
  hi: number;
  log: boolean;
}

/**
 * The scale that all these fields of one kind share. Exposure, in steps of a factor of two, makes small numbers bright:
 * it divides the end of a coverage scale, the range of signed errors, and moves a log scale of power down.
 * `known` holds ranges of errors that the program measured over active pixels.
 */
export function scaleOf(
  fields: readonly Field[],
  map: MapName,
  exposure: number,
  known: readonly number[] = [],
): Scale {
  const kind = fields[0]?.kind ?? "value";
  const gain = 2 ** exposure;
  if (kind === "value") return finish("coverage", map, 0, 1 / gain, false);
  if (kind === "power") {
    const { lo, hi } = powerRange(fields);
    return finish("power per frequency", map, lo / gain, hi / gain, true);
  }
  const measured = known.filter((range) => range > 0);
  const size = measured.length > 0 ? Math.max(...measured) : Math.max(0, ...fields.map((field) => signedRange(field)));
  const range = (size > 0 ? size : 1) / gain;
  const titles = { error: "error, got \u2212 exact", difference: "difference", decibels: "ratio of powers, dB" };
  return finish(titles[kind], "diverging", -range, range, false);
}

function finish(title: string, map: MapName, lo: number, hi: number, log: boolean): Scale {
  return { key: `${map} ${lo} ${hi} ${log}`, title, map, lo, hi, log };
}

/** Where the value lies on the bar: 0 at its lower end, 1 at its upper. NaN for NaN. */
export function positionOn(scale: Scale, value: number): number {
  if (!scale.log) return (value - scale.lo) / (scale.hi - scale.lo);
  return value <= 0 ? 0 : Math.log(value / scale.lo) / Math.log(scale.hi / scale.lo);
}

export function colourOn(scale: Scale, value: number): Rgb {
  const position = positionOn(scale, value);
  if (Number.isNaN(position)) return kNanColour;
  const at = 3 * Math.round(Math.min(Math.max(position, 0), 1) * (kEntries - 1));
  const table = tableOf(scale.map);
  return [table[at]!, table[at + 1]!, table[at + 2]!];
}

/** The field in the scale's colours, a pixel for each pixel. */
export function rasterOf(field: Field, scale: Scale): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = field.w;
  canvas.height = field.h;
  const image = new ImageData(field.w, field.h);
  const table = tableOf(scale.map);
  const out = image.data;
  const [red, green, blue] = kNanColour;
  for (let i = 0, o = 0; i < field.w * field.h; ++i, o += 4) {
    const position = positionOn(scale, field.at(i));
    if (Number.isNaN(position)) {
      out[o] = red;
      out[o + 1] = green;
      out[o + 2] = blue;
    } else {
      const at = 3 * Math.round(Math.min(Math.max(position, 0), 1) * (kEntries - 1));
      out[o] = table[at]!;
      out[o + 1] = table[at + 1]!;
      out[o + 2] = table[at + 2]!;
    }
    out[o + 3] = 255;
  }
  canvas.getContext("2d")!.putImageData(image, 0, 0);
  return canvas;
}

/** What numbers in the middle of a bar keep from those at its ends, in parts of the bar. */
const kApart = 0.17;

/** Numbers to write beside the bar, each with its place on it: of a log scale powers of ten, and both ends. */
export function ticksOf(scale: Scale): { position: number; value: number }[] {
  const { lo, hi } = scale;
  let values = [0, 1, 2, 3, 4].map((i) => lo + ((hi - lo) * i) / 4);
  if (scale.log) {
    values = [];
    for (let e = Math.ceil(Math.log10(lo)); e <= Math.log10(hi); ++e) values.push(10 ** e);
    values = [
      lo,
      ...values.filter((value) => Math.min(positionOn(scale, value), 1 - positionOn(scale, value)) > kApart),
      hi,
    ];
  }
  return values.map((value) => ({ position: positionOn(scale, value), value }));
}
