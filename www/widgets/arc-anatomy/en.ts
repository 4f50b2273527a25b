/** Arc Anatomy in English; see messages/en.ts. */

export const en = {
  title: 'Arc Anatomy',
  settings: {
    underway: { name: 'time along the arc' },
    map: { name: 'Heat map' },
  },
  floorTitle: 'On the floor: one arc, one last turn',
  overlays: {
    commanded: 'commanded arc',
    inverted: 'the one arc to the robot',
    wedge: 'last turn, *γ̂Δt*',
    chord: 'chord',
    twist: 'constant twist *ξ*: steady speeds along, sideways and turning',
  },
  mapNames: { none: 'none', prob: 'p', density: 'density' },
  presets: { left: 'Left turn', right: 'Right turn', reverse: 'Reverse', straight: 'Straight' },
  printedRadiusLabel: 'radius without sign, as printed',
  timeTitle: 'Time',
  likelihoodTitle: 'Likelihood',
  csvTitle: 'The three estimates with their factors, and the parameters',
  handles: { start: ['Start', 'Heading at the start'], next: ['Robot, where it is found', 'Heading of the robot, where it is found'] },
  factorBars: {
    label: 'Residuals in standard deviations, and factors of p',
    estimateNames: ['speed', 'turn rate', 'last turn'],
    factorText: (sharePercent) => `factor: ${sharePercent} of its peak`,
  },
  headline: { beforeShare: 'The robot’s pose is', afterShare: 'as likely as the best pose', afterPower: 'times as likely as the best pose' },
  likelihoodReadouts: { prob: '*p* of the tables', density: 'density of the sampler (m⁻² rad⁻¹)', undefinedDensity: 'none: a variance is 0', xiReadout: '*ξ* (m, m, rad)' },
  captionSentences: {
    worstFactor: (estimateName, deviationCount, keptShare, sharePercent) =>
      `The ${estimateName} fits worst: ${deviationCount} standard deviations off. Its factor is ${keptShare} of its peak, the product of all three ${sharePercent}.`,
    atPeak: 'The robot is where the command leads without noise: p is at its peak.',
    zeroVariance: (estimateName) => `The ${estimateName} has zero variance but a non-zero residual, so p = 0.`,
    printedRadius: (v, sharePercent) =>
      `As printed, the radius has no sign: v̂ = ${v} m/s has the wrong sign, and p is ${sharePercent} of its peak.`,
  },
  formErrorPlot: {
    errorAxis: 'error of the end (m)',
    arcFormula: 'arc, by its radius',
    straightLineFormula: 'straight line',
    caption: 'At 1 m/s for 0.1 s, root mean square over all headings, against twice the digits. The arc loses digits by its long radius, the straight line is bent; they cross near 2·10⁻⁸/*Δt*. The chapter’s code goes over at 10⁻⁶ rad/s. The chord form needs no branch and loses nothing.',
  },
  table: {
    label: 'Table 5.1, line by line',
    noLine: 'No line',
    introduction: 'Table 5.1 of Probabilistic Robotics, the velocity model’s density, line by line: each line highlights its construction in the picture.',
    signNote: 'The sign of *r\\** is that of the side: positive with the centre to the left of the heading. The table prints the root alone, so that *v̂* has the sign of Δ*θ*: wrong wherever the centre is to the right.',
  },
} satisfies import('../../messages/registry.ts').MessageEntry;
