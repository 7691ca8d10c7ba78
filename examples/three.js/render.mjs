// Renders the exported scene to a float target and sends values and times back; render.py serves this page.

import * as THREE from "three";
import { EXRLoader } from "three/addons/loaders/EXRLoader.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { castShadows } from "./shadows.mjs";
import { hasPlainSurfaces, surfaceMaterial } from "./surface.mjs";

const WARM_UP = 5;
const FRAMES = 20;

/** The camera of camera.json, by its own matrices. */
function cameraOf(told) {
  const camera = told.kind === "orthographic" ? new THREE.OrthographicCamera() : new THREE.PerspectiveCamera();
  camera.near = told.near;
  camera.far = told.far;
  camera.matrixAutoUpdate = false;
  camera.matrix.set(...told.world_from_camera.flat());
  camera.projectionMatrix.set(...told.clip_from_camera.flat());
  camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
  camera.updateMatrixWorld(true);
  return camera;
}

/** Light from around, and what is seen behind everything. three.js looks lat-long maps up as camera.json says. */
async function surround(world, told) {
  const texture = await new EXRLoader().loadAsync(`/export/${told.environment.file}`);
  texture.mapping = THREE.EquirectangularReflectionMapping;
  world.environment = texture;
  const constant = told.environment.radiance;
  if (constant) world.background = new THREE.Color(...constant);
  else if (told.camera.kind === "perspective") world.background = texture; // a map's cube is too small for the other
}

/** Flat shapes get the normals of their faces, which three.js would find in the fragment shader, too late for shadows. */
function giveNormals(mesh) {
  if (mesh.geometry.attributes.normal) return;
  mesh.geometry = mesh.geometry.index ? mesh.geometry.toNonIndexed() : mesh.geometry;
  mesh.geometry.computeVertexNormals();
}

function read(renderer, target) {
  const values = new Float32Array(4 * target.width * target.height);
  renderer.readRenderTargetPixels(target, 0, 0, target.width, target.height, values);
  return values;
}

/** Milliseconds of finished frames. Chromium takes gl.finish for gl.flush, but cannot read a pixel before it is there. */
function time(draw, renderer, target) {
  const pixel = new Float32Array(4);
  const times = [];
  for (let frame = 0; frame < WARM_UP + FRAMES; frame += 1) {
    const start = performance.now();
    draw();
    renderer.readRenderTargetPixels(target, 0, 0, 1, 1, pixel);
    times.push(performance.now() - start);
  }
  return times.slice(WARM_UP);
}

const asked = new URLSearchParams(location.search);
const told = await (await fetch("/camera.json")).json();
const [width, height] = [Number(asked.get("width")), Number(asked.get("height"))];

const renderer = new THREE.WebGLRenderer({ antialias: false });
renderer.setSize(1, 1);
renderer.setClearColor(0x000000, 0);
renderer.shadowMap.enabled = true;
renderer.debug.onShaderError = (gl, program, vertex, fragment) => {
  throw new Error(`a shader does not compile: ${gl.getShaderInfoLog(vertex)}${gl.getShaderInfoLog(fragment)}`);
};
const target = new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType });
renderer.setRenderTarget(target); // no tone mapping, no encoding: those are for the screen

const scene = (await new GLTFLoader().loadAsync(`/export/${asked.get("gltf")}`)).scene;
scene.updateMatrixWorld(true);
scene.traverse((object) => object.isMesh && giveNormals(object));
const world = new THREE.Scene();
world.add(scene);
if (told.environment) await surround(world, told);
const camera = cameraOf(told.camera);
castShadows(world);

const draw = () => renderer.render(world, camera);
const times = time(draw, renderer, target);
await fetch("/image", { method: "POST", body: read(renderer, target) });

if (hasPlainSurfaces(world)) {
  world.overrideMaterial = surfaceMaterial();
  world.background = null; // leaves the clear colour, 0: no surface
  draw();
  await fetch("/surface", { method: "POST", body: read(renderer, target) });
}

const gl = renderer.getContext();
const information = gl.getExtension("WEBGL_debug_renderer_info");
const device = gl.getParameter(information ? information.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
await fetch("/done", { method: "POST", body: JSON.stringify({ version: THREE.REVISION, device, times }) });
