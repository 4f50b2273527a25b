/** @type {import('@docusaurus/types').Config} */
const config = {
  title: 'Probable Motion',
  url: 'https://example.org',
  baseUrl: '/book/',
  onBrokenLinks: 'throw',

  future: {
    v4: true,
  },

  clientModules: ['./src/figures.js'],

  presets: [
    [
      'classic',
      /** @type {import('@docusaurus/preset-classic').Options} */
      ({
        docs: { routeBasePath: '/' },
        blog: false,
      }),
    ],
  ],

  themeConfig:
    /** @type {import('@docusaurus/preset-classic').ThemeConfig} */
    ({
      navbar: { title: 'Probable Motion' },
    }),
};

export default config;
