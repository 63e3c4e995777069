// The numbers of shots, decoded when somebody looks at them; those not looked at for long are let go.
import { decodePixels } from "../decode";
import type { ReportImage } from "../schema";
import { anyImage, type Shot } from "./catalogue";

/** Row by row from the top; `error` is absent of an exact image, `exact` where the page does not hold it. */
export interface Picture {
  shot: Shot;
  w: number;
  h: number;
  exact?: Float32Array;
  error?: Float32Array;
  spectrum?: Float32Array;
  structured?: Float32Array;
  noise?: Float32Array;
}

/** What decoded images may take: 250 of 256 x 256 pixels. */
const kMostBytes = 64 << 20;

export class Pictures {
  #images = new Map<string, { pixels: Promise<Float32Array>; bytes: number }>(); // in order of last use
  #bytes = 0;

  /** All that is needed to show the shot in any way. Rejects where an image's data are damaged. */
  async load(shot: Shot): Promise<Picture> {
    const { w, h } = anyImage(shot).pixels;
    const picture: Picture = { shot, w, h };
    await Promise.all(
      (["exact", "error", "spectrum", "structured", "noise"] as const).map(async (kind) => {
        const image = shot[kind];
        if (image === undefined) return;
        if (image.pixels.w !== w || image.pixels.h !== h) throw new Error(`${image.id}: not of the size of ${shot.id}`);
        picture[kind] = await this.#pixels(image);
      }),
    );
    return picture;
  }

  #pixels(image: ReportImage): Promise<Float32Array> {
    let entry = this.#images.get(image.id);
    if (entry === undefined) {
      const pixels = decodePixels(image.pixels).catch((error: unknown) => {
        throw new Error(`${image.id}: ${error instanceof Error ? error.message : String(error)}`);
      });
      entry = { pixels, bytes: 4 * image.pixels.w * image.pixels.h };
      this.#bytes += entry.bytes;
    }
    this.#images.delete(image.id);
    this.#images.set(image.id, entry);
    for (const [id, old] of this.#images) {
      if (this.#bytes <= kMostBytes || id === image.id) break;
      this.#images.delete(id);
      this.#bytes -= old.bytes;
    }
    return entry.pixels;
  }
}
