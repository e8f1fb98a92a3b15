// SPDX-License-Identifier: MIT
// Elements, numbers and words of the page. What the study says is only ever set as text.

/// An element with text, or with children.
export function element(tag, className, content = []) {
    const e = document.createElement(tag);
    if (className) e.className = className;
    if (Array.isArray(content)) e.append(...content.filter((c) => c !== null && c !== undefined && c !== ''));
    else e.textContent = content;
    return e;
}

export function button(text, onclick, className = '') {
    const e = element('button', className, text);
    e.type = 'button';
    e.onclick = onclick;
    return e;
}

const superscript = (power) => String(power).replace(/[-0-9]/g, (c) => (c === '-' ? '\u207b' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[c]));

/// "10⁻⁴"
export const powerOfTen = (power) => `10${superscript(power)}`;

/// "0.0123", "1.2×10⁻⁵"
export function number(value, digits = 3) {
    if (value === null || value === undefined || !Number.isFinite(value)) return '–';
    if (value === 0) return '0';
    const size = Math.abs(value);
    if (size >= 0.999e-3 && size < 1e6) {
        const rounded = Number(value.toPrecision(digits));
        return size >= 1e4 ? rounded.toLocaleString('en') : String(rounded);
    }
    const [mantissa, power] = value.toExponential(digits - 1).split('e');
    return `${Number(mantissa)}×${powerOfTen(Number(power))}`;
}

/// "1.2 ms" out of microseconds.
export function duration(us) {
    if (us === null || us === undefined || !Number.isFinite(us)) return '–';
    const [factor, unit] = us >= 1e6 ? [1e6, 's'] : us >= 1e3 ? [1e3, 'ms'] : [1, 'µs'];
    return `${number(us / factor)} ${unit}`;
}

export const withUnit = (value, unit) => (unit ? `${number(value)} ${unit}` : number(value));

/// A table whose columns are {head, value(row), shown(row), number}: a click on a head sorts where `sortable`.
export function table(columns, rows, sortable = false) {
    const body = element('tbody');
    const fill = (list) => body.replaceChildren(...list.map((row) => {
        const line = element('tr', '', columns.map((c) => {
            const shown = c.shown ? c.shown(row) : c.value(row) ?? '';
            return element('td', c.number ? 'number' : '', shown instanceof Node ? [shown] : String(shown));
        }));
        if (row.front) line.className = 'front';
        return line;
    }));
    let sorted = null, up = true;
    const sort = (column) => {
        up = sorted === column ? !up : true;
        sorted = column;
        const sign = up ? 1 : -1;
        fill([...rows].sort((a, b) => {
            const [x, y] = [column.value(a) ?? Infinity, column.value(b) ?? Infinity];
            return sign * (typeof x === 'string' || typeof y === 'string' ? String(x).localeCompare(String(y)) : x - y || 0);
        }));
    };
    const heads = columns.map((c) => {
        const cell = element('th', c.number ? 'number' : '', sortable ? [button(c.head, () => sort(c), 'sort')] : c.head);
        cell.scope = 'col';
        return cell;
    });
    fill(rows);
    return element('div', 'scroll', [element('table', '', [element('thead', '', [element('tr', '', heads)]), body])]);
}
