/** Sentences about logs, in German. */

import { REPAIR_COMMANDS } from './en.ts';
import type { LogTexts, UnitBasis, DropCause, LogSummary } from './log.ts';

const FIELD_NAMES: Record<string, string> = { t: 'Zeit', x: 'x', y: 'y', yaw: 'Gierwinkel', qx: 'qx', qy: 'qy', qz: 'qz', qw: 'qw', v: 'Geschwindigkeit v', omega: 'Drehrate ω' };

const NEEDED_COLUMNS = {
  poses: 'x, y und yaw (oder qx, qy, qz und qw)',
  either: 'x, y und yaw (oder qx, qy, qz und qw), oder v und omega',
};

const POSE_TYPES = 'nav_msgs/Odometry, geometry_msgs/PoseStamped, PoseWithCovarianceStamped, TransformStamped, Pose, Pose2D oder tf2_msgs/TFMessage';
const COMMAND_TYPES = 'geometry_msgs/Twist, TwistStamped oder TwistWithCovarianceStamped';
const MESSAGE_TYPES = { poses: POSE_TYPES, either: `${POSE_TYPES}, oder ${COMMAND_TYPES}`, transforms: 'tf2_msgs/TFMessage, worin Koordinatensysteme sind' };

const ROLE_NAMES = { odometry: 'Odometrie', reference: 'Referenz' };

const countWithNoun = (count: number, singular: string, plural: string) => `${count} ${count === 1 ? singular : plural}`;
const withDecimalComma = (value: number, digitCount: number) => value.toFixed(digitCount).replace('.', ',');

const UNIT_BASIS_TEXTS: Record<UnitBasis, string> = { name: ' (nach dem Namen)', size: ' (nach der Größe)', rate: ' (nach Rate und Geschwindigkeit)', format: '', date: ' (aus Datumsangaben)', option: ' (wie angegeben)', usage: ' (angenommen)' };

const ANGLE_UNIT_TEXTS: Record<LogSummary['units']['angle']['unit'], string> = { rad: 'Richtung in rad', deg: 'Richtung in Grad', quaternion: 'Richtung aus einem Quaternion', none: '' };

const DROP_REASONS: Record<DropCause, string> = {
  damaged: 'beschädigte Nachrichten',
  notFinite: 'keine endliche Zahl, oder eine über einer Milliarde',
  noRotation: 'ein Quaternion, das keine Drehung ist',
  short: 'zu wenige Felder oder Ziffern',
  text: 'ein Feld ohne Zahl',
  noStamp: 'der Zeitstempel 0',
  duplicate: 'die Zeit der Zeile davor',
  repeated: 'eine Pose, die öfter wiederholt ist, als sie gemessen wurde',
  burst: 'zugleich mit der nächsten Zeile angekommen, so dass ihre Zeit nicht die der Messung ist',
  held: 'die Pose steht, während die Odometrie weitergeht',
};

export const german: LogTexts = {
  errorPlaceText: (file, line, topic) => `${file}${topic ? `, Topic ${topic}` : ''}${line ? `, ${topic ? 'Nachricht' : 'Zeile'} ${line}` : ''}`,
  refusalReasons: {
    unreadableFileReason: (reason) => (reason === 'ENOENT' ? 'es gibt keine solche Datei und keinen solchen Ordner.' : `die Datei lässt sich nicht lesen (${reason}); prüfen, ob sie da ist und gelesen werden darf.`),
    emptyFileReason: 'es steht nichts darin; erwartet wird ein Log von Posen oder Befehlen.',
    unknownFormatReason: 'das ist weder Text noch eine bekannte Aufzeichnung; erwartet wird eine ROS-Bag, rosbag2, MCAP, oder eine Tabelle als CSV oder TUM, aus einem Archiv entpackt.',
    longLineReason: (max) => `die Zeile hat mehr als ${max} Bytes; erwartet wird eine Zeile je Zeitpunkt.`,
    noLogReason: 'sie sieht nicht wie ein Log aus, denn sie hat keine Zeilen mit Zahlen; erwartet wird eine Tabelle mit einer Kopfzeile wie „t,x,y,yaw“ und darunter einer Zeile je Zeitpunkt, oder eine Aufzeichnung von ROS.',
    noTimeColumnReason: (columns) =>
      `keine der Spalten ${columns} ist die Zeit; erwartet wird eine mit dem Namen t, time, timestamp oder stamp, oder zwei mit sec und nanosec, oder eine Auswahl der Spalten.`,
    missingColumnsReason: (neededFields, columns) => `die Spalten sind ${columns}; erwartet werden darunter ${NEEDED_COLUMNS[neededFields]}, oder eine Auswahl der Spalten.`,
    globeReason: 'Breite und Länge sind Winkel; gebraucht werden x und y in Metern, auf eine Ebene projiziert wie durch UTM oder ENU.',
    ambiguousColumnReason: (field, column, otherColumn) => `sowohl „${column}“ als auch „${otherColumn}“ kann die Spalte „${FIELD_NAMES[field]}“ sein; erwartet wird eines davon.`,
    shortRowReason: (count, needed) => `die Zeile hat ${countWithNoun(count, 'Feld', 'Felder')}; erwartet werden mindestens ${needed}.`,
    wideRowReason: (count, needed, header) =>
      `die Zeile hat ${countWithNoun(count, 'Feld', 'Felder')} und die Kopfzeile (Zeile ${header}) ${needed}; erwartet werden gleich viele, mit Dezimalpunkten in Zahlen oder Semikolons zwischen Feldern.`,
    columnCountReason: (cellCount, nameCount) => `die Zeile hat ${countWithNoun(cellCount, 'Feld', 'Felder')}, und --columns nennt ${nameCount}; alle Spalten der Reihe nach nennen, mit - für die, die nicht gelesen werden.`,
    noHeaderReason: (count, row) =>
      `die Tabelle hat keine Kopfzeile, und ihre erste Zeile ist „${row}“; ihre ${count} Spalten benennen.`,
    noTableReason: (notation) => `das ist ${notation}, keine Tabelle; eine Zeile je Zeitpunkt schreiben, wie mit ros2 topic echo --csv, rostopic echo -p oder pandas, oder die Aufzeichnung selbst angeben.`,
    noHeadingReason: (columns) =>
      `${columns} sind Positionen ohne Richtung; nötig ist eine Referenz, die die Richtung misst, wie mit zwei Prismen, Markern oder Scan-Matching (in einer Tabelle in einer Spalte namens yaw mit dem Präfix von x und y): Die Fahrtrichtung verbirgt Drehfehler und würde alpha1 und alpha2 halbieren.`,
    eulerAnglesReason: (rotation) => `die Drehungen sind Eulerwinkel (${rotation}); die Aufnahme noch einmal aus Motive exportieren, mit Rotation Type „Quaternion“.`,
    tiltedPosesReason: 'die Posen drehen sich nicht um eine senkrechte Z-Achse; mit Z nach oben exportieren oder aufzeichnen.',
    yUpReason: 'die Richtungen folgen dem Weg in x und z, die senkrechte Achse ist also Y; mit Z nach oben exportieren, oder die Spalten in anderer Reihenfolge auswählen.',
    mirroredPathReason: 'die Richtungen drehen sich anders herum als der Weg; erwartet werden Richtungen, die gegen den Uhrzeigersinn wachsen, von x nach y; x und y vertauschen, oder eines davon negieren.',
    mixedSourcesReason: (framePair) => `die Zeilen gehören zu mehreren Frames, Topics oder Robotern (${framePair}); nur die eines davon behalten.`,
    unknownUnitReason: (unit) => `die Einheit ${unit} einer Spalte ist unbekannt, oder nicht die einer anderen; erwartet wird s, ms, us oder ns, m, cm, mm, ft oder in, und rad oder deg.`,
    alternatingPathsReason: (metres) => `Posen zweier Wege wechseln sich ab, ${withDecimalComma(metres, 2)} m auseinander: Sie sind von zwei Robotern, oder von zwei Knoten, die auf einem Topic senden; nur die eines davon behalten.`,
    damagedRowsReason: (badCount, rows, percent) => `${badCount} von ${rows} Zeilen sind beschädigt; erlaubt sind höchstens ${percent} %.`,
    notNumericReason: (column, value) => `${column} ist „${value}“; erwartet wird eine Zahl${/^\d{1,3}(\D\d{3})+\b/.test(value) ? ' ohne Tausendertrennung' : /^[+-]?\d*,\d+$/.test(value) ? ' mit Dezimalpunkt' : /\d[/:-]\d/.test(value) ? ', oder ein Datum wie 2024-01-31 12:00:00.5' : ''}.`,
    tooManyRowsReason: (max) => `es sind mehr Zeilen; erwartet werden höchstens ${max}.`,
    clockSetBackReason: (seconds) =>
      `die Zeiten springen um ${seconds.toPrecision(3)} s zurück und wiederholen die davor; dort die Datei teilen, nur eine Aufzeichnung angeben, oder Nachkommastellen mit ihren führenden Nullen schreiben (1.050000000 für 1 s und 50000000 ns).`,
    equalTimesReason: (count, rows) =>
      `${count} von ${rows} Zeilen, diese zuerst, haben die Zeit einer anderen Zeile und andere Werte; nötig ist das Log eines Roboters, mit allen Stellen der Zeiten (eine Tabellenkalkulation oder ein Format wie %.9e kann sie gerundet haben).`,
    fewRowsReason: (kept, rows, reason) => `${kept} von ${rows} Zeilen sind zu brauchen${reason ? ` (${DROP_REASONS[reason]})` : ''}; erwartet werden mindestens 2.`,
    timeUnit: (rate, unit, choices) =>
      `in ${unit} wären es ${rate.toPrecision(3)} Zeilen je Sekunde; ${choices.length ? `die Einheit der Zeiten angeben: ${choices.join(' oder ')}` : 'sie in s schreiben, oder als Datum wie 2024-01-31 12:00:00.5 (Tabellenprogramme zählen Tage)'}.`,
    lengthUnit: (speed, unit, choices) =>
      `in ${unit} führe der Roboter ${speed.toPrecision(3)} m/s; die Einheit der Längen angeben: ${choices.join(' oder ')}.`,
    angleUnit: (turn, unit, choices) =>
      `Richtungen in ${unit} drehten sich mit ${turn.toPrecision(3)} rad/s; ihre Einheit angeben: ${choices.join(' oder ')}.`,
    damagedFileReason: (reason, format) => `sie ist beschädigt oder unvollständig (${reason}); noch einmal vom Roboter kopieren${format ? `, oder „${REPAIR_COMMANDS[format]}“ versuchen` : ''}.`,
    largeFileReason: (command, max) => `sie hat dekomprimiert mehr als ${max} Bytes; mit „${command}“ dekomprimieren und das Ergebnis angeben.`,
    foreignDatabaseReason: 'das ist eine SQLite-Datenbank ohne die Tabellen „topics“ und „messages“ von rosbag2; erwartet wird eine Aufzeichnung von „ros2 bag record“.',
    listedFileReason: 'sie steht in der metadata.yaml einer Aufzeichnung, ist aber keine Aufzeichnung; erwartet wird eine MCAP- oder .db3-Datei.',
    journalFileReason: 'das ist ein Journal mit Nachrichten, die seiner .db3-Datei fehlen; das Aufzeichnen beenden, oder sie mit „sqlite3 DATEI.db3 \'PRAGMA wal_checkpoint\'“ zurückschreiben.',
    unreadFormatReason: (format, command) => `das hat das Format ${format}; ${command ? `mit „${command}“ umwandeln und das Ergebnis angeben` : 'entpacken, oder als CSV exportieren'}.`,
    missingFilesReason: (files) => `sie beschreibt eine Aufzeichnung in ${files}; auch diese Datei angeben, oder den ganzen Ordner.`,
    unknownTopicReason: (series) => `es gibt kein solches Topic, keine solche Gruppe von Spalten und keine solchen Transformationen; erwartet wird eines von ${series}.`,
    noLogTopicsReason: (topics) => `die Topics sind ${topics}; erwartet wird eines vom Typ ${MESSAGE_TYPES.either}.`,
    singleLogReason: (series, logRole) =>
      `es ist nur ein Log darin, ${series}${logRole ? `, nach Namen oder Typ die ${ROLE_NAMES[logRole]}` : ''}; gebraucht ${logRole ? `wird auch die ${ROLE_NAMES[logRole === 'odometry' ? 'reference' : 'odometry']}` : 'werden Odometrie und Referenz'}.`,
    missingRoleReason: (logRole, series) => `nach Namen und Typen ist keine ${ROLE_NAMES[logRole]} darin, sondern ${series}; eines davon auswählen, oder auch eine Datei mit der ${ROLE_NAMES[logRole]} angeben.`,
    ambiguousRoleReason: (logRole, series) => `es ist nicht klar, was die ${ROLE_NAMES[logRole]} ist: ${series}.`,
    wrongTypeReason: (type, neededType) => `sein Typ ist „${type}“; erwartet wird ${MESSAGE_TYPES[neededType]} (kodiert als cdr oder ros1).`,
    unreadableMessageReason: (reason) => `sie lässt sich nicht lesen (${reason}); erwartet wird eine vom Typ des Topics.`,
    missingFramesReason: (knownFrames) => knownFrames ? `einen Parent- und einen Child-Frame angeben; verbunden sind ${knownFrames}.` : 'das Topic hat keine Transformationen; ein anderes Topic wählen.',
    unconnectedFramesReason: (framePair, knownFrames) =>
      `keine Transformationen verbinden ${framePair}; ${knownFrames ? `verbundene Frames wählen: ${knownFrames}` : 'ein anderes Topic wählen, denn dieses hat keine Transformationen'}.`,
    constantTransformReason: (framePair, otherFrames) =>
      `die Transformation ${framePair} ändert sich nie und ist daher kein Weg eines Roboters; erwartet werden Frames, die sich bewegen${otherFrames ? `, wie ${otherFrames}` : ''}.`,
    sameLogReason: (name) => `${name} ist die Odometrie selbst; gebraucht wird eine Referenz, die nicht von den Rädern kommt, wie Motion-Capture oder Scan-Matching.`,
    otherUnitReason: (factor, otherName, unit) => `der Roboter führe ${Math.round(factor)}-mal so schnell wie in ${otherName}: Die Längen sind wohl in ${unit}; ihre Einheit angeben.`,
    stillOdometryReason: 'ihre Pose ändert sich nie; gebraucht wird die Odometrie eines Roboters, der fährt.',
    frozenReferenceReason: 'ihre Pose steht, während die Odometrie weitergeht: Sie hat den Roboter verloren; gebraucht wird eine, die ihm folgt.',
    unknownRoleReason: 'ihr Name sagt nicht, ob sie Odometrie oder Referenz ist; die Dateien nach dem Muster odom1.csv, truth1.csv, odom2.csv, … benennen, oder die Rolle jeder auswählen.',
    unpairedLogsReason: (odometry, reference) => `die Odometrie ist in ${odometry || 'keiner Datei'}, und die Referenz in ${reference || 'keiner Datei'}; gebraucht wird je eines für eine Fahrt.`,
  },
  logChoiceTexts: {
    roleNames: ROLE_NAMES,
    openPlaceholder: 'auswählen',
    skippedFileNote: (reason) => `Nicht verwendet: ${reason}`,
    timeUnit: (file) => `Einheit der Zeiten in ${file}`,
    lengthUnit: (file) => `Einheit der Längen in ${file}`,
    angleUnit: (file) => `Einheit der Richtungen in ${file}`,
    unitNames: { s: 'Sekunden (s)', ms: 'Millisekunden (ms)', us: 'Mikrosekunden (µs)', ns: 'Nanosekunden (ns)', m: 'Meter (m)', cm: 'Zentimeter (cm)', mm: 'Millimeter (mm)', ft: 'Fuß (ft)', in: 'Zoll (in)', rad: 'Radiant (rad)', deg: 'Grad (°)' },
    columnsLegend: (file, isProposal) => `Spalten von ${file}${isProposal ? ' (vorgeschlagen)' : ''}: auswählen, dann lesen`,
    columnLabel: (number, cell) => `Spalte ${number}: ${cell}`,
    fieldNames: FIELD_NAMES,
    noColumnLabel: 'keine',
    readLabel: 'Lesen',
    bothFilesHint: 'Die andere Datei auch hierher ziehen oder wählen, oder beide zugleich.',
  },
  logSummaryTexts: {
    summaryTitle: 'Was gelesen wurde',
    driveCaption: (number) => `Fahrt ${number}`,
    pathsCaption: (isAligned, width, height) => `Wege von oben: Referenz (durchgezogen) und Odometrie (gestrichelt, ${isAligned ? 'an ihr' : 'nicht'} ausgerichtet); ${width} m mal ${height} m.`,
    rowLabels: { rows: 'gelesen', columns: 'Spalten', units: 'Einheiten', frames: 'Frames', clock: 'Zeiten', dropped: 'weggelassen', gaps: 'Lücken', jumps: 'Sprünge', notes: 'Hinweise' },
    rowsSummary: (used, rows, seconds, rate, distance) => `${used} von ${rows} Zeilen, ${withDecimalComma(seconds, 1)} s mit ${rate.toPrecision(3).replace('.', ',')} Hz, ${withDecimalComma(distance, 1)} m gefahren`,
    unitsSummary: ({ time, length, angle }) =>
      `Zeit in ${time.unit}${UNIT_BASIS_TEXTS[time.by]}, Längen in ${length.unit}${UNIT_BASIS_TEXTS[length.by]}${ANGLE_UNIT_TEXTS[angle.unit] ? `, ${ANGLE_UNIT_TEXTS[angle.unit]}${UNIT_BASIS_TEXTS[angle.by]}` : ''}`,
    droppedRowsSummary: (reason, count, line) => `${countWithNoun(count, 'Zeile', 'Zeilen')}${line ? ` ${count === 1 ? 'in' : 'ab'} Zeile ${line}` : ''}: ${DROP_REASONS[reason]}`,
    noGapsSummary: 'keine',
    gapsSummary: (count, first, longest) => `${count}, die erste ${withDecimalComma(first, 2)} s nach dem Start, die längste von ${withDecimalComma(longest, 2)} s`,
    jumpsSummary: (count, first) => `${count}, der erste ${withDecimalComma(first, 2)} s nach dem Start`,
    recordedTimesNote: 'die der Aufzeichnung, da die Header keine oder immer dieselben haben',
    notes: {
      damaged: (count, reason) => `${count} ${count === 1 ? 'beschädigter Block' : 'beschädigte Blöcke'} ausgelassen (${reason})`,
      cutShort: 'die Datei ist unvollständig: Sie endet mitten in einer Zeile oder einem Record',
      yUp: 'Y ist die senkrechte Achse',
      wFirst: 'die Quaternionen beginnen mit w',
      swappedRoles: (odometry) => `sie heißt wie eine Odometrie, und ${odometry} nicht: Ist die Odometrie als Referenz angegeben?`,
      sorted: (count) => `${countWithNoun(count, 'verspätete Zeile', 'verspätete Zeilen')} nach der Zeit sortiert`,
      apart: (name, period, otherPeriod) => `keine Zeit gemeinsam mit ${name} (${period}, und ${otherPeriod}): Die Uhren werden nach den Drehungen des Roboters gestellt`,
      localizer: 'die Schätzung eines Lokalisierers, deren Fehler der Odometrie folgen: Die Referenz muss unabhängig gemessen sein',
    },
  },
};
