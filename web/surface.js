// Surfaces as a report holds them: unpacked, and drawn with the light of the program's own pictures.
// `packViewMesh` (report/view_mesh.h) says how they are packed, preview/shading.h what the light is.

import {
  BufferAttribute, BufferGeometry, DataTexture, DoubleSide, LinearFilter, Mesh, PlaneGeometry,
  RedFormat, ShaderMaterial, Sphere, UnsignedByteType, Vector3,
} from 'three';

async function inflated(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/// Reads planes of differences one after the other.
class Planes {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }
  byteSums(count, out, offset, stride) {
    let value = 0;
    for (let i = 0; i < count; ++i) {
      value = (value + this.bytes[this.at++]) & 255;
      out[offset + i * stride] = value;
    }
  }
  wordSums(count, out, offset, stride) {
    let value = 0;
    for (let i = 0; i < count; ++i) {
      const zigzag = this.bytes[this.at + i] | (this.bytes[this.at + count + i] << 8);
      value = (value + ((zigzag >> 1) ^ -(zigzag & 1))) & 65535;
      out[offset + i * stride] = value;
    }
    this.at += 2 * count;
  }
  number() {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = this.bytes[this.at++];
      value += (byte & 127) * 2 ** shift;
      if (byte < 128) return value;
    }
  }
}

/// The geometry of a part as `viewPart` wrote it; positions 0..1 along the sides of its box.
export async function unpackSurface(part) {
  const planes = new Planes(await inflated(part.data));
  const n = part.vertices;
  const position = new Uint16Array(4 * n), normal = new Int8Array(4 * n);
  const color = new Uint8Array(4 * n), finish = new Uint8Array(4 * n), source = new Uint8Array(4 * n);
  for (let axis = 0; axis < 3; ++axis) planes.wordSums(n, position, axis, 4);
  for (let axis = 0; axis < 2; ++axis) planes.byteSums(n, normal, axis, 4);
  for (let c = 0; c < 3; ++c) planes.byteSums(n, color, c, 4);
  for (let c = 0; c < 2; ++c) planes.byteSums(n, finish, c, 4);  // metallic, roughness
  planes.byteSums(n, color, 3, 4);                               // glow
  for (let c = 2; c < 4; ++c) planes.byteSums(n, finish, c, 4);  // light of sky and key
  for (let axis = 0; axis < 4; ++axis) planes.byteSums(n, source, axis, 4);  // and the seam's jump
  const index = n > 65535 ? new Uint32Array(3 * part.triangles) : new Uint16Array(3 * part.triangles);
  for (let i = 0, next = 0; i < index.length; ++i) {
    const corner = next - planes.number();
    if (corner >= next) next = corner + 1;
    index[i] = corner;
  }
  const floor = new Uint8Array(part.floor.side * part.floor.side);
  planes.byteSums(floor.length, floor, 0, 1);

  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(position, 4, true));
  geometry.setAttribute('octahedral', new BufferAttribute(normal, 4, true));
  geometry.setAttribute('look', new BufferAttribute(color, 4, true));
  geometry.setAttribute('finish', new BufferAttribute(finish, 4, true));
  geometry.setAttribute('source', new BufferAttribute(source, 4, false));
  geometry.setIndex(new BufferAttribute(index, 1));
  geometry.boundingSphere = new Sphere(new Vector3(0.5, 0.5, 0.5), 1);
  return { part, geometry, position, floor };
}

export const kModes = ['material', 'origins', 'jumps'];

// The color of a place of the example, from its share of the way along each side: hue and
// saturation go around the ground plan, lightness up; OKLab (B. Ottosson, 2020). The legend says the
// same in scripts, `sourceColor`.
const kSourceColor = `
vec3 sourceColor(vec3 p) {
  vec3 lab = vec3(0.48 + 0.34 * p.z, 0.30 * (p.x - 0.5), 0.30 * (p.y - 0.5));
  vec3 lms = vec3(lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z,
                  lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z,
                  lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z);
  lms = lms * lms * lms;
  return clamp(vec3(4.0767416621 * lms.x - 3.3077115913 * lms.y + 0.2309699292 * lms.z,
                    -1.2684380046 * lms.x + 2.6097574011 * lms.y - 0.3413193965 * lms.z,
                    -0.0041960863 * lms.x - 0.7034186147 * lms.y + 1.7076147010 * lms.z), 0.0, 1.0);
}`;

const kVertex = `
attribute vec2 octahedral;
attribute vec4 look, finish, source;
varying vec3 vNormal, vWorld;
varying vec4 vLook, vFinish;
varying vec3 vSource;
varying float vJump;
${kSourceColor}
void main() {
  vec2 o = octahedral;
  vec3 n = vec3(o, 1.0 - abs(o.x) - abs(o.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  vNormal = n;
  vec4 world = modelMatrix * vec4(position, 1.0);
  vWorld = world.xyz;
  vLook = look;
  vFinish = finish;
  bool known = source.x + source.y + source.z > 0.0;
  vSource = known ? sourceColor((source.xyz - 1.0) / 254.0) : vec3(0.2);
  vJump = source.w;
  gl_Position = projectionMatrix * viewMatrix * world;
}`;

const kFragment = `
uniform int mode;
uniform float jumpScale;
uniform vec3 eye, toKey, toRim, floorSky;
varying vec3 vNormal, vWorld;
varying vec4 vLook, vFinish;
varying vec3 vSource;
varying float vJump;

vec3 linear(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c)); }
vec3 encoded(vec3 c) {
  return mix(c * 12.92, 1.055 * pow(max(c, vec3(1e-5)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
const vec3 keyLight = 0.86 * vec3(1.0, 0.955, 0.89);  // irradiance over pi
vec3 floorRadiance(float share) {
  return 0.62 * (keyLight * max(0.0, toKey.z) * share + floorSky * (0.55 + 0.45 * share));
}
vec3 skyAt(vec3 d) {
  if (d.z < 0.0) return floorRadiance(1.0);
  float t = 1.0 - clamp(d.z, 0.0, 1.0);
  vec3 light = mix(vec3(0.25, 0.285, 0.34), vec3(0.46, 0.475, 0.49), t * t);
  light += vec3(1.0, 0.97, 0.92) * 0.75 * exp(6.0 * (dot(d, toKey) - 1.0));
  light += vec3(0.90, 0.95, 1.0) * 0.45 * exp(9.0 * (dot(d, toRim) - 1.0));
  return light;
}
vec3 filmic(vec3 c) {
  float peak = max(c.x, max(c.y, c.z));
  if (peak <= 0.76) return c;
  float squeezed = 1.0 - 0.24 * 0.24 / (peak + 0.24 - 0.76);
  return mix(c * (squeezed / peak), vec3(squeezed), 1.0 - 1.0 / (0.15 * (peak - squeezed) + 1.0));
}
// Steps of one hue family from light to dark that also differ in gray; the legend's are the same.
vec3 jumpColor(float t) {
  vec3 none = vec3(0.80), low = vec3(0.98, 0.85, 0.44), middle = vec3(0.91, 0.42, 0.18),
       high = vec3(0.66, 0.07, 0.32), most = vec3(0.26, 0.03, 0.32);
  if (t <= 0.0) return none;
  float s = clamp(t, 0.0, 1.0) * 4.0;
  return s < 1.0 ? mix(none, low, s) : s < 2.0 ? mix(low, middle, s - 1.0)
       : s < 3.0 ? mix(middle, high, s - 2.0) : mix(high, most, s - 3.0);
}

void main() {
  vec3 n = normalize(vNormal), v = normalize(eye - vWorld);
  // Both sides of a surface show, and light was gathered on the outer one.
  vec3 face = cross(dFdx(vWorld), dFdy(vWorld));
  if (dot(n, v) < 0.0 && dot(face, n) * dot(face, v) < 0.0) n = -n;
  float sky = vFinish.z, key = vFinish.w;
  vec3 base = mode == 1 ? vSource : linear(mode == 2 ? jumpColor(vJump / jumpScale) : vLook.rgb);
  float metallic = mode == 0 ? vFinish.x : 0.0;
  float roughness = mode == 0 ? max(vFinish.y, 0.08) : 0.9;
  float nl = max(dot(n, toKey), 0.0), nv = max(dot(n, v), 1e-3);
  vec3 around = mix(floorRadiance(0.5), floorSky, 0.5 + 0.5 * n.z);
  // Light that comes back from what hides the sky is of the surface's own color.
  vec3 open = vec3(sky) / (1.0 - 0.75 * base * (1.0 - sky));
  vec3 diffuse = keyLight * nl * key + around * open;
  vec3 color;
  if (mode == 0) {
    vec3 mirror = mix(vec3(0.04), base, metallic);
    vec3 fresnel = mirror + (1.0 - mirror) * pow(1.0 - nv, 5.0) * (1.0 - roughness);
    vec3 h = normalize(toKey + v);
    float nh = max(dot(n, h), 0.0), alpha = roughness * roughness, a2 = alpha * alpha;
    float d = nh * nh * (a2 - 1.0) + 1.0;
    float glint = min(a2 / (d * d) * 0.25 / mix(nl * nv, 1.0, alpha * 0.5 + 0.05), 8.0);
    vec3 reflected = mix(skyAt(reflect(-v, n)), around, roughness * 0.85);
    color = base * (1.0 - metallic) * diffuse + fresnel * reflected * open +
            mirror * keyLight * (glint * nl * key);
    color = mix(color, base, vLook.a);
  } else {
    // Enough shading to read the shape, little enough to read the color.
    float shade = dot(diffuse, vec3(0.333));
    color = base * (0.42 + 0.58 * min(shade, 1.15));
  }
  gl_FragColor = vec4(encoded(filmic(color)), 1.0);
}`;

const kFloorFragment = `
uniform sampler2D light;
uniform float strength;
varying vec2 vUv;
void main() {
  vec2 side = min(vUv, 1.0 - vUv);
  float fade = smoothstep(0.0, 0.12, min(side.x, side.y));
  gl_FragColor = vec4(0.0, 0.0, 0.0, (1.0 - texture2D(light, vUv).r) * strength * fade);
}`;
const kFloorVertex = `
varying vec2 vUv;
void main() {
  vUv = uv;
  gl_Position = projectionMatrix * viewMatrix * modelMatrix * vec4(position, 1.0);
}`;

/// What all surfaces share: the light, which is where it was for the pictures.
export function makeMaterials(key) {
  const toKey = new Vector3(...key).normalize();
  const toRim = new Vector3(-toKey.x, -toKey.y, 0.35).normalize();
  const uniforms = {
    mode: { value: 0 }, jumpScale: { value: 128 }, eye: { value: new Vector3() },
    toKey: { value: toKey }, toRim: { value: toRim }, floorSky: { value: floorSky(toKey, toRim) },
  };
  return {
    uniforms,
    surface: new ShaderMaterial({
      uniforms, vertexShader: kVertex, fragmentShader: kFragment, side: DoubleSide,
    }),
  };
}

/// The sky's light on an open floor, over pi: midpoints of a grid uniform in the cosine's measure.
function floorSky(toKey, toRim) {
  const kSteps = 48, sum = new Vector3(), d = new Vector3();
  for (let i = 0; i < kSteps; ++i) {
    for (let j = 0; j < kSteps; ++j) {
      const r = Math.sqrt((i + 0.5) / kSteps), phi = (2 * Math.PI * (j + 0.5)) / kSteps;
      d.set(r * Math.cos(phi), r * Math.sin(phi), Math.sqrt(1 - r * r));
      const t = (1 - d.z) ** 2;
      const key = 0.75 * Math.exp(6 * (d.dot(toKey) - 1)), rim = 0.45 * Math.exp(9 * (d.dot(toRim) - 1));
      sum.x += 0.25 + t * (0.46 - 0.25) + key + 0.9 * rim;
      sum.y += 0.285 + t * (0.475 - 0.285) + 0.97 * key + 0.95 * rim;
      sum.z += 0.34 + t * (0.49 - 0.34) + 0.92 * key + rim;
    }
  }
  return sum.multiplyScalar(1 / (kSteps * kSteps));
}

export function makeSurfaceMesh(surface, materials) {
  const [low, high] = surface.part.box;
  const mesh = new Mesh(surface.geometry, materials.surface);
  mesh.position.set(...low);
  mesh.scale.set(...[0, 1, 2].map((a) => high[a] - low[a] || 1e-9));
  mesh.frustumCulled = false;
  return mesh;
}

export function makeFloorMesh(surface, strength) {
  const { side, box: [low, high] } = surface.part.floor;
  const texture = new DataTexture(surface.floor, side, side, RedFormat, UnsignedByteType);
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  const material = new ShaderMaterial({
    uniforms: { light: { value: texture }, strength }, vertexShader: kFloorVertex,
    fragmentShader: kFloorFragment, transparent: true, depthWrite: false,
  });
  const mesh = new Mesh(new PlaneGeometry(1, 1), material);
  mesh.position.set((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]);
  mesh.scale.set(high[0] - low[0] || 1e-9, high[1] - low[1] || 1e-9, 1);
  mesh.frustumCulled = false;
  return mesh;
}
