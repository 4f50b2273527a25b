import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { npmInstall, pinned } from './project.mjs';
import { files, program } from './serving.mjs';

/** The bundler of sites that are older than the present template. @type {import('./project.mjs').Serving['serve']} */
async function byWebpack(directory, tools) {
  const config = "import config from './docusaurus.config.js';\nexport default { ...config, future: { ...config.future, faster: false } };\n";
  writeFileSync(join(directory, 'webpack.docusaurus.config.mjs'), config);
  await tools.run('npm', ['run', 'build', '--', '--config', 'webpack.docusaurus.config.mjs', '--out-dir', 'build-webpack']);
  return files('build-webpack', '/book/')(directory, tools);
}

/** @type {import('./project.mjs').Engine} */
export default {
  heading: 'Docusaurus',
  versions: () => pinned('docusaurus', '@docusaurus/core', '@docusaurus/faster', 'react'),
  install: npmInstall,
  build: (_directory, { run }) => run('npm', ['run', 'build']),
  servings: [
    { name: 'production', serve: files('build', '/book/') },
    { name: 'webpack', serve: byWebpack },
    { name: 'development', serve: program((port) => ['npm', ['run', 'start', '--', '--port', port, '--no-open']], '/book/') },
  ],
  pages: { first: '/motion', second: '/sensors' },
  go: (page, path) => page.locator(`.theme-doc-sidebar-menu a[href$="${path}"]`).click(),
  async dark(page, on) {
    const theme = () => page.locator('html').getAttribute('data-theme');
    // It goes round: the system's, light, dark.
    while ((await theme()) !== (on ? 'dark' : 'light')) await page.locator('.navbar button[class*="toggle"][aria-label*="mode"]').first().click();
  },
  expected: [
    { selector: 'banana-machine >> nth=0', properties: { omega: 0.8, samples: 20000 } },
    { selector: 'banana-machine >> nth=1', properties: { omega: 0.3, samples: 5000, alphas: [0.1, 0.1, 0.1, 0.1, 0.01, 0.01] } },
    { selector: 'map-squeeze', properties: { samples: 1000 } },
  ],
};
