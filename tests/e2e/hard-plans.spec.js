import { expect } from '@playwright/test';
import { openSqueeze } from './squeeze-support.js';
import { STILL, frames, test } from './support.js';

test.use(STILL);


/** Tasks of the page's main thread by the processor's time, ms, longest first. */
async function tasks(page, work) {
  const browser = page.context().browser();
  await browser.startTracing(page, { categories: ['toplevel', 'disabled-by-default-devtools.timeline', 'devtools.timeline', 'disabled-by-default-v8.cpu_profiler'].slice(0, 3) });
  const said = await work();
  const trace = JSON.parse((await browser.stopTracing()).toString());
  const events = trace.traceEvents;
  const mains = new Set(events.filter((e) => e.name === 'thread_name' && e.args.name === 'CrRendererMain').map((e) => `${e.pid}/${e.tid}`));
  const long = events.filter((e) => mains.has(`${e.pid}/${e.tid}`) && e.name.endsWith('RunTask') && e.tdur > 30_000);
  const inner = events.filter((e) => mains.has(`${e.pid}/${e.tid}`) && e.tdur > 20_000 && ['FunctionCall', 'FireAnimationFrame', 'Layout', 'Paint', 'RunMicrotasks', 'MajorGC', 'MinorGC', 'PrePaint', 'Commit'].includes(e.name)).map((e) => `${e.name} ${e.args?.data?.functionName ?? ''} ${Math.round(e.tdur / 1000)}`);
  return { said, long: long.map((e) => Math.round(e.tdur / 1000)), inner };
}

for (const kind of (process.env.KINDS ?? 'equal,star,random,mesh').split(','))
test('explore ' + kind, async ({ page }) => {
  test.setTimeout(120_000);
  const widget = await openSqueeze(page);
  await widget.evaluate((element, kind) => {
      const n = 100_000;
      const T = Math.PI;
      const make = {
        equal: () => [0, 0, 10, 10],
        star: (i) => [5 - 4.9 * Math.cos((T * i) / n), 5 - 4.9 * Math.sin((T * i) / n), 5 + 4.9 * Math.cos((T * i) / n), 5 + 4.9 * Math.sin((T * i) / n)],
        random: () => [10 * Math.random(), 10 * Math.random(), 10 * Math.random(), 10 * Math.random()],
        mesh: (i) => (i % 2 ? [0, (10 * i) / n, 10, (10 * i) / n] : [(10 * i) / n, 0, (10 * i) / n, 10]),
      }[kind];
      window.map = { name: kind, bounds: [0, 0, 10, 10], walls: Array.from({ length: n }, (_, i) => make(i)) };
      const timed = (object, name) => { const f = object[name]; object[name] = function (...a) { const b = performance.now(); const r = f.apply(this, a); const e = performance.now() - b; if (e > 40) (window.slow ??= []).push(`${name} ${Math.round(e)}`); return r; }; };
      const proto = Object.getPrototypeOf(element.machine);
      for (const [name, d] of Object.entries(Object.getOwnPropertyDescriptors(proto))) {
        if (d.value && name !== 'constructor') timed(proto, name);
        else if (d.get) { const g = d.get; Object.defineProperty(proto, name, { ...d, get() { const b = performance.now(); const r = g.call(this); const e = performance.now() - b; if (e > 40) (window.slow ??= []).push(`get ${name} ${Math.round(e)}`); return r; } }); }
      }
  }, kind);
  const client = await page.context().newCDPSession(page);
  await client.send('Profiler.enable');
  await client.send('Profiler.setSamplingInterval', { interval: 1000 });
  await client.send('Profiler.start');
  const said = await tasks(page, () => widget.evaluate(async (squeeze, kind) => {
      const t0 = performance.now();
      squeeze.map = window.map;
      const set = performance.now() - t0;
      while (squeeze.map?.name !== kind) await new Promise(requestAnimationFrame);
      const there = performance.now() - t0;
      await new Promise((r) => setTimeout(r, 1500));
      return [set, there, window.slow];
    }, kind));
  const { profile } = await client.send('Profiler.stop');
  const self = new Map();
  const byId = new Map(profile.nodes.map((n) => [n.id, n]));
  profile.samples.forEach((id, i) => { const { functionName, url, lineNumber, columnNumber } = byId.get(id).callFrame; const key = `${functionName}:${url.split('/').pop()}:${lineNumber}:${columnNumber}`; self.set(key, (self.get(key) ?? 0) + profile.timeDeltas[i] / 1000); });
  console.log([...self].sort((a, b) => b[1] - a[1]).slice(0, 14).map(([k, v]) => `${k} ${Math.round(v)}`).join('\n'));
  console.log(kind, JSON.stringify(said));
});
