/** Map Squeeze in German; see messages/en.js. */

/** @type {typeof import('./en.js').en} */
export const de = {
  title: 'Map Squeeze: mit Karte durch die Wand',
  keyAndSample: 'Was gezeichnet ist',
  countsLabel: 'Anzahlen und Kosten',
  presets: { doorway: 'Vor einer Tür', wall: 'Vor einer Wand', corridor: 'Im freien Flur' },
  samplers: { endpoint: 'Endpunkt', 'whole-arc': 'ganzer Bogen', 'sub-stepped': 'Teilschritte' },
  samplerEffects: {
    endpoint: 'Behält einen Zug, wenn der Roboter an dessen Ende Platz hat; wie er hinkam, fragt niemand.',
    'whole-arc': 'Behält einen Zug, wenn der Roboter auf dem ganzen gefahrenen Bogen keine Wand berührt.',
    'sub-stepped':
      'Teilt den Befehl in *k* Teile und behält einen Teil, wenn der Roboter an dessen Ende Platz hat.',
    off: 'Aus: Jeder Zug bleibt, wo immer er endet.',
  },
  settings: {
    v: { effect: 'Wie weit er geschickt wird, und wie viele Wände er also trifft.' },
    omega: { effect: 'Biegt den Weg: Er kann hinter einer Ecke im Freien enden.' },
    dt: { effect: 'Wie lange er unbeobachtet fährt, zwischen zwei Blicken auf die Karte.' },
    noise: { name: 'Rauschen', effect: 'Verbreitert die Wolke: *α*₁ bis *α*₄ sind *n*, die anderen *n*/4.' },
    clearance: { name: 'Abstand', effect: 'Radius des Roboters: Ein breiterer hat an weniger Stellen Platz und trifft mehr Wände.' },
    unknown: { name: 'Unbekannte Zellen' },
    sampler: { name: 'Verfahren' },
    steps: { name: 'Teile des Befehls', effect: 'Teilschritte: Teile des Befehls, jeder mit eigenem Rauschen.' },
    samples: { name: 'Stichproben', effect: 'Versuchte Bewegungen: je mehr, desto enger das Intervall des Anteils durch die Wand.' },
    view: { name: 'Ansicht' },
  },
  place: 'Ort',
  unknown: { free: 'frei', blocked: 'gesperrt' },
  views: { whole: 'ganze Karte', close: 'aus der Nähe' },
  map: 'Karte',
  mapNotInCode: 'Der Code ist ohne Ihre Karte: Eine Seite gibt sie der Eigenschaft map.',
  condition: 'Auf die Karte bedingen',
  commandAndNoise: 'Fahrbefehl, Rauschen und Teile',
  wedged: (drawn, accepted, printed, all, through) =>
    `Der Roboter sitzt fest: In ${drawn} Zügen von Teilen ${accepted === 0 ? 'kam keine Bewegung ans Ende' : `kamen nur ${printed} von ${all} Bewegungen ans Ende; ${through}`}.`,
  nothing: (count, drawn, wholeArc) =>
    `Nichts wurde angenommen: Von ${drawn} ${count === 1 ? 'versuchten Zug' : 'versuchten Zügen'} ${wholeArc ? 'blieb unterwegs keiner ohne Berührung einer Wand' : 'endet keiner, wo der Roboter Platz hat'}.`,
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
  tested: {
    endpoint: (accepted, all) => `${accepted} von ${all} Bewegungen enden, wo der Roboter Platz hat, und sind angenommen`,
    'whole-arc': (accepted, all) => `${accepted} von ${all} Bewegungen berühren unterwegs keine Wand und sind angenommen`,
    'sub-stepped': (accepted, all) =>
      `${accepted} von ${all} Bewegungen enden, Teil für Teil, wo der Roboter Platz hat, und sind angenommen`,
    off: (accepted) => `Ohne die Karte bleiben alle ${accepted} Bewegungen`,
  },
  throughOf: (count, through, share) =>
    count === 0 ? 'keine davon ging durch eine Wand' : `${through} davon, ${share}, gingen durch eine Wand`,
  verdictOf: (tested, through) => `${tested}; ${through}.`,
  noneYet: 'Noch ist keine Bewegung versucht.',
  apartment: 'Die Wohnung',
  pasted: 'Eingegebener Plan',
  mapText: (name, width, height, walls, printed) =>
    `${name}: ${width} m × ${height} m, ${printed} ${walls === 1 ? 'Wand' : 'Wände'}`,
  picture: (map) => `Grundriss von oben, x nach rechts und y nach oben. ${map}.`,
  robotAt: (x, y, theta, command) =>
    `Der Roboter steht bei x ${x} m, y ${y} m, Richtung ${theta} rad. Befohlen: ${command}.`,
  outcome: (drawn, parts, accepted, kept, through, ofThem, density) =>
    `${drawn} ${parts ? 'Teile ' : ''}gezogen; ${accepted} ${parts ? 'Bewegungen ' : ''}${kept}, als ${density ? 'Dichte' : 'Punkte'}; davon ${through} ${ofThem}${density ? '' : ', mit Ring'}.`,
  rest: (density) => `Der Rest ist verworfen${density ? '' : ', als Kreuze'}.`,
  robot: {
    robot: 'Roboter',
    robotTitle: 'Zieh den Roboter',
    heading: 'Richtung des Roboters',
    headingTitle: 'Dreh den Roboter',
    ends: 'Hier endet die Karte',
  },
  rates: {
    accepted: 'angenommen',
    ofParts: 'angenommen, von allen Teilen',
    kept: 'behalten',
    through: 'davon durch eine Wand',
    interval: 'davon durch eine Wand (95-%-Intervall)',
  },
  key: {
    density: 'So viele sind als Dichte gezeichnet, je dunkler, desto mehr: Jede Stelle hat die Farbe dessen, was die meisten dort sind.',
    unknown: 'unbekannt: die Karte sagt nichts',
    overview: 'In der Ecke: die ganze Karte und der Teil davon, der zu sehen ist.',
    accepted: (kept) => `${kept}, mit Richtung`,
    through: (through) =>
      `${through}: Sein Weg, die dünne Linie, berührt eine Wand oder verlässt die Karte`,
    commanded: 'der Befehl ohne Rauschen',
  },
  tally: {
    drawn: 'gezogen',
    draws: (kept) => `Züge für eine (${kept})`,
    paths: 'davon Weg gezeichnet für',
    first: (count) => `die ersten ${count}`,
    tests: (kept) => `berechnete Abstände von Wänden für eine (${kept})`,
  },
  sample: 'Stichprobe',
  markHint: 'Zeig auf eine, um ihren Weg und das Urteil über sie zu sehen.',
  costs: {
    caption:
      'Eine angenommene Stichprobe jedes Verfahrens unter den Einstellungen oben, auf diesem Gerät gemessen, wenn sich nichts bewegt; und der Anteil eines Rechenkerns, den 2000 Partikel bei 20 Hz bräuchten. Alles von dieser einen Pose aus; wiederholte Messungen weichen um einige Prozent ab.',
    sampler: 'Verfahren',
    draws: 'Züge',
    tests: 'Abstände',
    core: 'vom Kern',
    none: 'noch nicht gemessen',
    wedged: 'sitzt fest: keine wird angenommen',
    few: 'zu wenige angenommen, um zu messen',
  },
  own: {
    reading: 'Die Karte wird gelesen …',
    legend: 'Eine eigene Karte',
    text: 'Zieh Dateien irgendwo auf diese Abbildung oder wähle sie hier: einen Grundriss in JSON oder eine Karte des map_server von ROS, die YAML-Datei zusammen mit ihrem Bild in PGM oder PNG. Sie verlassen dieses Gerät nicht.',
    files: 'Kartendateien',
    open: 'An freier Stelle',
    leave: 'Zurück in die Wohnung',
    back: (name) => `Zurück zu ${name}`,
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
    long: (name, bytes, most) => `${name}: Die Datei hat ${bytes} Bytes; erwartet werden höchstens ${most}.`,
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
    broken: (name, reason) => `${name}: ${reason}.`,
    line: (name, line, reason) => `${name}, Zeile ${line}: ${reason}.`,
  },
};
