// SPDX-License-Identifier: MIT
// What a page of Plumb shows: a comparison of colliders where it carries one (comparison.js), else the replay of a run: draws the frames that the page carries, and lets time be played and scrubbed.
// "#t=2.5" behind the address opens it paused at 2.5 s.
import * as THREE from 'three';
import { ComparisonPage } from './comparison.js';
import { Motion, readMeshes, readScene } from './data.js';
import { Deformables } from './deformables.js';
import { ShapeLibrary } from './shapes.js';
import { Stage } from './stage.js';
import { Interface, showFailure, withUnit } from './ui.js';

class Player {
    constructor() {
        this.scene = readScene();
        this.motion = new Motion(this.scene);
        this.times = this.scene.frames.time;
        this.ui = new Interface(this.scene);
        this.stage = new Stage(this.ui.canvas, this.scene);
        this.matrices = this.scene.bodies.map(() => new THREE.Matrix4());
        const bytes = readMeshes();
        this.addBodies(bytes);
        this.deformables = new Deformables(this.scene, bytes, this.matrices);
        this.stage.world.add(...this.deformables.objects);
        this.surround();
        this.time = this.times[0] ?? 0;
        this.playing = this.times.length > 1;
        this.speed = 1;
        this.picked = -1;  // body
        this.pickedPoint = null;  // of a deformable
        this.dirty = true;
        this.listen();
        this.startAt(new URLSearchParams(location.hash.slice(1)).get('t'));
        this.ui.showPlaying(this.playing);
        this.last = null;
        requestAnimationFrame((now) => this.tick(now));
    }

    startAt(text) {
        if (text === null || !Number.isFinite(+text)) return;
        this.playing = false;
        this.seek(+text);
    }

    addBodies(bytes) {
        const { scene } = this;
        for (const [i, body] of scene.bodies.entries()) {
            if (!body.pose) continue;
            const [x, y, z, ...q] = body.pose;
            this.matrices[i].compose(new THREE.Vector3(x, y, z), new THREE.Quaternion(...q),
                new THREE.Vector3(1, 1, 1));
        }
        const library = new ShapeLibrary(scene, bytes);
        const cell = this.gridCell();
        for (const [i, body] of scene.bodies.entries()) {
            const shape = scene.shapes[body.shape];
            if (!shape) continue;
            if (shape.kind === 'plane') this.stage.addGround(this.matrices[i], cell);
            else library.add(shape, i, new THREE.Matrix4());
        }
        this.meshes = library.meshes(scene.bodies.map((body) => new THREE.Color(body.color)));
        for (const mesh of this.meshes) this.stage.world.add(mesh);
        this.place(0, 0);
        const moving = new Set(scene.moving.map(({ body }) => body));
        for (const mesh of this.meshes) {
            this.fillInstances(mesh);
            mesh.userData.moves = mesh.userData.items.some(({ body }) => moving.has(body));
        }
    }

    /// Side of the ground's cells [m]: 1, 2 or 5 times a power of ten, some twentieth of the view.
    gridCell() {
        const { eye, target } = this.scene.view;
        const wanted = new THREE.Vector3(...eye).distanceTo(new THREE.Vector3(...target)) / 14;
        const power = 10 ** Math.floor(Math.log10(wanted));
        return power * [1, 2, 5, 10].findLast((f) => f * power <= wanted * 1.001);
    }

    /// Matrices of the moving bodies.
    place(frame, fraction) {
        const position = new THREE.Vector3(), rotation = new THREE.Quaternion();
        const one = new THREE.Vector3(1, 1, 1);
        if (this.times.length === 0) return;
        this.scene.moving.forEach(({ body }, index) => {
            this.motion.pose(position, rotation, index, frame, fraction);
            this.matrices[body].compose(position, rotation, one);
        });
    }

    fillInstances(mesh) {
        const matrix = new THREE.Matrix4();
        mesh.userData.items.forEach(({ body, local }, i) => {
            mesh.setMatrixAt(i, matrix.multiplyMatrices(this.matrices[body], local));
        });
        mesh.instanceMatrix.needsUpdate = true;
        mesh.boundingSphere = null;
    }

    /// Ball about what can move, without the few that are far from the rest.
    ball() {
        const places = this.scene.bodies.flatMap((body, i) => (body.fixed || body.shape < 0
            ? [] : [new THREE.Vector3().setFromMatrixPosition(this.matrices[i])]));
        places.push(...this.deformables.someOfEach());
        if (places.length === 0) return null;
        const middle = new THREE.Vector3(...['x', 'y', 'z'].map((axis) =>
            places.map((p) => p[axis]).sort((a, b) => a - b)[places.length >> 1]));
        const distances = places.map((p) => p.distanceTo(middle)).sort((a, b) => a - b);
        const most = 5 * distances[places.length >> 1];
        const radius = distances.findLast((d) => d <= most) ?? 0;
        return { middle, radius: 1.25 * radius || this.stage.camera.position.distanceTo(middle) / 4 };
    }

    surround() {
        const { eye, target, field_of_view: angle } = this.scene.view;
        const middle = new THREE.Vector3(...target);
        const distance = middle.distanceTo(new THREE.Vector3(...eye));
        this.stage.surround(middle, 1.5 * distance * Math.tan(THREE.MathUtils.degToRad(angle / 2)));
    }

    /// Number of the frame that a time stands in, and how far it is towards the next.
    frameAt(time) {
        let low = 0, high = this.times.length - 1;
        while (low < high) {
            const middle = (low + high + 1) >> 1;
            if (this.times[middle] <= time) low = middle;
            else high = middle - 1;
        }
        const length = this.times[low + 1] - this.times[low];
        return [low, length > 0 ? THREE.MathUtils.clamp((time - this.times[low]) / length, 0, 1) : 0];
    }

    seek(time) {
        this.time = THREE.MathUtils.clamp(time, this.times[0] ?? 0, this.times.at(-1) ?? 0);
        this.dirty = true;
    }

    stepFrames(count) {
        this.setPlaying(false);
        const [frame, fraction] = this.frameAt(this.time);
        const from = count < 0 && fraction > 0.01 ? frame + 1 : frame;
        this.seek(this.times[THREE.MathUtils.clamp(from + count, 0, this.times.length - 1)] ?? 0);
    }

    setPlaying(playing) {
        if (playing && this.time >= (this.times.at(-1) ?? 0)) this.seek(this.times[0] ?? 0);
        this.playing = playing;
        this.ui.showPlaying(playing);
    }

    fit() {
        const ball = this.ball();
        if (ball) this.stage.fit(ball.middle, ball.radius);
        this.dirty = true;
    }

    listen() {
        const { ui, stage } = this;
        ui.play.onclick = () => this.setPlaying(!this.playing);
        ui.back.onclick = () => this.stepFrames(-1);
        ui.forth.onclick = () => this.stepFrames(1);
        ui.fit.onclick = () => this.fit();
        ui.scrub.oninput = () => this.seek(+ui.scrub.value);
        ui.speed.onchange = () => { this.speed = +ui.speed.value; };
        stage.controls.addEventListener('change', () => { this.dirty = true; });
        addEventListener('resize', () => { stage.resize(); this.dirty = true; });
        addEventListener('keydown', (event) => this.onKey(event));
        this.listenForPicks();
        stage.resize();
    }

    onKey(event) {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const actions = {
            ' ': () => this.setPlaying(!this.playing),
            ArrowLeft: () => this.stepFrames(event.shiftKey ? -10 : -1),
            ArrowRight: () => this.stepFrames(event.shiftKey ? 10 : 1),
            Home: () => this.seek(-Infinity), End: () => this.seek(Infinity),
            f: () => this.fit(), h: () => { this.stage.goHome(); this.dirty = true; },
        };
        const action = actions[event.key];
        if (!action || event.target.tagName === 'SELECT') return;
        event.preventDefault();
        action();
    }

    /// A click that is no drag names the body under it.
    listenForPicks() {
        let down = null;
        this.ui.canvas.addEventListener('pointerdown', (e) => { down = [e.clientX, e.clientY]; });
        this.ui.canvas.addEventListener('pointerup', (e) => {
            if (!down || Math.hypot(e.clientX - down[0], e.clientY - down[1]) > 4) return;
            const caster = new THREE.Raycaster();
            caster.setFromCamera(new THREE.Vector2(2 * e.clientX / innerWidth - 1,
                1 - 2 * e.clientY / innerHeight), this.stage.camera);
            const [hit] = caster.intersectObjects([...this.meshes, ...this.deformables.objects]);
            this.picked = hit?.object.userData.items?.[hit.instanceId].body ?? -1;
            this.pickedPoint = hit ? this.deformables.nearest(hit) : null;
            this.dirty = true;
        });
    }

    /// "box 3, 1.20 m/s"
    pickedText(frame) {
        const a = Math.max(0, Math.min(frame, this.times.length - 2)), b = Math.min(a + 1, this.times.length - 1);
        if (this.pickedPoint) {
            const { name, particle } = this.pickedPoint;
            return `${name}, ${withUnit(this.deformables.way(particle, a, b) / (this.times[b] - this.times[a]), 'm/s')}`;
        }
        if (this.picked < 0) return '';
        const name = this.scene.bodies[this.picked].name || `body ${this.picked}`;
        const index = this.scene.moving.findIndex(({ body }) => body === this.picked);
        if (index < 0) return `${name}, at rest`;
        const way = this.motion.position(new THREE.Vector3(), index, a)
            .distanceTo(this.motion.position(new THREE.Vector3(), index, b));
        return `${name}, ${withUnit(way / (this.times[b] - this.times[a]), 'm/s')}`;
    }

    tick(now) {
        const passed = this.last === null ? 0 : Math.min((now - this.last) / 1000, 0.1);
        this.last = now;
        if (this.playing) {
            this.seek(this.time + passed * this.speed);
            if (this.time >= this.times.at(-1)) this.setPlaying(false);
        }
        this.stage.controls.update();
        if (this.dirty) this.draw();
        requestAnimationFrame((next) => this.tick(next));
    }

    draw() {
        this.dirty = false;
        const [frame, fraction] = this.frameAt(this.time);
        this.place(frame, fraction);
        for (const mesh of this.meshes) {
            if (mesh.userData.moves) this.fillInstances(mesh);
        }
        this.deformables.place(frame, fraction);
        this.ui.showFrame(this.time, frame);
        this.ui.showPicked(this.pickedText(frame));
        this.stage.render();
    }
}

try {
    if (document.getElementById('plumb-comparison')) new ComparisonPage();
    else new Player();
} catch (error) {
    showFailure(error);
    throw error;
}
