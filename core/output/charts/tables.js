// SPDX-License-Identifier: MIT
// The tables of a subject: orders, departures and all rows.
import { button, duration, element, number, table, withUnit } from './dom.js';
import { saveCsv } from './save.js';

/// An order within this of theory counts as theory's.
const kSameOrder = 0.25;

/// More rows than this are shown only when asked for.
const kLong = 12;

const isJudged = ({ slope, expected }) => expected > 0 && Number.isFinite(slope);

function judgement(row) {
    if (!isJudged(row)) return '';
    const difference = row.slope - row.expected;
    return Math.abs(difference) <= kSameOrder ? 'as expected' : difference < 0 ? 'lower' : 'higher';
}

function badge(row) {
    const text = judgement(row);
    return text ? element('span', `badge ${text === 'lower' ? 'bad' : 'good'}`, text) : '';
}

const heading = (slopes) => {
    const judged = slopes.filter(isJudged);
    const good = judged.filter((s) => judgement(s) !== 'lower').length;
    return judged.length > 0 ? `${good} of ${judged.length} orders that theory gives are reached. ` : '';
};

export function slopesTable(slopes) {
    const columns = [{ head: 'curve', value: (s) => s.curve }, { head: 'precision', value: (s) => s.precision },
        { head: 'refined by', value: (s) => s.ladder }, { head: 'collider', value: (s) => s.collider },
        { head: 'from', value: (s) => s.from, shown: (s) => number(s.from), number: true },
        { head: 'to', value: (s) => s.to, shown: (s) => number(s.to), number: true },
        { head: 'order measured', value: (s) => s.slope, shown: (s) => (Number.isFinite(s.slope) ? s.slope.toFixed(2) : '–'), number: true },
        { head: 'order expected', value: (s) => s.expected, shown: (s) => (s.expected > 0 ? number(s.expected) : '–'), number: true },
        { head: '', value: judgement, shown: badge }];
    const rows = table(columns, slopes, true), lower = slopes.filter((s) => judgement(s) === 'lower');
    const long = element('details', '', [element('summary', '', `All ${slopes.length} orders`), rows]);
    return [element('h3', '', 'Order of convergence'), element('p', 'soft',
        `${heading(slopes)}An order of 1 halves the error where the ladder doubles; within ${kSameOrder} of theory counts as expected.`),
    ...(slopes.length <= kLong ? [rows] : lower.length > 0 ? [table(columns, lower), long] : [long])];
}

export function departuresTable(departures) {
    const columns = [{ head: 'what', value: (d) => d.what },
        { head: 'ratio', value: (d) => d.ratio, shown: (d) => (Number.isFinite(d.ratio) ? `${number(d.ratio, 2)} ×` : '–'), number: true },
        { head: 'at a cost of', value: (d) => d.at_us, shown: (d) => duration(d.at_us), number: true },
        { head: 'meaning', value: (d) => d.note }];
    return [element('h3', '', 'What each departure from the paper is worth'), table(columns, departures)];
}

export function rowColumns(subject) {
    const text = (head) => ({ head, value: (r) => r[head] });
    const others = [...new Set(subject.rows.flatMap((r) => Object.keys(r.others ?? {})))];
    const unit = subject.metric.unit ? ` [${subject.metric.unit}]` : '';
    const measured = (head, value) => ({ head, value, shown: (r) => number(value(r)), number: true });
    return [text('curve'), text('precision'), text('ladder'), { head: 'value', value: (r) => r.value, number: true }, text('collider'),
        text('contacts'), text('status'), measured(`error${unit}`, (r) => r.error),
        ...others.map((name) => measured(name, (r) => r.others?.[name])), measured('CPU [µs/s]', (r) => r.us),
        measured('solver [µs/s]', (r) => r.us_solver), { head: 'runs', value: (r) => r.runs, number: true },
        { head: 'front', value: (r) => (r.front ? 'front' : '') }, text('note'), text('settings')];
}

/// All rows, made when they are asked for.
export function rowsDetails(subject, file) {
    const columns = rowColumns(subject);
    const details = element('details', '', [element('summary', '', `All ${subject.rows.length} rows as a table`)]);
    details.addEventListener('toggle', () => {
        if (details.children.length > 1) return;
        const csv = () => saveCsv(file, [columns.map((c) => c.head), ...subject.rows.map((r) => columns.map((c) => c.value(r)))]);
        details.append(element('p', 'soft', ['Costs are µs of CPU per simulated second. A click on a head sorts. ', button('Save CSV', csv)]),
            table(columns, subject.rows, true));
    });
    return details;
}

/// Failures that have no cost, and so no place in the chart.
export function withoutCost(lines, subject) {
    const list = lines.flatMap((line) => line.failed.filter(({ us }) => !(us > 0)).map((row) => ({ row, line })));
    if (list.length === 0) return null;
    const kinds = [...new Set(list.map(({ row }) => row.status))].map((status) =>
        `${list.filter(({ row }) => row.status === status).length} ${status}`);
    return element('details', '', [element('summary', '', `Not in the chart, having no cost: ${kinds.join(', ')}`),
        element('ul', '', list.map(({ row, line }) => element('li', '', [`${line.label}, ${row.ladder} = ${row.value}: `,
            element('b', '', row.status), row.note ? `, ${row.note}` : '', row.status === 'done' ? `, error ${withUnit(row.error, subject.metric.unit)}` : ''])))]);
}
