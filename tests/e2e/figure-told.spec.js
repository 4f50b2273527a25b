import { cloudOn, expectRecorded } from './figure-contract.js';
import { STILL, frames, test, unfold } from './support.js';

test.use(STILL);

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
    const moved = () => {
      const { nextSibling } = element;
      element.remove();
      document.body.insertBefore(element, nextSibling);
    };
    await note('Moved before anything', moved);
    await note('An end before any step', slider('v', 1, ['change']));
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
    // Where the robot with a number is drawn.
    const pointed = (/** @type {string} */ type, /** @type {string} */ pointerType, /** @type {number} */ index) => () => {
      const { poses, pictures: [{ view }] } = figure;
      const [x, y] = poses.subarray(3 * index);
      const { left, top } = canvas.getBoundingClientRect();
      canvas.dispatchEvent(new PointerEvent(type, { pointerType, clientX: left + view.toPixelX(x), clientY: top + view.toPixelY(y), bubbles: true, composed: true }));
    };
    await note('Moved over one', pointed('pointermove', 'mouse', 0));
    await note('Moved over one by a finger', pointed('pointermove', 'touch', 7));
    await note('A finger on one', pointed('pointerdown', 'touch', 7));
    await note('One tapped', pointed('click', 'touch', 7));
    await note('One clicked on', pointed('click', 'mouse', 0));
    Object.defineProperty(figure, 'held', { value: true, configurable: true });
    await note('Moved over one with a handle held', pointed('pointermove', 'mouse', 7));
    delete figure.held;
    await note('Moved over nothing', pointer('pointermove', 'mouse', 0.01));
    await note('Clicked on nothing', pointer('click', 'mouse', 0.01));
    await note('The page', () => (figure.v = 0.5));
    await note('The page, in part', () => figure.setState({ widget: 'banana-machine', version: 1, shown: 10, marked: null }));
    await note('The page asks', () => [figure.stats.n, figure.poses.length, figure.twists.length, figure.toCSV().split('\n').length, figure.toCSV().split('\n').slice(0, 2)]);
    await note('Gone in a step', () => {
      slider('v', 0.75, ['input'])();
      moved();
    });
    await note('Gone after a step', async () => {
      slider('v', 0.5, ['input'])();
      await Promise.resolve();
      moved();
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
    Object.assign(window, { asked: 0 });
    Element.prototype.requestFullscreen = () => {
      Object.assign(window, { asked: Reflect.get(window, 'asked') + 1 });
      return Promise.reject();
    };
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
  await note('Left and begun at once', () => widget.evaluate((element) => {
    const figure = /** @type {any} */ (element);
    scrollTo(0, 10);
    figure.presentation = false;
    figure.presentation = true;
  }));
  await note('In no full screen', () => widget.evaluate((element) => void element.dispatchEvent(new Event('fullscreenchange'))));
  await note('Begun and left at once', () => widget.evaluate((element) => {
    const figure = /** @type {any} */ (element);
    figure.presentation = true;
    figure.presentation = false;
  }));
  await note('Once more', set(true));
  await note('Left with the screen, which takes a while and the scrolling with it', () => widget.evaluate(async (element) => {
    const left = new Promise((resolve) => setTimeout(() => {
      scrollTo(0, 0);
      document.body.tabIndex = -1;
      document.body.focus();
      resolve(undefined);
    }, 100));
    const { matches } = Element.prototype;
    Object.assign(element, { matches: (/** @type {string} */ selector) => selector === ':fullscreen' || matches.call(element, selector) });
    document.exitFullscreen = () => /** @type {Promise<any>} */ (left);
    /** @type {any} */ (element).presentation = false;
    await left;
  }));
  lines.push(`Asked for the screen: ${await page.evaluate(() => Reflect.get(window, 'asked'))}`);
  expectRecorded('presented', lines);
});
