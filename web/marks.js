// Pictures with marks at what a run did badly.

const kMarks = {
  seam: { name: 'Seams', one: 'seam', says: (m) => `jumps by ${short(m.value)} voxels` },
  repeat: { name: 'Repeated parts', one: 'part', says: (m) => `${short(m.value)} times as often as the average part` },
  copy: { name: 'Copies', one: 'copy', says: (m) => `${short(100 * m.value)} % of the example’s surface, in one piece` },
};

/// Names for marks: seams and copies by number, places of repeated parts by their part's letter.
function named(marks) {
  const count = {};
  return marks.map((mark) => {
    const group = mark.kind === 'repeat' ? String.fromCharCode(65 + mark.group) : mark.kind === 'copy' ? 'C' : '';
    const key = mark.kind + group;
    count[key] = (count[key] || 0) + 1;
    return { ...mark, name: `${group}${count[key]}` };
  });
}

function markClass(mark) {
  return `mark-${mark.kind}${mark.kind === 'repeat' ? mark.group % 2 : ''}`;
}

/// A picture and its marks; `shown` holds the kinds that are on.
function markedPicture(source, alt, marks, shown) {
  const figure = h('div', { class: 'marked' });
  const image = h('img', { src: source, alt });
  figure.append(image);
  const draw = () => {
    const w = image.naturalWidth || 4, t = image.naturalHeight || 3;
    const svg = h('svg', { viewBox: `0 0 ${w} ${t}`, 'aria-hidden': 'true' });
    const unit = w / 100;
    for (const mark of marks) {
      if (!mark.at || !shown.has(mark.kind)) continue;
      const [x, y] = [mark.at[0] * w, mark.at[1] * t];
      const group = h('g', { class: markClass(mark), 'data-mark': mark.name });
      if (mark.outline) {
        const points = mark.outline.map(([u, v]) => `${(u * w).toFixed(1)},${(v * t).toFixed(1)}`).join(' ');
        group.append(h('polygon', { points, class: 'halo' }), h('polygon', { points }));
      }
      if (mark.kind === 'seam') {
        group.append(h('circle', { cx: x, cy: y, r: 2.6 * unit, class: 'halo' }), h('circle', { cx: x, cy: y, r: 2.6 * unit }));
      }
      const bx = mark.kind === 'seam' ? x + 2.6 * unit : x, by = mark.kind === 'seam' ? y - 2.6 * unit : y;
      group.append(
        h('circle', { cx: bx, cy: by, r: 1.5 * unit, class: 'badge' }),
        h('text', { x: bx, y: by + 0.62 * unit, 'font-size': 1.7 * unit, 'text-anchor': 'middle' }, mark.name));
      svg.append(group);
    }
    const old = figure.querySelector('svg');
    if (old) old.replaceWith(svg);
    else figure.append(svg);
  };
  image.addEventListener('load', draw);
  draw();
  return figure;
}

/// The marks in words, a line a seam or copy, one for all places of a part.
function markList(marks, shown) {
  const lines = [];
  for (const kind of Object.keys(kMarks)) {
    if (!shown.has(kind)) continue;
    const own = marks.filter((mark) => mark.kind === kind);
    if (kind === 'repeat') {
      for (const group of new Set(own.map((mark) => mark.group))) {
        const places = own.filter((mark) => mark.group === group), hidden = places.filter((m) => !m.at).length;
        lines.push([places[0], String.fromCharCode(65 + group),
          `part ${kMarks.repeat.says(places[0])}; ${places.length} places${hidden ? `, ${hidden} out of sight` : ''}`]);
      }
    } else {
      for (const mark of own) {
        const [x, y, z] = mark.position.map(short);
        lines.push([mark, mark.name, `${kMarks[kind].one} ${kMarks[kind].says(mark)}, at (${x}, ${y}, ${z})${mark.at ? '' : '; out of sight'}`]);
      }
    }
  }
  if (!lines.length) return h('p', { class: 'quiet' }, 'Nothing of these kinds was found.');
  return h('ul', { class: 'marks' }, lines.map(([mark, name, text]) =>
    h('li', {}, h('span', { class: `key ${markClass(mark)}` }, name), h('span', {}, text))));
}
