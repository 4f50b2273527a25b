/**
 * The words that all widgets share, in English; those of each are in its folder. A message with values in
 * it is a function of them; numbers come printed, save where their size decides on the words. *Stars* make
 * italics, subscript digits and _{braces} subscripts, where HTML is shown.
 */

/**
 * @param {number} count
 * @param {string} word
 */
export const plural = (count, word) => `${word}${count === 1 ? '' : 's'}`;

export const en = /** @satisfies {import('./registry.js').Message} */ ({
  failure: (reason) => `This interactive figure cannot run here. ${reason}`,
  beginWith: 'Begin with',
  play: 'Play',
  pause: 'Pause',
  step: 'Step',
  reset: 'Reset',
  newSeed: 'New seed',
  seed: (seed) => `seed ${seed}`,
  commandText: (v, omega, dt) => `v = ${v} m/s, ω = ${omega} rad/s, Δt = ${dt} s`,
  command: 'Command',
  settings: {
    v: { name: 'v, commanded speed' },
    omega: { name: 'ω, commanded turn rate' },
    dt: { name: 'Δt, duration' },
  },
  pose: {
    keys: 'Arrow keys move it, with Shift by larger steps; Page Up and Page Down move it far in y, Home and End to the ends along x; [ and ] turn it',
    headingKeys: 'Arrow keys turn it, with Shift by larger steps; Page Up and Page Down turn it far, Home and End to the back',
  },
  sliderEnds: (end) => `The slider ends at ${end}; values beyond can be typed.`,
  refused: (name, given, least, most, whole) =>
    `${name} is ${given}; allowed is ${whole ? 'a whole number from ' : ''}${least} to ${most}${given.includes(',') && !whole ? ', with a decimal point' : ''}.`,
  exports: {
    label: 'Save the figure',
    png: 'PNG',
    svg: 'SVG',
    csv: 'CSV',
    pngTitle: 'The picture in twice the pixels of the screen',
    svgTitle: 'The picture as vector graphics',
    csvTitle: 'Every sample, with the parameters and the seed',
  },
  progress: {
    label: 'Computing',
    begins: 'This takes a moment. Escape stops it.',
    stop: 'Stop',
    stopTitle: 'Everything stays as it was (Escape)',
    stopped: 'Stopped: everything is as it was.',
  },
  presentation: { begin: 'Present', title: 'Fills the screen, for an audience', controls: 'Controls', end: 'Leave' },
  copies: {
    label: 'Share the figure',
    link: 'Copy link',
    linkTitle: 'The address of this page with the figure as it is now',
    code: 'Copy embed code',
    codeTitle: 'HTML that shows the figure as it is now on a page of your own',
    done: 'Copied.',
    byHand: 'Copy it from here:',
  },
});
