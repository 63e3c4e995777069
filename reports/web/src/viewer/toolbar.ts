// The row above the images: how A and B are laid out, colours, exposure, zoom, the reference.
import { button, el } from "../dom";
import type { Choices, Mode } from "./choices";
import { kMapTitles, type MapName } from "./colours";
import { setAttribute, setOptions, setText } from "./update";

export interface ToolbarActions {
  mode(mode: Mode): void;
  zoom(steps: number): void;
  fit(): void;
  oneToOne(): void;
  reference(): void;
  help(): void;
}

const kModeNames: Record<Mode, string> = {
  side: "Side by side",
  swipe: "Swipe",
  flip: "Flip",
  difference: "B \u2212 A",
  grid: "All patterns",
};

export class Toolbar {
  readonly element: HTMLElement;
  #modes = new Map<Mode, HTMLInputElement>();
  #map = el("select", { "data-testid": "map" });
  #exposure = el("input", { type: "range", min: -8, max: 8, step: 0.5, "data-testid": "exposure" });
  #exposureText = el("output", { class: "v-number", "data-testid": "exposure-value" });
  #zoomText = el("output", { class: "v-number", "data-testid": "zoom" });
  #reference: HTMLButtonElement;
  #choices: Choices;

  /** `prefix` keeps the groups of two viewers apart; `maps` are those that the values have. */
  constructor(choices: Choices, prefix: string, maps: readonly MapName[], hasExact: boolean, actions: ToolbarActions) {
    this.#choices = choices;
    const modes = el("fieldset", { class: "v-modes" }, el("legend", { class: "unseen" }, "Comparison"));
    for (const [mode, name] of Object.entries(kModeNames) as [Mode, string][]) {
      const input = el("input", { type: "radio", name: `${prefix}mode`, value: mode, "data-testid": `mode-${mode}` });
      input.addEventListener("change", () => actions.mode(mode));
      this.#modes.set(mode, input);
      modes.append(el("label", {}, input, el("span", {}, name)));
    }
    setOptions(
      this.#map,
      maps.map((map) => ({ value: map, text: kMapTitles[map] })),
      maps[0]!,
    );
    this.#map.addEventListener("change", () => (choices.mapName = this.#map.value));
    this.#exposure.addEventListener("input", () => (choices.exposure = Number(this.#exposure.value)));
    this.#reference = button(
      "Exact",
      { "data-testid": "reference", title: "Shows the exact image in B's place (key R)" },
      actions.reference,
    );
    this.#reference.hidden = !hasExact;
    this.element = el(
      "div",
      { class: "v-bar" },
      modes,
      this.#reference,
      el("label", {}, "Colours ", this.#map),
      el("label", {}, "Exposure ", this.#exposure, " ", this.#exposureText),
      el(
        "div",
        { class: "v-zoom", role: "group", "aria-label": "Zoom" },
        button("\u2212", { "aria-label": "Zoom out", "data-testid": "zoom-out" }, () => actions.zoom(-1)),
        this.#zoomText,
        button("+", { "aria-label": "Zoom in", "data-testid": "zoom-in" }, () => actions.zoom(1)),
        button("Fit", { "data-testid": "zoom-fit" }, actions.fit),
        button("1:1", { "data-testid": "zoom-1" }, actions.oneToOne),
      ),
      button("Keys", { "data-testid": "help" }, actions.help),
    );
  }

  /** `zoom`: device pixels per image pixel; `mapIsFree`: something is shown that has a choice of maps. */
  update(zoom: number, map: MapName, mapIsFree: boolean): void {
    const choices = this.#choices;
    for (const [mode, input] of this.#modes) input.checked = mode === choices.mode;
    this.#map.value = map;
    this.#map.disabled = !mapIsFree;
    setAttribute(this.#map, "title", mapIsFree ? "" : "Signed numbers keep the diverging map");
    this.#exposure.value = String(choices.exposure);
    const ev = `${choices.exposure > 0 ? "+" : choices.exposure < 0 ? "\u2212" : ""}${Math.abs(choices.exposure)} EV`;
    setText(this.#exposureText, ev);
    setAttribute(this.#exposure, "aria-valuetext", ev);
    setText(this.#zoomText, zoom >= 1 ? `${Number(zoom.toFixed(2))}:1` : `1:${Number((1 / zoom).toFixed(2))}`);
    setAttribute(this.#reference, "aria-pressed", choices.front === "exact");
  }
}
