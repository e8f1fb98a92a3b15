// SPDX-License-Identifier: MIT
// A bit of a line, for legends: its colour, its dash and its marker.
import * as Plot from '@observablehq/plot';

/// An SVG of 34 × 16.
export function sample(look) {
    const ends = [[1, 8], [33, 8]];
    const mark = look.front
        ? [Plot.line(ends, { stroke: 'currentColor', strokeOpacity: 0.28, strokeWidth: 6.5 })]
        : look.failure ? [Plot.dot([[17, 8]], { symbol: 'times', r: 4.2, stroke: 'currentColor', strokeWidth: 2.2 })]
            : [Plot.line(ends, { stroke: look.color, strokeWidth: look.thin ? 1.2 : 1.9, strokeDasharray: look.dash || null }),
                ...(look.symbol ? [Plot.dot([[17, 8]], { symbol: look.symbol, r: 4.2, stroke: look.color, strokeWidth: 1.4,
                    fill: look.hollow ? 'var(--card)' : look.color })] : [])];
    const svg = Plot.plot({ width: 34, height: 16, margin: 0, axis: null, x: { domain: [0, 34], range: [0, 34] },
        y: { domain: [0, 16], range: [16, 0] }, style: { background: 'transparent' }, marks: mark });
    for (const sheet of svg.querySelectorAll('style')) sheet.remove();
    svg.setAttribute('aria-hidden', 'true');
    return svg;
}
