// The frame of the page: header, run switch, the bar of sections, and sections that are drawn when they come near.
import { stayAt } from "./arrival";
import { Choice } from "./controls";
import { button, el } from "./dom";
import type { Page, Section } from "./page";
import type { Report } from "./schema";
import type { PageState } from "./state";
import type { Theme } from "./theme";

const kNear = "700px"; // from the window's edges: drawn before it is seen

const kPatience = 3000; // ms: a busy page, too, is complete some time

export class Shell {
  readonly header: HTMLElement;
  readonly nav: HTMLElement;
  readonly #links = el("ul", {});
  #waiting = new Map<HTMLElement, () => Promise<void>>();
  #near: IntersectionObserver | undefined;
  #leave: (() => void) | undefined; // ends the stay at a section

  constructor(
    report: Report,
    private readonly root: HTMLElement,
    private readonly state: PageState,
    theme: Theme,
    private readonly sections: Section[],
  ) {
    const runs = report.runs.map((run) => ({
      value: run.id,
      label: run.header.study.name === run.id ? run.id : `${run.id}: ${run.header.study.name}`,
    }));
    const themes = button("", { class: "quiet", "data-testid": "theme" }, () => theme.toggle());
    const name = (): void => {
      themes.textContent = theme.dark ? "Light theme" : "Dark theme";
    };
    name();
    theme.onChange(name);
    this.header = el(
      "header",
      {},
      el("a", { class: "skip", href: "#main" }, "Skip to the results"),
      el("h1", {}, report.title),
      el("span", { class: "grow" }),
      runs.length > 1 && new Choice(state, "run", "Run", runs).control(() => undefined),
      themes,
    );
    this.header.querySelector(".skip")?.addEventListener("click", (event) => {
      event.preventDefault(); // the address holds the reader's choices
      this.root.querySelector<HTMLElement>("h2")?.focus();
    });
    this.nav = el("nav", { "aria-label": "Sections" }, this.#links);
    addEventListener("beforeprint", () => void this.#drawAll());
    addEventListener("hashchange", () => void this.#goTo(state.get("section")));
    addEventListener("scroll", () => this.#markHere(), { passive: true });
  }

  /** Shows that run in place of the one before. */
  show(page: Page): void {
    const first = this.#near === undefined;
    this.#near?.disconnect();
    this.#waiting = new Map();
    const near = new IntersectionObserver(
      (entries) => {
        for (const entry of entries) if (entry.isIntersecting) void this.#draw(entry.target as HTMLElement);
      },
      { rootMargin: kNear },
    );
    this.#near = near;

    const present = this.sections.filter((section) => section.present(page.data));
    this.#links.replaceChildren(
      ...present.map((section) => {
        const link = el("a", { href: `#section=${section.id}`, "data-section": section.id }, section.title(page.data));
        link.addEventListener("click", (event) => {
          event.preventDefault(); // the address keeps the other choices
          this.state.set("section", section.id);
          void this.#goTo(section.id); // again, too, where the choice is the same
        });
        return el("li", {}, link);
      }),
    );
    this.root.replaceChildren(
      ...present.map((section) => {
        const body = el("div", { class: "body waiting" });
        const lead = section.lead(page.data);
        const element = el(
          "section",
          { id: section.id, "aria-labelledby": `${section.id}-title` },
          el("h2", { id: `${section.id}-title`, tabindex: -1 }, section.title(page.data)),
          lead.length > 0 && el("p", { class: "lead" }, ...lead),
          body,
        );
        this.#waiting.set(element, async () => {
          // Its room is kept until it is drawn: a page that shrinks in between loses the reader's place.
          try {
            await section.render(body, page);
          } finally {
            body.classList.remove("waiting");
          }
        });
        return element;
      }),
    );
    for (const element of this.#waiting.keys()) near.observe(element);
    // A link names a section; whoever switches runs stays where they are.
    if (first) void this.#goTo(this.state.get("section"));
    this.#markHere();
    this.#drawWhenIdle();
  }

  /** The rest, one section at a time: printing and finding in the page want all of it. */
  #drawWhenIdle(): void {
    const [next] = this.#waiting.keys();
    if (next === undefined) return;
    requestIdleCallback(() => void this.#draw(next).then(() => this.#drawWhenIdle()), { timeout: kPatience });
  }

  async #draw(section: HTMLElement): Promise<void> {
    const render = this.#waiting.get(section);
    if (render === undefined) return;
    this.#waiting.delete(section);
    this.#near?.unobserve(section);
    try {
      await render();
    } catch (error) {
      const text = error instanceof Error ? error.message : String(error);
      section.append(el("p", { class: "failure", role: "alert" }, `This section cannot be shown: ${text}.`));
      console.error(error);
    }
  }

  async #drawAll(): Promise<void> {
    await Promise.all([...this.#waiting.keys()].map((section) => this.#draw(section)));
  }

  /** Sections above it may still grow, so they are drawn first. */
  async #goTo(id: string | undefined): Promise<void> {
    const target = id === undefined ? null : this.root.querySelector<HTMLElement>(`section[id="${CSS.escape(id)}"]`);
    if (target === null) return;
    const all = [...this.root.children] as HTMLElement[];
    await Promise.all(all.slice(0, all.indexOf(target) + 1).map((section) => this.#draw(section)));
    this.#leave?.();
    this.#leave = stayAt(target, () => this.root.querySelector(".waiting") === null);
    target.querySelector("h2")?.focus({ preventScroll: true });
    this.#markHere();
  }

  /** The section that the window's upper third shows; the last one at the page's end, however short it is. */
  #markHere(): void {
    const sections = [...this.root.children] as HTMLElement[];
    const at_end = innerHeight + scrollY >= document.documentElement.scrollHeight - 2;
    const begun = sections.filter((section) => section.getBoundingClientRect().top < innerHeight / 3);
    const here = at_end ? sections.at(-1) : (begun.at(-1) ?? sections[0]);
    if (here !== undefined) this.#mark(here.id);
  }

  #mark(id: string): void {
    for (const link of this.#links.querySelectorAll("a")) {
      if (link.dataset["section"] === id) link.setAttribute("aria-current", "true");
      else link.removeAttribute("aria-current");
    }
  }
}
