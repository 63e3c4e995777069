// The viewer's keys. One key does one thing: no key means another thing with Shift held.
import { button, el } from "../dom";

export interface KeyAction {
  keys: readonly string[]; // as KeyboardEvent.key says, letters small
  does: string;
  run(key: string): void;
}

const kNames: Record<string, string> = {
  arrowleft: "\u2190",
  arrowright: "\u2192",
  arrowup: "\u2191",
  arrowdown: "\u2193",
  "-": "\u2212",
  escape: "Esc",
};

/** True where the key was one of the actions'. Keys of the browser and of fields that take text stay theirs. */
export function runKey(event: KeyboardEvent, actions: readonly KeyAction[]): boolean {
  if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return false;
  const key = event.key.toLowerCase();
  const target = event.target instanceof Element ? event.target : undefined;
  // Lists search by letters, fields take digits, buttons of a group and sliders move with arrows.
  if (target?.closest("select, input:not([type=radio]):not([type=checkbox]):not([type=range]), textarea")) return false;
  if (key.startsWith("arrow") && target?.closest("input, [role=slider]")) return false;
  const action = actions.find((a) => a.keys.includes(key));
  if (action === undefined) return false;
  event.preventDefault();
  action.run(key);
  return true;
}

export function helpDialog(actions: readonly KeyAction[]): HTMLDialogElement {
  const body = el("tbody");
  for (const { keys, does } of actions) {
    const names = keys.filter((key) => key !== "=").map((key) => el("kbd", {}, kNames[key] ?? key.toUpperCase()));
    body.append(el("tr", {}, el("th", { scope: "row" }, ...names), el("td", {}, does)));
  }
  const dialog = el(
    "dialog",
    { class: "v-help", "aria-label": "Keys of the image viewer", "data-testid": "keys" },
    el("h3", {}, "Keys"),
    el(
      "p",
      {},
      "They work while the viewer has the focus, or the pointer is over it. The mouse: drag pans, the wheel zooms, " +
        "a click sets the crosshair, Shift and drag marks a region.",
    ),
    el("table", {}, body),
    button("Close", {}, () => dialog.close()),
  );
  return dialog;
}
