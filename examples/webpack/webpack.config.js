export default {
  mode: 'production',
  entry: './main.js',
  output: { clean: true },
  // The page goes along as it is. The WebAssembly module needs nothing: webpack 5 finds it by itself.
  module: { rules: [{ test: /\.html$/, type: 'asset/resource', generator: { filename: '[name][ext]' } }] },
};
