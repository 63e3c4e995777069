// Which series stands out in all charts: the one under the pointer or with the focus. The others are dimmed.

export class Highlight {
  #key: string | undefined;
  readonly #root: HTMLElement;

  constructor(root: HTMLElement) {
    this.#root = root;
  }

  set(key: string | undefined): void {
    if (key === this.#key) return;
    this.#key = key;
    this.apply(this.#root);
  }

  /** Marks what is drawn there; called again for charts drawn while a series stands out. A chart that has no such
   * series stays as it is. */
  apply(root: ParentNode): void {
    for (const chart of root.querySelectorAll<HTMLElement>(".chart")) {
      const groups = [...chart.querySelectorAll<SVGElement>("[data-series]")];
      const known = this.#key !== undefined && groups.some((group) => group.dataset["series"] === this.#key);
      for (const group of groups) group.classList.toggle("dim", known && group.dataset["series"] !== this.#key);
    }
  }
}
