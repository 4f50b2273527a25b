import js from '@eslint/js';
import globals from 'globals';

export default [
  { ignores: ['build/', 'dist/', 'target/', 'test-results/', 'python/'] },
  js.configs.recommended,
  {
    rules: {
      eqeqeq: 'error',
      'no-var': 'error',
      'object-shorthand': 'error',
      'prefer-const': 'error',
      'no-unused-vars': ['error', { argsIgnorePattern: '^_' }],
    },
  },
  { files: ['www/**', 'examples/**'], languageOptions: { globals: globals.browser } },
  { files: ['www/cli.js', 'www/cli/**'], languageOptions: { globals: globals.node } },
  // They run in Node and in a page.
  { files: ['benches/**', 'tests/digest/**'], languageOptions: { globals: { ...globals['shared-node-browser'], ...globals.browser } } },
  { files: ['scripts/**', 'tests/fuzz/**', 'tests/node/**', '*.config.js', 'examples/**/*.config.js'], languageOptions: { globals: globals.node } },
  // Browser tests run in Node and pass functions into the page.
  { files: ['tests/e2e/**', 'tests/embeddings/**', 'tests/engines/**', 'tests/package/**'], languageOptions: { globals: { ...globals.node, ...globals.browser } } },
];
