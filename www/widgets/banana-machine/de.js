/** The Banana Machine in German; see messages/en.js. */

/**
 * A sentence on an α that has nothing to multiply.
 *
 * @param {string} zero
 * @param {string} cause
 * @param {string} picture what turning that up would show
 */
const silent = (zero, cause, picture) =>
  `${zero}: gar kein Rauschen. Dreh ${cause} etwas auf und sieh, wie es die Wolke ${picture}.`;

/** @type {typeof import('./en.js').en} */
export const de = {
  title: 'Die Bananenmaschine',
  presets: { straight: 'Geradeaus', gentle: 'Sanfter Bogen', hard: 'Enger Bogen', pivot: 'Auf der Stelle' },
  settings: {
    v: { effect: 'Wie weit den Bogen entlang; unter null fährt der Roboter rückwärts.' },
    omega: { effect: 'Wie eng der Bogen ist; positiv heißt nach links.' },
    dt: { effect: 'Wie lange er fährt: unterwegs wachsen die Fehler.' },
    model: { name: 'Modell' },
    noise: { name: 'Rauschen' },
    alphas: {
      name: 'Rauschparameter',
      effects: {
        velocity: [
          ['v² in v̂', 'verschmiert die Wolke den Bogen entlang'],
          ['ω² in v̂', 'ebenso, aber nur in Kurven'],
          ['v² in ω̂', 'fächert die Wolke auf und biegt sie'],
          ['ω² in ω̂', 'fächert ebenso, aber nur in Kurven'],
          ['v² in γ̂', 'dreht jeden Roboter, wo er hält'],
          ['ω² in γ̂', 'dreht ebenso, aber nur in Kurven'],
        ],
        odometry: [
          ['Drehung in Drehung', 'schwenkt die Wolke um den Start'],
          ['Weg in Drehung', 'fächert sie auf, auch geradeaus'],
          ['Weg in Weg', 'verschmiert sie in Fahrtrichtung'],
          ['Drehung in Weg', 'ebenso, aber nur in Kurven'],
        ],
      },
    },
    samples: { name: 'N, Roboter in der ganzen Wolke', effect: 'Roboter unterwegs: wenige als Punkte mit Richtung, viele als Dichte.' },
  },
  cloud: {
    legend: 'Wolke',
    play: 'Lässt die Wolke wachsen',
    step: (batch) => `Schickt ${batch} Roboter mehr los`,
    reset: 'Leert die Wolke; derselbe Startwert schickt dieselben Roboter',
    reseed: 'Schickt andere Roboter',
  },
  overlaysLabel: 'Eingezeichnet',
  overlays: {
    command: 'befohlener Bogen',
    ellipse: '2σ-Gauß-Ellipse in (x, y)',
    linearized: 'linearisierte Ellipse (EKF)',
    exponential: '2σ-Gauß in Exponentialkoordinaten',
  },
  modelAndNoise: 'Modell und Rauschen',
  models: { velocity: 'Geschwindigkeit', odometry: 'Odometrie' },
  noises: { normal: 'Normalverteilung', triangular: 'Dreiecksverteilung' },
  isolate: 'Nur einen gelten lassen',
  only: (alpha) => `Nur ${alpha}`,
  off: (value) => `${value} aus`,
  notes: {
    still: 'Der Befehl heißt stehen bleiben, und ein Roboter, der steht, hat kein Bewegungsrauschen.',
    silent: 'Jedes α ist 0: gar kein Rauschen, also hält jeder Roboter genau da, wo er soll.',
    unfed: 'Kein α über 0 hat in diesem Befehl etwas zu vervielfachen: gar kein Rauschen.',
    headings: 'Nur γ̂ rauscht: Alle Roboter halten am selben Punkt, und nur ihre Richtungen fächern sich auf.',
    circle: 'Manche Roboter drehen sich fast im Kreis. Dort enden die Exponentialkoordinaten und ihre Zahlen.',
    backwards: 'Die Odometrie liest Rückwärtsfahren als zwei halbe Drehungen und berechnet für beide Rauschen.',
    line: 'Nur eine Zahl rauscht: Die Roboter liegen auf einer Linie, und ein Umriss ohne Fläche enthält keinen Anteil.',
  },
  alphaIsZero: (alpha) => `${alpha} gilt allein und ist 0: gar kein Rauschen. Dreh es auf.`,
  alphaIsSilent: {
    velocity: [
      silent('α₁ vervielfacht v², und v ist 0', 'v', 'den Bogen entlang verschmiert'),
      silent('α₂ vervielfacht ω², und ω ist 0', 'ω', 'den Bogen entlang verschmiert'),
      silent('α₃ vervielfacht v², und v ist 0', 'v', 'auffächert'),
      silent('α₄ vervielfacht ω², und ω ist 0', 'ω', 'auffächert'),
      silent('α₅ vervielfacht v², und v ist 0', 'v', 'auf der Stelle dreht'),
      silent('α₆ vervielfacht ω², und ω ist 0', 'ω', 'in ihren Richtungen verwischt'),
    ],
    odometry: [
      silent('α₁ vervielfacht die Quadrate der Drehungen, und sie sind 0', 'ω', 'schwenkt'),
      silent('α₂ vervielfacht das Quadrat des Weges, und es ist 0', 'v', 'auffächert'),
      silent('α₃ vervielfacht das Quadrat des Weges, und es ist 0', 'v', 'verschmiert'),
      silent('α₄ vervielfacht die Quadrate der Drehungen, und sie sind 0', 'ω', 'verschmiert'),
    ],
  },
  announcement: (robots, command, outcome) => `${robots} Roboter, ${command}. ${outcome}`,
  skew: (skew) => `Schiefe quer zur Fahrt ${skew}.`,
  noSkew: 'Schiefe quer zur Fahrt nicht definiert.',
  plane: (command) => `Der Boden von oben, x nach rechts und y nach oben. Befohlen: ${command}.`,
  drawnOver: (overlays) => `Darüber gezeichnet: ${overlays}.`,
  noRobots: 'Noch keine Roboter.',
  oneRobot: 'Ein Roboter.',
  mean: (robots, x, y) => `${robots} Roboter halten um x ${x} m, y ${y} m.`,
  spread: (x, y) => `Standardabweichungen ${x} m in x und ${y} m in y.`,
  bend: {
    unsure: (skew) => `Zu wenige Roboter, um zu sagen, wohin die Wolke neigt: Schiefe ${skew}.`,
    hardly: (skew) => `Die Wolke neigt kaum zu einer Seite: Schiefe ${skew}.`,
    right: (skew) => `Die Wolke ist krumm wie eine Banane, ihr Schweif rechts der mittleren Richtung: Schiefe ${skew}.`,
    left: (skew) => `Die Wolke ist krumm wie eine Banane, ihr Schweif links der mittleren Richtung: Schiefe ${skew}.`,
  },
  fewRobots: 'Zu wenige Roboter für eine Schiefe.',
  robotsHere: (_count, printed) => `hier ${printed} Roboter`,
  exactSkew: (skew) => `exakte Schiefe ${skew}`,
  noExactSkew: 'exakte Schiefe nicht definiert',
  twist: 'Dieselben Roboter in Exponentialkoordinaten',
  twistIs: {
    odometry:
      'nur ungefähr eine Gauß-Verteilung. Das Rauschen der Odometrie tritt an drei Gelenken ein, nicht einen Bogen entlang, und die vorhergesagte Schiefe trifft nicht.',
    triangular: 'nicht mehr krumm, wenn auch Dreiecksrauschen nicht gaußisch ist.',
    turned: 'fast eine Gauß-Verteilung. Daran hindert sie γ̂, das den Roboter nach seinem Bogen dreht.',
    exact: 'genau eine Gauß-Verteilung, deren Umriss eine Ellipse ist.',
  },
  twistAxes: 'ξ längs nach rechts und ξ Richtung nach oben',
  twistMoments: (along, heading, deviationAlong, deviationHeading, share) =>
    `Mittelwerte ${along} m und ${heading} rad, Standardabweichungen ${deviationAlong} m und ${deviationHeading} rad. ` +
    `${share} liegen in der 2σ-Ellipse.`,
  axisAlong: 'ξ längs (m)',
  axisHeading: 'ξ Richtung (rad)',
  handle: 'Ende des befohlenen Bogens',
  handleKeys: 'Die Pfeiltasten bewegen es über den Boden',
  handleTitle: 'Zieh am Ende des Bogens',
  chart: 'Exakte Schiefe quer zur Fahrt über dem befohlenen ω, beim jetzigen Rauschen',
  chartAxis: 'Schiefe quer zur Fahrt',
  chartMarker: 'Befohlenes ω im Diagramm',
  chartText: (omega, skew) => `ω = ${omega} rad/s, ${skew}`,
  chartCaption:
    'Exakte Schiefe über dem befohlenen *ω*, und die der Roboter mit ihrem Standardfehler. Die gestrichelte Linie ist jede Gauß-Verteilung in *(x, y)*.',
  readouts: {
    skew: 'Schiefe quer zur Fahrt ± Standardfehler',
    gaussian: 'Schiefe, Gauß in Exponentialkoordinaten',
    plane: 'Schiefe, jeder Gauß in *(x, y)*',
    rho: '*ρ*(Querlage, Richtung)',
    robots: 'Roboter gezeigt, *n* von *N*',
    exponential: 'innerhalb 2σ, Exponentialkoordinaten',
    ellipse: 'innerhalb 2σ, Gauß in *(x, y)*',
    nominal: 'innerhalb 2σ, Sollwert',
  },
  nOfAll: (n, all) => `${n} von ${all}`,
  robot: 'Roboter',
  markHint: 'Zeig in einer der Ansichten auf einen, um ihn in beiden zu markieren.',
  table: {
    caption:
      'Momente der Pose: um den Befehl linearisiert, exakt, und an den gezeigten Robotern gemessen. Meter und Radiant.',
    twistCaption: 'Momente in Exponentialkoordinaten: die des Befehls mit seinem Rauschen, und die gemessenen.',
    quantity: 'Größe',
    linearized: 'linearisiert',
    exact: 'exakt',
    measured: 'gemessen',
    command: 'Befehl',
    mean: (symbol) => `Mittel ${symbol}`,
    variance: (symbol) => `Varianz ${symbol}`,
    skew: 'Schiefe quer',
    axes: ['*ξ* längs', '*ξ* quer', '*ξ* Richtung'],
  },
};
