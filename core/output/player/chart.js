// SPDX-License-Identifier: MIT
// A line chart as SVG: lines over a common x, ticks at round numbers, a legend.
const kWidth = 560, kHeight = 260, kLeft = 64, kRight = 14, kTop = 34, kBottom = 40;

/// The browser knows SVG's namespace; a page that asks for nothing from outside names no address.
const kNamespace = (() => {
    const holder = document.createElement('div');
    holder.innerHTML = '<svg></svg>';
    return holder.firstChild.namespaceURI;
})();

function svg(tag, attributes, text) {
    const e = document.createElementNS(kNamespace, tag);
    for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
    if (text !== undefined) e.textContent = text;
    return e;
}

/// About `wanted` round numbers that cover [low, high].
function ticks(low, high, wanted) {
    const rough = Math.max((high - low) / wanted, 1e-300);
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find((f) => f * power >= rough * 0.999);
    const list = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) list.push(k * step);
    return list;
}

const label = (value, span) => (value === 0 ? '0'
    : span >= 1e5 || span < 1e-3 ? value.toExponential(1) : String(Number(value.toPrecision(4))));

/// lines: [{name, color, y: [value at each x]}]
export function lineChart({ title, x, lines }) {
    const values = lines.flatMap(({ y }) => y).filter(Number.isFinite);
    let low = Math.min(0, ...values), high = Math.max(...values, low + 1e-12);
    high += 0.05 * (high - low);
    const atX = (v) => kLeft + (kWidth - kLeft - kRight) * (v - x[0]) / (x.at(-1) - x[0] || 1);
    const atY = (v) => kHeight - kBottom - (kHeight - kBottom - kTop) * (v - low) / (high - low);
    const chart = svg('svg', { viewBox: `0 0 ${kWidth} ${kHeight}`, role: 'img', 'aria-label': title });
    chart.append(svg('text', { x: kLeft, y: 18, class: 'title' }, title));
    for (const v of ticks(low, high, 5)) {
        chart.append(svg('line', { x1: kLeft, x2: kWidth - kRight, y1: atY(v), y2: atY(v), class: 'grid' }),
            svg('text', { x: kLeft - 8, y: atY(v) + 4, 'text-anchor': 'end' }, label(v, high - low)));
    }
    for (const v of ticks(x[0], x.at(-1), 8)) {
        chart.append(svg('line', { x1: atX(v), x2: atX(v), y1: kHeight - kBottom, y2: kHeight - kBottom + 5, class: 'axis' }),
            svg('text', { x: atX(v), y: kHeight - kBottom + 18, 'text-anchor': 'middle' }, label(v, x.at(-1) - x[0])));
    }
    chart.append(svg('line', { x1: kLeft, x2: kWidth - kRight, y1: kHeight - kBottom, y2: kHeight - kBottom, class: 'axis' }),
        svg('text', { x: (kLeft + kWidth) / 2, y: kHeight - 4, 'text-anchor': 'middle' }, 'time [s]'));
    lines.forEach(({ name, color, y }, i) => {
        const points = y.map((v, k) => `${atX(x[k]).toFixed(1)},${atY(v).toFixed(1)}`).join(' ');
        chart.append(svg('polyline', { points, fill: 'none', stroke: color, 'stroke-width': 2 - 0.15 * i,
            'stroke-dasharray': ['', '7 4', '2 3'][i % 3] }));
    });
    const legend = document.createElement('div');
    legend.className = 'legend-line';
    for (const { name, color } of lines) {
        const item = document.createElement('span'), mark = document.createElement('i');
        mark.className = 'mark';
        mark.style.background = color;
        item.append(mark, name);
        legend.append(item);
    }
    const figure = document.createElement('figure');
    figure.append(chart, legend);
    return figure;
}
