// The layers `normal` and `depth`: interpolated normals in world space, metres along the camera's forward axis.

import * as THREE from "three";

/** Whether one shader for all says what is seen: no normal maps, no holes, no backs that are turned to the viewer. */
export function hasPlainSurfaces(world) {
  let plain = true;
  world.traverse((object) => {
    if (!object.isMesh) return;
    const { normalMap, alphaTest, side } = object.material;
    if (normalMap || alphaTest > 0 || side !== THREE.FrontSide) plain = false;
  });
  return plain;
}

/** Writes (normal, depth). */
export function surfaceMaterial() {
  return new THREE.ShaderMaterial({
    vertexShader: /* glsl */ `
      varying vec3 vNormal;
      varying float vDepth;
      void main() {
        vec4 seen = modelViewMatrix * vec4(position, 1.0);
        vNormal = normalMatrix * normal;
        vDepth = -seen.z;
        gl_Position = projectionMatrix * seen;
      }`,
    fragmentShader: /* glsl */ `
      varying vec3 vNormal;
      varying float vDepth;
      void main() {
        vec3 world = (vec4(normalize(vNormal), 0.0) * viewMatrix).xyz;
        gl_FragColor = vec4(world, vDepth);
      }`,
  });
}
