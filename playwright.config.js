import { defineConfig } from '@playwright/test';
import { CHROME_ARGUMENTS, findChrome } from './scripts/browser.mjs';

export default defineConfig({
  testDir: 'tests/e2e',
  outputDir: 'test-results/e2e',
  forbidOnly: true,
  fullyParallel: true,
  // Tests often wait for frames and timers. Three workers therefore keep two processor cores busy.
  workers: '150%',
  reporter: 'list',
  use: {
    baseURL: process.env.SERVED_AT,
    // If this machine has no Chromium, Playwright uses its own.
    launchOptions: { executablePath: process.env.CHROME ?? findChrome(), args: CHROME_ARGUMENTS },
  },
  projects: [
    // Tests reuse one page, because the process of a page keeps compiled scripts and modules. A new page would take four times as long to
    // open. Between tests Playwright empties the page, except for its history.
    { name: 'shared', grepInvert: /@fresh/, use: { reuseContext: true } },
    { name: 'fresh', grep: /@fresh/ },
  ],
  webServer: {
    command: 'node scripts/serve.mjs',
    env: { PORT: '0' },
    wait: { stdout: /The widgets are at (?<served_at>\S+)/ },
    // Time limit in ms of the first build.
    timeout: 900_000,
    gracefulShutdown: { signal: 'SIGTERM', timeout: 5000 },
  },
});
