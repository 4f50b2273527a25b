/** Map Squeeze in English; see messages/en.ts. */

import { formatCount } from '../../messages/en.ts';

export const en = {
  title: 'Map Squeeze',
  floorTitle: 'On the floor: where one command may end',
  presets: { doorway: 'Facing a doorway', wall: 'Facing a wall', corridor: 'Open corridor' },
  samplerNames: { endpoint: 'Endpoint', 'whole-arc': 'Whole arc', 'sub-stepped': 'Each sub-step' },
  settings: {
    noise: { name: 'noise level', effect: 'Spreads the cloud: sets α₁ to α₄; α₅ and α₆ are a quarter.' },
    clearance: { name: 'robot radius', effect: 'A wider robot fits in fewer places and meets more walls.' },
    unknown: { name: 'Unknown cells' },
    sampler: { name: 'Sampler: where it tests for walls' },
    steps: { name: 'sub-steps', effect: 'Parts of the command, each with noise of its own.' },
    samples: { effect: 'More samples narrow the interval of the share.' },
    view: { name: 'View' },
  },
  overlays: {
    accepted: 'accepted', through: 'accepted through a wall', rejected: 'rejected',
    commanded: 'commanded path', unknown: 'unknown cells',
  },
  unknownCellNames: { free: 'free', blocked: 'blocked' },
  viewNames: { whole: 'whole map', close: 'close-up' },
  robotAndMapTitle: 'Robot and map',
  mapNotInLinkNote: 'Your map is too large for a link and is not in it: the figure opens with the apartment.',
  mapNotInCodeNote: 'Your map is not in it: give it to the property map, or the figure opens with the apartment.',
  conditionedLabel: 'Check samples against the map',
  headline: {
    noMotionHeadline: 'No motion has been tried yet',
    noneAcceptedHeadline: 'No motion was accepted',
    noneThroughWallHeadline: 'No accepted motion went through a wall',
    shareThroughWallHeadline: (sharePercent) => `${sharePercent} of the accepted motions went through a wall`,
  },
  wedgedNote: (drawnCount, accepted, requestedCount, through) =>
    `The robot is wedged: ${drawnCount} sub-steps drawn completed only ${accepted} of ${requestedCount} motions; ${through}.`,
  nothingAcceptedNote: (drawnCount) => `No sample was accepted: none of the ${drawnCount} drawn is collision-free.`,
  startCollisionNote: 'The start pose is in collision.',
  /** Sentences on the number of accepted motions, by sampler. In the caption, a clause on motions through walls follows. */
  testedSentences: {
    endpoint: (accepted, attemptCount) => `${accepted} of ${attemptCount} motions end where the robot fits and are accepted`,
    'whole-arc': (accepted, attemptCount) => `${accepted} of ${attemptCount} motions keep clear of walls all the way and are accepted`,
    'sub-stepped': (accepted, attemptCount) => `${accepted} of ${attemptCount} motions end each sub-step where the robot fits and are accepted`,
    off: (accepted) => `Without the map all ${accepted} motions are accepted`,
  },
  throughWallClause: (throughWallCount, through, sharePercent, intervalText) =>
    `${throughWallCount === 0 ? 'none of them' : `${through} of them, ${sharePercent},`} went through a wall${intervalText && ` (95\u202f% interval ${intervalText})`}`,
  densityNote: 'Density: darker = more samples; colour = most frequent outcome per cell.',
  apartmentName: 'The apartment',
  editedMapName: 'Edited apartment',
  pastedMapName: 'Pasted plan',
  mapDescription: (name, mapWidth, mapHeight, wallCount) => `${name}: ${mapWidth} m × ${mapHeight} m, ${formatCount(wallCount, 'wall')}`,
  contactLabel: 'through this wall',
  handles: { start: ['Robot', 'Heading of the robot'] },
  wallHandles: {
    doorwayEdgeName: 'Edge of a doorway',
    wallName: 'Wall',
    hint: '□ Drag to move a wall',
    keysHint: 'Arrow keys move it, with Shift by larger steps; comma and period, or [ and ], go to the other walls',
  },
  tallyLabels: {
    drawnSamplesLabel: 'drawn',
    drawsPerAcceptedLabel: 'samples drawn per accepted sample',
    wallTestsPerAcceptedLabel: 'wall distances computed per accepted sample',
  },
  sample: 'Sample',
  markHint: 'Point at one to see its path and its verdict.',
  costTable: {
    measureLabel: 'Measure the cost of each sampler',
    caption:
      'Cost of one accepted sample for each sampler at the settings above, measured on this device; and the share of a core that 2000 particles at 20 Hz would take. Repeated runs differ by several per cent.',
    samplerColumn: 'sampler',
    drawsColumn: 'samples drawn',
    wallTestsColumn: 'wall distances',
    coreShareColumn: 'of a core',
    wedged: 'wedged: too few are accepted',
  },
  userMap: {
    readingNotice: 'Reading the map …',
    title: 'A map of your own',
    instructionsText: 'Drop files anywhere on this figure, or choose them here: a floor plan in JSON, or a map of ROS map_server, its YAML file and its PGM or PNG image together. They do not leave this device.',
    chooseFilesLabel: 'Choose map files',
    leaveLabel: 'Back to the apartment',
    planFieldLabel: 'Or a floor plan here, in metres',
    usePlanLabel: 'Use this plan',
  },
  /** Reasons for refusing files. A reason names the file, the line or field, and what was expected. */
  refusals: {
    cannotOpenSentence: (reason) => `The map cannot be opened: ${reason}.`,
    wrongFilesSentence: (fileNames) => `${fileNames}: expected is one .json floor plan, or one .yaml file together with its .pgm or .png image.`,
    largeFileSentence: (name, byteCount, maxBytes) => `${name}: the file has ${byteCount} bytes; expected are at most ${maxBytes}.`,
    invalidPlanSentence: (name, reason) => `${name}: ${reason}; expected is {"bounds": [x0, y0, x1, y1], "walls": [[x0, y0, x1, y1], …]} in metres.`,
    invalidImageNameSentence: (name, imageField) => `${name}: image is ${imageField || 'missing'}; expected is the name of a .pgm or .png file.`,
    missingImageSentence: (name, namedImage, givenImage) =>
      `${name}: image names ${namedImage}, which is not there${givenImage && ` (${givenImage} came instead)`}; expected are both files together.`,
    invalidYamlSentence: (name, lineNumber, reason) => `${name}, line ${lineNumber}: ${reason}; expected is one field a line, as in resolution: 0.05.`,
    invalidLineSentence: (name, lineNumber, reason) => `${name}, line ${lineNumber}: ${reason}.`,
  },
} satisfies import('../../messages/registry.ts').MessageEntry;
