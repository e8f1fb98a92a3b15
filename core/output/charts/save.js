// SPDX-License-Identifier: MIT
// Charts as files: a drawing that stands alone, with its title, its legend and its caption.
import { element } from './dom.js';
import { sample } from './sample.js';

const kMargin = 18, kFont = 'Helvetica, Arial, "Liberation Sans", sans-serif', kInk = '#1d2731', kPaper = '#ffffff';
export const kPaperWidth = 900, kPaperHeight = 520;

const measure = document.createElement('canvas').getContext('2d');

function textWidth(text, size, bold = false) {
    measure.font = `${bold ? '600 ' : ''}${size}px ${kFont}`;
    return measure.measureText(text).width;
}

/// Words of a text in lines of at most `width` pixels.
function wrapped(text, width, size) {
    const lines = [''];
    for (const word of text.split(/\s+/)) {
        const longer = lines.at(-1) ? `${lines.at(-1)} ${word}` : word;
        if (lines.at(-1) && textWidth(longer, size) > width) lines.push(word);
        else lines[lines.length - 1] = longer;
    }
    return lines;
}

/// An SVG element; `like`: any element of SVG, which knows the namespace.
function node(like, tag, attributes, text) {
    const e = document.createElementNS(like.namespaceURI, tag);
    for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
    if (text !== undefined) e.textContent = text;
    return e;
}

/// Legend entries in rows: [{x, y, entry}] and the height that they take.
function legendPlaces(entries, width) {
    const places = [];
    let x = 0, y = 0;
    for (const entry of entries) {
        const wide = 44 + textWidth(entry.label, 12.5) + 16;
        if (x > 0 && x + wide > width) [x, y] = [0, y + 20];
        places.push({ x, y, entry });
        x += wide;
    }
    return { places, height: entries.length > 0 ? y + 24 : 0 };
}

/// One SVG of chart (as Plot draws it, kPaperWidth wide), title, legend and caption.
export function standalone(chart, title, entries, caption) {
    const width = kPaperWidth + 2 * kMargin, inner = kPaperWidth;
    const titles = wrapped(title, inner, 17), captions = wrapped(caption, inner, 11.5);
    const legend = legendPlaces(entries, inner);
    const legendTop = kMargin + 24 * titles.length + Number(chart.getAttribute('height')) + 12, captionTop = legendTop + legend.height + 12;
    const height = captionTop + 16 * captions.length + kMargin - 8;
    const svg = node(chart, 'svg', { viewBox: `0 0 ${width} ${height}`, width, height, color: kInk, fill: kInk,
        'font-family': kFont, 'font-size': 12.5 });
    svg.append(node(chart, 'rect', { width, height, fill: kPaper }));
    titles.forEach((line, i) => svg.append(node(chart, 'text', { x: kMargin, y: kMargin + 16 + 24 * i, 'font-size': 17,
        'font-weight': 600 }, line)));
    for (const sheet of chart.querySelectorAll('style')) sheet.remove();
    const placed = node(chart, 'g', { 'text-anchor': 'middle', transform: `translate(${kMargin},${kMargin + 24 * titles.length})` });
    placed.append(...chart.childNodes);
    svg.append(placed);
    for (const { x, y, entry } of legend.places) {
        const item = node(chart, 'g', { transform: `translate(${kMargin + x},${legendTop + y})` });
        const mark = sample(entry.look);
        item.append(...mark.childNodes, node(chart, 'text', { x: 42, y: 12 }, entry.label));
        svg.append(item);
    }
    captions.forEach((line, i) => svg.append(node(chart, 'text', { x: kMargin, y: captionTop + 10 + 16 * i, 'font-size': 11.5,
        'fill-opacity': 0.75 }, line)));
    return { text: new XMLSerializer().serializeToString(svg).replaceAll('var(--card)', kPaper), width, height };
}

export function download(name, blob) {
    const link = element('a');
    link.download = name;
    link.setAttribute('href', URL.createObjectURL(blob));
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.getAttribute('href')), 10000);
}

export const saveSvg = (name, { text }) => download(`${name}.svg`, new Blob([text], { type: 'image/svg+xml' }));

/// At twice the size, which is sharp in print.
export function savePng(name, { text, width, height }) {
    const picture = new Image(), address = URL.createObjectURL(new Blob([text], { type: 'image/svg+xml' }));
    picture.onload = () => {
        const canvas = Object.assign(document.createElement('canvas'), { width: 2 * width, height: 2 * height });
        canvas.getContext('2d').drawImage(picture, 0, 0, 2 * width, 2 * height);
        URL.revokeObjectURL(address);
        canvas.toBlob((blob) => download(`${name}.png`, blob));
    };
    picture.src = address;
}

/// Rows of text as RFC 4180 wants them.
export function saveCsv(name, rows) {
    const field = (value) => (/[",\r\n]/.test(String(value)) ? `"${String(value).replaceAll('"', '""')}"` : String(value));
    download(`${name}.csv`, new Blob([rows.map((row) => `${row.map((v) => field(v ?? '')).join(',')}\n`).join('')], { type: 'text/csv' }));
}
