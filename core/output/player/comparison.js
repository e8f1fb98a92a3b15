// SPDX-License-Identifier: MIT
// The page of a comparison: a verdict, tables, charts of free runs, and the worst disagreements drawn.
// "#finding=3" behind the address opens the third.
import { lineChart } from './chart.js';
import { comparisonStyle } from './comparison_style.js';
import { readComparison, readMeshes } from './data.js';
import { ManifoldView } from './manifolds.js';

const kColors = ['#d9522b', '#1668b8', '#1f9d55', '#8a4fbf', '#b8860b', '#0f8b8d'];

/// An element with text, or with children.
function element(tag, className, content = []) {
    const e = document.createElement(tag);
    if (className) e.className = className;
    if (Array.isArray(content)) e.append(...content);
    else e.textContent = content;
    return e;
}

function percent(share) {
    if (share >= 1) return '100 %';
    const shown = Math.min(100 * share, 99.9999);
    return `${shown.toFixed(shown > 99.99 ? 4 : 2)} %`;
}

const count = (n) => Math.round(n).toLocaleString('en');
const short = (value, unit) => (unit === 'ratio' ? value.toFixed(4)
    : `${value > 0 && value < 1e-3 ? value.toExponential(1) : Number(value.toPrecision(2))} ${unit}`);

function table(head, rows) {
    const cells = (tag, values) => element('tr', '', values.map((value, i) => {
        const cell = value instanceof Node ? element(tag, '', [value]) : element(tag, '', String(value));
        if (i > 0) cell.classList.add('number');
        return cell;
    }));
    return element('div', 'scroll', [element('table', '', [element('thead', '', [cells('th', head)]),
        element('tbody', '', rows.map((row) => cells('td', row)))])]);
}

function badge(text) {
    const kind = { agree: 'good', DIFFER: 'bad' }[text] ?? 'none';
    return element('span', `badge ${kind}`, text === 'DIFFER' ? 'differ' : text);
}

export class ComparisonPage {
    constructor() {
        this.data = readComparison();
        this.color = new Map(this.data.colliders.map(({ name }, i) => [name, kColors[i % kColors.length]]));
        document.head.append(element('style', '', comparisonStyle));
        const page = element('main', '', [this.header(), this.colliders(), ...this.data.pairs.map((p) => this.pair(p)),
            this.freeRuns(), this.findings(), this.notes()].filter(Boolean));
        document.body.append(page);
        if (this.data.disagreements.length > 0) this.startView();
    }

    name(collider) {
        const mark = element('i', 'mark');
        mark.style.background = this.color.get(collider);
        return element('span', 'collider', [mark, element('b', '', collider)]);
    }

    header() {
        const { data } = this;
        const about = `${count(data.poses)} poses over ${Number(data.simulated_time.toPrecision(3))} s, driven by ${data.driver}; `
            + `contacts are wanted up to ${Number((1e3 * data.margin).toPrecision(2))} mm apart`
            + `${data.interrupted ? '; interrupted' : ''}`;
        return element('header', '', [element('h1', '', [data.scene, ' ',
            element('span', `badge ${data.agrees ? 'good' : 'bad'}`, data.agrees ? 'the colliders agree' : 'the colliders differ')]),
        element('p', '', data.description), element('p', 'soft', about)]);
    }

    colliders() {
        const share = (part, f) => (f.contacts_a_pose > 0
            ? percent(part / (f.contacts_a_pose * this.data.poses)) : '–');
        const rows = this.data.colliders.map(({ name, version, precision, own_process: own, clipped: f, raw }) => [
            this.name(name), version + (own ? ' (own process)' : ''), precision, f.ms.median.toFixed(3),
            raw.ms.median.toFixed(3), count(f.contacts_a_pose), share(f.from_backend, f), share(f.from_clip, f),
            share(f.from_fallback, f), percent(f.own_normal_share), count(raw.contacts_a_pose)]);
        return element('section', '', [element('h2', '', 'Colliders'), table(['collider', 'version', 'precision',
            'ms a pose', 'raw ms', 'contacts a pose', 'of the back-end', 'clipped', 'fallback', 'own normals',
            'raw contacts'], rows)]);
    }

    totals(totals, judged) {
        const rows = totals.rows.map((row) => {
            const e = row.errors;
            return [row.label, row.tolerance, row.wanted === undefined ? '–' : percent(row.wanted), count(row.compared),
                row.compared > 0 ? percent(row.within) : '–', ...['median', 'p99', 'worst'].map((k) => (e ? short(e[k], e.unit) : '–')),
                judged ? badge(row.verdict) : ''];
        });
        return [table(['', 'tolerance', 'wanted', 'compared', 'within', 'median', '99 %', 'worst', ''], rows),
            element('p', 'soft', `Left out: ${count(totals.grazing)} grazing pairs, ${count(totals.apart)} pairs that are apart, `
                + `${count(totals.ambiguous_normals)} normals of two equally good axes.`)];
    }

    sets(sets, judged) {
        return ['convex', 'meshes'].flatMap((kind) => (sets[kind].compared > 0
            ? [...(kind === 'meshes' ? [element('h4', '', 'Pairs with a mesh')] : []), ...this.totals(sets[kind], judged)] : []));
    }

    pair(pair) {
        const raw = element('details', '', [element('summary', '', 'Raw: what the back-ends themselves say' + (this.data.raw_judged ? '' : ', not judged')),
            ...this.sets(pair.raw, this.data.raw_judged)]);
        raw.open = this.data.raw_judged;
        return element('section', '', [element('h2', '', [this.name(pair.first), ' and ', this.name(pair.second), ' ',
            badge(pair.agrees ? 'agree' : 'DIFFER')]), ...this.sets(pair.clipped, true), raw]);
    }

    freeRuns() {
        const runs = this.data.free_run;
        if (!runs) return null;
        const color = (name) => this.color.get(name);
        const names = ({ first, second }) => `${first}, ${second}`;
        const pairColor = (i) => kColors[i % kColors.length];
        const charts = [
            lineChart({ title: 'Largest distance between the same bodies [m]', x: runs.times,
                lines: runs.pairs.map((p, i) => ({ name: names(p), color: pairColor(i), y: p.largest })) }),
            lineChart({ title: 'Mean distance between the same bodies [m]', x: runs.times,
                lines: runs.pairs.map((p, i) => ({ name: names(p), color: pairColor(i), y: p.mean })) }),
            lineChart({ title: 'Mean height of moving bodies [m]', x: runs.times,
                lines: runs.colliders.map(({ name, height }) => ({ name, color: color(name), y: height })) }),
            lineChart({ title: 'Energy, kinetic and potential [J]', x: runs.times,
                lines: runs.colliders.map(({ name, energy }) => ({ name, color: color(name), y: energy })) }),
        ];
        return element('section', '', [element('h2', '', 'Free runs'), element('p', 'soft',
            'Each collider drives a run of its own from the same start. Small differences grow; heights and energies should stay alike.'),
        element('div', 'charts', charts)]);
    }

    findings() {
        const { disagreements } = this.data;
        if (disagreements.length === 0)
            return element('section', '', [element('h2', '', 'Disagreements'), element('p', '', 'None.')]);
        this.buttons = disagreements.map((d, i) => {
            const button = element('button', 'finding', [element('b', '', `${d.aspect}, ${d.set}`),
                element('span', '', `${d.colliders.join(' and ')}: ${d.words}`),
                element('span', 'soft', `${d.bodies[0].name} and ${d.bodies[1].name} at ${Number(d.time.toPrecision(4))} s`)]);
            button.onclick = () => this.select(i);
            return button;
        });
        this.canvas = element('canvas', '');
        this.canvas.setAttribute('aria-label', 'Both answers on the two bodies; drag to turn, wheel to zoom');
        this.legend = element('div', 'legend');
        this.words = element('div', 'words');
        return element('section', '', [element('h2', '', 'Worst disagreements'), element('div', 'viewer', [
            element('nav', 'list', this.buttons),
            element('div', 'stage', [element('div', 'frame', [this.canvas, this.legend]), this.words])])]);
    }

    startView() {
        this.view = new ManifoldView(this.canvas, this.data.shapes, readMeshes());
        addEventListener('resize', () => this.view.resize());
        addEventListener('keydown', (event) => {
            const way = { ArrowDown: 1, ArrowUp: -1 }[event.key];
            if (way && this.buttons.includes(document.activeElement)) {
                event.preventDefault();
                this.select(this.chosen + way);
                this.buttons[this.chosen].focus();
            }
        });
        const asked = Number(new URLSearchParams(location.hash.slice(1)).get('finding') ?? 1);
        this.select(Number.isFinite(asked) ? asked - 1 : 0);
    }

    select(index) {
        this.chosen = Math.max(0, Math.min(index, this.buttons.length - 1));
        this.buttons.forEach((button, i) => button.classList.toggle('chosen', i === this.chosen));
        const finding = this.data.disagreements[this.chosen];
        this.shown = [true, true];
        this.view.show(finding, finding.colliders.map((name) => this.color.get(name)));
        this.legend.replaceChildren(...finding.colliders.map((name, i) => {
            const box = element('input', '');
            Object.assign(box, { type: 'checkbox', checked: true });
            box.onchange = () => this.view.setVisible(i, box.checked);
            return element('label', '', [box, this.name(name)]);
        }));
        this.words.replaceChildren(...this.sentences(finding));
    }

    sentences(finding) {
        const [a, b] = finding.bodies;
        const answers = finding.colliders.map((name, i) =>
            element('p', '', [this.name(name), `: ${finding.answers[i].words}`]));
        return [element('p', '', [element('b', '', a.name), ` (${a.shape}) and `, element('b', '', b.name),
            ` (${b.shape}) at ${Number(finding.time.toPrecision(4))} s, step ${finding.step}`]),
        element('p', 'bad-text', finding.words + (finding.judged ? '' : ' (not judged)')), ...answers];
    }

    notes() {
        return element('footer', 'soft', 'L is the longest side of the smaller body; s. the sagitta and e. the longest edge of a mesh\'s facets. '
            + 'A pair that only one collider reports is grazing, and left out, where its gap is within a narrow band about 0 or about the margin. '
            + 'Normals deeper than 5 % L are reported and not judged: there is no one right answer. Arrows point out of the second body towards the first; '
            + 'the first collider\'s points are solid, the second\'s are rings about them.');
    }
}
