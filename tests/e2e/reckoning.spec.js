import { expect } from '@playwright/test';
import { expectAccessible } from './axe.js';
import { show } from './element-support.js';
import { STILL, detail, dragSlider, frames, pictureOf, pixelsOf, readout, test, unfold } from './support.js';

/**
 * @typedef {import('@playwright/test').Page} Page
 * @typedef {import('@playwright/test').Locator} Locator
 * @typedef {import('../../www/types.d.ts').DeadReckoning} DeadReckoning
 * @typedef {HTMLElement & { machine: DeadReckoning }} DeadReckoningElement
 */

test.use(STILL);

/**
 * The element on a page of its own, with all of its robots driven.
 *
 * @param {Page} page
 * @param {string} [attributes]
 */
async function openReckoning(page, attributes = '') {
  await show(page, `<main><h1>Bare</h1><dead-reckoning heading-level="2" ${attributes}></dead-reckoning></main>`);
  const widget = page.locator('dead-reckoning');
  await expect(widget.locator('.folds')).toBeVisible();
  await settled(widget);
  return widget;
}

/** Waits until all robots are driven and shown. @param {Locator} widget */
async function settled(widget) {
  await expect.poll(() => widget.evaluate((element) => {
    const { machine, settings } = /** @type {any} */ (element);
    return !settings.stale && machine.shown === machine.config.samples && machine.stats.n === machine.shown;
  })).toBe(true);
  await frames(widget.page());
}

/** @param {Locator} widget */
const config = (widget) => widget.evaluate((element) => /** @type {DeadReckoningElement} */ (element).machine.config);
const caption = (/** @type {Locator} */ widget) => widget.locator('p[part=caption] > span');
const plotOf = (/** @type {Locator} */ widget) => widget.locator('.ratios svg.plot');

/** What the three readouts say of the components. @param {Locator} widget */
const missed = (widget) => Promise.all(['along', 'lateral', 'heading'].map((name) => readout(widget, new RegExp(`^\\s*${name}`)).textContent()));

test('opens with the lateral miss that the chapter’s 6 % hides', async ({ page }) => {
  const widget = await openReckoning(page);
  expect(await config(widget)).toMatchObject({
    command: { v: 1, omega: 0.5, dt: 0.2 }, steps: 20, step: 2, alphas: [0.02, 0.02, 0.02, 0.02, 0.005, 0.005], compounding: 'chapter', samples: 50_000,
  });
  await expect(caption(widget)).toHaveText(
    'The −6.1\u202f% along the track at the end hides a worse miss: of the lateral variance it predicts 0.00 at step 1, 0.44 at step 2, 0.77 at step 5.',
  );
  expect(await missed(widget)).toEqual(['steps 15–20', 'steps 1–15', 'never']);
  await expect(detail(widget, /^\s*along/)).toHaveText('−6.1 ± 0.6\u202f%');
  await expect(plotOf(widget)).toHaveAttribute('aria-label', /At step 2: along 1.009 ± 0.006, lateral 0.445 ± 0.003, heading/);
  for (const [canvas, role] of [['plane', 'prior'], ['plane', 'posterior'], ['twist', 'posterior'], ['twist', 'truth']]) {
    expect(await pixelsOf(widget.locator(`canvas.${canvas}`), role), `${role} in ${canvas}`).toBeGreaterThan(20);
  }
});

test('a slider walks along the path, from the keyboard too, and drives nobody', async ({ page }) => {
  const widget = await openReckoning(page);
  const slider = widget.locator('#step');
  const before = await widget.evaluate((element) => /** @type {DeadReckoningElement} */ (element).machine.measured);
  const pictures = () => Promise.all(['plane', 'twist'].map((name) => pictureOf(widget.locator(`canvas.${name}`))));
  const [plane, twist] = await pictures();
  await slider.press('End');
  await frames(page);
  expect((await config(widget)).step).toBe(20);
  const [planeAtEnd, twistAtEnd] = await pictures();
  expect(planeAtEnd).not.toBe(plane);
  expect(twistAtEnd).not.toBe(twist);
  expect(await widget.evaluate((element) => /** @type {DeadReckoningElement} */ (element).machine.measured)).toEqual(before);
  await slider.press('Home');
  await frames(page);
  await expect(widget.locator('canvas.twist')).toHaveAttribute('aria-label', /measured 0.0316 m and 0.0035 m, predicted 0.0316 m and 0.0000 m/);
  await expect(plotOf(widget)).toContainText('step 1');
  await dragSlider(slider, 0.5);
  await frames(page);
  expect((await config(widget)).step).toBe(11);
});

test('a step beyond the last is refused where it is typed', async ({ page }) => {
  const widget = await openReckoning(page, 'samples="1000"');
  const field = widget.locator('.walk .typed');
  for (const [typed, said] of [['25', 'k is 25; allowed is a whole number from 1 to 20.'], ['0', 'k is 0; allowed is a whole number from 1 to 20.']]) {
    await field.fill(typed);
    await field.press('Enter');
    await expect(widget.locator('.walk').getByRole('alert')).toHaveText(said);
    await expect(widget.locator('.walk').getByRole('alert')).toBeVisible();
    await expect(field).toHaveValue('2');
    await expect(widget.locator('#step')).toHaveValue('2');
  }
  await field.fill('20');
  await field.press('Enter');
  await frames(page);
  expect((await config(widget)).step).toBe(20);
});

/** Has the page keep what is written on a canvas, and where its left end is. @param {Page} page @param {string} name */
function keepLettering(page, name) {
  return page.addInitScript((ofName) => {
    /** @type {{ text: string, left: number }[]} */
    const told = [];
    const { fillText } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
      const { actualBoundingBoxLeft } = this.measureText(text);
      if (/** @type {HTMLElement} */ (this.canvas).className === ofName) told.push({ text, left: x - actualBoundingBoxLeft });
      fillText.call(this, text, x, y);
    };
    Object.assign(window, { told });
  }, name);
}

/** @param {Page} page @returns {Promise<{ text: string, left: number }[]>} */
const lettering = (page) => page.evaluate(() => /** @type {any} */ (window).told);

test('ticks of a tiny step stand on the picture', async ({ page }) => {
  await keepLettering(page, 'twist');
  await openReckoning(page, 'preset="fine" step="1" samples="1000"');
  const told = await lettering(page);
  expect(told.map(({ text }) => text)).toContain('ξ lateral (10⁻⁵ m)');
  for (const { text, left } of told) expect(left, text).toBeGreaterThanOrEqual(0);
});

for (const [lang, names] of /** @type {[string, string[]][]} */ ([
  ['en', ['Gaussian in (x, y)', 'in ξ', 'command']],
  ['de', ['Gauß in (x, y)', 'in ξ', 'Befehl']],
])) {
  test(`the key of the floor names all that is drawn in the column of a book, in ${lang}`, async ({ page }) => {
    await page.setViewportSize({ width: 680, height: 900 });
    await keepLettering(page, 'plane');
    await openReckoning(page, `samples="1000" lang="${lang}"`);
    await page.addScriptTag({ type: 'module', url: '/de.js' });
    await expect.poll(async () => (await lettering(page)).map(({ text }) => text)).toEqual(expect.arrayContaining(names));
  });
}

test('the slider of the step says how much of the path is driven', async ({ page }) => {
  const widget = await openReckoning(page, 'samples="1000"');
  const help = widget.locator('.walk .effect');
  await expect(help).toBeHidden();
  await widget.locator('#step').press('End');
  await expect(help).toBeVisible();
  await expect(help).toHaveText('Walks along the path: 4.00 of 4.00 s are driven.');
  await widget.locator('#step').press('ArrowLeft');
  await expect(help).toHaveText('Walks along the path: 3.80 of 4.00 s are driven.');
});

test('with J_r, and to fourth order, every component is right', async ({ page }) => {
  const widget = await openReckoning(page);
  for (const name of ['with Jᵣ', 'fourth order']) {
    await widget.getByRole('radio', { name }).check();
    await frames(page);
    expect(await missed(widget)).toEqual(['never', 'never', 'never']);
    await expect(caption(widget)).toHaveText('Within 5 % of what 50\u202f000 robots do, in every component at every step.');
  }
  expect((await config(widget)).compounding).toBe('fourth-order');
  await unfold(widget);
  const cells = await widget.locator('table tbody tr').first().locator('td').allTextContents();
  expect(cells).toEqual(['steps 15–20', 'never', 'never']);
});

test('presets are paths, and tell which one it is', async ({ page }) => {
  const widget = await openReckoning(page);
  const button = (/** @type {string} */ name) => widget.getByRole('button', { name });
  await expect(button('The chapter’s 20 steps')).toHaveAttribute('aria-pressed', 'true');
  await expect(button('Heading noise doubled')).toHaveAttribute('title', /deviation is doubled: .* fourfold/);
  await button('Heading noise doubled').click();
  await settled(widget);
  expect((await config(widget)).alphas).toEqual([0.02, 0.02, 0.08, 0.08, 0.02, 0.02]);
  expect((await missed(widget))[0]).toBe('steps 9–20');
  await expect(widget).toHaveAttribute('preset', 'doubled');
  await button('Same path, 200 steps').click();
  await settled(widget);
  expect(await config(widget)).toMatchObject({ steps: 200, command: { dt: 0.02 } });
  expect((await missed(widget))[0]).toBe('never');
  await widget.locator('#headingNoise').press('ArrowRight');
  await settled(widget);
  expect((await config(widget)).alphas).toEqual([0.02, 0.02, 0.025, 0.025, 0.00625, 0.00625]);
  await expect(widget).not.toHaveAttribute('preset');
});

test('more steps are shorter ones of the same path, seen from the same place', async ({ page }) => {
  const widget = await openReckoning(page, 'step="10" samples="1000"');
  const end = (/** @type {Locator} */ of) => of.evaluate((element) => [.../** @type {DeadReckoningElement} */ (element).machine.commanded.slice(-2)]);
  const [x, y] = await end(widget);
  await dragSlider(widget.locator('#steps'), 0.5);
  await settled(widget);
  const { steps, step, command } = await config(widget);
  expect(steps).toBeGreaterThan(80);
  expect(Math.abs(steps * command.dt - 4)).toBeLessThan(1e-12);
  expect(Math.abs(step / steps - 0.5)).toBeLessThan(0.02);
  const [atX, atY] = await end(widget);
  expect(Math.hypot(atX - x, atY - y)).toBeLessThan(1e-12);
  // To a single step and back.
  await widget.locator('#steps').press('Home');
  await settled(widget);
  expect(await config(widget)).toMatchObject({ steps: 1, step: 1 });
});

test('too few robots tell nothing, and none at all say so', async ({ page }) => {
  const widget = await openReckoning(page, 'samples="1000"');
  await expect(caption(widget)).toHaveText('Too few robots to tell 5 %: the bands are wider than that.');
  expect(await missed(widget)).toEqual(['too few', 'too few', 'too few']);
  await widget.getByRole('button', { name: 'Reset' }).click();
  await frames(page);
  await expect(caption(widget)).toHaveText('No robots yet.');
  expect(await missed(widget)).toEqual(['—', '—', '—']);
  await widget.getByRole('button', { name: 'Step', exact: true }).click();
  await frames(page);
  expect(await widget.evaluate((element) => /** @type {DeadReckoningElement} */ (element).machine.shown)).toBe(7);
});

test('a single robot on a single step is one', async ({ page }) => {
  const widget = await openReckoning(page, 'samples="1" steps="1" step="1"');
  await expect(caption(widget)).toHaveText(/^Too few robots/);
  await expect(widget.locator('canvas.plane')).toHaveAttribute('aria-label', / 1 robot drives 1 step of /);
});

test('no noise has no ratio, and a fourth order without a covariance neither', async ({ page }) => {
  const widget = await openReckoning(page, 'samples="500" alpha1="0" alpha2="0" alpha3="0" alpha4="0" alpha5="0" alpha6="0"');
  await expect(caption(widget)).toHaveText(/^No noise:/);
  await expect(plotOf(widget)).toHaveAttribute('aria-label', /along —/);
  const wild = await widget.evaluate((element) => {
    Object.assign(element, { headingNoise: 60, compounding: 'fourth-order', step: 20 });
    return /** @type {DeadReckoningElement} */ (element).machine.stats.predicted['fourth-order'];
  });
  expect(wild).toBeNull();
  await settled(widget);
  await expect(caption(widget)).toHaveText(/has left no covariance/);
});

test('a heading without noise takes nothing from the other components', async ({ page }) => {
  const widget = await openReckoning(page, 'headingNoise="0"');
  await expect(caption(widget)).toHaveText(/lateral variance it predicts/);
  expect(await missed(widget)).toContain('—');
  for (const name of ['with Jᵣ', 'fourth order']) {
    await widget.getByRole('radio', { name }).check();
    await frames(page);
    await expect(caption(widget)).toHaveText(/^Within 5 %/);
  }
});

test('a robot that is pointed at shows its way', async ({ page }) => {
  const widget = await openReckoning(page, 'step="20"');
  await unfold(widget);
  const canvas = widget.locator('canvas.plane');
  const before = await pixelsOf(canvas, 'accent');
  await widget.getByRole('spinbutton', { name: 'Robot' }).fill('40000');
  await frames(page);
  expect(await pixelsOf(canvas, 'accent')).toBeGreaterThan(before + 100);
  const end = await widget.evaluate((element) => [.../** @type {DeadReckoningElement} */ (element).machine.rollout(39_999)].slice(-3));
  await expect(widget.locator('.marked output')).toContainText(`x ${end[0].toFixed(3)} m`);
});

for (const [width, height] of [[1280, 720], [1920, 1080]]) {
  test(`before an audience says what it finds, clear of the buttons, ${width} × ${height} px`, async ({ page }) => {
    await page.setViewportSize({ width, height });
    const widget = page.locator('dead-reckoning');
    await show(page, '<dead-reckoning presentation></dead-reckoning>');
    await settled(widget);
    await expect(caption(widget)).toBeInViewport({ ratio: 0.99 });
    await expect(widget.locator('.readouts')).toBeInViewport({ ratio: 0.99 });
    await expect(widget.locator('#step')).toBeHidden();
    const bottom = (/** @type {Locator} */ of) => of.evaluate((each) => each.getBoundingClientRect().bottom);
    for (const controls of [false, true]) {
      if (controls) await page.keyboard.press('c');
      await frames(page);
      const top = await plotOf(widget).evaluate((each) => each.getBoundingClientRect().top);
      expect(top).toBeGreaterThanOrEqual(await bottom(widget.locator('.presenting button').first()));
      expect(await widget.locator('.surface').evaluate((each) => each.scrollHeight - each.clientHeight)).toBeLessThanOrEqual(0);
    }
  });
}

test('a symbol that is pointed at says its name', async ({ page }) => {
  const widget = await openReckoning(page, 'samples="1000"');
  for (const [key, name] of [['step', 'k, step that is looked at'], ['headingNoise', 'h, heading noise'], ['steps', 'n, steps of the same path'], ['samples', 'N, robots']]) {
    await expect(widget.locator(`label[for=${key}]`)).toHaveAttribute('title', name);
  }
});

test('takes along a row a step', async ({ page }) => {
  const widget = await openReckoning(page);
  const { text, measured, predicted } = await widget.evaluate((element) => {
    const { machine } = /** @type {DeadReckoningElement} */ (element);
    return { text: /** @type {any} */ (element).toCSV(), measured: [...machine.measured], predicted: [...machine.predicted['first-order']] };
  });
  const lines = text.trimEnd().split('\n');
  const [, columns, ...rows] = lines;
  const names = columns.split(',');
  expect(rows).toHaveLength(20);
  const value = (/** @type {number} */ row, /** @type {string} */ name) => Number(rows[row].split(',')[names.indexOf(name)]);
  expect(value(0, 'step')).toBe(1);
  expect(value(4, 'measured_lateral_m2')).toBe(measured[13]);
  expect(value(19, 'first_order_heading_rad2')).toBe(predicted[59]);
  expect(value(0, 'chapter_lateral_m2')).toBe(0);
});

test('variances of a straight drive cross where the formula says', async ({ page }) => {
  const widget = await openReckoning(page);
  await unfold(widget);
  const plot = widget.locator('figure svg.plot');
  await expect(plot).toHaveAttribute('aria-label', /Equal to first order after 2.00 s\.$/);
  await widget.evaluate((element) => Object.assign(element, { headingNoise: 0.08 }));
  await settled(widget);
  await expect(plot).toHaveAttribute('aria-label', /after 1.00 s\.$/);
  await widget.evaluate((element) => Object.assign(element, { headingNoise: 0 }));
  await settled(widget);
  await expect(plot).toHaveAttribute('aria-label', /never cross\.$/);
});

test('what takes long shows how far it is, and can be stopped', async ({ page }) => {
  const widget = await openReckoning(page);
  const before = await config(widget);
  await widget.evaluate((element) => Object.assign(element, { samples: 1_000_000 }));
  await expect(widget.locator('[part=progress]')).toBeVisible();
  await page.keyboard.press('Escape');
  await expect(widget.locator('[part=progress]')).toHaveCount(0);
  expect(await config(widget)).toEqual(before);
  expect(await missed(widget)).toEqual(['steps 15–20', 'steps 1–15', 'never']);
});

test('speaks German', async ({ page }) => {
  await page.addInitScript(() => document.addEventListener('DOMContentLoaded', () => void (document.documentElement.lang = 'de')));
  await show(page, '<dead-reckoning></dead-reckoning>', {
    script: '<script type="module" src="/motion-widgets.js"></script><script type="module" src="/de.js"></script>',
  });
  const widget = page.locator('dead-reckoning');
  await expect(caption(widget)).toContainText('0,44 in Schritt 2');
  await expect(widget.getByRole('radio', { name: '4. Ordnung' })).toBeVisible();
});

for (const width of [320, 375, 700, 1280]) {
  test(`is accessible and no wider than its page, ${width} px`, async ({ page }) => {
    await page.setViewportSize({ width, height: 900 });
    const widget = await openReckoning(page);
    await unfold(widget);
    await expectAccessible(page);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
  });
}

test('a noise parameter and a level of noise that are set in one frame are both taken, in turn', async ({ page }) => {
  const widget = await openReckoning(page, 'samples="100"');
  await unfold(widget);
  await widget.evaluate((element) => {
    for (const [id, value] of [['alpha1', '0.03'], ['headingNoise', '0.08'], ['alpha2', '0.04']]) {
      const slider = /** @type {HTMLInputElement} */ (/** @type {ShadowRoot} */ (element.shadowRoot).getElementById(id));
      slider.value = value;
      slider.dispatchEvent(new InputEvent('input', { bubbles: true }));
    }
  });
  await expect.poll(async () => (await config(widget)).alphas).toEqual([0.03, 0.04, 0.08, 0.08, 0.02, 0.02]);
});
