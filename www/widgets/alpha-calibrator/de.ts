/** The Alpha Calibrator in German; see messages/en.ts. */

/** Prints a number of legs. */
const formatLegCount = (count: string) => `${count} Etappe${count === '1' ? '' : 'n'}`;

const CHECK_MESSAGES: Record<string, string> = {
  'reference-matches-mirrored':
    'Die Referenz dreht sich nach links, wo sich die Odometrie nach rechts dreht: Bei einer von beiden zeigt Z nach unten, oder eine Achse ist gespiegelt. Die α sind bedeutungslos. Bei einer von beiden y und den Winkel negieren: Welche falsch ist, zeigen die Logs nicht, und die α sind dieselben.',
  'reference-matches-copied':
    'Kein Fehler der Odometrie ist sichtbar: Die Referenz ist eine Kopie davon, daraus berechnet oder zu ungenau. Die α sind bedeutungslos. Eine genaue, unabhängige Messung verwenden, zum Beispiel Motion Capture oder SLAM.',
  'reference-matches':
    'Die Referenz folgt der Odometrie nicht: Vielleicht ist sie von einer anderen Fahrt, hat andere Einheiten (Grad, Fuß, Millimeter), eine gespiegelte y-Achse oder eine andere senkrechte Achse als z, oder ihre Spalten sind vertauscht. Die α sind bedeutungslos. Beide Dateien jeder Fahrt vergleichen.',
  'enough-legs':
    'Es sind wenige Etappen: Die Intervalle sind breit und die anderen Prüfungen schwach. Länger aufzeichnen: eine Viertelstunde mit Geraden, Bögen und Drehungen auf der Stelle.',
  'legs-lost-withoutReference':
    'Viele Etappen gingen verloren. Die α gelten für den Rest. Den meisten fehlt die Referenz: Sie endet früh, hat Lücken oder steht. Sie während der ganzen Fahrt aufzeichnen.',
  'legs-lost-acrossBreaks':
    'Viele Etappen gingen verloren. Die α gelten für den Rest. Die meisten gehen über einen Bruch: die Sprünge und die weggelassenen Zeilen ansehen.',
  'legs-lost-acrossPauses':
    'Viele Etappen gingen verloren. Die α gelten für den Rest. Die meisten sind durch eine Pause zu lang: beide ohne Lücken aufzeichnen.',
  'sampling-dense':
    'Die Aufzeichnung hat zu wenige Zeilen für diese Länge: Die Etappen sind länger als verlangt, und die α gelten für diese Länge. Mit höherer Rate aufzeichnen oder längere Etappen wählen.',
  'outliers-few':
    'Viele Etappen sind Ausreißer. Die α gelten für den Rest und sind zu klein, wenn die Ausreißer Schlupf der Räder sind. Die Ausreißer ansehen: Sprünge der Referenz oder Schlupf?',
  'sideways-rare':
    'Die Odometrie bewegt sich seitwärts: Ihre Positionen rauschen (nach Tabelle 5.6 zählt das auch in Drehungen auf der Stelle), ihr Koordinatensystem liegt nicht auf der Achse, sie ist mit der Referenz vertauscht, oder der Roboter fährt rückwärts (zählt nur nach Tabelle 5.6). α₁ und α₄ sind zu klein. Die Regel von Nav2 verwenden, oder Odometrie der Räder in der Mitte ihrer Achse.',
  'distance-scale-constant':
    'Der Skalenfaktor der Strecke ist nicht konstant und wurde nur auf Wunsch korrigiert. Raddurchmesser, Last und Schlupf in Kurven prüfen; erst die Räder kalibrieren, dann das Rauschen.',
  'turn-scale-constant': 'Der Skalenfaktor der Drehung ist nicht konstant und wurde nur auf Wunsch korrigiert. Spurweite und Schlupf auf diesem Boden prüfen, und längere Etappen wählen: Rauschen verbirgt kleine Drehungen.',
  'inflation-bounded':
    'Keine Vergrößerung bis 30 deckt die Fehler über 1 m: Sie sind kein Rauschen der Räder. Zuerst die Ursache suchen: behaltene Ausreißer, eine springende oder driftende Referenz, Schlupf.',
  'residuals-uncorrelated':
    'Fehler benachbarter Etappen sind korreliert: Sie halten über mehrere Etappen an, ein systematischer Fehler ist nicht korrigiert, oder die Referenz hat wenige Zeilen (unter 30 Hz). Über längere Strecken sind die angepassten α zu klein, wenn Fehler anhalten, und zu groß, wenn sie sich aufheben. Empfohlene α gelten über 1 m.',
  'tails-normal':
    'Einige Fehler sind viel größer, als eine Normalverteilung vorhersagt: Die Intervalle der vorhergesagten Pose sind an den Rändern zu schmal. Die größten Residuen ansehen. Empfohlene α berücksichtigen diese Fehler.',
  'holdout-covered':
    'Die α der einen Hälfte der Aufzeichnung passen nicht zur anderen: Boden, Last oder Geschwindigkeit haben sich geändert, oder die Referenz driftet. Für jede Bedingung kalibrieren, mit einer Referenz, die nicht driftet.',
  ...Object.fromEntries([1, 2, 5].map((length) => [
    `window-${length}m-covered`,
    'Über Fenster dieser Länge sagen die angepassten α den Fehler nicht vorher: Er wächst anders, wie bei ungleichen Raddurchmessern, einem Richtungsfehler, der während der Etappe wächst, oder einer driftenden Referenz. Empfohlene α gelten über 1 m: verwenden, wenn das Filter seine Pose so oft korrigiert.',
  ])),
};

export const de: typeof import('./en.ts').en = {
  title: 'Der Alpha-Kalibrierer',
  settings: {
    model: { name: 'Modell' },
    distance: { name: 'Etappenlänge (update_min_d)', effect: 'Eine Etappe endet nach *d* in *x* oder *y*. Die *α* gelten für diese Länge.' },
    angle: { name: 'Etappenwinkel (update_min_a)', effect: 'Eine Etappe endet nach einer Drehung um *φ*.' },
    duration: { name: 'Etappendauer', effect: 'Über 0 beendet *T* eine Etappe statt *d* und *φ*.' },
    outliers: { name: 'Ausreißer' },
    positionStd: { name: 'σ der Referenzposition', effect: 'Standardabweichung der Referenzposition, in *x* und in *y*.' },
    yawStd: { name: 'σ des Referenzwinkels', effect: 'Standardabweichung des Gierwinkels der Referenz.' },
    inflation: { name: 'Rauschfaktor', effect: 'Multipliziert die angepassten *α* in der vorhergesagten Wolke.' },
  },
  modelAndFitTitle: 'Modell und Anpassung',
  modelRuleNames: { thrun: 'Tabelle 5.6', nav2: 'Nav2', beluga: 'Beluga 2', omni: 'Omni', velocity: 'Geschwindigkeit' },
  outlierTreatments: { reject: 'aussortieren', keep: 'als Rauschen anpassen' },
  predictionTitle: 'Vorhergesagte Wolke',
  estimatedLabel: 'geschätzt',
  pathTitle: 'Referenzweg, p-Wert jeder Etappe',
  legTitle: (legNumber) => `Etappe ${legNumber}, von ihrem Anfang aus`,
  overlays: {
    likely: '*p* > 0,5',
    plausible: '*p* 0,05–0,5',
    unlikely: '*p* 0,001–0,05',
    implausible: '*p* < 0,001',
    outlier: 'Ausreißer',
    odometry: 'Odometrie',
    predicted: 'vorhergesagtes Ende',
    reference: 'Referenz',
  },
  aheadAxisLabel: 'voraus (m)',
  leftAxisLabel: 'links (m)',
  simulatedLogName: 'simulierte Aufzeichnung',
  legCountSentence: (logName, legs, outliers) => `${formatLegCount(legs)}${outliers ? `, davon ${outliers} Ausreißer` : ''}, ${logName}.`,
  ratingBadges: { consistent: 'Verwendbar', questionable: 'Vorsicht', unusable: 'Nicht verwenden' },
  checksPassedSentence: (count) => `Alle ${count} Prüfungen bestanden.`,
  failedChecksSentence: (checkNames, failedCount, count) => `Nicht bestanden: ${checkNames} (${failedCount} von ${count} Prüfungen).`,
  useRecommendedSentence: 'Die empfohlenen α mit Etappen dieser Länge verwenden.',
  useAnywaySentence: 'Lässt sich die Aufzeichnung nicht verbessern, die empfohlenen α verwenden.',
  missingAlphasSentence: (alphas, advisedDrive) => `Von dieser Aufzeichnung nicht bestimmt: ${alphas}; ${advisedDrive}.`,
  noAlphaSentence: 'Die Aufzeichnung bestimmt kein α.',
  clockOffsetNote: (seconds, isAhead) => `Die Uhr der Referenz geht gegen die der Odometrie ${seconds} s ${isAhead ? 'vor' : 'nach'}. Beide sind nach den Drehungen des Roboters ausgerichtet: prüfen, ob sie von derselben Fahrt sind.`,
  tooFewLegsSentence: 'Nicht genug Daten: Weniger als 8 Etappen haben Posen in beiden Aufzeichnungen. Beide Aufzeichnungen derselben Fahrt nehmen, kürzere Etappen wählen oder länger fahren.',
  checks: {
    title: 'Prüfungen',
    checkColumn: 'Prüfung',
    observedColumn: 'beobachtet',
    expectedColumn: 'erwartet',
    resultColumn: 'Ergebnis',
    passedLabel: 'bestanden',
    failedLabel: 'nicht bestanden',
    checkNames: {
      'reference-matches': 'Unterschied von Odometrie und Referenz',
      'enough-legs': 'Anzahl der Etappen',
      'legs-lost': 'verlorene Etappen',
      'sampling-dense': 'Etappenlänge durch verlangte Länge',
      'outliers-few': 'Ausreißer',
      'sideways-rare': 'Etappen seitwärts oder rückwärts',
      'distance-scale-constant': 'Änderung des Skalenfaktors, Strecke',
      'turn-scale-constant': 'Änderung des Skalenfaktors, Drehung',
      'inflation-bounded': 'Vergrößerung, die Fenster von ≥ 1 m brauchen',
      'residuals-uncorrelated': 'Korrelation benachbarter Residuen',
      'tails-normal': 'Kurtosis der Residuen (eine Gaußverteilung hat 3)',
      'holdout-covered': 'zurückgehaltene Etappen innerhalb von 95 %',
      'window-1m-covered': 'zurückgehaltene Fenster von ≥ 1 m innerhalb von 95 %',
      'window-2m-covered': 'zurückgehaltene Fenster von ≥ 2 m innerhalb von 95 %',
      'window-5m-covered': 'zurückgehaltene Fenster von ≥ 5 m innerhalb von 95 %',
    },
    translateMessage: (name, englishMessage) => CHECK_MESSAGES[name] ?? englishMessage,
  },
  noRecommendationSentence: 'Es gibt keine empfohlenen α: Die Aufzeichnung ist unbrauchbar.',
  recommendationReason: (inflation, coverage, count, nees) =>
    `Empfohlen: angepasst × ${inflation}. Die Anpassung deckt ${coverage} von ${count} zurückgehaltenen Fenstern von ≥ 1 m (erwartet 95 %; nötig sind 20 Fenster); ihr quadrierter Fehler durch vorhergesagte Varianz (NEES) ist ${nees}, erwartet 1.`,
  alphas: {
    title: (modelRuleName) => `Angepasste Rauschparameter (${modelRuleName})`,
    noiseColumn: 'Rauschen',
    fittedColumn: 'angepasst, 95 %',
    recommendedColumn: 'empfohlen',
    intervalColumn: '95-%-Intervall',
    notDeterminedText: (missingMotion, advisedDrive) => `nicht bestimmt: ${missingMotion}; ${advisedDrive}`,
    missingMotions: {
      'insufficient-rotation': { lack: 'zu wenig Drehung', drive: '~50 Drehungen auf der Stelle ergänzen', byCommands: '~50 Etappen in engen Kurven ergänzen' },
      'insufficient-translation': { lack: 'zu wenig Strecke', drive: '~50 gerade Etappen ergänzen', byCommands: '~50 gerade Etappen und ~50 in Kurven ergänzen' },
      'reference-too-noisy': { lack: 'das σ der Referenz ist größer als dieses Rauschen', drive: 'längere Etappen oder eine bessere Referenz verwenden', byCommands: 'längere Etappen oder eine bessere Referenz verwenden' },
      collinear: { lack: 'Drehung und Strecke sind kollinear', drive: '~50 gerade Etappen und ~50 Drehungen auf der Stelle ergänzen', byCommands: '~50 gerade Etappen und ~50 in engeren Kurven ergänzen' },
    },
  },
  systematic: {
    title: 'Systematische Fehler (angekreuzt = vor der Anpassung korrigiert)',
    errorColumn: 'Fehler',
    valueColumn: 'Wert',
    simulatedColumn: 'simuliert',
    errorNames: {
      clockOffset: 'Uhrenversatz (s)',
      mountYaw: 'Einbauwinkel (rad)',
      leverArm: 'Hebelarm (m)',
      distanceScale: 'Skalenfaktor, Strecke',
      turnScale: 'Skalenfaktor, Drehung',
    },
    notDeterminedText: 'nicht bestimmt',
    treatmentColumn: 'Behandlung',
    correctedLabel: 'korrigiert',
    notCorrectedLabel: 'nicht korrigiert',
    notConstantLabel: 'keine Konstante',
    uncorrectedSentence: (errorList, correctionPlace) => `Nicht korrigiert: ${errorList} (siehe ${correctionPlace}).`,
  },
  leg: {
    legsTitle: 'Etappen',
    name: 'Etappe',
    nextWorstLegLabel: 'Nächstgrößtes Residuum',
    endErrorLabel: 'Fehler',
    squaredDistanceLabel: (expectedDistance) => `quadrierte Mahalanobis-Distanz (erwartet ${expectedDistance})`,
  },
  panels: {
    title: 'Residuen und Bewegung',
    caption: 'Quadrierte Residuen in Klassen aus gleich vielen Etappen, ohne den Anteil des anderen *α* und ohne Etappen seitwärts oder rückwärts (siehe die Prüfung). Die Steigung ist das *α*, das Band sein 95-%-Intervall; Balken sind Standardfehler.',
    componentNames: { rot1: 'erste Drehung', trans: 'Strecke', rot2: 'zweite Drehung', strafe: 'Seitwärtsbewegung', v: 'Geschwindigkeit v̂', omega: 'Drehrate ω̂', gamma: 'letzte Drehung γ̂' },
    turnAxisLabel: 'Drehung² (rad²)',
    distanceAxisLabel: 'Strecke² (m²)',
    turnRateAxisLabel: 'Drehrate² (rad²/s²)',
    speedAxisLabel: 'Geschwindigkeit² (m²/s²)',
    binMeansName: 'Klassenmittel',
    slopeName: (alphaSubscript) => `Steigung *α*${alphaSubscript}`,
    squaredResidualLabel: 'quadriertes Residuum',
  },
  windowTable: {
    title: 'Zurückgehaltene Fenster',
    caption: 'Abdeckung durch die α der anderen Hälfte',
    lengthLabel: 'Strecke',
    countColumn: 'Fenster',
    coverageColumn: 'innerhalb von 95 %',
    neesColumn: 'quadrierter Fehler durch vorhergesagte Varianz (NEES, erwartet 1)',
  },
  noiseTable: {
    title: 'Rauschen der Referenz und Persistenz',
    quantityColumn: 'Größe',
    correlationName: 'Korrelation der Radfehler benachbarter Etappen',
    lengthLabel: 'Korrelationslänge',
  },
  lostLegs: {
    title: 'Verlorene Etappen',
    withoutReference: 'ohne Referenz',
    acrossBreaks: 'über Brüche',
    acrossPauses: 'über Pausen',
    standing: 'im Stillstand',
  },
  logControls: {
    dropZoneHint: 'Log hierher ziehen: ROS-Bag (.bag, .db3, .mcap, Ordner), CSV oder TUM, oder',
    dropZoneTooltip: 'Odometrie und Referenz: eine Aufzeichnung mit beiden oder zwei Dateien; bei mehreren Fahrten alle Dateien zugleich. Nichts verlässt dieses Gerät.',
    chooseFilesLabel: 'Dateien wählen',
    title: 'Aufzeichnung und Referenz',
    leaveLabel: 'Zurück zur simulierten Aufzeichnung',
    simulatedLogNote: 'Ein simulierter Roboter folgt einer Kurve und dreht sich ab und zu auf der Stelle. Die wahren Werte stehen neben den Schätzungen.',
    resultsOfLogNote: (name) => `Ergebnisse von ${name}.`,

    refusedLogSentence: (refusalMessage) => `Aufzeichnung abgelehnt: ${refusalMessage}`,
    otherLogNote: (log) => `Gezeigt wird noch das vorige Ergebnis: ${log}. Die zuletzt gewählten Dateien werden nicht verwendet.`,
    dismissFilesLabel: 'Diese Dateien verwerfen',
  },
  nav2: {
    title: 'Für Nav2',
    yamlLabel: 'Zeilen für nav2_params.yaml',
    copyLabel: 'Für Nav2 kopieren',
    fitLabel: 'Für Nav2 anpassen',
    fitTooltip: 'Diese α gelten für ein anderes Modell: das von Nav2 anpassen, dann kopieren',
    saveJsonLabel: 'Alles als JSON speichern',
    noYamlNote: 'Keine Zeilen für nav2_params.yaml: Nav2 hat kein Geschwindigkeitsmodell, oder es werden keine α empfohlen. In JSON steht alles.',
    localizer: 'Warnung: Die Referenz ist die Schätzung eines Lokalisierers. Ihre Fehler folgen der Odometrie: Die α sind zu klein. Eine unabhängig gemessene Referenz verwenden.',
    swappedRoles: 'Warnung: Nach den Namen scheinen Odometrie und Referenz vertauscht. Sind sie es, so gelten die α für die Referenz: die beiden tauschen.',
    correctionAdvice: (distanceFactor, turnFactor) =>
      `Zuerst in der Odometrie ${[distanceFactor && `Strecken mit ${distanceFactor}`, turnFactor && `Drehungen mit ${turnFactor}`].filter(Boolean).join(' und ')} multiplizieren: Die α gelten für den korrigierten Roboter.`,
  },
  csvTitle: 'Jede Etappe mit Odometrie, Referenz und Residuen',
  logNotInCopiesNote: 'Die eigene Aufzeichnung ist nicht dabei: Die Abbildung öffnet sich mit der simulierten.',
};
