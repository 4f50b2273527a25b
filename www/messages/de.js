/** The words that all widgets share, in German; see en.js. */

/** @type {typeof import('./en.js').en} */
export const de = {
  failure: (reason) => `Diese interaktive Abbildung läuft hier nicht. ${reason}`,
  beginWith: 'Beginn mit',
  play: 'Abspielen',
  pause: 'Anhalten',
  step: 'Schritt',
  reset: 'Leeren',
  newSeed: 'Neu würfeln',
  seed: (seed) => `Startwert ${seed}`,
  commandText: (v, omega, dt) => `v = ${v} m/s, ω = ${omega} rad/s, Δt = ${dt} s`,
  command: 'Fahrbefehl',
  settings: {
    v: { name: 'v, befohlene Geschwindigkeit' },
    omega: { name: 'ω, befohlene Drehrate' },
    dt: { name: 'Δt, Dauer' },
  },
  pose: {
    keys: 'Die Pfeiltasten bewegen ihn, mit Umschalt in größeren Schritten; Bild auf und Bild ab bewegen ihn weit in y, Pos1 und Ende an die Enden in x; [ und ] drehen ihn',
    headingKeys: 'Die Pfeiltasten drehen ihn, mit Umschalt in größeren Schritten; Bild auf und Bild ab drehen ihn weit, Pos1 und Ende nach hinten',
  },
  sliderEnds: (end) => `Der Regler endet bei ${end}; Werte darüber hinaus kann man eintippen.`,
  refused: (name, given, least, most, whole) =>
    `${name} ist ${given}; erlaubt ist ${whole ? 'eine ganze Zahl von ' : ''}${least} bis ${most}.`,
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
  presentation: { begin: 'Vorführen', title: 'Füllt den Bildschirm, für ein Publikum', controls: 'Bedienung', end: 'Verlassen' },
  copies: {
    label: 'Abbildung weitergeben',
    link: 'Link kopieren',
    linkTitle: 'Die Adresse dieser Seite mit der Abbildung, wie sie jetzt ist',
    code: 'Code zum Einbetten kopieren',
    codeTitle: 'HTML, das die Abbildung, wie sie jetzt ist, auf einer eigenen Seite zeigt',
    done: 'Kopiert.',
    byHand: 'Von hier kopieren:',
  },
};
