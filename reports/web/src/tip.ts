// The one tip of the page: a point's values beside it. Screen readers have them from the point itself.
import { el } from "./dom";

let tip: HTMLElement | undefined;

/** Shows the text at that place of the window, on the side where there is room. */
export function showTip(text: string, x: number, y: number): void {
  if (tip === undefined) {
    tip = el("div", { class: "tip", "aria-hidden": true });
    document.body.append(tip);
  }
  tip.textContent = text;
  tip.hidden = false;
  const { width, height } = tip.getBoundingClientRect();
  const left = x + 14 + width < innerWidth ? x + 14 : x - 14 - width;
  const top = Math.min(Math.max(4, y - height / 2), innerHeight - height - 4);
  tip.style.transform = `translate(${Math.max(4, left)}px, ${top}px)`;
}

export function hideTip(): void {
  if (tip !== undefined) tip.hidden = true;
}
