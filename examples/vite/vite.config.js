export default {
  base: './',
  // While developing, Vite would move the script away from the WebAssembly module that it looks for beside itself.
  optimizeDeps: { exclude: ['motion-widgets'] },
};
