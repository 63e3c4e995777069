// What a link to this page carries: the reader's choices as key=value pairs behind the address's '#'.

type Listener = (value: string | undefined) => void;

/** Browsers refuse more than some 20 changes of the address a second; a drag makes more. */
const kWriteDelay = 150; // ms

/**
 * The choices by key. A key and its value are any text. A hash without '=' such as #images, which links between
 * sections leave, is taken as section=images: the other choices stay.
 */
export class PageState {
  #values = new Map<string, string>();
  #listeners = new Map<string, Set<Listener>>();
  #timer: number | undefined;

  constructor() {
    this.#values = this.#parse(location.hash);
    addEventListener("hashchange", () => this.#read());
    addEventListener("pagehide", () => this.flush());
  }

  get(key: string): string | undefined {
    return this.#values.get(key);
  }

  /** Stores the value, or forgets the key, and tells whoever listens; the address follows a moment later. */
  set(key: string, value: string | undefined): void {
    if (this.#values.get(key) === value) return;
    if (value === undefined) this.#values.delete(key);
    else this.#values.set(key, value);
    this.#tell(key);
    this.#timer ??= setTimeout(() => this.flush(), kWriteDelay);
  }

  /** Calls `fn` with each new value of the key, whether `set` here or typed into the address. Returns how to stop. */
  onChange(key: string, fn: Listener): () => void {
    const listeners = this.#listeners.get(key) ?? new Set();
    this.#listeners.set(key, listeners);
    listeners.add(fn);
    return () => listeners.delete(fn);
  }

  /** Writes to the address at once what `set` has stored. */
  flush(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    const hash = this.#hash();
    if (hash !== location.hash)
      history.replaceState(history.state, "", hash === "" ? location.pathname + location.search : hash);
  }

  #tell(key: string): void {
    for (const fn of [...(this.#listeners.get(key) ?? [])]) fn(this.#values.get(key));
  }

  #read(): void {
    const before = this.#values;
    this.#values = this.#parse(location.hash);
    this.flush();
    for (const key of new Set([...before.keys(), ...this.#values.keys()])) {
      if (before.get(key) !== this.#values.get(key)) this.#tell(key);
    }
  }

  #parse(hash: string): Map<string, string> {
    const text = hash.replace(/^#/, "");
    if (text !== "" && !text.includes("=")) return new Map(this.#values).set("section", decode(text));
    const values = new Map<string, string>();
    for (const pair of text.split("&")) {
      const at = pair.indexOf("=");
      if (at > 0) values.set(decode(pair.slice(0, at)), decode(pair.slice(at + 1)));
    }
    return values;
  }

  #hash(): string {
    if (this.#values.size === 0) return "";
    return "#" + [...this.#values].map(([key, value]) => `${encode(key)}=${encode(value)}`).join("&");
  }
}

/** Links are read by people, too: names of patterns and of images keep their signs. */
function encode(text: string): string {
  return encodeURIComponent(text).replace(/%(?:2F|3A|2C|40|3B)/g, decodeURIComponent);
}

function decode(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text; // a stray '%': somebody typed it
  }
}
