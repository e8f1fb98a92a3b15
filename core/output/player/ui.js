// SPDX-License-Identifier: MIT
// The panels of the page: what is shown, the numbers of a frame, and the controls.
import { style } from './style.js';

const kSpeeds = [0.1, 0.25, 0.5, 1, 2];
const kIcons = {
    play: 'M8 5v14l11-7z', pause: 'M7 5h4v14H7zM13 5h4v14h-4z',
    back: 'M7 6h2v12H7zM19 6v12l-8-6z', forth: 'M15 6h2v12h-2zM5 6v12l8-6z',
    fit: 'M4 9V4h5v2H6v3zM15 4h5v5h-2V6h-3zM18 15h2v5h-5v-2h3zM4 15h2v3h3v2H4z',
};
const kPrefixes = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, 'µ']];

const icon = (name) => `<svg width="20" height="20" viewBox="0 0 24 24" fill="currentColor" aria-hidden="true">`
    + `<path d="${kIcons[name]}"/></svg>`;

/// "1.23 kJ"
export function withUnit(value, unit) {
    if (value === null || !Number.isFinite(value)) return '–';
    const size = Math.abs(value);
    if (size < 5e-7) return `0 ${unit}`;
    const [factor, prefix] = kPrefixes.find(([f]) => size >= f) ?? kPrefixes.at(-1);
    return `${(value / factor).toPrecision(3)} ${prefix}${unit}`;
}

/// "0.31 %"
function percent(share) {
    const value = 100 * share;
    if (value < 1e-6) return '0 %';
    return `${value < 100 ? Number(value.toPrecision(2)) : Math.round(value).toLocaleString('en')} %`;
}

/// The height of the curve of what is left unsolved, in [0, 1]: from a millionth of the weight to all of it, by powers of ten.
const heightOf = (share) => Math.min(1, Math.max(0, 1 + Math.log10(share) / 6));

/// That curve as the path of an SVG, 1000 wide and 100 high, with gaps where nobody told.
function curvePath(times, shares) {
    const start = times[0], length = times.at(-1) - start || 1;
    let path = '', stroke = 'M';
    shares.forEach((share, i) => {
        if (share !== null) {
            path += `${stroke}${(1000 * (times[i] - start) / length).toFixed(1)} ${(100 - 100 * heightOf(share)).toFixed(1)}`;
        }
        stroke = share === null ? 'M' : 'L';
    });
    return path;
}

const kPage = `
<canvas tabindex="0" aria-label="The scene; drag to turn, wheel to zoom"></canvas>
<section id="about" class="panel"><h1></h1><p id="description"></p><p id="made"></p></section>
<dl id="numbers" class="panel">
  <dt>Bodies</dt><dd id="bodies"></dd><dt class="soft-only">Particles</dt><dd id="particles" class="soft-only"></dd><dt>Contacts</dt><dd id="contacts"></dd>
  <dt>Kinetic energy</dt><dd id="kinetic"></dd><dt>Potential energy</dt><dd id="potential"></dd>
  <dt>Penetration</dt><dd id="penetration"></dd><div id="unsolved"></div><div id="picked"></div></dl>
<nav id="controls" class="panel" aria-label="Replay">
  <button id="play" title="Play or pause (space)" aria-label="Play">${icon('play')}</button>
  <button id="back" title="One frame back (←)" aria-label="One frame back">${icon('back')}</button>
  <button id="forth" title="One frame on (→)" aria-label="One frame on">${icon('forth')}</button>
  <div id="timeline"><svg id="curve" viewBox="0 0 1000 100" preserveAspectRatio="none"><title>Unsolved, as a share of the weight: from 0.0001 % to 100 %, by powers of ten</title><path/></svg>
    <input id="scrub" type="range" min="0" max="1" step="any" value="0" aria-label="Time"></div>
  <div id="clock"></div>
  <select id="speed" title="Speed" aria-label="Speed">${kSpeeds.map((s) =>
        `<option value="${s}"${s === 1 ? ' selected' : ''}>${s}×</option>`).join('')}</select>
  <button id="fit" title="Fit view (F)" aria-label="Fit view">${icon('fit')}</button>
</nav>`;

export class Interface {
    constructor(scene) {
        const sheet = document.createElement('style');
        sheet.textContent = style;
        document.head.append(sheet);
        const page = document.createElement('main');
        page.innerHTML = kPage;  // constant; what the scene says is only ever set as text
        document.body.append(page);
        for (const e of page.querySelectorAll('[id]')) this[e.id] = e;
        this.canvas = page.querySelector('canvas');
        this.times = scene.frames.time;
        this.frames = scene.frames;
        this.describe(scene);
    }

    describe(scene) {
        this.about.querySelector('h1').textContent = scene.name || 'Scene';
        this.description.textContent = scene.description;
        this.made.textContent = [scene.collider && `Collider ${scene.collider}`, scene.method &&
            `method ${scene.method}`, scene.dt > 0 && `step ${withUnit(scene.dt, 's')}`].filter(Boolean).join(' · ');
        this.bodies.textContent = scene.bodies.length.toLocaleString('en');
        const particles = scene.deformables.reduce((sum, { count }) => sum + count, 0);
        this.particles.textContent = particles.toLocaleString('en');
        this.numbers.classList.toggle('rigid', particles === 0);
        this.scrub.min = this.times[0] ?? 0;
        this.scrub.max = this.times.at(-1) ?? 0;
        this.describeResidual(scene.frames.residual);
    }

    /// What a recording from before there were any, or a program that told none, lacks is not shown.
    describeResidual(residual) {
        const path = curvePath(this.times, residual?.force_of_weight ?? []);
        this.curve.querySelector('path').setAttribute('d', path);
        this.curve.classList.toggle('untold', path === '');
        this.unsolved.classList.toggle('untold', path === '');
    }

    showPlaying(playing) {
        this.play.innerHTML = icon(playing ? 'pause' : 'play');
        this.play.setAttribute('aria-label', playing ? 'Pause' : 'Play');
    }

    showFrame(time, frame) {
        const last = this.times.at(-1) ?? 0, { frames } = this;
        this.scrub.value = time;
        this.clock.innerHTML = `${time.toFixed(2)} / ${last.toFixed(2)} s`
            + `<small>frame ${frame + 1} of ${this.times.length}</small>`;
        this.contacts.textContent = (frames.contacts[frame] ?? 0).toLocaleString('en');
        this.kinetic.textContent = withUnit(frames.kinetic[frame], 'J');
        this.potential.textContent = withUnit(frames.potential[frame], 'J');
        this.penetration.textContent = withUnit(frames.penetration[frame], 'm');
        if (frames.residual) this.showResidual(frame);
    }

    /// "Unsolved: 0.31 % of weight, 2.00 µm"; the force itself where the pointer rests on it.
    showResidual(frame) {
        const { force_of_weight: shares, force, error } = this.frames.residual;
        const share = shares[frame] ?? null;
        this.unsolved.textContent = 'Unsolved: '
            + (share === null ? '–' : `${percent(share)} of weight, ${withUnit(error[frame], 'm')}`);
        this.unsolved.title = share === null ? '' : `at the most ${withUnit(force[frame], 'N')}`;
    }

    showPicked(text) {
        this.picked.style.display = text ? 'block' : 'none';
        this.picked.textContent = text;
    }
}

/// A sentence instead of the replay, where the browser cannot draw it.
export function showFailure(error) {
    const sheet = document.createElement('style');
    sheet.textContent = style;
    const panel = document.createElement('div');
    panel.id = 'failure';
    panel.className = 'panel';
    panel.textContent = `This replay cannot be shown: ${error.message}`;
    document.head.append(sheet);
    document.body.append(panel);
}
