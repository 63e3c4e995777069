// The images: reconstructions and their errors beside the exact ones, in the viewer.
import type { Section } from "../page";
import { mountViewer } from "../viewer/viewer";

const kKinds = new Set(["exact", "error"]);

export const images: Section = {
  id: "images",
  title: () => "Images",
  lead: (data) =>
    data.run.images.some((image) => kKinds.has(image.kind))
      ? ["Two images at a time, with the same zoom, exposure and colours; the exact image is always at hand."]
      : ["This page holds none of the run's images."],
  present: (data) => data.run.images.some((image) => kKinds.has(image.kind)) || data.leftOut("images").length > 0,

  render(host, page) {
    const shown = page.data.run.images.filter((image) => kKinds.has(image.kind));
    const left_out = page.data.leftOut("images");
    mountViewer(host, shown, { run: page.data.run, state: page.state, left_out });
  },
};
