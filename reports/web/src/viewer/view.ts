// Zoom and position, shared by all panes. Lengths of panes are device pixels, places in images count from the upper
// left corner of the first pixel, so that pixel (x, y) is the square from there to (x + 1, y + 1).

export interface Size {
  w: number;
  h: number;
}

/** `zoom`: device pixels per image pixel; (x, y): the place in the image that the pane's middle shows. */
export interface View {
  zoom: number;
  x: number;
  y: number;
}

/** Whole numbers above 1: at others nearest-neighbour pixels differ in size, and that is itself a Moire pattern. */
const kLevels = [1 / 8, 1 / 6, 1 / 4, 1 / 3, 1 / 2, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192];

/** The largest zoom that shows all of the image: a whole number, or a level below 1. */
export function fitZoom(image: Size, pane: Size): number {
  const most = Math.min(pane.w / image.w, pane.h / image.h);
  if (most >= 1) return Math.floor(most);
  return kLevels.filter((level) => level <= most).pop() ?? kLevels[0]!;
}

export function fit(image: Size, pane: Size): View {
  return { zoom: fitZoom(image, pane), x: image.w / 2, y: image.h / 2 };
}

/** The next level above (steps > 0) or below, but never below `least`. */
export function nextZoom(zoom: number, steps: number, least: number): number {
  const levels =
    steps > 0 ? kLevels.filter((level) => level > zoom) : kLevels.filter((level) => level < zoom).reverse();
  const next = levels[Math.min(Math.abs(steps), levels.length) - 1] ?? zoom;
  return Math.max(next, Math.min(least, zoom));
}

/** Where the image's upper left corner lies in the pane: whole device pixels, so that pixels have sharp sides. */
export function origin(view: View, pane: Size): { x: number; y: number } {
  return { x: Math.round(pane.w / 2 - view.x * view.zoom), y: Math.round(pane.h / 2 - view.y * view.zoom) };
}

/** The place in the image that is shown at (px, py) in the pane. */
export function placeAt(view: View, pane: Size, px: number, py: number): { x: number; y: number } {
  const from = origin(view, pane);
  return { x: (px - from.x) / view.zoom, y: (py - from.y) / view.zoom };
}

/** The same view at another zoom; what is shown at (px, py) stays there. */
export function zoomAbout(view: View, pane: Size, px: number, py: number, zoom: number): View {
  const place = placeAt(view, pane, px, py);
  return { zoom, x: place.x - (px - pane.w / 2) / zoom, y: place.y - (py - pane.h / 2) / zoom };
}

/** Keeps the pane's middle inside the image, or within half a pane of it while all of the image is visible. */
export function held(view: View, image: Size, pane: Size): View {
  const hold = (at: number, length: number, room: number) => {
    const slack = Math.max(0, (room / view.zoom - length) / 2);
    return Math.min(Math.max(at, -slack), length + slack);
  };
  return { zoom: view.zoom, x: hold(view.x, image.w, pane.w), y: hold(view.y, image.h, pane.h) };
}
