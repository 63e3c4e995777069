// Which images there are, by what a reader chooses: scene, filter, pattern, samples per pixel and trial.
import type { ReportImage } from "../schema";

export const kFacets = ["scene", "filter", "source", "spp", "trial"] as const;
export type Facet = (typeof kFacets)[number];

/** What of a shot is shown. */
export type Show = "value" | "error" | "spectrum" | "structured" | "noise";

/**
 * One case: the exact image of a scene under a filter, a pattern's reconstruction of it, or the spectra of its errors.
 * `source` is "exact" or the pattern with its layout and estimator; `spp` and `trial` are "" where there is none.
 */
export interface Shot extends Record<Facet, string> {
  id: string; // of its first image; what permalinks say
  exact?: ReportImage;
  error?: ReportImage;
  spectrum?: ReportImage;
  structured?: ReportImage;
  noise?: ReportImage;
}

export function isSpectral(shot: Shot): boolean {
  return (shot.spectrum ?? shot.structured ?? shot.noise) !== undefined;
}

/** What can be shown of a shot, the best first. */
export function shows(shot: Shot): Show[] {
  const list: Show[] = [];
  if (shot.exact !== undefined) list.push("value");
  if (shot.error !== undefined) list.push("error");
  for (const kind of ["spectrum", "structured", "noise"] as const) if (shot[kind] !== undefined) list.push(kind);
  return list;
}

/** One image of the shot: for its size and its names. */
export function anyImage(shot: Shot): ReportImage {
  return (shot.error ?? shot.exact ?? shot.spectrum ?? shot.structured ?? shot.noise)!;
}

/** In words, without the scene: "jittered, 16 samples, box". */
export function titleOf(shot: Shot): string {
  const samples = shot.spp === "" ? "" : `, ${shot.spp} ${shot.spp === "1" ? "sample" : "samples"}`;
  return `${shot.source}${samples}, ${shot.filter}`;
}

export function shotsOf(images: readonly ReportImage[]): Shot[] {
  const exact = new Map(images.filter((image) => image.kind === "exact").map((image) => [image.id, image]));
  const shots = new Map<string, Shot>();
  for (const image of images) {
    const facets = {
      scene: image.scene,
      filter: image.filter,
      source: sourceOf(image),
      spp: image.spp === undefined ? "" : String(image.spp),
      trial: image.trial === undefined ? "" : String(image.trial),
    };
    // An exact image and a pattern's error are cases of their own; the three spectra of one case belong together.
    const key = image.kind === "exact" || image.kind === "error" ? image.id : JSON.stringify(facets);
    const shot: Shot = shots.get(key) ?? { id: image.id, ...facets };
    shot[image.kind] = image;
    if (image.kind === "error" && image.of !== undefined) {
      const of = exact.get(image.of);
      if (of !== undefined) shot.exact = of;
    }
    shots.set(key, shot);
  }
  return [...shots.values()].sort(exactFirst);
}

/** The values of a facet among shots that agree with `shot` in the facets before it; numbers ascend. */
export function optionsOf(shots: readonly Shot[], shot: Shot, facet: Facet): string[] {
  const before = kFacets.slice(0, kFacets.indexOf(facet));
  const values = new Set<string>();
  for (const other of shots) if (before.every((f) => other[f] === shot[f])) values.add(other[facet]);
  const list = [...values];
  if (facet === "spp" || facet === "trial") list.sort((a, b) => Number(a) - Number(b));
  return list;
}

/**
 * The shot with facet = value that is most like `shot`: it agrees in the facets before, and in as many of those behind,
 * in their order, as there is a shot for. `remember` stands in for the number of samples that an exact image lacks.
 */
export function withFacet(shots: readonly Shot[], shot: Shot, facet: Facet, value: string, remember?: Shot): Shot {
  const at = kFacets.indexOf(facet);
  const wanted = { ...shot, [facet]: value };
  if (shot.spp === "" && remember !== undefined) wanted.spp = remember.spp;
  let best = shot;
  let bestScore = -1;
  for (const other of shots) {
    if (kFacets.slice(0, at + 1).some((f) => other[f] !== wanted[f])) continue;
    let score = 0;
    for (const f of kFacets) score = 2 * score + (other[f] === wanted[f] ? 1 : 0);
    if (score > bestScore) [best, bestScore] = [other, score];
  }
  return best;
}

function sourceOf(image: ReportImage): string {
  if (image.kind === "exact") return "exact";
  const layout = image.layout === undefined || image.layout === "pixel" ? "" : ` over the ${image.layout}`;
  const estimator = image.estimator === undefined || image.estimator === "ratio" ? "" : `, ${image.estimator}`;
  return `${image.pattern ?? "?"}${layout}${estimator}`;
}

/** Exact images head the lists of sources; all else keeps the study's order. */
function exactFirst(a: Shot, b: Shot): number {
  return Number(b.source === "exact") - Number(a.source === "exact");
}
