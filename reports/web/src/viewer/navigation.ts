// Moving about in the images: zoom, position, crosshair and region, as gestures and keys ask for them.
import { anyImage } from "./catalogue";
import type { Choices } from "./choices";
import type { Pane } from "./pane";
import type { Place } from "./pointer";
import { clipped } from "./statistics";
import { fit, fitZoom, held, nextZoom, placeAt, zoomAbout, type Size, type View } from "./view";

export class Navigation {
  #choices: Choices;

  constructor(choices: Choices) {
    this.#choices = choices;
  }

  /** What the pane shows; without a choice all of A's image. */
  view(pane: Pane): View {
    return this.#choices.view ?? fit(this.#image, pane.size);
  }

  canZoom(pane: Pane, steps: number): boolean {
    return this.#next(pane, steps) !== this.view(pane).zoom;
  }

  /** To the next level; what is shown at `place` stays there, until all of the image is visible. */
  zoom(pane: Pane, place: Place, steps: number): void {
    const zoom = this.#next(pane, steps);
    if (zoom > fitZoom(this.#image, pane.size)) this.#zoomAt(pane, place, zoom);
    else this.#choices.view = undefined;
  }

  /** By keys and buttons: about the crosshair where it is in sight, else about the middle. */
  zoomBy(pane: Pane, steps: number): void {
    this.zoom(pane, this.#anchor(pane), steps);
  }

  zoomTo(pane: Pane, zoom: number): void {
    this.#zoomAt(pane, this.#anchor(pane), zoom);
  }

  /** Device pixels: what is shown goes to the right and down with them. */
  pan(pane: Pane, dx: number, dy: number): void {
    const view = this.view(pane);
    const moved = { ...view, x: view.x - dx / view.zoom, y: view.y - dy / view.zoom };
    this.#choices.view = held(moved, this.#image, pane.size);
  }

  /** The image's pixel at that place of the pane, if there is one. */
  pixelAt(pane: Pane, place: Place): { x: number; y: number } | undefined {
    const { x, y } = placeAt(this.view(pane), pane.size, place.x, place.y);
    const { w, h } = this.#image;
    return x >= 0 && y >= 0 && x < w && y < h ? { x: Math.floor(x), y: Math.floor(y) } : undefined;
  }

  /** The region of all pixels touched between two corners; nothing changes where that is none. */
  mark(pane: Pane, from: Place, to: Place): void {
    const one = placeAt(this.view(pane), pane.size, from.x, from.y);
    const two = placeAt(this.view(pane), pane.size, to.x, to.y);
    const x = Math.floor(Math.min(one.x, two.x));
    const y = Math.floor(Math.min(one.y, two.y));
    const w = Math.floor(Math.max(one.x, two.x)) - x + 1;
    const h = Math.floor(Math.max(one.y, two.y)) - y + 1;
    this.#choices.region = clipped({ x, y, w, h }, this.#image) ?? this.#choices.region;
  }

  /** Puts the crosshair there, and what is zoomed in on it into the middle. */
  goTo(x: number, y: number): void {
    this.#choices.at = { x, y };
    const view = this.#choices.view;
    if (view !== undefined) this.#choices.view = { ...view, x: x + 0.5, y: y + 0.5 };
  }

  /** From the middle of the view where there is no crosshair; the view follows where it would leave. */
  moveCrosshair(pane: Pane, dx: number, dy: number): void {
    const view = this.view(pane);
    const { w, h } = this.#image;
    const at = this.#choices.at ?? { x: Math.floor(view.x), y: Math.floor(view.y) };
    const x = Math.min(Math.max(at.x + dx, 0), w - 1);
    const y = Math.min(Math.max(at.y + dy, 0), h - 1);
    this.#choices.at = { x, y };
    if (!this.#inSight(pane, x, y)) this.#choices.view = { ...view, x: x + 0.5, y: y + 0.5 };
  }

  get #image(): Size {
    return anyImage(this.#choices.side("a").shot).pixels;
  }

  #next(pane: Pane, steps: number): number {
    return nextZoom(this.view(pane).zoom, steps, fitZoom(this.#image, pane.size));
  }

  #zoomAt(pane: Pane, place: Place, zoom: number): void {
    this.#choices.view = held(zoomAbout(this.view(pane), pane.size, place.x, place.y, zoom), this.#image, pane.size);
  }

  #placeOf(pane: Pane, x: number, y: number): Place {
    const view = this.view(pane);
    return { x: pane.size.w / 2 + (x + 0.5 - view.x) * view.zoom, y: pane.size.h / 2 + (y + 0.5 - view.y) * view.zoom };
  }

  #inSight(pane: Pane, x: number, y: number): boolean {
    const place = this.#placeOf(pane, x, y);
    return place.x >= 0 && place.y >= 0 && place.x < pane.size.w && place.y < pane.size.h;
  }

  #anchor(pane: Pane): Place {
    const at = this.#choices.at;
    if (at !== undefined && this.#inSight(pane, at.x, at.y)) return this.#placeOf(pane, at.x, at.y);
    return { x: pane.size.w / 2, y: pane.size.h / 2 };
  }
}
