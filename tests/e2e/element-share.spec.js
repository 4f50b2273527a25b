import { expect } from '@playwright/test';
import { expectAccessible } from './axe.js';
import { ALL, CLOUDS, KNOWN, heard, property, ready, show, stateOf } from './element-support.js';
import { FRESH, STILL, frames, test, unfold } from './support.js';

/** @typedef {import('./element-support.js').AnyElement} AnyElement */

test.use(STILL);

const THREE = `<banana-machine share></banana-machine>
  <h2 id="what-to-try" style="margin-top: 3000px">What to try</h2>
  <banana-machine share id="second one"></banana-machine>
  <banana-machine></banana-machine>`;

test('two widgets and an anchor share the fragment, and the link shows what was there', FRESH, async ({ page, context }) => {
  await show(page, THREE, { fragment: '#what-to-try&theme=a%20b' });
  // The anchor is found though the fragment has more in it.
  await expect.poll(() => page.evaluate(() => scrollY)).toBeGreaterThan(1000);
  const [first, second, third] = [0, 1, 2].map((i) => page.locator('banana-machine').nth(i));
  await first.scrollIntoViewIfNeeded();
  await ready(first);
  const hash = () => page.evaluate(() => location.hash);
  expect(await hash()).toBe('#what-to-try&theme=a%20b');
  const entries = await page.evaluate(() => history.length);

  await first.getByRole('button', { name: 'Hard arc' }).click();
  await expect.poll(hash).toMatch(/^#what-to-try&theme=a%20b&banana-machine\.1=[\w-]+$/);
  await second.scrollIntoViewIfNeeded();
  await ready(second);
  await second.getByRole('button', { name: 'Pivot' }).click();
  await expect.poll(hash).toMatch(/^#what-to-try&theme=a%20b&banana-machine\.1=[\w-]+&banana-machine:second%20one=[\w-]+$/);
  await third.scrollIntoViewIfNeeded();
  await ready(third);
  const before = await hash();
  await third.getByRole('button', { name: 'Straight' }).click();
  await frames(page);
  expect(await hash()).toBe(before);
  expect(await page.evaluate(() => history.length)).toBe(entries);

  const link = await first.evaluate((element) => /** @type {AnyElement} */ (element).shareLink());
  expect(new URL(link).hash).toBe(before);
  const other = await context.newPage();
  await show(other, THREE, { fragment: new URL(link).hash });
  const [one, two, three] = [0, 1, 2].map((i) => other.locator('banana-machine').nth(i));
  for (const [copy, original] of [[one, first], [two, second]]) {
    await copy.scrollIntoViewIfNeeded();
    await ready(copy);
    expect(await stateOf(copy)).toEqual(await stateOf(original));
  }
  await three.scrollIntoViewIfNeeded();
  await ready(three);
  expect(/** @type {any} */ (await stateOf(three)).command).toEqual({ v: 1, omega: 0.5, dt: 1 });
  expect(await heard(other, ['error', 'input', 'change'])).toEqual([]);
});

test('figures in a frame and in a shadow root have parts of the fragment that are their own', FRESH, async ({ page }) => {
  await show(page, '<banana-machine></banana-machine><iframe srcdoc="<!doctype html><body></body>" width="1100" height="900"></iframe><div></div>');
  await page.waitForFunction(() => document.querySelector('iframe')?.contentDocument?.body);
  const widget = page.locator('banana-machine').first();
  await ready(widget);
  const keys = await page.evaluate(async () => {
    const [inFrame, inShadow] = [0, 1].map(() => document.createElement('banana-machine'));
    document.querySelector('iframe')?.contentDocument?.body.append(inFrame);
    document.querySelector('div')?.attachShadow({ mode: 'open' }).append(inShadow);
    const links = [document.querySelector('banana-machine'), inFrame, inShadow].map((element) => /** @type {any} */ (element).shareLink());
    return (await Promise.all(links)).map((link) => new URL(link).hash.replace(/=.*/, ''));
  });
  expect(keys).toEqual(['#banana-machine.1', '#iframe.1/banana-machine.1', '#div.1/banana-machine.1']);
});

test('the page’s own anchor is gone to once, whatever it is called', FRESH, async ({ page }) => {
  await show(page, '<banana-machine></banana-machine><h2 id="100%" style="margin: 3000px 0">All of it</h2>', { fragment: '#100%&theme=a' });
  await expect.poll(() => page.evaluate(() => scrollY)).toBeGreaterThan(1000);
  const scrolled = await page.evaluate(() => {
    scrollTo(0, 0);
    document.body.append(document.createElement('banana-machine'));
    return scrollY;
  });
  expect(scrolled).toBe(0);
});

test('a link leads to the figure that it was copied from, once; a reload leads nowhere', FRESH, async ({ page, context }) => {
  const gap = '<p style="margin: 2000px 0">Between</p>';
  const body = `${gap}<banana-machine></banana-machine>${gap}<banana-machine></banana-machine>${gap}`;
  await show(page, body);
  const figure = (/** @type {import('@playwright/test').Page} */ of, /** @type {number} */ i) => of.locator('banana-machine').nth(i);
  const tops = (/** @type {import('@playwright/test').Page} */ of) =>
    of.locator('banana-machine').evaluateAll((all) => all.map((each) => Math.round(each.getBoundingClientRect().top)));
  /** @type {string[]} */
  const links = [];
  for (const i of [0, 1]) {
    await figure(page, i).scrollIntoViewIfNeeded();
    await ready(figure(page, i));
    // The address has the first one's state when the second one is copied.
    links.push(new URL(await figure(page, i).evaluate((element) => /** @type {AnyElement} */ (element).shareLink())).hash);
    await page.evaluate((hash) => history.replaceState(null, '', hash), links[i]);
  }
  expect(links[1]).toMatch(/^#banana-machine\.2=.*&banana-machine\.1=/);
  // Of a figure that is in the address already, it has one part.
  expect(new URL(await figure(page, 1).evaluate((element) => /** @type {AnyElement} */ (element).shareLink())).hash).toBe(links[1]);
  for (const [i, fragment] of links.entries()) {
    const other = await context.newPage();
    await show(other, body, { fragment });
    await ready(figure(other, i));
    await expect.poll(async () => (await tops(other))[i]).toBe(0);
    // One more of them, and the reader is elsewhere.
    const moved = await other.evaluate(async () => {
      scrollTo(0, 100);
      document.body.append(document.createElement('banana-machine'));
      document.body.append(/** @type {Element} */ (document.querySelector('banana-machine')));
      await new Promise((resolve) => setTimeout(resolve));
      return scrollY;
    });
    expect(moved).toBe(100);
    await other.close();
  }
  // One that is followed on the page.
  await page.evaluate(() => scrollTo(0, 0));
  await page.evaluate((hash) => (location.hash = hash), links[0]);
  await expect.poll(async () => (await tops(page))[0]).toBe(0);
  await page.evaluate(() => scrollTo(0, 700));
  await page.reload();
  await expect(page.locator('banana-machine:defined')).toHaveCount(2);
  await frames(page);
  expect(await page.evaluate(() => scrollY)).toBe(700);
});

test('a figure that comes when its link is no longer the address does not move the page', FRESH, async ({ page }) => {
  const gap = '<p style="margin: 2000px 0">Between</p>';
  await show(page, gap, { fragment: '#banana-machine.1=abc' });
  const moved = await page.evaluate(async () => {
    await customElements.whenDefined('banana-machine');
    document.querySelector('p')?.before(document.createElement('map-squeeze'));
    history.replaceState(null, '', '#other');
    const figure = /** @type {any} */ (document.createElement('banana-machine'));
    document.body.append(figure);
    await figure.updateComplete;
    await new Promise(requestAnimationFrame);
    return scrollY;
  });
  expect(moved).toBe(0);
});

test('a state that the address had while the figure was far away is not entered when it has none any more', async ({ page }) => {
  await show(page, '<banana-machine v="0.5"></banana-machine>');
  const first = page.locator('banana-machine').first();
  await ready(first);
  const hash = await first.evaluate((element) => /** @type {AnyElement} */ (element).shareLink().then((link) => new URL(link).hash.replace('#banana-machine.1', '#x&banana-machine.2')));
  const last = await page.evaluateHandle(async (address) => {
    const gap = document.createElement('div');
    gap.style.height = '5000px';
    const figure = document.createElement('banana-machine');
    document.body.append(gap, figure);
    const rest = async () => {
      // The state is unpacked in a stream.
      for (let i = 0; i < 10; i++) await new Promise((resolve) => setTimeout(resolve));
    };
    for (const next of [address, '#other=1']) {
      const heard = new Promise((resolve) => addEventListener('hashchange', resolve, { once: true }));
      location.hash = next;
      await heard;
      await rest();
    }
    return figure;
  }, hash);
  await last.scrollIntoViewIfNeeded();
  await ready(page.locator('banana-machine').last());
  expect(await last.evaluate((element) => Reflect.get(element, 'v'))).not.toBe(0.5);
});

test('an anchor by itself is the browser’s business: who has left it is not brought back by a figure', FRESH, async ({ page }) => {
  await show(page, '<div style="height: 3000px"></div><p id="low">Low</p><div style="height: 3000px"></div>', { fragment: '#low', script: '' });
  expect(await page.evaluate(() => scrollY)).toBeGreaterThan(2000);
  await page.evaluate(async () => {
    scrollTo(0, 0);
    const figure = document.createElement('banana-machine');
    document.body.prepend(figure);
    await import(/** @type {any} */ ('/motion-widgets.js'));
    await new Promise((resolve) => figure.addEventListener('load', resolve));
  });
  expect(await page.evaluate(() => scrollY)).toBe(0);
});

test('an anchor that is not there is none', FRESH, async ({ page }) => {
  await show(page, '<banana-machine></banana-machine>', { fragment: '#nowhere&theme=a' });
  await ready(page.locator('banana-machine'));
  expect(await page.evaluate(() => scrollY)).toBe(0);
});

test('a link that is followed on the page, and a plain anchor', async ({ page }) => {
  await show(page, '<banana-machine share></banana-machine><p id="end">The end</p>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  await widget.getByRole('button', { name: 'Pivot' }).click();
  const link = await widget.evaluate((element) => /** @type {AnyElement} */ (element).shareLink());
  await widget.getByRole('button', { name: 'Straight' }).click();
  await page.evaluate(() => (location.hash = '#end'));
  await frames(page);
  expect(await page.evaluate(() => document.querySelector(':target')?.id)).toBe('end');
  expect(/** @type {any} */ (await stateOf(widget)).command).toEqual({ v: 1, omega: 0, dt: 2 });
  await page.evaluate((hash) => (location.hash = hash), new URL(link).hash);
  await expect.poll(async () => /** @type {any} */ (await stateOf(widget)).command).toEqual({ v: 0.06, omega: 1.5, dt: 1 });
});

test('a link that is broken is reported, and the figure opens as its attributes say', async ({ page }) => {
  for (const text of ['nonsense!', 'AAAA', '', 'q1YqSy0qzszPU7JSMtAzUKoFAA']) {
    await page.goto('about:blank');
    await show(page, '<banana-machine share v="0.5"></banana-machine>', { fragment: `#banana-machine.1=${text}` });
    const widget = page.locator('banana-machine');
    await ready(widget);
    const errors = await heard(page, ['error']);
    expect(errors.length, text).toBe(1);
    expect(errors[0].message).toMatch(/^state.*; allowed (is|are) /);
    expect(/** @type {any} */ (await stateOf(widget)).command.v).toBe(0.5);
  }
});

test('a page with a base of its own keeps its address', async ({ page }) => {
  await show(page, '<map-squeeze share></map-squeeze>', { head: '<base href="/somewhere/else/">' });
  const widget = page.locator('map-squeeze');
  await ready(widget);
  const address = () => page.evaluate(() => location.href);
  await widget.getByRole('button', { name: 'Facing a wall' }).click();
  await expect.poll(address).toMatch(/\/bare\.html#map-squeeze\.1=[\w-]+$/);
  // A later state takes the place of the former.
  const former = await address();
  await widget.getByRole('button', { name: 'Open corridor' }).click();
  await expect.poll(address).not.toBe(former);
  expect(await address()).toMatch(/\/bare\.html#map-squeeze\.1=[\w-]+$/);
});

for (const name of ALL) {
  const { slider, values, button } = KNOWN[name];

  test(`${name} without share leaves the address alone, and opens what a link has for it`, FRESH, async ({ page, context }) => {
    await show(page, `<${name}></${name}>`, { fragment: '#elsewhere' });
    const widget = page.locator(name);
    await ready(widget);
    await widget.evaluate((element, [key, value]) => void Reflect.set(element, key, value), /** @type {const} */ ([slider, values[0]]));
    await widget.getByRole('button', { name: button, exact: true }).click();
    await frames(page);
    expect(await page.evaluate(() => location.hash)).toBe('#elsewhere');
    const link = await widget.evaluate((element) => /** @type {AnyElement} */ (element).shareLink());
    expect(link.split('#')[0]).toBe(page.url().split('#')[0]);
    const other = await context.newPage();
    await show(other, `<${name}></${name}>`, { fragment: new URL(link).hash });
    await ready(other.locator(name));
    const opened = await stateOf(other.locator(name));
    expect(opened).toEqual(await stateOf(widget));
    await other.locator(name).locator(`#${slider}`).fill(String(values[1]));
    await frames(other);
    expect(await other.evaluate(() => location.hash)).toBe(new URL(link).hash);
    // What the reader made of it stays when the figure goes and comes back.
    const left = await stateOf(other.locator(name));
    expect(left).not.toEqual(opened);
    await other.locator(name).evaluate(async (element) => {
      element.remove();
      await new Promise(requestAnimationFrame);
      const loaded = new Promise((resolve) => element.addEventListener('load', resolve, { once: true }));
      document.body.append(element);
      await loaded;
    });
    expect(await stateOf(other.locator(name))).toEqual(left);
  });

  test(`${name} reports a link that says nothing, and opens as ever`, async ({ page }) => {
    await show(page, `<${name}></${name}>`, { fragment: `#${name}.1=nonsense` });
    await ready(page.locator(name));
    expect(await heard(page, ['error'])).toHaveLength(1);
  });
}

for (const name of CLOUDS) {
  test(`a link to ${name} without a sample opens without one`, FRESH, async ({ page, context }) => {
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    await unfold(widget);
    await widget.getByRole('button', { name: 'Reset', exact: true }).click();
    await frames(page);
    const link = await widget.evaluate((element) => /** @type {AnyElement} */ (element).shareLink());
    const other = await context.newPage();
    await show(other, `<${name}></${name}>`, { fragment: new URL(link).hash });
    await ready(other.locator(name));
    const state = await stateOf(other.locator(name));
    expect(state).toMatchObject({ shown: 0, playing: false });
    expect(state).toEqual(await stateOf(widget));
  });
}

for (const name of ALL) {
  const { slider, values, button } = KNOWN[name];

  test(`${name} with share keeps its state in the address, and follows one that comes`, async ({ page }) => {
    await show(page, `<${name} share></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    const hash = () => page.evaluate(() => location.hash);
    await widget.locator(`#${slider}`).fill(String(values[0]));
    await expect.poll(hash).toMatch(new RegExp(`^#${name}\\.1=[\\w-]+$`));
    const [former, state] = [await hash(), await stateOf(widget)];
    await widget.getByRole('button', { name: button, exact: true }).click();
    await expect.poll(hash).not.toBe(former);
    expect(await stateOf(widget)).not.toEqual(state);
    await page.evaluate((fragment) => (location.hash = fragment), former);
    await expect.poll(() => stateOf(widget)).toEqual(state);
    expect(await heard(page, ['error'])).toEqual([]);
  });
}

test('a link that unpacks to more than any map takes is refused, whatever it says', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  const state = JSON.stringify({ widget: 'banana-machine', version: 1, samples: 700 });
  for (const [length, samples] of [[10_000_001, 50_000], [10_000_000, 700]]) {
    await page.evaluate(async (text) => {
      const packed = new Blob([text]).stream().pipeThrough(new CompressionStream('deflate-raw'));
      const bytes = new Uint8Array(await new Response(packed).arrayBuffer());
      location.hash = `#banana-machine.1=${btoa(String.fromCharCode(...bytes)).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '')}`;
    }, state.padEnd(length));
    if (samples === 700) await expect.poll(() => property(widget, 'samples')).toBe(samples);
    else await expect.poll(async () => (await heard(page, ['error'])).map(({ message }) => message).join()).toContain('state in the address is "');
    expect(await property(widget, 'samples')).toBe(samples);
  }
});

test('the code to embed a figure that is not there yet has what was said of it by theme, language and direction', async ({ page }) => {
  await show(page, '');
  const code = await page.evaluate(() => {
    const element = document.createElement('banana-machine');
    for (const [name, text] of Object.entries({ theme: 'dark', lang: 'de', dir: 'ltr', v: '0.5' })) element.setAttribute(name, text);
    return element.embedCode();
  });
  expect(code.split('\n').slice(1)).toEqual(['<banana-machine theme="dark" lang="de" dir="ltr"></banana-machine>', '']);
});

test.describe('the menu', () => {
  test.use({ permissions: ['clipboard-read', 'clipboard-write'] });

  test('copies a link, and the code to embed with the address of the script', async ({ page }) => {
    await show(page, '<banana-machine></banana-machine>');
    const widget = page.locator('banana-machine');
    await ready(widget);
    await widget.getByRole('button', { name: 'Pivot' }).click();
    await frames(page);
    await widget.getByText('Share the figure').click();
    const clipboard = () => page.evaluate(() => navigator.clipboard.readText());
    await widget.getByRole('button', { name: 'Copy link' }).click();
    await expect(widget.getByText('Copied.')).toBeVisible();
    expect(await clipboard()).toBe(await widget.evaluate((element) => /** @type {AnyElement} */ (element).shareLink()));
    const embed = widget.getByRole('button', { name: 'Copy embed code' });
    await expect(embed).toHaveAttribute('title', 'HTML that shows the figure as it is now on a page of your own');
    await embed.click();
    await expect.poll(clipboard).toContain('<banana-machine preset="pivot"></banana-machine>');
    const origin = new URL(page.url()).origin;
    expect(await clipboard()).toContain(`<script type="module" src="${origin}/motion-widgets.js"></script>`);
  });

  test('says that the code to embed is without the own map', async ({ page }) => {
    await show(page, '<map-squeeze></map-squeeze>');
    const widget = page.locator('map-squeeze');
    await ready(widget);
    await widget.getByText('Share the figure').click();
    await widget.getByRole('button', { name: 'Copy embed code' }).click();
    await expect(widget.getByText('Copied.')).toHaveText('Copied.');
    await widget.evaluate((element) => void Object.assign(element, { map: { bounds: [0, 0, 6, 4], walls: [[3, 0, 3, 1.5]] } }));
    await frames(page);
    await widget.getByRole('button', { name: 'Copy embed code' }).click();
    await expect(widget.getByText('Copied.')).toContainText('without your map');
  });

  for (const [script, tag] of [
    ['<script type="module" src="/external.js"></script>', '<script type="module" src="ORIGIN/external.js"></script>'],
    ['<script defer src="/motion-widgets.iife.js"></script>', '<script defer src="ORIGIN/motion-widgets.iife.js"></script>'],
  ]) {
    test(`names the script in full that defined the element: ${script}`, FRESH, async ({ page }) => {
      await show(page, '<map-squeeze></map-squeeze>', { script });
      const widget = page.locator('map-squeeze');
      await ready(widget);
      const code = await widget.evaluate((element) => /** @type {AnyElement} */ (element).embedCode());
      expect(code).toContain(tag.replace('ORIGIN', new URL(page.url()).origin));
    });
  }

  test('shows what the clipboard does not take', async ({ page }) => {
    await page.addInitScript(() => Object.defineProperty(navigator, 'clipboard', { value: undefined }));
    await show(page, '<map-squeeze seed="4"></map-squeeze>');
    const widget = page.locator('map-squeeze');
    await ready(widget);
    await widget.getByText('Share the figure').click();
    await widget.getByRole('button', { name: 'Copy embed code' }).click();
    await expect(widget.getByRole('textbox', { name: 'Copy it from here' })).toHaveValue(/<map-squeeze seed="4"><\/map-squeeze>/);
    await expectAccessible(page, undefined, 'map-squeeze');
  });
});

test('the code to embed has the published script where that of the page is nothing to others', async ({ page }) => {
  await show(page, '', { script: '' });
  const code = await page.evaluate(async () => {
    const script = new Blob([await (await fetch('/motion-widgets.js')).text()], { type: 'text/javascript' });
    await import(URL.createObjectURL(script));
    return document.createElement('banana-machine').embedCode();
  });
  expect(code).toBe('<script type="module" src="https://cdn.jsdelivr.net/npm/motion-widgets@0.1/dist/motion-widgets.js"></script>\n<banana-machine></banana-machine>\n');
});

test('a link that is followed while the figure starts is heard', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  const links = [];
  for (const name of ['Pivot', 'Straight']) {
    await widget.getByRole('button', { name }).click();
    links.push(new URL(await widget.evaluate((element) => /** @type {AnyElement} */ (element).shareLink())).hash);
  }
  const [pivot, straight] = links;
  await page.evaluate(async ([first, second]) => {
    document.querySelector('banana-machine')?.remove();
    location.hash = first;
    await new Promise((resolve) => addEventListener('hashchange', resolve, { once: true }));
    const element = document.createElement('banana-machine');
    const { link } = /** @type {any} */ (element);
    const { prepare } = link;
    link.prepare = async () => {
      await prepare.call(link);
      // It has read the address, and there is no machine yet.
      location.hash = second;
      await new Promise((resolve) => addEventListener('hashchange', resolve, { once: true }));
    };
    const loaded = new Promise((resolve) => element.addEventListener('load', resolve));
    document.body.prepend(element);
    await loaded;
  }, [pivot, straight]);
  const command = () => page.evaluate(() => /** @type {any} */ (document.querySelector('banana-machine')).getState()?.command);
  await expect.poll(command).toEqual({ v: 1, omega: 0, dt: 2 });
});

test('figures in shadow roots, closed ones too, have parts of their own in the address', async ({ page }) => {
  await page.addInitScript(() => {
    for (const [name, mode] of [['open-host', 'open'], ['closed-host', 'closed']]) {
      customElements.define(name, class extends HTMLElement {
        figure = this.attachShadow({ mode: /** @type {ShadowRootMode} */ (mode) }).appendChild(document.createElement('banana-machine'));
      });
    }
  });
  await show(page, '<open-host></open-host><open-host></open-host><closed-host id="c"></closed-host><banana-machine></banana-machine>');
  const keys = await page.evaluate(async () => {
    const hosts = /** @type {any[]} */ ([...document.querySelectorAll('open-host, closed-host')].map((host) => Reflect.get(host, 'figure')));
    const figures = /** @type {AnyElement[]} */ ([...hosts, document.querySelector('banana-machine')]);
    return Promise.all(figures.map(async (figure) => new URL(await figure.shareLink()).hash.slice(1).split('=')[0]));
  });
  expect(keys).toEqual(['open-host.1/banana-machine.1', 'open-host.2/banana-machine.1', 'closed-host:c/banana-machine.1', 'banana-machine.1']);
});
