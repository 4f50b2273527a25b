/** The words that all widgets share, in German; see en.js. */

/** @type {typeof import('./en.js').en} */
export const de = {
  failure: (reason) => `Diese interaktive Abbildung läuft hier nicht. ${reason}`,
  presets: 'Voreinstellungen',
  cloud: {
    play: 'Zieht die Stichproben, immer ein paar',
    step: (batch) => `Zieht ${batch} weitere`,
    clear: 'Leert die Wolke; derselbe Startwert zieht dieselben Stichproben',
    reseed: 'Neuer zufälliger Startwert',
  },
  legend: 'Legende',
  moreControls: 'Weitere Regler',
  numbersAndData: 'Zahlen und Daten',
  samples: 'Stichprobe',
  play: 'Abspielen',
  pause: 'Anhalten',
  step: 'Schritt',
  clear: 'Leeren',
  startOver: 'Von vorn',
  startOverTitle: 'Einstellungen, Ausschnitt und Startwert wie am Anfang',
  newSeed: 'Neu würfeln',
  seed: 'Startwert',
  commandText: (v, omega, dt) => `v = ${v} m/s, ω = ${omega} rad/s, Δt = ${dt} s`,
  command: 'Fahrbefehl',
  settings: {
    v: { name: 'Geschwindigkeit' },
    omega: { name: 'Drehrate' },
    dt: { name: 'Dauer' },
    samples: { name: 'Stichproben' },
  },
  noise: 'Rauschen',
  alphas: {
    velocity: [
      'Geschwindigkeitsrauschen durch Fahren', 'Geschwindigkeitsrauschen durch Drehen',
      'Drehratenrauschen durch Fahren', 'Drehratenrauschen durch Drehen',
      'Rauschen der letzten Drehung durch Fahren', 'Rauschen der letzten Drehung durch Drehen',
    ],
    odometry: [
      'Drehrauschen durch Drehen', 'Drehrauschen durch Fahren',
      'Streckenrauschen durch Fahren', 'Streckenrauschen durch Drehen',
      'Seitliches Rauschen durch Fahren',
    ],
  },
  pose: {
    keys: 'Die Pfeiltasten bewegen ihn, mit Umschalt in größeren Schritten; Bild auf und Bild ab bewegen ihn weit in y, Pos1 und Ende an die Enden in x; [ und ] drehen ihn',
    headingKeys: 'Die Pfeiltasten drehen ihn, mit Umschalt in größeren Schritten; Bild auf und Bild ab drehen ihn weit, Pos1 und Ende nach hinten',
  },
  sliderEnds: (end) => `Der Regler endet bei ${end}; Werte darüber hinaus kann man eintippen.`,
  refused: (name, given, least, most, whole) =>
    `${name} muss ${whole ? 'eine ganze Zahl ' : ''}von ${least} bis ${most} sein (gegeben: ${given}).`,
  exports: {
    label: 'Abbildung sichern',
    png: 'PNG',
    svg: 'SVG',
    csv: 'CSV',
    pngTitle: 'Das Bild mit doppelt so vielen Pixeln wie auf dem Bildschirm',
    svgTitle: 'Das Bild als Vektorgrafik',
    csvTitle: 'Jede Stichprobe, mit den Parametern und dem Startwert',
  },
  progress: {
    label: 'Wird berechnet',
    begins: 'Das dauert einen Augenblick. Escape bricht es ab.',
    stop: 'Abbrechen',
    stopTitle: 'Alles bleibt, wie es war (Escape)',
    stopped: 'Abgebrochen: Alles ist, wie es war.',
  },
  presentation: { begin: 'Vorführen', title: 'Füllt den Bildschirm, für ein Publikum', controls: 'Bedienung', end: 'Beenden' },
  copies: {
    label: 'Abbildung weitergeben',
    link: 'Link kopieren',
    linkTitle: 'Die Adresse dieser Seite mit der Abbildung, wie sie jetzt ist',
    code: 'Code zum Einbetten kopieren',
    codeTitle: 'HTML, das die Abbildung, wie sie jetzt ist, auf einer eigenen Seite zeigt',
    done: 'Kopiert.',
    byHand: 'Von Hand kopieren:',
  },
};
