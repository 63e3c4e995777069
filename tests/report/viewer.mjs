// What the tests of the viewer share: choosing by the address, waiting, and reading pixels and numbers off it.

/** Chooses what the address says, key by key ("mode", "a", ...), and waits until it is shown. */
export async function look(page, choices, kind = "image") {
  const pairs = Object.entries(choices).map(([key, value]) => `${kind}.${key}=${encodeURIComponent(value)}`);
  await page.evaluate((hash) => (location.hash = hash), `#${pairs.join("&")}`);
  await settled(page, kind);
}

/** Waits until the viewer shows what is chosen. A window behind another is not drawn: this one comes to the front. */
export async function settled(page, kind = "image") {
  await page.bringToFront();
  await page.evaluate(async (testid) => {
    const frames = async (n) => {
      for (let i = 0; i < n; ++i) await new Promise(requestAnimationFrame);
    };
    await frames(3); // an event of the address, the answer to it, and the drawing
    const viewer = document.querySelector(`[data-testid="${testid}"]`);
    while (viewer.getAttribute("aria-busy") !== "false") await frames(1);
    await frames(2);
  }, `${kind}-viewer`);
}

export function part(page, testid, kind = "image") {
  return page.locator(`[data-testid="${kind}-viewer"] [data-testid="${testid}"]`);
}

/** The number behind a cell, all digits; NaN where it is empty. */
export async function number(page, testid, kind = "image") {
  const text = await part(page, testid, kind).getAttribute("data-value");
  return text === null ? NaN : Number(text);
}

/** Where the image lies in a canvas that shows all of it: device pixels. By definition, not as the page does it. */
export function fitted(canvas, image) {
  const zoom = Math.floor(Math.min(canvas.w / image.w, canvas.h / image.h));
  return {
    zoom,
    x: Math.round(canvas.w / 2 - (zoom * image.w) / 2),
    y: Math.round(canvas.h / 2 - (zoom * image.h) / 2),
  };
}

export function canvasSize(page, testid, kind = "image") {
  return part(page, testid, kind).evaluate((canvas) => ({ w: canvas.width, h: canvas.height }));
}

/** The colour in the middle of the image's pixel (x, y) in a canvas that shows all of it: [red, green, blue]. */
export async function colourAt(page, testid, image, x, y, kind = "image") {
  const { zoom, x: left, y: top } = fitted(await canvasSize(page, testid, kind), image);
  const at = [Math.floor(left + (x + 0.5) * zoom), Math.floor(top + (y + 0.5) * zoom)];
  return (await pixels(page, testid, [...at, 1, 1], kind))[0];
}

/** The colours of a rectangle [x, y, width, height] of a canvas, through a copy: reading the page's own slows it. */
export function pixels(page, testid, rectangle, kind = "image") {
  return part(page, testid, kind).evaluate((canvas, [x, y, w, h]) => {
    const copy = new OffscreenCanvas(w, h).getContext("2d", { willReadFrequently: true });
    copy.drawImage(canvas, x, y, w, h, 0, 0, w, h);
    const { data } = copy.getImageData(0, 0, w, h);
    return Array.from({ length: w * h }, (_, i) => [...data.slice(4 * i, 4 * i + 3)]);
  }, rectangle);
}

/** Where that pixel's middle lies on the screen, once the canvas has been brought into the middle of it. */
export async function screenPlace(page, testid, image, x, y, kind = "image") {
  await part(page, testid, kind).evaluate((element) =>
    element.scrollIntoView({ block: "center", behavior: "instant" }),
  );
  const canvas = await canvasSize(page, testid, kind);
  const { zoom, x: left, y: top } = fitted(canvas, image);
  const box = await part(page, testid, kind).boundingBox();
  return {
    x: box.x + ((left + (x + 0.5) * zoom) * box.width) / canvas.w,
    y: box.y + ((top + (y + 0.5) * zoom) * box.height) / canvas.h,
  };
}

/** All pixels of a canvas, as a text that differs where they do. */
export function fingerprint(page, testid, kind = "image") {
  return part(page, testid, kind).evaluate((canvas) => canvas.toDataURL());
}

/** IEC 61966-2-1: linear to a code of 8 bits. */
export function srgb(linear) {
  const v = Math.min(Math.max(linear, 0), 1);
  return Math.floor(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055) + 0.5);
}
