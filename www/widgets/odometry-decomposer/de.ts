/** The Odometry Decomposer in German; see messages/en.ts. */

export const de: typeof import('./en.ts').en = {
  title: 'Der Odometrie-Zerleger',
  presets: {
    all: 'Drehen, fahren, drehen',
    'turn-drive': 'Drehen, fahren',
    'drive-turn': 'Fahren, drehen',
    reverse: 'Rückwärts',
    spin: 'Drehen',
    rest: 'Im Stand',
  },
  rules: {
    thrun: 'Tabelle 5.6',
    nav2: 'AMCL von Nav2',
    beluga: 'Beluga 2',
    omni: 'AMCL, omnidirektional',
  },
  settings: {
    rule: { name: 'Rauschmodell' },
    noise: { name: 'Verteilung' },
    alpha1: { effect: 'Je mehr er sich dreht, desto weniger kennt er seine Richtung.' },
    alpha2: { effect: 'Öffnet die Gelenke auch eines geraden Weges.' },
    alpha3: { effect: 'Streut die Ausgänge in Fahrtrichtung.' },
    alpha4: { effect: 'Streut sie auch dort, wo er sich nur gedreht hat.' },
    alpha5: { effect: 'Nur im omnidirektionalen Modell.' },
    correlation: {
      name: 'Korrelation der Drehungen',
      effect: 'Zwischen dem Rauschen beider Drehungen: dreht die Ausgänge an ihrem Ort und verschiebt keinen.',
    },
    phase: { name: 'Fortschritt der Bewegung', effect: 'Die erste Drehung bis 1, die Fahrt bis 2, die zweite Drehung bis 3.' },
    drift: { name: 'Driftzeit', effect: 'Trägt den Rahmen der Odometrie davon. Die Vorhersage bleibt.' },
    samples: { name: 'Ausgänge', effect: 'Ausgänge: Mehr davon verkleinern den Fehler dessen, was sie messen.' },
  },
  noises: { normal: 'normalverteilt', triangular: 'dreiecksverteilt' },
  path: 'Weg',
  drift: 'Drift',
  plays: { phase: 'Teile abfahren', drift: 'Driften lassen' },
  handles: {
    from: { robot: 'Odometrie davor', robotTitle: 'Pose davor ziehen', heading: 'Richtung davor', headingTitle: 'Pose davor drehen' },
    to: { robot: 'Odometrie danach', robotTitle: 'Pose danach ziehen', heading: 'Richtung danach', headingTitle: 'Pose danach drehen' },
    ends: 'Hier endet der Boden',
  },
  legsTitle: 'Was die Odometrie misst: drehen, fahren, drehen',
  worldTitle: 'In der Welt: Ihr Rahmen driftet',
  overlays: {
    legs: 'Messung',
    deviation: '± *σ*',
    outcomes: 'Ausgänge',
    prediction: 'Vorhersage *x*',
    odometry: 'Odometrie *x̄*',
    difference: 'Unterschied',
  },
  readouts: {
    lever: 'Hebel, *δ*_{trans} · *σ*(*δ*_{rot1})',
    across: 'Standardabweichung quer zum Weg',
    crossTrack: '*σ* quer zum Weg, gemessen',
    heading: '*σ* der Richtung, gemessen',
    exactly: (exact) => `genau ${exact}`,
    independent: (exact, independent) => `genau ${exact}; unabhängig wären es ${independent}`,
  },
  table: {
    caption: 'Standardabweichungen mit denselben *α*. Fett auf Farbe: anders als in Tabelle 5.6, dem Odometriemodell aus *Probabilistic Robotics*.',
    columns: ['*δ*_{rot1} (rad)', '*δ*_{trans} (m)', '*δ*_{rot2} (rad)', 'Gleiten (m)', 'quer (m)', '*θ* (rad)'],
  },
  caption: {
    lever: (deviation, trans, lever) =>
      `Das erste Gelenk hat den Hebel: Aus ± ${deviation} rad am Anfang werden nach ${trans} m ± ${lever} m quer zum Weg.`,
    reverse: 'Rückwärtsfahren zerfällt in zwei Drehungen über π/2. Tabelle 5.6 gibt Rauschen für beide; die anderen nehmen min(|\u2060δ\u2060|,\u00a0π\u00a0−\u00a0|\u2060δ\u2060|).',
    rest: (trans, rot1) =>
      `Die Räder stehen, ihre Geber zittern um ${trans} mm. Tabelle 5.6 hält das für eine Drehung um ${rot1} rad und gibt Rauschen dafür.`,
    restSpin: (trans) => `Weniger als ein Zentimeter: ${trans} mm haben in diesem Rauschmodell keine Richtung, es gibt fast kein Rauschen.`,
    spin: 'Eine Drehung auf der Stelle steckt ganz in der zweiten Drehung. Nur das Rauschen von α₄ verschiebt den Roboter.',
    spinEitherWay: (left) => `Jenseits einer Vierteldrehung zählt, was zur halben fehlt, hier ${left} rad: Eine halbe Drehung auf der Stelle hat kein Rauschen.`,
    omni: (strafe) => `Dieses Rauschmodell hat keine Gelenke: Der Kurs ist genau, und der Roboter gleitet ± ${strafe} m quer dazu, wie er sich auch dreht.`,
    still: 'Ohne Rauschen ist jeder Ausgang die Messung.',
  },
  worldCaption: (distance) =>
    `Der Rahmen driftet, die Vorhersage bleibt: Nur die Bewegung von *x̄*_{t−1} nach *x̄*_{t} geht ein. Nie vergleichen: *x̄*_{t} ist ${distance} m von *x*_{t}.`,
  hinges:
    'Die Rauschmodelle ziehen beide Drehungen unabhängig. Eine Korrelation *ρ* lässt jeder ihr Rauschen und jedem Ausgang seinen Ort; die Richtungen streuen von der Differenz der beiden Abweichungen (*ρ* = −1) bis zu ihrer Summe (*ρ* = 1). Bei *ρ* = 0 sieht man beides nicht.',
  plot: {
    title: 'Streuung über der Länge der Fahrt',
    label: (trans, exact) =>
      `Standardabweichungen über der Länge der Fahrt: quer zum Weg, der Hebel allein, und in Fahrtrichtung. Bei der Messung, ${trans} m, sind es quer ${exact} m.`,
    x: 'δ trans (m)',
    y: 'σ (m)',
    crossTrack: 'quer zum Weg, genau',
    lever: 'Hebel, *δ*_{trans} · *σ*(*δ*_{rot1})',
    along: 'in Fahrtrichtung',
    here: 'gemessen',
    caption: 'Die Drehungen wie gemessen. Der Punkt ist der der Ausgänge, mit seinem Standardfehler.',
  },
  picture: (rot1, trans, rot2, x, y) =>
    `Der Boden von oben, im Rahmen der Odometrie, x nach rechts und y nach oben. Die Messung: eine erste Drehung um ${rot1} rad, eine Fahrt von ${trans} m, eine zweite Drehung um ${rot2} rad, nach x ${x} m, y ${y} m.`,
  outcomes: (count, across, heading) => `${count} Ausgänge streuen um ${across} m quer zum Weg und um ${heading} rad in ihrer Richtung.`,
  none: 'Noch ist kein Ausgang gezogen.',
  worldPicture: (x, y, theta, distance) =>
    `Die Welt von oben. Der Rahmen der Odometrie ist nach x ${x} m, y ${y} m, Richtung ${theta} rad gedriftet. Der Roboter und seine vorhergesagten Ausgänge sind, wo sie waren, ${distance} m von der Pose der Odometrie.`,
};
