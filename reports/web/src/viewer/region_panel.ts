// Statistics of a region, or of the whole image: the errors of A and of B, and B - A. Of spectra: the powers.
import { button, el } from "../dom";
import { differenceOf, fieldOf, isPower, type Field } from "./field";
import type { Picture } from "./pictures";
import type { Choices } from "./choices";
import type { Show } from "./catalogue";
import { frequencyText } from "./frequency";
import { rounded } from "./numbers";
import { Recent } from "./recent";
import { clipped, statisticsOf, type Statistics } from "./statistics";
import { setText } from "./update";

const kRows = [
  { key: "bias", name: "Mean" },
  { key: "mae", name: "Mean absolute" },
  { key: "rmse", name: "Root mean square" },
  { key: "max", name: "Largest absolute" },
  { key: "p50", name: "p50 of absolute" },
  { key: "p95", name: "p95 of absolute" },
  { key: "p99", name: "p99 of absolute" },
] as const;
const kColumns = ["a", "b", "difference"] as const;
const kSides = ["x", "y", "w", "h"] as const;

export class RegionPanel {
  readonly element: HTMLElement;
  #choices: Choices;
  #inputs = new Map<(typeof kSides)[number], HTMLInputElement>();
  #caption = el("caption", { "data-testid": "region-caption" });
  #heads = kColumns.map(() => el("th", { scope: "col" }));
  #cells = new Map<string, HTMLElement>();
  #worst: HTMLButtonElement[] = [];
  #places: (Statistics | undefined)[] = [];
  #statistics = new Recent<Statistics>(24);

  /** `goTo` shows a pixel. */
  constructor(choices: Choices, goTo: (x: number, y: number) => void) {
    this.#choices = choices;
    const names = { x: "x", y: "y", w: "width", h: "height" };
    const fields = kSides.map((side) => {
      const input = el("input", {
        type: "number",
        min: side === "w" || side === "h" ? 1 : 0,
        step: 1,
        "data-testid": `region-${side}`,
      });
      input.addEventListener("change", () => this.#read());
      this.#inputs.set(side, input);
      return el("label", {}, `${names[side]} `, input);
    });
    const body = el("tbody");
    for (const { key, name } of kRows) {
      const row = el("tr", {}, el("th", { scope: "row" }, name));
      kColumns.forEach((column, c) => {
        const text = el("span", { "data-testid": `region-${column}-${key}` });
        this.#cells.set(`${column} ${key}`, text);
        const cell = el("td", {}, text);
        if (key === "max") {
          const where = button("", { class: "v-where", "data-testid": `worst-${column}` }, () => {
            const s = this.#places[c];
            if (s !== undefined && s.n > 0) goTo(s.maxX, s.maxY);
          });
          this.#worst.push(where);
          cell.append(" ", where);
        }
        row.append(cell);
      });
      body.append(row);
    }
    const head = el("tr", {}, el("td"), ...this.#heads);
    this.element = el(
      "div",
      { class: "v-region", "data-testid": "region" },
      el(
        "div",
        { class: "v-region-inputs", role: "group", "aria-label": "Region, in pixels" },
        ...fields,
        button("Whole image", { "data-testid": "region-all" }, () => (choices.region = undefined)),
      ),
      el("table", { class: "v-table" }, this.#caption, el("thead", {}, head), body),
    );
  }

  update(a: Picture, b: Picture, showA: Show, showB: Show): void {
    const power = isPower(showB);
    const fields: (Field | undefined)[] = power
      ? [fieldOf(a, showA), fieldOf(b, showB), differenceOf(a, b, showA, showB)]
      : [fieldOf(a, "error"), fieldOf(b, "error"), differenceOf(a, b, "value", "value")];
    const heads = power ? ["Power of A", "Power of B", "B over A, dB"] : ["Error of A", "Error of B", "B \u2212 A"];
    this.#heads.forEach((head, c) => setText(head, heads[c]!));
    this.#places = fields.map((field) => this.#of(field));
    kColumns.forEach((column, c) => {
      const s = this.#places[c];
      for (const { key } of kRows) {
        const cell = this.#cells.get(`${column} ${key}`)!;
        setText(cell, s === undefined || s.n === 0 ? "\u2013" : rounded(s[key]));
        cell.dataset["value"] = s === undefined ? "" : String(s[key]);
      }
      const where = this.#worst[c]!;
      where.hidden = s === undefined || s.n === 0;
      setText(where, s === undefined ? "" : `at ${power ? frequencyText(a, s.maxX, s.maxY) : `${s.maxX}, ${s.maxY}`}`);
    });
    this.#write(a);
  }

  #of(field: Field | undefined): Statistics | undefined {
    if (field === undefined) return undefined;
    const region = this.#choices.region;
    const part = region === undefined ? { x: 0, y: 0, w: field.w, h: field.h } : clipped(region, field);
    if (part === undefined) return undefined;
    return this.#statistics.get(`${field.key} ${JSON.stringify(part)}`, () => statisticsOf(field, part));
  }

  #write(a: Picture): void {
    const region = this.#choices.region;
    const shown = region ?? { x: 0, y: 0, w: a.w, h: a.h };
    for (const [side, input] of this.#inputs) if (input !== document.activeElement) input.value = String(shown[side]);
    const n = this.#places[0]?.n ?? 0;
    const nans = this.#places.reduce((sum, s) => Math.max(sum, s?.nans ?? 0), 0);
    const not = nans > 0 ? `, ${nans} more are not numbers` : "";
    setText(
      this.#caption,
      `${region === undefined ? "Whole image" : "Region"}: ${n.toLocaleString("en")} pixels${not}`,
    );
  }

  #read(): void {
    const [x, y, w, h] = kSides.map((side) => Math.floor(Number(this.#inputs.get(side)!.value)));
    if ([x, y, w, h].some((v) => v === undefined || !Number.isFinite(v)) || w! < 1 || h! < 1) return;
    this.#choices.region = { x: Math.max(0, x!), y: Math.max(0, y!), w: w!, h: h! };
  }
}
