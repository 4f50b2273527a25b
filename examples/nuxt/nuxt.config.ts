import { isFigureTag } from 'motion-widgets';

export default defineNuxtConfig({
  css: ['motion-widgets/motion-widgets.css'],
  vue: { compilerOptions: { isCustomElement: isFigureTag } },
  hooks: {
    // Figures load their own chunks and modules when they start. Nuxt would prefetch all of them for every page.
    'build:manifest'(manifest) {
      for (const file of Object.values(manifest)) if (!file.isEntry) file.prefetch = false;
    },
  },
});
