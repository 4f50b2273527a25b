import { expect } from '@playwright/test';
import { ALL, ready, show } from './element-support.js';
import { expectRecorded } from './figure-contract.js';
import { STILL, test, unfold } from './support.js';

test.use(STILL);

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
    await note('A key that is another, and other words', () => {
      root.querySelector('canvas').dispatchEvent(new KeyboardEvent('keydown', { key: 'x', bubbles: true, composed: true }));
      figure.announcer.tell('Other words.');
    });
    await note('Escape', () => {
      const event = new KeyboardEvent('keydown', { key: 'Escape', bubbles: true, composed: true, cancelable: true });
      let heard = false;
      document.addEventListener('keydown', () => (heard = true), { once: true });
      root.querySelector('canvas').dispatchEvent(event);
      return [heard, event.defaultPrevented];
    });
    left = 0;
    await note('Nothing more to do', () => {});
    left = 26;
    await note('Two slices in the last frame, and a picture in the next', () => figure.gesture.decide({ seed: 3 }));
    left = 50;
    await note('Fifty, and asked for at once', () => {
      figure.seed = 8;
      return [figure.stats.attempts, figure.seed];
    });
    left = 50;
    await note('Fifty, with another wanted, and asked for at once', () => {
      figure.seed = 9;
      figure.settings.want({ seed: 10 });
      return [figure.stats.attempts, figure.seed];
    });
    for (const ways of [['noise', 'alphas'], ['alphas', 'noise']]) {
      for (const key of ways) figure.settings.want({ [key]: key === 'noise' ? 0.25 : [1, 2, 3, 4, 5, 6] });
      said.push(`Wanted ${ways}: ${figure.settings.wanted.alphas} ${figure.noise} ${figure.alphas}`);
    }
    figure.preset = null;
    // What was wanted so far is done for who asks for figures.
    void figure.stats;
    left = 30;
    await note('A step that takes long', () => {
      machine.restart();
      figure.cloud.playing = true;
      figure.stage.wake();
    });
    left = 0;
    figure.cloud.playing = false;
    await note('Stopped for good', () => figure.settings.stop());
    await note('Stopped where nothing goes on', () => figure.settings.stop());
    left = 50;
    await note('A step again', () => {
      machine.restart();
      figure.cloud.playing = true;
      figure.stage.wake();
    });
    figure.settings.stop();
    said.push(`Stopped, playing: ${figure.cloud.playing}`);
    left = 0;
    await note('Played after that', () => figure.cloud.play());
    figure.setState({ ...figure.getState(), map: { name: 'hut', bounds: [0, 0, 4, 4], walls: [[0, 0, 4, 0], [0, 0, 0, 4]] } });
    said.push(`A state that needs no slices: ${figure.state.own.map?.name} ${figure.settings.next}`);
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
    const framesOf = /** @type {number[]} */ ([]);
    let count = 0;
    const counted = () => {
      count++;
      requestAnimationFrame(counted);
    };
    requestAnimationFrame(counted);
    figure.addEventListener('stats', () => {
      framesOf.push(count);
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
    said.push(`Plays: ${figure.playing}`);
    await new Promise((resolve) => figure.addEventListener('load', resolve, { once: true }));
    note('Loaded');
    const rest = async () => {
      for (let i = 0; i < 5; i++) await new Promise(requestAnimationFrame);
    };
    while (shown.length < 4) await new Promise(requestAnimationFrame);
    await rest();
    note('Paused');
    said.push(`Steps: ${shown.slice(0, 4)}, a frame each: ${[2, 3].map((step) => framesOf[step] - framesOf[step - 1])}`);
    figure.cloud.step();
    await rest();
    note('A step');
    figure.cloud.play();
    note('Gone on');
    figure.cloud.play();
    figure.setState({ widget: 'banana-machine', version: 1, shown: 298, playing: true });
    while (figure.playing) await new Promise(requestAnimationFrame);
    await rest();
    note('Whole');
    figure.marked = 300;
    note('Marked');
    figure.setState({ widget: 'banana-machine', version: 1, shown: 300, marked: 299 });
    note('Marked, and less shown');
    figure.setState({ widget: 'banana-machine', version: 1, shown: 301, marked: null });
    await rest();
    said.push(`Status: ${figure.shadowRoot.querySelector('[role=status]').textContent}`);
    figure.cloud.play();
    note('Again');
    figure.cloud.reset();
    figure.marked = null;
    figure.setState({ widget: 'banana-machine', version: 1, shown: 1, marked: 0 });
    note('The first marked');
    figure.cloud.reset();
    await rest();
    note('Emptied');
    figure.cloud.unmark();
    note('Unmarked');
    const { seed } = figure;
    figure.cloud.reseed();
    await rest();
    said.push(`Another seed: ${figure.seed !== seed}`);
    // What cannot be stopped is told of by nothing but its end.
    const { now } = performance;
    let time = now.call(performance);
    performance.now = () => time;
    let slices = 40;
    figure.machine.advance = () => {
      time += 10;
      return --slices < 0;
    };
    figure.seed = 5;
    let told = '';
    while (figure.settings.stale) {
      await new Promise(requestAnimationFrame);
      told += figure.shadowRoot.querySelector('.progress')?.textContent ?? '';
    }
    said.push(`In silence: ${slices} ${told}`);
    delete figure.machine.advance;
    performance.now = now;

    // The view eases, but not what is taken along.
    figure.setState({ widget: 'banana-machine', version: 1, shown: 301, playing: false });
    await rest();
    figure.v = 1.5;
    const atOnce = figure.toSVG();
    for (let i = 0; i < 60; i++) await new Promise(requestAnimationFrame);
    const views = figure.pictures.map((/** @type {any} */ { view }) => view.ease(0, false));
    said.push(`The same later: ${figure.toSVG() === atOnce}, with the views on their way: ${views}`);
    for (const tag of ['map-squeeze', 'odometry-decomposer', 'dead-reckoning']) {
      const other = /** @type {any} */ (document.createElement(tag));
      const opened = new Promise((resolve) => other.addEventListener('load', () => resolve([other.machine.shown, other.playing]), { once: true }));
      main.prepend(other);
      said.push(`${tag} opens with ${await opened}`);
      other.remove();
    }
    for (const tag of ['map-squeeze', 'arc-anatomy']) {
      const other = document.createElement(tag);
      said.push(`${tag} has ${['playing', 'marked', 'poses'].filter((name) => name in other)}`);
    }
    // It is told how long ago the frame before was, of which it makes the steps of its views.
    const spans = /** @type {boolean[]} */ ([]);
    const { frame } = figure.stage;
    let before = NaN;
    figure.stage.frame = function (/** @type {number} */ elapsed) {
      const now = Number(document.timeline.currentTime);
      if (!Number.isNaN(before)) spans.push(Math.abs(elapsed - Math.min(100, now - before)) < 1);
      before = now;
      frame.call(this, elapsed);
      figure.stage.wake();
    };
    figure.stage.wake();
    while (spans.length < 5) await new Promise(requestAnimationFrame);
    figure.stage.frame = frame;
    said.push(`Told of the time: ${spans}`);

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

test('a core that traps is made again three times, and then a sentence says that it cannot run', async ({ page }) => {
  await show(page, '<banana-machine samples="40" seed="9"></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  const lines = await widget.evaluate(async (element) => {
    const figure = /** @type {any} */ (element);
    const said = /** @type {string[]} */ ([]);
    let told = /** @type {string[]} */ ([]);
    for (const name of ['load', 'error', 'input', 'change']) element.addEventListener(name, (event) => void told.push(`${name} ${Reflect.get(event, 'message') ?? ''}`.trim()));
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
    await note('Hastened again', async () => {
      await runtime.hasten();
    });
    await note('Refused', () => runtime.attempt(() => { throw new RangeError('x is 1'); }));
    await note('Tolerated', () => runtime.tolerate(() => { throw new RangeError('x is 1'); }));
    await note('Tolerated well', () => runtime.tolerate(() => 5));
    await note('A trap', () => runtime.attempt(trap));
    await note('A tolerated trap', () => runtime.tolerate(trap));
    await note('Decided while it is mended', () => {
      runtime.attempt(trap);
      figure.gesture.decide({ seed: 4 });
    });
    await note('A trap in a frame, which proves nothing', async () => {
      const { machine } = figure;
      let proven = false;
      runtime.prove = () => void (proven ||= !figure.machine);
      machine.begin = trap;
      // The page asks nothing.
      element.addEventListener('input', (event) => event.stopPropagation(), { once: true });
      figure.settings.want({ seed: 4 });
      while (figure.machine === machine) await new Promise(requestAnimationFrame);
      delete runtime.prove;
      return proven;
    });
    await note('Traps that are proven wrong', () => {
      for (let i = 0; i < 2; i++) runtime.attempt(trap);
      runtime.prove();
    });
    await note('A trap in what is wanted, when the page sets something', () => {
      figure.settings.want({ seed: 4 });
      figure.machine.begin = trap;
      figure.v = 0.5;
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
    const brief = /** @type {any} */ (document.createElement('banana-machine'));
    brief.addEventListener('load', () => void said.push('It is there.'));
    document.body.prepend(brief);
    const made = brief.runtime.hasten();
    brief.remove();
    await made;
    said.push(`Gone before it was there: ${brief.machine} ${brief.motion}`);
    await note('Pointed at while there is none', () => {
      runtime.attempt(trap);
      figure.shadowRoot.querySelector('canvas').dispatchEvent(new PointerEvent('pointermove'));
    });
    runtime.prove();
    let freed = 0;
    const { free } = figure.machine;
    figure.machine.free = function () {
      freed++;
      free.call(this);
    };
    figure.settings.want({ seed: 12 });
    await note('Failed of a refusal', () => runtime.attemptOrFail(() => { throw new RangeError('y is 2'); }));
    said.push(`Freed ${freed}, kept ${figure.getState().seed}`);
    // Who failed and is back may trap as often as any other.
    await note('Back once more', async () => {
      const { parentNode } = element;
      element.remove();
      await new Promise((resolve) => setTimeout(resolve));
      /** @type {Element} */ (parentNode).append(element);
      await runtime.hasten();
    });
    await note('A trap after that', () => runtime.attemptOrFail(trap));
    return said;
  });
  expectRecorded('trapped', lines);
});

for (const name of ALL) {
  test(`${name}: who has it rendered while work is under way does not make it hurry`, async ({ page }) => {
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    await unfold(widget);
    const steps = await widget.evaluate(async (element) => {
      const figure = /** @type {any} */ (element);
      let done = 0;
      const work = function* () {
        for (; done < 1000; done++) yield done / 1000;
      };
      await new Promise(requestAnimationFrame);
      figure.settings.work(work());
      figure.requestUpdate();
      // A microtask later, before any frame goes on with it.
      await figure.updateComplete;
      return [done, figure.renderRoot.querySelectorAll('canvas').length > 0];
    });
    expect(steps).toEqual([0, true]);
  });
}

test('what takes long from the first picture on is done in slices too', async ({ page }) => {
  await show(page, '<main></main>');
  const frames = await page.evaluate(async () => {
    const figure = /** @type {any} */ (document.createElement('banana-machine'));
    let done = 0;
    const work = function* () {
      for (; done < 60; done++) {
        // As long as five to ten milliseconds of a machine's.
        const end = performance.now() + 5;
        while (performance.now() < end);
        yield done / 60;
      }
    };
    const loaded = new Promise((resolve) => figure.addEventListener('load', (/** @type {Event} */ event) => {
      // The page asks nothing.
      event.stopPropagation();
      resolve(figure.settings.work(work()));
    }, { once: true }));
    document.querySelector('main')?.append(figure);
    await loaded;
    let frames = 0;
    for (; done < 60; frames++) await new Promise(requestAnimationFrame);
    return frames;
  });
  // 300 ms of work, of which a frame does no more than 25 and a step.
  expect(frames).toBeGreaterThanOrEqual(10);
});

test('a machine that another is to replace is drawn meanwhile; the other is stopped, or what fails where it arrives ends in the sentence', async ({ page }) => {
  await show(page, '<main></main>');
  const seen = await page.evaluate(async () => {
    const figure = /** @type {any} */ (document.createElement('banana-machine'));
    const [picture] = figure.pictures;
    const { draw } = picture;
    let [time, drawn, slices] = [performance.now(), 0, 300];
    picture.draw = function (/** @type {any[]} */ ...given) {
      drawn++;
      return draw.apply(this, given);
    };
    const give = () => figure.setState({ ...figure.getState(), samples: 200, shown: 200 });
    const loaded = new Promise((resolve) => figure.addEventListener('load', (/** @type {Event} */ event) => {
      // The page asks nothing.
      event.stopPropagation();
      const { prototype } = figure.machine.constructor;
      const { advance } = prototype;
      // A clock that goes on by ten milliseconds with each slice of work.
      performance.now = () => time;
      prototype.advance = function () {
        time += 10;
        return --slices > 0 ? false : advance.call(this, 1e9);
      };
      give();
      resolve(undefined);
    }, { once: true }));
    document.querySelector('main')?.append(figure);
    await loaded;
    while (figure.settings.next && drawn === 0) await new Promise(requestAnimationFrame);
    const seen = [drawn, figure.settings.next !== undefined];
    const stop = () => figure.shadowRoot.querySelector('[part=progress] button');
    while (figure.settings.next && !stop()) await new Promise(requestAnimationFrame);
    stop()?.click();
    seen.push(figure.settings.next, figure.machine.config.samples === 200);
    slices = 10;
    give();
    figure.machineChanged = () => {
      throw new Error('It does not fit.');
    };
    while (figure.settings.next) await new Promise(requestAnimationFrame);
    await figure.updateComplete;
    return [...seen, figure.shadowRoot.querySelector('.failure')?.textContent];
  });
  expect(seen).toEqual([1, true, undefined, false, 'This interactive figure cannot run here. It does not fit.']);
});
