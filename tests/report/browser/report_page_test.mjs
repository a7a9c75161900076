// The page of a report in headless Chromium: that it shows what it holds, and that its controls do
// what they say. node report_page_test.mjs EXEMPLAR MODULES: the command, and where npm put
// playwright-core. Exit status 77: skipped, for want of a browser.

import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const [, , exemplar, modules] = process.argv;
const browserPath = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome']
  .find((path) => existsSync(path));

function skip(why) {
  const required = process.env.EXEMPLAR_BROWSER_TESTS === 'required';
  console.log(`${required ? 'FAILED' : 'SKIPPED'}: ${why}`);
  process.exit(required ? 1 : 77);
}
if (!browserPath) skip('no Chromium in /usr/bin (apt-get install chromium)');
let chromium;
try {
  ({ chromium } = createRequire(join(modules, 'x.js'))('playwright-core'));
} catch (error) {
  skip(`no playwright-core in ${modules} (${error.message.split('\n')[0]}); npm fetches it when exemplar is built`);
}

const folder = mkdtempSync(join(tmpdir(), 'exemplar-report-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));
process.chdir(folder);

let checks = 0, failures = 0;
function check(what, good, detail = '') {
  ++checks;
  if (good) return;
  ++failures;
  console.log(`FAILED: ${what}${detail === '' ? '' : `: ${detail}`}`);
}
const near = (a, b, tolerance) => Math.abs(a - b) <= tolerance;

// ---- a report of hills that repeat, which all engines can go on with

function run(...args) {
  const done = spawnSync(exemplar, args, { encoding: 'utf8' });
  if (done.status !== 0) {
    console.log(`FAILED: exemplar ${args.join(' ')}: ${done.stderr}`);
    process.exit(1);
  }
}
let pgm = 'P2\n32 32\n255\n';
for (let y = 0; y < 32; ++y) {
  for (let x = 0; x < 32; ++x) pgm += `${40 + 5 * Math.abs((x % 8) - 4) + 4 * Math.abs((y % 8) - 3)}\n`;
}
// A name that would be markup, were it not escaped.
const example = 'hills <b> & "x\'.vdb';
writeFileSync('hills.pgm', pgm);
run('sdf', 'hills.pgm', '-o', example, '--cell-size', '1', '--height-scale', '0.2', '-q');
const small = ['--size', '320x240', '--samples', '16', '-q'];
run('compare', example, '-o', 'made', '--seeds', '2', '--engines', 'blocks,geometry', '--scale', '1.5,1,1', ...small);
const comparison = JSON.parse(readFileSync('made/compare.json', 'utf8'));
const url = (path) => `file://${encodeURI(join(folder, path))}`;

// ---- the browser

async function open(path, { flags = [], ...options } = {}) {
  const profile = mkdtempSync(join(folder, 'profile-'));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: browserPath, headless: true, viewport: { width: 1280, height: 900 },
    // A quarter of the pixels, all of which the CPU draws here.
    deviceScaleFactor: 0.5, ...options,
    args: ['--headless=new', '--no-sandbox', '--disable-gpu', '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run', '--disable-background-networking',
      '--disable-component-update', '--disable-sync', ...flags],
  });
  const page = context.pages()[0] || await context.newPage();
  page.setDefaultTimeout(60000);
  const errors = [], requests = [];
  page.on('console', (message) => { if (message.type() === 'error') errors.push(message.text()); });
  page.on('pageerror', (error) => errors.push(error.message));
  page.on('request', (request) => {
    if (!/^(data|blob):/.test(request.url()) && request.url() !== url(path)) requests.push(request.url());
  });
  await page.goto(url(path));
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, { timeout: 30000 }).catch(() => {
    check(`${path} opens`, false, errors.join('; '));
    process.exit(1);
  });
  return { context, page, errors, requests };
}

/// Helpers inside of the page.
async function teach(page) {
  await page.evaluate(() => {
    const pixels = (canvas) => canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    window.test = {
      pixels,
      canvas: (n) => document.querySelectorAll('#views canvas')[n],
      frame: () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 0)))),
      /// How much of a canvas is drawn, and how much its colors vary.
      content: (canvas) => {
        const { data } = pixels(canvas);
        let drawn = 0, sum = 0, squares = 0;
        for (let i = 0; i < data.length; i += 4) {
          if (data[i + 3] < 250) continue;
          const light = (data[i] + data[i + 1] + data[i + 2]) / 3;
          ++drawn;
          sum += light;
          squares += light * light;
        }
        const mean = sum / drawn;
        return { share: drawn / (data.length / 4), deviation: Math.sqrt(squares / drawn - mean * mean) || 0 };
      },
      hash: (canvas) => {
        let hash = 2166136261;
        for (const byte of pixels(canvas).data) hash = Math.imul(hash ^ byte, 16777619);
        return hash >>> 0;
      },
      /// How many hues there are among saturated pixels, of 24.
      hues: (canvas) => {
        const seen = new Set(), { data } = pixels(canvas);
        for (let i = 0; i < data.length; i += 4) {
          const [r, g, b] = [data[i], data[i + 1], data[i + 2]], high = Math.max(r, g, b), low = Math.min(r, g, b);
          if (data[i + 3] < 250 || high - low < 40) continue;
          const hue = high === r ? ((g - b) / (high - low) + 6) % 6 : high === g ? (b - r) / (high - low) + 2 : (r - g) / (high - low) + 4;
          seen.add(Math.floor(hue * 4));
        }
        return seen.size;
      },
    };
  });
}
const settle = async (page) => {
  await page.waitForFunction(() => [...document.querySelectorAll('#views canvas')].every((c) => c.dataset.drawn));
  await page.waitForTimeout(120);
  await page.evaluate(() => test.frame());
};
const hashes = (page) => page.evaluate(() => [...document.querySelectorAll('#views canvas')].map(test.hash));
const contents = (page) => page.evaluate(() => [...document.querySelectorAll('#views canvas')].map(test.content));
const isBlank = ({ share, deviation }) => !(share > 0.05 && share < 0.95 && deviation > 4);

// ---- views, turning, colors, the slider

const { context, page, errors, requests } = await open('made/report.html');
await teach(page);
check('the page shows views', await page.evaluate(() => document.documentElement.dataset.ready) === 'views');
check('a hostile name is text', await page.evaluate(() => document.querySelector('h1').textContent) === 'hills <b> & "x\'');
// All of them in sight, so that all are drawn.
await page.setViewportSize({ width: 1280, height: 2600 });
await settle(page);
const count = await page.locator('#views canvas').count();
check('there is a view of the example and of each engine', count === 3, count);
for (const content of await contents(page)) check('a view shows a surface', !isBlank(content), JSON.stringify(content));
check('a blank view is distinguished from one that shows something', await page.evaluate(() => {
  const canvas = document.createElement('canvas');
  return test.content(canvas);
}).then(isBlank));

const home = await hashes(page);
await page.locator('#views canvas').first().focus();
await page.keyboard.press('ArrowRight');
await settle(page);
const turned = await hashes(page);
check('a key turns every view', turned.every((h, n) => h !== home[n]));
await page.keyboard.press('Home');
await settle(page);
check('Home turns every view back', (await hashes(page)).every((h, n) => h === home[n]));
await page.keyboard.press('+');
await settle(page);
check('plus zooms every view', (await hashes(page)).every((h, n) => h !== home[n]));
const outline = await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
check('the focus is seen', outline !== 'none', outline);
await page.keyboard.press('Home');
const drag = async (n) => {
  const box = await page.locator('#views canvas').nth(n).boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2 + 20, { steps: 4 });
  await page.mouse.up();
  await settle(page);
};
await drag(1);
check('dragging one view turns them all', (await hashes(page)).every((h, n) => h !== home[n]));
await page.locator('[data-look=top]').click();
await page.waitForTimeout(700);
await settle(page);
const top = await hashes(page);
check('Top looks from above', top.every((h, n) => h !== home[n]));
await page.locator('[data-look=iso]').click();
await page.waitForTimeout(700);
await settle(page);
check('Iso turns back', (await hashes(page)).every((h, n) => h === home[n]));
await page.locator('#together').uncheck();
await drag(1);
const alone = await hashes(page);
check('apart, only the dragged one turns', alone[0] === home[0] && alone[1] !== home[1] && alone[2] === home[2]);
await page.locator('#together').check();
await settle(page);

const choose = async (name, value) => {
  await page.locator(`input[name="choice-${name}"][value="${value}"]`).locator('..').click();
  await settle(page);
};
const huesOf = () => page.evaluate(() => [...document.querySelectorAll('#views canvas')].map(test.hues));
const plainHues = await huesOf();
await choose('Color', 'origins');
const origins = await hashes(page), originHues = await huesOf();
check('origins recolor every view', origins.every((h, n) => h !== home[n]));
check('origins have many hues', originHues.every((n, i) => n >= 8 && n > plainHues[i]), `${originHues} from ${plainHues}`);
check('origins have a legend', /origins/i.test(await page.locator('.legend').innerText()));
await choose('Color', 'jumps');
const jumps = await hashes(page), jumpHues = await huesOf();
check('seam jumps recolor every view', jumps.every((h, n) => h !== home[n] && h !== origins[n]));
check('the example has no seam, and a result of blocks has', jumpHues[0] === 0 && jumpHues[1] > 0, jumpHues);
check('seam jumps have a legend with units', /voxels/.test(await page.locator('.legend').innerText()));
await page.locator('.legend select').selectOption('1');
await settle(page);
check('the scale of jumps changes what is shown', (await hashes(page))[1] !== jumps[1]);
await choose('Color', 'material');
check('material is as before', (await hashes(page)).every((h, n) => h === home[n]));
await page.locator('#seed').selectOption('1');
await page.waitForTimeout(300);
await settle(page);
const second = await hashes(page);
check('another seed shows another result', second[1] !== home[1] && second[0] === home[0]);
await page.locator('#seed').selectOption('0');
await settle(page);

await page.locator('.wipe canvas').scrollIntoViewIfNeeded();
await page.waitForFunction(() => document.querySelector('.wipe canvas').dataset.drawn);
const slide = async (percent) => {
  await page.locator('.slider').evaluate((slider, value) => {
    slider.value = value;
    slider.dispatchEvent(new Event('input'));
  }, percent);
  await page.waitForTimeout(200);
  return page.evaluate(() => {
    const canvas = document.querySelector('.wipe canvas'), { data, width, height } = test.pixels(canvas);
    // Left and right of the middle, apart from the pixels at the line.
    const half = (from, to) => {
      let hash = 2166136261;
      for (let y = 0; y < height; ++y) {
        for (let i = 4 * (y * width + from); i < 4 * (y * width + to); ++i) hash = Math.imul(hash ^ data[i], 16777619);
      }
      return hash >>> 0;
    };
    const middle = width >> 1;
    return [half(0, middle - 2), half(middle + 2, width)];
  });
};
const result = await slide(0), whole = await slide(100), both = await slide(50);
check('the slider shows the result, the example, and half of each', both[0] === whole[0] && both[1] === result[1]);
check('which are not the same', whole[0] !== result[0] && whole[1] !== result[1]);
await page.locator('.slider').focus();
await page.keyboard.press('ArrowRight');
check('the slider moves by keys', await page.locator('.slider').inputValue() === '51');
await page.screenshot();

// ---- gross agreement with the ray-traced picture

await choose('Scale', 'fit');
await settle(page);
const agreement = await page.evaluate(async () => {
  const canvas = document.querySelector('[data-card=blocks] canvas');
  const image = document.querySelector('[data-marks=blocks] img');
  await image.decode();
  const view = test.pixels(canvas), w = view.width, h = view.height;
  const compare = (mirrored) => {
    const other = document.createElement('canvas');
    other.width = w;
    other.height = h;
    const context = other.getContext('2d');
    if (mirrored) context.setTransform(-1, 0, 0, 1, w, 0);
    context.drawImage(image, 0, 0, w, h);
    const picture = context.getImageData(0, 0, w, h).data;
    const mean = [0, 0, 0, 0, 0, 0];
    let inside = 0, around = 0, outside = 0, xy = 0, xx = 0, yy = 0, sx = 0, sy = 0;
    for (let i = 0; i < picture.length; i += 4) {
      const light = (picture[i] + picture[i + 1] + picture[i + 2]) / 3;
      if (view.data[i + 3] < 250) {
        ++outside;
        if (light > 215) ++around;
        continue;
      }
      ++inside;
      const own = (view.data[i] + view.data[i + 1] + view.data[i + 2]) / 3;
      for (let c = 0; c < 3; ++c) {
        mean[c] += view.data[i + c];
        mean[3 + c] += picture[i + c];
      }
      sx += own, sy += light, xx += own * own, yy += light * light, xy += own * light;
    }
    const covariance = xy / inside - (sx / inside) * (sy / inside);
    const correlation = covariance / Math.sqrt((xx / inside - (sx / inside) ** 2) * (yy / inside - (sy / inside) ** 2));
    return { mean: mean.map((m) => m / inside), background: around / outside, correlation };
  };
  return { straight: compare(false), mirrored: compare(true) };
});
const { straight, mirrored } = agreement;
for (let c = 0; c < 3; ++c) {
  check('the view has the picture’s mean color', near(straight.mean[c], straight.mean[3 + c], 25), JSON.stringify(straight));
}
check('the view’s light is the picture’s, place by place', straight.correlation > 0.6, straight.correlation);
check('where the view shows nothing the picture shows its background, but for shadows', straight.background > 0.7, straight.background);
check('another picture does not agree', mirrored.correlation < straight.correlation - 0.15, JSON.stringify(agreement));

// ---- marks, plots, table

const marked = comparison.runs.find((run) => run.engine === 'blocks' && run.seed === 0).marks;
const seen = marked.filter((mark) => mark.at).length;
check('there are marks', seen > 0);
check('every mark that is seen is on the picture', await page.locator('[data-marks=blocks] svg [data-mark]').count() === seen);
for (const kind of ['seam', 'repeat', 'copy']) await page.locator(`[data-kind=${kind}]`).uncheck();
check('marks can be taken off', await page.locator('[data-marks=blocks] svg [data-mark]').count() === 0);
const plots = await page.locator('.plot').count();
check('every numeric figure has a plot', plots >= 20, plots);
check('a plot has a sign for every run', await page.locator('.plot[data-figure="likeness.lp_dense"] .dot').count() === 4);

const mean = (engine, group, key) => {
  const values = comparison.runs.filter((run) => run.engine === engine).map((run) => run.figures[group][key]);
  return values.reduce((a, b) => a + b, 0) / values.length;
};
const pasted = async () => {
  await page.locator('#copy').click();
  await page.waitForFunction(() => document.querySelector('.status').textContent !== '');
  await page.evaluate(() => {
    const area = document.createElement('textarea');
    area.id = 'pasted';
    document.body.append(area);
    area.focus();
  });
  await page.keyboard.press('Control+V');
  return page.evaluate(() => {
    const area = document.querySelector('#pasted'), text = area.value;
    area.remove();
    return text;
  });
};
const holdsFigures = (text) => {
  const rows = new Map(text.trim().split('\n').map((line) => [line.split('\t')[0], line.split('\t').slice(1)]));
  return ['blocks', 'geometry'].every((engine, n) =>
    near(parseFloat((rows.get('likeness.lp_dense') || [])[n]), mean(engine, 'likeness', 'lp_dense'), 6e-4));
};
const copied = await pasted();
check('the copied table holds the figures', holdsFigures(copied), copied.slice(0, 200));
check('another table does not', !holdsFigures(copied.replace(/(lp_dense\t)[^\t]+/, '$10.123')));
await page.evaluate(() => { navigator.clipboard.writeText = () => Promise.reject(new Error('no')); });
await page.evaluate(() => { document.querySelector('.status').textContent = ''; });
await choose('Rows', 'runs');
const every = await pasted();
const lines = every.trim().split('\n').map((line) => line.split('\t'));
check('without the clipboard’s permission every run is copied too', lines.length === 1 + comparison.runs.length, every.slice(0, 200));
check('a row has a value for each column', lines.every((line) => line.length === lines[0].length));
check('copied figures are not rounded', lines.slice(1).every((line, n) =>
  Number(line[lines[0].indexOf('likeness.coverage')]) === comparison.runs[n].figures.likeness.coverage));

// ---- light and dark, narrow and still

const colors = async (scheme) => {
  await page.emulateMedia({ colorScheme: scheme });
  await page.waitForTimeout(150);
  return page.evaluate(() => {
    const light = (c) => c.match(/[\d.]+/g).slice(0, 3).reduce((a, b) => a + Number(b), 0) / 3;
    const style = getComputedStyle(document.body);
    return { ground: light(style.backgroundColor), ink: light(style.color) };
  });
};
const dark = await colors('dark'), light = await colors('light');
check('dark is dark', dark.ground < 60 && dark.ink > 180, JSON.stringify(dark));
check('light is light', light.ground > 200 && light.ink < 80, JSON.stringify(light));
await page.emulateMedia({ reducedMotion: 'reduce' });
check('with reduced motion nothing turns by itself', !await page.locator('.turn').isVisible());
const before = await hashes(page);
await page.locator('[data-look=front]').click();
await settle(page);
check('and views change at once', (await hashes(page)).every((h, n) => h !== before[n]));
for (const width of [360, 414, 768]) {
  await page.setViewportSize({ width, height: 780 });
  await page.waitForTimeout(200);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  check(`${width} pixels wide there is nothing to scroll sideways`, wide <= width, wide);
}
await page.setViewportSize({ width: 360, height: 780 });
await page.locator('#views canvas').first().scrollIntoViewIfNeeded();
await page.waitForTimeout(400);
check('a view on a phone shows a surface', !isBlank(await page.evaluate(() => test.content(test.canvas(0)))));

// Everything can be reached by the Tab key.
await page.setViewportSize({ width: 1280, height: 900 });
await page.evaluate(() => { document.activeElement.blur(); getSelection().removeAllRanges(); scrollTo(0, 0); });
const reached = new Set();
for (let n = 0; n < 60; ++n) {
  await page.keyboard.press('Tab');
  reached.add(await page.evaluate(() => {
    const e = document.activeElement;
    return e.id || e.className || e.dataset.look || e.name || e.tagName;
  }));
}
for (const name of ['seed', 'choice-Color', 'iso', 'together', 'CANVAS', 'slider', 'copy']) {
  check(`Tab reaches ${name}`, reached.has(name), [...reached].join(' '));
}
check('nothing was asked of the network', requests.length === 0, requests);
check('the console has no error', errors.length === 0, errors.join('; '));
await context.close();

// ---- without WebGL

const plain = await open('made/report.html', { flags: ['--disable-3d-apis'] });
check('without WebGL the page shows pictures', await plain.page.evaluate(() => document.documentElement.dataset.ready) === 'pictures');
check('a picture for each', await plain.page.locator('#views .stage img').count() === 3);
check('that are there', await plain.page.evaluate(() => [...document.querySelectorAll('#views img')].every((i) => i.naturalWidth === 320)));
await plain.page.locator('.slider').evaluate((slider) => {
  slider.value = 25;
  slider.dispatchEvent(new Event('input'));
});
check('and a slider between them', /75%/.test(await plain.page.evaluate(() => document.querySelector('.wipe img').style.clipPath)));
check('without an error', plain.errors.filter((e) => !/WebGL/i.test(e)).length === 0, plain.errors.join('; '));
await plain.context.close();

// ---- one result, as synth and measure report it

run('synth', example, '-o', 'more.vdb', '--scale', '1.5,1,1', '--origins', 'origins.vdb', '--report', 'synth.html', '--method', 'blocks', ...small);
run('measure', example, 'more.vdb', '--report', 'measure.html', ...small);
for (const [path, views, hasMarks] of [['synth.html', 2, true], ['measure.html', 2, false]]) {
  const one = await open(path);
  await teach(one.page);
  await one.page.setViewportSize({ width: 1280, height: 2000 });
  await settle(one.page);
  const shown = await contents(one.page);
  check(`${path} has two views`, shown.length === views && !shown.some(isBlank), JSON.stringify(shown));
  check(`${path} has marks where there are origins`, (await one.page.locator('#marks img').count() > 0) === hasMarks);
  check(`${path} has a table`, /lp_dense/.test(await one.page.locator('.figures').innerText()));
  check(`${path} has no error and asks for nothing`, one.errors.length + one.requests.length === 0, one.errors.join('; '));
  await one.context.close();
}

console.log(`${checks - failures} of ${checks} checks passed`);
process.exit(failures ? 1 : 0);
