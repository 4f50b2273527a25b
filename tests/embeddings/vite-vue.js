import { inVite } from './vite.mjs';

/** @type {import('./project.mjs').Engine} */
export default {
  heading: 'Vue',
  ...inVite('vite-vue', 'vue'),
  expected: [
    { selector: 'banana-machine', properties: { omega: 0.8, samples: 20000, alphas: [0.1, 0.1, 0.1, 0.1, 0.01, 0.01] } },
    { selector: 'map-squeeze', properties: { samples: 1000 } },
  ],
};
