// SPDX-License-Identifier: MIT
// Error against cost, both logarithmic: a line for each way of running, the Pareto front behind them, failures in a
// band above all errors.
import * as Plot from '@observablehq/plot';
import { chartStyle, logAxis, logTicks } from './axes.js';
import { kFailureColor } from './curves.js';
import { duration, withUnit } from './dom.js';

const kTop = 30, kBottom = 48, kMarkerRow = 13;
/// CPU time of a second that takes a second [µs].
const kRealTime = 1e6;

/// What a point says of itself.
export function rowText(row, line, subject) {
    const { metric } = subject;
    const others = Object.entries(row.others ?? {}).map(([name, value]) => `${name}: ${withUnit(value, '')}`);
    const solver = Number.isFinite(row.us_solver) ? ` (solver ${duration(row.us_solver)})` : '';
    const runs = row.runs > 0 ? `, ${row.runs} ${row.runs === 1 ? 'run' : 'runs'}` : '';
    return [`${line.label}, ${row.ladder} = ${row.value}`,
        row.status === 'done' ? `error: ${withUnit(row.error, metric.unit)}` : row.status,
        Number.isFinite(row.us) ? `cost: ${duration(row.us)} of CPU per simulated second${solver}${runs}` : '',
        ...others, row.settings, row.note, row.front ? 'on the Pareto front' : ''].filter(Boolean).join('\n');
}

/// Places failures side by side in as few rows of the band as keep them apart: adds `level`, counted from its top.
function withLevels(failures, pixelOf) {
    const ends = [];
    return [...failures].sort((a, b) => a.row.us - b.row.us).map((failure) => {
        const at = pixelOf(failure.row.us);
        let level = ends.findIndex((end) => at - end >= kMarkerRow - 2);
        if (level < 0) level = ends.length < 4 ? ends.length : 3;
        ends[level] = at;
        return { ...failure, level };
    });
}

const frontRows = (subject) => subject.rows.filter((r) => r.front && r.status === 'done' && r.us > 0 && Number.isFinite(r.error))
    .sort((a, b) => a.us - b.us);

const extent = (values) => [Math.min(...values), Math.max(...values)];

/// Room about the values, and at least a decade.
function padded([low, high], by) {
    const middle = Math.sqrt(low * high), least = Math.sqrt(10);
    return [Math.min(low / by, middle / least), Math.max(high * by, middle * least)];
}

/// The stage: domains, and the band of failures above the highest error.
function layout(lines, shown, subject, width, height) {
    const visible = lines.filter(({ key }) => shown.has(key));
    const done = visible.flatMap((line) => line.done), front = frontRows(subject);
    const failures = lines.flatMap((line) => line.failed.filter(({ us }) => us > 0)
        .map((row) => ({ row, line, visible: shown.has(line.key) })));
    const costs = [...done, ...front, ...failures.map(({ row }) => row)].map(({ us }) => us).filter((us) => us > 0);
    const tolerance = subject.tolerance > 0 ? [subject.tolerance] : [];
    const errors = [...done, ...front].map(({ error }) => error).concat(tolerance).filter((e) => e > 0);
    const x = padded(costs.length ? extent(costs) : [1, 100], 1.35);
    const [low, high] = padded(errors.length ? extent(errors) : [1e-3, 1], 1.8);
    const pixelOf = (us) => (width - 76) * Math.log(us / x[0]) / Math.log(x[1] / x[0]);
    const placed = withLevels(failures, pixelOf);
    const rows = placed.length > 0 ? 1 + Math.max(...placed.map(({ level }) => level)) : 0;
    const plotted = height - kTop - kBottom, band = rows > 0 ? rows * kMarkerRow + 8 : 0;
    const grown = Math.log(high / low) * plotted / (plotted - band);
    const top = low * Math.exp(grown);
    const markerAt = (level) => top / Math.exp(grown * (10 + level * kMarkerRow) / plotted);
    return { x, low, high, top, hasBand: band > 0, visible,
        failures: placed.map((f) => ({ ...f, us: f.row.us, y: markerAt(f.level) })),
        yPixels: plotted / grown };
}

/// The lines themselves: broken where a step of the ladder failed; an error of nought stands on the lower edge.
function lineMarks({ visible, low }) {
    const y = (row) => (row.status !== 'done' || !Number.isFinite(row.error) ? NaN : Math.max(row.error, low));
    return visible.flatMap(({ rows, done, look, label, mark }) => [
        Plot.line(rows, { x: 'us', y, stroke: look.color, strokeWidth: look.thin ? 1.2 : 1.9, strokeDasharray: look.dash || null,
            ariaLabel: () => label, className: mark, strokeLinejoin: 'round' }),
        Plot.dot(done, { x: 'us', y, symbol: look.symbol, r: 4.2, stroke: look.color, strokeWidth: 1.4,
            fill: look.hollow ? 'var(--card)' : look.color, ariaLabel: () => label, className: mark })]);
}

/// Best error for the money, as stairs: the bold line of the study. Corners that belong to hidden lines are dots.
function frontMarks(subject, { low, x, visible }) {
    const corners = frontRows(subject).map((row) => ({ row, us: row.us, error: Math.max(row.error, low) }));
    if (corners.length === 0) return [];
    const seen = new Set(visible.flatMap((line) => line.done));
    return [Plot.line([...corners, { us: x[1], error: corners.at(-1).error }], { x: 'us', y: 'error', curve: 'step-after',
        stroke: 'currentColor', strokeOpacity: 0.28, strokeWidth: 6.5, strokeLinejoin: 'round', clip: true, ariaLabel: () => 'Pareto front' }),
    Plot.dot(corners.filter(({ row }) => !seen.has(row)), { x: 'us', y: 'error', r: 3, fill: 'currentColor', fillOpacity: 0.55,
        ariaLabel: () => 'on the Pareto front, of a hidden line' })];
}

/// Errors below which rounding lets no setting of the visible lines go.
function visibleFloors(subject, { visible, low, high }) {
    const seen = new Set(visible.map(({ curve, precision }) => `${curve}|${precision}`));
    return (subject.floors ?? []).filter((f) => f.error >= low && f.error <= high && seen.has(`${f.curve}|${f.precision}`))
        .sort((a, b) => a.error - b.error);
}

const floorMarks = (floors, looks) => floors.map((f) => Plot.ruleY([f.error], { stroke: looks.colorOfCurve(f.curve),
    strokeDasharray: '1 4', strokeWidth: 1.5, strokeLinecap: 'round', ariaLabel: () => 'rounding floor' }));

/// Words of the floors; those that would touch share a line.
function floorWords(floors, { x, yPixels }) {
    const words = [];
    for (const floor of floors) {
        const last = words.at(-1);
        if (last && yPixels * Math.log(floor.error / last.floors.at(-1).error) < 15) last.floors.push(floor);
        else words.push({ floors: [floor] });
    }
    const precisions = (list) => [...new Set(list.map(({ precision }) => precision))].join(', ');
    return Plot.text(words, { x: () => x[0], y: ({ floors: list }) => list.at(-1).error, textAnchor: 'start', dx: 6, dy: -8, ...kHalo,
        text: ({ floors: list }) => `rounding, ${list.length === 1 ? `${list[0].curve} ` : ''}${precisions(list)}` });
}

const kHalo = { fill: 'currentColor', stroke: 'var(--card)', strokeWidth: 4 };

/// Tolerance, real time and the band of failures, drawn beneath the lines.
function ruleMarks(subject, { x, low, high, top, hasBand }) {
    return [...(subject.tolerance > 0 ? [Plot.ruleY([subject.tolerance], { strokeDasharray: '8 5', strokeWidth: 1.3,
        strokeOpacity: 0.75, ariaLabel: () => 'tolerance' })] : []),
    ...(kRealTime > x[0] && kRealTime < x[1] ? [Plot.ruleX([kRealTime], { y1: low, y2: high, strokeOpacity: 0.5, strokeDasharray: '2 3',
        ariaLabel: () => 'real time' })] : []),
    ...(hasBand ? [Plot.rect([0], { x1: x[0], x2: x[1], y1: high, y2: top, fill: 'currentColor', fillOpacity: 0.055 }),
        Plot.text(['failed'], { frameAnchor: 'top-left', dx: -8, dy: 4, textAnchor: 'end', fontWeight: 600 })] : [])];
}

/// Words of the rules, above all lines.
function ruleWords(subject, { x, low, visible }) {
    const tolerance = `tolerance ${withUnit(subject.tolerance, subject.metric.unit)}`;
    const exact = visible.some(({ done }) => done.some(({ error }) => error <= 0));
    return [...(exact ? [Plot.text(['at the lower edge: no error at all'], { x: () => x[1], y: () => low, textAnchor: 'end', dx: -6, dy: -9, ...kHalo })] : []),
    ...(subject.tolerance > 0 ? [Plot.text([tolerance], { x: () => x[1], y: () => subject.tolerance, textAnchor: 'end', dx: -6,
        dy: -8, ...kHalo })] : []),
    ...(kRealTime > x[0] && kRealTime < x[1] ? [Plot.text(['as slow as real time'], { x: () => kRealTime, y: () => low, rotate: -90,
        textAnchor: 'start', dx: -8, dy: -8, ...kHalo })] : [])];
}

/// Every failure with a cost, in its line's colour, or grey where that line is hidden.
const failureMarks = ({ failures }) => failures.map((f) => Plot.dot([f], { x: 'us', y: 'y', symbol: 'times', r: 4.2,
    stroke: f.visible ? f.line.look.color : kFailureColor, strokeWidth: 2.2, strokeOpacity: f.visible ? 1 : 0.6,
    ariaLabel: () => `${f.row.status}: ${f.line.label}`, className: f.visible ? f.line.mark : 'hidden-failure' }));

/// What is near the pointer says what it is: points of visible lines and of the front, and failures.
function pointerMarks(subject, lines, { visible, failures, low }, tips) {
    const tells = (line) => line.done.filter((row) => visible.includes(line) || row.front)
        .map((row) => ({ us: row.us, y: Math.max(row.error, low), row, line }));
    const text = ({ row, line }) => rowText(row, line, subject);
    const points = [...lines.flatMap(tells), ...failures].map((point) => ({ ...point, text: text(point) }));
    const place = { x: 'us', y: 'y', maxRadius: 30 };
    return [Plot.dot(points, Plot.pointer({ ...place, r: 8, stroke: 'currentColor', strokeWidth: 1.6 })),
        ...(tips ? [Plot.tip(points, Plot.pointer({ ...place, title: 'text', fill: 'var(--card)', fontSize: 12.5, lineHeight: 1.3,
            lineWidth: 30, textPadding: 9 }))] : [])];
}

/// The chart of a subject; `shown`: keys of the lines that are drawn. `still`: for a file, nothing answers the pointer;
/// `tips`: what it answers is written in the chart, and else only told (figure.js).
export function workPrecision(subject, lines, shown, looks, { width, height, still = false, tips = true }) {
    const stage = layout(lines, shown, subject, width, height);
    const { x, low, high, top } = stage;
    const floors = visibleFloors(subject, stage);
    const unit = subject.metric.unit ? ` [${subject.metric.unit}]` : '';
    const xTicks = logTicks(x[0], x[1], width / 62), yTicks = logTicks(low, high, 10);
    return Plot.plot({
        ...chartStyle(width, height), marginTop: kTop, marginBottom: kBottom,
        x: { type: 'log', domain: x }, y: { type: 'log', domain: [low, top] },
        marks: [...logAxis('y', yTicks, `${subject.metric.what || subject.metric.name}${unit}`),
            ...logAxis('x', xTicks, 'CPU time per simulated second [µs]'), Plot.frame({ strokeOpacity: 0.35 }),
            ...frontMarks(subject, stage), ...ruleMarks(subject, stage), ...floorMarks(floors, looks),
            ...lineMarks(stage), ...failureMarks(stage), ...ruleWords(subject, stage), floorWords(floors, stage), ...(still ? [] : pointerMarks(subject, lines, stage, tips))],
    });
}
