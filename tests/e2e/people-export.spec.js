import { readFileSync } from 'node:fs';
import { expect } from '@playwright/test';
import { presets } from '../../www/settings.js';
import { ALL, assign, ready, show } from './element-support.js';
import { openSqueeze, squeezed } from './squeeze-support.js';
import { STILL, boxOf, frames, numberIn, open, openWhole, readout, state, test } from './support.js';

/**
 * @typedef {import('@playwright/test').Locator} Locator
 * @typedef {import('../../www/types.d.ts').BananaMachineElement} Figure either element, as far as it can be exported
 */

test.use(STILL);

/** @param {string} text as `toCSV` writes it */
function parsed(text) {
  const [comment, header, ...lines] = text.trimEnd().split('\n');
  expect(comment.startsWith('# ')).toBe(true);
  return { settings: JSON.parse(comment.slice(2)), columns: header.split(','), rows: lines.map((line) => line.split(',').map(Number)) };
}

const mean = (/** @type {number[]} */ values) => values.reduce((sum, value) => sum + value, 0) / values.length;

/**
 * Third standardized moment across the circular mean of the headings.
 *
 * @param {number[][]} poses
 */
function crossTrackSkew(poses) {
  const heading = Math.atan2(mean(poses.map(([, , theta]) => Math.sin(theta))), mean(poses.map(([, , theta]) => Math.cos(theta))));
  const across = poses.map(([x, y]) => y * Math.cos(heading) - x * Math.sin(heading));
  const centre = mean(across);
  const moment = (/** @type {number} */ power) => mean(across.map((value) => (value - centre) ** power));
  return moment(3) / moment(2) ** 1.5;
}

const csvOf = (/** @type {Locator} */ widget) => widget.evaluate((element) => /** @type {Figure} */ (element).toCSV());
const svgOf = (/** @type {Locator} */ widget) => widget.evaluate((element) => /** @type {Figure} */ (element).toSVG());

/**
 * What an SVG file looks like on its own, by the numbers of its elements.
 *
 * @param {import('@playwright/test').Page} page
 * @param {string} svg
 */
function elementsOf(page, svg) {
  return page.evaluate((text) => {
    const parsed = new DOMParser().parseFromString(text, 'image/svg+xml');
    if (parsed.querySelector('parsererror')) throw new Error(parsed.documentElement.textContent ?? '');
    const count = (/** @type {string} */ selector) => parsed.querySelectorAll(selector).length;
    return {
      title: parsed.querySelector('title')?.textContent,
      description: parsed.querySelector('desc')?.textContent,
      paths: count('path'),
      texts: count('text'),
      images: count('image'),
      dashed: count('[stroke-dasharray]'),
      size: [parsed.documentElement.getAttribute('width'), parsed.documentElement.getAttribute('height')].map(Number),
    };
  }, svg);
}

/**
 * The size of a PNG image, and whether it is opaque everywhere.
 *
 * @param {Locator} widget
 */
function pngOf(widget) {
  return widget.evaluate(async (element) => {
    const blob = await /** @type {Figure} */ (element).toPNG();
    const image = await createImageBitmap(blob);
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = /** @type {OffscreenCanvasRenderingContext2D} */ (canvas.getContext('2d'));
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    const colours = new Set();
    let opaque = true;
    for (let i = 0; i < data.length; i += 4) {
      colours.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
      opaque &&= data[i + 3] === 255;
    }
    return { type: blob.type, width: image.width, height: image.height, opaque, colours: colours.size };
  });
}

test('the samples as CSV bring back the skew on screen, and their settings the same samples', async ({ page }) => {
  const widget = await open(page);
  await widget.getByRole('button', { name: 'Hard arc' }).click();
  const { config, shown, stats, poses } = await state(widget);
  const { settings, columns, rows } = parsed(await csvOf(widget));
  expect(columns).toEqual([
    ...['x_m', 'y_m', 'theta_rad', 'xi_along_m', 'xi_lateral_m', 'xi_heading_rad'],
    ...['v_hat_m_per_s', 'omega_hat_rad_per_s', 'gamma_hat_rad_per_s'],
  ]);
  expect(rows).toHaveLength(shown);
  // Every digit comes back.
  expect(rows.flatMap((row) => row.slice(0, 3))).toEqual(poses);
  const { dt } = config.command;
  for (const [x, y, theta, along, lateral, heading, vHat, omegaHat, gammaHat] of rows.slice(0, 100)) {
    // Exponential coordinates: the chord is turned and stretched, the heading is the turn.
    const [cotangent, half] = [(heading / 2) / Math.tan(heading / 2), heading / 2];
    expect(along).toBeCloseTo(cotangent * x + half * y, 9);
    expect(lateral).toBeCloseTo(cotangent * y - half * x, 9);
    expect(Math.cos(heading - theta)).toBeCloseTo(1, 9);
    const turn = omegaHat * dt;
    expect((vHat * dt * Math.sin(turn)) / turn).toBeCloseTo(x, 9);
    expect((vHat * dt * (1 - Math.cos(turn))) / turn).toBeCloseTo(y, 9);
    expect(Math.cos(turn + gammaHat * dt - theta)).toBeCloseTo(1, 9);
  }
  const skew = crossTrackSkew(rows);
  expect(Math.abs(skew - stats.crossTrackSkew)).toBeLessThan(1e-9);
  const printed = ((await readout(widget, 'cross-track skew').textContent()) ?? '').split(' ± ')[0];
  expect(Math.abs(numberIn(printed) - skew)).toBeLessThanOrEqual(0.0005);
  expect(settings).toEqual({ element: 'banana-machine', ...config });
  const again = await widget.evaluate((element, { element: _name, ...given }) => {
    const { motion } = /** @type {import('./support.js').BananaMachineElement} */ (element);
    const machine = new motion.BananaMachine(given);
    const copy = [...machine.poses];
    machine.free();
    return copy;
  }, settings);
  expect(again).toEqual(poses);
});

test('Map Squeeze’s CSV has the verdicts, which add up to the figures', async ({ page }) => {
  const widget = await openSqueeze(page);
  const { config, stats } = await squeezed(widget);
  const { settings, columns, rows } = parsed(await csvOf(widget));
  expect(settings).toEqual({ element: 'map-squeeze', map: null, ...config });
  expect(columns).toEqual(['x_m', 'y_m', 'theta_rad', 'end_free', 'path_free', 'accepted']);
  expect(rows).toHaveLength(stats.attempts);
  expect(rows.filter((row) => row[5] === 1)).toHaveLength(stats.accepted);
  expect(rows.filter((row) => row[5] === 1 && row[4] === 0)).toHaveLength(stats.throughWall);
});

test('SVG is vectors with a title and a description: dots while they are few, else an image', async ({ page }) => {
  const widget = await open(page);
  const plane = widget.locator('canvas.plane');
  // A thousand.
  await widget.getByRole('slider', { name: 'robots in the whole cloud' }).fill('6');
  await frames(page);
  const few = await elementsOf(page, await svgOf(widget));
  const { width, height } = await boxOf(plane);
  expect(few.title).toBe('The Banana Machine');
  expect(few.description).toBe(await plane.getAttribute('aria-label'));
  expect(few.size).toEqual([Math.round(width), Math.round(height)]);
  expect(few.images).toBe(0);
  expect(few.paths).toBeGreaterThan(1000);
  expect(few.texts).toBeGreaterThan(8);
  // The commanded arc and the ellipse, and what they are called above the picture.
  expect(few.dashed).toBe(4);
  const drawn = await svgOf(widget);
  for (const name of ['Gaussian in (x, y)', 'Gaussian in ξ', 'command']) expect(drawn).toContain(`>${name}</text>`);
  await widget.getByRole('slider', { name: 'robots in the whole cloud' }).fill('9');
  await frames(page);
  const many = await elementsOf(page, await svgOf(widget));
  expect(many.images).toBe(1);
  expect(many.paths).toBeLessThan(60);

  const squeeze = await openSqueeze(page);
  const map = await elementsOf(page, await svgOf(squeeze));
  expect(map.title).toBe('Map Squeeze');
  expect(map.images).toBe(0);
  expect(map.paths).toBeGreaterThan(600);
  // Both may stand on one page: of each a title, a description and a clip, and that of the inset with the whole map.
  const ids = [await svgOf(widget), await svgOf(squeeze)].flatMap((svg) => [...svg.matchAll(/ id="([^"]+)"/g)].map(([, id]) => id));
  expect(ids).toHaveLength(7);
  expect(new Set(ids).size).toBe(7);
});

test('SVG has the turns of the odometry model as arcs of their angles', async ({ page }) => {
  const widget = await open(page);
  await widget.evaluate((element) => Object.assign(element, { model: 'odometry', omega: 1.2 }));
  await frames(page);
  const { rot1, rot2 } = await widget.evaluate((element) => /** @type {any} */ (element).machine.reading);
  const svg = await svgOf(widget);
  const number = '(-?[\\d.]+)';
  const arcs = [...svg.matchAll(new RegExp(`d="M${number},${number}A${number},\\3 0 (0|1) (0|1) ${number},${number}"`, 'g'))];
  // A chord of the circle says the angle; both turns are to the left, against the sense of SVG, where y runs down.
  const angles = arcs.map(([, x, y, radius, , , toX, toY]) => 2 * Math.asin(Math.hypot(Number(toX) - Number(x), Number(toY) - Number(y)) / 2 / Number(radius)));
  expect(angles).toHaveLength(2);
  expect(arcs.map(([, , , , large, sweep]) => [large, sweep])).toEqual([['0', '0'], ['0', '0']]);
  // Coordinates are printed to a tenth or a hundredth of a pixel, of some 26.
  for (const [i, turn] of [rot1, rot2].entries()) expect(Math.abs(angles[i] - turn)).toBeLessThan(0.01);
});

// In two others, names of angles and of distances have the colours of these.
for (const name of ALL.filter((each) => each !== 'arc-anatomy' && each !== 'odometry-decomposer')) {
  test(`no word of ${name} has the colour of what it stands beside`, async ({ page }) => {
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    const { colours, allowed } = await widget.evaluate((element) => {
      const figure = /** @type {Figure & { stage: { palette: Record<string, string> } }} */ (element);
      const { documentElement: root } = new DOMParser().parseFromString(figure.toSVG(), 'image/svg+xml');
      const { ink, muted } = figure.stage.palette;
      return { colours: [...root.querySelectorAll('text')].map((text) => text.getAttribute('fill')), allowed: [ink, muted] };
    });
    expect(colours.length).toBeGreaterThan(4);
    expect(colours.filter((colour) => !allowed.includes(colour ?? ''))).toEqual([]);
  });
}

test('the picture on screen stays as it is when it is exported', async ({ page }) => {
  const widget = await openWhole(page);
  const canvas = widget.locator('canvas.plane');
  const pixels = () => canvas.evaluate((element) => /** @type {HTMLCanvasElement} */ (element).toDataURL());
  const before = await pixels();
  await svgOf(widget);
  await pngOf(widget);
  await widget.getByRole('checkbox', { name: 'linearized' }).check();
  await widget.getByRole('checkbox', { name: 'linearized' }).uncheck();
  await frames(page);
  expect(await pixels()).toBe(before);
});

test('a figure that has no size is taken along in one of its own, and a browser that makes no image of it says so', async ({ page }) => {
  const widget = await open(page);
  await page.evaluate(() => void (document.body.style.display = 'none'));
  await frames(page);
  expect((await elementsOf(page, await svgOf(widget))).size).toEqual([720, 432]);
  expect(await pngOf(widget)).toMatchObject({ width: 1440, height: 864, opaque: true });
  const complaint = await widget.evaluate((element) => {
    HTMLCanvasElement.prototype.toBlob = (done) => done(null);
    return /** @type {Figure} */ (element).toPNG().catch(String);
  });
  expect(complaint).toBe('Error: The browser makes no PNG image of it.');
  // The menu has nobody else to tell.
  const told = await widget.evaluate((element) => new Promise((resolve) => {
    element.addEventListener('error', (event) => {
      event.preventDefault();
      resolve(/** @type {ErrorEvent} */ (event).message);
    });
    /** @type {HTMLElement | undefined | null} */ (element.shadowRoot?.querySelector('.exports button'))?.click();
  }));
  expect(told).toBe('The browser makes no PNG image of it.');
});

test('what is taken along shows and says what has just changed, before a frame has come', async ({ page }) => {
  for (const widget of [await open(page), await openSqueeze(page)]) {
    const [before, taken, shown] = await widget.evaluate(async (element) => {
      const figure = /** @type {Figure} */ (element);
      const drawn = [figure.toSVG()];
      figure.v = 5;
      drawn.push(figure.toSVG());
      for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
      return [...drawn, figure.toSVG()];
    });
    expect(taken).toBe(shown);
    expect(taken).not.toBe(before);
    // What the reader has just changed, too.
    const [was, given, later] = await widget.evaluate(async (element) => {
      const figure = /** @type {Figure} */ (element);
      const drawn = [figure.toSVG()];
      const slider = /** @type {HTMLInputElement} */ (figure.shadowRoot?.querySelector('#v'));
      slider.value = '1';
      slider.dispatchEvent(new Event('input', { bubbles: true }));
      drawn.push(figure.toSVG());
      for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
      return [...drawn, figure.toSVG()];
    });
    expect(given).toBe(later);
    expect(given).not.toBe(was);
  }
});

for (const colorScheme of /** @type {const} */ (['light', 'dark'])) {
  test(`PNG has twice the pixels and its paper under it, in ${colorScheme}`, async ({ page }) => {
    await page.emulateMedia({ colorScheme });
    for (const widget of [await open(page), await openSqueeze(page)]) {
      const { width, height } = await boxOf(widget.locator('canvas.plane'));
      const { colours, ...png } = await pngOf(widget);
      expect(png).toEqual({ type: 'image/png', width: Math.round(2 * width), height: Math.round(2 * height), opaque: true });
      expect(colours).toBeGreaterThan(50);
    }
  });
}

test('the menu saves files with names that say what they are, from the keyboard too', async ({ page }) => {
  const widget = await open(page);
  const menu = widget.locator('.exports summary');
  await menu.focus();
  await page.keyboard.press('Enter');
  for (const ending of ['png', 'svg', 'csv']) {
    await page.keyboard.press('Tab');
    const [download] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('Enter')]);
    expect(download.suggestedFilename()).toBe(`banana-machine-3.${ending}`);
    const contents = readFileSync(await download.path());
    expect(contents.length).toBeGreaterThan(1000);
    if (ending === 'csv') expect(contents.toString()).toBe(await csvOf(widget));
  }
});

test('a file that is saved says of what type it is, and takes no memory for good', async ({ page }) => {
  await page.addInitScript(() => {
    const types = /** @type {string[]} */ ([]);
    const held = new Set();
    const [address, revoke, later] = [URL.createObjectURL.bind(URL), URL.revokeObjectURL.bind(URL), setTimeout];
    Object.assign(window, { types, held });
    URL.createObjectURL = (blob) => {
      types.push(/** @type {Blob} */ (blob).type);
      const made = address(blob);
      held.add(made);
      return made;
    };
    URL.revokeObjectURL = (made) => {
      held.delete(made);
      revoke(made);
    };
    // A minute is a second.
    Object.assign(window, { setTimeout: (/** @type {TimerHandler} */ work, delay = 0) => later(work, Math.min(delay, 1000)) });
  });
  const widget = await open(page);
  await widget.locator('.exports summary').click();
  for (const name of ['PNG', 'SVG', 'CSV']) {
    await Promise.all([page.waitForEvent('download'), widget.locator('.exports').getByRole('button', { name }).click()]);
  }
  expect(await page.evaluate(() => Reflect.get(window, 'types'))).toEqual(['image/png', 'image/svg+xml', 'text/csv']);
  await expect.poll(() => page.evaluate(() => Reflect.get(window, 'held').size)).toBe(0);
});

test('before there is a figure the methods say so', async ({ page }) => {
  await open(page);
  const complaint = await page.evaluate(async () => {
    const element = document.createElement('banana-machine');
    return element.toPNG().catch((error) => String(error));
  });
  expect(complaint).toBe('Error: There is no figure yet: it is there from the load event on.');
});

/** What no XML may have, and what would end a part of it. */
const HOSTILE = ']]> --> <!-- <![CDATA[ </svg><script>alert(1)</script> & &amp; " \u0027 \u0000\u0001\u0008\u000b\u000c\u001f\ufffe\uffff \ud800 \udc00 \u{1f916} é';

/** As it comes out of an SVG file. @param {string} text */
// eslint-disable-next-line no-control-regex
const harmless = (text) => text.replace(/[\0-\x08\x0b\x0c\x1f\ufffe\uffff\p{Cs}]/gu, '\ufffd');

test('SVG is well-formed whatever a page calls its things', async ({ page }) => {
  const walls = [[3, 0, 3, 1.5], [3, 2.5, 3, 4], [0, 0, 6, 0], [6, 0, 6, 4], [6, 4, 0, 4], [0, 4, 0, 0]];
  const banana = await open(page);
  const squeeze = await openSqueeze(page);
  for (const widget of [banana, squeeze]) {
    await widget.evaluate(
      async (element, [json, map]) => {
        // On the way to the page, halves of a pair are lost otherwise.
        const text = JSON.parse(json);
        const { setMessages } = await import(new URL('/motion-widgets.js', location.href).href);
        // Every word and every name is another's.
        /** @type {(message: any) => any} */
        const hostile = (message) => {
          if (typeof message === 'string') return text;
          if (typeof message === 'function') return () => text;
          const entries = Object.entries(message).map(([key, each]) => [key, hostile(each)]);
          return Array.isArray(message) ? entries.map(([, each]) => each) : Object.fromEntries(entries);
        };
        const english = Reflect.get(globalThis, Symbol.for('motion-widgets.messages')).english;
        setMessages('fr', hostile(english));
        element.setAttribute('lang', 'fr');
        const title = Object.assign(document.createElement('span'), { slot: 'title', textContent: text });
        element.append(title);
        element.style.setProperty('--motion-font', `"${text.replaceAll('"', '').replaceAll('\0', '')}", serif`);
        if ('map' in element) element.map = { ...map, name: text };
        await new Promise(requestAnimationFrame);
        await new Promise(requestAnimationFrame);
      },
      /** @type {const} */ ([JSON.stringify(HOSTILE), { bounds: [0, 0, 6, 4], walls }]),
    );
    const svg = await svgOf(widget);
    const { title, description } = await elementsOf(page, svg);
    expect(title).toBe(harmless(HOSTILE.replace(/\s+/g, ' ')));
    expect(description).toContain(harmless(HOSTILE));
    expect(await page.evaluate((text) => new DOMParser().parseFromString(text, 'image/svg+xml').querySelectorAll('script').length, svg)).toBe(0);
  }
});

for (const [tag, own] of Object.entries(presets)) {
  test(`every preset of ${tag} is vectors that stand on their own`, async ({ page }) => {
    await show(page, `<${tag}></${tag}>`);
    const widget = page.locator(tag);
    await ready(widget);
    for (const { name } of own) {
      await assign(widget, 'preset', name);
      const { title, texts, paths, size } = await elementsOf(page, await svgOf(widget));
      expect(title).not.toBe('');
      // The axes at least, and what the lines are called.
      expect(texts, name).toBeGreaterThan(6);
      expect(paths, name).toBeGreaterThan(10);
      expect(Math.min(...size), name).toBeGreaterThan(100);
    }
  });
}
