// SPDX-License-Identifier: MIT
// Two bodies, see-through, and what two colliders say of their contact: points and normals in one colour a collider.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { ShapeLibrary } from './shapes.js';

const kBodyColors = [0xc9a25b, 0x7f9fbd];
const kUp = new THREE.Vector3(0, 1, 0);

/// Drawn over the bodies, whatever stands before it.
function onTop(mesh, order) {
    mesh.material.depthTest = false;
    mesh.material.transparent = true;
    mesh.renderOrder = order;
    return mesh;
}

export class ManifoldView {
    constructor(canvas, shapes, bytes) {
        this.shapes = shapes;
        this.bytes = bytes;
        this.canvas = canvas;
        this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
        this.renderer.setClearColor(0xf4f6f8);
        this.world = new THREE.Scene();
        const sun = new THREE.DirectionalLight(0xffffff, 2.2);
        sun.position.set(0.6, 1, 0.8);
        this.world.add(new THREE.HemisphereLight(0xffffff, 0xb0b6bc, 1.6), sun);
        this.camera = new THREE.PerspectiveCamera(35, 1, 0.001, 1000);
        this.controls = new OrbitControls(this.camera, canvas);
        this.controls.addEventListener('change', () => this.render());
        this.content = new THREE.Group();
        this.world.add(this.content);
    }

    /// finding: an entry of the comparison's disagreements; colors: of its two colliders.
    show(finding, colors) {
        this.world.remove(this.content);
        this.content = new THREE.Group();
        this.world.add(this.content);
        const contacts = finding.answers.flatMap((answer) => answer.contacts);
        this.middle = new THREE.Vector3();
        for (const { point } of contacts) this.middle.add(new THREE.Vector3(...point));
        this.middle.divideScalar(Math.max(1, contacts.length));
        this.bodies = finding.bodies.map((body, i) => this.body(body, kBodyColors[i]));
        this.size = Math.min(...this.bodies.map(({ radius }) => radius));
        for (const { group } of this.bodies) this.content.add(group);
        this.answers = finding.answers.map((answer, i) => this.answer(answer.contacts, colors[i], i));
        for (const answer of this.answers) this.content.add(answer);
        this.look(contacts[0]);
        this.resize();
    }

    setVisible(index, visible) {
        this.answers[index].visible = visible;
        this.render();
    }

    /// The see-through shape of a body, and its radius; a plane has none and is cut to a square.
    body({ geometry, position, rotation }, color) {
        const shape = this.shapes[geometry], group = new THREE.Group();
        const pose = new THREE.Matrix4().compose(new THREE.Vector3(...position), new THREE.Quaternion(...rotation),
            new THREE.Vector3(1, 1, 1));
        if (!shape || shape.kind === 'plane') return { group: this.plane(pose, color), radius: Infinity };
        const library = new ShapeLibrary({ shapes: [shape], bodies: [{}] }, this.bytes);
        library.many.add('box');  // sharp corners: contacts lie upon them
        library.add(shape, 0, new THREE.Matrix4());
        const bounds = new THREE.Box3();
        for (const { make, items } of library.forms.values()) {
            const form = make(), edges = new THREE.EdgesGeometry(form, 15);
            for (const { local } of items) {
                const matrix = pose.clone().multiply(local);
                for (const part of this.surface(form, edges, color)) {
                    part.matrixAutoUpdate = false;
                    part.matrix.copy(matrix);
                    group.add(part);
                }
                form.computeBoundingBox();
                bounds.union(form.boundingBox.clone().applyMatrix4(local));
            }
        }
        return { group, radius: bounds.getSize(new THREE.Vector3()).length() / 2 };
    }

    surface(form, edges, color) {
        const material = new THREE.MeshStandardMaterial({ color, roughness: 0.6, transparent: true, opacity: 0.42,
            depthWrite: false, side: THREE.DoubleSide });
        const line = new THREE.LineBasicMaterial({ color: new THREE.Color(color).multiplyScalar(0.45),
            transparent: true, opacity: 0.7 });
        return [new THREE.Mesh(form, material), new THREE.LineSegments(edges, line)];
    }

    plane(pose, color) {
        const group = new THREE.Group();
        const normal = new THREE.Vector3().setFromMatrixColumn(pose, 1);
        const foot = this.middle.clone().addScaledVector(normal,
            normal.dot(new THREE.Vector3().setFromMatrixPosition(pose).sub(this.middle)));
        const form = new THREE.PlaneGeometry(8, 8, 16, 16).rotateX(-Math.PI / 2);
        const square = new THREE.Mesh(form, new THREE.MeshStandardMaterial({ color, transparent: true, opacity: 0.3,
            depthWrite: false, side: THREE.DoubleSide }));
        const grid = new THREE.GridHelper(8, 32, 0x556270, 0x9aa6b2);
        Object.assign(grid.material, { transparent: true, opacity: 0.35 });
        group.add(square, grid);
        group.quaternion.setFromUnitVectors(kUp, normal);
        group.position.copy(foot);
        return group;
    }

    /// The first answer's points are solid, the second's are rings about them, so that both are seen where they agree.
    answer(contacts, color, index) {
        const group = new THREE.Group(), size = this.size, point = size * 0.03;
        const form = index === 0 ? new THREE.SphereGeometry(point, 20, 12)
            : new THREE.TorusGeometry(1.6 * point, 0.3 * point, 10, 32).rotateX(Math.PI / 2);
        const thick = size * (index === 0 ? 0.011 : 0.007), length = size * (index === 0 ? 0.42 : 0.55);
        const shaft = new THREE.CylinderGeometry(thick, thick, length, 12).translate(0, length / 2, 0);
        const head = new THREE.ConeGeometry(3.2 * thick, 9 * thick, 16).translate(0, length, 0);
        const material = new THREE.MeshStandardMaterial({ color, roughness: 0.5, emissive: color, emissiveIntensity: 0.35 });
        for (const { point: at, normal } of contacts) {
            const turn = new THREE.Quaternion().setFromUnitVectors(kUp, new THREE.Vector3(...normal));
            for (const part of [form, shaft, head]) {
                const mesh = onTop(new THREE.Mesh(part, material), 10 + index);
                mesh.position.set(...at);
                mesh.quaternion.copy(turn);
                group.add(mesh);
            }
        }
        return group;
    }

    /// From the side of the first normal, a little above it.
    look(contact) {
        const normal = contact ? new THREE.Vector3(...contact.normal) : kUp.clone();
        const side = new THREE.Vector3().crossVectors(normal, Math.abs(normal.y) < 0.9 ? kUp : new THREE.Vector3(1, 0, 0));
        const back = side.normalize().addScaledVector(kUp, 0.45).addScaledVector(normal, 0.25).normalize();
        this.controls.target.copy(this.middle);
        this.camera.position.copy(this.middle).addScaledVector(back, 5.2 * this.size);
        this.camera.near = 0.01 * this.size;
        this.camera.far = 400 * this.size;
        this.controls.update();
    }

    resize() {
        const { clientWidth: width, clientHeight: height } = this.canvas;
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / Math.max(height, 1);
        this.camera.updateProjectionMatrix();
        this.render();
    }

    render() { this.renderer.render(this.world, this.camera); }
}
