import { spawnSync } from 'node:child_process';
import { expect } from '@playwright/test';
import { recordingOf, transform } from '../mcap.js';
import { caption, choose, example, fold, openCalibrator, recordingWith, rows, settled, stats, tablesOf } from './calibrator-support.js';
import { heard, stateOf } from './element-support.js';
import { STILL, pixelsOf, test, unfold } from './support.js';

/** @typedef {import('./calibrator-support.js').AlphaCalibratorElement} AlphaCalibratorElement */

test.use(STILL);

test('two tables of the reader’s own take the place of the simulated log, and leave it again', async ({ page }) => {
  const widget = await openCalibrator(page);
  const tables = await tablesOf(widget);
  await choose(widget, { 'truth.csv': tables.reference, 'odom.csv': tables.odometry });
  await expect(caption(widget)).toHaveText(/^\d+ legs of odom\.csv, truth\.csv, with a reference taken to be exact\./);
  await settled(widget);
  expect(await widget.evaluate((element) => /** @type {AlphaCalibratorElement} */ (element).machine.truth)).toBeNull();
  await expect(fold(widget, 'Your log').locator('.present')).toHaveText('The log at present: odom.csv, truth.csv.');
  // Their names say which is which, whatever the reader does.
  const hint = widget.getByText('it is called as odometry is, and truth.csv is not: are the two the other way round?');
  await expect(hint).toHaveCount(0);
  await widget.getByRole('button', { name: 'The other way round' }).click();
  await expect(caption(widget)).toHaveText(/of truth\.csv, odom\.csv[.,]/);
  await expect(hint).toBeVisible();
  await widget.getByRole('button', { name: 'Back to the simulated log' }).click();
  await expect(caption(widget)).toHaveText(/of the simulated log/);
});

for (const [attributes, options, legs] of /** @type {[string, string, object][]} */ ([
  ['', '', { distance: 0.25, angle: 0.2 }],
  ['duration="0.8" positiondeviation="0.004" headingdeviation="0.003"', '--duration 0.8 --position-deviation 0.004 --heading-deviation 0.003', { duration: 0.8 }],
])) test(`of the same log it says the same as the command line, to the last bit: ${options}`, async ({ page }) => {
  const widget = await openCalibrator(page, `robust="false" seed="0" bylength ${attributes}`);
  await choose(widget, { 'odometry.csv': example('odometry'), 'reference.csv': example('reference') });
  // Whoever states what the reference errs by is not told that nobody has.
  await expect(caption(widget)).toHaveText(options ? /of odometry\.csv, reference\.csv\./ : /reference\.csv, with a reference taken to be exact\./);
  await settled(widget);
  const shown = await widget.evaluate((element) => {
    const { machine: { stats, legs } } = /** @type {AlphaCalibratorElement} */ (element);
    return JSON.stringify({ ...stats, legs }, (_, value) => (ArrayBuffer.isView(value) ? [.../** @type {Float64Array} */ (value)] : value));
  });
  const files = ['odometry', 'reference'].flatMap((name) => [`--${name}`, `examples/calibration/${name}.csv`]);
  const { stdout } = spawnSync(process.execPath, ['dist/cli.js', 'calibrate', ...files, ...options.split(' ').filter(Boolean), '--json'], { encoding: 'utf8', cwd: new URL('../..', import.meta.url), maxBuffer: 2 ** 28 });
  const { date, fit, deviations, logs, start, ...printed } = JSON.parse(stdout);
  expect([fit, start, logs.length, typeof date]).toEqual([{ legs, byLength: true }, 9, 2, 'string']);
  expect(deviations).toEqual(options === '' ? {} : { positionDeviation: 0.004, headingDeviation: 0.003 });
  expect(JSON.parse(shown)).toEqual(printed);
});

test('a recording has both, and where it is not clear which topic is which, the reader chooses', async ({ page }) => {
  const widget = await openCalibrator(page);
  await choose(widget, { 'odometry.csv': example('odometry'), 'reference.csv': example('reference') });
  await expect(caption(widget)).toHaveText(/of odometry\.csv, reference\.csv[.,]/);
  await settled(widget);
  const { alphas } = await stats(widget);
  for (const topics of [['/mocap/pose'], ['/mocap/pose', '/slam/pose']]) {
    const name = `run-${topics.length}.mcap`;
    const buffer = await recordingWith(topics);
    await widget.locator('#log-files').setInputFiles({ name, mimeType: 'application/octet-stream', buffer });
    if (topics.length > 1) {
      await expect(widget.getByRole('alert')).toHaveText(/^run-2\.mcap: which topic is the reference is not clear; expected is a choice of .*\/slam\/pose \(PoseStamped\)\.$/);
      await widget.getByLabel('Reference', { exact: true }).selectOption('/mocap/pose');
    }
    await expect(caption(widget)).toHaveText(new RegExp(`of ${name}[.,]`));
    await settled(widget);
    const read = await stats(widget);
    // Quaternions round the headings.
    alphas.forEach((alpha, i) => expect(Number(read.alphas[i]) / Number(alpha)).toBeCloseTo(1, 3));
  }
});

test('of files with poses and commands the velocity model takes the commands, as the command does, and the others the poses', async ({ page }) => {
  const widget = await openCalibrator(page, 'model="velocity"');
  const keys = () => widget.evaluate((element) => Object.keys(/** @type {AlphaCalibratorElement} */ (element).log?.odometry ?? {}));
  const model = async (/** @type {string} */ name, /** @type {string} */ key) => {
    await widget.getByRole('radio', { name }).check();
    await expect.poll(keys).toContain(key);
    await settled(widget);
  };
  // What is commanded in a row is driven until the next one.
  const [header, ...lines] = example('odometry').trim().split('\n');
  const driven = lines.map((line) => line.split(',').map(Number));
  const commands = driven.map(([t, x, y, yaw], i) => {
    const [next, toX, toY, to] = driven[i + 1] ?? [t + 1, x, y, yaw];
    return `${lines[i]},${Math.hypot(toX - x, toY - y) / (next - t)},${Math.atan2(Math.sin(to - yaw), Math.cos(to - yaw)) / (next - t)}`;
  });
  await choose(widget, { 'odom.csv': [`${header},v,omega`, ...commands].join('\n'), 'truth.csv': example('reference') });
  await expect.poll(keys).toContain('omega');
  await settled(widget);
  expect((await stats(widget)).alphas).toHaveLength(6);
  await model('Table 5.6', 'theta');
  await model('velocity', 'omega');
  // Where there is nothing else, all models have the same.
  await choose(widget, { 'odom.csv': example('odometry'), 'truth.csv': example('reference') });
  await expect.poll(keys).toContain('theta');
  await model('Table 5.6', 'theta');
  await model('velocity', 'theta');
  // Of a recording they are a topic of their own, unless the reader has chosen another.
  const buffer = await recordingWith(['/mocap/pose'], undefined, true);
  const topic = widget.getByLabel('Odometry', { exact: true });
  await widget.locator('#log-files').setInputFiles({ name: 'run.mcap', mimeType: 'application/octet-stream', buffer });
  await expect.poll(keys).toContain('omega');
  await expect(topic).toHaveValue('/cmd_vel');
  await model('Table 5.6', 'theta');
  await expect(topic).toHaveValue('/odom');
  await model('velocity', 'omega');
  await topic.selectOption('/odom');
  await expect.poll(keys).toContain('theta');
  await model('Table 5.6', 'theta');
  await model('velocity', 'theta');
  await expect(topic).toHaveValue('/odom');
});

test('of transforms the reader says which frames are meant', async ({ page }) => {
  const widget = await openCalibrator(page);
  const rows = (/** @type {'odometry' | 'reference'} */ name) => example(name).trim().split('\n').slice(1).map((line) => line.split(',').map(Number));
  const messages = (/** @type {'odometry' | 'reference'} */ name, /** @type {string} */ parent, /** @type {string} */ child) =>
    rows(name).map(([t, x, y, yaw]) => ({ topic: '/tf', type: 'tf2_msgs/msg/TFMessage', t, message: { transforms: [transform(t, parent, child, x, y, yaw)] } }));
  const all = [...messages('odometry', 'odom', 'base_footprint'), ...messages('reference', 'map', 'base_link')];
  const buffer = await recordingOf(all.sort((one, other) => one.t - other.t), { compression: 'zstd', chunkSize: 100_000 });
  await fold(widget, 'Your log').locator('summary').click();
  await widget.locator('#log-files').setInputFiles({ name: 'tf.mcap', mimeType: 'application/octet-stream', buffer });
  await widget.getByLabel('Odometry', { exact: true }).selectOption('/tf');
  await widget.getByLabel('Reference', { exact: true }).selectOption('/tf');
  await expect(widget.getByRole('alert')).toHaveText(/no transforms lead from odom to base_link; expected are frames that are connected, of .*base_footprint/);
  const frames = widget.getByLabel('Odometry: Frames');
  await frames.fill('odom, base_footprint');
  await frames.press('Enter');
  await expect(caption(widget)).toHaveText(/of tf\.mcap[.,]/);
});

test('files that are no log are refused in a sentence, and all stays as it was', async ({ page }) => {
  const widget = await openCalibrator(page);
  const before = await stateOf(widget);
  const alert = widget.getByRole('alert');
  await choose(widget, { 'odom.csv': 't,x,y,yaw\n0,0,0,0\n1,one,0,0\n', 'truth.csv': 't,x,y,yaw\n0,0,0,0\n' });
  await expect(alert).toHaveText(/^odom\.csv, line 3: x is “one”; expected is a number\.$/);
  await choose(widget, { 'a.csv': '1', 'b.csv': '1', 'c.csv': '1' });
  await expect(alert).toHaveText(/3 files given; expected are two tables/);
  await choose(widget, { 'alone.csv': 't,x,y,yaw\n0,0,0,0\n' });
  await expect(alert).toHaveText(/The log is refused: 1 file given; expected are two tables at once/);
  // A recording has both.
  const recording = await recordingWith(['/mocap/pose']);
  const table = Buffer.from(example('odometry'));
  await widget.locator('#log-files').setInputFiles([{ name: 'odom.csv', buffer: table, mimeType: 'text/csv' }, { name: 'run.mcap', buffer: recording, mimeType: 'application/octet-stream' }]);
  await expect(alert).toHaveText(/: 2 files given; expected are two tables at once, of odometry and of the reference, or one recording\.$/);
  // What is called a recording, or is one of something else.
  await choose(widget, { 'notes.mcap': 'no recording' });
  await expect(alert).toHaveText(/^notes\.mcap: the recording is damaged/);
  const buffer = await recordingOf([{ topic: '/rosout', type: 'rcl_interfaces/msg/Log', t: 1, message: {} }], {});
  await widget.locator('#log-files').setInputFiles({ name: 'words.mcap', mimeType: 'application/octet-stream', buffer });
  await expect(alert).toHaveText(/^words\.mcap: the topics are \/rosout \(Log\); expected is one of type nav_msgs\/msg\/Odometry/);
  expect(await stateOf(widget)).toEqual(before);
  await expect(caption(widget)).toHaveText(/of the simulated log/);
});

test('a log that says nothing does not take the place of one that does, nor its name', async ({ page }) => {
  const widget = await openCalibrator(page);
  await choose(widget, { 'odometry.csv': example('odometry'), 'reference.csv': example('reference') });
  await expect(caption(widget)).toHaveText(/of odometry\.csv, reference\.csv[.,]/);
  await settled(widget);
  const before = await caption(widget).innerText();
  const { alphas } = await stats(widget);
  const said = await page.evaluateHandle(() => {
    const said = /** @type {Set<string>} */ (new Set());
    const caption = /** @type {HTMLElement} */ (document.querySelector('alpha-calibrator')?.shadowRoot?.querySelector('p[part=caption]'));
    new MutationObserver(() => said.add(caption.innerText)).observe(caption, { subtree: true, childList: true, characterData: true });
    return said;
  });
  const still = 't,x,y,yaw\n0,0,0,0\n1,0,0,0\n2,0,0,0\n';
  await choose(widget, { 'a.csv': still, 'b.csv': still });
  await expect(widget.getByRole('alert')).toHaveText('The log is refused: Fewer than eight legs: too little motion, or no time in common.');
  // Of another drive, which has no time in common with this one.
  const elsewhere = Array.from({ length: 600 }, (_, i) => `${1e6 + i / 10},${0.05 * i},0,${Math.sin(i * i / 900)}`);
  await choose(widget, { 'odometry.csv': example('odometry'), 'elsewhere.csv': ['t,x,y,yaw', ...elsewhere].join('\n') });
  await expect(widget.getByRole('alert')).toHaveText(/^The log is refused: Fewer than eight legs/);
  await settled(widget);
  expect(await caption(widget).innerText()).toBe(before);
  expect((await stats(widget)).alphas).toEqual(alphas);
  await expect(widget.locator('.own-log .present')).toContainText('odometry.csv, reference.csv');
  await expect(widget.locator('.own-log')).not.toContainText('nothing in common:');
  // No caption has the figures of one log and the name of another.
  const half = (/** @type {'odometry' | 'reference'} */ name) => example(name).split('\n').slice(0, 2000).join('\n');
  await choose(widget, { 'half.csv': half('odometry'), 'reference.csv': half('reference') });
  await expect(caption(widget)).toHaveText(/of half\.csv, reference\.csv[.,]/);
  const { count } = await widget.evaluate((element) => /** @type {AlphaCalibratorElement} */ (element).machine.legs);
  const captions = (await said.evaluate((said) => [...said])).filter((text) => text.includes('half.csv'));
  expect(captions.length).toBeGreaterThan(0);
  for (const text of captions) expect(text).toMatch(new RegExp(`^${count} legs of half`));
});

test('who stops the reading of a log is told that all is as it was', async ({ page }) => {
  const widget = await openCalibrator(page);
  const before = await stateOf(widget);
  await fold(widget, 'Your log').locator('summary').click();
  // What is in a fold comes when it opens.
  await expect(widget.locator('#log-files')).toBeVisible();
  await widget.evaluate(async (element) => {
    const root = /** @type {ShadowRoot} */ (element.shadowRoot);
    const input = /** @type {HTMLInputElement} */ (root.querySelector('#log-files'));
    const table = ['t,x,y,yaw', ...Array.from({ length: 200_000 }, (_, row) => `${row / 20},0,0,0`)].join('\n');
    const { files, items } = new DataTransfer();
    for (const name of ['odom.csv', 'truth.csv']) items.add(new File([table], name));
    input.files = files;
    input.dispatchEvent(new Event('change'));
    const button = () => [...root.querySelectorAll('button')].find(({ textContent }) => textContent?.trim() === 'Stop');
    while (!button()) await new Promise(requestAnimationFrame);
    button()?.click();
  });
  await expect(widget.getByRole('alert')).toHaveText('Stopped: everything is as it was.');
  await expect(widget.locator('.own-log progress')).toHaveCount(0);
  expect(await stateOf(widget)).toEqual(before);
  await expect(caption(widget)).toHaveText(/of the simulated log/);
});

test('while a log is fitted, whoever asks for the picture does not go on with it: nothing keeps the page', async ({ page }) => {
  const widget = await openCalibrator(page);
  const [before, after] = await widget.evaluate((element) => {
    const figure = /** @type {AlphaCalibratorElement & { scene: unknown }} */ (element);
    // A drive of an hour, which takes many frames.
    const t = Float64Array.from({ length: 100_000 }, (_, row) => row / 25);
    const of = (/** @type {(t: number) => number} */ coordinate) => t.map(coordinate);
    const theta = of((time) => Math.sin(time / 3));
    const poses = { t, x: of((time) => 0.3 * time), y: of((time) => Math.cos(time)), theta };
    figure.log = { name: 'an hour', odometry: poses, reference: { ...poses, y: of((time) => Math.cos(time) + 0.01 * Math.sin(17 * time)) } };
    const before = figure.settings.next.progress;
    for (let asked = 0; asked < 5; asked++) void figure.scene;
    return [before, figure.settings.next?.progress];
  });
  expect(before).toBeLessThan(1);
  expect(after).toBe(before);
  await expect(caption(widget)).toHaveText(/of an hour[.,]/);
});

test('a page gives a log, which is in no state; one that is refused leaves the present one', async ({ page }) => {
  const widget = await openCalibrator(page);
  const before = await stateOf(widget);
  const opened = await caption(widget).innerText();
  const [name, count, refused] = await widget.evaluate(async (element) => {
    const figure = /** @type {AlphaCalibratorElement} */ (element);
    const { legs } = figure.machine;
    const t = Array.from({ length: legs.count }, (_, leg) => leg);
    const column = (/** @type {Float64Array} */ poses, /** @type {number} */ at) => t.map((leg) => poses[6 * leg + at]);
    const poses = (/** @type {Float64Array} */ all) => ({ t, x: column(all, 0), y: column(all, 1), theta: column(all, 2) });
    const given = { name: 'of the page', odometry: poses(legs.odometry), reference: poses(legs.reference) };
    figure.log = given;
    await new Promise((resolve) => figure.addEventListener('stats', resolve, { once: true }));
    let refused = '';
    figure.addEventListener('error', (event) => { refused = /** @type {ErrorEvent} */ (event).message; event.preventDefault(); }, { once: true });
    figure.log = { ...given, odometry: { ...given.odometry, t: t.with(3, 1) } };
    figure.addEventListener('error', (event) => { refused += `; ${/** @type {ErrorEvent} */ (event).message}`; event.preventDefault(); }, { once: true });
    Object.assign(figure, { log: 5 });
    return [figure.log?.name, figure.machine.count, refused];
  });
  expect(name).toBe('of the page');
  expect(Number(count)).toBeGreaterThan(100);
  expect(refused).toMatch(/^odometry: sample 3 is not later than the one before.*; log is 5; allowed is an object with keys from name, odometry, reference$/);
  expect(await stateOf(widget)).toEqual(before);
  expect(opened).not.toContain('exact');
  // Of what the log and the page state, the rest is taken to be exact.
  for (const [positionDeviation, headingDeviation, stated, said] of /** @type {[number, number, object, string][]} */ ([
    [0, 0, {}, 'page, with a reference taken to be exact.'],
    [0.004, 0, {}, 'page, with headings of the reference taken to be exact.'],
    [0, 0.003, {}, 'page, with positions of the reference taken to be exact.'],
    [0.004, 0.003, {}, 'page.'],
    [0, 0, { positionDeviation: 0.004 }, 'page, with headings of the reference taken to be exact.'],
    [0, 0.003, { positionDeviation: 0.004 }, 'page.'],
  ])) {
    await widget.evaluate((element, [deviations, stated]) => {
      const figure = /** @type {AlphaCalibratorElement} */ (element);
      const { log } = figure;
      if (log) figure.log = { ...log, reference: { ...log.reference, positionDeviation: undefined, ...stated } };
      Object.assign(figure, deviations);
    }, [{ positionDeviation, headingDeviation }, stated]);
    await expect(caption(widget)).toHaveText(new RegExp(`^\\d+ legs of of the ${said.replaceAll('.', '\\.')}`));
  }
});

test('of twenty thousand legs that are shorter than a pixel those are drawn that can be told apart', async ({ page }) => {
  const widget = await openCalibrator(page, 'distance="0.01"');
  const [legs, lines, characters] = await widget.evaluate(async (element) => {
    const figure = /** @type {AlphaCalibratorElement} */ (element);
    // Twenty times around a circle of ten metres, three centimetres a leg, with a wobble that the reference alone has.
    const count = 40_000;
    const of = (/** @type {(turned: number, i: number) => number} */ f) => Float64Array.from({ length: count }, (_, i) => f((40 * Math.PI * i) / count, i));
    const wobble = (/** @type {number} */ i) => 1e-3 * Math.sin(i * i);
    const [t, heading] = [of((_, i) => i / 50), of((turned) => turned + Math.PI / 2)];
    const odometry = { t, x: of((turned) => 10 * Math.cos(turned)), y: of((turned) => 10 * Math.sin(turned)), theta: heading };
    const settled = new Promise((resolve) => figure.addEventListener('stats', () => figure.log && resolve(undefined)));
    figure.log = { odometry, reference: { t, x: of((turned, i) => 10 * Math.cos(turned) + wobble(i)), y: of((turned, i) => 10 * Math.sin(turned) + wobble(i + 1)), theta: heading } };
    await settled;
    const svg = /** @type {any} */ (figure).toSVG();
    const { legs } = figure.machine;
    return [legs.count, svg.match(/[ML]/g)?.length ?? 0, svg.length];
  });
  expect(legs).toBeGreaterThan(15_000);
  // Some two thousand pixels of way, in each of four classes at most, and what the odometry has of it; two ends a line.
  expect(lines).toBeLessThan(legs);
  expect(lines).toBeGreaterThan(2000);
  expect(characters).toBeLessThan(400_000);
  // Numbers of five digits leave the button beside them its room, in German too.
  await widget.evaluate((element) => element.setAttribute('lang', 'de'));
  await expect(widget.getByRole('button', { name: 'Nächste schlechte' })).toBeVisible();
  for (let width = 340; width <= 1400; width += 60) {
    await page.setViewportSize({ width, height: 900 });
    const overlap = await widget.evaluate((element) => {
      const box = (/** @type {string} */ selector) => /** @type {Element} */ (/** @type {ShadowRoot} */ (element.shadowRoot).querySelector(selector)).getBoundingClientRect();
      const [value, button] = [box('fieldset.leg .printed'), box('.looked button')];
      return Math.min(value.right - button.left, button.right - value.left, value.bottom - button.top, button.bottom - value.top);
    });
    expect(overlap, `${width} pixels`).toBeLessThanOrEqual(0);
  }
});

for (const [what, driven] of /** @type {[string, (at: number) => number[]][]} */ ([
  ['never turns', (at) => [at, 0, 0]],
  // A reference in no need of a calibration, but for its clock: the noise of its turns is 10³⁰ times as large as that of its way.
  ['is exact to rounding', (at) => [Math.sin(at), 1 - Math.cos(at), at]],
])) test(`of a log that ${what} every figure has room, and no picture a number that is none`, async ({ page }) => {
  const messages = /** @type {string[]} */ ([]);
  page.on('console', (message) => messages.push(message.text()));
  const widget = await openCalibrator(page, 'robust="false"');
  const [t, all] = [Array.from({ length: 4000 }, (_, i) => i / 20), (/** @type {number} */ late) => Array.from({ length: 4000 }, (_, i) => driven((i / 20 - late) * (0.3 + 0.1 * Math.sin(i / 300))))];
  const poses = (/** @type {number} */ late) => ({ t, ...Object.fromEntries(['x', 'y', 'theta'].map((name, k) => [name, all(late).map((pose) => pose[k])])) });
  await widget.evaluate((element, log) => Object.assign(element, { log }), { name: what, odometry: poses(0), reference: poses(0.123) });
  await expect(caption(widget)).toContainText(`legs of ${what}`);
  for (const name of ['Why these', 'Doubts', 'Inflate']) await fold(widget, name).locator('summary').click();
  await settled(widget);
  const texts = await widget.locator('svg.plot text, td').allTextContents();
  expect(texts.length).toBeGreaterThan(30);
  expect(texts.filter((text) => /\d{8}/.test(text))).toEqual([]);
  expect(messages).toEqual([]);
});

test('a log without legs says so, and trouble with it is no failure', async ({ page }) => {
  const widget = await openCalibrator(page);
  await widget.evaluate((element) => {
    const still = { t: [0, 1, 2, 3], x: [0, 0, 0, 0], y: [0, 0, 0, 0], theta: [0, 0, 0, 0] };
    /** @type {AlphaCalibratorElement} */ (element).log = { odometry: still, reference: still };
  });
  await settled(widget);
  await unfold(widget);
  await expect(caption(widget)).toHaveText(/^Fewer than eight legs:/);
  await expect(rows(widget).first()).toHaveText(/—/);
  await expect(widget.locator('canvas.plane')).toHaveAttribute('aria-label', /none is looked at\.$/);
  await expect(widget.locator('canvas.leg')).toHaveAttribute('aria-label', 'There is no leg to look at.');
  await expect(widget.locator('.slider.off:has(#leg)')).toBeVisible();
  await expect(widget.getByRole('button', { name: 'Next worst leg' })).toBeDisabled();
  expect(await heard(page, ['error'])).toEqual([]);
});

test('where legs lie upon each other many times, the unusual ones do not hide the others', async ({ page }) => {
  const widget = await openCalibrator(page);
  const share = await widget.evaluate(async (element) => {
    const calibrator = /** @type {any} */ (element);
    // A robot that drives around in a hall; one leg in sixteen is far off.
    const count = 60_000;
    const made = () => Object.fromEntries(['t', 'x', 'y', 'theta'].map((key) => [key, new Float64Array(count + 1)]));
    const log = { odometry: made(), reference: made() };
    let seed = 1;
    const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647 - 0.5;
    for (let i = 1; i <= count; i++) {
      const turn = i % 20 === 0 ? Math.PI / 2 + 0.3 * Math.sin(i) : 0.02 * Math.sin(i);
      const off = i % 16 === 0 ? 0.3 : 0.03;
      const [turned, gone] = [off * random(), 0.3 + off * random()];
      for (const [poses, error, way] of /** @type {const} */ ([[log.odometry, 0, 0.3], [log.reference, turned, gone]])) {
        const { t, x, y, theta } = poses;
        t[i] = i / 2;
        theta[i] = theta[i - 1] + turn + error;
        x[i] = x[i - 1] + way * Math.cos(theta[i]);
        y[i] = y[i - 1] + way * Math.sin(theta[i]);
      }
    }
    calibrator.log = log;
    while (calibrator.pictures[0].unfinished || calibrator.machine.count < 30_000 || calibrator.settings.stale) await new Promise(requestAnimationFrame);
    const { classes, legs } = calibrator.reading;
    return classes.filter((/** @type {number} */ each) => each === 3).length / legs.count;
  });
  const canvas = widget.locator('canvas').first();
  const covered = await canvas.evaluate((element) => {
    const { width, height } = /** @type {HTMLCanvasElement} */ (element);
    const copy = /** @type {any} */ (new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true }));
    copy.drawImage(element, 0, 0);
    return copy.getImageData(0, 0, width, height).data.filter((/** @type {number} */ value, /** @type {number} */ i) => i % 4 === 3 && value > 0).length;
  });
  expect(share).toBeGreaterThan(0.05);
  // As lines of four and a half pixels they had two thirds of what is drawn.
  expect((await pixelsOf(canvas, 'accent')) / covered).toBeLessThan(2 * share);
  // So many legs know systematic errors better than to a thousandth, and each is told by how much.
  const halves = await widget.locator('table.systematic td.between > div').allTextContents();
  expect(halves.filter((half) => /^± 0\.\d*[1-9]/.test(half))).toEqual(halves);
  expect(halves.filter((half) => half.length > '± 0.000'.length)).not.toEqual([]);
});

test('without a log of the page’s own there is the simulated one again', async ({ page }) => {
  const widget = await openCalibrator(page);
  const count = () => widget.evaluate((element) => /** @type {AlphaCalibratorElement} */ (element).machine.count);
  const simulated = await count();
  for (const none of [null, undefined]) {
    await widget.evaluate((element) => {
      const { legs } = /** @type {AlphaCalibratorElement} */ (element).machine;
      const of = (/** @type {Float64Array} */ poses, /** @type {number} */ at) => Float64Array.from({ length: 200 }, (_, leg) => poses[6 * leg + at]);
      const log = (/** @type {Float64Array} */ poses) => ({ t: Float64Array.from({ length: 200 }, (_, i) => i), x: of(poses, 0), y: of(poses, 1), theta: of(poses, 2) });
      /** @type {AlphaCalibratorElement} */ (element).log = { odometry: log(legs.odometry), reference: log(legs.reference) };
    });
    await expect.poll(count).toBeLessThan(simulated);
    await widget.evaluate((element, given) => void Object.assign(element, { log: given }), none);
    await expect.poll(count).toBe(simulated);
    expect(await widget.evaluate((element) => /** @type {AlphaCalibratorElement} */ (element).log)).toBe(null);
  }
});
