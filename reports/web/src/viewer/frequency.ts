// Where a pixel of a spectrum lies: frequency 0 is pixel (w / 2, h / 2), and w pixels span one cycle per pixel.
import { short } from "./numbers";
import type { Size } from "./view";

/** Of the pixel (x, y), in cycles per pixel; y points down as in images. */
export function frequencyAt({ w, h }: Size, x: number, y: number): { fx: number; fy: number } {
  return { fx: (x - Math.floor(w / 2)) / w, fy: (y - Math.floor(h / 2)) / h };
}

/** The pixel that stands for a frequency, with its fraction; 1/2 is also -1/2, the first column or row. */
export function pixelOf({ w, h }: Size, fx: number, fy: number): { x: number; y: number } {
  const wrapped = (at: number, length: number) => ((at % length) + length) % length;
  return { x: wrapped(Math.floor(w / 2) + fx * w, w), y: wrapped(Math.floor(h / 2) + fy * h, h) };
}

export function frequencyText(size: Size, x: number, y: number): string {
  const { fx, fy } = frequencyAt(size, x, y);
  return `${short(fx)}, ${short(fy)}`;
}
