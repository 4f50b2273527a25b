export default {
  title: 'Motion',
  head: `<link rel="stylesheet" href="motion-widgets.css">
<script type="module" src="motion-widgets.iife.js"></script>`,
  // No request to a server of fonts.
  globalStylesheets: [],
  // Addresses that any server of files knows.
  preserveExtension: true,
};
