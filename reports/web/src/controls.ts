// Choices that links carry: one of several, several of several, and which series are shown.
import { button, el } from "./dom";
import { swatch } from "./series_style";
import type { SeriesStyles } from "./series_style";
import type { PageState } from "./state";
import type { Highlight } from "./highlight";
import { breakable } from "./text";

const kSeparator = "|"; // no name of a scene, filter or pattern holds it

export interface Option {
  value: string;
  label: string;
}

/** Tells of changes as long as the control is in the page: another run brings controls of its own. */
function listen(state: PageState, key: string, control: HTMLElement, changed: () => void): void {
  const stop = state.onChange(key, () => {
    if (control.isConnected) changed();
    else stop();
  });
}

export function options(values: readonly (string | number)[], label: (value: string) => string = (v) => v): Option[] {
  return values.map((value) => ({ value: String(value), label: label(String(value)) }));
}

/** One of several. What the link says counts where it is among the options, else the fallback or the first. */
export class Choice {
  constructor(
    private readonly state: PageState,
    private readonly key: string,
    readonly label: string,
    readonly choices: Option[],
    private readonly fallback: string | undefined = choices[0]?.value,
  ) {}

  get value(): string {
    const stored = this.state.get(this.key);
    if (this.choices.some((choice) => choice.value === stored)) return stored ?? "";
    return this.fallback ?? "";
  }

  /** A labelled select; calls `changed` whenever the choice is another. */
  control(changed: () => void): HTMLElement {
    const select = el("select", { "data-testid": `choose-${this.key}` });
    for (const choice of this.choices) select.append(el("option", { value: choice.value }, choice.label));
    select.value = this.value;
    select.addEventListener("change", () => {
      this.state.set(this.key, select.value === this.fallback ? undefined : select.value);
    });
    listen(this.state, this.key, select, () => {
      select.value = this.value;
      changed();
    });
    return el("label", { class: "control" }, el("span", {}, this.label), select);
  }
}

/** A list that lies over the page folds in when the reader turns elsewhere, and by Escape. */
function closable(list: HTMLDetailsElement, summary: HTMLElement): void {
  const outside = (event: Event): void => {
    if (event.target instanceof Node && !list.contains(event.target)) list.open = false;
  };
  list.addEventListener("toggle", () => {
    for (const kind of ["pointerdown", "focusin"]) {
      if (list.open) document.addEventListener(kind, outside);
      else document.removeEventListener(kind, outside);
    }
  });
  list.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || !list.open) return;
    list.open = false;
    summary.focus();
  });
}

/** Several of several, in the options' order; without a choice the first few. */
export class Choices {
  constructor(
    private readonly state: PageState,
    private readonly key: string,
    readonly label: string,
    readonly choices: string[],
    private readonly first: number,
  ) {}

  get values(): string[] {
    const stored = this.state.get(this.key);
    if (stored === undefined) return this.choices.slice(0, this.first);
    const wanted = new Set(stored.split(kSeparator));
    return this.choices.filter((choice) => wanted.has(choice));
  }

  /** A list of check boxes that folds out, with "All" and "None". */
  control(changed: () => void): HTMLElement {
    const summary = el("summary", {});
    const boxes = this.choices.map((choice) => {
      const box = el("input", { type: "checkbox", value: choice });
      box.addEventListener("change", () => store(boxes.filter((b) => b.checked).map((b) => b.value)));
      return box;
    });
    const store = (values: string[]): void => {
      const usual = this.choices.slice(0, this.first);
      const same = values.length === usual.length && values.every((value) => usual.includes(value));
      this.state.set(this.key, same ? undefined : values.join(kSeparator));
    };
    const show = (): void => {
      const values = this.values;
      for (const box of boxes) box.checked = values.includes(box.value);
      summary.textContent = `${this.label}: ${values.length} of ${this.choices.length}`;
    };
    show();
    listen(this.state, this.key, summary, () => {
      show();
      changed();
    });
    const list = el(
      "details",
      { class: "choices", "data-testid": `choose-${this.key}` },
      summary,
      el(
        "div",
        { class: "menu", role: "group", "aria-label": this.label },
        el(
          "div",
          { class: "all-none" },
          button("All", { class: "quiet" }, () => store([...this.choices])),
          button("None", { class: "quiet" }, () => store([])),
        ),
        ...boxes.map((box) => el("label", {}, box, el("span", {}, box.value))),
      ),
    );
    closable(list, summary);
    return list;
  }
}

/** The series that the reader has switched off, one set for all sections. */
export class Hidden {
  static readonly kKey = "hide";

  static of(state: PageState): Set<string> {
    return new Set((state.get(Hidden.kKey) ?? "").split(kSeparator).filter((key) => key !== ""));
  }

  static store(state: PageState, keys: Iterable<string>): void {
    const list = [...keys];
    state.set(Hidden.kKey, list.length === 0 ? undefined : list.join(kSeparator));
  }
}

/** The legend: each series a switch with its marker; the one under the pointer or the focus stands out in charts. */
export function legend(
  series: string[],
  styles: SeriesStyles,
  state: PageState,
  highlight: Highlight,
  changed: () => void,
): HTMLElement {
  const switches = series.map((key) => {
    const item = button("", { class: "series" }, () => {
      const hidden = Hidden.of(state);
      if (!hidden.delete(key)) hidden.add(key);
      Hidden.store(state, hidden);
    });
    item.append(swatch(styles.of(key)), el("span", {}, breakable(key)));
    item.addEventListener("pointerenter", () => highlight.set(key));
    item.addEventListener("pointerleave", () => highlight.set(undefined));
    item.addEventListener("focus", () => highlight.set(key));
    item.addEventListener("blur", () => highlight.set(undefined));
    return item;
  });
  const show = (): void => {
    const hidden = Hidden.of(state);
    series.forEach((key, i) => switches[i]?.setAttribute("aria-pressed", String(!hidden.has(key))));
  };
  show();
  const bar = el(
    "div",
    { class: "legend", role: "group", "aria-label": "Patterns shown", "data-testid": "legend" },
    ...switches,
    button("All", { class: "quiet" }, () =>
      Hidden.store(
        state,
        [...Hidden.of(state)].filter((key) => !series.includes(key)),
      ),
    ),
    button("None", { class: "quiet" }, () => Hidden.store(state, new Set([...Hidden.of(state), ...series]))),
  );
  listen(state, Hidden.kKey, bar, () => {
    show();
    changed();
  });
  return bar;
}

/** What the colours mean, where nothing is to be switched; the one under the pointer stands out. */
export function colourKey(
  label: string,
  keys: string[],
  styles: SeriesStyles,
  highlight: Highlight,
  markers: boolean,
): HTMLElement {
  const items = keys.map((key) => {
    const item = el("span", { class: "series" }, swatch(styles.of(key), markers), el("span", {}, breakable(key)));
    item.addEventListener("pointerenter", () => highlight.set(key));
    item.addEventListener("pointerleave", () => highlight.set(undefined));
    return item;
  });
  return el("div", { class: "legend", role: "group", "aria-label": label }, ...items);
}

/** A row of choices above what they steer. */
export function toolbar(...children: (HTMLElement | undefined)[]): HTMLElement {
  return el("div", { class: "toolbar" }, ...children);
}
