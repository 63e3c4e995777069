// The viewer's look, on the variables of style.css. It comes with the viewer: pages without one do not carry it.

export const kViewerStyle = `
.viewer { margin: 12px 0 20px; font-size: 0.88rem; }
.viewer fieldset { margin: 0; padding: 0; border: 0; min-width: 0; }
.viewer [hidden] { display: none; }

.v-sides {
  display: grid; grid-template-columns: minmax(0, 1fr); gap: 6px 16px; align-items: center; margin-bottom: 8px;
}
@media (min-width: 1100px) {
  .v-sides { grid-template-columns: minmax(0, 1fr) auto; }
  .v-sides .v-between {
    grid-column: 2; grid-row: 1 / 3; flex-direction: column; align-items: start; max-width: 11rem; padding-left: 0;
  }
}
.viewer .v-side {
  display: flex; flex-wrap: wrap; align-items: center; gap: 4px 12px;
  padding: 5px 12px 5px 44px; position: relative;
  border: 1px solid var(--rule); border-radius: 8px; background: var(--raised);
}
.v-side legend {
  position: absolute; left: 12px; top: 50%; transform: translateY(-50%);
  padding: 0; font-size: 1.25rem; font-weight: 700;
}
.v-side label { display: flex; align-items: center; gap: 5px; min-width: 0; }
.v-side label span { color: var(--muted); font-size: 0.8rem; }
.v-side select { max-width: 10.5rem; min-width: 0; }
.v-side select:disabled { opacity: 1; color: var(--muted); background: transparent; }
.v-links { margin-left: auto; color: var(--muted); font-size: 0.82rem; }
.v-between {
  display: flex; max-width: 30rem; flex-wrap: wrap; gap: 6px 16px; align-items: center; padding-left: 44px;
}

.v-bar { display: flex; flex-wrap: wrap; align-items: center; gap: 8px 16px; margin-bottom: 10px; }
.v-bar > label { display: inline-flex; align-items: center; gap: 6px; color: var(--muted); }
.v-bar input[type="range"] { width: 8.5rem; accent-color: var(--accent); }
.v-bar button[aria-pressed="true"] { border-color: var(--accent); background: var(--accent-soft); }
.v-bar select:disabled { color: var(--muted); opacity: 1; text-decoration: line-through; }
.viewer .v-modes {
  display: inline-flex; flex-wrap: wrap; border: 1px solid var(--rule); border-radius: 6px; overflow: hidden;
}
.v-modes label { position: relative; cursor: pointer; }
.v-modes label + label { border-left: 1px solid var(--rule); }
.v-modes input { position: absolute; inset: 0; margin: 0; opacity: 0; cursor: pointer; }
.v-modes span { display: block; padding: 4px 11px; background: var(--surface); }
.v-modes input:checked + span { background: var(--accent-soft); box-shadow: inset 0 -2px 0 var(--accent); }
.v-modes label:focus-within span { outline: 2px solid var(--accent); outline-offset: -2px; border-radius: 4px; }
.v-number { display: inline-block; min-width: 4.2em; font-variant-numeric: tabular-nums; color: var(--text); }
.v-zoom { display: inline-flex; align-items: center; gap: 4px; }
.v-zoom .v-number { min-width: 3.2em; text-align: center; }
.v-zoom button { min-width: 32px; padding: 3px 8px; }
.v-status:empty { display: none; }
.v-status { color: var(--failure); }

.v-stage { display: grid; gap: 12px; grid-template-columns: minmax(0, 1fr); border-radius: 8px; }
.v-stage[data-mode="side"] { grid-template-columns: repeat(auto-fit, minmax(min(100%, 300px), 1fr)); }
.v-stage[data-mode="grid"] { grid-template-columns: repeat(auto-fill, minmax(min(100%, 272px), 1fr)); }
.v-stage:focus-visible { outline: 2px solid var(--accent); outline-offset: 4px; }
.v-pane { margin: 0; min-width: 0; break-inside: avoid; }
.v-pane figcaption { margin-bottom: 4px; overflow-wrap: break-word; font-size: 0.85rem; }
.v-frame {
  position: relative; overflow: hidden; line-height: 0; border-radius: 4px;
  background: var(--raised); box-shadow: 0 0 0 1px var(--rule);
}
.v-frame canvas { width: 100%; cursor: crosshair; touch-action: pan-y; }
.v-message {
  position: absolute; inset: 0; display: grid; place-items: center; margin: 0; padding: 16px; line-height: 1.4;
  text-align: center;
}
.viewer .v-pick { width: 100%; min-height: 26px; padding: 1px 8px; text-align: left; }
.v-pick[aria-pressed="true"] { border-color: var(--accent); background: var(--accent-soft); font-weight: 600; }
.v-pick[aria-pressed="true"]::after { content: " (B)"; }
.v-handle {
  position: absolute; top: 0; bottom: 0; width: 29px; margin-left: -14.5px; cursor: ew-resize;
  touch-action: none;
}
.v-handle::before {
  content: ""; position: absolute; top: 0; bottom: 0; left: 14px; width: 1px;
  background: #fff; box-shadow: 0 0 0 1px #000;
}
.v-handle::after {
  content: "\\25C2\\2006\\25B8"; position: absolute; top: 50%; left: 0; width: 29px; height: 29px; margin-top: -14px;
  border-radius: 50%; background: #fff; color: #000; box-shadow: 0 0 0 1px #000;
  font-size: 11px; line-height: 29px; text-align: center;
}
.v-handle:focus-visible { outline: none; }
.v-handle:focus-visible::after { box-shadow: 0 0 0 2px #fff, 0 0 0 5px var(--accent); }

.v-bars { display: flex; flex-wrap: wrap; gap: 10px 40px; margin: 8px 0; }
.v-colour-bar { flex: 1 1 20rem; max-width: 40rem; margin: 0; }
.v-colour-bar figcaption { margin-bottom: 3px; color: var(--muted); font-size: 0.82rem; }
.v-colour-bar canvas {
  display: block; width: 100%; height: 14px; border-radius: 2px; box-shadow: 0 0 0 1px var(--rule);
}
.v-ticks { position: relative; height: 1.6em; font-size: 0.8rem; font-variant-numeric: tabular-nums; }
.v-ticks span { position: absolute; transform: translateX(-50%); white-space: nowrap; }
.v-ticks span::before {
  content: ""; display: block; width: 1px; height: 4px; margin: 0 auto; background: var(--muted);
}
.v-ticks span[style*="left: 0%"] { transform: none; }
.v-ticks span[style*="left: 0%"]::before { margin: 0; }
.v-ticks span[style*="left: 100%"] { transform: translateX(-100%); }
.v-ticks span[style*="left: 100%"]::before { margin: 0 0 0 auto; }

.v-numbers {
  display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 420px), 1fr)); gap: 16px 32px;
  align-items: start; margin-top: 8px;
}
.v-table { width: 100%; table-layout: fixed; }
.v-table thead td { width: 27%; }
.v-table caption { padding-bottom: 4px; text-align: left; font-weight: 600; font-size: 0.9rem; }
.v-table th {
  position: static; padding: 4px 8px 4px 0; background: none; font-weight: 400; color: var(--muted);
  border-top: 1px solid var(--grid);
}
.v-table thead th { border-top: 0; }
.v-table thead th:not(:first-child), .v-table td { text-align: right; }
.v-table thead td { border-top: 0; }
.v-table tbody th { vertical-align: baseline; }
.v-table td { vertical-align: baseline; padding: 4px 0 4px 8px; overflow: hidden; text-overflow: ellipsis; }
.v-table thead th { padding: 4px 0 4px 8px; }
.v-region-inputs { display: flex; flex-wrap: wrap; align-items: center; gap: 6px 12px; margin-bottom: 8px; }
.v-region-inputs label { color: var(--muted); }
.v-region-inputs input {
  width: 4.6rem; min-height: 30px; padding: 3px 6px; border: 1px solid var(--rule); border-radius: 6px;
  background: var(--surface); color: var(--text); font: inherit;
}
.viewer .v-where {
  display: block; width: 100%; min-height: 24px; padding: 0; border: 0; background: none; color: var(--accent);
  font-size: 0.8rem; text-align: right;
}
.v-where:hover { text-decoration: underline; }
.v-note { max-width: 80ch; margin-top: 12px; color: var(--muted); font-size: 0.82rem; }
.v-left-out { margin-top: 8px; }
.v-left-out ul { max-height: 18rem; overflow: auto; columns: 20rem; font-size: 0.82rem; overflow-wrap: break-word; }

.v-help {
  max-width: 40rem; max-height: 86vh; padding: 16px 24px 20px; border: 1px solid var(--rule);
  border-radius: 10px; background: var(--surface); color: var(--text);
}
.v-help::backdrop { background: rgb(0 0 0 / 45%); }
.v-help h3 { margin: 0 0 6px; }
.v-help table { margin-bottom: 12px; }
.v-help th {
  position: static; width: 9rem; padding: 4px 8px 4px 0; background: none; font-weight: 400;
  white-space: nowrap;
}
.v-help td { white-space: normal; }
kbd {
  display: inline-block; min-width: 1.9em; margin-right: 3px; padding: 0 5px; border: 1px solid var(--rule);
  border-bottom-width: 2px; border-radius: 4px; background: var(--raised); font: inherit;
  font-size: 0.82rem; text-align: center;
}

@media print {
  .v-bar, .v-between, .v-links, .v-region-inputs, .v-handle::after, .v-where { display: none; }
}
`;
