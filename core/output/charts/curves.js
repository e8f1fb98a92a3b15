// SPDX-License-Identifier: MIT
// Lines of the charts, made of the rows of a study: what belongs together, what it is called and how it looks.

/// Dark enough on paper, light enough on a dark page, and apart for colour-blind eyes (after Okabe and Ito).
const kColors = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#b8860b', '#56b4e9', '#8c564b', '#7b5ea7', '#6b7780'];
const kSymbols = ['circle', 'square', 'triangle', 'diamond', 'star', 'wye'];
const kDashes = ['', '7 4', '2 3', '9 3 2 3'];
const kParts = ['curve', 'precision', 'ladder', 'collider', 'contacts'];
/// More lines than this are shown only when asked for.
const kShown = 7;

export const kFailureColor = '#8a94a0';

const isDone = (row) => row.status === 'done' && Number.isFinite(row.error) && Number.isFinite(row.us);

/// Names and looks that hold through the whole page, so that a colour means the same in every chart.
export class Looks {
    constructor(subjects) {
        const rows = subjects.flatMap((s) => s.rows);
        this.values = Object.fromEntries(kParts.map((part) => [part, [...new Set(rows.map((r) => r[part] ?? ''))]]));
        this.varying = kParts.filter((part) => this.values[part].length > 1);
        // Colour tells what there is most reason to tell apart: methods, or else whatever has the most values.
        const count = (part) => this.values[part].length;
        this.colored = count('curve') > 1 ? 'curve' : kParts.reduce((a, b) => (count(b) > count(a) ? b : a));
    }

    /// "pbd · single · substeps": what all lines share is left out.
    label(line) {
        const parts = ['curve', ...this.varying.filter((part) => part !== 'curve')];
        return parts.map((part) => (part === 'contacts' && line[part] ? `${line[part]} contacts` : line[part]))
            .filter(Boolean).join(' · ') || 'runs';
    }

    color(line) { return this.colorOf(line[this.colored]); }

    colorOf(value) {
        return kColors[Math.max(0, this.values[this.colored].indexOf(value ?? '')) % kColors.length];
    }

    colorOfCurve(curve) { return this.colored === 'curve' ? this.colorOf(curve) : '#6b7780'; }

    /// Colour, dash and marker of a line.
    of(line) {
        const index = (part) => (part === this.colored ? 0 : Math.max(0, this.values[part].indexOf(line[part] ?? '')));
        return { color: this.color(line), symbol: kSymbols[index('ladder') % kSymbols.length],
            dash: kDashes[index('precision') % kDashes.length], hollow: index('collider') % 2 === 1,
            thin: index('collider') >= 2 || index('contacts') > 0 };
    }

    /// Look of a name that a profile gives: that of the curve which it begins with, where there is one.
    ofName(name, index) {
        const longest = (part) => this.values[part].filter((v) => v && ` ${name} `.includes(` ${v} `))
            .sort((a, b) => b.length - a.length)[0];
        const line = Object.fromEntries(kParts.map((part) => [part, longest(part)]));
        const known = line[this.colored] !== undefined;
        return { ...this.of(line), color: known ? this.color(line) : kColors[index % kColors.length], symbol: null };
    }
}

/// Lines of a subject: [{key, label, look, mark: a class of its marks, rows: in the ladder's order, done, failed}].
export function linesOf(subject, looks) {
    const lines = new Map();
    for (const row of subject.rows) {
        const key = JSON.stringify(kParts.map((part) => row[part] ?? ''));
        if (!lines.has(key)) lines.set(key, { key, ...Object.fromEntries(kParts.map((p) => [p, row[p] ?? ''])), rows: [] });
        lines.get(key).rows.push(row);
    }
    return [...lines.values()].map((line, i) => {
        line.rows.sort((a, b) => a.value - b.value);
        return { ...line, mark: `line-${i}`, label: looks.label(line), look: looks.of(line), done: line.rows.filter(isDone),
            failed: line.rows.filter((row) => !isDone(row)) };
    });
}

/// Keys of the lines that are worth seeing first: each curve as it runs in the ways that the front favours, so that curves
/// differ in nothing else, then whatever else is on the front.
export function importantLines(lines, tolerance) {
    if (lines.length <= kShown) return new Set(lines.map(({ key }) => key));
    const ways = new Map();
    for (const line of lines) ways.set(wayOf(line), (ways.get(wayOf(line)) ?? 0) + onFront(line));
    const better = (a, b) => ways.get(wayOf(b)) - ways.get(wayOf(a)) || onFront(b) - onFront(a)
        || costWithin(a, tolerance) - costWithin(b, tolerance);
    const ran = [...lines].sort((a, b) => (b.done.length > 0) - (a.done.length > 0) || better(a, b));
    const ofCurves = ran.filter((line) => ran.find(({ curve }) => curve === line.curve) === line);
    const others = lines.filter((line) => onFront(line) > 0 && !ofCurves.includes(line)).sort((a, b) => onFront(b) - onFront(a));
    return new Set([...ofCurves, ...others].slice(0, kShown).map(({ key }) => key));
}

const wayOf = (line) => JSON.stringify(kParts.slice(1).map((part) => line[part]));
const onFront = (line) => line.done.filter((row) => row.front).length;
const costWithin = (line, tolerance) =>
    Math.min(Number.MAX_VALUE, ...line.done.filter((row) => row.error <= tolerance).map((row) => row.us));
