/** Sentences about logs, in English. */

import type { UnitBasis, DropCause, Recording, LogRole, LogSummary } from './log.ts';

const FIELD_NAMES: Record<string, string> = { t: 'time', x: 'x', y: 'y', yaw: 'yaw', qx: 'qx', qy: 'qy', qz: 'qz', qw: 'qw', v: 'speed v', omega: 'turn rate ω' };

const NEEDED_COLUMNS = {
  poses: 'x, y and yaw (or qx, qy, qz and qw)',
  either: 'x, y and yaw (or qx, qy, qz and qw), or v and omega',
};

const POSE_TYPES = 'nav_msgs/Odometry, geometry_msgs/PoseStamped, PoseWithCovarianceStamped, TransformStamped, Pose, Pose2D or tf2_msgs/TFMessage';
const COMMAND_TYPES = 'geometry_msgs/Twist, TwistStamped or TwistWithCovarianceStamped';
const MESSAGE_TYPES = { poses: POSE_TYPES, either: `${POSE_TYPES}, or ${COMMAND_TYPES}`, transforms: 'tf2_msgs/TFMessage, which has frames' };

const UNIT_BASIS_TEXTS: Record<UnitBasis, string> = { name: ' (by name)', size: ' (by size)', rate: ' (by rate and speed)', format: '', date: ' (from dates)', option: ' (as stated)', usage: ' (assumed)' };

const ANGLE_UNIT_TEXTS: Record<LogSummary['units']['angle']['unit'], string> = { rad: 'yaw in rad', deg: 'yaw in degrees', quaternion: 'yaw from a quaternion', none: '' };

const DROP_REASONS = {
  damaged: 'damaged messages',
  notFinite: 'a value that is not finite, or above a billion',
  noRotation: 'a quaternion that is no rotation',
  short: 'too few cells or digits',
  text: 'a cell that is not a number',
  noStamp: 'a stamp of 0',
  duplicate: 'the time of the row before',
  repeated: 'a pose repeated at a higher rate than it was measured',
  burst: 'arrived together with the next row, so that its time is not that of its measurement',
  held: 'the pose stands still while the odometry moves on',
};

export const REPAIR_COMMANDS: Record<Recording['recordingFormat'], string> = { mcap: 'mcap recover', rosbag: 'rosbag reindex', sqlite: 'sqlite3 FILE .recover | sqlite3 NEW.db3', csv: '' };

export const english = {
  errorPlaceText: (file: string, line: number, topic: string) =>
    `${file}${topic ? `, topic ${topic}` : ''}${line ? `, ${topic ? 'message' : 'line'} ${line}` : ''}`,
  /** Reasons for refusing a log. In an error message, a reason follows the place of the error. */
  refusalReasons: {
    unreadableFileReason: (reason: string) => (reason === 'ENOENT' ? 'there is no such file or folder.' : `the file cannot be read (${reason}); check that it exists and may be read.`),
    emptyFileReason: 'there is nothing in it; expected is a log of poses or commands.',
    unknownFormatReason: 'it is neither text nor a known recording; expected is a ROS bag, rosbag2, MCAP, or a table as CSV or TUM, unpacked from an archive.',
    longLineReason: (max: number) => `the line has more than ${max} bytes; expected is one row a line.`,
    noLogReason: 'it does not look like a log, as it has no rows of numbers; expected is a table with a header such as “t,x,y,yaw” and below it one row a time, or a recording of ROS.',
    noTimeColumnReason: (columns: string) =>
      `none of the columns ${columns} is the time; expected is one named t, time, timestamp or stamp, or two named sec and nanosec, or a choice of columns.`,
    missingColumnsReason: (neededFields: keyof typeof NEEDED_COLUMNS, columns: string) =>
      `the columns are ${columns}; expected are ${NEEDED_COLUMNS[neededFields]} among them, or a choice of columns.`,
    globeReason: 'latitude and longitude are angles; give x and y in metres, projected to a plane as by UTM or ENU.',
    ambiguousColumnReason: (field: string, column: string, otherColumn: string) =>
      `both “${column}” and “${otherColumn}” may be the column of ${FIELD_NAMES[field]}; expected is one of them.`,
    shortRowReason: (count: number, needed: number) => `the row has ${count} ${count === 1 ? 'cell' : 'cells'}; expected are at least ${needed}.`,
    wideRowReason: (count: number, needed: number, header: number) =>
      `the row has ${count} cells, and the header in line ${header} ${needed}; expected are as many, with decimal points in numbers, or semicolons between cells.`,
    columnCountReason: (cellCount: number, nameCount: number) => `the row has ${cellCount} cells, and --columns names ${nameCount}; name each column in order, with - for those to skip.`,
    noHeaderReason: (count: number, row: string) =>
      `the table has no header, and its first row is “${row}”; name its ${count} columns.`,
    noTableReason: (notation: string) => `it is ${notation}, not a table; write one row a time, as by ros2 topic echo --csv, rostopic echo -p or pandas, or give the recording itself.`,
    noHeadingReason: (columns: string) =>
      `${columns} are positions without a heading; give a reference that measures the heading, as by two prisms, markers or scan matching (in a table, in a column named yaw with the prefix of x and y): the direction of travel hides turning errors, and would halve alpha1 and alpha2.`,
    eulerAnglesReason: (rotation: string) => `the rotations are Euler angles (${rotation}); export the take from Motive again with the rotation type Quaternion.`,
    tiltedPosesReason: 'the poses do not turn about a vertical Z axis; export or record them again with Z up.',
    yUpReason: 'the headings follow the path in x and z, so the vertical axis is Y; export with Z up, or choose the columns in another order.',
    mirroredPathReason: 'the headings turn the other way than the path; expected are headings that grow counterclockwise, from x to y; swap x and y, or negate one of them.',
    mixedSourcesReason: (framePair: string) => `the rows are of several frames, topics or robots (${framePair}); keep those of one.`,
    unknownUnitReason: (unit: string) => `the unit ${unit} of a column is not known, or differs from that of another; expected is s, ms, us or ns, m, cm, mm, ft or in, and rad or deg.`,
    alternatingPathsReason: (metres: number) => `poses of two paths alternate, ${metres.toPrecision(2)} m apart: they are of two robots, or of two nodes that publish one topic; keep those of one.`,
    damagedRowsReason: (badCount: number, rows: number, percent: number) => `${badCount} of ${rows} rows are damaged; at most ${percent} % may be.`,
    notNumericReason: (column: string, value: string) => `${column} is “${value}”; expected is a number${/^\d{1,3}(\D\d{3})+\b/.test(value) ? ' without separators of thousands' : /^[+-]?\d*,\d+$/.test(value) ? ' with a decimal point' : /\d[/:-]\d/.test(value) ? ', or a date as 2024-01-31 12:00:00.5' : ''}.`,
    tooManyRowsReason: (max: number) => `there are more rows; expected are at most ${max}.`,
    clockSetBackReason: (seconds: number) =>
      `times go back by ${seconds.toPrecision(3)} s and repeat those before; split the file there, give one recording only, or write fractions with their leading zeros (1.050000000 for 1 s and 50000000 ns).`,
    equalTimesReason: (count: number, rows: number) =>
      `${count} of ${rows} rows, this one first, have the time of another row and other values; give the log of one robot, with all digits of its times (a spreadsheet, or a format such as %.9e, may have rounded them).`,
    fewRowsReason: (kept: number, rows: number, reason?: DropCause) =>
      `${kept} of ${rows} rows can be used${reason ? ` (${DROP_REASONS[reason]})` : ''}; expected are at least 2.`,
    timeUnit: (rate: number, unit: string, choices: string[]) =>
      `in ${unit}, the times would mean ${rate.toPrecision(3)} rows a second; ${choices.length ? `state their unit: ${choices.join(' or ')}` : 'write them in s, or as dates such as 2024-01-31 12:00:00.5 (a spreadsheet counts days)'}.`,
    lengthUnit: (speed: number, unit: string, choices: string[]) =>
      `in ${unit}, the robot would drive at ${speed.toPrecision(3)} m/s; state the unit of lengths: ${choices.join(' or ')}.`,
    angleUnit: (turn: number, unit: string, choices: string[]) =>
      `headings in ${unit} would turn at ${turn.toPrecision(3)} rad/s; state their unit: ${choices.join(' or ')}.`,
    damagedFileReason: (reason: string, format?: Recording['recordingFormat']) => `it is damaged or incomplete (${reason}); copy it again from the robot${format ? `, or try “${REPAIR_COMMANDS[format]}”` : ''}.`,
    largeFileReason: (command: string, max: number) => `it has more than ${max} bytes when it is decompressed; decompress it with “${command}”, and give the result.`,
    foreignDatabaseReason: 'it is an SQLite database without the tables “topics” and “messages” of rosbag2; expected is a recording of “ros2 bag record”.',
    listedFileReason: 'it is listed in the metadata.yaml of a recording, but is not a recording; expected is an MCAP or .db3 file.',
    journalFileReason: 'it is a journal with messages that its .db3 file lacks; end the recorder, or write them back with “sqlite3 FILE.db3 \'PRAGMA wal_checkpoint\'”.',
    unreadFormatReason: (format: string, command?: string) => `it is in the format ${format}; ${command ? `convert it with “${command}”, and give the result` : 'unpack it, or export it as CSV'}.`,
    missingFilesReason: (files: string) => `it describes a recording in ${files}; give that file too, or the whole folder.`,
    unknownTopicReason: (series: string) => `it has no such topic, group of columns or transforms; expected is one of ${series}.`,
    noLogTopicsReason: (topics: string) => `the topics are ${topics}; expected is one of type ${MESSAGE_TYPES.either}.`,
    singleLogReason: (series: string, logRole: LogRole | undefined) =>
      `it has one log only, ${series}${logRole ? `, by name or type the ${logRole}` : ''}; give ${logRole ? `the ${logRole === 'odometry' ? 'reference' : 'odometry'} too` : 'odometry and reference'}.`,
    missingRoleReason: (logRole: LogRole, series: string) => `by its names and types it has no ${logRole}, but ${series}; choose one of these, or give a file with the ${logRole} too.`,
    ambiguousRoleReason: (logRole: LogRole, series: string) => `it is not clear what the ${logRole} is: ${series}.`,
    wrongTypeReason: (type: string, neededType: keyof typeof MESSAGE_TYPES) => `its type is “${type}”; expected is ${MESSAGE_TYPES[neededType]} (encoded as cdr or ros1).`,
    unreadableMessageReason: (reason: string) => `it cannot be read (${reason}); expected is one of the topic's type.`,
    missingFramesReason: (knownFrames: string) => knownFrames ? `give a parent and a child frame; connected are ${knownFrames}.` : 'the topic has no transforms; choose another topic.',
    unconnectedFramesReason: (framePair: string, knownFrames: string) =>
      `no transforms connect ${framePair}; ${knownFrames ? `choose among the connected frames: ${knownFrames}` : 'choose another topic, since this one has no transforms'}.`,
    constantTransformReason: (framePair: string, otherFrames: string) =>
      `the transform ${framePair} never changes, so it is not the path of a robot; expected are frames that move${otherFrames ? `, such as ${otherFrames}` : ''}.`,
    sameLogReason: (name: string) => `${name} is the odometry itself; choose a reference that does not come from the wheels, such as motion capture or scan matching.`,
    otherUnitReason: (factor: number, otherName: string, unit: string) => `the robot would drive ${Math.round(factor)} times as fast as in ${otherName}: its lengths seem to be in ${unit}; state their unit.`,
    stillOdometryReason: 'its pose never changes; give the odometry of a robot that drives.',
    frozenReferenceReason: 'its pose stands still while the odometry moves on: it has lost the robot; give one that follows the robot.',
    unknownRoleReason: 'its name does not say whether it is odometry or reference; name the files as odom1.csv, truth1.csv, odom2.csv, …, or choose the role of each.',
    unpairedLogsReason: (odometry: string, reference: string) => `the odometry is in ${odometry || 'no file'}, and the reference in ${reference || 'no file'}; give one of each for a drive.`,
  },
  logChoiceTexts: {
    roleNames: { odometry: 'Odometry', reference: 'Reference' },
    openPlaceholder: 'choose',
    skippedFileNote: (reason: string) => `Not used: ${reason}`,
    timeUnit: (file: string) => `Unit of times in ${file}`,
    lengthUnit: (file: string) => `Unit of lengths in ${file}`,
    angleUnit: (file: string) => `Unit of headings in ${file}`,
    unitNames: { s: 'seconds (s)', ms: 'milliseconds (ms)', us: 'microseconds (µs)', ns: 'nanoseconds (ns)', m: 'metres (m)', cm: 'centimetres (cm)', mm: 'millimetres (mm)', ft: 'feet (ft)', in: 'inches (in)', rad: 'radians (rad)', deg: 'degrees (°)' },
    columnsLegend: (file: string, isProposal: boolean) => `Columns of ${file}${isProposal ? ' (proposed)' : ''}: choose, then read`,
    columnLabel: (number: number, cell: string) => `column ${number}: ${cell}`,
    fieldNames: FIELD_NAMES,
    noColumnLabel: 'none',
    readLabel: 'Read',
    bothFilesHint: 'Drop or choose the other file too, or both at once.',
  },
  logSummaryTexts: {
    summaryTitle: 'What was read',
    driveCaption: (number: number) => `Drive ${number}`,
    pathsCaption: (isAligned: boolean, width: string, height: string) => `Paths from above: reference (solid) and odometry (dashed, ${isAligned ? 'aligned with it' : 'not aligned'}); ${width} m by ${height} m.`,
    rowLabels: { rows: 'read', columns: 'columns', units: 'units', frames: 'frames', clock: 'times', dropped: 'left out', gaps: 'gaps', jumps: 'jumps', notes: 'notes' },
    rowsSummary: (used: number, rows: number, seconds: number, rate: number, distance: number) =>
      `${used} of ${rows} rows, ${seconds.toFixed(1)} s at ${rate.toPrecision(3)} Hz, ${distance.toFixed(1)} m driven`,
    unitsSummary: ({ time, length, angle }: LogSummary['units']) =>
      `time in ${time.unit}${UNIT_BASIS_TEXTS[time.by]}, lengths in ${length.unit}${UNIT_BASIS_TEXTS[length.by]}${ANGLE_UNIT_TEXTS[angle.unit] ? `, ${ANGLE_UNIT_TEXTS[angle.unit]}${UNIT_BASIS_TEXTS[angle.by]}` : ''}`,
    droppedRowsSummary: (reason: DropCause, count: number, line: number) =>
      `${count} ${count === 1 ? 'row' : 'rows'}${line ? (count === 1 ? `, line ${line}` : `, from line ${line} on`) : ''}: ${DROP_REASONS[reason]}`,
    noGapsSummary: 'none',
    gapsSummary: (count: number, first: number, longest: number) => `${count}, the first ${first.toFixed(2)} s after the start, the longest of ${longest.toFixed(2)} s`,
    jumpsSummary: (count: number, first: number) => `${count}, the first ${first.toFixed(2)} s after the start`,
    recordedTimesNote: 'when messages were recorded, as their headers have no stamps, or all the same one',
    notes: {
      damaged: (count: number, reason: string) => `${count} damaged ${count === 1 ? 'block' : 'blocks'} skipped (${reason})`,
      cutShort: 'the file is incomplete: it ends in the middle of a row or record',
      yUp: 'Y is the vertical axis',
      wFirst: 'the quaternions start with w',
      swappedRoles: (odometry: string) => `it is named like odometry, and ${odometry} is not: was the odometry given as the reference?`,
      sorted: (count: number) => `${count} late ${count === 1 ? 'row' : 'rows'} sorted by time`,
      apart: (name: string, period: string, otherPeriod: string) =>
        `no time in common with ${name} (${period}, and ${otherPeriod}): the clocks are aligned by the turns of the robot`,
      localizer: 'a localizer’s own estimate, whose errors follow the odometry: measure the reference independently',
    },
  },
};
