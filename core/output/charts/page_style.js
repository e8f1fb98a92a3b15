// SPDX-License-Identifier: MIT
// How the page of a study looks: on a screen, in the dark, on a phone and on paper.
export const pageStyle = `
:root { color-scheme: light dark; --ink: #1d2731; --soft: #5c6a77; --line: #dfe4e9; --page: #eef1f4; --card: #ffffff;
    --good: #1f7a44; --good-back: #dcf2e4; --bad: #b3261e; --bad-back: #fbe0de; --accent: #0072b2; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e9ee; --soft: #9fadba; --line: #36414c; --page: #14191f; --card: #1d242c;
    --good: #7fd3a0; --good-back: #1d3b2a; --bad: #ff9d94; --bad-back: #47211f; --accent: #56b4e9; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--ink);
    font: 14.5px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
main { max-width: 1180px; margin: 0 auto; padding: 20px 20px 40px; }
header, section { background: var(--card); border-radius: 12px; padding: 18px 22px; margin-bottom: 14px;
    box-shadow: 0 1px 2px rgba(20,30,40,.08); }
h1 { font-size: 24px; line-height: 1.25; margin: 0 0 6px; } h2 { font-size: 18px; line-height: 1.3; margin: 0 0 6px; }
h3 { font-size: 15px; margin: 22px 0 4px; }
p { margin: 4px 0; max-width: 80ch; } .soft { color: var(--soft); font-size: 13.5px; }
a { color: var(--accent); }
.advice li { margin: 3px 0; max-width: 80ch; } .advice ul, details ul { margin: 4px 0 0; padding-left: 20px; }
.advice h3 { margin-top: 14px; } .advice h3 a { color: inherit; text-decoration: none; } .advice h3 a:hover { text-decoration: underline; }
nav { margin-top: 8px; display: flex; flex-wrap: wrap; gap: 2px 16px; font-size: 13.5px; }
figure { margin: 14px 0 0; } .stage { min-height: 300px; } .stage svg { display: block; max-width: 100%; overflow: visible; }
.stage g[class^=line-] { transition: opacity .12s; }
.told { white-space: pre-line; font-size: 13px; overflow-wrap: anywhere; } .told:empty { display: none; }
.legend { display: flex; flex-wrap: wrap; gap: 2px 6px; margin: 6px 0 0; align-items: center; font-size: 13px; }
button { font: inherit; color: inherit; background: none; border: 1px solid var(--line); border-radius: 7px; padding: 2px 9px; cursor: pointer; }
button:hover { background: var(--page); } button:focus-visible { outline: 2px solid var(--accent); }
.entry { display: inline-flex; align-items: center; gap: 6px; border-color: transparent; padding: 2px 6px; text-align: left; }
.entry svg { flex: none; } .entry[aria-pressed=false] { opacity: .45; } .more { margin-top: 2px; font-size: 13px; }
.more .legend { display: grid; grid-template-columns: repeat(auto-fill, minmax(250px, 1fr)); }
.entry.fixed { padding: 2px 6px; } .choices { display: inline-flex; gap: 6px; align-items: center; color: var(--soft); margin-left: auto; }
figcaption { display: flex; flex-wrap: wrap; gap: 6px 16px; justify-content: space-between; align-items: baseline; color: var(--soft);
    font-size: 12.5px; border-top: 1px solid var(--line); margin-top: 8px; padding-top: 8px; }
figcaption > span:first-child { flex: 1 1 320px; overflow-wrap: anywhere; } .savers { display: inline-flex; gap: 6px; }
.scroll { overflow-x: auto; margin-top: 6px; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 13.5px; min-width: 60%; }
th { text-align: left; font-weight: 550; color: var(--soft); font-size: 12.5px; vertical-align: bottom; white-space: nowrap; }
th, td { padding: 4px 16px 4px 0; border-bottom: 1px solid var(--line); } td { white-space: nowrap; }
td:last-child { white-space: normal; min-width: 16ch; } details td:last-child { white-space: nowrap; }
th.number, td.number { text-align: right; } tbody tr:last-child td { border-bottom: 0; }
.sort { border: 0; padding: 0; border-radius: 0; } .sort:hover { background: none; text-decoration: underline; }
tr.front td { font-weight: 600; }
.badge { border-radius: 20px; padding: 1px 10px; font-size: 12.5px; font-weight: 600; white-space: nowrap; }
.badge.good { background: var(--good-back); color: var(--good); } .badge.bad { background: var(--bad-back); color: var(--bad); }
details { margin-top: 12px; } summary { cursor: pointer; color: var(--soft); }
@media (max-width: 640px) { main { padding: 8px 0 24px; } header, section { border-radius: 0; padding: 14px 14px; margin-bottom: 8px; }
    h1 { font-size: 20px; } .choices { margin-left: 0; } }
@media print { :root { color-scheme: light; --ink: #000; --soft: #444; --line: #ccc; --page: #fff; --card: #fff; --accent: #000;
        --good: #1f7a44; --good-back: #fff; --bad: #b3261e; --bad-back: #fff; }
    main { padding: 0; max-width: none; } header, section { box-shadow: none; padding: 0 0 12px; } button:not(.entry), .choices, .told, .savers, nav { display: none; }
    .entry[aria-pressed=false] { display: none; } figure, table { break-inside: avoid; } h2, h3, section > p { break-after: avoid; } h1, h2, h3, p, li { break-inside: avoid; } }
`;
