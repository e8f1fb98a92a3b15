// SPDX-License-Identifier: MIT
// A performance profile: which share of the cases each curve solves within a factor τ of the cheapest curve's cost.
import * as Plot from '@observablehq/plot';
import { chartStyle, logAxis, logTicks } from './axes.js';
import { number } from './dom.js';

/// Lines of a profile, as figure.js wants them.
export const profileLines = (profile, looks) => profile.curves.map(({ name, points }, i) =>
    ({ key: name, label: name, mark: `line-${i}`, look: looks.ofName(name, i), points: points.map(([tau, share]) => ({ tau, share, name })) }));

export function profileChart(lines, shown, { width, height, still = false, tips = true }) {
    const visible = lines.filter(({ key }) => shown.has(key));
    const last = Math.max(2, ...lines.flatMap(({ points }) => points.map(({ tau }) => tau)));
    const whole = (points) => (points.length > 0 ? [...points, { ...points.at(-1), tau: last }] : []);
    const place = { x: 'tau', y: 'share', maxRadius: 30 };
    const corners = visible.flatMap(({ points }) => points).map(({ name, tau, share }) => ({ tau, share,
        text: `${name}\n${Math.round(100 * share)} % of the cases within ${number(tau)} times the cheapest` }));
    return Plot.plot({
        ...chartStyle(width, height), marginTop: 30, x: { type: 'log', domain: [1, last] }, y: { domain: [0, 1.02] },
        marks: [Plot.axisY({ label: 'share of the cases', labelAnchor: 'top', labelArrow: 'none', tickFormat: (v) => `${Math.round(100 * v)} %`,
            labelOffset: 50, ticks: 5 }), Plot.gridY({ ticks: 5, strokeOpacity: 0.13 }),
        ...logAxis('x', logTicks(1, last, width / 62), 'τ: cost as a multiple of the cheapest'), Plot.frame({ strokeOpacity: 0.35 }),
        ...visible.map(({ points, label, look, mark }) => Plot.line(whole(points), { x: 'tau', y: 'share', curve: 'step-after', stroke: look.color,
            strokeWidth: 2, strokeDasharray: look.dash || null, ariaLabel: () => label, className: mark })),
        ...(still ? [] : [Plot.dot(corners, Plot.pointer({ ...place, r: 5, stroke: 'currentColor', strokeWidth: 1.6 }))]),
        ...(still || !tips ? [] : [Plot.tip(corners, Plot.pointer({ ...place, title: 'text', fill: 'var(--card)', fontSize: 12.5 }))])],
    });
}
