// A few results kept for as long as they are in use: the one not asked for the longest goes first.

export class Recent<T> {
  #entries = new Map<string, T>();
  #most: number;

  constructor(most: number) {
    this.#most = most;
  }

  /** What `make` gave for this key, made now if need be. */
  get(key: string, make: () => T): T {
    const value = this.#entries.has(key) ? this.#entries.get(key)! : make();
    this.#entries.delete(key);
    this.#entries.set(key, value);
    if (this.#entries.size > this.#most) this.#entries.delete(this.#entries.keys().next().value!);
    return value;
  }
}
