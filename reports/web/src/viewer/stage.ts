// The panes of the present mode, their size, and the handle of a swipe.
import { button, el } from "../dom";
import type { Choices, Mode } from "./choices";
import { Pane } from "./pane";
import { listenTo, type Gestures } from "./pointer";
import { setAttribute } from "./update";
import { fitZoom, type Size } from "./view";

/** CSS pixels of the window for what stands about an image: choosers, the row of tools, colour bar and read-out. */
const kAbout = 388;
const kLeastHeight = 160;

export class Stage {
  readonly element: HTMLElement;
  panes: Pane[] = [];
  #choices: Choices;
  #gestures: Gestures;
  #handle: HTMLElement;
  #built = "";
  #pick: (index: number) => void;

  /** `pick`: what a thumbnail's button does. */
  constructor(choices: Choices, label: string, gestures: Gestures, pick: (index: number) => void) {
    this.#choices = choices;
    this.#gestures = gestures;
    this.#pick = pick;
    this.#handle = this.#makeHandle();
    this.element = el("div", {
      class: "v-stage",
      tabindex: 0,
      role: "application",
      "aria-label": label,
      "aria-roledescription": "image viewer",
      "data-testid": "stage",
    });
  }

  /** Makes as many panes as the mode has; `names` are those of the grid's images. */
  build(mode: Mode, names: readonly string[]): void {
    const key = mode === "grid" ? `grid ${names.join("\n")}` : mode;
    if (key === this.#built) return;
    this.#built = key;
    const ids =
      mode === "side" ? ["canvas-a", "canvas-b"] : mode === "grid" ? names.map((name) => `thumb-${name}`) : ["canvas"];
    this.panes = ids.map((id, i) => {
      const caption =
        mode === "grid"
          ? button("", { class: "v-pick", "data-testid": `pick-${names[i]}` }, () => this.#pick(i))
          : undefined;
      const pane = new Pane(id, caption);
      listenTo(pane, this.#gestures);
      return pane;
    });
    if (mode === "swipe") this.panes[0]!.frame.append(this.#handle);
    setAttribute(this.element, "data-mode", mode);
    this.element.replaceChildren(...this.panes.map((pane) => pane.figure));
  }

  /** As wide as there is room, as high as an image of this size then is at the largest whole zoom. */
  layout(image: Size): void {
    const dense = devicePixelRatio;
    const grid = this.#choices.mode === "grid";
    for (const pane of this.panes) {
      const width = pane.frame.clientWidth;
      const most = grid ? width : Math.max(innerHeight - kAbout, 2 * kLeastHeight);
      const zoom = fitZoom(image, { w: width * dense, h: most * dense });
      pane.resize(Math.min(Math.max(Math.round((zoom * image.h) / dense), kLeastHeight), most));
    }
    const wipe = this.#choices.wipe;
    this.#handle.style.left = `${100 * wipe}%`;
    setAttribute(this.#handle, "aria-valuenow", Math.round(100 * wipe));
    setAttribute(this.#handle, "aria-valuetext", `A in the left ${Math.round(100 * wipe)} per cent, B in the rest`);
  }

  /** Marks the thumbnail that is B. */
  press(index: number): void {
    this.panes.forEach((pane, i) => setAttribute(pane.caption, "aria-pressed", i === index));
  }

  #makeHandle(): HTMLElement {
    const choices = this.#choices;
    const handle = el("div", {
      class: "v-handle",
      role: "slider",
      tabindex: 0,
      "aria-label": "Line between A and B",
      "aria-orientation": "horizontal",
      "aria-valuemin": 0,
      "aria-valuemax": 100,
      "data-testid": "wipe",
    });
    handle.addEventListener("pointerdown", (event) => {
      handle.setPointerCapture(event.pointerId);
      handle.focus({ preventScroll: true });
      event.preventDefault();
    });
    handle.addEventListener("pointermove", (event) => {
      if (!handle.hasPointerCapture(event.pointerId)) return;
      const box = this.panes[0]!.canvas.getBoundingClientRect();
      choices.wipe = (event.clientX - box.left) / box.width;
    });
    handle.addEventListener("keydown", (event) => {
      const steps: Record<string, number> = {
        ArrowLeft: -0.01,
        ArrowDown: -0.01,
        ArrowRight: 0.01,
        ArrowUp: 0.01,
        PageDown: -0.1,
        PageUp: 0.1,
        Home: -1,
        End: 1,
      };
      const step = steps[event.key];
      if (step === undefined) return;
      event.preventDefault();
      choices.wipe += step;
    });
    return handle;
  }
}
