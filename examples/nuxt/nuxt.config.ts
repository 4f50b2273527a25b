import { isFigureTag } from 'motion-widgets';

export default defineNuxtConfig({
  css: ['motion-widgets/motion-widgets.css'],
  vue: { compilerOptions: { isCustomElement: isFigureTag } },
  hooks: {
    // Prefetching is turned off, because Nuxt would load the chunks of all figures on every page.
    'build:manifest'(manifest) {
      for (const file of Object.values(manifest)) if (!file.isEntry) file.prefetch = false;
    },
  },
});
