/** Map Squeeze in German; see messages/en.ts. */

export const de: typeof import('./en.ts').en = {
  title: 'Map Squeeze: mit Karte durch die Wand',
  floorTitle: 'Auf dem Boden: wo ein Befehl enden kann',
  presets: { doorway: 'Vor einer Tür', wall: 'Vor einer Wand', corridor: 'Im freien Flur' },
  samplerNames: { endpoint: 'Endpunkt', 'whole-arc': 'Ganzer Bogen', 'sub-stepped': 'Jeder Teilschritt' },
  settings: {
    noise: { name: 'Rauschpegel', effect: 'Verbreitert die Wolke: setzt α₁ bis α₄; α₅ und α₆ sind ein Viertel.' },
    clearance: { name: 'Roboterradius', effect: 'Ein breiterer Roboter hat an weniger Stellen Platz und trifft mehr Wände.' },
    unknown: { name: 'Unbekannte Zellen' },
    sampler: { name: 'Verfahren: wo es auf Wände prüft' },
    steps: { name: 'Teilschritte', effect: 'Teile des Befehls, jeder mit eigenem Rauschen.' },
    samples: { effect: 'Mehr Stichproben verengen das Intervall.' },
    view: { name: 'Ansicht' },
  },
  overlays: {
    accepted: 'angenommen', through: 'angenommen durch eine Wand', rejected: 'verworfen',
    commanded: 'befohlener Weg', unknown: 'unbekannte Zellen',
  },
  unknownCellNames: { free: 'frei', blocked: 'gesperrt' },
  viewNames: { whole: 'ganze Karte', close: 'aus der Nähe' },
  robotAndMapTitle: 'Roboter und Karte',
  mapNotInLinkNote: 'Ihre Karte ist zu groß für einen Link und nicht dabei: Es öffnet sich die Wohnung.',
  mapNotInCodeNote: 'Ihre Karte ist nicht dabei: Geben Sie sie der Eigenschaft map; sonst öffnet sich die Wohnung.',
  conditionedLabel: 'Stichproben mit der Karte prüfen',
  headline: {
    noMotionHeadline: 'Noch keine Bewegung versucht',
    noneAcceptedHeadline: 'Keine Bewegung wurde angenommen',
    noneThroughWallHeadline: 'Keine angenommene Bewegung ging durch eine Wand',
    shareThroughWallHeadline: (sharePercent) => `${sharePercent} der angenommenen Bewegungen gingen durch eine Wand`,
  },
  wedgedNote: (drawnCount, accepted, requestedCount, through) =>
    `Der Roboter sitzt fest: ${drawnCount} gezogene Teilschritte vollendeten nur ${accepted} von ${requestedCount} Bewegungen; ${through}.`,
  nothingAcceptedNote: (drawnCount) => `Keine Stichprobe wurde angenommen: Keine der ${drawnCount} gezogenen ist kollisionsfrei.`,
  startCollisionNote: 'Die Startpose ist in Kollision.',
  testedSentences: {
    endpoint: (accepted, attemptCount) => `${accepted} von ${attemptCount} Bewegungen enden kollisionsfrei und sind angenommen`,
    'whole-arc': (accepted, attemptCount) => `${accepted} von ${attemptCount} Bewegungen berühren unterwegs keine Wand und sind angenommen`,
    'sub-stepped': (accepted, attemptCount) =>
      `${accepted} von ${attemptCount} Bewegungen enden nach jedem Teilschritt kollisionsfrei und sind angenommen`,
    off: (accepted) => `Ohne die Karte werden alle ${accepted} Bewegungen angenommen`,
  },
  throughWallClause: (throughWallCount, through, sharePercent, intervalText) =>
    `${throughWallCount === 0 ? 'keine davon ging' : `${through} davon, ${sharePercent}, gingen`} durch eine Wand${intervalText && ` (95-%-Intervall ${intervalText})`}`,
  densityNote: 'Dichte: dunkler = mehr Stichproben; Farbe = häufigster Ausgang je Zelle.',
  apartmentName: 'Die Wohnung',
  editedMapName: 'Geänderte Wohnung',
  pastedMapName: 'Eingegebener Plan',
  mapDescription: (name, mapWidth, mapHeight, wallCount) => `${name}: ${mapWidth} m × ${mapHeight} m, ${wallCount} ${wallCount === '1' ? 'Wand' : 'Wände'}`,
  contactLabel: 'durch diese Wand',
  handles: { start: ['Roboter', 'Richtung des Roboters'] },
  wallHandles: {
    doorwayEdgeName: 'Türkante',
    wallName: 'Wand',
    hint: '□ ziehen: verschiebt eine Wand',
    keysHint: 'Pfeiltasten bewegen sie, mit Umschalt in größeren Schritten; Komma und Punkt oder [ und ] führen zu den anderen Wänden',
  },
  tallyLabels: {
    drawnSamplesLabel: 'gezogen',
    drawsPerAcceptedLabel: 'gezogene je angenommene Stichprobe',
    wallTestsPerAcceptedLabel: 'berechnete Wandabstände je angenommene Stichprobe',
  },
  sample: 'Stichprobe',
  markHint: 'Zeig auf eine, um ihren Weg und ihr Urteil zu sehen.',
  costTable: {
    measureLabel: 'Kosten jedes Verfahrens messen',
    caption:
      'Kosten einer angenommenen Stichprobe jedes Verfahrens mit den Einstellungen oben, auf diesem Gerät gemessen; und der Anteil eines Rechenkerns, den 2000 Partikel bei 20 Hz bräuchten. Wiederholte Messungen weichen um einige Prozent ab.',
    samplerColumn: 'Verfahren',
    drawsColumn: 'gezogen',
    wallTestsColumn: 'Abstände',
    coreShareColumn: 'vom Kern',
    wedged: 'sitzt fest: zu wenige werden angenommen',
  },
  userMap: {
    readingNotice: 'Die Karte wird gelesen …',
    title: 'Eine eigene Karte',
    instructionsText: 'Zieh Dateien irgendwo auf diese Abbildung oder wähle sie hier: einen Grundriss in JSON oder eine Karte des map_server von ROS, die YAML-Datei zusammen mit ihrem Bild in PGM oder PNG. Sie verlassen dieses Gerät nicht.',
    chooseFilesLabel: 'Kartendateien wählen',
    leaveLabel: 'Zurück in die Wohnung',
    planFieldLabel: 'Oder hier ein Grundriss, in Metern',
    usePlanLabel: 'Diesen Plan nehmen',
  },
  refusals: {
    cannotOpenSentence: (reason) => `Die Karte lässt sich nicht öffnen: ${reason}.`,
    wrongFilesSentence: (fileNames) => `${fileNames}: Erwartet wird ein Grundriss als .json oder eine .yaml-Datei zusammen mit ihrem Bild als .pgm oder .png.`,
    largeFileSentence: (name, byteCount, maxBytes) => `${name}: Die Datei hat ${byteCount} Bytes; erwartet werden höchstens ${maxBytes}.`,
    invalidPlanSentence: (name, reason) => `${name}: ${reason}; erwartet wird {"bounds": [x0, y0, x1, y1], "walls": [[x0, y0, x1, y1], …]} in Metern.`,
    invalidImageNameSentence: (name, imageField) =>
      `${name}: image ${imageField ? `ist ${imageField}` : 'fehlt'}; erwartet wird der Name einer .pgm- oder .png-Datei.`,
    missingImageSentence: (name, namedImage, givenImage) =>
      `${name}: image nennt ${namedImage}, das nicht dabei ist${givenImage && ` (dafür kam ${givenImage})`}; erwartet werden beide Dateien zusammen.`,
    invalidYamlSentence: (name, lineNumber, reason) => `${name}, Zeile ${lineNumber}: ${reason}; erwartet wird ein Feld je Zeile, wie in resolution: 0.05.`,
    invalidLineSentence: (name, lineNumber, reason) => `${name}, Zeile ${lineNumber}: ${reason}.`,
  },
};
