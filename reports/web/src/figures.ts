// Figures for papers: every chart of every run as SVG text in the page itself, for `moire report --figures` to cut out.
import { figureSvg } from "./chart_card";
import { el } from "./dom";
import type { Page, Section } from "./page";
import { slug } from "./text";

/** Appends the script `moire-figures` with [{name, svg}]. Names are unique: of several runs they begin with
 * the run's id, and a second of one name is NAME-2. */
export async function writeFigures(pages: Page[], sections: Section[]): Promise<void> {
  const figures: { name: string; svg: string }[] = [];
  const used = new Map<string, number>();
  for (const page of pages) {
    for (const section of sections) {
      if (!section.present(page.data) || section.figures === undefined) continue;
      for (const { spec, styles } of await section.figures(page)) {
        // Of several runs the name says which.
        const wanted = pages.length > 1 ? `${slug(page.data.run.id)}_${spec.name}` : spec.name;
        const times = (used.get(wanted) ?? 0) + 1;
        used.set(wanted, times);
        const name = times === 1 ? wanted : `${wanted}-${times}`;
        figures.push({ name, svg: figureSvg(spec, styles) });
      }
    }
  }
  const json = JSON.stringify(figures).replace(/</g, "\\u003c").replace(/>/g, "\\u003e").replace(/&/g, "\\u0026");
  document.body.append(el("script", { type: "application/json", id: "moire-figures" }, json));
}
