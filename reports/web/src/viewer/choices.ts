// What the reader has chosen in one viewer. It lives in the page's state alone, so that a link restores all of it.
import type { PageState } from "../state";
import type { MapName } from "./colours";
import { shows, withFacet, type Facet, type Shot, type Show } from "./catalogue";
import type { Region } from "./statistics";

export const kModes = ["side", "swipe", "flip", "difference", "grid"] as const;
export type Mode = (typeof kModes)[number];
export type Slot = "a" | "b";

export interface Side {
  shot: Shot;
  show: Show;
}

const kKeys = [
  "mode",
  "a",
  "b",
  "a-show",
  "b-show",
  "link",
  "ev",
  "map",
  "zoom",
  "centre",
  "wipe",
  "front",
  "at",
  "region",
];
export const kMostExposure = 16;

export class Choices {
  readonly shots: readonly Shot[];
  #state: PageState;
  #prefix: string;
  #first: Record<Slot, Shot>;

  /** `shots` has at least one; `prefix` keeps the keys of two viewers apart. */
  constructor(shots: readonly Shot[], state: PageState, prefix: string) {
    this.shots = shots;
    this.#state = state;
    this.#prefix = prefix;
    this.#first = firstPair(shots);
  }

  /** Calls `fn` after every change, also one typed into the address; returns how to stop. */
  onChange(fn: () => void): () => void {
    const stops = kKeys.map((key) => this.#state.onChange(this.#prefix + key, fn));
    return () => stops.forEach((stop) => stop());
  }

  get mode(): Mode {
    return kModes.find((mode) => mode === this.#get("mode")) ?? "side";
  }
  set mode(mode: Mode) {
    this.#set("mode", mode === "side" ? undefined : mode);
  }

  side(slot: Slot): Side {
    const id = this.#get(slot);
    const shot = this.shots.find((s) => s.id === id) ?? this.#first[slot];
    const list = shows(shot);
    return { shot, show: list.find((show) => show === this.#get(`${slot}-show`)) ?? list[0]! };
  }

  /** Chooses another shot. While A and B are linked the other one follows in scene, filter and samples. */
  choose(slot: Slot, facet: Facet, value: string): void {
    const other: Slot = slot === "a" ? "b" : "a";
    const mine = this.side(slot).shot;
    const theirs = this.side(other).shot;
    this.#put(slot, withFacet(this.shots, mine, facet, value, theirs));
    // An exact image stays exact: it has no samples to follow with.
    if (!this.linked || facet === "source" || theirs[facet] === "") return;
    this.#put(other, withFacet(this.shots, theirs, facet, value, mine));
  }

  chooseShot(slot: Slot, shot: Shot): void {
    this.#put(slot, shot);
  }

  setShow(slot: Slot, show: Show): void {
    this.#set(`${slot}-show`, show === shows(this.side(slot).shot)[0] ? undefined : show);
  }

  /** Puts A where B was and the other way round. */
  swap(): void {
    const [a, b] = [this.side("a"), this.side("b")];
    this.#put("a", b.shot);
    this.#put("b", a.shot);
    this.setShow("a", b.show);
    this.setShow("b", a.show);
  }

  get linked(): boolean {
    return this.#get("link") !== "no";
  }
  set linked(linked: boolean) {
    this.#set("link", linked ? undefined : "no");
  }

  /** In steps of a factor of two. */
  get exposure(): number {
    return clamp(number(this.#get("ev")) ?? 0, -kMostExposure, kMostExposure);
  }
  set exposure(exposure: number) {
    const ev = clamp(exposure, -kMostExposure, kMostExposure);
    this.#set("ev", ev === 0 ? undefined : String(ev));
  }

  /** Of coverage and of power; errors have the diverging map. */
  map(fallback: MapName): MapName {
    return (["grey", "linear", "heat"] as const).find((map) => map === this.#get("map")) ?? fallback;
  }
  set mapName(map: string) {
    this.#set("map", map);
  }

  /** None: all of the image, whatever the size of the pane. */
  get view(): { zoom: number; x: number; y: number } | undefined {
    const zoom = number(this.#get("zoom"));
    const [x, y] = numbers(this.#get("centre"), 2) ?? [];
    return zoom !== undefined && zoom > 0 && x !== undefined && y !== undefined ? { zoom, x, y } : undefined;
  }
  set view(view: { zoom: number; x: number; y: number } | undefined) {
    this.#set("zoom", view && String(Number(view.zoom.toFixed(6))));
    this.#set("centre", view && `${Number(view.x.toFixed(3))},${Number(view.y.toFixed(3))}`);
  }

  /** Where the line between A and B is, in parts of the pane from its left side. */
  get wipe(): number {
    return clamp(number(this.#get("wipe")) ?? 0.5, 0, 1);
  }
  set wipe(wipe: number) {
    this.#set("wipe", String(Number(clamp(wipe, 0, 1).toFixed(4))));
  }

  /** What lies in front: in a flip A or B; in every mode the exact image, in B's place, once it is asked for. */
  get front(): "a" | "b" | "exact" {
    return (["a", "exact"] as const).find((front) => front === this.#get("front")) ?? "b";
  }
  set front(front: "a" | "b" | "exact") {
    this.#set("front", front === "b" ? undefined : front);
  }

  /** The crosshair's pixel. */
  get at(): { x: number; y: number } | undefined {
    const [x, y] = numbers(this.#get("at"), 2) ?? [];
    return x !== undefined && y !== undefined ? { x: Math.floor(x), y: Math.floor(y) } : undefined;
  }
  set at(at: { x: number; y: number } | undefined) {
    this.#set("at", at && `${at.x},${at.y}`);
  }

  get region(): Region | undefined {
    const [x, y, w, h] = (numbers(this.#get("region"), 4) ?? []).map(Math.floor);
    if (x === undefined || y === undefined || w === undefined || h === undefined || w < 1 || h < 1) return undefined;
    return { x, y, w, h };
  }
  set region(region: Region | undefined) {
    this.#set("region", region && [region.x, region.y, region.w, region.h].join(","));
  }

  #put(slot: Slot, shot: Shot): void {
    this.#set(slot, shot.id);
  }
  #get(key: string): string | undefined {
    return this.#state.get(this.#prefix + key);
  }
  #set(key: string, value: string | undefined): void {
    this.#state.set(this.#prefix + key, value);
  }
}

/**
 * Two patterns of one scene, filter and number of samples, the study's first and last. Of the scenes the one with an
 * image whose pixels take most room in the page each: it has most to show.
 */
function firstPair(shots: readonly Shot[]): Record<Slot, Shot> {
  const sampled = shots.filter((shot) => shot.source !== "exact");
  const room = (shot: Shot) => {
    const pixels = (shot.error ?? shot.spectrum)?.pixels;
    return pixels === undefined ? 0 : pixels.data.length / (pixels.w * pixels.h);
  };
  const busiest = sampled.reduce<Shot | undefined>(
    (best, shot) => (best && room(best) >= room(shot) ? best : shot),
    undefined,
  );
  if (busiest === undefined) return { a: shots[0]!, b: shots[shots.length - 1]! };
  const scene = sampled.filter((shot) => shot.scene === busiest.scene);
  const counts = [...new Set(scene.map((shot) => Number(shot.spp)))].sort((a, b) => a - b);
  const spp = String(counts[Math.floor((counts.length - 1) / 2)]);
  const alike = scene.filter((shot) => shot.spp === spp && shot.filter === scene[0]!.filter);
  const list = alike.length > 0 ? alike : scene;
  return { a: list[0]!, b: list[list.length - 1]! };
}

function number(text: string | undefined): number | undefined {
  const value = text === undefined || text.trim() === "" ? NaN : Number(text);
  return Number.isFinite(value) ? value : undefined;
}

/** `count` numbers with commas between, or none. */
function numbers(text: string | undefined, count: number): number[] | undefined {
  const values = (text ?? "")
    .split(",")
    .map(number)
    .filter((value): value is number => value !== undefined);
  return values.length === count ? values : undefined;
}

function clamp(value: number, lo: number, hi: number): number {
  return Math.min(Math.max(value, lo), hi);
}
