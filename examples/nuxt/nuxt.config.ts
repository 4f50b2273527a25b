import { isFigureTag } from 'motion-widgets';

export default defineNuxtConfig({
  css: ['motion-widgets/motion-widgets.css'],
  vue: { compilerOptions: { isCustomElement: isFigureTag } },
  hooks: {
    // Nuxt asks every page to prefetch all chunks and modules. Figures load theirs.
    'build:manifest'(manifest) {
      for (const file of Object.values(manifest)) if (!file.isEntry) file.prefetch = false;
    },
  },
});
