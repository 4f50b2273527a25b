// What every figure does with what it is given, asked and told, much of it on one page: line for line as in
// figure-contract.txt. A change there is to be meant: `UPDATE_CONTRACT=1` writes it anew.

import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect } from '@playwright/test';
import { ready, show } from './element-support.js';
import { STILL, frames, test, unfold } from './support.js';

test.use(STILL);

const FILE = join(import.meta.dirname, 'figure-contract.txt');

/**
 * Compares lines with those that the file has below a title.
 *
 * @param {string} title
 * @param {string[]} given
 */
function expectRecorded(title, given) {
  const lines = given.map((line) => line.trimEnd());
  const sections = new Map(
    readFileSync(FILE, 'utf8').split(/^## /m).slice(1).map((section) => {
      const [name, ...rest] = section.trimEnd().split('\n');
      return [name, rest];
    }),
  );
  if (process.env.UPDATE_CONTRACT) {
    sections.set(title, lines);
    const texts = [...sections].sort(([a], [b]) => (a < b ? -1 : 1)).map(([name, rest]) => `## ${name}\n${rest.join('\n')}\n`);
    writeFileSync(FILE, texts.join('\n'));
  } else {
    expect(lines).toEqual(sections.get(title));
  }
}

/**
 * A page with a small cloud, whole from the start.
 *
 * @param {import('@playwright/test').Page} page
 * @param {string} [attributes]
 * @param {string} [inside]
 */
async function cloudOn(page, attributes = 'samples="150"', inside = '') {
  await show(page, `<p>Above</p><banana-machine ${attributes}>${inside}</banana-machine><p inert>Below</p>`);
  const widget = page.locator('banana-machine');
  await ready(widget);
  return widget;
}

/** HTML without what Lit notes in it, and what the letters of the machine decide. @param {string} html */
const plain = (html) => html.replace(/<!--.*?-->/g, '').replace(/ (width|height)="[1-9]\d*"/g, '').replace(/\s+/g, ' ').replace(/> </g, '><');

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
      ['alpha5', 0.25], ['alpha1', '0.5'], ['alpha4', -1], ['command', { v: 0.25, omega: 1, dt: 2 }], ['command', { v: 0.25 }],
      ['alphas', [1, 2, 3, 4, 5, 6]], ['alphas', undefined], ['model', 'odometry'], ['alpha5', 1], ['alpha4', 0.125],
      ['model', 'bicycle'], ['model', 7], ['model', Symbol('x')], ['model', () => 1], ['model', 1n], ['reverseAware', ''],
      ['reverseAware', 'false'], ['reverseAware', 'no'], ['reverseAware', 'true'], ['reverseAware', null], ['isolate', 2],
      ['isolate', 2.5], ['isolate', undefined], ['seed', '12'], ['seed', -1], ['samples', 100], ['samples', 0], ['marked', 99],
      ['marked', '7'], ['marked', 100], ['marked', -1], ['marked', 1.5], ['marked', 0], ['samples', 50], ['marked', 49], ['samples', 40],
      ['marked', null], ['overlays', ['ellipse', 'command', 'ellipse']], ['overlays', ' linearized\tcommand '], ['overlays', ['stars']],
      ['overlays', 'stars'], ['overlays', 5], ['overlays', null], ['preset', 'hard'], ['preset', 'soft'], ['preset', null],
      ['theme', 'dark'], ['theme', 'blue'], ['theme', 'x'.repeat(41)], ['theme', null], ['theme', 3], ['theme', {}], ['share', true], ['share', false],
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
  const widget = await cloudOn(page, 'samples="150" heading-level="2"', '<span slot="title"> A  <b>name</b>\n</span><span slot="title">of two</span><p slot="caption">Below</p>');
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
  const act = (/** @type {string} */ code) => widget.evaluate((element, text) => void new Function('figure', 'root', text)(element, element.shadowRoot), code);
  /** @type {[string, string, string[]][]} */
  const acts = [
    ['With other slots', 'figure.querySelector("[slot=title]").remove(); figure.querySelector("[slot=title]").remove(); figure.headingLevel = null', ['.title-slot', '.machine > :first-child']],
    ['Emptied', 'root.querySelectorAll(".cloud button")[2].click()', cloud],
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

test('what the reader does is told once, and keys go where they are of use', async ({ page }) => {
  const widget = await cloudOn(page);
  await unfold(widget);
  await widget.evaluate((element) => /** @type {any} */ (element).typing.refuse('v', 'No.'));
  const lines = await widget.evaluate(async (element) => {
    const figure = /** @type {any} */ (element);
    const root = figure.shadowRoot;
    const said = /** @type {string[]} */ ([]);
    let told = /** @type {string[]} */ ([]);
    for (const name of ['input', 'change', 'stats', 'load', 'error']) {
      document.addEventListener(name, (event) => {
        const from = /** @type {Element} */ (event.composedPath()[0]).localName;
        const detail = event instanceof CustomEvent ? ` of ${event.detail.n}` : '';
        told.push(`${name}${detail}${from === 'banana-machine' ? '' : ` from ${from}`}${event.bubbles && event.composed ? '' : ' here'}`);
      }, { capture: name === 'error' });
    }
    const rest = async () => {
      for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
    };
    const note = async (/** @type {string} */ what, /** @type {() => unknown} */ act) => {
      told = [];
      let answer;
      try {
        answer = act();
      } catch (error) {
        answer = `throws ${error}`;
      }
      await rest();
      const { command, shown, playing, marked, alphas, seed } = figure.getState();
      said.push(`${what}: ${told.join(', ')} | ${[command.v, alphas.velocity[0], shown, playing, marked, seed > 0 ? figure.samples : ''].join(' ')} | ${answer === undefined ? '' : JSON.stringify(answer)}`);
    };
    const slider = (/** @type {string} */ id, /** @type {number} */ value, /** @type {string[]} */ names) => () => {
      const input = root.getElementById(id);
      input.value = value;
      for (const name of names) input.dispatchEvent(new Event(name, { bubbles: true, composed: true }));
    };
    const typed = (/** @type {string} */ id, /** @type {string} */ text) => () => {
      const input = root.querySelector(`.slider:has(#${id}) .typed`);
      input.focus();
      input.value = text;
      input.blur();
      figure.requestUpdate();
    };
    const buttons = [...root.querySelectorAll('.cloud button')];
    await note('A step of v', slider('v', 0.5, ['input']));
    await note('Two more and the end', slider('v', 0.25, ['input', 'input', 'change']));
    await note('An end without a step', slider('v', 0.25, ['change']));
    await note('N', slider('samples', 2, ['input', 'change']));
    await note('α₁ and N in one handler', () => {
      slider('alpha1', 0.1, ['input'])();
      slider('samples', 0, ['input'])();
      slider('alpha1', 0.15, ['input', 'change'])();
    });
    for (const [id, text] of [['v', '0.75'], ['v', '1e7'], ['v', '-1,5 m/s'], ['v', 'x'], ['alpha1', '0.3'], ['alpha1', '-1'], ['samples', '120'], ['samples', '0'], ['samples', '2.5'], ['samples', '1 000']]) {
      await note(`Typed ${text} for ${id}`, typed(id, text));
      said.push(`  ${root.querySelector(`.slider:has(#${id})`).className}: ${root.querySelector(`.slider:has(#${id}) .effect`).textContent}`);
    }
    figure.samples = 300;
    for (const [name, at] of [['Reset', 2], ['Step', 1], ['Step', 1], ['Reset', 2]]) await note(String(name), () => buttons[Number(at)].click());
    figure.motion.randomSeed = () => 77;
    await note('New seed', () => buttons[3].click());
    await note('Decided', () => figure.gesture.decide({ samples: 150 }));
    await note('Decided by what is wanted', () => figure.gesture.decide((/** @type {any} */ wanted) => ({ samples: wanted.samples + 1 })));
    await note('Decided wrongly', () => figure.gesture.decide({ samples: -1 }));
    await note('Chosen', () => figure.gesture.choose('overlays', ['command']));
    await note('The page, in part', () => figure.setState({ widget: 'banana-machine', version: 1, shown: 151 }));
    await note('Marked', () => figure.cloud.mark(3));
    await note('Marked by its number', () => {
      const input = root.querySelector('input[type=number]');
      input.value = '9';
      input.dispatchEvent(new Event('input', { bubbles: true, composed: true }));
      input.dispatchEvent(new Event('change', { bubbles: true, composed: true }));
    });
    for (const text of ['0', '152', '1.5', '']) {
      await note(`Marked by ${text}`, () => {
        const input = root.querySelector('input[type=number]');
        input.value = text;
        input.dispatchEvent(new Event('input', { bubbles: true, composed: true }));
        input.dispatchEvent(new Event('change', { bubbles: true, composed: true }));
      });
      said.push(`  ${figure.typing.refusalOf('marked')}`);
    }
    const canvas = root.querySelector('canvas');
    const box = canvas.getBoundingClientRect();
    const pointer = (/** @type {string} */ type, /** @type {string} */ pointerType, /** @type {number} */ share) => () => {
      canvas.dispatchEvent(new PointerEvent(type, { pointerType, clientX: box.left + share * box.width, clientY: box.top + share * box.height, bubbles: true, composed: true }));
    };
    await note('Moved over', pointer('pointermove', 'mouse', 0.6));
    await note('Moved over nothing', pointer('pointermove', 'mouse', 0.01));
    await note('Clicked on nothing', pointer('click', 'mouse', 0.01));
    await note('Moved by a finger', pointer('pointermove', 'touch', 0.6));
    await note('Tapped', pointer('click', 'touch', 0.6));
    await note('The page', () => (figure.v = 0.5));
    await note('The page, in part', () => figure.setState({ widget: 'banana-machine', version: 1, shown: 10, marked: null }));
    await note('The page asks', () => [figure.stats.n, figure.poses.length, figure.twists.length, figure.toCSV().split('\n').length, figure.toCSV().split('\n').slice(0, 2)]);
    await note('Gone in a step', () => {
      slider('v', 0.75, ['input'])();
      const { nextSibling } = element;
      element.remove();
      document.body.insertBefore(element, nextSibling);
    });

    // Keys that are used stay inside, any other goes on.
    const targets = { field: '.typed', slider: 'input[type=range]', radio: 'input[type=radio]', box: 'input[type=checkbox]', number: 'input[type=number]', button: 'button', summary: 'summary' };
    const heard = /** @type {string[]} */ ([]);
    document.addEventListener('keydown', ({ key }) => void heard.push(key));
    for (const [name, selector] of Object.entries(targets)) {
      for (const modifiers of [{}, { ctrlKey: true }, { altKey: true }, { metaKey: true }, { shiftKey: true }]) {
        heard.length = 0;
        for (const key of ['Escape', 'q', 'ArrowLeft', 'PageUp', 'Home', 'End', 'Enter', 'Tab', ' ']) {
          root.querySelector(selector).dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true, composed: true, cancelable: true, ...modifiers }));
        }
        said.push(`${name} ${Object.keys(modifiers)} leaves ${heard.join(' ')}`);
      }
    }
    const prevented = new KeyboardEvent('keydown', { key: 'q', bubbles: true, composed: true, cancelable: true });
    heard.length = 0;
    prevented.preventDefault();
    root.querySelector('button').dispatchEvent(prevented);
    said.push(`prevented leaves ${heard}`);
    return said;
  });
  expectRecorded('told', lines);
});

test('a figure before an audience fills the window, and all is as before when it ends', async ({ page }) => {
  await page.setViewportSize({ width: 1440, height: 1080 });
  const widget = await cloudOn(page, 'samples="150" style="display: block; margin-top: 40px"');
  await page.evaluate(() => {
    // It is not asked for.
    Object.defineProperty(document, 'fullscreenEnabled', { value: false });
    document.body.style.height = '4000px';
    document.documentElement.style.overflow = 'clip';
    scrollTo(0, 30);
  });
  await frames(page);
  const lines = /** @type {string[]} */ ([]);
  const note = async (/** @type {string} */ what, /** @type {() => Promise<unknown>} */ act) => {
    await act();
    await frames(page);
    lines.push(`${what}: ${await widget.evaluate((element) => {
      const figure = /** @type {any} */ (element);
      const root = figure.shadowRoot;
      return [
        figure.presentation, figure.presenting.zoom, element.style.getPropertyValue('--zoom'), root.querySelector('.surface').className.trim(),
        root.querySelector('.presenting button')?.getAttribute('aria-pressed'), root.activeElement?.className, root.activeElement?.getAttribute('aria-pressed'),
        document.documentElement.style.overflow, scrollY, [...document.querySelectorAll('[inert]')].map(({ localName }) => localName).join(' '),
        (root.querySelector('canvas').width / root.querySelector('canvas').clientWidth).toFixed(1),
      ].map(String).join(' | ');
    })}`);
  };
  const key = (/** @type {Record<string, any>} */ init, prevented = false) => () => page.evaluate(([given, isPrevented]) => {
    const event = new KeyboardEvent('keydown', { cancelable: true, ...given });
    if (isPrevented) event.preventDefault();
    dispatchEvent(event);
  }, /** @type {const} */ ([init, prevented]));
  const set = (/** @type {boolean} */ on) => () => widget.evaluate((element, to) => void (/** @type {any} */ (element).presentation = to), on);
  await note('At first', async () => {});
  await note('A key before', key({ key: 'c' }));
  await note('Presented', set(true));
  await note('Presented again', set(true));
  for (const init of [{ key: 'c', ctrlKey: true }, { key: 'c', altKey: true }, { key: 'c', metaKey: true }, { key: 'x' }, { key: 'c', shiftKey: true }, { key: 'C' }, { key: 'Escape', ctrlKey: true }]) {
    await note(JSON.stringify(init), key(init));
  }
  await note('c, used by the page', key({ key: 'c' }, true));
  await note('c', key({ key: 'c' }));
  await note('In a small window', () => page.setViewportSize({ width: 900, height: 500 }));
  await note('In a wide window', () => page.setViewportSize({ width: 2560, height: 1080 }));
  await note('Escape', key({ key: 'Escape' }));
  await note('A key after', key({ key: 'c' }));
  await note('By its button', () => widget.locator('.to-present').click());
  await note('Controls by their button', () => widget.locator('.presenting button').first().click());
  await note('Left by its button', () => widget.locator('.presenting button').last().click());
  await note('Once more', set(true));
  await note('Taken away and back', () => widget.evaluate(async (element) => {
    const parent = /** @type {Element} */ (element.parentNode);
    element.remove();
    await new Promise(requestAnimationFrame);
    parent.prepend(element);
  }));
  await note('In no full screen', () => widget.evaluate((element) => void element.dispatchEvent(new Event('fullscreenchange'))));
  expectRecorded('presented', lines);
});

test('work that takes long is done in slices of the time that a frame has for it, with progress', async ({ page }) => {
  await show(page, '<map-squeeze samples="300"></map-squeeze>');
  const widget = page.locator('map-squeeze');
  await ready(widget);
  const lines = await widget.evaluate(async (element) => {
    const figure = /** @type {any} */ (element);
    const said = /** @type {string[]} */ ([]);
    const root = figure.shadowRoot;
    // A clock that goes on by ten milliseconds with each slice of work.
    let time = performance.now();
    performance.now = () => time;
    let calls = 0;
    let left = 0;
    let told = /** @type {string[]} */ ([]);
    for (const name of ['input', 'change', 'stats', 'error']) {
      element.addEventListener(name, (event) => {
        told.push(name);
        // The page asks nothing.
        event.stopPropagation();
      });
    }
    const { machine } = figure;
    const { advance } = Object.getPrototypeOf(machine);
    Object.defineProperty(machine, 'progress', { get: () => 1 - left / 100 });
    machine.advance = (/** @type {number} */ work) => {
      calls++;
      time += 10;
      if (left > 0) left--;
      return left > 0 ? false : advance.call(machine, work * 1000);
    };
    const note = async (/** @type {string} */ what, /** @type {() => unknown} */ act) => {
      [calls, told] = [0, []];
      let answer = act();
      for (let [frame, idle] = [0, 0]; frame < 10 && idle < 3; frame++) {
        idle = calls || told.length ? 0 : idle + 1;
        const shown = root.querySelector('.progress');
        said.push(`${frame === 0 ? what : ` ${frame}`}: ${calls} ${told.join(' ')} | ${figure.settings.stale} ${figure.settings.done.toFixed(2)} ${shown ? shown.textContent.replace(/\s+/g, ' ') : ''} ${shown?.querySelector('progress').value.toFixed(2) ?? ''} | ${root.querySelector('[role=status]')?.textContent} | ${machine.config.seed} ${figure.settings.wanted.seed} ${figure.settings.told.seed} ${machine.shown} ${JSON.stringify(answer) ?? ''}`);
        [calls, told, answer] = [0, [], undefined];
        await new Promise(requestAnimationFrame);
        await figure.updateComplete;
      }
    };
    await note('At rest', () => {});
    left = 28;
    await note('Slices by the page', () => void (figure.seed = 5));
    left = 100;
    await note('A hundred slices by the reader', () => figure.gesture.decide({ seed: 6 }));
    await note('What is wanted meanwhile', () => figure.settings.want({ seed: 7 }));
    await note('A key that is another', () => void root.querySelector('canvas').dispatchEvent(new KeyboardEvent('keydown', { key: 'x', bubbles: true, composed: true })));
    await note('Escape', () => {
      const event = new KeyboardEvent('keydown', { key: 'Escape', bubbles: true, composed: true, cancelable: true });
      let heard = false;
      document.addEventListener('keydown', () => (heard = true), { once: true });
      root.querySelector('canvas').dispatchEvent(event);
      return [heard, event.defaultPrevented];
    });
    left = 0;
    await note('Nothing more to do', () => {});
    left = 50;
    await note('Fifty, and asked for at once', () => {
      figure.seed = 8;
      return [figure.stats.n, figure.seed];
    });
    left = 30;
    await note('A step that takes long', () => {
      machine.restart();
      figure.cloud.playing = true;
      figure.stage.wake();
    });
    left = 0;
    figure.cloud.playing = false;
    await note('Stopped for good', () => figure.settings.stop());
    return said;
  });
  expectRecorded('sliced', lines);
});

test('a cloud grows before the eyes of a reader who likes that, step by step', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'no-preference' });
  await show(page, '<main></main>');
  const lines = await page.evaluate(async () => {
    const said = /** @type {string[]} */ ([]);
    const main = /** @type {HTMLElement} */ (document.querySelector('main'));
    main.innerHTML = '<banana-machine samples="301"></banana-machine>';
    const figure = /** @type {any} */ (main.firstElementChild);
    figure.marked = 300;
    const shown = /** @type {number[]} */ ([]);
    figure.addEventListener('stats', () => {
      if (shown.push(figure.machine.shown) === 4) figure.cloud.play();
    });
    const note = (/** @type {string} */ what) => {
      const { cloud } = figure;
      const { marked, shown: at, playing, samples } = figure.getState() ?? {};
      const buttons = [...(figure.shadowRoot?.querySelectorAll('.cloud button') ?? [])].map(({ innerText, disabled, title }) => `${innerText}${disabled ? ' (off)' : ''} ${title}`);
      const { complete, asked, growing, isMarked, markable, index } = figure.machine ? cloud : /** @type {any} */ ({});
      said.push(`${what}: ${JSON.stringify({ marked, at, playing, samples, complete, asked, growing, isMarked, markable, index })} ${buttons.join('; ')}`);
    };
    note('Before');
    await new Promise((resolve) => figure.addEventListener('load', resolve, { once: true }));
    note('Loaded');
    const rest = async () => {
      for (let i = 0; i < 5; i++) await new Promise(requestAnimationFrame);
    };
    while (shown.length < 4) await new Promise(requestAnimationFrame);
    await rest();
    note('Paused');
    said.push(`Steps: ${shown.slice(0, 4)}`);
    figure.cloud.step();
    await rest();
    note('A step');
    figure.setState({ widget: 'banana-machine', version: 1, shown: 298, playing: true });
    while (figure.playing) await new Promise(requestAnimationFrame);
    await rest();
    note('Whole');
    said.push(`Status: ${figure.shadowRoot.querySelector('[role=status]').textContent}`);
    figure.cloud.play();
    note('Again');
    figure.cloud.reset();
    await rest();
    note('Emptied');
    figure.cloud.unmark();
    note('Unmarked');
    const { seed } = figure;
    figure.cloud.reseed();
    await rest();
    said.push(`Another seed: ${figure.seed !== seed}`);
    // An element without its cloud on the page any more.
    figure.remove();
    await new Promise(requestAnimationFrame);
    figure.cloud.play();
    figure.cloud.step();
    said.push(JSON.stringify([figure.stats, figure.getState().shown, figure.playing, figure.poses]));
    return said;
  });
  expectRecorded('grown', lines);
});

test('the address has a part for each figure, by its id or its place, and nothing else is touched', async ({ page }) => {
  await show(
    page,
    '<div style="position: fixed; inset: 0"><banana-machine share samples="20"></banana-machine><banana-machine id="ä b" share samples="20"></banana-machine><div id="host"></div><arc-anatomy></arc-anatomy></div>',
    { fragment: '#top&other=1&' },
  );
  const lines = await page.evaluate(async () => {
    const said = /** @type {string[]} */ ([]);
    const root = /** @type {Element} */ (document.querySelector('#host')).attachShadow({ mode: 'open' });
    root.innerHTML = '<p></p><banana-machine samples="20"></banana-machine>';
    const figures = [...document.querySelectorAll('banana-machine'), ...root.querySelectorAll('banana-machine')].map((each) => /** @type {any} */ (each));
    for (const figure of figures) await figure.runtime.hasten();
    const names = () => location.hash.replace(/=[^&]{20,}/g, '=…');
    const rest = async () => {
      await new Promise((resolve) => setTimeout(resolve));
      for (let i = 0; i < 4; i++) await new Promise(requestAnimationFrame);
    };
    said.push(`At first ${names()}`);
    for (const [i, figure] of figures.entries()) {
      const link = await figure.shareLink();
      said.push(`Link of ${i}: ${new URL(link).hash.replace(/=[^&]{20,}/g, '=…')} ${/^[\w-]+$/.test(link.split('=').at(-1))}`);
    }
    const { length } = history;
    for (const [i, figure] of figures.entries()) {
      figure.gesture.decide({ seed: 40 + i });
      await rest();
      while (i < 2 && !location.hash.includes(await figure.shareLink().then((/** @type {string} */ link) => link.split('=').at(-1)))) await rest();
      said.push(`Changed ${i}: ${names()} ${history.length - length}`);
    }
    // What comes by the address is entered; what is broken is told.
    const errors = /** @type {string[]} */ ([]);
    for (const [i, figure] of figures.entries()) figure.addEventListener('error', (/** @type {ErrorEvent} */ event) => void errors.push(`${i} ${event.error.name} ${event.message}`));
    const text = await figures[0].shareLink().then((/** @type {string} */ link) => new URL(link).hash.split('&').find((/** @type {string} */ part) => part.startsWith('banana-machine.1='))?.split('=')[1]);
    const follow = async (/** @type {string} */ hash) => {
      errors.length = 0;
      const heard = new Promise((resolve) => addEventListener('hashchange', resolve, { once: true }));
      location.hash = hash;
      await heard;
      await rest();
      await rest();
      said.push(`${hash.replace(/=[^&]{20,}/g, '=…')}: ${figures.map(({ seed }) => seed)} ${errors.map((error) => error.replace(/"[\w-]{20}"/, '…'))}`);
    };
    await follow(`#banana-machine:${encodeURIComponent('ä b')}=${text}`);
    await follow(`#x&host/banana-machine.1=${text}`);
    await follow(`#div:host/banana-machine.1=${text}`);
    await follow('#banana-machine.1=%%%');
    await follow('#banana-machine.1=');
    await follow('#banana-machine.11=abc&banana-machine.2=abc');
    await follow(`#banana-machine.1=${text?.slice(0, 20)}`);
    await follow(`#${'banana-machine.1=AAAA&'.repeat(2)}end`);
    return said;
  });
  expectRecorded('addressed', lines);
});

test('what is taken along is named, copied and saved as the menus say, before the figure is there and after', async ({ page }) => {
  await show(page, '<div style="height: 3000px"></div><banana-machine samples="20" theme="light" lang="en" style="width: 500px"><i slot="title">One &amp; two</i></banana-machine>');
  const widget = page.locator('banana-machine');
  await frames(page);
  const lines = await widget.evaluate(async (element) => {
    const figure = /** @type {any} */ (element);
    const said = /** @type {string[]} */ ([]);
    const asked = async (/** @type {string} */ what, /** @type {() => any} */ question) => {
      let answer;
      try {
        answer = await question();
      } catch (error) {
        answer = `throws ${error}`;
      }
      said.push(`${what}: ${typeof answer === 'string' ? answer : JSON.stringify(answer)}`);
    };
    const ask = async (/** @type {string} */ when) => {
      await asked(`${when}, stats`, () => figure.stats && figure.stats.n);
      await asked(`${when}, state`, () => figure.getState() && Object.keys(figure.getState()));
      await asked(`${when}, poses`, () => figure.poses && figure.poses.length);
      await asked(`${when}, v`, () => figure.v);
      await asked(`${when}, overlays`, () => figure.overlays);
      await asked(`${when}, PNG`, async () => {
        const { type, size } = await figure.toPNG();
        return `${type} ${size > 1000}`;
      });
      await asked(`${when}, SVG`, () => figure.toSVG().replace(/(width|height)="\d+"/g, '$1').replace(/viewBox="[^"]*"/, '').split('\n').slice(0, 4).join(' '));
      await asked(`${when}, CSV`, () => figure.toCSV().split('\n').slice(0, 2).concat(figure.toCSV().split('\n').length).join(' '));
      await asked(`${when}, link`, async () => new URL(await figure.shareLink()).hash.split('=')[0]);
      await asked(`${when}, code`, () => figure.embedCode().replace(/https?:\/\/[^/]+/, '').replaceAll('\n', ' '));
    };
    figure.v = 0.5;
    await ask('Before');
    said.push(figure.shadowRoot.querySelector('.reserved').outerHTML);
    await figure.runtime.hasten();
    await figure.updateComplete;
    await ask('Then');
    const { shadowRoot: root } = figure;

    // Out of sight nothing is drawn.
    said.push(`In sight ${figure.stage.inSight}, opening ${figure.stage.opening}`);
    const clipboard = (/** @type {unknown} */ value) => Object.defineProperty(navigator, 'clipboard', { value, configurable: true });
    /** @type {string} */
    let written;
    const kinds = {
      taken: { writeText: async (/** @type {string} */ text) => void (written = text) },
      refused: { writeText: () => Promise.reject(new Error('no')) },
      absent: undefined,
    };
    for (const [kind, value] of Object.entries(kinds)) {
      clipboard(value);
      for (const button of root.querySelectorAll('.copies button')) {
        written = '';
        button.click();
        // The state is packed in a stream.
        for (let i = 0; i < 10; i++) await new Promise((resolve) => setTimeout(resolve));
        for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
        const field = root.querySelector('.copies textarea');
        const brief = (/** @type {string} */ text) => text.replace(/^http.*#(.*)=.*$/s, 'link $1').replace(/https?:\/\/[^/]+/, '').replaceAll('\n', ' ');
        said.push(`Copied, ${kind}: ${brief(written)} | ${root.querySelector('output').textContent} | ${field ? `${brief(field.value)} ${field.rows} ${field.readOnly} ${field.getAttribute('aria-label')}` : ''}`);
      }
    }
    const { click } = HTMLAnchorElement.prototype;
    const { revokeObjectURL } = URL;
    const { setTimeout: later } = window;
    const blobs = new Map();
    const { createObjectURL } = URL;
    URL.createObjectURL = (/** @type {any} */ blob) => {
      const url = createObjectURL(blob);
      blobs.set(url, blob);
      return url;
    };
    /** @type {any} */ (window).setTimeout = (/** @type {() => void} */ work, /** @type {number} */ time) => {
      if (time !== 60_000) return later(work, time);
      said.push('Kept for a minute');
      work();
    };
    URL.revokeObjectURL = (url) => void said.push(`Given back ${blobs.get(url).type}`);
    HTMLAnchorElement.prototype.click = function () {
      said.push(`Saved ${this.download} ${blobs.get(this.href).type}`);
    };
    for (const button of root.querySelectorAll('.exports button')) {
      const { length } = said;
      button.click();
      while (said.length < length + 3) await new Promise((resolve) => later(resolve));
    }
    Object.assign(HTMLAnchorElement.prototype, { click });
    Object.assign(URL, { createObjectURL, revokeObjectURL });
    Object.assign(window, { setTimeout: later });
    element.remove();
    await new Promise((resolve) => setTimeout(resolve));
    await ask('Gone');
    return said;
  });
  expectRecorded('taken along', lines);
});

test('a figure takes its ground from what is around it, and paper is light', async ({ page }) => {
  await cloudOn(page);
  const lines = await page.evaluate(async () => {
    const figure = /** @type {any} */ (document.querySelector('banana-machine'));
    const around = document.body;
    const said = /** @type {string[]} */ ([]);
    const note = (/** @type {string} */ what) => {
      const { palette } = figure.stage;
      const surface = figure.shadowRoot.querySelector('.surface');
      said.push(`${what}: ${surface.style.cssText} | ${palette.paper} ${palette.ink} ${palette.cloud}`);
    };
    const settle = async () => {
      for (let i = 0; i < 4; i++) await new Promise(requestAnimationFrame);
    };
    note('At first');
    for (const css of [
      'background: #123; color: #eee', 'background: rgb(0 0 0 / 50%); color: white', 'background: #fffbe6; color: #430', 'background: url(data:,) ; color: #ddd',
      'background: linear-gradient(black, black); color: white; color-scheme: dark', 'color: #777', '',
    ]) {
      around.style.cssText = css;
      figure.stage.recolour();
      await settle();
      note(css);
    }
    around.style.cssText = 'background: #222; color: #ddd';
    for (const theme of ['light', 'dark', 'auto']) {
      figure.theme = theme;
      await settle();
      note(`${theme} on dark`);
    }
    dispatchEvent(new Event('beforeprint'));
    note('On paper');
    dispatchEvent(new Event('afterprint'));
    note('And back');
    // What fades is heard of where it is around the figure, and nothing else.
    let count = 0;
    const { recolour } = figure.stage;
    figure.stage.recolour = function () {
      count++;
      recolour.call(this);
    };
    const faded = (/** @type {Element} */ target, /** @type {string} */ propertyName) => target.dispatchEvent(new TransitionEvent('transitionend', { propertyName, bubbles: true }));
    for (const [where, target] of /** @type {[string, Element][]} */ ([['the body', around], ['the root', document.documentElement], ['a neighbour', document.querySelector('p')]])) {
      for (const name of ['background-color', 'color']) {
        count = 0;
        faded(target, name);
        said.push(`${name} of ${where} has faded: ${count}`);
      }
    }
    const probe = figure.shadowRoot.querySelector('.scheme-probe');
    for (const type of ['transitionend', 'transitioncancel', 'transitionstart']) {
      count = 0;
      probe.dispatchEvent(new TransitionEvent(type));
      said.push(`${type} of the probe: ${count}`);
    }
    count = 0;
    for (const name of ['theme', 'heading-level', 'share', 'seed', 'class']) {
      figure.setAttribute(name, name === 'theme' ? 'dark' : '2');
      said.push(`${name}: ${count}`);
    }
    figure.setAttribute('theme', 'dark');
    said.push(`The same theme: ${count}`);
    return said;
  });
  expectRecorded('grounds', lines);
});

test('a core that traps is made again three times, and then a sentence says that it cannot run', async ({ page }) => {
  await show(page, '<banana-machine samples="40" seed="9"></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  const lines = await widget.evaluate(async (element) => {
    const figure = /** @type {any} */ (element);
    const said = /** @type {string[]} */ ([]);
    let told = /** @type {string[]} */ ([]);
    for (const name of ['load', 'error', 'change']) element.addEventListener(name, (event) => void told.push(`${name} ${Reflect.get(event, 'message') ?? ''}`.trim()));
    const { runtime } = figure;
    const trap = () => {
      throw new WebAssembly.RuntimeError('unreachable');
    };
    const rest = async () => {
      for (let i = 0; i < 5; i++) await new Promise(requestAnimationFrame);
      for (let i = 0; i < 50 && !figure.machine && runtime.failure === undefined; i++) await new Promise((resolve) => setTimeout(resolve, 20));
      for (let i = 0; i < 5; i++) await new Promise(requestAnimationFrame);
    };
    const note = async (/** @type {string} */ what, /** @type {() => unknown} */ act) => {
      told = [];
      const { machine, motion } = figure;
      let answer;
      try {
        answer = JSON.stringify(await act());
      } catch (error) {
        answer = `throws ${error}`;
      }
      const between = `${figure.machine === undefined} ${figure.seed}`;
      await rest();
      const { shadowRoot: root } = figure;
      said.push(`${what}: ${answer} | ${between} | ${told.join(', ')} | ${[figure.machine === machine, figure.motion === motion, figure.seed, figure.getState()?.shown, runtime.failure, root.querySelector('.failure')?.textContent, root.querySelectorAll('canvas').length].join(' ')}`);
    };
    await note('Well', () => runtime.attempt(() => 5));
    await note('Refused', () => runtime.attempt(() => { throw new RangeError('x is 1'); }));
    await note('Tolerated', () => runtime.tolerate(() => { throw new RangeError('x is 1'); }));
    await note('Tolerated well', () => runtime.tolerate(() => 5));
    await note('A trap', () => runtime.attempt(trap));
    await note('A tolerated trap', () => runtime.tolerate(trap));
    await note('Traps that are proven wrong', () => {
      for (let i = 0; i < 2; i++) runtime.attempt(trap);
      runtime.prove();
    });
    await note('Three', () => {
      for (let i = 0; i < 3; i++) runtime.attempt(trap);
      runtime.prove();
    });
    await note('Where none hears', () => runtime.attemptOrFail(() => 7));
    await note('Gone and back', () => {
      const { parentNode } = element;
      element.remove();
      /** @type {Element} */ (parentNode).append(element);
    });
    await note('Four, and no picture between', async () => {
      runtime.prove = () => {};
      for (let i = 0; i < 4; i++) {
        runtime.attemptOrFail(trap);
        await rest();
      }
      delete runtime.prove;
    });
    await note('Asked then', () => [figure.stats, figure.getState()?.seed, figure.poses]);
    await note('Back on the page', async () => {
      const { parentNode } = element;
      element.remove();
      await new Promise((resolve) => setTimeout(resolve));
      /** @type {Element} */ (parentNode).append(element);
    });
    await note('Failed of a refusal', () => runtime.attemptOrFail(() => { throw new RangeError('y is 2'); }));
    return said;
  });
  expectRecorded('trapped', lines);
});
