// The page in the iframe sends the height of its widget, and the iframe element takes that height.
addEventListener('message', ({ data, source }) => {
  if (data?.type !== 'motion-widgets:height' || !Number.isFinite(data.height)) return;
  for (const frame of document.querySelectorAll('iframe')) {
    if (frame.contentWindow === source) frame.style.height = `${data.height}px`;
  }
});
