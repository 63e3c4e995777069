// What the run's tables say of an image: its error, and the peak of its spectrum.
import { column, unpack } from "../decode";
import type { Cell, RadialSpectrum, Run } from "../schema";
import type { Shot } from "./catalogue";
import type { Notes } from "./compose";
import { pixelOf } from "./frequency";
import { rounded, short } from "./numbers";
import type { Ring } from "./pane";

/** `changed` is called when the tables have been unpacked; until then nothing is said. */
export function notesOf(run: Run, changed: () => void): Notes {
  let rmse: Cell[] = [];
  let spectra: RadialSpectrum[] = [];
  const table = run.tables["image_rows"];
  if (table !== undefined) {
    void unpack(table).then((rows) => {
      rmse = column(rows, "rmse_active");
      changed();
    });
  }
  if (run.radial_spectra !== undefined) {
    void unpack(run.radial_spectra).then((list) => {
      spectra = list;
      changed();
    });
  }
  const rmseOf = (shot: Shot) => {
    const row = shot.error?.row;
    const value = row === undefined ? undefined : rmse[row];
    return typeof value === "number" ? value : undefined;
  };
  const peakOf = (shot: Shot) => {
    const image = shot.spectrum ?? shot.structured ?? shot.noise;
    if (image === undefined) return undefined;
    return spectra.find(
      (s) =>
        s.scene === image.scene &&
        s.filter === image.filter &&
        s.pattern === image.pattern &&
        s.spp === image.spp &&
        s.layout === (image.layout ?? "pixel") &&
        s.estimator === (image.estimator ?? "ratio"),
    )?.peak;
  };
  return {
    rmse: rmseOf,
    text(shot: Shot): string {
      const value = rmseOf(shot);
      if (value !== undefined) return `RMSE ${rounded(value)} (active pixels)`;
      const peak = peakOf(shot);
      if (peak === undefined) return "";
      if (!peak.significant) return "no significant peak";
      // JSON has null where the program had no number.
      const height = Number.isFinite(peak.height_db) ? ` ${rounded(peak.height_db)} dB over the power around it` : "";
      return `strongest peak${height} at (${short(peak.fx)}, ${short(peak.fy)}) cycles per pixel`;
    },
    /** An image is real, so its power at (fx, fy) is that at (-fx, -fy): both are marked. A peak that chance explains is
     * none. */
    rings(shot: Shot): Ring[] {
      const pixels = (shot.spectrum ?? shot.structured ?? shot.noise)?.pixels;
      const peak = peakOf(shot);
      if (pixels === undefined || peak === undefined || !peak.significant) return [];
      return [1, -1].map((sign) => pixelOf(pixels, sign * peak.fx, sign * peak.fy));
    },
  };
}
