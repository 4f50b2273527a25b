/** Arc Anatomy in German; see messages/en.js. */

/** @type {typeof import('./en.js').en} */
export const de = {
  title: 'Arc Anatomy: was ein Bogen verrät',
  settings: {
    v: { effect: 'Wie weit der befohlene Bogen führt.' },
    omega: { effect: 'Biegt ihn: Der Radius ist *v*/*ω*, die Drehung *ωΔt*.' },
    dt: { effect: 'Die Geschwindigkeiten sind, was in *Δt* gefahren wurde.' },
    noise: { name: 'Rauschen' },
    map: { name: 'Karte' },
    alpha1: { effect: 'Je schneller die Fahrt, desto mehr wird *v̂* verziehen.' },
    alpha2: { effect: 'Je schneller die Drehung, desto mehr wird *v̂* verziehen.' },
    alpha3: { effect: 'Je schneller die Fahrt, desto mehr wird *ω̂* verziehen.' },
    alpha4: { effect: 'Je schneller die Drehung, desto mehr wird *ω̂* verziehen.' },
    alpha5: { effect: 'Je schneller die Fahrt, desto mehr wird *γ̂* verziehen.' },
    alpha6: { effect: 'Je schneller die Drehung, desto mehr wird *γ̂* verziehen.' },
  },
  maps: { none: 'keine', prob: 'p', density: 'Dichte' },
  presets: { left: 'Linkskurve', right: 'Rechtskurve', reverse: 'Rückwärts', straight: 'Geradeaus' },
  printed: 'wie gedruckt: *r\\** ≥ 0',
  twist: 'gleichbleibender Twist, *ξ*',
  underway: 'Unterwegs',
  drawn: 'Was gezeichnet ist',
  noiseLabel: 'Rauschen',
  noises: { normal: 'normal', triangular: 'dreieckig' },
  csvTitle: 'Die drei Schätzungen mit ihren Faktoren, und die Parameter',
  handles: {
    start: { robot: 'Start', robotTitle: 'Zieh den Start', heading: 'Richtung am Start', headingTitle: 'Dreh den Start' },
    next: {
      robot: 'Roboter, wo er gefunden wird',
      robotTitle: 'Zieh den Roboter',
      heading: 'Richtung des Roboters, wo er gefunden wird',
      headingTitle: 'Dreh den Roboter',
    },
    ends: 'Weiter geht es nicht',
  },
  bars: {
    label: 'Abweichungen in Standardabweichungen, und was jede von ihrem Faktor lässt',
    keeps: (share) => `lässt ${share}`,
  },
  likelihoods: { share: '*p*, vom Gipfel', density: 'Dichte der Ziehung (m⁻² rad⁻¹)', none: 'keine: eine Varianz ist 0' },
  verdict: {
    off: (symbol, deviations, kept, share) =>
      `${symbol} liegt am weitesten daneben, um ${deviations} Standardabweichungen: Von seinem Faktor bleiben ${kept} des Gipfels, von allen dreien zusammen ${share}.`,
    peak: 'Der Roboter ist, wohin ihn der Befehl ohne Rauschen bringt: p ist auf dem Gipfel.',
    noiseless: (symbol) => `${symbol} hat kein Rauschen, das die Abweichung verzeiht: p ist 0.`,
    printed: (v, share) =>
      `Wie gedruckt hat der Radius kein Vorzeichen: v̂ kommt als ${v} m/s heraus, was in die Gegenrichtung fährt, und p ist ${share} seines Gipfels.`,
  },
  pose: (x, y, theta) => `x ${x} m, y ${y} m, Richtung ${theta} rad`,
  picture: {
    poses: (start, command, next) => `Ein Roboter von oben. Er beginnt bei ${start}; befohlen ist ${command}. Gefunden wird er bei ${next}.`,
    arc: (radius, left) => `Der Bogen dazwischen hat den Radius ${radius} m, sein Mittelpunkt ist ${left ? 'links' : 'rechts'}.`,
    straight: 'Der Weg dazwischen ist gerade.',
    estimates: (v, omega, gamma) => `v̂ = ${v} m/s, ω̂ = ${omega} rad/s, γ̂ = ${gamma} rad/s.`,
  },
  centreAt: (metres) => `Mittelpunkt ${metres} m`,
  drawnShort: { prob: 'p', density: 'Dichte', commanded: 'befohlen', inverted: 'erschlossen', twist: 'gleichbleibender Twist' },
  key: {
    commanded: 'was befohlen war: Bogen, Mittelpunkt, beide Radien und seine Drehung *ωΔt*',
    inverted: 'der eine Bogen, der vom Start in dessen Richtung ausgeht und den Roboter erreicht: Mittelpunkt, Radius *r\\** mit Vorzeichen und Drehung *ω̂Δt*',
    wedge: 'die letzte Drehung, *γ̂Δt*: was der Bogen von der Richtung übrig lässt',
    chord: 'die Sehne zwischen beiden Orten',
    twist: 'gleichbleibender Twist *ξ*: Die Striche sind sein Weg zur Seite, den Räder nicht fahren',
  },
  forms: {
    label: 'Aufgabe 1: beinahe gerade',
    error: 'Fehler des Endes (m)',
    arc: 'Bogen, mit seinem Radius',
    straight: 'Gerade',
    chord: 'Sehne',
    text: 'Der Fehler des Endes einer Bewegung über der Drehgeschwindigkeit, auf logarithmischen Achsen: Der der Bogenform fällt mit ihr, der der Geraden steigt, und bei 2·10⁻⁷ rad/s kreuzen sie sich; der der Sehne bleibt unter beiden.',
    caption: 'Bei 1 m/s in 0,1 s, quadratisches Mittel über alle Richtungen, gegen doppelt so viele Stellen. Der Bogen verliert Stellen an seinen langen Radius, die Gerade ist gebogen; bei 2·10⁻⁸/*Δt* kreuzen sie sich. Der Code des Kapitels wechselt bei 10⁻⁶ rad/s. Die Sehnenform braucht keinen Zweig und verliert nichts.',
  },
  table: {
    label: 'Tabelle 5.1, Zeile für Zeile',
    begin: 'Tabelle 5.1, Zeile für Zeile: Jede hebt hervor, was sie konstruiert.',
    back: 'Die Zeile davor',
    on: 'Die nächste Zeile',
    sign: 'Das Vorzeichen von *r\\** ist das der Seite: positiv, wenn der Mittelpunkt links der Richtung liegt. Die Tabelle druckt die Wurzel allein, sodass *v̂* das Vorzeichen von Δ*θ* hat: falsch, wo immer der Mittelpunkt rechts liegt.',
  },
};
