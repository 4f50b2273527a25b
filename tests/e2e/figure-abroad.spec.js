import { show } from './element-support.js';
import { cloudOn, expectRecorded } from './figure-contract.js';
import { STILL, frames, test } from './support.js';

test.use(STILL);

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
    // The same where the browser has no base64 of its own.
    figures[0].setState({ ...figures[0].getState(), alphas: { velocity: Array.from({ length: 6 }, (_, i) => Math.sin(i) ** 2), odometry: [Math.E, Math.PI, Math.SQRT2, Math.LN2] } });
    const whole = await figures[0].shareLink();
    const { prototype } = /** @type {any} */ (Uint8Array);
    const { toBase64 } = prototype;
    delete prototype.toBase64;
    said.push(`Without base64 of the browser ${(await figures[0].shareLink()) === whole}`);
    if (toBase64) prototype.toBase64 = toBase64;
    // One that is there already is written over, and one that says the same is not written.
    figures[0].gesture.decide({ seed: 39 });
    while (new URL(await figures[0].shareLink()).hash !== location.hash) await rest();
    said.push(`Changed again: ${names()}`);
    const { replaceState } = history;
    let written = 0;
    history.replaceState = (...given) => {
      written++;
      replaceState.apply(history, given);
    };
    await figures[0].link.write();
    said.push(`The same written: ${written}`);
    // Of two, one right after the other, the later one is; what is removed meanwhile writes none.
    figures[0].seed = 51;
    const both = [figures[0].link.write()];
    figures[0].seed = 39;
    both.push(figures[0].link.write());
    await Promise.all(both);
    said.push(`Two written: ${written}`);
    figures[0].seed = 52;
    const late = figures[0].link.write();
    const { nextSibling: next, parentNode: parent } = figures[0];
    figures[0].remove();
    await late;
    said.push(`Written of what is gone: ${written}`);
    parent.insertBefore(figures[0], next);
    await figures[0].runtime.hasten();
    figures[0].seed = 39;
    history.replaceState = replaceState;

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
    // Without base64 of the browser too.
    const bytes = /** @type {any} */ (Uint8Array);
    const { fromBase64 } = bytes;
    delete bytes.fromBase64;
    figures[0].seed = 1;
    await follow(`#banana-machine.1=${text}&later`);
    if (fromBase64) bytes.fromBase64 = fromBase64;
    // Of two addresses, one right after the other, the later one counts.
    figures[0].seed = 2;
    history.replaceState(null, '', `#banana-machine.1=${text}`);
    const followed = [figures[0].link.follow()];
    history.replaceState(null, '', '#');
    followed.push(figures[0].link.follow());
    await Promise.all(followed);
    await rest();
    said.push(`Left at once: ${figures[0].seed}`);
    // One that is not on the page follows nothing.
    const [, away] = figures;
    const { parentNode, nextSibling } = away;
    away.seed = 77;
    away.remove();
    await rest();
    await follow(`#banana-machine:${encodeURIComponent('ä b')}=${text}&away`);
    parentNode.insertBefore(away, nextSibling);
    await away.runtime.hasten();
    await rest();
    said.push(`Back: ${away.seed}`);
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
    // There is nothing to print yet, nor anything that complains of that.
    for (const name of ['beforeprint', 'afterprint']) dispatchEvent(new Event(name));
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
    said.push(`In sight ${figure.stage.inSight}`);
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
      'background: linear-gradient(black, black); color: white; color-scheme: dark', 'background: #bbb; color: #000', 'background: #fff; color: #333',
      'background: #fff; color: #555', 'background: #fff; color: #fff', 'background: #fff; color: #606060', 'background: #fff; color: #6a6a6a', 'background: #eee; color: #444', 'background: #eee; color: #505050',
      'color: #777', '',
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
    // Nothing of a picture is left to a later frame where none comes.
    const [picture] = figure.pictures;
    const { draw } = picture;
    picture.draw = function (/** @type {any[]} */ ...given) {
      const { atOnce, piecemeal, still } = given[3];
      said.push(`Drawn: ${[atOnce, piecemeal, still]}`);
      return draw.apply(this, given);
    };
    dispatchEvent(new Event('beforeprint'));
    note('On paper');
    dispatchEvent(new Event('afterprint'));
    note('And back');
    picture.draw = draw;
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
