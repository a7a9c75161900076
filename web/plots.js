// Small plots of figures over seeds, and what each engine took.

/// A few round numbers from low to high.
function ticksOf(low, high) {
  const span = high - low || 1, raw = span / 3;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].map((n) => n * power).find((n) => n >= raw * 0.999) || raw;
  const ticks = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * span; ++n) ticks.push(n * step);
  return ticks;
}

/// One figure: a row for each engine, a sign for each seed, a line at the mean.
function plot(figure, engines, valuesOf, shownSeed) {
  const about = kFigures[figure.id] || {};
  const rows = engines.map((engine) => ({ engine, values: valuesOf(engine, figure) }));
  const all = rows.flatMap((row) => row.values.map((v) => v.value));
  const width = 300, left = Math.min(130, 22 + 6.2 * Math.max(...engines.map((e) => e.length))), right = 14, top = 8, line = 22;
  const height = top + line * rows.length + 22;
  let low = Math.min(...all, about.from ?? Infinity, about.best ?? Infinity);
  let high = Math.max(...all, about.to ?? -Infinity, about.best ?? -Infinity);
  if (low === high) {
    low -= Math.abs(low) * 0.1 || 0.5;
    high += Math.abs(high) * 0.1 || 0.5;
  }
  const x = (v) => left + ((v - low) / (high - low)) * (width - left - right);
  const label = about.label || figure.key.replaceAll('_', ' ');
  const says = rows.map((row) => `${row.engine} ${row.values.length ? row.values.map((v) => number(v.value)).join(', ') : 'none'}`);
  const svg = h('svg', {
    viewBox: `0 0 ${width} ${height}`, role: 'img',
    'aria-label': `${label}${about.unit ? `, ${about.unit}` : ''}: ${says.join('; ')}`,
  });
  for (const tick of ticksOf(low, high)) {
    svg.append(
      h('line', { x1: x(tick), x2: x(tick), y1: top, y2: height - 18, class: 'grid' }),
      h('text', { x: x(tick), y: height - 5, 'text-anchor': 'middle', class: 'tick' }, short(Number(tick.toPrecision(6)))));
  }
  if (about.best !== undefined) {
    svg.append(h('line', { x1: x(about.best), x2: x(about.best), y1: top - 4, y2: height - 18, class: 'best' }));
  }
  rows.forEach((row, r) => {
    const y = top + line * (r + 0.5);
    svg.append(h('text', { x: 0, y: y + 4, class: 'name' }, row.engine.length > 18 ? `${row.engine.slice(0, 17)}…` : row.engine));
    if (!row.values.length) {
      svg.append(h('text', { x: left, y: y + 4, class: 'tick' }, kDash));
      return;
    }
    const mean = meanOf(row.values.map((v) => v.value));
    svg.append(h('line', { x1: x(mean), x2: x(mean), y1: y - 8, y2: y + 8, class: `mean engine-${engineIndex(row.engine)}` }));
    for (const v of row.values) {
      const dot = sign(row.engine, x(v.value), y, 4, {});
      dot.classList.add('dot');
      if (v.seed === shownSeed && row.values.length > 1) dot.classList.add('shown');
      dot.append(h('title', {}, `${row.engine}, seed ${v.seed}: ${number(v.value)}`));
      svg.append(dot);
    }
  });
  return h('figure', { class: 'plot', 'data-figure': figure.id },
    h('figcaption', {}, h('b', {}, label), about.unit ? h('span', { class: 'unit' }, about.unit) : null),
    svg,
    h('p', { class: 'meaning' }, figure.meaning ? `${capital(figure.meaning)}.` : ''));
}

/// Likeness against novelty, a sign for each result: what is wanted is right and below.
function frontierPlot(runs, shownSeed) {
  const results = runs.map((run) => ({ run, at: (run.figures || {}).frontier || {} }))
    .filter(({ at }) => typeof at.likeness === 'number' && typeof at.novelty === 'number');
  if (!results.length) return null;
  const width = 300, height = 190, left = 34, right = 12, top = 10, bottom = 34;
  const kNew = 0.2, kAlike = 2;
  const most = Math.max(kAlike * 1.25, ...results.map(({ at }) => at.likeness));
  const widest = Math.max(0.5, ...results.map(({ at }) => at.novelty));
  const x = (v) => left + (v / widest) * (width - left - right);
  const y = (v) => height - bottom - (v / most) * (height - top - bottom);
  const svg = h('svg', {
    viewBox: `0 0 ${width} ${height}`, role: 'img',
    'aria-label': `Likeness against novelty: ${results.map(({ run, at }) => `${run.engine}, seed ${run.seed}: ${number(at.likeness)}, ${number(at.novelty)}`).join('; ')}`,
  });
  svg.append(h('rect', { x: x(kNew), y: y(kAlike), width: width - right - x(kNew), height: y(0) - y(kAlike), class: 'wanted' }));
  for (const tick of ticksOf(0, widest)) {
    svg.append(h('line', { x1: x(tick), x2: x(tick), y1: top, y2: y(0), class: 'grid' }),
      h('text', { x: x(tick), y: height - bottom + 13, 'text-anchor': 'middle', class: 'tick' }, short(Number(tick.toPrecision(6)))));
  }
  for (const tick of ticksOf(0, most)) {
    svg.append(h('line', { x1: left, x2: width - right, y1: y(tick), y2: y(tick), class: 'grid' }),
      h('text', { x: left - 5, y: y(tick) + 4, 'text-anchor': 'end', class: 'tick' }, short(Number(tick.toPrecision(6)))));
  }
  svg.append(h('text', { x: (left + width - right) / 2, y: height - 4, 'text-anchor': 'middle', class: 'tick' }, 'novelty →'));
  for (const { run, at } of results) {
    const dot = sign(run.engine, x(at.novelty), y(at.likeness), 4, {});
    dot.classList.add('dot');
    if (run.seed === shownSeed) dot.classList.add('shown');
    dot.append(h('title', {}, `${run.engine}, seed ${run.seed}: likeness ${number(at.likeness)}, novelty ${number(at.novelty)} (${String(at.kind).replaceAll('_', ' ')})`));
    svg.append(dot);
  }
  return h('figure', { class: 'plot', 'data-figure': 'frontier' },
    h('figcaption', {}, h('b', {}, 'Likeness against novelty'), h('span', { class: 'unit' }, '× a fresh sample’s distance')),
    svg,
    h('p', { class: 'meaning' }, 'Up: how much farther from the example than a fresh sample of it is, at several scales. Right: how far from the example itself, wherever it is laid. The field is what is wanted: alike, and new.'));
}

/// What every engine came to: success over seeds, time, memory, violations.
function outcomes(engines, runs) {
  const line = (engine) => {
    const own = runs.filter((run) => run.engine === engine);
    const complete = own.filter((run) => run.status === 'complete');
    const took = own.map((run) => run.seconds).filter((s) => typeof s === 'number');
    const peaks = own.map(peakOf).filter((b) => typeof b === 'number');
    const violations = complete.filter((run) => typeof run.adjacency_violations === 'number');
    const pairs = violations.map((run) => run.adjacency_pairs).filter((v) => typeof v === 'number');
    const unknown = violations.map((run) => run.unknown_blocks).filter((v) => typeof v === 'number');
    const range = (values, write) => {
      if (!values.length) return kDash;
      const low = write(Math.min(...values)), high = write(Math.max(...values));
      return low === high ? low : `${low} to ${high}`;
    };
    const seeds = h('span', { class: 'seeds', role: 'img', 'aria-label': `${complete.length} of ${own.length} complete` },
      own.slice(0, 40).map((run) => h('i', {
        class: `engine-${engineIndex(engine)}${run.status === 'complete' ? ' done' : ''}`,
        title: `seed ${run.seed}: ${run.status}`,
      })));
    const why = own.find((run) => run.status !== 'complete');
    return h('tr', {},
      h('th', { scope: 'row' }, signIcon(engine), engine, h('small', {}, engineSays(engine))),
      h('td', { 'data-label': 'complete' }, seeds, `${complete.length} of ${own.length}`,
        why ? h('small', {}, `${why.status}: ${why.why || ''}`) : null),
      h('td', { 'data-label': 'time' }, range(took, seconds)),
      h('td', { 'data-label': 'memory' }, range(peaks, bytes)),
      h('td', { 'data-label': 'violations' }, violations.length
        ? [range(violations.map((run) => run.adjacency_violations), grouped),
          pairs.length ? h('small', {}, `of ${range(pairs, grouped)} pairs of neighbors`) : null,
          unknown.length && Math.max(...unknown) > 0 ? h('small', {}, `${range(unknown, (v) => `${Math.round(100 * v)} %`)} of the blocks are like none of the example’s`) : null]
        : 'not computed'));
  };
  return h('table', { class: 'outcomes' },
    h('thead', {}, h('tr', {}, h('th', {}, 'engine'), h('th', {}, 'complete'), h('th', {}, 'time'),
      h('th', {}, 'peak memory'), h('th', {}, 'adjacency violations'))),
    h('tbody', {}, engines.map(line)));
}
function peakOf(run) {
  return run.peak_memory_bytes ?? run.peak_rss_bytes ?? run.peak_bytes;
}
