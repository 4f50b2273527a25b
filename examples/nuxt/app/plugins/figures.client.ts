import 'motion-widgets';

export default defineNuxtPlugin(() => {});
