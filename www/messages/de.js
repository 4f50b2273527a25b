/**
 * Every word of the elements, in German: see en.js.
 *
 * @module
 */

/**
 * @param {number} count
 * @param {string} one
 * @param {string} many
 */
const plural = (count, one, many) => (count === 1 ? one : many);

/**
 * A sentence on an α that has nothing to multiply.
 *
 * @param {string} zero
 * @param {string} cause
 * @param {string} picture what turning that up would show
 */
const silent = (zero, cause, picture) =>
  `${zero}: gar kein Rauschen. Dreh ${cause} etwas auf und sieh, wie es die Wolke ${picture}.`;

/** @type {import('./registry.js').Messages} */
export const de = {
  failure: (reason) => `Diese interaktive Abbildung läuft hier nicht. ${reason}`,
  play: 'Abspielen',
  pause: 'Anhalten',
  step: 'Schritt',
  reset: 'Leeren',
  newSeed: 'Neu würfeln',
  seed: (seed) => `Startwert ${seed}`,
  commandText: (v, omega, dt) => `v = ${v} m/s, ω = ${omega} rad/s, Δt = ${dt} s`,
  command: 'Fahrbefehl',
  speed: 'v, befohlene Geschwindigkeit',
  turnRate: 'ω, befohlene Drehrate',
  duration: 'Δt, Dauer',
  exports: {
    label: 'Abbildung sichern',
    png: 'PNG',
    svg: 'SVG',
    csv: 'CSV',
    pngTitle: 'Das Bild mit doppelt so vielen Pixeln wie auf dem Bildschirm',
    svgTitle: 'Das Bild als Vektorgrafik',
    csvTitle: 'Jede Stichprobe, mit den Parametern und dem Startwert',
  },
  copies: {
    label: 'Abbildung weitergeben',
    link: 'Link kopieren',
    linkTitle: 'Die Adresse dieser Seite mit der Abbildung, wie sie jetzt ist',
    code: 'Code zum Einbetten kopieren',
    codeTitle: 'HTML, das die Abbildung, wie sie jetzt ist, auf einer eigenen Seite zeigt',
    done: 'Kopiert.',
    byHand: 'Von hier kopieren:',
  },
  banana: {
    title: 'Die Bananenmaschine',
    presets: { straight: 'Geradeaus', gentle: 'Sanfter Bogen', hard: 'Enger Bogen', pivot: 'Auf der Stelle' },
    cloud: {
      legend: 'Wolke',
      play: 'Lässt die Wolke wachsen',
      step: (batch) => `Schickt ${batch} Roboter mehr los`,
      reset: 'Leert die Wolke; derselbe Startwert schickt dieselben Roboter',
      reseed: 'Schickt andere Roboter',
      count: 'N, Roboter in der ganzen Wolke',
      effect: 'Roboter unterwegs: wenige als Punkte mit Richtung, viele als Dichte.',
    },
    overlaysLabel: 'Eingezeichnet',
    overlays: {
      command: 'befohlener Bogen',
      ellipse: '2σ-Gauß-Ellipse in (x, y)',
      linearized: 'linearisierte Ellipse (EKF)',
      exponential: '2σ-Gauß in Exponentialkoordinaten',
    },
    effects: {
      v: 'Wie weit den Bogen entlang; unter null fährt der Roboter rückwärts.',
      omega: 'Wie eng der Bogen ist; positiv heißt nach links.',
      dt: 'Wie lange er fährt: unterwegs wachsen die Fehler.',
    },
    modelAndNoise: 'Modell und Rauschen',
    model: 'Modell',
    models: { velocity: 'Geschwindigkeit', odometry: 'Odometrie' },
    noise: 'Rauschen',
    noises: { normal: 'Normalverteilung', triangular: 'Dreiecksverteilung' },
    alphas: 'Rauschparameter',
    isolate: 'Nur einen gelten lassen',
    only: (alpha) => `Nur ${alpha}`,
    off: (value) => `${value} aus`,
    alphaEffects: {
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
  },
  squeeze: {
    title: 'Map Squeeze: mit Karte durch die Wand',
    presets: { doorway: 'Vor einer Tür', wall: 'Vor einer Wand', corridor: 'Im freien Flur' },
    samplers: { endpoint: 'Endpunkt', 'whole-arc': 'ganzer Bogen', 'sub-stepped': 'Teilschritte' },
    samplerEffects: {
      endpoint: 'Behält einen Zug, wenn der Roboter an dessen Ende Platz hat; wie er hinkam, fragt niemand.',
      'whole-arc': 'Behält einen Zug, wenn der Roboter auf dem ganzen gefahrenen Bogen keine Wand berührt.',
      'sub-stepped':
        'Teilt den Befehl in *k* Teile und behält einen Teil, wenn der Roboter an dessen Ende Platz hat. Vor der Tür und im Flur kommen mit wachsendem *k* weniger durch die Wand; vor der Wand wird ihr Anteil größer, bis der Roboter festsitzt.',
      off: 'Aus: Jeder Zug bleibt, wo immer er endet.',
    },
    cloud: {
      legend: 'Stichproben',
      play: 'Zieht eine nach der anderen',
      step: (batch) => `Zieht ${batch} mehr`,
      reset: 'Nimmt alle weg; derselbe Startwert zieht dieselben',
      reseed: 'Zieht andere',
      count: 'N, Stichproben',
      effect: 'Versuchte Bewegungen: je mehr, desto enger das Intervall des Anteils durch die Wand.',
    },
    place: 'Ort',
    view: 'Ansicht',
    views: { whole: 'ganze Karte', close: 'aus der Nähe' },
    map: 'Karte',
    condition: 'Auf sie bedingen',
    sampler: 'Verfahren',
    steps: 'k, Teile des Befehls',
    commandAndNoise: 'Fahrbefehl und Rauschen',
    noise: 'n, Rauschen',
    clearance: 'r, Abstand',
    effects: {
      v: 'Wie weit er geschickt wird, und wie viele Wände er also trifft.',
      omega: 'Biegt den Weg: Er kann hinter einer Ecke im Freien enden.',
      dt: 'Wie lange er unbeobachtet fährt, zwischen zwei Blicken auf die Karte.',
      noise: 'Verbreitert die Wolke: *α*₁ bis *α*₄ sind *n*, die anderen *n*/4.',
      clearance: 'Radius des Roboters: Ein breiterer hat an weniger Stellen Platz und trifft mehr Wände.',
      steps: 'Teile des Befehls. Jeder rauscht für sich, sodass die Streuung wie 1/√*k* schrumpft.',
    },
    wedged: (accepted, printed, all, drawn) =>
      `Der Roboter sitzt fest: ${accepted === 0 ? 'keine Bewegung kam' : `nur ${printed} von ${all} Bewegungen kamen`} zu einem Ende in den ${drawn} Zügen bis zum Aufgeben.`,
    nothing: (count, drawn, wholeArc) =>
      `Nichts wurde angenommen: Von ${drawn} ${plural(count, 'versuchten Zug', 'versuchten Zügen')} ${wholeArc ? 'blieb unterwegs keiner ohne Berührung einer Wand' : 'endet keiner, wo der Roboter Platz hat'}.`,
    noRoom: 'Der Roboter hat keinen Platz, wo er steht; so beginnt jeder Weg von hier in einer Wand.',
    accepted: { kept: 'angenommen', through: 'angenommen durch die Wand', ofThem: 'durch die Wand' },
    kept: { kept: 'behalten', through: 'behalten, Weg nicht frei', ofThem: 'mit einem Weg, der nicht frei ist' },
    rejected: 'verworfen',
    verdict: {
      part: 'einer der Teile fand kein freies Ende',
      end: 'der Roboter hat am Ende keinen Platz',
      free: 'frei am Ende und auf dem ganzen Weg',
      way: 'frei am Ende, aber der Weg berührt eine Wand oder verlässt die Karte',
    },
    byConstruction: '0, nach Bauart',
    counts: (drawn, accepted, kept) => `${drawn} gezogen, ${accepted} ${kept}`,
    ofThem: (through, ofThem, share) => `, davon ${through} ${ofThem}: ${share}`,
    apartment: 'Die Wohnung',
    pasted: 'Eingegebener Plan',
    mapText: (name, width, height, walls, printed) =>
      `${name}: ${width} m × ${height} m, ${printed} ${plural(walls, 'Wand', 'Wände')}`,
    picture: (map) => `Grundriss von oben, x nach rechts und y nach oben. ${map}.`,
    robotAt: (x, y, theta, command) =>
      `Der Roboter steht bei x ${x} m, y ${y} m, Richtung ${theta} rad. Befohlen: ${command}.`,
    outcome: (drawn, accepted, kept, through, ofThem) =>
      `${drawn} gezogen; ${accepted} ${kept}, als Punkte; davon ${through} ${ofThem}, mit Ring.`,
    rest: 'Der Rest ist verworfen, als Kreuze.',
    robot: 'Roboter',
    robotKeys: 'Die Pfeiltasten bewegen ihn; [ und ] oder Umschalt mit einer Pfeiltaste drehen ihn',
    robotTitle: 'Zieh den Roboter',
    robotText: (x, y) => `x = ${x} m, y = ${y} m`,
    heading: 'Richtung des Roboters',
    headingKeys: 'Die Pfeiltasten drehen ihn',
    headingTitle: 'Dreh den Roboter',
    key: {
      accepted: (kept) => `${kept}, mit Richtung`,
      through: (through) =>
        `${through}: der Weg, die dünne Linie, ist nicht frei, er berührt eine Wand oder verlässt die Karte`,
      commanded: 'der Befehl ohne Rauschen',
    },
    tally: {
      drawn: 'gezogen',
      rate: 'Annahmerate',
      rateOfParts: 'Annahmerate eines Teils',
      draws: (kept) => `Züge je Stichprobe (${kept})`,
      share: (kept) => `Anteil unter „${kept}“`,
      interval: ' (95 %)',
      paths: 'davon mit Weg gezeichnet',
      first: (count) => `die ersten ${count}`,
      tests: (kept) => `Wandtests je Stichprobe (${kept})`,
    },
    sample: 'Stichprobe',
    markHint: 'Zeig auf eine, um ihren Weg und das Urteil über sie zu sehen.',
    costs: {
      caption:
        'Eine angenommene Stichprobe jedes Verfahrens unter den Einstellungen oben, auf diesem Gerät gemessen, wenn sich nichts bewegt; und der Anteil eines Rechenkerns, den 2000 Partikel bei 20 Hz bräuchten. Alles von dieser einen Pose aus; wiederholte Messungen weichen um einige Prozent ab.',
      sampler: 'Verfahren',
      draws: 'Züge',
      tests: 'Wandtests',
      core: 'vom Kern',
      none: 'noch nicht gemessen',
      wedged: 'sitzt fest: keine wird angenommen',
      few: 'zu wenige angenommen, um zu messen',
    },
    own: {
      legend: 'Eine eigene Karte',
      text: 'Zieh Dateien irgendwo auf diese Abbildung oder wähle sie hier: einen Grundriss in JSON oder eine Karte des map_server von ROS, die YAML-Datei zusammen mit ihrem Bild in PGM oder PNG. Sie verlassen dieses Gerät nicht.',
      files: 'Kartendateien',
      leave: 'Zurück in die Wohnung',
      plan: 'Oder hier ein Grundriss, in Metern',
      use: 'Diesen Plan nehmen',
    },
    refused: {
      cannot: (reason) => `Die Karte lässt sich nicht öffnen: ${reason}.`,
      kind: (name) =>
        `${name}: Dateien dieser Art werden nicht gelesen; erwartet wird ein Grundriss als .json oder eine .yaml-Datei zusammen mit ihrem Bild als .pgm oder .png.`,
      several: (names, count) => `${names}: Das sind ${count} Karten; erwartet wird eine auf einmal.`,
      noFile: 'Keine Datei',
      alone: (name) => `${name}: Ein Bild allein hat keinen Maßstab; erwartet wird seine .yaml-Datei dazu.`,
      gone: (name, reason) => `${name}: Die Datei ist nicht lesbar (${reason}); erwartet wird eine, die noch da ist.`,
      plan: (name, reason, form) => `${name}: ${reason}; ein Grundriss ist ${form} in Metern.`,
      planForm: (form) => `${form} in Metern`,
      yamlForm: 'ein Feld je Zeile, wie in resolution: 0.05',
      syntax: (name, line, format, reason, expected) =>
        `${name}${line ? `, Zeile ${line}` : ''}: Das ist kein ${format} (${reason}); erwartet wird ${expected}.`,
      image: (name, value) =>
        `${name}: image ${value ? `ist ${value}` : 'fehlt'}; erwartet wird der Name einer .pgm- oder .png-Datei.`,
      pair: (name, wanted, given) =>
        `${name}: image nennt ${wanted}, das nicht dabei ist${given && ` (dafür kam ${given})`}; erwartet werden beide Dateien zusammen.`,
      fields: (name) => `${name}: Darin sind keine Felder; erwartet werden mindestens image, resolution und origin.`,
      noPng: (name) => `${name}: Die ersten Bytes sind nicht die eines PNG-Bildes; erwartet wird PNG.`,
      large: (name, size, side, pixels) =>
        `${name}: Breite × Höhe ist ${size}; erwartet werden Seiten bis ${side} und höchstens ${pixels} Pixel.`,
      broken: (name) => `${name}: Die Bilddaten lassen sich nicht entziffern; erwartet wird ein vollständiges PNG-Bild.`,
      line: (name, line, reason) => `${name}, Zeile ${line}: ${reason}.`,
      cells: (name, reason) => `${name}: Die belegten Zellen haben zu viele Seiten: ${reason}.`,
    },
  },
};
