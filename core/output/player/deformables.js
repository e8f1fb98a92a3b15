// SPDX-License-Identifier: MIT
// What is made of particles, and the links between things: surfaces, and rods for ropes and links.
import * as THREE from 'three';
import { meshArrays, ParticleMotion } from './data.js';
import { isShown, SmoothSurface } from './smooth_surface.js';

const kThinnest = 8e-4;  // radius of a rope or link at the least, of the view's distance
const kLinkColor = 0x4a5560;
const kLooks = {  // cloth glows a little, for the light that passes through
    cloth: { roughness: 0.85, envMapIntensity: 0.9, emissiveIntensity: 0.09 },
    balloon: { roughness: 0.22, envMapIntensity: 1.3 },
    solid: { roughness: 0.42, envMapIntensity: 0.9 },
    rope: { roughness: 0.9, envMapIntensity: 0.7 },
};

/// Rods between pairs of places, with balls at their ends: one draw call each.
class Rods {
    constructor(count, radius, look) {
        const material = new THREE.MeshStandardMaterial(look);
        const mesh = (form, items) => {
            const result = new THREE.InstancedMesh(form, material, items);
            result.castShadow = result.receiveShadow = true;
            result.frustumCulled = false;
            return result;
        };
        this.radius = radius;
        this.rods = mesh(new THREE.CylinderGeometry(1, 1, 1, 14, 1, true), count);
        this.balls = mesh(new THREE.SphereGeometry(1, 14, 9), 2 * count);
        this.objects = [this.rods, this.balls];
        this.up = new THREE.Vector3(0, 1, 0);
        this.along = new THREE.Vector3();
        this.middle = new THREE.Vector3();
        this.rotation = new THREE.Quaternion();
        this.scale = new THREE.Vector3();
        this.matrix = new THREE.Matrix4();
    }

    hide(i) {
        this.matrix.makeScale(0, 0, 0);
        this.rods.setMatrixAt(i, this.matrix);
        this.balls.setMatrixAt(2 * i, this.matrix);
        this.balls.setMatrixAt(2 * i + 1, this.matrix);
    }

    place(i, a, b) {
        const { along, middle, rotation, scale, matrix, radius } = this;
        const length = along.subVectors(b, a).length();
        rotation.setFromUnitVectors(this.up, length > 0 ? along.divideScalar(length) : this.up);
        middle.addVectors(a, b).multiplyScalar(0.5);
        this.rods.setMatrixAt(i, matrix.compose(middle, rotation, scale.set(radius, length, radius)));
        scale.setScalar(radius);
        this.balls.setMatrixAt(2 * i, matrix.compose(a, rotation, scale));
        this.balls.setMatrixAt(2 * i + 1, matrix.compose(b, rotation, scale));
    }

    finish() {
        for (const mesh of this.objects) {
            mesh.instanceMatrix.needsUpdate = true;
            mesh.boundingSphere = null;
        }
    }
}

export class Deformables {
    /// `matrices`: [body] where the bodies are, which links follow.
    constructor(scene, bytes, matrices) {
        this.deformables = scene.deformables;
        this.links = scene.links;
        this.matrices = matrices;
        this.motion = new ParticleMotion(scene);
        this.places = new Float32Array(3 * this.motion.count);
        this.motion.fill(this.places, 0, 0);
        this.objects = [];
        const distance = new THREE.Vector3(...scene.view.eye).distanceTo(new THREE.Vector3(...scene.view.target));
        this.parts = this.deformables.map((deformable) => (deformable.mesh ? this.addSurface(deformable, bytes)
            : this.addRods(deformable.segments.length, Math.max(deformable.radius, kThinnest * distance), deformable)));
        this.rods = this.addRods(this.links.length, kThinnest * distance, { kind: 'rope', color: kLinkColor });
        this.place(0, 0);
    }

    /// Each side of a surface is a mesh of its own, so that each is lit and shaded as what it is: the near side.
    addSurface(deformable, bytes) {
        const { first, count, kind, color, mesh, crease, shown } = deformable;
        const places = this.places.subarray(3 * first, 3 * (first + count));
        const surface = new SmoothSurface(places, meshArrays(bytes, mesh).corners, crease, shown);
        for (const side of [THREE.FrontSide, THREE.BackSide]) {
            const material = new THREE.MeshStandardMaterial({ ...kLooks[kind], color, side, shadowSide: THREE.DoubleSide,
                emissive: kind === 'cloth' ? color : 0 });
            const object = new THREE.Mesh(surface.geometry, material);
            object.castShadow = side === THREE.FrontSide;
            object.receiveShadow = true;
            object.frustumCulled = false;
            object.userData = { deformable, point: ({ face }) => surface.point(face.a) };
            this.objects.push(object);
        }
        return surface;
    }

    addRods(count, radius, deformable) {
        const rods = new Rods(count, radius, { ...kLooks[deformable.kind], color: deformable.color });
        if (!deformable.segments) {
            this.objects.push(...rods.objects);
            return rods;
        }
        const [pieces, ends] = rods.objects;
        pieces.userData = { deformable, point: ({ instanceId }) => deformable.segments[instanceId][0] };
        ends.userData = { deformable, point: ({ instanceId }) => deformable.segments[instanceId >> 1][instanceId & 1] };
        this.objects.push(pieces, ends);
        return rods;
    }

    particle(result, index) {
        return result.fromArray(this.places, 3 * index);
    }

    end(result, { particle, body, place }) {
        if (particle !== undefined) return this.particle(result, particle);
        result.set(...place);
        return body === undefined ? result : result.applyMatrix4(this.matrices[body]);
    }

    place(frame, fraction) {
        if (frame === this.frame && fraction === this.fraction) return;
        this.frame = frame;
        this.fraction = fraction;
        const a = new THREE.Vector3(), b = new THREE.Vector3();
        this.motion.fill(this.places, frame, fraction);
        this.deformables.forEach(({ first, segments, shown }, i) => {
            const part = this.parts[i];
            if (!segments) {
                part.update(frame);
                return;
            }
            segments.forEach(([from, to], k) => {
                if (shown && !isShown(shown[k], frame)) part.hide(k);
                else part.place(k, this.particle(a, first + from), this.particle(b, first + to));
            });
            part.finish();
        });
        this.links.forEach((link, k) => this.rods.place(k, this.end(a, link[0]), this.end(b, link[1])));
        this.rods.finish();
    }

    /// Places of some points of each deformable, for those who want to see all of it.
    someOfEach() {
        return this.deformables.flatMap(({ first, count }) => {
            const step = Math.max(1, Math.floor(count / 50));
            return Array.from({ length: Math.ceil(count / step) }, (_, i) => this.particle(new THREE.Vector3(), first + i * step));
        });
    }

    /// What a ray has hit: the deformable's name and a particle nearby; null where it is none.
    nearest(hit) {
        const { deformable, point } = hit.object.userData;
        if (!point) return null;
        const name = deformable.name || `deformable ${this.deformables.indexOf(deformable)}`;
        return { name, particle: deformable.first + point(hit) };
    }

    /// How far a particle is between two frames [m].
    way(particle, from, to) {
        const a = this.motion.place(new THREE.Vector3(), particle, from);
        return a.distanceTo(this.motion.place(new THREE.Vector3(), particle, to));
    }
}
