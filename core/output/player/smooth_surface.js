// SPDX-License-Identifier: MIT
// A surface of moving points: blended normals, edges only where the shape had them at the start.
import * as THREE from 'three';

/// Normals of triangles, as long as twice their areas.
function areaNormals(result, places, corners) {
    for (let t = 0; t < corners.length; t += 3) {
        const a = 3 * corners[t], b = 3 * corners[t + 1], c = 3 * corners[t + 2];
        const ux = places[b] - places[a], uy = places[b + 1] - places[a + 1], uz = places[b + 2] - places[a + 2];
        const vx = places[c] - places[a], vy = places[c + 1] - places[a + 1], vz = places[c + 2] - places[a + 2];
        result[t] = uy * vz - uz * vy;
        result[t + 1] = uz * vx - ux * vz;
        result[t + 2] = ux * vy - uy * vx;
    }
}

/// Whether a frame shows what is there from one frame on until before another.
export function isShown([first, end], frame) {
    return first <= frame && frame < end;
}

/// Cosine of the angle between the normals of two triangles, given by their first corners.
function cosine(normals, s, t) {
    const dot = normals[s] * normals[t] + normals[s + 1] * normals[t + 1] + normals[s + 2] * normals[t + 2];
    const length = (i) => Math.hypot(normals[i], normals[i + 1], normals[i + 2]);
    return dot / (length(s) * length(t) || 1);
}

/// One vertex for all corners at a point that blend the same triangles.
class Vertices {
    constructor(places, corners, crease) {
        const normals = new Float32Array(corners.length);
        areaNormals(normals, places, corners);
        const about = Array.from({ length: places.length / 3 }, () => []);
        corners.forEach((point, k) => about[point].push(k - k % 3));
        this.points = [];  // [vertex]
        this.starts = [0];  // [vertex] where its triangles begin
        this.triangles = [];  // by their first corners
        this.index = new Uint32Array(corners.length);  // [corner] vertex
        const known = new Map();
        corners.forEach((point, k) => {
            const blended = about[point].filter((t) => crease < -1 || cosine(normals, t, k - k % 3) >= crease);
            const key = `${point}:${blended}`;
            if (!known.has(key)) {
                known.set(key, this.points.push(point) - 1);
                this.triangles.push(...blended);
                this.starts.push(this.triangles.length);
            }
            this.index[k] = known.get(key);
        });
    }
}

export class SmoothSurface {
    /// `places`: those of the surface's points, which are followed from then on. `shown`: [triangle] which frames
    /// show it, or undefined: all do.
    constructor(places, corners, crease, shown) {
        this.places = places;
        this.corners = corners;
        this.flat = new Float32Array(corners.length);
        this.shown = shown;
        this.vertices = new Vertices(places, corners, crease);
        this.geometry = new THREE.BufferGeometry();
        for (const name of ['position', 'normal']) {
            const values = new Float32Array(3 * this.vertices.points.length);
            const attribute = new THREE.BufferAttribute(values, 3).setUsage(THREE.DynamicDrawUsage);
            this.geometry.setAttribute(name, attribute);
        }
        this.geometry.setIndex(new THREE.BufferAttribute(this.vertices.index.slice(), 1));
    }

    /// The point of the surface that a vertex shows.
    point(vertex) {
        return this.vertices.points[vertex];
    }

    /// Triangles that a frame does not show shrink to a point.
    tear(frame) {
        const { index } = this.geometry, whole = this.vertices.index;
        for (let t = 0; t < this.corners.length; t += 3) {
            const gone = !isShown(this.shown[t / 3], frame);
            for (let k = t; k < t + 3; ++k) {
                index.array[k] = whole[gone ? t : k];
                if (gone) this.flat[k] = 0;
            }
        }
        index.needsUpdate = true;
    }

    update(frame) {
        const { position, normal } = this.geometry.attributes, { points, starts, triangles } = this.vertices;
        areaNormals(this.flat, this.places, this.corners);
        if (this.shown) this.tear(frame);
        for (let i = 0; i < points.length; ++i) {
            let x = 0, y = 0, z = 0;
            for (let k = starts[i]; k < starts[i + 1]; ++k) {
                const t = triangles[k];
                x += this.flat[t], y += this.flat[t + 1], z += this.flat[t + 2];
            }
            const length = Math.hypot(x, y, z) || 1;
            normal.setXYZ(i, x / length, y / length, z / length);
            const p = 3 * points[i];
            position.setXYZ(i, this.places[p], this.places[p + 1], this.places[p + 2]);
        }
        position.needsUpdate = normal.needsUpdate = true;
        this.geometry.boundingSphere = null;
    }
}
