import { HtmlBasePlugin } from '@11ty/eleventy';

export default function (config) {
  config.addPlugin(HtmlBasePlugin);
  config.addPassthroughCopy({ 'node_modules/motion-widgets/dist': 'motion-widgets' });
}
