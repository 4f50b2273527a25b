import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { files } from './serving.mjs';
import { inVite } from './vite.mjs';

/** The same sources with the version before, which bears another name beside this one. @type {import('./project.mjs').Serving['serve']} */
async function before(directory, tools) {
  const versions = ['react', 'react-dom'].map((name) => `${name}-18@npm:${name}@18.3.1`);
  await tools.run('npm', ['install', '--no-save', '--legacy-peer-deps', '--no-audit', '--no-fund', '--prefer-offline', '--loglevel', 'error', ...versions]);
  const path = join(directory, 'vite.config.ts');
  const alias = "resolve: { alias: { 'react-dom': 'react-dom-18', react: 'react-18' } },";
  writeFileSync(path, readFileSync(path, 'utf8').replace("base: '/book/',", `$& ${alias}`));
  await tools.run('npx', ['vite', 'build', '--outDir', 'dist-18']);
  return files('dist-18', '/book/')(directory, tools);
}

const common = inVite('vite-react', 'react');

/** @type {import('./project.mjs').Engine} */
export default {
  heading: 'React',
  ...common,
  servings: [...common.servings, { name: 'React 18', serve: before }],
  expected: [
    { selector: 'banana-machine', properties: { omega: 0.8, samples: 20000, alphas: [0.1, 0.05, 0.05, 0.1, 0.01, 0.01] } },
    { selector: 'map-squeeze', properties: { noise: 0.2, start: { x: 2.05, y: 2.6, theta: 1.5 } } },
  ],
};
