import { defineConfig } from 'vitepress'

export default defineConfig({
  title: 'Probable Motion',
  base: '/book/',
  vue: {
    template: {
      compilerOptions: {
        isCustomElement: (tag) => /^(banana-machine|map-squeeze|arc-anatomy|odometry-decomposer|dead-reckoning|alpha-calibrator)$/.test(tag),
      },
    },
  },
  vite: {
    optimizeDeps: { exclude: ['motion-widgets'] },
  },
  themeConfig: {
    sidebar: [
      { text: 'Motion', link: '/motion' },
      { text: 'Sensors', link: '/sensors' },
    ],
  },
})
