/**
 * Words that all widgets share, in English. A message with values is a function. Its values are formatted texts, or numbers if their size
 * selects the words. In HTML, *stars* make italics, and subscript digits and _{braces} make subscripts.
 */

export const formatCount = (countText: string, singularWord: string) => `${countText} ${singularWord}${countText === '1' ? '' : 's'}`;

export const en = {
  failureMessage: (failureReason) => `This interactive figure cannot run here. ${failureReason}`,
  presetsHeading: 'Presets',
  cloud: {
    drawLabel: 'Draw samples',
    playTitle: 'A few at a time',
    stepTitle: (batchSize) => `Draw ${batchSize} more`,
    clearTitle: 'Clear the samples; the same seed draws the same ones',
    newSeedTitle: 'New random seed',
  },
  legendLabel: 'Legend',
  moreControls: 'More controls',
  numbersAndData: 'Numbers and data',
  samplesHeading: 'Samples',
  playLabel: 'Play',
  pauseLabel: 'Pause',
  stepLabel: 'Step',
  clearLabel: 'Clear',
  earlierOutlinesLabel: 'before',
  startOver: 'Start over',
  startOverTitle: 'Settings, view and seed as the figure opened',
  newSeed: 'New seed',
  seed: 'seed',
  commandHeading: 'Command',
  settings: {
    v: { name: 'speed', effect: 'How far the robot drives: *vΔt*; below zero it backs up.' },
    omega: { name: 'turn rate', effect: 'How sharply its path bends: radius *v*/*ω*, turn *ωΔt*; positive is left.' },
    dt: { name: 'duration', effect: 'How long it drives: errors spread on the way.' },
    samples: { name: 'samples' },
    noise: { name: 'Distribution' },
  },
  noiseNames: { normal: 'normal', triangular: 'triangular' },
  noiseHeading: 'Noise',
  /** Names of the noise parameters (which noise grows with which motion), and their effects. */
  alphas: {
    velocity: [
      ['speed noise from speed', '*v*² into *v̂*: spreads robots along the arc.'],
      ['speed noise from turning', '*ω*² into *v̂*: the same, but only in turns.'],
      ['turn rate noise from speed', '*v*² into *ω̂*: fans robots out and bends their cloud, unless *α*₁ blurs the bend.'],
      ['turn rate noise from turning', '*ω*² into *ω̂*: the same, but only in turns.'],
      ['last turn noise from speed', '*v*² into *γ̂*: turns each robot where it stopped.'],
      ['last turn noise from turning', '*ω*² into *γ̂*: the same, if *ω* ≠ 0.'],
    ],
    odometry: [
      ['rotation noise from rotation', 'Rotation into rotation: swings robots about the start.'],
      ['rotation noise from translation', 'Distance into rotation: fans robots out, even on a straight path.'],
      ['translation noise from translation', 'Distance into distance: spreads robots along the line of travel.'],
      ['translation noise from rotation', 'Rotation into distance: the same, also after a turn on the spot.'],
      ['sideways noise from translation', 'Distance into sideways motion: in the omnidirectional model alone.'],
    ],
  },
  pose: {
    moveTitle: 'Drag to move',
    turnTitle: 'Drag to turn',
    floorEndNote: 'The floor ends here',
    keysHint: 'Arrow keys move it, with Shift by larger steps; Page Up and Page Down move it far in y, Home and End to the ends along x; comma and period, or [ and ], turn it',
    headingKeysHint: 'Arrow keys turn it, with Shift by larger steps; Page Up and Page Down turn it far, Home and End to the back',
  },
  sliderEndNote: (sliderEnd) => `Ends at ${sliderEnd}; type values beyond.`,
  exports: {
    label: 'Save the figure',
    png: 'PNG',
    svg: 'SVG',
    csv: 'CSV',
    pngTitle: 'The picture in twice the pixels of the screen',
    svgTitle: 'The picture as vector graphics',
    csvTitle: 'Every sample, with the settings and the seed',
  },
  closeLabel: 'Close',
  unreadableLinkNotice: 'This link cannot be read: it may be cut off. The figure stays as it was.',
  progress: {
    label: 'Computing',
    stopLabel: 'Stop',
    stopTitle: 'Everything stays as it was (Escape)',
    stoppedNotice: 'Stopped: everything is as it was.',
  },
  presentation: { beginLabel: 'Present', beginTitle: 'Fills the screen, for an audience, and keeps the present state: the key 0 brings it back', controlsLabel: 'Controls', restoreLabel: 'As prepared', restoreTitle: 'The figure as it was when Present was pressed', endLabel: 'Exit' },
  copies: {
    label: 'Embed the figure',
    linkLabel: 'Copy link',
    linkTitle: 'The address of this page with the figure as it is now',
    codeLabel: 'Copy embed code',
    codeTitle: 'HTML that shows the figure as it is now on a page of your own',
    copiedNotice: 'Copied.',
    manualCopyLabel: 'Copy manually:',
  },
} satisfies import('./registry.ts').MessageEntry;
