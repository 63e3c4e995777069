// From the reader's choices and decoded pictures to what each pane draws and which colour bars belong to it.
import { titleOf, type Shot, type Show } from "./catalogue";
import type { Choices, Slot } from "./choices";
import type { Use } from "./colour_bars";
import type { MapName } from "./colours";
import { differenceOf, exactOf, fieldOf, isPower, type Field } from "./field";
import { rounded } from "./numbers";
import type { Content, Layer, Ring } from "./pane";
import type { Picture } from "./pictures";
import { Recent } from "./recent";
import { rasterOf, scaleOf, type Scale } from "./scale";

export interface Composition {
  panes: Content[]; // one for each pane of the mode, in order
  uses: Use[];
  mapIsFree: boolean; // something shown has a choice of maps
}

/** What is said and drawn about a shot besides its pixels. */
export interface Notes {
  rmse(shot: Shot): number | undefined; // over active pixels
  text(shot: Shot): string; // "" or such as "RMSE 0.012 (active pixels)"
  rings(shot: Shot): Ring[];
}

const kSizesDiffer = "A and B differ in size: no difference is defined.";
const kKindsDiffer = "A and B show different things: no difference is defined.";

export class Composer {
  #choices: Choices;
  #maps: readonly MapName[];
  #notes: Notes;
  #fields = new Recent<Field>(64);
  #rasters = new Recent<HTMLCanvasElement>(64);

  /** `maps`: those of values, or of powers; the first is the rule. */
  constructor(choices: Choices, maps: readonly MapName[], notes: Notes) {
    this.#choices = choices;
    this.#maps = maps;
    this.#notes = notes;
  }

  get map(): MapName {
    return this.#choices.map(this.#maps[0]!);
  }

  /** All modes but the grid. */
  pair(a: Picture, b: Picture): Composition {
    const choices = this.#choices;
    const showA = choices.side("a").show;
    const showB = choices.side("b").show;
    const exact = choices.front === "exact" ? exactOf(b) : undefined;
    const fieldA = this.#field(a, showA);
    const fieldB = exact ?? this.#field(b, showB);
    const captionA = this.#caption("a", a, showA);
    const captionB = exact === undefined ? this.#caption("b", b, showB) : `Exact: ${b.shot.scene}, ${b.shot.filter}`;
    const [scaleA, scaleB] = this.#scales(fieldA, fieldB, a, b);
    const layerA = this.#layer(fieldA, scaleA);
    const layerB = this.#layer(fieldB, scaleB);
    const ringsA = this.#notes.rings(a.shot);
    const ringsB = exact === undefined ? this.#notes.rings(b.shot) : [];
    const inB = exact === undefined ? "B" : "Exact";
    const uses =
      scaleA.key === scaleB.key
        ? [{ scale: scaleA, of: `A and ${inB}` }]
        : [
            { scale: scaleA, of: "A" },
            { scale: scaleB, of: inB },
          ];
    const mapIsFree = [fieldA, fieldB].some((field) => field.kind === "value" || field.kind === "power");
    const paneA = this.#content(captionA, layerA, ringsA);
    const paneB = this.#content(captionB, layerB, ringsB);
    if (choices.mode === "side") return { panes: [paneA, paneB], uses, mapIsFree };
    if (choices.mode === "swipe") {
      const caption = `${captionA}  |  ${captionB}`;
      return { panes: [{ ...paneB, caption, left: layerA, wipe: choices.wipe }], uses, mapIsFree };
    }
    if (choices.mode === "flip") return { panes: [choices.front === "a" ? paneA : paneB], uses, mapIsFree };
    if (exact !== undefined) return { panes: [paneB], uses: [{ scale: scaleB, of: inB }], mapIsFree };
    return this.#differencePane(a, b, showA, showB);
  }

  /** The grid: every picture's error, or its power, on one scale. */
  grid(pictures: readonly Picture[], show: Show): Composition {
    const fields = pictures.map((picture) => this.#field(picture, isPower(show) ? show : "error"));
    const known = pictures.map((picture) => picture.shot.error?.range ?? 0);
    const scale = scaleOf(fields, this.map, this.#choices.exposure, known);
    const panes = fields.map((field, i) => {
      const { shot } = pictures[i]!;
      const rmse = this.#notes.rmse(shot);
      const caption = rmse === undefined ? shot.source : `${shot.source}: RMSE ${rounded(rmse)}`;
      return this.#content(caption, this.#layer(field, scale), this.#notes.rings(shot));
    });
    return { panes, uses: [{ scale, of: "All" }], mapIsFree: isPower(show) };
  }

  #differencePane(a: Picture, b: Picture, showA: Show, showB: Show): Composition {
    const field = differenceOf(a, b, showA, showB);
    const caption = `B \u2212 A: ${b.shot.scene}: (${titleOf(b.shot)}) \u2212 (${titleOf(a.shot)})`;
    if (field === undefined) {
      const message = a.w !== b.w || a.h !== b.h ? kSizesDiffer : kKindsDiffer;
      return { panes: [{ ...this.#content(caption, undefined, []), message }], uses: [], mapIsFree: false };
    }
    const kept = this.#fields.get(field.key, () => field);
    const scale = scaleOf([kept], "diverging", this.#choices.exposure);
    return {
      panes: [this.#content(caption, this.#layer(kept, scale), [])],
      uses: [{ scale, of: "B \u2212 A" }],
      mapIsFree: false,
    };
  }

  /** One scale for A and B where they show the same kind of number. */
  #scales(fieldA: Field, fieldB: Field, a: Picture, b: Picture): [Scale, Scale] {
    const { exposure } = this.#choices;
    const rangeA = fieldA.kind === "error" ? (a.shot.error?.range ?? 0) : 0;
    const rangeB = fieldB.kind === "error" ? (b.shot.error?.range ?? 0) : 0;
    if (fieldA.kind === fieldB.kind) {
      const both = scaleOf([fieldA, fieldB], this.map, exposure, [rangeA, rangeB]);
      return [both, both];
    }
    return [scaleOf([fieldA], this.map, exposure, [rangeA]), scaleOf([fieldB], this.map, exposure, [rangeB])];
  }

  #field(picture: Picture, show: Show): Field {
    const field = fieldOf(picture, show);
    return this.#fields.get(field.key, () => field);
  }

  #layer(field: Field, scale: Scale): Layer {
    return { field, scale, raster: this.#rasters.get(`${field.key} ${scale.key}`, () => rasterOf(field, scale)) };
  }

  #content(caption: string, main: Layer | undefined, rings: Ring[]): Content {
    const { at, region, mode } = this.#choices;
    const marks = mode === "grid" ? { at: undefined, region: undefined } : { at, region };
    return { caption, main, wipe: 0, message: "", rings, ...marks };
  }

  #caption(slot: Slot, picture: Picture, show: Show): string {
    const what =
      show === "error" && picture.shot.source !== "exact"
        ? ", error"
        : isPower(show) && show !== "spectrum"
          ? `, ${show}`
          : "";
    const note = this.#notes.text(picture.shot);
    const name = `${slot.toUpperCase()}: ${picture.shot.scene}: ${titleOf(picture.shot)}${what}`;
    return note === "" ? name : `${name}; ${note}`;
  }
}
