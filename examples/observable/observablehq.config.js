export default {
  title: 'Motion',
  head: `<link rel="stylesheet" href="motion-widgets.css">
<script type="module" src="motion-widgets.iife.js"></script>`,
  // By default the pages load fonts from another server.
  globalStylesheets: [],
  // Addresses of files keep their endings, so that any file server finds the files.
  preserveExtension: true,
};
