// SPDX-License-Identifier: MIT
// Reads what the page carries: the scene as JSON, meshes, and the motion (formats: motion_code.h, particle_motion.h).
import { unzlibSync } from 'fflate';
import { Quaternion, Vector3 } from 'three';

function bytesOf(id) {
    const text = atob(document.getElementById(id).textContent);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return unzlibSync(bytes);
}

/// Undoes one channel: low and high bytes of zigzag differences from a linear prediction; where neighbours are alike, less
/// those of the one before.
function decodeChannel(bytes, offset, bodies, frames, alike = false) {
    const count = bodies * frames;
    const values = new Uint16Array(count), neighbour = new Uint16Array(frames);
    for (let body = 0, k = 0; body < bodies; ++body) {
        let previous = 0, before = 0;
        for (let frame = 0; frame < frames; ++frame, ++k) {
            const code = bytes[offset + k] | (bytes[offset + count + k] << 8);
            const difference = ((code >>> 1) ^ -(code & 1)) + neighbour[frame];
            if (alike) neighbour[frame] = difference;
            values[k] = difference + 2 * previous - before;
            before = previous;
            previous = values[k];
        }
    }
    return values;
}

function decodeLargest(bytes, offset, bodies, frames) {
    const values = new Uint8Array(bodies * frames);
    for (let body = 0, k = 0; body < bodies; ++body) {
        let previous = 0;
        for (let frame = 0; frame < frames; ++frame, ++k) {
            previous = values[k] = (previous + bytes[offset + k]) & 3;
        }
    }
    return values;
}

/// Poses of the moving bodies, kept as integers and made numbers when asked for.
export class Motion {
    constructor(scene) {
        const bytes = bytesOf('plumb-motion');
        this.moving = scene.moving;
        this.frames = scene.frames.time.length;
        this.rotationQuantum = Math.SQRT2 / (2 ** scene.rotation_bits - 1);
        const plane = 2 * this.moving.length * this.frames;
        this.channels = [];
        for (let c = 0; c < 6; ++c) {
            this.channels.push(decodeChannel(bytes, c * plane, this.moving.length, this.frames));
        }
        this.largest = decodeLargest(bytes, 6 * plane, this.moving.length, this.frames);
        this.nextPosition = new Vector3();
        this.nextRotation = new Quaternion();
    }

    position(result, index, frame) {
        const { low, quantum } = this.moving[index];
        const k = index * this.frames + frame;
        return result.set(low[0] + quantum * this.channels[0][k],
            low[1] + quantum * this.channels[1][k], low[2] + quantum * this.channels[2][k]);
    }

    rotation(result, index, frame) {
        const k = index * this.frames + frame;
        const largest = this.largest[k], q = [0, 0, 0, 0];
        let rest = 1;
        for (let i = 0, c = 3; i < 4; ++i) {
            if (i === largest) continue;
            q[i] = this.channels[c++][k] * this.rotationQuantum - Math.SQRT1_2;
            rest -= q[i] * q[i];
        }
        q[largest] = Math.sqrt(Math.max(0, rest));
        return result.set(q[0], q[1], q[2], q[3]).normalize();
    }

    /// Pose between a frame and the next.
    pose(position, rotation, index, frame, fraction) {
        this.position(position, index, frame);
        this.rotation(rotation, index, frame);
        if (fraction <= 0 || frame + 1 >= this.frames) return;
        position.lerp(this.position(this.nextPosition, index, frame + 1), fraction);
        rotation.slerp(this.rotation(this.nextRotation, index, frame + 1), fraction);
    }
}

/// Places of the deformables' points, one deformable after another, kept as integers.
export class ParticleMotion {
    constructor(scene) {
        this.deformables = scene.deformables;
        this.frames = scene.frames.time.length;
        this.channels = [];  // [deformable][axis]
        if (this.deformables.length === 0) return;
        const bytes = bytesOf('plumb-particles');
        let offset = 0;
        for (const { count } of this.deformables) {
            this.channels.push([0, 1, 2].map((axis) => decodeChannel(bytes,
                offset + 2 * axis * count * this.frames, count, this.frames, true)));
            offset += 6 * count * this.frames;
        }
    }

    get count() {
        return this.deformables.reduce((sum, { count }) => sum + count, 0);
    }

    /// Integer of a point on an axis; `k`: point and frame.
    static step(values, k, base) {
        return base + ((values[k] - base) & 0xffff);
    }

    place(result, particle, frame) {
        const i = this.deformables.findLastIndex(({ first }) => first <= particle);
        const { first, low, quantum, bases } = this.deformables[i];
        const k = (particle - first) * this.frames + frame;
        return result.fromArray(this.channels[i].map((values, axis) =>
            low[axis] + quantum * ParticleMotion.step(values, k, bases ? bases[frame][axis] : 0)));
    }

    /// Fills places, three numbers a point, with those between a frame and the next.
    fill(places, frame, fraction) {
        if (this.frames === 0) return;
        const next = Math.min(frame + 1, this.frames - 1);
        this.deformables.forEach(({ first, count, low, quantum, bases }, i) => {
            for (let axis = 0; axis < 3; ++axis) {
                const values = this.channels[i][axis];
                const a = bases ? bases[frame][axis] : 0, b = bases ? bases[next][axis] : 0;
                for (let point = 0, k = 0; point < count; ++point, k += this.frames) {
                    const here = ParticleMotion.step(values, k + frame, a);
                    const there = ParticleMotion.step(values, k + next, b);
                    places[3 * (first + point) + axis] = low[axis] + quantum * (here + fraction * (there - here));
                }
            }
        });
    }
}

const readJson = (id) => JSON.parse(document.getElementById(id).textContent);

export const readScene = () => readJson('plumb-scene');

/// A comparison of colliders, and the shapes that its bodies name (null where none is drawn).
export const readComparison = () => ({ ...readJson('plumb-comparison'), shapes: readJson('plumb-shapes') });

/// Bytes of all meshes; `meshArrays` cuts one out.
export function readMeshes() {
    return bytesOf('plumb-meshes');
}

export function meshArrays(bytes, { offset, vertices, triangles }) {
    const buffer = bytes.slice(offset, offset + 12 * (vertices + triangles)).buffer;
    return {
        positions: new Float32Array(buffer, 0, 3 * vertices),
        corners: new Uint32Array(buffer, 12 * vertices, 3 * triangles),
    };
}
