// SPDX-License-Identifier: MIT
// How the page of a comparison looks.
export const comparisonStyle = `
:root { color-scheme: light; --ink: #1d2731; --soft: #5c6a77; --line: #dfe4e9; --good: #1f7a44; --bad: #b3261e; }
* { box-sizing: border-box; }
body { margin: 0; background: #eef1f4; color: var(--ink);
    font: 14px/1.45 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
main { max-width: 1240px; margin: 0 auto; padding: 20px 20px 40px; }
header, section { background: #fff; border-radius: 12px; padding: 16px 20px; margin-bottom: 14px;
    box-shadow: 0 1px 2px rgba(20,30,40,.08); }
h1 { font-size: 22px; margin: 0 0 4px; } h2 { font-size: 16px; margin: 0 0 10px; } h4 { margin: 12px 0 4px; }
p { margin: 4px 0; } .soft { color: var(--soft); font-size: 13px; } p.soft { margin-top: 6px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th { text-align: left; font-weight: 550; color: var(--soft); font-size: 12.5px; vertical-align: bottom; }
th, td { padding: 5px 10px 5px 0; border-bottom: 1px solid var(--line); white-space: nowrap; }
.number { text-align: right; } tbody tr:last-child td { border-bottom: 0; }
.badge { border-radius: 20px; padding: 2px 10px; font-size: 12.5px; font-weight: 600; white-space: nowrap; vertical-align: middle; }
.badge.good { background: #dcf2e4; color: var(--good); } .badge.bad { background: #fbe0de; color: var(--bad); }
.badge.none { color: var(--soft); font-weight: 400; padding: 2px 0; }
.mark { display: inline-block; width: 11px; height: 11px; border-radius: 3px; margin-right: 6px; }
details { margin-top: 8px; } summary { cursor: pointer; color: var(--soft); }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(400px, 1fr)); gap: 14px; }
figure { margin: 0; } svg { width: 100%; height: auto; }
svg text { font-size: 12px; fill: var(--soft); } svg .title { font-size: 13.5px; font-weight: 600; fill: var(--ink); }
svg .grid { stroke: #e6eaee; } svg .axis { stroke: #9aa6b2; }
.legend-line { display: flex; flex-wrap: wrap; gap: 4px 16px; padding-left: 64px; font-size: 13px; }
.viewer { display: grid; grid-template-columns: 330px 1fr; gap: 16px; }
.list { max-height: 620px; overflow-y: auto; display: flex; flex-direction: column; gap: 4px; }
.finding { font: inherit; text-align: left; border: 1px solid var(--line); background: #fff; border-radius: 8px; padding: 7px 10px;
    cursor: pointer; display: flex; flex-direction: column; color: inherit; flex: none; }
.finding:hover { background: #f4f6f8; } .finding.chosen { border-color: var(--ink); background: #f0f3f6; }
.finding b { font-weight: 600; }
.frame { position: relative; } .frame canvas { width: 100%; height: 480px; display: block; border-radius: 8px; touch-action: none; cursor: grab; }
.legend { position: absolute; top: 10px; left: 12px; display: flex; gap: 14px; background: rgba(255,255,255,.85);
    padding: 4px 10px; border-radius: 8px; }
.legend label { display: flex; align-items: center; gap: 6px; cursor: pointer; }
.words { padding: 10px 2px 0; } .words p { margin: 2px 0; } .bad-text { color: var(--bad); font-weight: 550; }
footer { padding: 4px 6px; }
@media (max-width: 820px) { .viewer { grid-template-columns: 1fr; } .list { max-height: 240px; } .charts { grid-template-columns: 1fr; } }
`;
