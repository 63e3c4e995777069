// The choosers of A and of B: scene, filter, pattern, samples, trial, and what of it is shown.
import { button, el } from "../dom";
import { kFacets, optionsOf, shows, type Facet, type Show } from "./catalogue";
import type { Choices, Slot } from "./choices";
import { setAttribute, setOptions, setText } from "./update";

const kFacetNames: Record<Facet, string> = {
  scene: "Scene",
  filter: "Filter",
  source: "Pattern",
  spp: "Samples",
  trial: "Trial",
};

const kShowNames: Record<Show, string> = {
  value: "reconstruction",
  error: "error",
  spectrum: "all power",
  structured: "structured (in every trial)",
  noise: "noise (differs by trial)",
};

export class SidePanel {
  readonly element: HTMLElement;
  #facets = new Map<Facet, HTMLSelectElement>();
  #show = el("select");
  #links = el("span", { class: "v-links" });
  #choices: Choices;
  #slot: Slot;

  /** `folder`: where the run's files are, relative to the page, "" or ending in "/". */
  constructor(choices: Choices, slot: Slot) {
    this.#choices = choices;
    this.#slot = slot;
    const name = slot.toUpperCase();
    const fields = kFacets.map((facet) => {
      const select = el("select", { "data-testid": `${slot}-${facet}` });
      select.addEventListener("change", () => choices.choose(slot, facet, select.value));
      this.#facets.set(facet, select);
      return el("label", {}, el("span", {}, kFacetNames[facet]), select);
    });
    setAttribute(this.#show, "data-testid", `${slot}-show`);
    this.#show.addEventListener("change", () => choices.setShow(slot, this.#show.value as Show));
    this.element = el(
      "fieldset",
      { class: `v-side v-side-${slot}`, "data-testid": `side-${slot}` },
      el("legend", {}, name),
      ...fields,
      el("label", {}, el("span", {}, "Show"), this.#show),
      this.#links,
    );
  }

  update(): void {
    const choices = this.#choices;
    const { shot, show } = choices.side(this.#slot);
    for (const [facet, select] of this.#facets) {
      const values = optionsOf(choices.shots, shot, facet);
      setOptions(
        select,
        values.map((value) => ({ value, text: value === "" ? "\u2013" : value })),
        shot[facet],
      );
      select.closest("label")!.hidden = facet === "trial" && values.length < 2;
    }
    const exactly = shot.source === "exact";
    setOptions(
      this.#show,
      shows(shot).map((value) => ({ value, text: exactly ? "exact values" : kShowNames[value] })),
      show,
    );
    const images = [shot.error, shot.spectrum, shot.structured, shot.noise, shot.exact];
    const files = [...new Set(images.flatMap((image) => (image === undefined ? [] : [image.file])))];
    const key = files.join("\n");
    if (this.#links.dataset["key"] === key) return;
    this.#links.dataset["key"] = key;
    this.#links.replaceChildren("EXR: ");
    files.forEach((file, i) => {
      const kind = /\.([a-z]+)\.exr$/.exec(file)?.[1] ?? "image";
      this.#links.append(i === 0 ? "" : ", ", el("a", { href: hrefOf(file) }, kind));
    });
  }
}

/** Between the choosers: whether B follows A, and swapping them. */
export class SideLinks {
  readonly element: HTMLElement;
  #linked = el("input", { type: "checkbox", "data-testid": "link" });
  #choices: Choices;

  constructor(choices: Choices) {
    this.#choices = choices;
    this.#linked.addEventListener("change", () => (choices.linked = this.#linked.checked));
    this.element = el(
      "div",
      { class: "v-between" },
      el("label", {}, this.#linked, " Same scene, filter, samples in A and B"),
      button("Swap A and B", { "data-testid": "swap" }, () => choices.swap()),
    );
  }

  update(): void {
    this.#linked.checked = this.#choices.linked;
  }
}

/** A link to a file beside the page: names may hold '%', '#' and '?'. */
export function hrefOf(file: string): string {
  return file.split("/").map(encodeURIComponent).join("/");
}

/** The files that did not find room in the page, listed when somebody opens the list, or `open` at first. */
export function leftOutList(files: readonly { file: string; label: string }[], open = false): HTMLDetailsElement {
  const summary = el("summary");
  setText(summary, files.length === 1 ? "1 image is not in this page" : `${files.length} images are not in this page`);
  const details = el("details", { class: "v-left-out", "data-testid": "left-out" }, summary);
  details.addEventListener("toggle", () => {
    if (!details.open || details.childElementCount > 1) return;
    const list = el("ul");
    for (const { file, label } of files) list.append(el("li", {}, el("a", { href: hrefOf(file) }, label || file)));
    details.append(el("p", {}, "The page keeps to its size; these EXR files hold them:"), list);
  });
  details.open = open;
  return details;
}
