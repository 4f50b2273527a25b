import { isFigureTag } from 'motion-widgets'
import { defineConfig } from 'vitepress'

export default defineConfig({
  title: 'Probable Motion',
  base: '/book/',
  vue: {
    template: { compilerOptions: { isCustomElement: isFigureTag } },
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
