import { expect } from '@playwright/test';
import { cloudOn, expectRecorded, plain } from './figure-contract.js';
import { STILL, frames, test, unfold } from './support.js';

test.use(STILL);

test('what is given as properties and attributes is taken, refused and reflected', async ({ page }) => {
  const widget = await cloudOn(page);
  const lines = await widget.evaluate((element) => {
    const figure = /** @type {any} */ (element);
    const said = /** @type {string[]} */ ([]);
    let refused = '';
    element.addEventListener('error', (event) => {
      const { error, message, bubbles, composed, cancelable } = /** @type {ErrorEvent} */ (event);
      refused += `${error.name} ${message} ${[bubbles, composed, cancelable]}`;
    });
    const attributes = () => [...element.attributes].map(({ name, value }) => `${name}=${value}`);
    const printed = (/** @type {any} */ value) => (['symbol', 'function', 'bigint'].includes(typeof value) ? typeof value : JSON.stringify(value) ?? 'undefined');
    const note = (/** @type {string} */ what, /** @type {() => unknown} */ act) => {
      refused = '';
      const before = attributes();
      let answer;
      try {
        answer = printed(act());
      } catch (error) {
        answer = `throws ${error}`;
      }
      const fresh = attributes().filter((each) => !before.includes(each));
      const gone = before.filter((each) => !attributes().some((other) => other.split('=')[0] === each.split('=')[0]));
      said.push([what, refused || answer, ...fresh, ...gone.map((each) => `-${each.split('=')[0]}`)].join(' | '));
    };
    const properties = /** @type {[string, unknown][]} */ ([
      ['v', 0.5], ['v', ' 2e0 '], ['v', ' '], ['v', 'fast'], ['v', {}], ['v', [1]], ['v', 1e7], ['v', null],
      ['alpha5', 0.25], ['alpha1', '0.5'], ['alpha4', -1], ['command', { v: 0.25, omega: 1, dt: 2 }], ['command', { v: 0.25 }], ['command', 5], ['command', true],
      ['alphas', [1, 2, 3, 4, 5, 6]], ['alphas', undefined], ['model', 'odometry'], ['alpha5', 1], ['alpha4', 0.125],
      ['model', 'bicycle'], ['model', 7], ['model', Symbol('x')], ['model', () => 1], ['model', 1n], ['reverseAware', ''],
      ['reverseAware', 'false'], ['reverseAware', 'no'], ['reverseAware', 'true'], ['reverseAware', null], ['isolate', 2],
      ['isolate', 2.5], ['isolate', undefined], ['seed', '12'], ['seed', -1], ['samples', 100], ['samples', 0], ['marked', 99],
      ['marked', '7'], ['marked', 100], ['marked', -1], ['marked', 1.5], ['marked', 0], ['samples', 50], ['marked', 49], ['samples', 40],
      ['marked', null], ['overlays', ['ellipse', 'command', 'ellipse']], ['overlays', ' linearized\tcommand '], ['overlays', ['stars']],
      ['overlays', 'stars'], ['overlays', 5], ['overlays', null], ['preset', 'hard'], ['preset', 'soft'], ['preset', null],
      ['theme', 'dark'], ['theme', 'blue'], ['theme', 'x'.repeat(41)], ['theme', null], ['theme', 3], ['theme', {}], ['theme', () => 1], ['theme', 1n], ['theme', Symbol('x')], ['share', true], ['share', false],
      ['share', ''], ['share', false], ['headingLevel', 3], ['headingLevel', '7'], ['headingLevel', null], ['headingLevel', '2'],
      ['headingLevel', undefined], ['presentation', false],
    ]);
    for (const [name, value] of properties) {
      note(`${name} = ${printed(value)}`, () => {
        figure[name] = value;
        return figure[name];
      });
    }
    const texts = /** @type {[string, string | null][]} */ ([
      ['v', '0.75'], ['v', null], ['v', ''], ['v', 'x'], ['v', '1'], ['alpha6', '1'], ['alpha2', '2'], ['reverseaware', ''], ['reverseaware', 'no'],
      ['reverseaware', null], ['overlays', 'additive  command'], ['overlays', ''], ['overlays', null], ['theme', 'light'], ['theme', 'LIGHT'],
      ['theme', null], ['heading-level', '9'], ['heading-level', '1'], ['heading-level', null], ['marked', '3'], ['strange', '5'],
      ['isolate', '1'], ['isolate', null], ['preset', 'pivot'], ['preset', null], ['model', 'velocity'], ['model', null], ['share', ''], ['share', null],
    ]);
    for (const [name, text] of texts) {
      note(`<${name}=${text}>`, () => {
        if (text === null) element.removeAttribute(name);
        else element.setAttribute(name, text);
        const { v, alphas, overlays, theme, headingLevel, share, isolate, preset, model } = figure;
        return [v, alphas?.join(' '), overlays?.join(' '), theme, headingLevel, share, isolate, preset, model];
      });
    }
    const states = [
      null, [], 'text', 5, {}, { widget: 'banana-machine' }, { widget: 'banana-machine', version: 1, playing: 1 },
      ...[
        { seed: 5 }, { shown: 20 }, { shown: 41 }, { shown: 10, marked: 9 }, { shown: 10, marked: 10 }, { shown: 9 }, { samples: 5 }, { samples: 60 },
        { playing: true, shown: 0, marked: 30 }, { overlays: ['additive'] }, { overlays: [] }, { theme: 'dark' }, { ['k'.repeat(50)]: 1 },
        { alphas: { odometry: [0, 0, 0, 0] } }, { alphas: 5 }, { alphas: { walking: 1 } }, { isolateChoice: 0 },
      ].map((part) => ({ widget: 'banana-machine', version: 1, ...part })),
    ];
    for (const state of states) {
      note(`setState(${printed(state)})`, () => {
        figure.setState(state);
        return figure.getState();
      });
    }
    const { kind, settings, reflection } = figure;
    said.push(`observed ${kind.observedAttributes.join(' ')}`, `declared ${Object.keys(settings.declared(settings.present)).join(' ')}`);
    said.push(`needed ${JSON.stringify(reflection.needed())}`, figure.embedCode().replace(/https?:\/\/[^/]+/, ''));
    // What a widget says of itself, where it says nothing.
    const base = Object.getPrototypeOf(kind.prototype);
    note('createMachine', () => base.createMachine());
    note('read', () => base.read());
    note('takeaway', () => base.takeaway);
    for (const playing of [undefined, 1]) note(`setState playing ${playing}`, () => figure.setState({ widget: 'banana-machine', version: 1, playing }));
    said.push(`otherwise ${[typeof base.content(), JSON.stringify(base.announcement()), base.held]}`);
    const descriptors = ['v', 'overlays', 'command', 'marked', 'poses', 'playing'].map((name) => {
      const { configurable, enumerable, get, set } = /** @type {PropertyDescriptor} */ (Object.getOwnPropertyDescriptor(kind.prototype, name));
      return `${name} ${[configurable, enumerable, get !== undefined, set !== undefined]}`;
    });
    // What is written down is the same in every run.
    return [...said, ...descriptors].flatMap((line) => line.split('\n'));
  });
  expectRecorded('given', lines);
});

test('what is rendered is what its parts say', async ({ page }) => {
  const widget = await cloudOn(page, 'samples="150" heading-level="2"', '<span slot="title"> A  <b>name</b></span><span slot="title">of\n two</span><p slot="caption">Below</p>');
  await unfold(widget);
  const lines = /** @type {string[]} */ ([]);
  const see = async (/** @type {string} */ when, /** @type {string[]} */ selectors) => {
    await frames(page);
    const htmls = await widget.evaluate((element, all) => {
      const root = /** @type {ShadowRoot} */ (element.shadowRoot);
      return all.map((selector) => [selector, root.querySelector(selector)?.outerHTML ?? 'none', [...root.querySelectorAll(`${selector} input`)].map((input) => /** @type {any} */ (input).value).join(' ')]);
    }, selectors);
    for (const [selector, html, values] of htmls) lines.push(`${when}, ${selector}: ${plain(html)} ${values}`.trimEnd());
  };
  const cloud = ['fieldset.cloud', 'p[role=status]'];
  await see('At first', ['.scheme-probe', '.title-slot', '.caption-slot', 'canvas', '.slider:has(#alpha3)', '.slider:has(#v)', ...cloud, '.exports', '.copies', '.begin', '.presenting', '.progress', '.failure', '.reserved']);
  lines.push(`Name: ${await widget.evaluate((element) => /** @type {any} */ (element).lettering.name)}`);
  lines.push(...await widget.evaluate((element) => {
    const figure = /** @type {any} */ (element);
    const room = figure.kind.elementStyles.find((/** @type {any} */ { cssText }) => /\.reserved,/.test(cssText)).cssText.trim();
    const { position, visibility, transitionDuration } = getComputedStyle(figure.shadowRoot.querySelector('.scheme-probe'));
    return [`Room: ${room}`, `Probe: ${position} ${visibility} ${transitionDuration}`];
  }));
  const act = (/** @type {string} */ code) => widget.evaluate((element, text) => void new Function('figure', 'root', text)(element, element.shadowRoot), code);
  /** @type {[string, string, string[]][]} */
  const acts = [
    ['With other slots', 'figure.querySelector("[slot=title]").remove(); figure.querySelector("[slot=title]").remove(); figure.headingLevel = null', ['.title-slot', '.machine > :first-child']],
    ['Emptied', 'root.querySelectorAll(".cloud button")[2].click()', cloud],
    ['Read again', 'figure.refresh(); figure.requestUpdate()', ['p[role=status]']],
    ['A step on', 'root.querySelectorAll(".cloud button")[1].click()', cloud],
    ['Beyond the slider', 'figure.samples = 2_000_000; figure.settings.want({ command: { v: 5, omega: 1, dt: 1 } })', ['.slider:has(#v)', '.slider:has(#samples)']],
    ['Below the slider', 'figure.samples = 3; figure.settings.want({ command: { v: -5, omega: 1, dt: 1 } })', ['.slider:has(#v)', '.slider:has(#samples)']],
    ['Between', 'figure.samples = 150; figure.v = 1; figure.settings.want({ samples: 7 })', ['.slider:has(#v)', '.slider:has(#samples)']],
    ['Refused', 'figure.typing.refuse("alpha3", "No such noise.")', ['.slider:has(#alpha3)', '.slider:has(#alpha2)']],
    ['Forgotten', 'figure.typing.forget()', ['.slider:has(#alpha3)']],
    ['Told', 'figure.announcer.tell("Something is said."); figure.requestUpdate()', ['p[role=status]']],
    ['Presented', 'figure.presentation = true', ['.presenting']],
    ['With controls', 'window.dispatchEvent(new KeyboardEvent("keydown", { key: "c" }))', ['.presenting']],
    ['No more', 'figure.presentation = false', ['.presenting']],
  ];
  for (const [when, code, selectors] of acts) {
    await act(code);
    await see(when, selectors);
  }
  lines.push(`Rendered for nothing: ${await widget.evaluate((element) => {
    const figure = /** @type {any} */ (element);
    figure.typing.forget();
    return figure.isUpdatePending;
  })}`);
  lines.push(`class ${await widget.evaluate((element) => /** @type {any} */ (element).shadowRoot.querySelector('.surface').className)}`);
  const failed = await widget.evaluate(async (element) => {
    const figure = /** @type {any} */ (element);
    const told = /** @type {string[]} */ ([]);
    element.addEventListener('error', (event) => void told.push(/** @type {ErrorEvent} */ (event).message));
    for (const error of [new Error('It is broken.'), 'a text', { toString: () => { throw new Error('no'); } }, null]) {
      figure.runtime.fail(error);
      await figure.updateComplete;
      told.push(figure.shadowRoot.querySelector('.failure').outerHTML);
    }
    return told;
  });
  lines.push(...failed.map(plain));
  expectRecorded('rendered', lines);
});

test('of a map and a place in another that are given before there is a figure, the map stays, whichever came last', async ({ page }) => {
  await page.goto('/');
  const maps = await page.evaluate(async () => {
    const room = { name: 'room', bounds: [0, 0, 6, 4], walls: [[0, 0, 6, 0]] };
    const found = [];
    for (const order of [['map', 'preset'], ['preset', 'map']]) {
      const figure = /** @type {any} */ (document.createElement('map-squeeze'));
      const given = /** @type {Record<string, unknown>} */ ({ map: room, preset: 'corridor' });
      for (const name of order) figure[name] = given[name];
      const loaded = new Promise((resolve) => figure.addEventListener('load', resolve));
      document.body.prepend(figure);
      scrollTo(0, 0);
      await loaded;
      // What takes long is done for it.
      found.push([figure.getState().map?.name, figure.preset]);
      figure.remove();
    }
    return found;
  });
  expect(maps).toEqual([['room', null], ['room', null]]);
});

test('who turns away from a figure before its first picture comes back to all of it', async ({ page }) => {
  await page.goto('/');
  const controls = await page.evaluate(async () => {
    const figure = /** @type {any} */ (document.createElement('banana-machine'));
    const count = () => figure.renderRoot.querySelectorAll('[part=controls]').length;
    const turned = new Promise((resolve) =>
      figure.addEventListener('load', async () => {
        const before = count();
        figure.stage.sight(false);
        await figure.updateComplete;
        resolve([before, count()]);
      }),
    );
    document.body.prepend(figure);
    scrollTo(0, 0);
    return turned;
  });
  expect(controls).toEqual([0, 1]);
});
