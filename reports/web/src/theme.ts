// Light or dark: the system's choice until the reader makes another. Print is always light, by style.css.

const kKey = "moire-theme";

/** Storage may be forbidden to a page from a file; then the choice lasts as long as the page. */
function stored(): string | null {
  try {
    return localStorage.getItem(kKey);
  } catch {
    return null;
  }
}

export class Theme {
  #dark: boolean;
  readonly #listeners: (() => void)[] = [];

  constructor() {
    const system = matchMedia("(prefers-color-scheme: dark)");
    const choice = stored();
    this.#dark = choice === null ? system.matches : choice === "dark";
    this.#show();
    system.addEventListener("change", () => {
      if (stored() === null) this.#set(system.matches);
    });
  }

  get dark(): boolean {
    return this.#dark;
  }

  toggle(): void {
    this.#set(!this.#dark);
    try {
      localStorage.setItem(kKey, this.#dark ? "dark" : "light");
    } catch {
      // The choice then lasts as long as the page.
    }
  }

  onChange(listener: () => void): void {
    this.#listeners.push(listener);
  }

  #set(dark: boolean): void {
    this.#dark = dark;
    this.#show();
    for (const listener of this.#listeners) listener();
  }

  #show(): void {
    document.documentElement.dataset["theme"] = this.#dark ? "dark" : "light";
  }
}
