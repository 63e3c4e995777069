// The numbers under the pointer or the crosshair, of A, of B and of their difference.
import { el } from "../dom";
import { differenceOf, errorAt, exactOf, fieldOf, isPower, valueAt } from "./field";
import { frequencyAt, frequencyText } from "./frequency";
import type { Picture } from "./pictures";
import type { Show } from "./catalogue";
import { known } from "./numbers";
import { setText } from "./update";

/** What is asked about: the pixel, A and B, and what is shown of them. */
export interface Question {
  x: number;
  y: number;
  a: Picture;
  b: Picture;
  showA: Show;
  showB: Show;
}

interface Row {
  name: string;
  cells: [number | undefined, number | undefined, number | undefined]; // A, B, B - A
  uncertain: [number, number, number]; // what storing may have changed in each; 0: nothing that six digits show
}

/** Errors and powers are stored with 11 digits of two. */
const kHalfUlp = 2 ** -11;
/** So a ratio of powers is off by 2^-10 of itself: 10 lg(1 + 2^-10) dB. */
const kDecibels = 0.0042;

const kColumns = ["a", "b", "difference"] as const;

export class Readout {
  readonly element: HTMLElement;
  #place = el("caption", { "data-testid": "readout-place" });
  #heads = ["A", "B", "B \u2212 A"].map((name) => el("th", { scope: "col" }, name));
  #body = el("tbody");

  /** `names`: the rows there will be, so that nothing moves when somebody points. */
  constructor(names: readonly string[]) {
    const head = el("tr", {}, el("td"), ...this.#heads);
    this.element = el(
      "table",
      { class: "v-table", "data-testid": "readout" },
      this.#place,
      el("thead", {}, head),
      this.#body,
    );
    for (const name of names) setText(this.#newRow().cells[0]!, name);
  }

  /** None: nobody points at an image. */
  update(question: Question | undefined): void {
    if (question === undefined) {
      setText(this.#place, "Point at a pixel, or move the crosshair with H J K L");
      for (const cell of this.#body.querySelectorAll("td")) {
        setText(cell, "");
        delete cell.dataset["value"];
      }
      return;
    }
    setText(this.#place, placeOf(question));
    const power = isPower(question.showB);
    const heads = power ? ["Power of A", "Power of B", "B over A, dB"] : ["A", "B", "B \u2212 A"];
    this.#heads.forEach((head, c) => setText(head, heads[c]!));
    const rows = rowsOf(question);
    while (this.#body.rows.length > rows.length) this.#body.deleteRow(-1);
    rows.forEach((row, r) => {
      const line = this.#body.rows[r] ?? this.#newRow();
      setText(line.cells[0]!, row.name);
      row.cells.forEach((value, c) => {
        const cell = line.cells[c + 1]!;
        setText(cell, value === undefined ? "" : known(value, row.uncertain[c]!));
        cell.dataset["testid"] = `readout-${kColumns[c]}-${row.name}`;
        if (value === undefined) delete cell.dataset["value"];
        else cell.dataset["value"] = String(value);
      });
    });
  }

  #newRow(): HTMLTableRowElement {
    const row = el("tr", {}, el("th", { scope: "row" }), el("td"), el("td"), el("td"));
    this.#body.append(row);
    return row;
  }
}

/** In one sentence, for screen readers. */
export function spoken(question: Question): string {
  const parts = rowsOf(question)
    .filter((row) => row.name !== "exact")
    .map(({ name, cells, uncertain }) => {
      const [a, b] = [0, 1].map((c) => (cells[c] === undefined ? "none" : known(cells[c], uncertain[c]!)));
      return `${name}: A ${a}, B ${b}`;
    });
  return `${placeOf(question)}. ${parts.join(". ")}`;
}

function placeOf({ x, y, a, showB }: Question): string {
  if (!isPower(showB)) return `Pixel ${x}, ${y}`;
  const { fx, fy } = frequencyAt(a, x, y);
  return `Frequency ${frequencyText(a, x, y)}: ${Math.hypot(fx, fy).toFixed(4)} cycles per pixel`;
}

function rowsOf({ x, y, a, b, showA, showB }: Question): Row[] {
  const within = (p: Picture) => (x >= 0 && y >= 0 && x < p.w && y < p.h ? x + p.w * y : undefined);
  const [i, j] = [within(a), within(b)];
  const both = (of: (p: Picture, i: number) => number | undefined) =>
    [i === undefined ? undefined : of(a, i), j === undefined ? undefined : of(b, j)] as const;
  const less = (showOfA: Show, showOfB: Show) =>
    i === undefined || j === undefined ? undefined : differenceOf(a, b, showOfA, showOfB)?.at(i);
  if (isPower(showA) || isPower(showB)) {
    const powers = [
      i === undefined ? undefined : fieldOf(a, showA).at(i),
      j === undefined ? undefined : fieldOf(b, showB).at(j),
    ] as const;
    return [
      {
        name: "power",
        cells: [...powers, less(showA, showB)],
        uncertain: [kHalfUlp * (powers[0] ?? 0), kHalfUlp * (powers[1] ?? 0), kDecibels],
      },
    ];
  }
  const errors = both(errorAt);
  const [ofA, ofB] = [kHalfUlp * Math.abs(errors[0] ?? 0), kHalfUlp * Math.abs(errors[1] ?? 0)];
  const uncertain: Row["uncertain"] = [ofA, ofB, ofA + ofB];
  const exact = both((p, k) => exactOf(p)?.at(k));
  const exactDifference = exact[0] === undefined || exact[1] === undefined ? undefined : exact[1] - exact[0];
  const rows: Row[] = [];
  if (a.exact !== undefined || b.exact !== undefined) {
    rows.push({
      name: "value",
      cells: [...both((p, k) => (p.exact === undefined ? undefined : valueAt(p, k))), less("value", "value")],
      uncertain,
    });
    rows.push({ name: "exact", cells: [...exact, exactDifference], uncertain: [0, 0, 0] });
  }
  rows.push({ name: "error", cells: [...errors, less("error", "error")], uncertain });
  return rows;
}
