// One canvas of the viewer: draws what it is given, nearest neighbour, with the marks that lie above it.
import { el } from "../dom";
import { luminance } from "./colours";
import type { Field } from "./field";
import { tiny } from "./numbers";
import { colourOn, type Scale } from "./scale";
import { breakable } from "../text";
import type { Region } from "./statistics";
import { setAttribute, setText } from "./update";
import { fit, origin, type Size, type View } from "./view";

/** A field in its colours, a pixel for each pixel. */
export interface Layer {
  field: Field;
  scale: Scale;
  raster: HTMLCanvasElement;
}

/** A mark around the pixel whose middle is (x + 0.5, y + 0.5). */
export interface Ring {
  x: number;
  y: number;
}

export interface Content {
  caption: string;
  left?: Layer; // what lies left of the line of a swipe
  main?: Layer; // all of the pane, or what lies right of that line
  wipe: number; // where that line is, 0 to 1
  message: string; // in place of an image: why there is none
  rings: Ring[];
  at: { x: number; y: number } | undefined;
  region: Region | undefined;
}

/** From this many CSS pixels a pixel's value is written inside it. */
const kTextZoom = 52;

export class Pane {
  readonly figure: HTMLElement;
  readonly frame: HTMLElement;
  readonly canvas: HTMLCanvasElement;
  readonly caption: HTMLElement;
  #message: HTMLElement;
  #shown = "";

  /** `caption`: an element for the image's name, which may be a button. */
  constructor(testid: string, caption: HTMLElement = el("span")) {
    this.caption = caption;
    this.canvas = el("canvas", { role: "img", "data-testid": testid });
    this.#message = el("p", { class: "v-message" });
    this.frame = el("div", { class: "v-frame" }, this.canvas, this.#message);
    this.figure = el("figure", { class: "v-pane" }, el("figcaption", {}, caption), this.frame);
  }

  /** In device pixels. */
  get size(): Size {
    return { w: this.canvas.width, h: this.canvas.height };
  }

  /** Device pixels per CSS pixel, as the canvas has them. */
  get density(): number {
    return this.canvas.width / Math.max(1, this.canvas.clientWidth);
  }

  /** Makes the canvas `height` CSS pixels high and as wide as its frame, without scaling. */
  resize(height: number): void {
    this.canvas.style.height = `${height}px`;
    const w = Math.max(1, Math.round(this.frame.clientWidth * devicePixelRatio));
    const h = Math.max(1, Math.round(height * devicePixelRatio));
    if (this.canvas.width === w && this.canvas.height === h) return;
    this.canvas.width = w;
    this.canvas.height = h;
    this.#shown = "";
  }

  /** `view`: none shows all of the image. */
  draw(content: Content, chosen: View | undefined): void {
    if (this.caption.textContent !== content.caption) this.caption.replaceChildren(breakable(content.caption));
    setText(this.#message, content.message);
    this.#message.hidden = content.message === "";
    setAttribute(this.canvas, "aria-label", content.caption);
    const layers = [content.left, content.main].filter((layer): layer is Layer => layer !== undefined);
    const key = JSON.stringify(
      [chosen, content, layers.map((layer) => [layer.field.key, layer.scale.key])],
      withoutLayers,
    );
    if (key === this.#shown) return;
    this.#shown = key;
    const context = this.canvas.getContext("2d")!;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.size.w, this.size.h);
    const first = layers[0];
    if (first === undefined) return;
    const view = chosen ?? fit(first.field, this.size);
    const split = content.left === undefined ? 0 : Math.round(content.wipe * this.size.w);
    if (content.left !== undefined) this.#drawLayer(context, content.left, view, 0, split);
    if (content.main !== undefined) this.#drawLayer(context, content.main, view, split, this.size.w);
    this.#drawMarks(context, content, view);
  }

  #drawLayer(context: CanvasRenderingContext2D, layer: Layer, view: View, from: number, to: number): void {
    context.save();
    context.beginPath();
    context.rect(from, 0, to - from, this.size.h);
    context.clip();
    context.imageSmoothingEnabled = false;
    const at = origin(view, this.size);
    context.drawImage(layer.raster, at.x, at.y, layer.field.w * view.zoom, layer.field.h * view.zoom);
    if (view.zoom >= kTextZoom * this.density) this.#drawValues(context, layer, view);
    context.restore();
  }

  #drawValues(context: CanvasRenderingContext2D, { field, scale }: Layer, view: View): void {
    const at = origin(view, this.size);
    const { zoom } = view;
    const signed = field.kind === "error" || field.kind === "difference" || field.kind === "decibels";
    context.font = `${Math.round(Math.min(14 * this.density, zoom / 4.8))}px ui-monospace, monospace`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    const lastX = Math.min(field.w, Math.ceil((this.size.w - at.x) / zoom));
    const lastY = Math.min(field.h, Math.ceil((this.size.h - at.y) / zoom));
    for (let y = Math.max(0, Math.floor(-at.y / zoom)); y < lastY; ++y) {
      for (let x = Math.max(0, Math.floor(-at.x / zoom)); x < lastX; ++x) {
        const value = field.at(x + field.w * y);
        context.fillStyle = luminance(colourOn(scale, value)) > 0.18 ? "#000" : "#fff";
        context.fillText(tiny(value, signed), at.x + (x + 0.5) * zoom, at.y + (y + 0.5) * zoom);
      }
    }
  }

  #drawMarks(context: CanvasRenderingContext2D, { rings, at, region }: Content, view: View): void {
    const from = origin(view, this.size);
    const zoom = view.zoom;
    const unit = this.density;
    for (const ring of rings) {
      const radius = Math.max(7 * unit, 0.9 * zoom);
      context.beginPath();
      context.arc(from.x + (ring.x + 0.5) * zoom, from.y + (ring.y + 0.5) * zoom, radius, 0, 2 * Math.PI);
      this.#stroke(context);
    }
    if (region !== undefined) {
      context.beginPath();
      context.rect(
        from.x + region.x * zoom - 0.5,
        from.y + region.y * zoom - 0.5,
        region.w * zoom + 1,
        region.h * zoom + 1,
      );
      this.#stroke(context);
    }
    if (at !== undefined) {
      const [x0, y0] = [from.x + at.x * zoom, from.y + at.y * zoom];
      const [cx, cy] = [x0 + zoom / 2, y0 + zoom / 2];
      const gap = Math.max(zoom / 2, 3 * unit);
      const arm = gap + 9 * unit;
      context.beginPath();
      context.rect(cx - gap - 0.5, cy - gap - 0.5, 2 * gap + 1, 2 * gap + 1);
      for (const [dx, dy] of [
        [1, 0],
        [-1, 0],
        [0, 1],
        [0, -1],
      ] as const) {
        context.moveTo(cx + dx * gap, cy + dy * gap);
        context.lineTo(cx + dx * arm, cy + dy * arm);
      }
      this.#stroke(context);
    }
  }

  /** White within black, which is wider than a pixel on either side: seen on any colour. */
  #stroke(context: CanvasRenderingContext2D): void {
    context.lineWidth = 4 * this.density;
    context.strokeStyle = "#000";
    context.stroke();
    context.lineWidth = 1.4 * this.density;
    context.strokeStyle = "#fff";
    context.stroke();
  }
}

function withoutLayers(key: string, value: unknown): unknown {
  return key === "left" || key === "main" ? undefined : value;
}
