// Mouse, pen and fingers on a pane: drag pans, shift and drag marks a region, wheel and pinch zoom, a click points.
import type { Pane } from "./pane";

/** Places are device pixels of the pane. */
export interface Gestures {
  hover(pane: Pane, place: Place | undefined): void;
  click(pane: Pane, place: Place): void;
  pan(pane: Pane, dx: number, dy: number): void; // what is under the pointer goes with it
  zoom(pane: Pane, place: Place, steps: number): void; // what is under the pointer stays there
  canZoom(pane: Pane, steps: number): boolean;
  mark(pane: Pane, from: Place, to: Place): void;
}

export interface Place {
  x: number;
  y: number;
}

/** A click may tremble this much, in CSS pixels. */
const kTremble = 4;
/** What the wheel turns, in CSS pixels of scrolling, for a level of zoom; a notch of most mice is 100 to 120. */
const kWheelStep = 60;
/** Fingers' distances for a level of zoom. */
const kPinchStep = 1.35;

export function listenTo(pane: Pane, gestures: Gestures): void {
  const canvas = pane.canvas;
  const place = (event: { clientX: number; clientY: number }): Place => {
    const box = canvas.getBoundingClientRect();
    return { x: (event.clientX - box.left) * pane.density, y: (event.clientY - box.top) * pane.density };
  };
  const down = new Map<number, { x: number; y: number }>(); // pointers that press, where they were last
  let start: Place | undefined; // of a drag that is a click until it has moved
  let marking: Place | undefined;
  let spread = 0;

  const distance = () => {
    const [one, two] = [...down.values()];
    return one && two ? Math.hypot(one.x - two.x, one.y - two.y) : 0;
  };
  const middle = () => {
    const all = [...down.values()];
    return {
      clientX: all.reduce((sum, p) => sum + p.x, 0) / all.length,
      clientY: all.reduce((sum, p) => sum + p.y, 0) / all.length,
    };
  };

  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    down.set(event.pointerId, { x: event.clientX, y: event.clientY });
    spread = distance();
    start = down.size === 1 ? { x: event.clientX, y: event.clientY } : undefined;
    marking = event.shiftKey && down.size === 1 ? place(event) : undefined;
    event.preventDefault(); // no selection of text; the focus is the stage's own matter
    (canvas.closest("[tabindex]") as HTMLElement | null)?.focus({ preventScroll: true });
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = down.get(event.pointerId);
    if (last === undefined) {
      if (event.pointerType !== "touch") gestures.hover(pane, place(event));
      return;
    }
    if (start !== undefined && Math.hypot(event.clientX - start.x, event.clientY - start.y) <= kTremble) return;
    start = undefined;
    down.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (marking !== undefined) {
      gestures.mark(pane, marking, place(event));
    } else if (down.size === 2) {
      const ratio = distance() / spread;
      const steps = ratio > kPinchStep ? 1 : ratio < 1 / kPinchStep ? -1 : 0;
      if (steps === 0) return;
      spread = distance();
      gestures.zoom(pane, place(middle()), steps);
    } else {
      gestures.pan(pane, (event.clientX - last.x) * pane.density, (event.clientY - last.y) * pane.density);
      gestures.hover(pane, place(event));
    }
  });
  const up = (event: PointerEvent) => {
    if (!down.delete(event.pointerId)) return;
    if (event.type === "pointerup" && start !== undefined && marking === undefined) gestures.click(pane, place(event));
    start = undefined;
    marking = undefined;
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener("pointerleave", () => gestures.hover(pane, undefined));

  let turned = 0;
  canvas.addEventListener(
    "wheel",
    (event) => {
      const unit = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 40; // lines, pages: a notch is a step
      turned = Math.sign(turned) === Math.sign(event.deltaY) ? turned + unit * event.deltaY : unit * event.deltaY;
      // Gestures of a touchpad come as many small turns, pinches as turns with the control key, smaller still.
      const step = event.ctrlKey ? kWheelStep / 6 : kWheelStep;
      const steps = event.deltaY < 0 ? 1 : -1;
      if (!gestures.canZoom(pane, steps)) return; // at the ends of the zoom the wheel is the page's again
      event.preventDefault();
      if (Math.abs(turned) < step) return;
      turned = 0;
      gestures.zoom(pane, place(event), steps);
    },
    { passive: false },
  );
}
