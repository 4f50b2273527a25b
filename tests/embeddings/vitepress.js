import { npmInstall, pinned } from './project.mjs';
import { files, program } from './serving.mjs';

/** @type {import('./project.mjs').Engine} */
export default {
  heading: 'VitePress',
  versions: () => pinned('vitepress', 'vitepress'),
  install: npmInstall,
  build: (_directory, { run }) => run('npm', ['run', 'docs:build']),
  servings: [
    { name: 'production', serve: files('.vitepress/dist', '/book/') },
    { name: 'development', serve: program((port) => ['npm', ['run', 'docs:dev', '--', '--port', port, '--strictPort']], '/book/') },
  ],
  pages: { first: '/motion.html', second: '/sensors.html' },
  go: (page, path) => page.locator(`.VPSidebar a[href$="${path}"]`).click(),
  async dark(page, on) {
    const html = page.locator('html');
    if ((await html.getAttribute('class'))?.includes('dark') !== on) await page.locator('.VPNavBarAppearance .VPSwitchAppearance').click();
  },
  expected: [
    { selector: 'banana-machine >> nth=0', properties: { omega: 0.8, samples: 20000 } },
    { selector: 'banana-machine >> nth=1', properties: { omega: 0.3, samples: 5000, alphas: [0.1, 0.1, 0.1, 0.1, 0.01, 0.01] } },
    { selector: 'map-squeeze', properties: { samples: 1000 } },
  ],
};
