// The views: side by side, turning together, and one laid over the other with a slider between.

const kViewNames = { iso: null, front: [0, 0], right: [Math.PI / 2, 0], top: [0, Math.PI / 2] };
const reducedMotion = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

class Board {
  /// `page`: what the page knows (page.js). `viewer` is null where surfaces cannot be shown.
  constructor(page, viewer) {
    this.page = page;
    this.viewer = viewer;
    this.mode = 'material';
    this.sameScale = true;
    this.together = true;
    this.jumpScale = 2;
    const { azimuth, elevation } = page.report.camera;
    this.home = { azimuth, elevation, zoom: 1, panX: 0, panY: 0 };
    this.look = this.home;
    this.own = new Map();  // looks of canvases that turn alone
    this.canvases = new Map();
    this.pending = false;
    this.share = 0.5;
    this.frame = this.#largest();
    if (viewer) {
      viewer.onRestored = () => this.refresh();
      const dark = matchMedia('(prefers-color-scheme: dark)');
      viewer.setDark(dark.matches);
      dark.addEventListener('change', () => {
        viewer.setDark(dark.matches);
        this.refresh();
      });
      this.inSight = new IntersectionObserver((entries) => {
        for (const entry of entries) {
          const view = this.canvases.get(entry.target);
          if (view) view.inSight = entry.isIntersecting;
        }
        this.refresh();
      }, { rootMargin: '100px' });
      this.sized = new ResizeObserver(() => this.refresh());
    }
  }

  /// The size of a box that holds each surface at one scale.
  #largest() {
    const size = [0, 0, 0];
    for (const part of this.page.allParts()) {
      for (let a = 0; a < 3; ++a) size[a] = Math.max(size[a], part.box[1][a] - part.box[0][a]);
    }
    return size[0] > 0 ? size : null;
  }

  lookOf(canvas) { return (!this.together && this.own.get(canvas)) || this.look; }
  setLook(canvas, look) {
    if (this.together) this.look = look;
    else this.own.set(canvas, look);
    this.refresh();
  }
  setLookOfAll(look) {
    this.look = look;
    this.own.clear();
    this.refresh();
  }

  /// Turns all views to a look, in a quarter of a second or at once.
  glide(to) {
    const from = this.look, began = performance.now();
    if (reducedMotion()) return this.setLookOfAll(to);
    // The short way round.
    const around = to.azimuth + 2 * Math.PI * Math.round((from.azimuth - to.azimuth) / (2 * Math.PI));
    const step = (now) => {
      const t = Math.min(1, Math.max(0, (now - began) / 260)), s = t * t * (3 - 2 * t);
      const mix = (a, b) => a + (b - a) * s;
      this.setLookOfAll(t >= 1 ? to : {
        azimuth: mix(from.azimuth, around), elevation: mix(from.elevation, to.elevation),
        zoom: mix(from.zoom, to.zoom), panX: mix(from.panX, to.panX), panY: mix(from.panY, to.panY),
      });
      if (t < 1) requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  spin(on) {
    this.spinning = on;
    let before = performance.now();
    const step = (now) => {
      if (!this.spinning) return;
      this.setLookOfAll({ ...this.look, azimuth: this.look.azimuth + ((now - before) / 1000) * 0.5 });
      before = now;
      requestAnimationFrame(step);
    };
    if (on) requestAnimationFrame(step);
  }

  refresh() {
    if (!this.viewer || this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      for (const [canvas, view] of this.canvases) if (view.inSight) this.#draw(canvas, view);
    });
  }

  async #draw(canvas, view) {
    const layers = view.layers();
    // A slider's canvas shows the first layer left of it, the second right.
    const waiting = layers.filter((layer) => !layer.loaded);
    for (const layer of waiting) {
      try {
        layer.loaded = await this.viewer.load(layer.part);
      } catch (error) {
        view.failed();
        return;
      }
    }
    if (waiting.length) canvas.dataset.ready = 'yes';
    if (!canvas.isConnected || !canvas.clientWidth) return;
    this.viewer.draw(canvas, layers.map((layer) => ({
      ...layer, look: this.lookOf(canvas), frame: this.sameScale ? this.frame : null,
    })), { mode: this.mode, jumpScale: this.jumpScale });
    canvas.dataset.drawn = `${Number(canvas.dataset.drawn || 0) + 1}`;
  }

  /// A canvas that shows what `layers()` says; `failed()` is called where that cannot be shown.
  canvas(label, layers, failed) {
    const canvas = h('canvas', {
      tabindex: 0, role: 'img', 'aria-roledescription': 'view that turns',
      'aria-label': `${label}. Arrow keys turn it, plus and minus zoom, with Shift arrow keys move it, Home turns it back.`,
    });
    this.canvases.set(canvas, { layers, failed, inSight: false });
    ExemplarViewer.listen(canvas, () => this.lookOf(canvas), (look) => this.setLook(canvas, look), () => this.home);
    this.inSight.observe(canvas);
    this.sized.observe(canvas);
    return canvas;
  }
  forget(element) {
    for (const canvas of element.querySelectorAll('canvas')) {
      this.canvases.delete(canvas);
      this.inSight.unobserve(canvas);
      this.sized.unobserve(canvas);
    }
  }

  /// A view or, where there is none, its picture.
  stage(name, picture, label) {
    const stage = h('div', { class: 'stage' });
    const part = this.viewer && this.page.part(name);
    const showPicture = () => {
      const source = this.page.picture(picture);
      stage.replaceChildren(source ? h('img', { src: source, alt: label }) : h('p', { class: 'quiet' }, 'no picture'));
    };
    if (part) {
      const layer = { part };
      stage.append(this.canvas(label, () => [layer], showPicture));
    } else {
      showPicture();
    }
    return stage;
  }

  /// The slider: the example left of it, a result right.
  wipe(run) {
    const { page } = this;
    const example = page.report.example, label = `the example, and ${page.nameOf(run)}`;
    const stage = h('div', { class: 'stage wipe' });
    const line = h('div', { class: 'line' }), parts = [page.part(example.view), page.part(run.view)];
    const slider = h('input', {
      type: 'range', min: 0, max: 100, step: 1, value: Math.round(100 * this.share), class: 'slider',
      'aria-label': `Slider between the example (left) and ${page.nameOf(run)} (right): share of the example, per cent`,
    });
    let show;
    if (this.viewer && parts[0] && parts[1]) {
      const layers = parts.map((part) => ({ part }));
      const canvas = this.canvas(label, () => {
        Object.assign(layers[0], { from: 0, to: this.share });
        Object.assign(layers[1], { from: this.share, to: 1 });
        return layers;
      }, () => stage.replaceChildren(h('p', { class: 'quiet' }, 'This browser cannot show it.')));
      stage.append(canvas, line);
      show = () => this.refresh();
    } else {
      const images = [example.picture, run.picture].map((name, n) =>
        h('img', { src: page.picture(name) || '', alt: n ? page.nameOf(run) : 'the example' }));
      stage.append(...images, line);
      show = () => {
        images[0].style.clipPath = `inset(0 ${100 - 100 * this.share}% 0 0)`;
        images[1].style.clipPath = `inset(0 0 0 ${100 * this.share}%)`;
      };
    }
    const set = (share) => {
      this.share = Math.min(1, Math.max(0, share));
      slider.value = Math.round(100 * this.share);
      line.style.left = `${100 * this.share}%`;
      show();
    };
    slider.addEventListener('input', () => set(slider.valueAsNumber / 100));
    line.addEventListener('pointerdown', (event) => line.setPointerCapture(event.pointerId));
    line.addEventListener('pointermove', (event) => {
      if (!line.hasPointerCapture(event.pointerId)) return;
      const box = stage.getBoundingClientRect();
      set((event.clientX - box.left) / box.width);
    });
    set(this.share);
    return h('div', {}, stage, slider,
      h('div', { class: 'ends' }, h('span', {}, 'example'), h('span', {}, page.nameOf(run))));
  }
}

/// What the colors mean.
function legend(board) {
  const { page } = board;
  if (board.mode === 'origins') {
    const kCells = 9;
    const plan = h('svg', { viewBox: '0 0 90 90', class: 'plan', 'shape-rendering': 'crispEdges', role: 'img', 'aria-label': 'colors of the ground plan' });
    for (let y = 0; y < kCells; ++y) {
      for (let x = 0; x < kCells; ++x) {
        plan.append(h('rect', { x: 10 * x, y: 80 - 10 * y, width: 10, height: 10, fill: sourceColor([x / 8, y / 8, 0.5]) }));
      }
    }
    const rise = h('span', { class: 'ramp upright', style: `background: linear-gradient(to top, ${[0, 0.5, 1].map((z) => sourceColor([0.5, 0.5, z])).join(', ')})` });
    return h('div', { class: 'legend' }, h('div', { class: 'axes' }, plan, h('small', {}, 'x →  ·  y ↑')),
      h('div', { class: 'axes' }, rise, h('small', {}, 'z')),
      h('p', {}, h('b', {}, 'Origins. '), 'Each point has the color of the place in the example that it was taken from; the example itself is the key. Where colors change at once, copied parts meet; a color that comes back is a part that was used again. Dark gray: not known.'));
  }
  if (board.mode === 'jumps') {
    const m = board.jumpScale;
    return h('div', { class: 'legend' },
      h('div', { class: 'axes' }, h('span', { class: 'ramp', style: `background: linear-gradient(to right, ${kJumpColors.join(', ')})` }),
        h('div', { class: 'ends' }, [0, m / 4, m / 2, (3 * m) / 4].map((v) => h('span', {}, short(v))), h('span', {}, `≥ ${short(m)} voxels`))),
      h('p', {}, h('b', {}, 'Seam jump. '), 'Where copied parts meet, by how much the distance field steps aside from what either source says should follow, in voxels',
        page.report.voxel_size ? ` (one is ${short(page.report.voxel_size)} world units)` : '', '. Gray: no seam.'));
  }
  return h('div', { class: 'legend' }, h('p', {}, h('b', {}, 'Material. '),
    `The example’s own colors and materials${page.report.has_origins === false ? '' : ', carried to the result through its origins'}. The light does not move; it was gathered beforehand, as in the pictures.`));
}

/// Radio buttons in a row.
function segments(name, choices, chosen, choose) {
  return h('fieldset', { class: 'segments' }, h('legend', {}, name),
    Object.entries(choices).map(([value, label]) => h('label', {},
      h('input', { type: 'radio', name: `choice-${name}`, value, checked: value === chosen, change: () => choose(value) }),
      h('span', {}, label))));
}
