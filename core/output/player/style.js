// SPDX-License-Identifier: MIT
// How the page looks.
export const style = `
:root { color-scheme: light; --ink: #1d2731; --soft: #5c6a77; --panel: rgba(255,255,255,.82); --accent: #d9522b; }
* { box-sizing: border-box; }
html, body { margin: 0; height: 100%; overflow: hidden; background: #dfe5ea; color: var(--ink);
    font: 14px/1.4 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
canvas { position: fixed; inset: 0; width: 100%; height: 100%; display: block; touch-action: none; outline: none; }
.panel { position: fixed; background: var(--panel); border-radius: 12px; padding: 12px 16px;
    box-shadow: 0 1px 2px rgba(20,30,40,.10), 0 8px 24px rgba(20,30,40,.10); backdrop-filter: blur(10px); }
#about { top: 16px; left: 16px; max-width: min(420px, 46vw); }
#about h1 { margin: 0; font-size: 17px; font-weight: 650; overflow-wrap: anywhere; }
#about p { margin: 2px 0 0; color: var(--soft); overflow-wrap: anywhere; }
#about p:empty { display: none; }
#numbers { margin: 0; top: 16px; right: 16px; min-width: 256px; display: grid; grid-template-columns: auto auto;
    gap: 3px 18px; font-variant-numeric: tabular-nums; }
#numbers dt { color: var(--soft); margin: 0; }
#numbers dd { margin: 0; text-align: right; font-weight: 550; }
#numbers.rigid .soft-only, #unsolved.untold, #curve.untold { display: none; }
#unsolved { grid-column: 1 / 3; font-size: 12px; color: var(--soft); white-space: nowrap; }
#picked { display: none; grid-column: 1 / 3; border-top: 1px solid rgba(20,30,40,.12); margin-top: 6px;
    padding-top: 6px; max-width: 260px; overflow-wrap: anywhere; }
#controls { left: 50%; bottom: 18px; transform: translateX(-50%); width: min(900px, calc(100vw - 32px));
    display: flex; align-items: center; gap: 10px; padding: 9px 12px; }
button, select { font: inherit; color: inherit; border: 0; background: transparent; border-radius: 8px; height: 34px;
    cursor: pointer; }
button { min-width: 34px; padding: 0 7px; display: inline-flex; align-items: center; justify-content: center; }
button:hover, select:hover { background: rgba(20,30,40,.08); }
button:focus-visible, select:focus-visible, input:focus-visible { outline: 2px solid var(--accent); outline-offset: 1px; }
#play { background: var(--ink); color: #fff; border-radius: 50%; width: 38px; height: 38px; flex: none; }
#play:hover { background: #33414e; }
#timeline { flex: 1; min-width: 60px; }
#curve { display: block; width: calc(100% - 16px); height: 14px; margin: 0 8px; overflow: visible; }
#curve path { fill: none; stroke: var(--soft); stroke-width: 1; vector-effect: non-scaling-stroke; }
#scrub { display: block; width: 100%; margin: 0; accent-color: var(--accent); height: 22px; cursor: pointer; }
#clock { font-variant-numeric: tabular-nums; white-space: nowrap; text-align: right; min-width: 118px; }
#clock small { color: var(--soft); display: block; font-size: 12px; line-height: 1.2; }
#failure { inset: 0; margin: auto; width: min(480px, 90vw); height: max-content; }
@media (max-width: 640px) { #numbers { display: none; } #clock small, #back, #forth { display: none; } #clock { min-width: 0; } }
`;
