// Surfaces that turn. One WebGL context draws every view of the page, one after the other, and each
// canvas gets a copy: browsers allow few contexts, and a report has many views.

import { PerspectiveCamera, Scene, WebGLRenderer } from 'three';
import { fitCamera, listen, placeCamera } from './orbit.js';
import { kModes, makeFloorMesh, makeMaterials, makeSurfaceMesh, unpackSurface } from './surface.js';

export { listen };

/// Whether surfaces can be unpacked and drawn here.
function able() {
  return typeof DecompressionStream !== 'undefined' && typeof WebGL2RenderingContext !== 'undefined';
}

export class Viewer {
  /// `home`: azimuth, elevation, fieldOfView, margin and key (the light's direction) of the pictures.
  /// Throws where there is no WebGL.
  constructor(home) {
    if (!able()) throw new Error('no WebGL 2');
    this.canvas = document.createElement('canvas');
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true });
    this.renderer.setClearColor(0, 0);
    this.renderer.autoClear = false;
    this.home = { ...home, zoom: 1, panX: 0, panY: 0 };
    this.materials = makeMaterials(home.key);
    this.floorStrength = { value: 0.5 };
    this.camera = new PerspectiveCamera();
    this.scenes = new Map();
    this.lost = false;
    this.canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.lost = true;
    });
    this.canvas.addEventListener('webglcontextrestored', () => {
      this.lost = false;
      if (this.onRestored) this.onRestored();
    });
  }

  /// Unpacks a surface; the same one again for the same part.
  load(part) {
    if (!this.scenes.has(part)) this.scenes.set(part, this.#make(part));
    return this.scenes.get(part);
  }

  async #make(part) {
    const surface = await unpackSurface(part);
    const scene = new Scene();
    const floor = makeFloorMesh(surface, this.floorStrength);
    scene.add(floor, makeSurfaceMesh(surface, this.materials));
    return { surface, scene, floor };
  }

  setDark(dark) { this.floorStrength.value = dark ? 0.75 : 0.42; }

  /// The camera that holds a surface, or a box of `size` about its own middle and on its own floor.
  #fit(surface, aspect, size) {
    const [low, high] = surface.part.box;
    if (size) {
      const x = (low[0] + high[0]) / 2, y = (low[1] + high[1]) / 2;
      return fitCamera(this.home, aspect, (visit) => {
        for (let c = 0; c < 8; ++c) {
          visit([x + (c & 1 ? 0.5 : -0.5) * size[0], y + (c & 2 ? 0.5 : -0.5) * size[1],
            low[2] + (c & 4 ? size[2] : 0)]);
        }
      });
    }
    const p = surface.position, scale = [0, 1, 2].map((a) => (high[a] - low[a]) / 65535);
    return fitCamera(this.home, aspect, (visit) => {
      for (let i = 0; i < p.length; i += 4) {
        visit([low[0] + p[i] * scale[0], low[1] + p[i + 1] * scale[1], low[2] + p[i + 2] * scale[2]]);
      }
    });
  }

  /// Draws into a canvas what `views` says: each { loaded, look, frame, from, to }, the last two the
  /// shares of the canvas' width between which it shows. `mode`: a name of `kModes`; `jumpScale`: the
  /// jump in voxels that has the last color.
  draw(canvas, views, { mode, jumpScale }) {
    if (this.lost) return;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    const { renderer, camera, materials } = this;
    // The drawing buffer only grows; a view uses its lower left corner.
    const w = Math.max(width, this.canvas.width), h = Math.max(height, this.canvas.height);
    if (w !== this.canvas.width || h !== this.canvas.height) renderer.setSize(w, h, false);
    renderer.setViewport(0, 0, width, height);
    renderer.setScissorTest(true);
    renderer.setScissor(0, 0, width, height);
    renderer.clear();
    materials.uniforms.mode.value = Math.max(0, kModes.indexOf(mode));
    for (const { loaded, look, frame, from = 0, to = 1 } of views) {
      const key = `${(width / height).toFixed(4)} ${frame || ''}`;
      if (loaded.fitKey !== key) {
        loaded.fit = this.#fit(loaded.surface, width / height, frame);
        loaded.fitKey = key;
      }
      const place = placeCamera(loaded.fit, look);
      const [low, high] = loaded.surface.part.box;
      const reach = Math.hypot(...[0, 1, 2].map((a) => high[a] - low[a])) * 3;
      camera.aspect = width / height;
      camera.fov = (2 * Math.atan(loaded.fit.tanY) * 180) / Math.PI;
      camera.near = Math.max(place.distance - reach, place.distance * 0.02);
      camera.far = place.distance + reach;
      camera.position.set(...place.position);
      camera.up.set(...place.up);
      camera.lookAt(...place.target);
      camera.updateProjectionMatrix();
      materials.uniforms.eye.value.copy(camera.position);
      materials.uniforms.jumpScale.value = jumpScale * loaded.surface.part.jump_steps;
      loaded.floor.visible = place.position[2] > low[2] && mode === 'material';
      const left = Math.round(from * width), right = Math.round(to * width);
      if (right <= left) continue;
      renderer.setScissor(left, 0, right - left, height);
      renderer.render(loaded.scene, camera);
    }
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
    const context = canvas.getContext('2d');
    context.clearRect(0, 0, width, height);
    context.drawImage(this.canvas, 0, this.canvas.height - height, width, height, 0, 0, width, height);
  }
}
