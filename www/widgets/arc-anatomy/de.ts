/** Arc Anatomy in German; see messages/en.ts. */

export const de: typeof import('./en.ts').en = {
  title: 'Arc Anatomy: was ein Bogen verrät',
  settings: {
    underway: { name: 'Zeit auf dem Bogen' },
    map: { name: 'Heatmap' },
  },
  floorTitle: 'Auf dem Boden: ein Bogen, eine letzte Drehung',
  overlays: {
    commanded: 'befohlener Bogen',
    inverted: 'der eine Bogen zum Roboter',
    wedge: 'letzte Drehung, *γ̂Δt*',
    chord: 'Sehne',
    twist: 'konstanter Twist *ξ*: stetig längs, quer und drehend',
  },
  mapNames: { none: 'keine', prob: 'p', density: 'Dichte' },
  presets: { left: 'Linkskurve', right: 'Rechtskurve', reverse: 'Rückwärts', straight: 'Geradeaus' },
  printedRadiusLabel: 'Radius ohne Vorzeichen, wie gedruckt',
  timeTitle: 'Zeit',
  likelihoodTitle: 'Likelihood',
  csvTitle: 'Die drei Schätzungen mit ihren Faktoren, und die Parameter',
  handles: { start: ['Start', 'Richtung am Start'], next: ['Roboter, wo er gefunden wird', 'Richtung des Roboters, wo er gefunden wird'] },
  factorBars: {
    label: 'Residuen in Standardabweichungen und Faktoren von p',
    estimateNames: ['Geschwindigkeit', 'Drehrate', 'letzte Drehung'],
    factorText: (sharePercent) => `${sharePercent} des Maximums`,
  },
  headline: { beforeShare: 'Die Pose des Roboters ist', afterShare: 'so wahrscheinlich wie die beste Pose', afterPower: 'mal so wahrscheinlich wie die beste Pose' },
  likelihoodReadouts: { prob: '*p* der Tabellen', density: 'Dichte der Ziehung (m⁻² rad⁻¹)', undefinedDensity: 'keine: eine Varianz ist 0', xiReadout: '*ξ* (m, m, rad)' },
  captionSentences: {
    worstFactor: (estimateName, deviationCount, keptShare, sharePercent) =>
      `Die ${estimateName} passt am schlechtesten: ${deviationCount} Standardabweichungen daneben. Ihr Faktor: ${keptShare} des Maximums, das Produkt aller drei: ${sharePercent}.`,
    atPeak: 'Der Roboter ist, wohin der Befehl ohne Rauschen führt: p hat sein Maximum.',
    zeroVariance: (estimateName) => `Die ${estimateName} hat die Varianz 0, aber ein Residuum ungleich 0: p = 0.`,
    printedRadius: (v, sharePercent) =>
      `Wie gedruckt hat der Radius kein Vorzeichen: v̂ = ${v} m/s hat das falsche, und p liegt bei ${sharePercent} seines Maximums.`,
  },
  formErrorPlot: {
    errorAxis: 'Fehler des Endes (m)',
    arcFormula: 'Bogen, mit seinem Radius',
    straightLineFormula: 'Gerade',
    caption: 'Bei 1 m/s in 0,1 s, quadratisches Mittel über alle Richtungen, gegen doppelt so viele Stellen. Der Bogen verliert Stellen an seinen langen Radius, die Gerade ist gebogen; bei 2·10⁻⁸/*Δt* kreuzen sie sich. Der Code des Kapitels wechselt bei 10⁻⁶ rad/s. Die Sehnenform braucht keinen Zweig und verliert nichts.',
  },
  table: {
    label: 'Tabelle 5.1, Zeile für Zeile',
    noLine: 'Keine Zeile',
    introduction: 'Tabelle 5.1 aus Probabilistic Robotics, die Dichte des Geschwindigkeitsmodells, Zeile für Zeile: Jede Zeile hebt ihre Konstruktion im Bild hervor.',
    signNote: 'Das Vorzeichen von *r\\** ist das der Seite: positiv, wenn der Mittelpunkt links der Richtung liegt. Die Tabelle druckt die Wurzel allein, sodass *v̂* das Vorzeichen von Δ*θ* hat: falsch, wo immer der Mittelpunkt rechts liegt.',
  },
};
