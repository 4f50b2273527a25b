import { waitUntilLive } from './checks.mjs';
import { pinnedVersionsOf, installPythonPackages, pythonProgramPathOf } from './project.mjs';
import { serveByProgram } from './serving.mjs';

/** @type {NonNullable<import('./project.mjs').ServerMode['checks']>} */
const MARIMO_CHECKS = {
  async 'changes by the user reach Python, and changes by Python reach the figure'(page, servedSite) {
    await page.goto(servedSite.url);
    await waitUntilLive(page, servedSite);
    await page.locator('banana-machine').getByRole('slider', { name: /ω/ }).first().press('ArrowRight');
    await page.getByText('turn rate 0.81 rad/s').first().waitFor();
    await page.getByRole('button', { name: 'Hard arc' }).last().click();
    await page.getByText('turn rate 1.2 rad/s').first().waitFor();
  },
};

/** @type {import('./project.mjs').Platform} */
export default {
  heading: 'marimo',
  readVersions: () => pinnedVersionsOf('marimo', 'marimo', 'anywidget'),
  usesPython: true,
  installPackages: (projectDirectory, exampleTools) => installPythonPackages(projectDirectory, exampleTools, [exampleTools.pythonWheel]),
  serverModes: [
    {
      name: 'app',
      serve: serveByProgram((port, projectDirectory) => [pythonProgramPathOf(projectDirectory, 'marimo'), ['run', 'motion.py', '--headless', '--no-token', '--port', port]]),
      checks: MARIMO_CHECKS,
    },
  ],
  pages: { figuresPath: '/' },
  expectedFigures: [{ selector: 'banana-machine', properties: { omega: 0.8, samples: 20000 } }],
};
