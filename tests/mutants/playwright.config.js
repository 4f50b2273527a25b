import base from '../../playwright.config.js';

// A test that a mutant stops is to fail soon, and nothing is built on the way.
export default {
  ...base,
  testDir: '../e2e',
  outputDir: '../../test-results',
  webServer: undefined,
  retries: 0,
  use: { ...base.use, actionTimeout: 10_000 },
};
