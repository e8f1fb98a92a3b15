// SPDX-License-Identifier: MIT
// A chart with what belongs to it: a legend that shows and hides lines, a caption, and buttons that save it.
import { button, element } from './dom.js';
import { sample } from './sample.js';
import { kPaperHeight, kPaperWidth, savePng, saveSvg, standalone } from './save.js';

const kHeight = 500, kNarrow = 560;
/// What a sheet of paper holds where text has its usual size [pixels].
const kPrintWidth = 720;

/// chart: {title, file, lines: [{key, label, look, mark}], shown: Set of keys, extra: legend entries without a line,
/// caption, draw(shown, {width, height, still, tips}): an SVG whose data under the pointer have a text}
export class ChartFigure {
    constructor(chart) {
        this.chart = chart;
        this.shown = new Set(chart.shown);
        this.stage = element('div', 'stage');
        this.told = element('div', 'told');  // what a tip would say, where a chart has no room for tips
        this.items = chart.lines.map((line) => this.item(line));
        this.node = element('figure', '', [this.stage, this.told, this.legend(), element('figcaption', '', [
            element('span', '', chart.caption), this.savers()])]);
        new ResizeObserver(() => this.draw()).observe(this.stage);
        addEventListener('beforeprint', () => this.draw(kPrintWidth));
        addEventListener('afterprint', () => this.draw());
    }

    item(line) {
        const item = button('', () => {
            if (!this.shown.delete(line.key)) this.shown.add(line.key);
            this.refresh();
        }, 'entry');
        item.append(sample(line.look), element('span', '', line.label));
        item.title = 'Click to show or hide';
        item.onmouseenter = () => this.shown.has(line.key) && this.dimOthers(line.mark);
        item.onmouseleave = () => this.dimOthers(null);
        return item;
    }

    legend() {
        const show = (keys) => () => {
            this.shown = new Set(keys);
            this.refresh();
        };
        const { lines, shown, extra } = this.chart;
        const choices = [button('main lines', show(shown)), button('all', show(lines.map(({ key }) => key))), button('none', show([]))];
        const chooser = element('span', 'choices', ['Show ', ...(shown.size < lines.length ? choices : choices.slice(1))]);
        const fixed = extra.map(({ look, label }) => element('span', 'entry fixed', [sample(look), element('span', '', label)]));
        const first = this.items.filter((_, i) => shown.has(lines[i].key)), rest = this.items.filter((item) => !first.includes(item));
        const more = rest.length > 0 ? element('details', 'more', [element('summary', '', `${rest.length} more lines`),
            element('div', 'legend', rest)]) : null;
        return element('div', '', [element('div', 'legend', [...fixed, ...first, chooser]), more]);
    }

    savers() {
        const file = () => standalone(this.chart.draw(this.shown, { width: kPaperWidth, height: kPaperHeight, still: true }),
            this.chart.title, [...this.chart.extra, ...this.chart.lines.filter(({ key }) => this.shown.has(key))], this.chart.caption);
        return element('span', 'savers', [button('Save SVG', () => saveSvg(this.chart.file, file())),
            button('Save PNG', () => savePng(this.chart.file, file()))]);
    }

    dimOthers(mark) {
        for (const g of this.stage.querySelectorAll('g[class^=line-]'))
            g.style.opacity = mark === null || g.classList.contains(mark) ? '' : 0.12;
    }

    refresh() {
        this.width = 0;
        this.draw();
    }

    /// Draws anew where the width changed.
    draw(width = Math.floor(this.stage.clientWidth)) {
        if (width === 0 || width === this.width) return;
        this.width = width;
        this.items.forEach((item, i) =>
            item.setAttribute('aria-pressed', String(this.shown.has(this.chart.lines[i].key))));
        const tips = width >= kNarrow;
        const svg = this.chart.draw(this.shown, { width, height: tips ? kHeight : 400, tips });
        this.told.textContent = tips ? '' : 'Touch a point to read its numbers here.';
        svg.addEventListener('input', () => {
            if (!tips && svg.value) this.told.textContent = svg.value.text;
        });
        svg.setAttribute('role', 'img');
        svg.setAttribute('aria-label', this.chart.title);
        this.stage.replaceChildren(svg);
    }
}
