// The bar of colours below the images, with its numbers; one for each scale in use.
import { el } from "../dom";
import { kEntries, kMapTitles, tableOf } from "./colours";
import { short } from "./numbers";
import { ticksOf, type Scale } from "./scale";

export interface Use {
  scale: Scale;
  of: string; // whose scale it is: "A", "B", "A and B"
}

export class ColourBars {
  readonly element = el("div", { class: "v-bars", "data-testid": "colour-bars" });
  #shown = "";

  update(uses: readonly Use[]): void {
    const key = uses.map((use) => `${use.of} ${use.scale.key}`).join("\n");
    if (key === this.#shown) return;
    this.#shown = key;
    this.element.replaceChildren(...uses.map(barOf));
  }
}

function barOf({ scale, of }: Use): HTMLElement {
  const canvas = el("canvas", { width: 512, height: 1, "aria-hidden": "true" });
  const image = new ImageData(512, 1);
  const table = tableOf(scale.map);
  for (let i = 0; i < 512; ++i) {
    const at = 3 * Math.round((i / 511) * (kEntries - 1));
    image.data.set([table[at]!, table[at + 1]!, table[at + 2]!, 255], 4 * i);
  }
  canvas.getContext("2d")!.putImageData(image, 0, 0);
  const ticks = ticksOf(scale).map(({ position, value }) => {
    const tick = el("span", { "data-value": String(value) }, short(value));
    tick.style.left = `${100 * position}%`;
    return tick;
  });
  const axis = scale.log ? `${scale.title} (log scale)` : scale.title;
  return el(
    "figure",
    {
      class: "v-colour-bar",
      "data-testid": "colour-bar",
      "data-map": scale.map,
      "data-lo": String(scale.lo),
      "data-hi": String(scale.hi),
    },
    el("figcaption", {}, `${of}: ${axis}; ${kMapTitles[scale.map]}`),
    canvas,
    el("div", { class: "v-ticks" }, ...ticks),
  );
}
