import { defineConfig } from '@playwright/test';
import { CHROME_ARGUMENTS, findChrome } from './scripts/browser.mjs';

export default defineConfig({
  testDir: 'tests/e2e',
  outputDir: 'test-results/e2e',
  forbidOnly: true,
  fullyParallel: true,
  // Tests wait for frames and timers: three at a time keep two cores busy.
  workers: '150%',
  reporter: 'list',
  use: {
    baseURL: process.env.SERVED_AT,
    // Without a Chromium of this machine, Playwright's own.
    launchOptions: { executablePath: process.env.CHROME ?? findChrome(), args: CHROME_ARGUMENTS },
  },
  projects: [
    // A page that stays keeps its process, with the scripts and the module that it has compiled: three quarters of what
    // opening one costs. Between tests it is emptied; its history alone stays.
    { name: 'shared', grepInvert: /@fresh/, use: { reuseContext: true } },
    { name: 'fresh', grep: /@fresh/ },
  ],
  webServer: {
    command: 'node scripts/serve.mjs',
    env: { PORT: '0' },
    wait: { stdout: /The widgets are at (?<served_at>\S+)/ },
    // Enough for a first build.
    timeout: 900_000,
    gracefulShutdown: { signal: 'SIGTERM', timeout: 5000 },
  },
});
