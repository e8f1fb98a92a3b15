// SPDX-License-Identifier: MIT
// What the charts have in common: logarithmic axes with ticks at powers of ten, and the frame.
import * as Plot from '@observablehq/plot';
import { number, powerOfTen } from './dom.js';

/// What is read at a glance: 10⁻⁴, 0.01, 1, 100, 10⁵.
function tickText(value, plain) {
    const power = Math.round(Math.log10(value));
    const isPower = Math.abs(Math.log10(value) - power) < 1e-9;
    if (!isPower) return number(value);
    return plain ? value.toLocaleString('en', { maximumFractionDigits: 4 }) : powerOfTen(power);
}

/// Ticks within [low, high] of a logarithmic axis: powers of ten with a name, and what stands between.
export function logTicks(low, high, mostNamed) {
    const decades = [];
    for (let k = Math.ceil(Math.log10(low) - 1e-9); k <= Math.log10(high) + 1e-9; ++k) decades.push(k);
    const all = [];
    for (let k = Math.floor(Math.log10(low)); k <= Math.log10(high); ++k)
        for (let i = 1; i < 10; ++i) all.push(i * 10 ** k);
    const minor = all.filter((v) => v >= low && v <= high);
    const every = Math.max(1, Math.ceil(decades.length / mostNamed));
    const named = decades.length >= 2 ? decades.filter((k) => k % every === 0).map((k) => 10 ** k)
        : minor.filter((v) => [1, 2, 5].includes(Math.round(v / 10 ** Math.floor(Math.log10(v) + 1e-9))));
    return { named, minor: decades.length > 12 ? [] : minor, plain: low >= 0.9e-3 && high < 2e7 };
}

/// Marks of the axis and grid of one direction.
export function logAxis(direction, { named, minor, plain }, label) {
    const [axis, rule] = direction === 'x' ? [Plot.axisX, Plot.ruleX] : [Plot.axisY, Plot.ruleY];
    const sides = direction === 'x' ? { anchor: 'bottom', labelAnchor: 'center', labelOffset: 38 }
        : { anchor: 'left', labelAnchor: 'top', labelOffset: 50 };
    return [rule(minor, { strokeOpacity: 0.05 }), rule(named, { strokeOpacity: 0.13 }),
        axis({ ticks: named, tickFormat: (v) => tickText(v, plain), label, labelArrow: 'none', tickSize: 5, ...sides }),
        axis({ ticks: minor, tickFormat: () => '', label: null, tickSize: 3, anchor: sides.anchor, strokeOpacity: 0.5 })];
}

/// Options of every chart.
export const chartStyle = (width, height) => ({ width, height, marginLeft: 62, marginRight: 14, marginBottom: 48,
    style: { fontSize: '12.5px', background: 'transparent', fontFamily: 'inherit' } });
