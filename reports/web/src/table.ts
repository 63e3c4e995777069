// Sortable tables: a value and its interval in one cell, filters by the columns that name things, CSV of what is shown.
import { button, el } from "./dom";
import type { Child } from "./dom";
import type { Row, Table } from "./run_data";
import { distinct, num, str } from "./run_data";
import { csvText, download } from "./save";
import { breakable, columnFormat, heading, interval, number } from "./text";

export interface TableColumn {
  title: string;
  numeric: boolean;
  sort: (row: Row) => number | string;
  cell: (row: Row, write: Write) => Child;
  number?: (row: Row) => number; // what `write` of its cells is made for; without it four digits
  hint?: string;
}

/** How a column writes a number. */
export type Write = (x: number) => string;

export interface TableOptions {
  name: string; // of the CSV file
  caption: string;
  columns: TableColumn[];
  filters?: string[]; // columns that a select each narrows
  sort?: { column: number; descending: boolean };
  tiny?: boolean; // its numbers are errors of rounding themselves: none is written as 0 for being small
  plain?: boolean; // no toolbar: a short table whose heading stands above it
}

const kLong = 48; // characters of a cell that is broken into lines
const kRows = 100; // at first; more on request

export function textColumn(name: string, title = heading(name)): TableColumn {
  const cell = (row: Row): Child => {
    const text = str(row, name);
    return text.length > kLong ? el("span", { class: "long" }, breakable(text)) : breakable(text);
  };
  return { title, numeric: false, sort: (row) => str(row, name), cell };
}

/** A number, with the interval of NAME_lo and NAME_hi where the row has it. */
export function numberColumn(name: string, title = heading(name), factor = 1, hint?: string): TableColumn {
  return {
    title,
    numeric: true,
    sort: (row) => num(row, name),
    number: (row) => num(row, name) * factor,
    cell: (row, write) => {
      const [lo, hi] = [num(row, `${name}_lo`) * factor, num(row, `${name}_hi`) * factor];
      return valueWithInterval(num(row, name) * factor, lo, hi, write);
    },
    ...(hint === undefined ? {} : { hint }),
  };
}

/** A count or another number that is written in full. */
export function countColumn(name: string, title = heading(name)): TableColumn {
  return { title, numeric: true, sort: (row) => num(row, name), cell: (row) => str(row, name) };
}

export function valueWithInterval(value: number, lo: number, hi: number, write: Write = number): Child {
  if (!Number.isFinite(lo) || !Number.isFinite(hi)) return write(value);
  return el("span", {}, write(value), " ", el("span", { class: "interval" }, interval(lo, hi, write)));
}

/** A time of NAME in nanoseconds, in the unit that suits the largest of the table. */
export function timeColumn(table: Table, name: string, title?: string): TableColumn {
  const most = table.rows.reduce((least, row) => Math.max(least, num(row, name) || 0), 0);
  const [unit, factor] = (most >= 1e9 ? ["s", 1e-9] : most >= 1e6 ? ["ms", 1e-6] : ["µs", 1e-3]) as [string, number];
  return numberColumn(name, `${title ?? heading(name.replace(/_ns$/, ""))}, ${unit}`, factor);
}

/** Those of the wanted columns that the table has and that say something, in the wanted order: [name, heading]. */
export function chosenColumns(table: Table, wanted: readonly (readonly [string, string?])[]): TableColumn[] {
  const own = new Set(table.columns);
  return wanted.flatMap(([name, title]) => {
    if (!own.has(name)) return [];
    const [column] = plainColumns({ columns: own.has(`${name}_lo`) ? [name, `${name}_lo`] : [name], rows: table.rows });
    return column === undefined ? [] : [title === undefined ? column : { ...column, title }];
  });
}

/** What a reader of a table seldom asks for; the CSV has it. */
const kAside = /^(seed|width|height|(.*_)?ci_method|.*_(deviation|least|most)(_pixel|_sample)?_ns)$/;

/** Columns for a table that the page knows nothing about: intervals join their values, what is empty is left out. */
export function plainColumns(table: Table): TableColumn[] {
  const names = new Set(table.columns);
  const columns: TableColumn[] = [];
  for (const name of table.columns) {
    const base = name.replace(/_(lo|hi)$/, "");
    if ((base !== name && names.has(base)) || kAside.test(name)) continue;
    const cells = table.rows.map((row) => row[name]);
    if (cells.every((cell) => cell === null || cell === "")) continue;
    const numeric = cells.some((cell) => typeof cell === "number");
    const whole = numeric && cells.every((cell) => cell === null || Number.isInteger(cell));
    if (numeric && name.endsWith("_ns")) {
      columns.push(timeColumn(table, name));
      continue;
    }
    columns.push(
      !numeric ? textColumn(name) : whole && !names.has(`${name}_lo`) ? countColumn(name) : numberColumn(name),
    );
  }
  return columns;
}

/** The columns of a table that name what a row is about and have few values: good to narrow it by. */
export function narrowing(table: Table, wanted: readonly string[]): string[] {
  return wanted.filter((name) => {
    if (!table.columns.includes(name)) return false;
    return distinct(table.rows.map((row) => str(row, name))).length > 1;
  });
}

/** The table in its scrolling frame, with its filters, its count of rows and its CSV. */
export function sortableTable(table: Table, options: TableOptions): HTMLElement {
  let sort = options.sort;
  let shown = kRows;
  const chosen = new Map<string, string>();
  const body = el("tbody", {});
  const status = el("span", { class: "status", role: "status" });
  const more = button("Show all rows", { class: "quiet" }, () => {
    shown = Infinity;
    fill();
  });
  const writes = options.columns.map(({ number: of }) =>
    of === undefined ? number : columnFormat(table.rows.map(of), options.tiny),
  );
  const headers = options.columns.map((column, i) => {
    const arrow = el("span", { class: "arrow", "aria-hidden": true });
    const press = button("", { class: "sort", title: column.hint }, () => {
      sort = { column: i, descending: sort?.column === i ? !sort.descending : false };
      fill();
    });
    // Numbers end where their heading does.
    press.append(...(column.numeric ? [arrow, column.title] : [column.title, arrow]));
    return el("th", { scope: "col", class: column.numeric ? "number" : undefined }, press);
  });

  const rows = (): Row[] => {
    const kept = table.rows.filter((row) => [...chosen].every(([name, value]) => str(row, name) === value));
    const by = sort === undefined ? undefined : options.columns[sort.column];
    if (sort === undefined || by === undefined) return kept;
    const sign = sort.descending ? -1 : 1;
    return kept
      .map((row) => ({ row, key: by.sort(row) }))
      .sort((a, b) => {
        // Missing numbers stand last in both orders.
        if (typeof a.key === "number" && typeof b.key === "number") {
          if (Number.isNaN(a.key) || Number.isNaN(b.key))
            return Number(Number.isNaN(a.key)) - Number(Number.isNaN(b.key));
          return sign * (a.key - b.key);
        }
        return sign * String(a.key).localeCompare(String(b.key), "en", { numeric: true });
      })
      .map(({ row }) => row);
  };

  const fill = (): void => {
    const all = rows();
    headers.forEach((header, i) => {
      const here = sort?.column === i;
      header.setAttribute("aria-sort", here ? (sort?.descending ? "descending" : "ascending") : "none");
    });
    body.replaceChildren(
      ...all
        .slice(0, shown)
        .map((row) =>
          el(
            "tr",
            {},
            ...options.columns.map((column, i) =>
              el("td", { class: column.numeric ? "number" : undefined }, column.cell(row, writes[i] ?? number)),
            ),
          ),
        ),
    );
    status.textContent = all.length <= shown ? `${all.length} rows` : `${shown} of ${all.length} rows`;
    more.hidden = all.length <= shown;
  };

  const selects = (options.filters ?? []).map((name) => {
    const select = el("select", {}, el("option", { value: "" }, "all"));
    for (const value of distinct(table.rows.map((row) => str(row, name))))
      select.append(el("option", { value }, value || "none"));
    select.addEventListener("change", () => {
      if (select.value === "") chosen.delete(name);
      else chosen.set(name, select.value);
      fill();
    });
    return el("label", { class: "control" }, el("span", {}, heading(name)), select);
  });
  const save = button(
    "CSV",
    { class: "quiet", "aria-label": `Save the table ${options.caption} as CSV`, "data-testid": "save-table" },
    () => {
      const cells = rows().map((row) => table.columns.map((name) => row[name]));
      download(`${options.name}.csv`, "text/csv", csvText([table.columns, ...cells]));
    },
  );
  fill();
  const frame = el(
    "div",
    { class: "scroll", tabindex: 0, role: "region", "aria-label": options.caption },
    el(
      "table",
      {},
      el("caption", { class: "unseen" }, options.caption),
      el("thead", {}, el("tr", {}, ...headers)),
      body,
    ),
  );
  const shade = (): void => {
    frame.classList.toggle("more-left", frame.scrollLeft > 1);
    frame.classList.toggle("more-right", frame.scrollLeft + frame.clientWidth < frame.scrollWidth - 1);
  };
  frame.addEventListener("scroll", shade, { passive: true });
  new ResizeObserver(shade).observe(frame);
  const bar = options.plain
    ? el("div", { class: "toolbar" }, el("span", { class: "grow" }), more, save)
    : el(
        "div",
        { class: "toolbar" },
        el("h3", {}, options.caption),
        ...selects,
        el("span", { class: "grow" }),
        status,
        more,
        save,
      );
  return el(
    "div",
    { class: "table", "data-testid": `table-${options.name}` },
    ...(options.plain ? [frame, bar] : [bar, frame]),
  );
}
