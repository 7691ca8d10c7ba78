// Shadow maps for every light: three.js leaves their extent and their bias to whoever uses it.

import * as THREE from "three";

const RESOLUTION = 1024;
const REACH = 2.4; // texels from a looked-up point to the farthest compared: 0.95 of the disc, √2 of bilinear lookup
const WIDEST = THREE.MathUtils.degToRad(75); // half angle of a spot that one plane still holds with useful texels

/** Have every light and every mesh cast shadows. */
export function castShadows(world) {
  const box = new THREE.Box3().setFromObject(world);
  const lights = [];
  world.traverse((object) => {
    if (object.isMesh) {
      object.castShadow = object.receiveShadow = true;
      object.material.shadowSide = THREE.DoubleSide; // a single-sided surface casts shadows from its back, too
    }
    if (object.isLight) lights.push(object);
  });
  for (const light of lights) {
    world.attach(light); // its position is in world space from here on
    light.castShadow = !(light.isSpotLight && light.angle > WIDEST);
    light.shadow.mapSize.set(RESOLUTION, RESOLUTION);
    if (light.isDirectionalLight) fitParallel(light, box);
    else fitCone(light, box);
  }
}

/** A parallel light's place is free along its direction: before the scene, which its view just holds. */
function fitParallel(light, box) {
  const { center, radius } = box.getBoundingSphere(new THREE.Sphere());
  const forward = new THREE.Vector3(0, 0, -1).applyQuaternion(light.quaternion);
  light.position.copy(center).addScaledVector(forward, -2 * radius);
  light.updateMatrixWorld(true);
  const camera = light.shadow.camera;
  camera.position.copy(light.position);
  camera.lookAt(center);
  camera.updateMatrixWorld(true);
  const seen = new THREE.Box3().setFromPoints(corners(box).map((corner) => corner.applyMatrix4(camera.matrixWorldInverse)));
  const texel = Math.max(seen.max.x - seen.min.x, seen.max.y - seen.min.y) / (RESOLUTION - 2 * REACH);
  const border = REACH * texel;
  camera.left = seen.min.x - border;
  camera.right = seen.max.x + border;
  camera.bottom = seen.min.y - border;
  camera.top = seen.max.y + border;
  camera.near = radius / 2;
  camera.far = 4 * radius;
  camera.updateProjectionMatrix();
  light.shadow.normalBias = border;
}

/** A spot's view, or a point's six, reach to the farthest corner; the texels there are the widest. */
function fitCone(light, box) {
  const farthest = Math.max(...corners(box).map((corner) => corner.distanceTo(light.position)));
  const half = light.isSpotLight ? light.angle : Math.PI / 4;
  light.shadow.camera.near = farthest / 1000;
  light.shadow.camera.far = farthest;
  light.shadow.camera.updateProjectionMatrix();
  light.shadow.normalBias = (REACH * 2 * Math.tan(half) * farthest) / RESOLUTION;
}

function corners(box) {
  const [low, high] = [box.min, box.max];
  const pick = (bit, axis) => (bit ? high[axis] : low[axis]);
  return [...Array(8).keys()].map((i) => new THREE.Vector3(pick(i & 1, "x"), pick(i & 2, "y"), pick(i & 4, "z")));
}
