// Colour maps. The diverging one is the program's own (K. Moreland, "Diverging color maps for scientific
// visualization", ISVC 2009; straight lines in CIELAB), so that page and PNG previews agree.

export type Rgb = readonly [number, number, number];
export type MapName = "grey" | "linear" | "heat" | "diverging";

export const kMapTitles: Record<MapName, string> = {
  grey: "grey, sRGB",
  linear: "grey, linear",
  heat: "heat",
  diverging: "blue to red",
};

/** A value that is not a number. */
export const kNanColour: Rgb = [255, 0, 255];

/** Entries of a table: odd, so that the middle of the diverging map has one of its own. */
export const kEntries = 4097;

// Lightness rises along the map: it reads the same without colour, on paper and with any deficiency of colour vision.
const kHeat: Rgb[] = [
  [0, 0, 0],
  [58, 12, 94],
  [150, 32, 98],
  [222, 84, 52],
  [248, 168, 46],
  [252, 252, 222],
];
const kDiverging: Rgb[] = [
  [59, 76, 192],
  [221, 221, 221],
  [180, 4, 38],
];

const tables = new Map<MapName, Uint8Array>();

/** The map from its lower to its upper end: kEntries times red, green, blue. */
export function tableOf(map: MapName): Uint8Array {
  let table = tables.get(map);
  if (table === undefined) {
    table = new Uint8Array(3 * kEntries);
    for (let i = 0; i < kEntries; ++i) table.set(colourAt(map, i / (kEntries - 1)), 3 * i);
    tables.set(map, table);
  }
  return table;
}

/** Relative luminance, 0 to 1, of a colour: WCAG 2.2. */
export function luminance(rgb: Rgb): number {
  return 0.2126 * linearOf(rgb[0]) + 0.7152 * linearOf(rgb[1]) + 0.0722 * linearOf(rgb[2]);
}

function colourAt(map: MapName, t: number): Rgb {
  if (map === "grey") return [code(t), code(t), code(t)];
  if (map === "linear") return [Math.round(255 * t), Math.round(255 * t), Math.round(255 * t)];
  const stops = map === "heat" ? kHeat : kDiverging;
  const at = t * (stops.length - 1);
  const below = Math.min(Math.floor(at), stops.length - 2);
  const part = at - below;
  // Stops are themselves: 8-bit codes may not drift through CIELAB.
  if (part === 0) return stops[below]!;
  if (part === 1) return stops[below + 1]!;
  const from = toLab(stops[below]!);
  const to = toLab(stops[below + 1]!);
  return fromLab([0, 1, 2].map((k) => from[k]! + part * (to[k]! - from[k]!)));
}

/** IEC 61966-2-1: linear to code, and back. */
function code(linear: number): number {
  const v = Math.min(Math.max(linear, 0), 1);
  return Math.floor(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055) + 0.5);
}

function linearOf(code: number): number {
  const v = code / 255;
  return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
}

// CIE 1976 L*a*b* relative to D65, the white of sRGB.
const kToXyz = [
  [0.4124, 0.3576, 0.1805],
  [0.2126, 0.7152, 0.0722],
  [0.0193, 0.1192, 0.9505],
];
const kFromXyz = [
  [3.2406, -1.5372, -0.4986],
  [-0.9689, 1.8758, 0.0415],
  [0.0557, -0.204, 1.057],
];
const kWhite = [0.9505, 1, 1.089];
const kBend = 216 / 24389;
const kSlope = 24389 / 27;

function times(matrix: number[][], v: number[]): number[] {
  return matrix.map((row) => row[0]! * v[0]! + row[1]! * v[1]! + row[2]! * v[2]!);
}

function toLab(rgb: Rgb): number[] {
  const f = times(kToXyz, rgb.map(linearOf)).map((v, k) => {
    const t = v / kWhite[k]!;
    return t > kBend ? Math.cbrt(t) : (kSlope * t + 16) / 116;
  });
  return [116 * f[1]! - 16, 500 * (f[0]! - f[1]!), 200 * (f[1]! - f[2]!)];
}

function fromLab(lab: number[]): Rgb {
  const fy = (lab[0]! + 16) / 116;
  const xyz = [fy + lab[1]! / 500, fy, fy - lab[2]! / 200].map(
    (f, k) => kWhite[k]! * (f ** 3 > kBend ? f ** 3 : (116 * f - 16) / kSlope),
  );
  const rgb = times(kFromXyz, xyz);
  return [code(rgb[0]!), code(rgb[1]!), code(rgb[2]!)];
}
