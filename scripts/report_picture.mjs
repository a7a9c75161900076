// A picture of a report, taken when its views are drawn: node report_picture.mjs REPORT.html OUT.png [#origins]
// Uses Debian's chromium and the playwright-core that the build fetched.

import { mkdtempSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [, , report, picture, hash = ''] = process.argv;
const root = join(dirname(fileURLToPath(import.meta.url)), '..');
const { chromium } = createRequire(join(root, 'build/release/web/x.js'))('playwright-core');
const profile = mkdtempSync(join(tmpdir(), 'exemplar-picture-'));
const context = await chromium.launchPersistentContext(profile, {
  executablePath: '/usr/bin/chromium', headless: true, viewport: { width: 1200, height: 1640 },
  args: ['--headless=new', '--no-sandbox', '--disable-gpu', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
});
const page = context.pages()[0] || await context.newPage();
await page.goto(`file://${encodeURI(resolve(report))}${hash}`);
await page.waitForFunction(() => [...document.querySelectorAll('#views canvas')].every((c) => c.dataset.drawn));
await page.waitForTimeout(300);
await page.screenshot({ path: picture });
await context.close();
rmSync(profile, { recursive: true, force: true });
