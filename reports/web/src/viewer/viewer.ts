// The viewer of images and of two-dimensional spectra: two images A and B, or all patterns of a case, with linked zoom,
// exposure and colours. See choices.ts for what a reader chooses and compose.ts for what comes of it.
import { el } from "../dom";
import type { LeftOut, ReportImage, Run } from "../schema";
import type { PageState } from "../state";
import { isSpectral, optionsOf, shotsOf, type Shot } from "./catalogue";
import { Choices, type Mode } from "./choices";
import { ColourBars } from "./colour_bars";
import { Composer, type Composition } from "./compose";
import type { MapName } from "./colours";
import { helpDialog, runKey, type KeyAction } from "./keys";
import { Navigation } from "./navigation";
import { notesOf } from "./notes";
import type { Pane } from "./pane";
import { Pictures, type Picture } from "./pictures";
import type { Gestures, Place } from "./pointer";
import { Readout, spoken, type Question } from "./readout";
import { RegionPanel } from "./region_panel";
import { leftOutList, SideLinks, SidePanel } from "./side_panel";
import { Stage } from "./stage";
import { kViewerStyle } from "./style";
import { Toolbar } from "./toolbar";
import { setAttribute, setText } from "./update";

export interface ViewerContext {
  run: Run;
  state: PageState;
  left_out: readonly LeftOut[]; // images of this kind that the page has no room for
}

/** Screen readers hear where the crosshair has come to rest, not its way. */
const kAnnounceDelay = 500; // ms

/**
 * Puts a viewer of these images into `host`, in place of what is there: images with their exact ones, or spectra.
 * Nothing is decoded but what is shown. Without images there is the list of those left out, if any.
 */
export function mountViewer(host: HTMLElement, images: readonly ReportImage[], context: ViewerContext): void {
  const shots = shotsOf(images);
  host.replaceChildren();
  if (document.getElementById("viewer-style") === null)
    document.head.append(el("style", { id: "viewer-style" }, kViewerStyle));
  if (shots.length > 0) host.append(new Viewer(shots, context).element);
  else if (context.left_out.length > 0) host.append(leftOutList(context.left_out, true));
}

class Viewer {
  readonly element: HTMLElement;
  #choices: Choices;
  #shots: readonly Shot[];
  #navigation: Navigation;
  #pictures = new Pictures();
  #ready = new Map<string, Picture | string>(); // decoded, or what is wrong with it
  #waiting = new Set<string>();
  #grid: Shot[] = []; // the thumbnails
  #composer: Composer;
  #stage: Stage;
  #toolbar: Toolbar;
  #sides: [SidePanel, SidePanel];
  #links: SideLinks;
  #bars = new ColourBars();
  #readout: Readout;
  #region: RegionPanel;
  #live = el("p", { class: "unseen", "aria-live": "polite", "data-testid": "live" });
  #status = el("p", { class: "v-status", role: "status" });
  #help: HTMLDialogElement;
  #keys: readonly KeyAction[];
  #hovered: { x: number; y: number } | undefined;
  #question: Question | undefined;
  #pointed = false; // the pointer is over the viewer
  #frame = 0;
  #announcing = 0;
  #seen = false; // has been in the page
  #end = new AbortController();

  constructor(shots: readonly Shot[], { run, state, left_out }: ViewerContext) {
    const spectral = isSpectral(shots[0]!);
    const prefix = spectral ? "spectrum." : "image.";
    const maps: MapName[] = spectral ? ["heat", "linear"] : ["grey", "linear", "heat"];
    this.#shots = shots;
    const choices = new Choices(shots, state, prefix);
    this.#choices = choices;
    const navigation = new Navigation(choices);
    this.#navigation = navigation;
    this.#composer = new Composer(
      choices,
      maps,
      notesOf(run, () => this.#invalidate()),
    );
    const gestures: Gestures = {
      hover: (pane, place) => this.#hover(pane, place),
      click: (pane, place) => this.#click(pane, place),
      pan: (pane, dx, dy) => navigation.pan(pane, dx, dy),
      zoom: (pane, place, steps) => navigation.zoom(pane, place, steps),
      canZoom: (pane, steps) => navigation.canZoom(pane, steps),
      mark: (pane, from, to) => navigation.mark(pane, from, to),
    };
    const label = spectral ? "Spectra A and B" : "Images A and B";
    this.#stage = new Stage(
      choices,
      `${label}. Arrows pan, plus and minus zoom, H J K L move the crosshair, question mark lists all keys.`,
      gestures,
      (i) => this.#pick(i),
    );
    this.#toolbar = new Toolbar(
      choices,
      prefix,
      maps,
      shots.some((shot) => shot.exact !== undefined),
      {
        mode: (mode) => this.#setMode(mode),
        zoom: (steps) => this.#onPane((pane) => navigation.zoomBy(pane, steps)),
        fit: () => (choices.view = undefined),
        oneToOne: () => this.#onPane((pane) => navigation.zoomTo(pane, 1)),
        reference: () => this.#flipReference(),
        help: () => this.#help.showModal(),
      },
    );
    this.#sides = [new SidePanel(choices, "a"), new SidePanel(choices, "b")];
    this.#links = new SideLinks(choices);
    this.#readout = new Readout(spectral ? ["power"] : ["value", "exact", "error"]);
    this.#region = new RegionPanel(choices, (x, y) => this.#goTo(x, y));
    this.#keys = this.#keyActions();
    this.#help = helpDialog(this.#keys);
    this.element = el(
      "div",
      { class: "viewer", "data-testid": spectral ? "spectrum-viewer" : "image-viewer", "aria-busy": "true" },
      el("div", { class: "v-sides" }, this.#sides[0].element, this.#sides[1].element, this.#links.element),
      this.#toolbar.element,
      this.#status,
      this.#stage.element,
      this.#bars.element,
      el("div", { class: "v-numbers" }, this.#readout.element, this.#region.element),
      el("p", { class: "v-note" }, spectral ? kPrecisionOfPowers : kPrecision),
      left_out.length > 0 && leftOutList(left_out),
      this.#live,
      this.#help,
    );
    this.#listen();
    this.#invalidate();
  }

  #listen(): void {
    const { signal } = this.#end;
    const stop = this.#choices.onChange(() => this.#invalidate());
    signal.addEventListener("abort", stop);
    new ResizeObserver(() => this.#invalidate()).observe(this.#stage.element);
    addEventListener("resize", () => this.#invalidate(), { signal });
    this.element.addEventListener("pointerenter", () => (this.#pointed = true));
    this.element.addEventListener("pointerleave", () => (this.#pointed = false));
    document.addEventListener(
      "keydown",
      (event) => {
        const focus = document.activeElement;
        const mine = this.element.contains(focus) || (this.#pointed && (focus === null || focus === document.body));
        if (mine && !this.#help.open) runKey(event, this.#keys);
      },
      { signal },
    );
  }

  #invalidate(): void {
    if (this.#frame === 0) this.#frame = requestAnimationFrame(() => this.#render());
  }

  #render(): void {
    this.#frame = 0;
    if (!this.element.isConnected) {
      if (this.#seen) this.#end.abort(); // taken out of the page: nobody needs the listeners
      return;
    }
    this.#seen = true;
    const choices = this.#choices;
    for (const side of this.#sides) side.update();
    this.#links.update();
    const a = this.#picture(choices.side("a").shot);
    const b = this.#picture(choices.side("b").shot);
    const shots = choices.mode === "grid" ? this.#gridShots() : [];
    const grid = shots.map((shot) => this.#picture(shot));
    const wrong = [a, b, ...grid].filter((picture): picture is string => typeof picture === "string");
    setText(this.#status, wrong.join("; "));
    const waiting = [a, b, ...grid].includes(undefined);
    setAttribute(this.element, "aria-busy", waiting);
    // The last images stay until the next ones are decoded, or if they cannot be.
    if (waiting || typeof a !== "object" || typeof b !== "object") return;
    this.#forget([choices.side("a").shot, choices.side("b").shot, ...shots]);

    const pictures = grid.filter((picture): picture is Picture => typeof picture === "object");
    if (choices.mode === "grid" && pictures.length === 0) return;
    this.#grid = pictures.map((picture) => picture.shot);
    this.#stage.build(
      choices.mode,
      this.#grid.map((shot) => shot.source),
    );
    this.#stage.layout(pictures[0] ?? a);
    const composition: Composition =
      choices.mode === "grid" ? this.#composer.grid(pictures, choices.side("b").show) : this.#composer.pair(a, b);
    composition.panes.forEach((content, i) => this.#stage.panes[i]?.draw(content, choices.view));
    if (choices.mode === "grid") this.#stage.press(this.#grid.indexOf(choices.side("b").shot));
    this.#toolbar.update(this.#navigation.view(this.#stage.panes[0]!).zoom, this.#composer.map, composition.mapIsFree);
    this.#bars.update(composition.uses);
    const showA = choices.side("a").show;
    const showB = choices.side("b").show;
    this.#region.update(a, b, showA, showB);
    const at = this.#hovered ?? choices.at;
    this.#question = at && { ...at, a, b, showA, showB };
    this.#readout.update(this.#question);
  }

  /** The decoded shot, what is wrong with it, or nothing yet. */
  #picture(shot: Shot): Picture | string | undefined {
    const known = this.#ready.get(shot.id);
    if (known !== undefined || this.#waiting.has(shot.id)) return known;
    this.#waiting.add(shot.id);
    void this.#pictures
      .load(shot)
      .then(
        (picture) => this.#ready.set(shot.id, picture),
        (error: unknown) => this.#ready.set(shot.id, error instanceof Error ? error.message : String(error)),
      )
      .then(() => {
        this.#waiting.delete(shot.id);
        this.#invalidate();
      });
    return undefined;
  }

  #forget(used: readonly Shot[]): void {
    const ids = new Set(used.map((shot) => shot.id));
    for (const id of this.#ready.keys()) if (!ids.has(id)) this.#ready.delete(id);
  }

  /** All sources of B's case, or of A's where B is the exact image. */
  #gridShots(): Shot[] {
    const [a, b] = [this.#choices.side("a").shot, this.#choices.side("b").shot];
    const like =
      b.source !== "exact" ? b : a.source !== "exact" ? a : this.#shots.find((shot) => shot.source !== "exact");
    if (like === undefined) return [b];
    const seen = new Set<string>();
    return this.#shots.filter((shot) => {
      const alike =
        shot.source !== "exact" && shot.scene === like.scene && shot.filter === like.filter && shot.spp === like.spp;
      if (!alike || seen.has(shot.source)) return false;
      seen.add(shot.source);
      return true;
    });
  }

  // Gestures and keys.

  #hover(pane: Pane, place: Place | undefined): void {
    this.#hovered = place && this.#navigation.pixelAt(pane, place);
    this.#invalidate();
  }
  #click(pane: Pane, place: Place): void {
    if (this.#choices.mode === "grid") this.#pick(this.#stage.panes.indexOf(pane));
    else this.#choices.at = this.#navigation.pixelAt(pane, place);
  }
  #pick(index: number): void {
    const shot = this.#grid[index];
    if (shot !== undefined) this.#choices.chooseShot("b", shot);
  }
  #goTo(x: number, y: number): void {
    this.#navigation.goTo(x, y);
    this.#announce();
  }
  #moveCrosshair(dx: number, dy: number): void {
    this.#hovered = undefined;
    this.#onPane((pane) => this.#navigation.moveCrosshair(pane, dx, dy));
    this.#announce();
  }
  /** What keys and buttons do is meant for the first pane: the others are linked to it. */
  #onPane(act: (pane: Pane) => void): void {
    const pane = this.#stage.panes[0];
    if (pane !== undefined) act(pane);
  }
  #announce(): void {
    clearTimeout(this.#announcing);
    this.#announcing = setTimeout(() => {
      if (this.#question !== undefined) setText(this.#live, spoken(this.#question));
    }, kAnnounceDelay);
  }
  #setMode(mode: Mode): void {
    this.#choices.mode = mode;
    if (this.#choices.front === "a") this.#choices.front = "b";
  }
  #flip(): void {
    const choices = this.#choices;
    if (choices.mode !== "flip") {
      choices.mode = "flip";
      choices.front = "a";
    } else {
      choices.front = choices.front === "a" ? "b" : "a";
    }
    setText(this.#live, choices.front.toUpperCase());
  }
  #flipReference(): void {
    const choices = this.#choices;
    if (choices.side("b").shot.exact === undefined) return;
    choices.front = choices.front === "exact" ? "b" : "exact";
    setText(this.#live, choices.front === "exact" ? "Exact" : "B");
  }
  /** B's next pattern or number of samples: `by` places on, round at the ends. */
  #step(facet: "source" | "spp", by: number): void {
    const { shot } = this.#choices.side("b");
    const values = optionsOf(this.#shots, shot, facet);
    const next = values[(values.indexOf(shot[facet]) + by + values.length) % values.length];
    if (next !== undefined && next !== shot[facet]) this.#choices.choose("b", facet, next);
  }

  #keyActions(): KeyAction[] {
    const choices = this.#choices;
    const navigation = this.#navigation;
    const panBy = (dx: number, dy: number) =>
      this.#onPane((pane) => navigation.pan(pane, (dx * pane.size.w) / 8, (dy * pane.size.h) / 8));
    const moves: Record<string, [number, number]> = {
      arrowleft: [1, 0],
      arrowright: [-1, 0],
      arrowup: [0, 1],
      arrowdown: [0, -1],
      h: [-1, 0],
      l: [1, 0],
      k: [0, -1],
      j: [0, 1],
    };
    const mode = (key: string, to: Mode, does: string): KeyAction => ({
      keys: [key],
      does,
      run: () => this.#setMode(to),
    });
    return [
      { keys: ["f"], does: "flips between A and B in place", run: () => this.#flip() },
      { keys: ["r"], does: "shows the exact image in B's place, and B again", run: () => this.#flipReference() },
      mode("s", "side", "A and B side by side"),
      mode("w", "swipe", "swipe: A left of a line, B right of it"),
      mode("v", "difference", "the signed difference B \u2212 A"),
      mode("g", "grid", "all patterns of B's case; choosing one makes it B"),
      {
        keys: ["n", "p"],
        does: "the next and the previous pattern in B",
        run: (key) => this.#step("source", key === "n" ? 1 : -1),
      },
      { keys: [".", ","], does: "more and fewer samples", run: (key) => this.#step("spp", key === "." ? 1 : -1) },
      { keys: ["x"], does: "swaps A and B", run: () => choices.swap() },
      {
        keys: ["arrowleft", "arrowup", "arrowdown", "arrowright"],
        does: "move the view",
        run: (key) => panBy(...moves[key]!),
      },
      {
        keys: ["+", "=", "-"],
        does: "zoom in and out, about the crosshair if there is one",
        run: (key) => this.#onPane((pane) => navigation.zoomBy(pane, key === "-" ? -1 : 1)),
      },
      { keys: ["0"], does: "all of the image", run: () => (choices.view = undefined) },
      {
        keys: ["1"],
        does: "one pixel of the image for each of the screen",
        run: () => this.#onPane((pane) => navigation.zoomTo(pane, 1)),
      },
      {
        keys: ["h", "j", "k", "l"],
        does: "move the crosshair left, down, up, right",
        run: (key) => this.#moveCrosshair(...moves[key]!),
      },
      {
        keys: ["e", "d"],
        does: "exposure up and down by half a stop",
        run: (key) => (choices.exposure += key === "e" ? 0.5 : -0.5),
      },
      { keys: ["z"], does: "exposure 0", run: () => (choices.exposure = 0) },
      {
        keys: ["escape"],
        does: "no crosshair, no region",
        run: () => ([choices.at, choices.region] = [undefined, undefined]),
      },
      { keys: ["?"], does: "this table", run: () => this.#help.showModal() },
    ];
  }
}

const kPrecision =
  "Errors are kept with 11 significant binary digits, exact values with 24; the EXR files hold 24 of both. " +
  "Statistics are sums in double precision. Magenta is not a number.";
const kPrecisionOfPowers =
  "Powers are kept with 11 significant binary digits; the EXR files hold 24. Frequency 0 is in the middle, " +
  "frequencies are in cycles per pixel to the right and downwards.";
