// Files that the reader takes away: charts as SVG that stands alone, tables and charts as CSV.

import { svgEl } from "./dom";

/** The light theme's values of the variables that charts use, from style.css: a file follows no theme. */
function lightVariables(): Map<string, string> {
  const values = new Map<string, string>();
  for (const sheet of document.styleSheets) {
    for (const rule of sheet.cssRules) {
      if (!(rule instanceof CSSStyleRule) || rule.selectorText !== ":root") continue;
      for (const name of rule.style) {
        if (name.startsWith("--")) values.set(name, rule.style.getPropertyValue(name).trim());
      }
    }
  }
  return values;
}

/**
 * The chart as a file: white ground, light colours, its fonts named, and nothing that belongs to the page. The title
 * stands above the chart in `room` pixels.
 */
export function standaloneSvg(chart: SVGSVGElement, title: string, room: number): string {
  const svg = chart.cloneNode(true) as SVGSVGElement;
  svg.querySelectorAll("style").forEach((style) => style.remove());
  svg.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  svg.setAttribute("style", "background: #ffffff; color: #16191d; font-family: system-ui, sans-serif; font-size: 12px");
  svg.setAttribute("role", "img");
  svg.removeAttribute("class");
  for (const element of svg.querySelectorAll("*")) {
    for (const name of ["tabindex", "data-series", "class", "role", "aria-hidden"]) element.removeAttribute(name);
    if (element.tagName !== "g") element.removeAttribute("aria-label");
  }
  const { width, height } = { width: chart.width.baseVal.value, height: chart.height.baseVal.value + room };
  svg.setAttribute("height", String(height));
  svg.setAttribute("viewBox", `0 ${-room} ${width} ${height}`);
  const box = { x: 0, y: -room, width, height, fill: "#ffffff" };
  const heading = { x: width / 2, y: 18 - room, fill: "#16191d", "text-anchor": "middle", "font-weight": 600 };
  svg.prepend(svgEl("title", {}, title), svgEl("rect", box), svgEl("text", { ...heading, "font-size": 13 }, title));
  const light = lightVariables();
  const text = new XMLSerializer().serializeToString(svg);
  return text.replace(/var\((--[a-z0-9-]+)\)/g, (whole, variable: string) => light.get(variable) ?? whole);
}

/** Quoted as RFC 4180 says; lines end in LF as those of summary.csv; a number in full, a missing one empty. */
export function csvText(rows: readonly (readonly (string | number | boolean | null | undefined)[])[]): string {
  const field = (cell: string | number | boolean | null | undefined): string => {
    if (cell === null || cell === undefined || (typeof cell === "number" && !Number.isFinite(cell))) return "";
    const text = String(cell);
    return /[",\r\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
  };
  return rows.map((row) => row.map(field).join(",") + "\n").join("");
}

export function download(name: string, type: string, text: string): void {
  const url = URL.createObjectURL(new Blob([text], { type }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
