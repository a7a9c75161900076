// From where views look: the camera of the program's own pictures (preview/camera.h), and turning it.

/// The directions of a camera at an azimuth and elevation, z up.
export function axesOf(azimuth, elevation) {
  const ca = Math.cos(azimuth), sa = Math.sin(azimuth);
  const ce = Math.cos(elevation), se = Math.sin(elevation);
  const right = [ca, sa, 0], forward = [-sa * ce, ca * ce, -se];
  const up = [
    right[1] * forward[2] - right[2] * forward[1], right[2] * forward[0] - right[0] * forward[2],
    right[0] * forward[1] - right[1] * forward[0],
  ];
  return { right, up, forward };
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/// The nearest camera that holds all points: `points(visit)` calls `visit([x, y, z])` for each.
export function fitCamera(home, aspect, points) {
  const { right, up, forward } = axesOf(home.azimuth, home.elevation);
  const tangent = Math.tan(home.fieldOfView / 2);
  const tanX = tangent * Math.max(1, aspect), tanY = tangent * Math.max(1, 1 / aspect);
  const free = 1 - 2 * home.margin, freeX = tanX * free, freeY = tanY * free;
  let lowX = -Infinity, highX = Infinity, lowY = -Infinity, highY = Infinity, nearest = Infinity;
  let farthest = -Infinity;
  points((p) => {
    const a = dot(p, right), b = dot(p, up), c = dot(p, forward);
    lowX = Math.max(lowX, a - freeX * c);
    highX = Math.min(highX, a + freeX * c);
    lowY = Math.max(lowY, b - freeY * c);
    highY = Math.min(highY, b + freeY * c);
    nearest = Math.min(nearest, c);
    farthest = Math.max(farthest, c);
  });
  const depth = Math.min((highX - lowX) / (2 * freeX), (highY - lowY) / (2 * freeY), nearest - 1e-3);
  const a = (lowX + highX) / 2, b = (lowY + highY) / 2, middle = (nearest + farthest) / 2;
  // What it turns around: on the line of sight, as deep as the middle of what is seen.
  return {
    target: [0, 1, 2].map((i) => right[i] * a + up[i] * b + forward[i] * middle),
    distance: middle - depth, tanX, tanY,
  };
}

/// Where a fitted camera is after it was turned to `look`.
export function placeCamera(fit, look) {
  const { right, up, forward } = axesOf(look.azimuth, look.elevation);
  const distance = fit.distance / look.zoom;
  const target = [0, 1, 2].map(
    (i) => fit.target[i] + (right[i] * look.panX + up[i] * look.panY) * distance);
  return {
    target, up, distance, position: [0, 1, 2].map((i) => target[i] - forward[i] * distance),
  };
}

const kStep = Math.PI / 24;
const clamp = (v, low, high) => Math.min(high, Math.max(low, v));

export function turned(look, azimuth, elevation) {
  const limit = Math.PI / 2;
  return { ...look, azimuth: look.azimuth + azimuth, elevation: clamp(look.elevation + elevation, -limit, limit) };
}
export const zoomed = (look, factor) => ({ ...look, zoom: clamp(look.zoom * factor, 0.2, 20) });
export const moved = (look, x, y) => ({
  ...look, panX: clamp(look.panX + x, -2, 2), panY: clamp(look.panY + y, -2, 2),
});

/// The look after a key, or nothing where the key says nothing.
export function keyed(look, event, home) {
  if (event.ctrlKey || event.metaKey || event.altKey) return null;
  const shift = event.shiftKey;
  switch (event.key) {
    case 'ArrowLeft': return shift ? moved(look, 0.05, 0) : turned(look, kStep, 0);
    case 'ArrowRight': return shift ? moved(look, -0.05, 0) : turned(look, -kStep, 0);
    case 'ArrowUp': return shift ? moved(look, 0, -0.05) : turned(look, 0, kStep);
    case 'ArrowDown': return shift ? moved(look, 0, 0.05) : turned(look, 0, -kStep);
    case '+': case '=': return zoomed(look, 1.15);
    case '-': case '_': return zoomed(look, 1 / 1.15);
    case 'Home': return home;
    default: return null;
  }
}

/// Lets pointers turn what a canvas shows: one finger or button turns, with Shift or another button
/// moves; two fingers zoom and move. The wheel zooms where the canvas has the focus: a page that
/// scrolls past it must not be caught. `getLook`, `setLook(look)`.
export function listen(canvas, getLook, setLook, home) {
  const pointers = new Map();
  let spread = 0;
  canvas.addEventListener('pointerdown', (event) => {
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    spread = 0;
    canvas.setPointerCapture(event.pointerId);
  });
  const release = (event) => {
    pointers.delete(event.pointerId);
    spread = 0;
  };
  canvas.addEventListener('pointerup', release);
  canvas.addEventListener('pointercancel', release);
  canvas.addEventListener('lostpointercapture', release);
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('pointermove', (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before[0], dy = event.clientY - before[1];
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    const size = Math.min(canvas.clientWidth, canvas.clientHeight) || 1;
    if (pointers.size > 1) {
      const [a, b] = [...pointers.values()];
      const now = Math.hypot(a[0] - b[0], a[1] - b[1]);
      let look = moved(getLook(), (-0.25 * dx) / size, (0.25 * dy) / size);
      if (spread > 0 && now > 0) look = zoomed(look, now / spread);
      spread = now;
      setLook(look);
    } else if (event.shiftKey || event.buttons & 6) {
      setLook(moved(getLook(), (-0.5 * dx) / size, (0.5 * dy) / size));
    } else {
      setLook(turned(getLook(), (-Math.PI * dx) / size, (0.8 * Math.PI * dy) / size));
    }
  });
  canvas.addEventListener('wheel', (event) => {
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    setLook(zoomed(getLook(), Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015))));
  }, { passive: false });
  canvas.addEventListener('keydown', (event) => {
    const look = keyed(getLook(), event, home());
    if (!look) return;
    event.preventDefault();
    setLook(look);
  });
}
