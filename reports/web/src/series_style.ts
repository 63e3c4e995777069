// Colour, marker and dash of each series: the same throughout the page. Colours after M. Okabe and K. Ito, "Color
// Universal Design", 2008, the yellow darkened; lighter tints of them in the dark stand in style.css.
import * as Plot from "@observablehq/plot";

export interface SeriesStyle {
  color: string; // a CSS variable: charts follow the theme without drawing them again
  label: string; // of text: dark enough to read
  symbol: "circle" | "triangle" | "square" | "diamond2" | "star" | "wye" | "cross";
  dash: string | undefined;
}

const kColors = 8;
const kSymbols: SeriesStyle["symbol"][] = ["circle", "triangle", "square", "diamond2", "star", "wye", "cross"];
const kDashes = [undefined, "6 3", "2 2", "8 2 2 2"];

/** 8 colours and 7 markers have no common factor: 56 pairs differ. */
function style(index: number): SeriesStyle {
  return {
    color: `var(--series-${index % kColors})`,
    label: `var(--label-${index % kColors})`,
    symbol: kSymbols[index % kSymbols.length] ?? "circle",
    dash: kDashes[Math.floor(index / kColors) % kDashes.length],
  };
}

export class SeriesStyles {
  readonly #index = new Map<string, number>();

  constructor(keys: Iterable<string>) {
    for (const key of keys) this.of(key);
  }

  of(key: string): SeriesStyle {
    let index = this.#index.get(key);
    if (index === undefined) {
      index = this.#index.size;
      this.#index.set(key, index);
    }
    return style(index);
  }

  /** Looks for a few of the series: their own, but where two have one colour the later takes a free one. */
  among(keys: readonly string[]): SeriesStyles {
    const few = new SeriesStyles([]);
    const taken = new Set<number>();
    for (const key of keys) {
      let index = this.#index.get(key) ?? 0;
      const free = [...Array(kColors).keys()].find((color) => !taken.has(color));
      if (taken.has(index % kColors) && free !== undefined) index = free;
      taken.add(index % kColors);
      few.#index.set(key, index);
    }
    return few;
  }
}

/** A line with its marker or without, for legends and tables: 26 x 12 pixels. */
export function swatch(look: SeriesStyle, marker = true): SVGSVGElement | HTMLElement {
  const svg = Plot.plot({
    width: 26,
    height: 12,
    margin: 0,
    x: { axis: null, domain: [0, 26] },
    y: { axis: null, domain: [0, 12] },
    marks: [
      Plot.link([0], {
        x1: 0,
        x2: 26,
        y1: 6,
        y2: 6,
        stroke: look.color,
        strokeWidth: 1.75,
        strokeDasharray: look.dash,
      }),
      Plot.dot(marker ? [0] : [], { x: 13, y: 6, r: 3.5, symbol: look.symbol, fill: look.color, stroke: "none" }),
    ],
  });
  svg.setAttribute("aria-hidden", "true");
  svg.setAttribute("class", "swatch");
  return svg;
}
