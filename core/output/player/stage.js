// SPDX-License-Identifier: MIT
// Light, sky, ground and camera.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { RoomEnvironment } from 'three/examples/jsm/environments/RoomEnvironment.js';

const kHorizon = 0xdde4ea, kZenith = 0x8fa9c1, kGround = 0xb7bdc2;

/// Sky as a large ball with a gradient along `up`.
function sky(up) {
    const material = new THREE.ShaderMaterial({
        side: THREE.BackSide, depthWrite: false, depthTest: false, toneMapped: false,
        uniforms: { up: { value: up }, horizon: { value: new THREE.Color(kHorizon) },
            zenith: { value: new THREE.Color(kZenith) } },
        vertexShader: `varying vec3 d; void main() { d = position;
            gl_Position = projectionMatrix * vec4(mat3(modelViewMatrix) * position, 1.0); }`,
        fragmentShader: `varying vec3 d; uniform vec3 up, horizon, zenith;
            void main() { float h = dot(normalize(d), up);
            gl_FragColor = vec4(mix(horizon, zenith, smoothstep(0.0, 0.75, h)), 1.0);
            #include <colorspace_fragment>
            }`,
    });
    const mesh = new THREE.Mesh(new THREE.SphereGeometry(1, 32, 16), material);
    mesh.frustumCulled = false;
    mesh.renderOrder = -1;
    return mesh;
}

/// Ground of a plane: a wide disc with a fine grid that fades into the horizon.
function ground(cell) {
    const material = new THREE.MeshStandardMaterial({ color: kGround, roughness: 0.95, metalness: 0,
        envMapIntensity: 0.55 });
    const focus = { value: new THREE.Vector3() }, reach = { value: 100 };
    material.onBeforeCompile = (shader) => {
        Object.assign(shader.uniforms, { focus, reach, cell: { value: cell },
            horizon: { value: new THREE.Color(kHorizon) } });
        shader.vertexShader = shader.vertexShader
            .replace('#include <common>', `#include <common>
                varying vec2 onGround; varying vec3 inWorld; uniform float reach;`)
            .replace('#include <begin_vertex>', `#include <begin_vertex>
                onGround = reach * position.xz; inWorld = (modelMatrix * vec4(position, 1.0)).xyz;`);
        shader.fragmentShader = shader.fragmentShader
            .replace('#include <common>', `#include <common>
                varying vec2 onGround; varying vec3 inWorld; uniform vec3 focus, horizon; uniform float reach, cell;
                float lines(vec2 p, float width) {
                    vec2 w = fwidth(p), d = abs(fract(p - 0.5) - 0.5);
                    vec2 a = (1.0 - smoothstep(vec2(width), vec2(width) + w * 1.3, d)) * clamp(0.25 / w, 0.0, 1.0);
                    return max(a.x, a.y);
                }`)
            .replace('#include <color_fragment>', `#include <color_fragment>
                float grid = max(0.36 * lines(onGround / cell, 0.008), lines(onGround / (5.0 * cell), 0.003));
                diffuseColor.rgb *= 1.0 - 0.26 * grid;`)
            .replace('#include <tonemapping_fragment>', `#include <tonemapping_fragment>
                float far = smoothstep(0.25, 1.0, distance(inWorld, focus) / reach);`)
            .replace('#include <colorspace_fragment>', `gl_FragColor.rgb = mix(gl_FragColor.rgb, horizon, far);
                #include <colorspace_fragment>`);
    };
    const disc = new THREE.CircleGeometry(1, 96).rotateX(-Math.PI / 2);
    const mesh = new THREE.Mesh(disc, material);
    mesh.receiveShadow = true;
    mesh.userData.fade = { focus, reach };
    return mesh;
}

export class Stage {
    constructor(canvas, scene) {
        this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
        this.renderer.shadowMap.enabled = true;
        this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
        this.renderer.toneMapping = THREE.NeutralToneMapping;
        this.up = new THREE.Vector3(...scene.up);
        this.world = new THREE.Scene();
        this.world.add(sky(this.up));
        this.grounds = [];
        this.addLight();

        this.camera = new THREE.PerspectiveCamera(scene.view.field_of_view, 1, 0.1, 1000);
        this.camera.up.copy(this.up);
        this.camera.position.set(...scene.view.eye);
        this.controls = new OrbitControls(this.camera, canvas);
        this.controls.target.set(...scene.view.target);
        this.controls.enableDamping = true;
        this.controls.dampingFactor = 0.12;
        this.home = { eye: this.camera.position.clone(), target: this.controls.target.clone() };
    }

    addLight() {
        const maker = new THREE.PMREMGenerator(this.renderer);
        this.world.environment = maker.fromScene(new RoomEnvironment(), 0.04).texture;
        this.world.environmentIntensity = 0.36;
        this.world.environmentRotation.setFromQuaternion(
            new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), this.up));
        const fill = new THREE.HemisphereLight(0xeaf2ff, 0xb8aea2, 0.75);
        fill.position.copy(this.up);
        this.sun = new THREE.DirectionalLight(0xfff3e0, 2.8);
        this.sun.castShadow = true;
        this.sun.shadow.mapSize.set(2048, 2048);
        this.sun.shadow.radius = 3;
        this.world.add(fill, this.sun, this.sun.target);
    }

    /// A plane through `pose`, whose y axis is its normal.
    addGround(pose, cell) {
        const mesh = ground(cell);
        mesh.matrixAutoUpdate = false;
        mesh.userData.pose = pose;
        this.grounds.push(mesh);
        this.world.add(mesh);
    }

    /// Light, ground and clipping for a scene of this size about a middle.
    surround(middle, radius) {
        this.middle = middle;
        this.radius = radius;
        const side = new THREE.Vector3(0.55, 0, 0.35);
        if (Math.abs(this.up.y) < 0.7) side.set(0.55, -0.35, 0);
        const direction = side.addScaledVector(this.up, 1).normalize();
        this.sun.target.position.copy(middle);
        this.sun.position.copy(middle).addScaledVector(direction, 4 * radius);
        const box = this.sun.shadow.camera;
        Object.assign(box, { left: -1.3 * radius, right: 1.3 * radius, top: 1.3 * radius,
            bottom: -1.3 * radius, near: radius, far: 8 * radius });
        box.updateProjectionMatrix();
        this.sun.shadow.normalBias = 2.2 * radius / 2048;
        this.sun.shadow.bias = -0.0004;
        this.controls.maxDistance = 40 * radius;
    }

    /// Fits near, far and the ground to where the camera is now.
    follow() {
        const distance = this.camera.position.distanceTo(this.controls.target);
        const reach = Math.max(14 * this.radius, 6 * distance);
        this.camera.near = Math.max(distance * 0.01, 1e-4);
        this.camera.far = 3 * reach + distance;
        this.camera.updateProjectionMatrix();
        for (const mesh of this.grounds) {
            const { pose, fade } = mesh.userData;
            mesh.matrix.copy(pose).scale(new THREE.Vector3(reach, 1, reach));
            fade.focus.value.copy(this.middle);
            fade.reach.value = reach;
        }
    }

    resize() {
        const { clientWidth: width, clientHeight: height } = this.renderer.domElement;
        this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / Math.max(height, 1);
        this.camera.setViewOffset(width, height, 0, 0.04 * height, width, height);  // room for the controls
    }

    /// Looks from where it does now, from as far as it takes to see the ball.
    fit(middle, radius) {
        const half = THREE.MathUtils.degToRad(this.camera.fov / 2);
        const narrow = Math.min(half, Math.atan(Math.tan(half) * this.camera.aspect));
        const back = this.camera.position.clone().sub(this.controls.target).normalize();
        this.controls.target.copy(middle);
        this.camera.position.copy(middle).addScaledVector(back, radius / Math.sin(narrow));
    }

    goHome() {
        this.camera.position.copy(this.home.eye);
        this.controls.target.copy(this.home.target);
    }

    render() {
        this.follow();
        this.renderer.render(this.world, this.camera);
    }
}
