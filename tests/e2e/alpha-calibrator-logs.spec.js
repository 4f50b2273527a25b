import { spawnSync } from 'node:child_process';
import { expect, test as testWithWarnings } from '@playwright/test';
import { recordingOf } from '../mcap.js';
import { captionOf, chooseTables, chooseRecording, readExampleTable, openCalibrator, createExampleRecording, alphaRowsOf, exampleRowsOf, readStats, simulatedTablesOf } from './calibrator-support.js';
import { REDUCED_MOTION, dropFiles, readState, takeEvents, test, openDisclosures, waitUntilSettled } from './support.js';

/**
 * @typedef {import('@playwright/test').Locator} Locator
 * @typedef {import('./calibrator-support.js').AlphaCalibratorElement} AlphaCalibratorElement
 */

test.use(REDUCED_MOTION);
testWithWarnings.use(REDUCED_MOTION);

test('two tables of a user replace the simulated log, and a button restores the simulated log', async ({ page }) => {
  const calibrator = await openCalibrator(page);
  const logTables = await simulatedTablesOf(calibrator);
  // The clock of the reference is an hour ahead.
  const laterReferenceTable = logTables.reference.replaceAll(/^\d+/gm, (secondsText) => `${Number(secondsText) + 3600}`);
  await chooseTables(calibrator, { 'truth.csv': laterReferenceTable, 'odom.csv': logTables.odometry });
  await waitUntilSettled(calibrator);
  expect(await captionOf(calibrator).innerText()).toMatch(/ \d+ legs of odom\.csv, truth\.csv[.,]/);
  expect(await calibrator.evaluate((element) => /** @type {AlphaCalibratorElement} */ (element).simulation.truth)).toBeNull();
  await expect(calibrator.locator('.drop-zone .present')).toHaveText('Results of odom.csv, truth.csv.');
  await expect(calibrator.getByRole('row', { name: /^read \d+ of \d+ rows/ })).toBeVisible();
  await expect(calibrator.getByRole('img', { name: /^Paths from above: .*, aligned with it\); .* m by .* m\.$/ })).toBeVisible();
  // File names decide which log is the odometry and which is the reference. The order of the chosen files has no effect.
  await calibrator.getByLabel('odom.csv', { exact: true }).selectOption('Reference');
  await expect(captionOf(calibrator)).toHaveText(/of truth\.csv, odom\.csv[.,]/);
  await calibrator.getByRole('button', { name: 'Back to the simulated log' }).click();
  await expect(captionOf(calibrator)).toHaveText(/of the simulated log/);
  const errorAlert = calibrator.getByRole('alert');
  await chooseTables(calibrator, { 'odom.csv': logTables.odometry });
  await expect(errorAlert).toHaveText(/^odom\.csv: it has one log only, .* the odometry; give the reference too\. Drop or choose the other file too,/);
  // The α's on screen belong to the previous log. They cannot be copied until the user confirms these results.
  const outdatedResultsText = 'The results are still those of the simulated log. The files chosen last are not used.';
  await expect(calibrator.locator('.drop-zone .muted')).toContainText(outdatedResultsText);
  await expect(calibrator.locator('.to-do')).toHaveText(outdatedResultsText);
  await openDisclosures(calibrator);
  const resultButtons = ['Fit for Nav2', 'Save all as JSON'].map((buttonName) => calibrator.getByRole('button', { name: buttonName }));
  for (const resultButton of resultButtons) await expect(resultButton).toBeDisabled();
  await calibrator.getByRole('button', { name: 'Dismiss these files' }).click();
  for (const resultButton of resultButtons) await expect(resultButton).toBeEnabled();
  await expect(errorAlert).toHaveCount(0);
  await chooseTables(calibrator, { 'odom.csv': logTables.odometry });
  await expect(errorAlert).toHaveCount(1);
  await chooseTables(calibrator, { 'truth.csv': logTables.reference });
  await expect(captionOf(calibrator)).toHaveText(/of odom\.csv, truth\.csv[.,]/);
  await chooseTables(calibrator, { 'odom.csv': '', 'truth.csv': '' });
  await expect(errorAlert).toHaveText(/^odom\.csv: there is nothing in it/);
  await expect(calibrator.locator('.to-do')).toHaveText('The results are still those of odom.csv, truth.csv. The files chosen last are not used.');
  // After the refused files are dismissed, the user can again choose odometry and reference from the earlier files.
  await calibrator.getByRole('button', { name: 'Dismiss these files' }).click();
  await calibrator.getByLabel('odom.csv', { exact: true }).selectOption('Reference');
  await expect(captionOf(calibrator)).toHaveText(/of truth\.csv, odom\.csv[.,]/);
});

test('the figure and the command line give the same results to the last bit, also for a recording with topics chosen by the user', async ({ page }) => {
  const widget = await openCalibrator(page);
  await chooseTables(widget, { 'odometry.csv': readExampleTable('odometry'), 'reference.csv': readExampleTable('reference') });
  await expect(captionOf(widget)).toHaveText(/odometry\.csv, reference\.csv[.,]/);
  await waitUntilSettled(widget);
  const figureResults = await widget.evaluate((element) => {
    const { simulation: { stats, legs } } = /** @type {AlphaCalibratorElement} */ (element);
    return JSON.stringify({ ...stats, legs }, (_, jsonValue) => (ArrayBuffer.isView(jsonValue) ? [.../** @type {Float64Array} */ (jsonValue)] : jsonValue));
  });
  const fileArguments = ['odometry', 'reference'].flatMap((logRole) => [`--${logRole}`, `examples/calibration/${logRole}.csv`]);
  const { stdout } = spawnSync(process.execPath, ['dist/cli.js', 'calibrate', ...fileArguments, '--json'], {
    encoding: 'utf8', cwd: new URL('../..', import.meta.url), maxBuffer: 2 ** 28,
  });
  const { date, options, logs: reportedLogs, start, ...cliResults } = JSON.parse(stdout);
  expect([options, reportedLogs.length, start, typeof date]).toEqual([{ legs: { distance: 0.25, angle: 0.2 } }, 2, 9, 'string']);
  expect(JSON.parse(figureResults)).toEqual(cliResults);

  await chooseRecording(widget, 'run.mcap', await createExampleRecording(['/mocap/pose', '/vicon/pose']));
  await expect(widget.getByRole('alert')).toHaveText(/^run\.mcap: it is not clear what the reference is: .*\/vicon\/pose \(PoseStamped\)\.$/);
  await widget.getByLabel('Reference', { exact: true }).selectOption('/mocap/pose');
  await expect(captionOf(widget)).toHaveText(/of run\.mcap, \/odom, \/mocap\/pose[.,]/);
  await waitUntilSettled(widget);
  const { alphas } = await readStats(widget);
  // Results differ slightly, because converting the recording's quaternions rounds the headings.
  for (const [i, cliAlpha] of cliResults.alphas.entries()) expect(Number(alphas[i]) / cliAlpha).toBeCloseTo(1, 9);
});

test('the velocity model uses the commands of a file, and other models use the poses @nightly', async ({ page }) => {
  const widget = await openCalibrator(page, 'model="velocity"');
  await openDisclosures(widget);
  const readOdometryKeys = () => widget.evaluate((element) => Object.keys(/** @type {AlphaCalibratorElement} */ (element).log?.odometry ?? {}));
  const selectModel = async (/** @type {string} */ modelName, /** @type {string} */ modelKey) => {
    await widget.getByRole('radio', { name: modelName }).check();
    await expect.poll(readOdometryKeys).toContain(modelKey);
    await waitUntilSettled(widget);
  };
  // The command in a row applies until the time of the next row.
  const odometryRows = exampleRowsOf('odometry');
  const rowsWithCommands = odometryRows.map(([t, x, y, yaw], i) => {
    const [nextTime, nextX, nextY, nextYaw] = odometryRows[i + 1] ?? [t + 1, x, y, yaw];
    return [t, x, y, yaw, Math.hypot(nextX - x, nextY - y) / (nextTime - t), Math.atan2(Math.sin(nextYaw - yaw), Math.cos(nextYaw - yaw)) / (nextTime - t)].join(',');
  });
  await chooseTables(widget, { 'odom.csv': ['t,x,y,yaw,v,omega', ...rowsWithCommands].join('\n'), 'truth.csv': readExampleTable('reference') });
  await expect.poll(readOdometryKeys).toContain('omega');
  await waitUntilSettled(widget);
  expect((await readStats(widget)).alphas).toHaveLength(6);
  await selectModel('Table 5.6', 'theta');
  await selectModel('velocity', 'omega');
});

test('files of several drives are read together, and the user assigns the roles that file names leave open @nightly', async ({ page }) => {
  const widget = await openCalibrator(page);
  const splitExampleTable = (/** @type {'odometry' | 'reference'} */ logRole) => {
    const [headerLine, ...rowLines] = readExampleTable(logRole).trim().split('\n');
    const middleTime = Number(rowLines.at(-1)?.split(',')[0]) / 2;
    return [false, true].map((isSecondHalf) => [headerLine, ...rowLines.filter((rowLine) => Number(rowLine.split(',')[0]) > middleTime === isSecondHalf)].join('\n'));
  };
  const [[a, c], [b, d]] = [splitExampleTable('odometry'), splitExampleTable('reference')];
  await chooseTables(widget, { 'a.csv': a, 'b.csv': b, 'c.csv': c, 'd.csv': d });
  await expect(widget.getByRole('alert')).toHaveText(/^a\.csv: its name does not say whether it is odometry or reference;/);
  await expect(widget.getByLabel('a.csv')).toBeFocused();
  for (const [fileName, logRole] of [['a', 'Odometry'], ['b', 'Reference'], ['c', 'Odometry'], ['d', 'Reference']]) await widget.getByLabel(`${fileName}.csv`).selectOption(logRole);
  await expect(captionOf(widget)).toHaveText(/of a\.csv, c\.csv, b\.csv, d\.csv[.,]/);
  await expect(widget.locator('.found caption')).toHaveText(['Drive 1', 'Drive 2']);
});

test('the figure asks for missing names and units of columns, and the answer applies to that file only', async ({ page }) => {
  const widget = await openCalibrator(page);
  const rowsInMillimetres = exampleRowsOf('odometry').map(([t, x, y, yaw]) => [t, 1000 * x, 1000 * y, yaw].join(','));
  const errorAlert = widget.getByRole('alert');
  await chooseTables(widget, { 'notes.txt': 'hello', 'empty.csv': '' });
  await expect(errorAlert).toHaveText(/^notes\.txt: it does not look like a log,/);
  await expect(widget.locator('.choosers > p')).toHaveText([/^Not used: empty\.csv: there is nothing in it/]);
  await chooseTables(widget, { 'odom.csv': rowsInMillimetres.join('\n'), 'slam.csv': readExampleTable('reference') });
  await expect(errorAlert).toHaveText(/^odom\.csv, line 1: the table has no header, .* name its 4 columns\.$/);
  await expect(widget.getByRole('group', { name: 'Columns of odom.csv (proposed): choose, then read' }).getByLabel('time', { exact: true })).toBeFocused();
  await widget.getByRole('button', { name: 'Read', exact: true }).press('Enter');
  await expect(errorAlert).toHaveText(/in m, the robot would drive at .* state the unit of lengths: mm \(.* or cm \(.* or m \(.* or in \(.* or ft \(.* m\/s\)\.$/);
  await widget.getByRole('radiogroup', { name: 'Unit of lengths in odom.csv' }).getByRole('radio', { name: 'millimetres (mm)' }).check();
  await expect(captionOf(widget)).toHaveText(/of odom\.csv, slam\.csv[.,]/);
  await expect(widget.getByText('Warning: the reference is a localizer’s own estimate.').first()).toBeVisible();
});

test('two files of the same name get roles of their own, and columns are proposed that mirror one of them', async ({ page }) => {
  const widget = await openCalibrator(page);
  const mirroredRows = exampleRowsOf('reference').map(([t, x, y, yaw]) => [t, x, -y, -yaw].join(','));
  await widget.locator('#log-files').setInputFiles([readExampleTable('odometry'), ['t,x,y,yaw', ...mirroredRows].join('\n')].map((tableText) => ({ name: 'log.csv', mimeType: 'text/csv', buffer: Buffer.from(tableText) })));
  await widget.getByLabel('log.csv (2)', { exact: true }).selectOption('Reference');
  await expect(captionOf(widget)).toHaveText(/Do not use[^]* of log\.csv \(1\), log\.csv \(2\)[.,]/);
  await expect(widget.getByRole('group', { name: 'Columns of log.csv (2) (proposed)' }).getByLabel('yaw', { exact: true }).locator('option:checked')).toHaveText('− column 4: yaw');
  await widget.getByRole('button', { name: 'Read', exact: true }).click();
  await expect(captionOf(widget)).toHaveText(/Trust/);
  await expect(widget.getByRole('group', { name: 'Columns of log.csv (2): choose, then read' })).toBeVisible();
  const yColumn = widget.getByLabel('y', { exact: true });
  await yColumn.selectOption('column 3: y');
  await widget.getByRole('button', { name: 'Read', exact: true }).click();
  await expect(widget.getByRole('alert')).toContainText('the headings turn the other way than the path');
  await expect(yColumn.locator('option:checked')).toHaveText('− column 3: y');
});

test('the files of a dropped folder are one recording, and files that do not belong to it are ignored', async ({ page }) => {
  const widget = await openCalibrator(page);
  const cameraRecording = await recordingOf([0, 1].map((t) => ({ topic: '/image', type: 'std_msgs/msg/String', t, message: { data: '' } })));
  const base64Recordings = [await createExampleRecording(['/mocap/pose']), cameraRecording].map((recordingBytes) => recordingBytes.toString('base64'));
  await widget.locator('section.simulation').evaluate(async (dropTarget, encodedRecordings) => {
    const [recordingBytes, cameraBytes] = await Promise.all(encodedRecordings.map(async (encodedRecording) => (await fetch(`data:;base64,${encodedRecording}`)).arrayBuffer()));
    const splitRecordingMetadata = 'rosbag2_bagfile_information:\n  relative_file_paths: [run_0.mcap]\n';
    const journalFile = new File([new Uint8Array([0x37, 0x7f, 0x06, 0x82])], 'run_0.db3-wal');
    const fileEntries = [new File([recordingBytes], 'run_0.mcap'), new File([splitRecordingMetadata], 'metadata.yaml'), new File([cameraBytes], 'camera.mcap'), journalFile].map((droppedFile) =>
      ({ name: droppedFile.name, isDirectory: false, fullPath: `/run/${droppedFile.name}`, file: (/** @type {(file: File) => void} */ onFile) => onFile(droppedFile) }));
    const entryBatches = [fileEntries, []];
    const folderEntry = { isDirectory: true, createReader: () => ({ readEntries: (/** @type {(some: unknown) => void} */ onEntries) => onEntries(entryBatches.shift()) }) };
    const dataTransfer = { types: ['Files'], items: [{ kind: 'file', webkitGetAsEntry: () => folderEntry, getAsFile: () => null }] };
    dropTarget.dispatchEvent(Object.defineProperty(new Event('drop'), 'dataTransfer', { value: dataTransfer }));
  }, base64Recordings);
  await expect(captionOf(widget)).toHaveText(/of run, \/odom, \/mocap\/pose[.,]/);
  await expect(widget.locator('.choosers > p')).toHaveText([/^Not used: run_0\.db3-wal: it is a journal /, /^Not used: camera\.mcap: the topics are \/image /]);
});

test('a log with too few legs is refused, and the figure still shows the previous log and its name', async ({ page }) => {
  const widget = await openCalibrator(page);
  await chooseTables(widget, { 'odometry.csv': readExampleTable('odometry'), 'reference.csv': readExampleTable('reference') });
  await expect(captionOf(widget)).toHaveText(/of odometry\.csv, reference\.csv[.,]/);
  await waitUntilSettled(widget);
  const captionBefore = await captionOf(widget).textContent();
  const { alphas } = await readStats(widget);
  const shortDriveTable = Buffer.from('t,x,y,yaw\n0,0,0,0\n1,0,0,0\n2,0.01,0,0\n');
  await dropFiles(widget.locator('.stage').first(), ['odom.csv', 'truth.csv'].map((fileName) => ({ name: fileName, buffer: shortDriveTable })));
  await expect(widget.locator('.drop-zone').getByRole('alert')).toBeInViewport();
  await expect(widget.getByRole('alert')).toHaveText('Log refused: Not enough data: fewer than 8 legs have poses in both logs. Take both logs from one drive, choose shorter legs, or drive longer.');
  await waitUntilSettled(widget);
  expect(await captionOf(widget).textContent()).toBe(captionBefore);
  await expect(captionOf(widget).getByText('Trust')).toBeHidden();
  expect((await readStats(widget)).alphas).toEqual(alphas);
  await expect(widget.locator('.drop-zone .present')).toHaveText('Results of odometry.csv, reference.csv.');
  // The previous results are marked as outdated until the figure shows its simulated log again.
  await expect(widget.locator('.verdict')).toHaveCSS('filter', 'grayscale(1)');
  await widget.getByRole('button', { name: 'Start over' }).click();
  await expect(captionOf(widget)).toHaveText(/of the simulated log/);
  await expect(widget.getByRole('alert')).toHaveCount(0);
  await expect(widget.locator('.views')).toHaveCSS('filter', 'none');
});

/** Chooses two tables of 15 minutes, and returns the time of the choice. @param {Locator} widget */
const chooseLongTables = (widget) => widget.evaluate((element) => {
  const fileInput = /** @type {HTMLInputElement} */ (element.shadowRoot?.querySelector('#log-files'));
  const csvRowOf = (/** @type {number} */ i, /** @type {number} */ swayAmplitude) => {
    const [t, angle] = [i / 100, i / 400];
    return [t, 3 * Math.sin(angle), 3 - 3 * Math.cos(angle) + swayAmplitude * Math.sin(7 * t), angle % 6].join(',');
  };
  const { files: transferFiles, items: transferItems } = new DataTransfer();
  for (const [fileName, swayAmplitude] of /** @type {const} */ ([['odom.csv', 0], ['truth.csv', 0.02]])) {
    transferItems.add(new File([['t,x,y,yaw', ...Array.from({ length: 90_000 }, (_, i) => csvRowOf(i, swayAmplitude))].join('\n')], fileName));
  }
  fileInput.files = transferFiles;
  const startTime = performance.now();
  fileInput.dispatchEvent(new Event('change'));
  return startTime;
});

test('a log is read and fitted in a worker, so that the page stays responsive', async ({ page }) => {
  const widget = await openCalibrator(page);
  await page.evaluate(() => {
    const performanceEntries = /** @type {PerformanceEntry[]} */ ([]);
    const longTaskObserver = new PerformanceObserver((entryList) => void performanceEntries.push(...entryList.getEntries()));
    for (const entryType of ['longtask', 'layout-shift']) longTaskObserver.observe({ type: entryType });
    Object.assign(window, { entries: performanceEntries });
  });
  const startTime = await chooseLongTables(widget);
  await expect(captionOf(widget)).toHaveText(/of odom\.csv, truth\.csv[.,]/, { timeout: 20_000 });
  expect(page.workers().map((worker) => new URL(worker.url()).pathname)).toEqual(['/chunks/log-worker.js']);
  const { longestTaskShare, layoutShifts } = await page.evaluate((startTime) => {
    const recentEntries = /** @type {(PerformanceEntry & { value?: number, hadRecentInput?: boolean })[]} */ (Reflect.get(window, 'entries')).filter((performanceEntry) => performanceEntry.startTime > startTime);
    const taskDurations = recentEntries.filter(({ entryType }) => entryType === 'longtask').map(({ duration: taskDuration }) => taskDuration);
    return { longestTaskShare: Math.max(0, ...taskDurations) / (performance.now() - startTime), layoutShifts: recentEntries.flatMap(({ value, hadRecentInput }) => (value && !hadRecentInput ? value : [])) };
  }, startTime);
  // A worker reads the log. On the main thread, reading would be a single task of a third of the measured time.
  expect(longestTaskShare).toBeLessThan(0.2);
  // The Web Vitals call a layout unstable if its shift is 0.1 or more.
  expect(layoutShifts.reduce((layoutShiftSum, layoutShift) => layoutShiftSum + layoutShift, 0)).toBeLessThan(0.1);
  // A changed setting starts another fit. Until it ends, the figure shows the previous result.
  const { alphas } = await readStats(widget);
  const resultsWhileFitting = await widget.evaluate((element) => {
    const calibratorElement = /** @type {any} */ (element);
    calibratorElement.distance = 0.5;
    return { distance: calibratorElement.distance, alphas: calibratorElement.simulation.stats.alphas };
  });
  expect(resultsWhileFitting).toEqual({ distance: 0.5, alphas });
  await waitUntilSettled(widget);
  expect((await readStats(widget)).alphas).not.toEqual(alphas);
});

testWithWarnings('a log is read even if the page’s security policy forbids workers @nightly', async ({ page }) => {
  await page.route('**/bare.html', (route) => route.fulfill({
    contentType: 'text/html',
    headers: { 'content-security-policy': "worker-src 'none'" },
    body: '<script type="module" src="/external.js"></script><alpha-calibrator></alpha-calibrator>',
  }));
  await page.goto('/bare.html');
  const widget = page.locator('alpha-calibrator');
  await expect(widget.locator('.folds')).toBeVisible();
  await chooseTables(widget, { 'odometry.csv': readExampleTable('odometry'), 'reference.csv': readExampleTable('reference') });
  await expect(captionOf(widget)).toHaveText(/of odometry\.csv, reference\.csv[.,]/);
  expect(page.workers()).toEqual([]);
});

test('reading a log can be cancelled, which changes nothing in the figure', async ({ page }) => {
  const widget = await openCalibrator(page);
  const { odometry, reference } = await simulatedTablesOf(widget);
  await chooseTables(widget, { 'short-odom.csv': odometry, 'short-truth.csv': reference });
  await expect(captionOf(widget)).toHaveText(/of short-odom\.csv, short-truth\.csv[.,]/);
  const stateBefore = await readState(widget);
  await chooseLongTables(widget);
  await expect(widget.locator('.verdict')).toHaveCSS('opacity', '0.4');
  await widget.locator('.drop-zone').getByRole('button', { name: 'Stop' }).click();
  await expect(widget.getByRole('alert')).toHaveText('Stopped: everything is as it was.');
  await expect(widget.locator('.drop-zone progress')).toHaveCount(0);
  expect(await readState(widget)).toEqual(stateBefore);
  await expect(captionOf(widget)).toHaveText(/of short-odom\.csv, short-truth\.csv[.,]/);
  await expect(widget.locator('.choosers select')).toHaveCount(2);
  await expect(widget.getByLabel('short-odom.csv', { exact: true })).toHaveValue('odometry');
  await expect.poll(() => page.workers().length).toBe(0);
});

test('a new log replaces a log that is being fitted, and a removed figure has no worker until it is inserted again', async ({ page }) => {
  const widget = await openCalibrator(page);
  const widgetHandle = await widget.elementHandle();
  const firedErrors = await widget.evaluate(async (element) => {
    const calibratorElement = /** @type {AlphaCalibratorElement & { settled: Promise<void> }} */ (element);
    const errorMessages = /** @type {string[]} */ ([]);
    calibratorElement.addEventListener('error', (errorEvent) => void errorMessages.push(/** @type {ErrorEvent} */ (errorEvent).message));
    const poseColumnsOf = (/** @type {number} */ swayAmplitude) => {
      const circleAngles = Float64Array.from({ length: 60_000 }, (_, i) => i / 400);
      return { t: circleAngles.map((angle) => 4 * angle), x: circleAngles.map(Math.sin), y: circleAngles.map((angle) => swayAmplitude * Math.sin(28 * angle) - Math.cos(angle)), theta: circleAngles };
    };
    const [firstLog, secondLog] = ['first', 'second'].map((logName) => ({ name: logName, odometry: poseColumnsOf(0), reference: poseColumnsOf(0.02) }));
    calibratorElement.log = firstLog;
    calibratorElement.log = secondLog;
    await calibratorElement.settled;
    return errorMessages;
  });
  await expect(captionOf(widget)).toHaveText(/of second[.,]/);
  expect(firedErrors).toEqual([]);
  expect(page.workers()).toHaveLength(1);
  await widget.evaluate((element) => {
    Object.assign(element, { distance: 0.5 });
    element.remove();
  });
  await expect.poll(() => page.workers().length).toBe(0);
  const fittedDistance = await widgetHandle?.evaluate(async (/** @type {any} */ figureElement) => {
    document.body.append(figureElement);
    await figureElement.settled;
    return figureElement.viewModel.fittedConfig.distance;
  });
  expect(fittedDistance).toBe(0.5);
});

test('a log set by the page is fitted and not saved in states, and a refused log leaves the previous log', async ({ page }) => {
  const widget = await openCalibrator(page);
  const stateBefore = await readState(widget);
  const captionBefore = await captionOf(widget).innerText();
  const readLeftEdge = () => widget.evaluate((element) => /** @type {any} */ (element).pictures[0].pictureView.shownExtent.xMin);
  const leftEdgeBefore = await readLeftEdge();
  const refusalMessages = await widget.evaluate(async (element) => {
    const figureElement = /** @type {AlphaCalibratorElement} */ (element);
    const { legs } = figureElement.simulation;
    const t = Array.from({ length: legs.count }, (_, legIndex) => legIndex);
    const poseComponentOf = (/** @type {Float64Array} */ legPoses, /** @type {number} */ componentIndex) => t.map((legIndex) => legPoses[6 * legIndex + componentIndex]);
    const poseColumnsOf = (/** @type {Float64Array} */ legPoses) => ({ t, x: poseComponentOf(legPoses, 0).map((x) => x + 0.01), y: poseComponentOf(legPoses, 1), theta: poseComponentOf(legPoses, 2) });
    const pageLog = { name: 'of the page', odometry: poseColumnsOf(legs.odometry), reference: poseColumnsOf(legs.reference) };
    const waitForErrorMessage = () => new Promise((resolve) => {
      figureElement.addEventListener('error', (event) => {
        event.preventDefault();
        resolve(/** @type {ErrorEvent} */ (event).message);
      }, { once: true });
    });
    figureElement.log = pageLog;
    await new Promise((resolve) => figureElement.addEventListener('stats', resolve, { once: true }));
    const errorMessages = [];
    for (const refusedLog of [{ ...pageLog, odometry: { ...pageLog.odometry, t: t.with(3, 1) } }, 5]) {
      const messagePromise = waitForErrorMessage();
      Object.assign(figureElement, { log: refusedLog });
      errorMessages.push(await messagePromise);
    }
    return errorMessages;
  });
  expect(refusalMessages).toEqual([expect.stringMatching(/^odometry: sample 3 is not later than the one before/), 'log is 5; allowed is an object with keys from name, odometry, reference']);
  expect(await widget.evaluate((element) => {
    const { log, simulation: { count: legCount } } = /** @type {AlphaCalibratorElement} */ (element);
    return [log?.name, legCount > 100];
  })).toEqual(['of the page', true]);
  expect(await readState(widget)).toEqual(stateBefore);
  // The view is fitted to the new path, although the new path would fit into the previous view.
  await expect.poll(readLeftEdge).not.toBe(leftEdgeBefore);
  await chooseTables(widget, { 'odometry.csv': readExampleTable('odometry'), 'reference.csv': readExampleTable('reference') });
  await expect(captionOf(widget)).toHaveText(/of odometry\.csv, reference\.csv[.,]/);
  await widget.getByRole('button', { name: 'Start over' }).click();
  await expect(captionOf(widget)).toHaveText(/of of the page[.,]/);
  await widget.evaluate((element) => void Object.assign(element, { log: null }));
  await expect(captionOf(widget)).toHaveText(captionBefore);
});

test('the figure reports that a log has no legs @nightly', async ({ page }) => {
  const widget = await openCalibrator(page);
  await widget.evaluate((element) => {
    const standstillPoses = { t: [0, 1, 2, 3], x: [0, 0, 0, 0], y: [0, 0, 0, 0], theta: [0, 0, 0, 0] };
    /** @type {AlphaCalibratorElement} */ (element).log = { odometry: standstillPoses, reference: standstillPoses };
  });
  await expect.poll(() => widget.evaluate((element) => /** @type {AlphaCalibratorElement} */ (element).simulation.count)).toBe(0);
  await waitUntilSettled(widget);
  await openDisclosures(widget);
  await expect(captionOf(widget)).toHaveText(/^✕ Do not use\s+Not enough data: fewer than 8 legs have poses in both logs\. .* drive longer\.\s*$/);
  await expect(alphaRowsOf(widget).first()).toHaveText(/—/);
  await expect(widget.locator('canvas.plane')).toHaveAttribute('aria-label', /Not enough data: .* choose shorter legs, or drive longer\.$/);
  await expect(widget.locator('.slider.off:has(#leg)')).toBeVisible();
  await expect(widget.getByRole('button', { name: 'Next largest residual' })).toBeDisabled();
  expect(await takeEvents(page, ['error'])).toEqual([]);
});
