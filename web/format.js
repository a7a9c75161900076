// Helpers of the page: making elements, writing numbers, and what is known of each figure.
'use strict';

/// An element: attributes (functions become listeners, `true` an empty attribute), then children.
function h(tag, attributes = {}, ...children) {
  const svg = /^(svg|g|line|circle|rect|path|text|polygon|polyline|title)$/.test(tag);
  const element = svg ? document.createElementNS('http:\/\/www.w3.org/2000/svg', tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (typeof value === 'function') element.addEventListener(name, value);
    else element.setAttribute(name, value === true ? '' : value);
  }
  element.append(...children.flat(3).filter((c) => c !== null && c !== undefined && c !== false));
  return element;
}

const kDash = '–';

/// Four digits that count, as the command's own table writes them.
function number(value) {
  if (value === null || value === undefined) return kDash;
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  if (typeof value === 'string') return value.replaceAll('_', ' ');
  if (!Number.isFinite(value)) return kDash;
  if (Number.isInteger(value)) return grouped(value);
  if (Math.abs(value) < 0.001) return value.toExponential(1);
  return Math.abs(value) >= 10000 ? grouped(Math.round(value)) : String(Number(value.toPrecision(4)));
}
function short(value) {
  if (typeof value !== 'number') return number(value);
  return Math.abs(value) >= 1000 ? grouped(Math.round(value)) : String(Number(value.toPrecision(3)));
}
function grouped(n) {
  return String(n).replace(/\B(?=(\d{3})+(?!\d))/g, '\u2009');
}
function seconds(s) {
  if (s === null || s === undefined) return kDash;
  if (s < 0.0095) return `${Number((1000 * s).toPrecision(2))} ms`;
  if (s < 60) return `${Number(s.toPrecision(2))} s`;
  return `${Math.floor(s / 60)} min ${Math.round(s % 60)} s`;
}
function bytes(b) {
  if (b === null || b === undefined) return kDash;
  return b < 1e9 ? `${Math.round(b / 1e6)} MB` : `${(b / 1e9).toFixed(1)} GB`;
}
const times = (size) => (size ? size.map(grouped).join(' × ') : kDash);
const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

function meanOf(values) {
  return values.reduce((a, b) => a + b, 0) / values.length;
}
function deviationOf(values) {
  if (values.length < 2) return null;
  const mean = meanOf(values);
  return Math.sqrt(values.reduce((a, b) => a + (b - mean) ** 2, 0) / (values.length - 1));
}

/// What figures are called, in what unit, and where the best value is. Others keep their key.
const kFigures = {
  'likeness.lp_dense': { label: 'Likeness (LP-dense)', best: 1, from: 0, to: 1 },
  'likeness.coverage': { label: 'Coverage', best: 1, from: 0, to: 1 },
  'likeness.lp_dense_interior': { label: 'Likeness, inside', best: 1, from: 0, to: 1 },
  'likeness.coverage_interior': { label: 'Coverage, inside', best: 1, from: 0, to: 1 },
  'likeness.lp_dense_mean_iou': { label: 'Likeness, mean IoU', best: 1, from: 0, to: 1 },
  'likeness.coverage_mean_iou': { label: 'Coverage, mean IoU', best: 1, from: 0, to: 1 },
  'likeness.lp_published': { label: 'LP as published', best: 1, from: 0, to: 1 },
  'likeness.fpd': { label: 'Patch distance', unit: 'voxels²' },
  'likeness.fpd_floor': { label: 'Patch distance, floor', unit: 'voxels²' },
  'likeness.occupancy_ratio': { label: 'Solid share', unit: '× example', best: 1, from: 0.9, to: 1.1 },
  'likeness.surface_ratio': { label: 'Surface density', unit: '× example', best: 1, from: 0.9, to: 1.1 },
  'likeness.pieces_per_million_cells': { label: 'Whole pieces', unit: 'per million cells' },
  'likeness.pieces_per_million_cells_example': { label: 'Whole pieces, example', unit: 'per million cells' },
  'likeness.pieces_depth': { label: 'Depth of pieces', unit: 'voxels' },
  'likeness.broken_share': { label: 'Broken pieces', best: 0, from: 0 },
  'likeness.multiscale': { label: 'Shapes at several scales', unit: '× floor', best: 1, from: 0 },
  'likeness.multiscale_1': { label: 'Shapes, samples of 1', unit: '× floor', from: 0 },
  'likeness.multiscale_2': { label: 'Shapes, samples of 2', unit: '× floor', from: 0 },
  'likeness.multiscale_4': { label: 'Shapes, samples of 4', unit: '× floor', from: 0 },
  'likeness.multiscale_8': { label: 'Shapes, samples of 8', unit: '× floor', from: 0 },
  'wholeness.pieces': { label: 'Pieces' },
  'wholeness.pieces_example': { label: 'Pieces, example' },
  'wholeness.largest_piece': { label: 'Largest piece', from: 0, to: 1 },
  'wholeness.largest_piece_example': { label: 'Largest piece, example', from: 0, to: 1 },
  'wholeness.floating': { label: 'Floating solid', from: 0 },
  'wholeness.floating_example': { label: 'Floating solid, example', from: 0 },
  'wholeness.flat': { label: 'Flat surface', from: 0 },
  'wholeness.flat_example': { label: 'Flat surface, example', from: 0 },
  'wholeness.sliced': { label: 'Sliced surface', best: 0, from: 0 },
  'wholeness.open': { label: 'Cut by the box', best: 0, from: 0 },
  'wholeness.tunnels': { label: 'Tunnels', unit: 'per 10,000 faces' },
  'wholeness.tunnels_example': { label: 'Tunnels, example', unit: 'per 10,000 faces' },
  'wholeness.bubbles': { label: 'Bubbles', unit: 'per 10,000 faces' },
  'wholeness.bubbles_example': { label: 'Bubbles, example', unit: 'per 10,000 faces' },
  'wholeness.layers': { label: 'Difference by height', best: 0, from: 0 },
  'likeness.windows': { label: 'Windows drawn' },
  'novelty.distance_to_example': { label: 'Distance to example', from: 0, to: 1 },
  'novelty.distance_to_shifted_example': { label: 'Distance to shifted example', from: 0, to: 1 },
  'novelty.distance_to_rolled_example': { label: 'Distance to rolled example', from: 0, to: 1 },
  'novelty.distance_to_rolled_example_least': { label: 'The same, nearest window', from: 0, to: 1 },
  'novelty.distance_to_turned_example': { label: 'Distance to turned example', from: 0, to: 1 },
  'novelty.rolling_is_fair': { label: 'Moving is fair along' },
  'novelty.top_offset': { label: 'Commonest offset', from: 0, to: 1 },
  'novelty.top_offset_rolled': { label: 'Commonest offset, rolled', from: 0, to: 1 },
  'novelty.offsets_95': { label: 'Offsets for 95 %' },
  'frontier.likeness': { label: 'Likeness, at several scales', unit: '× floor', from: 0 },
  'frontier.novelty': { label: 'Novelty, rolled', from: 0, to: 1 },
  'frontier.kind': { label: 'Copied or new' },
  'doubts.moved': { label: 'Doubt: the example moved' },
  'doubts.pieces': { label: 'Doubt: more pieces' },
  'doubts.floating': { label: 'Doubt: parts float' },
  'doubts.occupancy': { label: 'Doubt: fuller or emptier' },
  'doubts.sliced': { label: 'Doubt: sliced' },
  'doubts.open': { label: 'Doubt: cut by the box' },
  'novelty.verbatim_run': { label: 'Copied regions', unit: '× example', from: 0, to: 1 },
  'novelty.use': { label: 'Evenness of use', best: 1, from: 0, to: 1 },
  'novelty.used_share': { label: 'Example used', best: 1, from: 0, to: 1 },
  'seams.seam_jump': { label: 'Seam jump', unit: 'voxels', best: 0, from: 0 },
  'seams.seam_jump_ratio': { label: 'Seam jump', unit: '× example’s own', from: 0 },
  'seams.seam_jump_near_surface': { label: 'Seam jump at the surface', unit: 'voxels', best: 0, from: 0 },
  'seams.seam_jump_ratio_near_surface': { label: 'Seam jump at the surface', unit: '× example’s own', from: 0 },
  'seams.seam_share': { label: 'Faces at seams', from: 0 },
  'seams.eikonal_residual': { label: 'Distance error', unit: '| |∇φ| − 1 |', from: 0 },
  'seams.eikonal_residual_example': { label: 'Distance error, example', unit: '| |∇φ| − 1 |', from: 0 },
  'content.labels_used': { label: 'Labels used', best: 1, from: 0, to: 1 },
  'content.label_shares': { label: 'Difference of label shares', best: 0, from: 0, to: 1 },
  'content.density': { label: 'Built cells', unit: '× example', best: 1, from: 0.5, to: 1.5 },
  'content.layers': { label: 'Difference by height', best: 0, from: 0 },
  'content.objects': { label: 'Objects', unit: 'per 100 columns' },
  'content.objects_example': { label: 'Objects, example', unit: 'per 100 columns' },
  'content.object_sizes': { label: 'Difference of object sizes', best: 0, from: 0, to: 1 },
  'content.runs_x': { label: 'Runs along x', unit: '× example', best: 1 },
  'content.runs_y': { label: 'Runs along y', unit: '× example', best: 1 },
  'content.runs_z': { label: 'Runs along z', unit: '× example', best: 1 },
  'content.js1': { label: 'Divergence of labels', unit: 'bits', best: 0, from: 0, to: 1 },
  'content.js2': { label: 'Divergence of 2³ blocks', unit: 'bits', best: 0, from: 0, to: 1 },
  'content.js3': { label: 'Divergence of 3³ blocks', unit: 'bits', best: 0, from: 0, to: 1 },
  'content.js1_halves': { label: 'Divergence of labels, halves', unit: 'bits', from: 0, to: 1 },
  'content.js2_halves': { label: 'Divergence of 2³ blocks, halves', unit: 'bits', from: 0, to: 1 },
  'content.js3_halves': { label: 'Divergence of 3³ blocks, halves', unit: 'bits', from: 0, to: 1 },
  'content.in3': { label: 'Known 3³ blocks', from: 0, to: 1 },
  'content.copy8': { label: 'Verbatim windows', best: 0, from: 0, to: 1 },
  'content.density_inside': { label: 'Built cells inside', unit: '× example', best: 1, from: 0.5, to: 1.5 },
  'content.layers_inside': { label: 'Difference by height inside', best: 0, from: 0 },
  'content.near8': { label: 'Nearly verbatim windows', best: 0, from: 0, to: 1 },
  'content.largest_copy': { label: 'Largest copied area', unit: '× example', best: 0, from: 0, to: 1 },
};
/// The figures that are shown first.
const kMain = [
  'likeness.lp_dense', 'likeness.coverage', 'likeness.occupancy_ratio', 'likeness.surface_ratio',
  'likeness.multiscale', 'novelty.distance_to_rolled_example', 'wholeness.pieces', 'wholeness.sliced',
  'novelty.used_share', 'novelty.verbatim_run', 'seams.seam_jump_near_surface', 'seams.seam_share', 'content.density', 'content.labels_used', 'content.layers', 'content.object_sizes',
];

/// What is known of engines by the first word of their name; settings may follow after a colon.
const kEngines = {
  blocks: { says: 'geometry synthesis by best-matching blocks', color: 0, mark: 'square' },
  geometry: { says: 'geometry synthesis by quilting, or by voting', color: 1, mark: 'circle' },
  quilting: { says: 'geometry synthesis by large pieces joined by cuts', color: 4, mark: 'circle' },
  voting: { says: 'geometry synthesis by patches matched and voted', color: 5, mark: 'circle' },
  model: { says: 'model synthesis by adjacency', color: 2, mark: 'triangle' },
  overlap: { says: 'model synthesis on overlapping blocks', color: 3, mark: 'diamond' },
};
const kColors = 8;
const styles = new Map();
/// Gives each engine of a report a color and a shape, its own where it has one.
function styleEngines(engines) {
  const free = [...Array(kColors).keys()].filter((c) => !engines.some((e) => kEngines[e] && kEngines[e].color === c));
  for (const engine of engines) {
    const about = kEngines[engine.split(':')[0]] || { mark: 'circle', says: '' };
    const color = kEngines[engine] ? about.color : free.length ? free.shift() : styles.size % kColors;
    styles.set(engine, { ...about, color });
  }
}
const styleOf = (engine) => styles.get(engine) || { color: 1, mark: 'circle', says: '' };
const engineIndex = (engine) => styleOf(engine).color;
const engineSays = (engine) => styleOf(engine).says;

/// The sign of an engine about (x, y): color and shape both show it.
function sign(engine, x, y, r, attributes = {}) {
  const attrs = { class: `engine-${engineIndex(engine)}`, ...attributes };
  switch (styleOf(engine).mark) {
    case 'square': return h('rect', { x: x - r * 0.9, y: y - r * 0.9, width: 1.8 * r, height: 1.8 * r, ...attrs });
    case 'triangle': return h('polygon', { points: `${x},${y - 1.15 * r} ${x + 1.1 * r},${y + 0.85 * r} ${x - 1.1 * r},${y + 0.85 * r}`, ...attrs });
    case 'diamond': return h('polygon', { points: `${x},${y - 1.25 * r} ${x + 1.1 * r},${y} ${x},${y + 1.25 * r} ${x - 1.1 * r},${y}`, ...attrs });
    default: return h('circle', { cx: x, cy: y, r, ...attrs });
  }
}
function signIcon(engine) {
  return h('svg', { class: 'sign', viewBox: '0 0 14 14', width: 14, height: 14, 'aria-hidden': 'true' }, sign(engine, 7, 7, 5));
}

/// The color of a place of the example, as views show it (surface.js): shares of each side, 0..1.
function sourceColor([x, y, z]) {
  const L = 0.48 + 0.34 * z, a = 0.30 * (x - 0.5), b = 0.30 * (y - 0.5);
  const l = (L + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (L - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (L - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const rgb = [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
  return `rgb(${rgb.map((c) => {
    const v = Math.min(1, Math.max(0, c));
    return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
  }).join(' ')})`;
}
/// The colors of seam jumps, from none to most (surface.js).
const kJumpColors = ['rgb(204 204 204)', 'rgb(250 217 112)', 'rgb(232 107 46)', 'rgb(168 18 82)', 'rgb(66 8 82)'];
