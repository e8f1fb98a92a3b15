// SPDX-License-Identifier: MIT
// Shapes of a scene as instanced meshes: one draw call for all bodies of the same form.
import * as THREE from 'three';
import { RoundedBoxGeometry } from 'three/examples/jsm/geometries/RoundedBoxGeometry.js';
import { toCreasedNormals } from 'three/examples/jsm/utils/BufferGeometryUtils.js';
import { meshArrays } from './data.js';

const kManySizes = 60;  // more sizes than this of one kind share a scaled form, so that draw calls stay few

/// Darkens a band of a round form, so that its turning can be seen.
function banded(geometry, dark) {
    const form = geometry.index ? geometry.toNonIndexed() : geometry;
    const p = form.attributes.position;
    const colors = new Float32Array(3 * p.count).fill(1);
    const middle = new THREE.Vector3(), corner = new THREE.Vector3();
    for (let i = 0; i < p.count; i += 3) {
        middle.set(0, 0, 0);
        for (let k = 0; k < 3; ++k) middle.add(corner.fromBufferAttribute(p, i + k));
        if (dark(middle.divideScalar(3))) colors.fill(0.62, 3 * i, 3 * i + 9);
    }
    form.setAttribute('color', new THREE.BufferAttribute(colors, 3));
    return form;
}

function plain(geometry) {
    const count = geometry.attributes.position.count;
    geometry.setAttribute('color', new THREE.BufferAttribute(new Float32Array(3 * count).fill(1), 3));
    return geometry;
}

function meshGeometry(bytes, mesh, smooth) {
    const { positions, corners } = meshArrays(bytes, mesh);
    let geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    geometry.setIndex(new THREE.BufferAttribute(corners, 1));
    if (smooth) {
        geometry.computeVertexNormals();
    } else {
        geometry = toCreasedNormals(geometry, Math.PI / 7);
    }
    return plain(geometry);
}

/// Collects what is to be drawn and makes the meshes of it.
export class ShapeLibrary {
    constructor(scene, bytes) {
        this.scene = scene;
        this.bytes = bytes;
        this.forms = new Map();  // key → {make, items, open}
        this.many = this.kindsOfManySizes();
        this.detail = scene.bodies.length > 600 ? 0.7 : 1;
    }

    kindsOfManySizes() {
        const sizes = new Map();
        const count = (shape) => {
            (shape.parts ?? []).forEach((part) => count(part.shape));
            if (!sizes.has(shape.kind)) sizes.set(shape.kind, new Set());
            sizes.get(shape.kind).add(JSON.stringify(shape));
        };
        this.scene.shapes.forEach(count);
        return new Set([...sizes].filter(([, set]) => set.size > kManySizes).map(([kind]) => kind));
    }

    /// Adds the parts of a body. `body`: its number; `local`: the part's frame in the body's.
    add(shape, body, local) {
        if (shape.kind === 'compound') {
            for (const { shape: part, position, rotation } of shape.parts) {
                const placed = new THREE.Matrix4().compose(new THREE.Vector3(...position),
                    new THREE.Quaternion(...rotation), new THREE.Vector3(1, 1, 1));
                this.add(part, body, placed.premultiply(local));
            }
            return;
        }
        const { key, make, scale, open } = this.form(shape);
        if (!this.forms.has(key)) this.forms.set(key, { make, items: [], open });
        const scaled = local.clone().scale(new THREE.Vector3(...scale));
        this.forms.get(key).items.push({ body, local: scaled });
    }

    form(shape) {
        const one = [1, 1, 1], around = Math.round(40 * this.detail), rings = this.detail < 1 ? 20 : 30;
        const band = Math.sin(Math.PI * 0.1);  // its edge lies on a ring
        const { kind, radius, half_height: half, half_extents: h } = shape;
        const key = JSON.stringify(shape);
        switch (kind) {
            case 'sphere':
                return { key: kind, scale: [radius, radius, radius],
                    make: () => banded(new THREE.SphereGeometry(1, around, rings),
                        (p) => Math.abs(p.y) < band) };
            case 'box':
                if (this.many.has(kind)) {
                    return { key: kind, scale: h, make: () => plain(new THREE.BoxGeometry(2, 2, 2)) };
                }
                return { key, scale: one, make: () => plain(new RoundedBoxGeometry(2 * h[0], 2 * h[1],
                    2 * h[2], 2, 0.1 * Math.min(...h))) };
            case 'capsule':
                return { key, scale: one, make: () => banded(
                    new THREE.CapsuleGeometry(radius, 2 * half, 10, around), (p) => Math.abs(p.y) > half) };
            case 'cylinder':
                return { key: kind, scale: [radius, half, radius],
                    make: () => plain(new THREE.CylinderGeometry(1, 1, 2, around)) };
            case 'cone':
                return { key: kind, scale: [radius, half, radius],
                    make: () => plain(new THREE.ConeGeometry(1, 2, around)) };
            default:
                return { key, scale: one, open: kind !== 'hull',
                    make: () => meshGeometry(this.bytes, shape.mesh, kind === 'height_field') };
        }
    }

    /// The instanced meshes; each knows its items, [{body, local}].
    meshes(colors) {
        const result = [];
        for (const { make, items, open } of this.forms.values()) {
            const material = new THREE.MeshStandardMaterial({ roughness: 0.48, metalness: 0,
                vertexColors: true, envMapIntensity: 0.9, side: open ? THREE.DoubleSide : THREE.FrontSide });
            const mesh = new THREE.InstancedMesh(make(), material, items.length);
            mesh.castShadow = mesh.receiveShadow = true;
            mesh.frustumCulled = false;
            items.forEach(({ body }, i) => mesh.setColorAt(i, colors[body]));
            mesh.userData.items = items;
            result.push(mesh);
        }
        return result;
    }
}
