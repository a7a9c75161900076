// The page: reads the report that is in it, and puts the sections together.

class Page {
  constructor(report) {
    this.report = report;
    this.pictures = new Map([...document.querySelectorAll('[data-picture]')].map((img) => [img.dataset.picture, img.src]));
    this.sources = new Map([...document.querySelectorAll('[data-view]')].map((e) => [e.dataset.view, e]));
    this.parts = new Map();
    for (const run of report.runs) {
      run.engine ??= 'result';  // measured, and not known what made it
      run.seed ??= 0;
    }
    this.engines = [...new Set(report.runs.map((run) => run.engine))];
    styleEngines(this.engines);
    this.seeds = [...new Set(report.runs.map((run) => run.seed))];
    this.seed = this.seeds[0];
  }
  picture(name) { return this.pictures.get(name); }
  part(name) {
    if (!name || !this.sources.has(name)) return null;
    if (!this.parts.has(name)) this.parts.set(name, JSON.parse(this.sources.get(name).textContent));
    return this.parts.get(name);
  }
  allParts() { return [...this.sources.keys()].map((name) => this.part(name)); }
  run(engine, seed) { return this.report.runs.find((run) => run.engine === engine && run.seed === seed); }
  nameOf(run) {
    return this.report.kind === 'comparison' ? `${run.engine}, seed ${run.seed}`
      : run.engine !== 'result' ? `the result (${run.engine})` : 'the result';
  }
}

function header(page) {
  const { report } = page;
  const facts = [
    report.example.samples && ['example', `${times(report.example.samples)} samples`],
    report.voxel_size && ['voxel', `${short(report.voxel_size)} world units`],
    report.scale && ['scale', times(report.scale)],
    report.kind === 'comparison' && ['runs', `${page.engines.length} engines × ${page.seeds.length} ${page.seeds.length === 1 ? 'seed' : 'seeds'}`],
    ['exemplar', report.version],
  ].filter((fact) => fact && fact[1]);
  return h('header', {},
    h('p', { class: 'kind' }, report.kind === 'comparison' ? 'A comparison of syntheses from one example' : 'An example, and what was made of it'),
    h('h1', {}, report.title),
    h('p', { class: 'lead' }, report.description),
    h('dl', { class: 'facts' }, facts.map(([name, value]) => h('div', {}, h('dt', {}, name), h('dd', {}, value)))));
}

function section(id, title, text, ...children) {
  return h('section', { id, 'aria-labeledby': `${id}-title` }, h('h2', { id: `${id}-title` }, title),
    text ? h('p', { class: 'intro' }, text) : null, ...children);
}

function sizeLine(page, run, part) {
  const size = run.samples ? `${times(run.samples)} samples` : '';
  const shown = part ? `${grouped(part.triangles)} triangles${part.of_triangles > part.triangles ? ` of ${grouped(part.of_triangles)}` : ''}` : '';
  return [size, run.seconds !== undefined ? seconds(run.seconds) : '', shown].filter(Boolean).join(' · ');
}

/// A card: what one engine made, or the example.
function card(page, board, run) {
  if (!run) {
    const { example } = page.report, part = page.part(example.view);
    return h('figure', { class: 'card', 'data-card': 'example' }, board.stage(example.view, example.picture, 'The example'),
      h('figcaption', {}, h('b', {}, 'Example'), h('span', {}, sizeLine(page, example, part))));
  }
  const name = h('b', {}, signIcon(run.engine), page.nameOf(run));
  if (run.status !== 'complete') {
    return h('figure', { class: 'card', 'data-card': run.engine },
      h('div', { class: 'stage nothing' }, h('div', {}, h('p', { class: 'status' }, capital(run.status)), h('p', {}, run.why || ''))),
      h('figcaption', {}, name, h('span', {}, 'no result')));
  }
  return h('figure', { class: 'card', 'data-card': run.engine }, board.stage(run.view, run.picture, capital(page.nameOf(run))),
    h('figcaption', {}, name, h('span', {}, sizeLine(page, run, page.part(run.view)))));
}

function viewsSection(page, board) {
  const grid = h('div', { class: 'views' }), key = h('div', { class: 'key-of-colors', 'aria-live': 'polite' });
  const draw = () => {
    board.forget(grid);
    grid.replaceChildren(card(page, board, null), ...page.engines.map((engine) => {
      const run = page.run(engine, page.seed);
      return run ? card(page, board, run) : null;
    }).filter(Boolean));
  };
  const explain = () => {
    key.replaceChildren(legend(board));
    if (board.mode === 'jumps') {
      key.firstChild.prepend(h('label', { class: 'field' }, 'Full color at ',
        h('select', { change: (event) => { board.jumpScale = Number(event.target.value); explain(); board.refresh(); } },
          [1, 2, 4, 8].map((v) => h('option', { value: v, selected: v === board.jumpScale }, `${v} voxels`)))));
    }
  };
  const look = (name) => {
    const to = kViewNames[name];
    board.glide(to ? { ...board.home, azimuth: to[0], elevation: to[1] } : board.home);
  };
  const modes = { material: 'Material' };
  if (page.report.has_origins !== false) Object.assign(modes, { origins: 'Origins', jumps: 'Seam jump' });
  // report.html#origins opens with these colors.
  if (modes[location.hash.slice(1)]) board.mode = location.hash.slice(1);
  const turn = h('button', {
    type: 'button', class: 'turn', 'aria-pressed': 'false',
    click: () => {
      const on = turn.getAttribute('aria-pressed') !== 'true';
      turn.setAttribute('aria-pressed', String(on));
      board.spin(on);
    },
  }, 'Turn');
  const controls = h('div', { class: 'controls' },
    page.seeds.length > 1 ? h('label', { class: 'field' }, 'Seed ',
      h('select', { id: 'seed', change: (event) => { page.seed = page.seeds[event.target.selectedIndex]; page.onSeed.forEach((f) => f()); } },
        page.seeds.map((seed) => h('option', { value: seed }, seed)))) : null,
    board.viewer ? [
      Object.keys(modes).length > 1 && segments('Color', modes, board.mode, (mode) => { board.mode = mode; explain(); board.refresh(); }),
      segments('Scale', { same: 'One scale', fit: 'Fit each' }, 'same', (value) => { board.sameScale = value === 'same'; board.refresh(); }),
      h('span', { class: 'buttons', role: 'group', 'aria-label': 'View' },
        Object.keys(kViewNames).map((name) => h('button', { type: 'button', 'data-look': name, click: () => look(name) }, capital(name))), turn),
      h('label', { class: 'check' }, h('input', {
        type: 'checkbox', checked: true, id: 'together',
        change: (event) => { board.together = event.target.checked; board.own.clear(); board.refresh(); },
      }), ' Turn together'),
    ] : null);
  page.onSeed.push(draw);
  draw();
  if (board.viewer) explain();
  return section('views', 'Side by side', board.viewer
    ? 'Drag to turn, pinch or scroll (once a view has the focus) to zoom, drag with Shift to move. With the keyboard: Tab to a view, then arrow keys, + and −, Home.'
    : page.whyPictures, controls, key, grid);
}

function wipeSection(page, board) {
  const place = h('div', {});
  const complete = () => page.engines.map((engine) => page.run(engine, page.seed)).filter((run) => run && run.status === 'complete');
  let engine = null;
  const draw = () => {
    board.forget(place);
    const runs = complete();
    if (!runs.length) return place.replaceChildren(h('p', { class: 'quiet' }, 'No engine completed with this seed.'));
    const run = runs.find((r) => r.engine === engine) || runs.find((r) => r.engine === 'geometry') || runs[0];
    engine = run.engine;
    place.replaceChildren(
      runs.length > 1 ? h('div', { class: 'controls' }, segments('Result', Object.fromEntries(runs.map((r) => [r.engine, r.engine])), engine, (value) => { engine = value; draw(); })) : '',
      board.wipe(run));
    board.refresh();
  };
  page.onSeed.push(draw);
  draw();
  return section('slider', 'Example against result', 'The example is left of the line, the result right of it, both seen by one camera.', place);
}

function marksSection(page) {
  const marked = page.report.runs.filter((run) => run.status === 'complete' && Array.isArray(run.marks));
  const text = 'The places where a result shows most plainly that it was put together: seams at the surface that jump most, parts of the example that occur in the result at least twice as often as the average, and the largest parts copied as they are.';
  if (!marked.length) return section('marks', 'What shows', null, h('p', { class: 'quiet' }, 'Marks need the result’s origins, which this report does not have.'));
  const shown = new Set(Object.keys(kMarks)), grid = h('div', { class: 'views' });
  const draw = () => {
    grid.replaceChildren(...page.engines.map((engine) => page.run(engine, page.seed))
      .filter((run) => run && run.status === 'complete' && page.picture(run.picture))
      .map((run) => {
        const marks = named(run.marks || []);
        return h('figure', { class: 'card', 'data-marks': run.engine },
          markedPicture(page.picture(run.picture), `Picture of ${page.nameOf(run)} with marks`, marks, shown),
          h('figcaption', {}, h('b', {}, signIcon(run.engine), page.nameOf(run))), markList(marks, shown));
      }));
    if (!grid.children.length) grid.append(h('p', { class: 'quiet' }, 'No engine completed with this seed, or its pictures were left out.'));
  };
  page.onSeed.push(draw);
  draw();
  const toggles = Object.entries(kMarks).map(([kind, about]) => h('label', { class: 'check' }, h('input', {
    type: 'checkbox', checked: true, 'data-kind': kind,
    change: (event) => { if (event.target.checked) shown.add(kind); else shown.delete(kind); draw(); },
  }), h('span', { class: `key mark-${kind}${kind === 'repeat' ? '0' : ''}` }, ''), about.name));
  return section('marks', 'What shows', text, h('div', { class: 'controls' }, toggles), grid);
}

/// Every figure of the complete runs: { id, key, group, meaning }.
function figuresOf(page) {
  const known = (page.report.figures || []).map((f) => ({ ...f, id: `${f.group}.${f.key}` }));
  const ids = new Set(known.map((f) => f.id));
  for (const run of page.report.runs) {
    for (const [group, values] of Object.entries(run.figures || {})) {
      for (const key of Object.keys(values || {})) {
        const id = `${group}.${key}`;
        if (!ids.has(id)) known.push({ group, key, id, meaning: '' });
        ids.add(id);
      }
    }
  }
  return known.filter((f) => page.report.runs.some((run) => ((run.figures || {})[f.group] || {})[f.key] !== undefined));
}
const valueOf = (run, figure) => ((run.figures || {})[figure.group] || {})[figure.key];

function plotsSection(page, figures) {
  const numeric = figures.filter((f) => page.report.runs.some((run) => typeof valueOf(run, f) === 'number'));
  const values = (engine, figure) => page.report.runs
    .filter((run) => run.engine === engine && typeof valueOf(run, figure) === 'number')
    .map((run) => ({ seed: run.seed, value: valueOf(run, figure) }));
  const main = h('div', { class: 'plots' }), more = h('div', { class: 'plots' });
  const draw = () => {
    const make = (f) => plot(f, page.engines, values, page.seed);
    main.replaceChildren(...[frontierPlot(page.report.runs, page.seed),
      ...kMain.map((id) => numeric.find((f) => f.id === id)).filter(Boolean).map(make)].filter(Boolean));
    more.replaceChildren(...numeric.filter((f) => !kMain.includes(f.id)).map(make));
  };
  page.onSeed.push(draw);
  draw();
  return section('plots', 'Figures over seeds', 'Each sign is one seed, the upright line the mean of an engine’s seeds, the dashed line the best there can be. The ringed sign is the seed that is shown above.',
    main, h('details', {}, h('summary', {}, `All other figures (${more.children.length})`), more));
}

/// What the table shows, as rows of text: what is copied.
function tableRows(page, figures, every) {
  const runs = page.report.runs, complete = (engine) => runs.filter((r) => r.engine === engine && r.status === 'complete');
  if (every) {
    const ids = figures.map((f) => f.id);
    return [['engine', 'seed', 'status', 'seconds', 'peak_memory_bytes', 'adjacency_pairs', 'adjacency_violations', 'unknown_blocks', ...ids],
      ...runs.map((run) => [run.engine, run.seed, run.status, run.seconds ?? '', peakOf(run) ?? '', run.adjacency_pairs ?? '', run.adjacency_violations ?? '', run.unknown_blocks ?? '',
        ...figures.map((f) => valueOf(run, f) ?? '')].map(String))];
  }
  const mean = (values) => {
    const numbers = values.filter((v) => typeof v === 'number');
    if (!numbers.length) {
      const rest = [...new Set(values.filter((v) => v !== null && v !== undefined).map(number))];
      return rest.length ? rest.join(', ') : kDash;
    }
    const deviation = deviationOf(numbers);
    return deviation === null || deviation === 0 ? number(meanOf(numbers)) : `${number(meanOf(numbers))} ± ${short(deviation)}`;
  };
  const row = (name, value) => [name, ...page.engines.map((engine) => value(engine))];
  return [['figure', ...page.engines],
    row('complete', (e) => `${complete(e).length} of ${runs.filter((r) => r.engine === e).length}`),
    row('seconds', (e) => mean(complete(e).map((r) => r.seconds))),
    row('peak_memory_bytes', (e) => mean(complete(e).map(peakOf))),
    row('adjacency_pairs', (e) => mean(complete(e).map((r) => r.adjacency_pairs))),
    row('adjacency_violations', (e) => mean(complete(e).map((r) => r.adjacency_violations))),
    row('unknown_blocks', (e) => mean(complete(e).map((r) => r.unknown_blocks))),
    ...figures.map((f) => row(f.id, (e) => mean(complete(e).map((r) => valueOf(r, f)))))];
}

async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // Not allowed here: by way of a selection.
    const area = h('textarea', { class: 'away', readonly: true });
    area.value = text;
    document.body.append(area);
    area.select();
    let done = false;
    try {
      done = document.execCommand('copy');
    } catch { /* stays false */ }
    area.remove();
    return done;
  }
}

function tableSection(page, figures) {
  const place = h('div', { class: 'wide', tabindex: 0, role: 'region', 'aria-label': 'Table of figures' });
  const copied = h('span', { class: 'status', role: 'status' });
  let every = false;
  const draw = () => {
    const [head, ...rows] = tableRows(page, figures, every);
    const meanings = new Map(figures.map((f) => [f.id, f.meaning]));
    place.replaceChildren(h('table', { class: 'figures' },
      h('thead', {}, h('tr', {}, head.map((cell) => h('th', { scope: 'col' }, cell)))),
      h('tbody', {}, rows.map((row) => h('tr', {}, row.map((cell, n) => (n ? h('td', {}, every ? cellText(cell) : cell)
        : h('th', { scope: 'row', title: meanings.get(cell) || null }, cell))))))));
  };
  const cellText = (cell) => (cell !== '' && Number.isFinite(Number(cell)) ? number(Number(cell)) : cell || kDash);
  const copy = h('button', {
    type: 'button', id: 'copy',
    click: async () => {
      const text = tableRows(page, figures, every).map((row) => row.map((cell) => String(cell).replace(/[\t\r\n]/g, ' ')).join('\t')).join('\n') + '\n';
      const done = await copyText(text);
      copied.textContent = done ? 'Copied, with tabs between columns.' : 'Copying is not allowed here; the table is selected instead.';
      if (!done) getSelection().selectAllChildren(place);
    },
  }, 'Copy table');
  draw();
  return section('table', 'Table', page.report.kind === 'comparison' ? 'Means over the complete runs ± their standard deviation, or every run by itself.' : null,
    h('div', { class: 'controls' },
      page.report.kind === 'comparison' ? segments('Rows', { means: 'Means', runs: 'Every run' }, 'means', (value) => { every = value === 'runs'; draw(); }) : null,
      copy, copied), place);
}

function closing(page) {
  const license = document.getElementById('license');
  return h('footer', {},
    h('p', {}, `Made by exemplar ${page.report.version || ''}. This page is one file: it loads nothing, and shows what it holds.`),
    license ? h('details', {}, h('summary', {}, 'Views are drawn by three.js (MIT license)'), h('pre', {}, license.content.textContent)) : null);
}

function build() {
  const page = new Page(JSON.parse(document.getElementById('report').textContent));
  const { report } = page;
  page.onSeed = [];
  let viewer = null;
  page.whyPictures = 'This report was made without surfaces that turn; these are its pictures.';
  if (typeof ExemplarViewer !== 'undefined' && page.sources.size) {
    try {
      viewer = new ExemplarViewer.Viewer(report.camera);
    } catch {
      page.whyPictures = 'This browser cannot show surfaces that turn (WebGL 2 is missing); these are the pictures.';
    }
  }
  const board = new Board(page, viewer), figures = figuresOf(page);
  const comparison = report.kind === 'comparison';
  const sections = [
    header(page),
    comparison ? section('outcomes', 'At a glance', null, outcomes(page.engines, report.runs)) : null,
    viewsSection(page, board), wipeSection(page, board), marksSection(page),
    comparison && figures.length ? plotsSection(page, figures) : null,
    figures.length ? tableSection(page, figures) : null,
    (report.notes || []).length ? section('notes', comparison ? 'What is not comparable' : 'Notes', null, h('ul', {}, report.notes.map((note) => h('li', {}, note)))) : null,
    closing(page),
  ];
  document.getElementById('page').replaceChildren(...sections.filter(Boolean));
  document.documentElement.dataset.ready = viewer ? 'views' : 'pictures';
}

build();
