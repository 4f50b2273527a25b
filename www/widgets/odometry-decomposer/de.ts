/** The Odometry Decomposer in German; see messages/en.ts. */

export const de: typeof import('./en.ts').en = {
  title: 'Der Odometrie-Zerleger',
  presets: {
    all: 'Drehen, fahren, drehen',
    'turn-drive': 'Drehen, fahren',
    'drive-turn': 'Fahren, drehen',
    reverse: 'Rückwärts',
    spin: 'Drehen',
    wheelJitter: 'Im Stand',
  },
  ruleNames: {
    thrun: 'Tabelle 5.6',
    nav2: 'AMCL von Nav2',
    beluga: 'Beluga 2',
    omni: 'AMCL, omnidirektional',
  },
  settings: {
    rule: { name: 'Rauschmodell' },
    correlation: {
      name: 'Korrelation der Drehungen',
      effect: 'Zwischen dem Rauschen beider Drehungen: dreht die Ausgänge an ihrem Ort und verschiebt keinen.',
    },
    phase: { name: 'Fortschritt der Bewegung', effect: 'Die erste Drehung bis 1, die Fahrt bis 2, die zweite Drehung bis 3.' },
    drift: { name: 'Driftzeit', effect: 'Verschiebt das Koordinatensystem der Odometrie gegen die Welt. Die Vorhersage bleibt.' },
    samples: { name: 'Ausgänge', effect: 'Ausgänge: Mehr davon verkleinern den Fehler dessen, was sie messen.' },
  },
  playLabels: { phase: 'Bewegung abspielen', drift: 'Drift abspielen' },
  handles: { from: ['Odometrie davor', 'Richtung davor'], to: ['Odometrie danach', 'Richtung danach'] },
  legsTitle: 'Eine Messung der Odometrie, vier Rauschmodelle',
  worldTitle: 'In der Welt: Die Odometrie driftet',
  overlays: {
    legs: 'Messung',
    deviation: '± *σ*',
    outcomes: 'Ausgänge',
    prediction: 'Vorhersage *x*',
    odometry: 'Odometrie *x̄*',
    difference: 'Drift *x̄* − *x*',
  },
  headline: { beforeRatio: 'Tabelle 5.6 erwartet', afterRatio: 'so viel Drehrauschen wie AMCL von Nav2' },
  outcomesLabel: (rule) => `Ausgänge nach ${rule}`,
  spreadLabel: (rule) => `Streuung (2σ)\nnach ${rule}`,
  readouts: {
    firstRotationDeviation: 'allein aus der ersten Drehung, *δ*_{trans} · *σ*(*δ*_{rot1})',
    acrossDeviation: '*σ* quer zum Weg, gemessen',
    headingDeviation: '*σ* der Richtung, gemessen',
    exactValue: (exactNumber) => `genau ${exactNumber}`,
    exactAndIndependentValues: (exactNumber, independentNumber) => `genau ${exactNumber}; unabhängig wären es ${independentNumber}`,
  },
  table: {
    caption: 'Standardabweichungen: des Rauschens je Teil, dann des Endes, quer und in *θ*. Fett auf Farbe: anders als in Tabelle 5.6 (*Probabilistic Robotics*).',
    columns: ['*δ*_{rot1} (rad)', '*δ*_{trans} (m)', '*δ*_{rot2} (rad)', 'Seite (m)', 'quer (m)', '*θ* (rad)'],
  },
  captionSentences: {
    lever: (deviation, trans, lever) =>
      `Die erste Drehung hat den langen Hebel: Aus ihren ± ${deviation} rad am Anfang werden nach ${trans} m ± ${lever} m quer zum Weg.`,
    reverse: 'Rückwärtsfahren zerfällt in zwei Drehungen über π/2. Tabelle 5.6 gibt Rauschen für beide; die anderen nehmen min(|\u2060δ\u2060|,\u00a0π\u00a0−\u00a0|\u2060δ\u2060|).',
    wheelJitter: (trans, rot1) =>
      `Die Räder stehen, ihre Geber zittern um ${trans} mm. Tabelle 5.6 hält das für eine Drehung um ${rot1} rad und gibt Rauschen dafür.`,
    ignoredWheelJitter: (trans) => `Weniger als ein Zentimeter: ${trans} mm haben in diesem Rauschmodell keine Richtung, es gibt fast kein Rauschen.`,
    spin: 'Eine Drehung auf der Stelle steckt ganz in der zweiten Drehung. Nur das Rauschen von α₄ verschiebt den Roboter.',
    spinFromEitherSide: (remainingTurn) => `Jenseits einer Vierteldrehung zählt, was zur halben fehlt, hier ${remainingTurn} rad: Eine halbe Drehung auf der Stelle hat kein Rauschen.`,
    omnidirectional: (strafe) => `Dieses Rauschmodell hat kein Rauschen in der ersten Drehung: Die Fahrtrichtung ist genau, und der Roboter liegt ± ${strafe} m seitlich daneben, wie er sich auch dreht.`,
    noNoise: 'Ohne Rauschen ist jeder Ausgang die Messung.',
  },
  worldCaption: (driftDistance) =>
    `Nur die Bewegung von *x̄*_{t−1} nach *x̄*_{t} geht ein: Die Vorhersage driftet nicht. Der Ort *x̄*_{t} selbst ist um ${driftDistance} m falsch.`,
  correlationNote:
    'Die Rauschmodelle ziehen beide Drehungen unabhängig. Eine Korrelation *ρ* lässt jeder ihr Rauschen und jedem Ausgang seinen Ort; die Richtungen streuen von der Differenz der beiden Abweichungen (*ρ* = −1) bis zu ihrer Summe (*ρ* = 1). Bei *ρ* = 0 sieht man beides nicht.',
  plot: {
    title: 'Streuung über der Länge der Fahrt',
    acrossCurve: 'quer zum Weg, genau',
    alongCurve: 'in Fahrtrichtung',
    readingMark: 'gemessen',
    caption: 'Die Drehungen wie gemessen. Der Punkt ist der der Ausgänge, mit seinem Standardfehler.',
  },
  readingDescription: (rot1, trans, rot2) => `Die Messung: eine erste Drehung um ${rot1} rad, eine Fahrt von ${trans} m, eine zweite Drehung um ${rot2} rad`,
};
