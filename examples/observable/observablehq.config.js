export default {
  title: 'Motion',
  head: `<link rel="stylesheet" href="motion-widgets.css">
<script type="module" src="motion-widgets.iife.js"></script>`,
  // The default style sheets are left out, because they load fonts from another server.
  globalStylesheets: [],
  // Links keep the extension `.html`, so that any file server finds the pages.
  preserveExtension: true,
};
