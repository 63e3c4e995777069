// Bringing elements up to date where something has changed, so that screen readers and selections are left alone.

export function setText(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

export function setAttribute(element: Element, name: string, value: string | number | boolean): void {
  const text = String(value);
  if (element.getAttribute(name) !== text) element.setAttribute(name, text);
}

export interface Option {
  value: string;
  text: string;
}

/** Fills a <select> and chooses one. A single option leaves nothing to choose. */
export function setOptions(select: HTMLSelectElement, options: readonly Option[], chosen: string): void {
  const key = options.map((option) => `${option.value}\t${option.text}`).join("\n");
  if (select.dataset["key"] !== key) {
    select.dataset["key"] = key;
    select.replaceChildren(...options.map((option) => new Option(option.text, option.value)));
    select.disabled = options.length < 2;
  }
  if (select.value !== chosen) select.value = chosen;
}
