// SPDX-License-Identifier: MIT
// The page of an accuracy-cost study: advice, a chart and tables for each subject, a performance profile.
// The study is the JSON of the element "plumb-study" (format: README.md).
import { importantLines, linesOf, Looks } from './curves.js';
import { element, number } from './dom.js';
import { ChartFigure } from './figure.js';
import { pageStyle } from './page_style.js';
import { profileChart, profileLines } from './profile.js';
import { departuresTable, rowsDetails, slopesTable, withoutCost } from './tables.js';
import { workPrecision } from './work_precision.js';

const fileName = (text) => String(text).toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '') || 'chart';

/// "Measured on …; built with …; Plumb 1.0; 1 May 2025."
function machineText(machine = {}) {
    const parts = [machine.cpu && `Measured on ${machine.cpu}`, machine.flags && `built with ${machine.flags}`,
        machine.version && (/plumb/i.test(machine.version) ? machine.version : `Plumb ${machine.version}`), machine.date];
    return `${parts.filter(Boolean).join('; ')}.`;
}

function header(study, subjects) {
    const links = subjects.map(({ title, name }, i) => {
        const link = element('a', '', title || name);
        link.setAttribute('href', `#subject-${i + 1}`);
        return link;
    });
    return element('header', '', [element('h1', '', study.title || document.title), element('p', 'soft', machineText(study.machine)),
        links.length > 1 || study.profile ? element('nav', '', links) : null]);
}

function advice(subjects) {
    const parts = subjects.map((subject, i) => ({ subject, i })).filter(({ subject }) => subject.advice?.length > 0)
        .flatMap(({ subject, i }) => {
            const link = element('a', '', subject.title || subject.name);
            link.setAttribute('href', `#subject-${i + 1}`);
            return [subjects.length > 1 ? element('h3', '', [link]) : null,
                element('ul', '', subject.advice.map((sentence) => element('li', '', sentence)))];
        });
    return parts.length > 0 ? element('section', 'advice', [element('h2', '', 'What it costs'), ...parts]) : null;
}

function introduction(subject) {
    const { metric, reference } = subject;
    const known = Number.isFinite(subject.horizon) && subject.horizon !== null
        ? ` No formula tells this scene's motion; it could be predicted until ${number(subject.horizon)} s, and errors count until then.` : '';
    return element('p', 'soft', `Error: ${metric.what || metric.name}${metric.unit ? ` [${metric.unit}]` : ''}.`
        + `${reference ? ` Compared with: ${reference}.` : ''}${known}`);
}

function subjectSection(subject, index, study, looks) {
    const lines = linesOf(subject, looks), title = subject.title || subject.name;
    const shown = importantLines(lines, subject.tolerance);
    const failed = lines.some((line) => line.failed.some(({ us }) => us > 0));
    const extra = [...(subject.rows.some((r) => r.front) ? [{ look: { front: true }, label: 'Pareto front: least error for the cost' }] : []),
        ...(failed ? [{ look: { failure: true }, label: 'failed, at the cost it had (grey: of a hidden line)' }] : [])];
    const figure = new ChartFigure({ title, file: `${fileName(subject.name || title)}-cost`, lines, shown, extra,
        caption: machineText(study.machine), draw: (keys, size) => workPrecision(subject, lines, keys, looks, size) });
    const section = element('section', '', [element('h2', '', title), introduction(subject), lines.length > 0 ? figure.node : element('p', '', 'Nothing was run.'), withoutCost(lines, subject),
        ...(subject.slopes?.length > 0 ? slopesTable(subject.slopes) : []),
        ...(subject.departures?.length > 0 ? departuresTable(subject.departures) : []),
        lines.length === 0 ? null : rowsDetails(subject, `${fileName(subject.name || title)}-rows`)]);
    section.id = `subject-${index + 1}`;
    return section;
}

function profileSection(study, looks) {
    if (!(study.profile?.curves?.length > 0)) return null;
    const lines = profileLines(study.profile, looks);
    const figure = new ChartFigure({ title: `Performance profile: ${study.profile.what}`, file: 'performance-profile', lines,
        shown: new Set(lines.slice(0, 9).map(({ key }) => key)), extra: [], caption: machineText(study.machine),
        draw: (keys, size) => profileChart(lines, keys, { ...size, height: Math.min(size.height, 420) }) });
    return element('section', '', [element('h2', '', 'Over all cases'), element('p', 'soft', study.profile.what
        ? `Performance profile: ${study.profile.what}. A curve that is higher at the left is cheapest more often; one that ends higher solves more cases.` : ''),
    figure.node]);
}

function build() {
    const study = JSON.parse(document.getElementById('plumb-study').textContent);
    const subjects = study.subjects.map((subject) => ({ ...subject, metric: subject.metric ?? {}, rows: subject.rows ?? [] }));
    const looks = new Looks(subjects);
    document.body.append(element('main', '', [header(study, subjects), advice(subjects),
        ...subjects.map((subject, i) => subjectSection(subject, i, study, looks)), profileSection(study, looks)]));
    if (location.hash) document.getElementById(location.hash.slice(1))?.scrollIntoView();
}

document.head.append(element('style', '', pageStyle));
try {
    build();
} catch (error) {
    document.body.append(element('main', '', [element('section', '', `This study cannot be shown: ${error.message}`)]));
}
