/** Forms that ask which logs to read, and the summary of the logs that were read. This module is loaded with the first log. */

import { html, nothing, svg } from 'lit';
import { guard } from 'lit/directives/guard.js';
import { keyed } from 'lit/directives/keyed.js';
import { live } from 'lit/directives/live.js';
import { LOG_ROLES, UNIT_NAMES, choiceLabelOf, readableSeriesOf, summaryLinesOf, type FileQuestion, type LogChoice, type UserQuestion, type LogRole } from '../../logs/log.ts';
import { alignPath, pathOf, svgPathDataOf, type TimedPath } from '../../logs/path.ts';
import { language } from '../../messages/registry.ts';
import { radioGroupHtml } from '../../ui/controls.ts';
import { MINUS_SIGN, formatFixed } from '../../ui/format.ts';
import type { AlphaCalibratorElement } from './alpha-calibrator.ts';
import type { LoggedDrive } from '../../logs/pairs.ts';
import type { FileContents } from '../../logs/session.ts';
import type { ChosenFiles, LogOpener, LogWords } from './open.ts';

export { english as en } from '../../logs/en.ts';
export { german as de } from '../../logs/de.ts';
export { mirroringQuestionsOf } from '../../logs/log.ts';

type Recording = FileContents['openedRecordings'][number];

const COLUMN_FIELDS = ['t', 'x', 'y', 'yaw', 'qx', 'qy', 'qz', 'qw', 'v', 'omega'] as const;

/** Minimum number of columns of a table with quaternions: time, x, y, qz and qw. */
const MIN_QUATERNION_COLUMNS = 5;

/** Maximum number of characters of a cell that labels a column. The label also has the number of the column. */
const MAX_CELL_LENGTH = 16;

/** Returns all logs that can be chosen for a role, each with a label. Every pair of frames is a separate log. */
function labelledChoicesOf(recording: Recording, logRole?: LogRole): [label: string, LogChoice][] {
  const usableSeries = readableSeriesOf(recording).filter(({ seriesKind }) => logRole !== 'reference' || seriesKind !== 'commands');
  const logChoices = usableSeries.flatMap(({ seriesName, seriesKind, framePairs = [] }): LogChoice[] => (seriesKind === 'transforms' ? framePairs.map((framePair) => ({ seriesName, framePair })) : [{ seriesName }]));
  return logChoices.map((logChoice) => [choiceLabelOf(logChoice) || recording.recordingName, logChoice]);
}

/** Returns the controls by which the user answers questions about the chosen files. */
export function logChoosersHtml(logOpener: LogOpener) {
  const { chosenFiles, texts } = logOpener;
  if (!chosenFiles || !texts) return nothing;
  const { openedRecordings, skippedFiles, questions } = chosenFiles;
  const hasOneLog = (recording: Recording) => labelledChoicesOf(recording).length === 1;
  const roleChoosers = [
    ...(openedRecordings.every(hasOneLog) ? [] : LOG_ROLES.map((role) => seriesSelectHtml(logOpener, chosenFiles, role, texts))),
    ...(openedRecordings.length > 1 ? openedRecordings.flatMap((recording, recordingIndex) => (hasOneLog(recording) ? [roleSelectHtml(logOpener, chosenFiles, recordingIndex, texts)] : [])) : []),
  ];
  return html`<div class="choosers">
    ${roleChoosers.length ? html`<div class="choices">${roleChoosers}</div>` : nothing}
    ${questions.map((question) => questionHtml(logOpener, chosenFiles, question, texts))}
    ${skippedFiles.filter((failure) => failure !== logOpener.refusal).map((failure) => html`<p class="muted">${texts.logChoiceTexts.skippedFileNote(logOpener.explainRefusal(failure))}</p>`)}
  </div>`;
}

function selectHtml(id: string, label: string, selectedValue: string, options: [value: string, label: string][], chooseOption: (selectedValue: string) => void, placeholder: string) {
  const allOptions = options.some(([optionValue]) => optionValue === selectedValue) ? options : [['', placeholder], ...options];
  return html`<label>
    ${label}
    <select id=${id} aria-label=${label} aria-describedby="refusal" @change=${(event: Event) => chooseOption((event.target as HTMLSelectElement).value)}>
      ${allOptions.map(([optionValue, optionLabel]) => html`<option value=${optionValue} .selected=${live(optionValue === selectedValue || (selectedValue === '' && optionValue === ''))}>${optionLabel}</option>`)}
    </select>
  </label>`;
}

function seriesSelectHtml(logOpener: LogOpener, { openedRecordings, userChoices }: ChosenFiles, role: LogRole, { logChoiceTexts: texts }: LogWords) {
  const choiceByLabel = new Map(openedRecordings.flatMap((recording) => labelledChoicesOf(recording, role)));
  const plannedRecording = openedRecordings.find(({ logChoices }) => logChoices?.[role]);
  const currentChoice = (userChoices[role] as LogChoice | undefined) ?? plannedRecording?.logChoices?.[role];
  const currentLabel = currentChoice ? choiceLabelOf(currentChoice) || (plannedRecording ?? openedRecordings[0]).recordingName : '';
  return selectHtml(`log-${role}`, texts.roleNames[role], currentLabel, [...choiceByLabel.keys()].map((label) => [label, label]), (label) => {
    const choice = choiceByLabel.get(label);
    if (choice) logOpener.changeChoices({ userChoices: { ...userChoices, [role]: choice } });
  }, texts.openPlaceholder);
}

function roleSelectHtml(logOpener: LogOpener, { openedRecordings, answers }: ChosenFiles, recordingIndex: number, { logChoiceTexts: texts }: LogWords) {
  const { recordingName, logChoices } = openedRecordings[recordingIndex];
  const currentRole = answers[recordingName]?.logRole ?? LOG_ROLES.find((role) => logChoices?.[role]);
  return selectHtml(`log-role-${recordingIndex}`, recordingName, currentRole ?? '', LOG_ROLES.map((role) => [role, texts.roleNames[role]]), (chosenValue) => {
    const role = chosenValue as LogRole;
    // If there are two files with one log each, and the user chooses the role of one file, the other file gets the other role.
    const otherRecording = openedRecordings.length === 2 ? openedRecordings[1 - recordingIndex] : undefined;
    const hasOtherRole = otherRecording && labelledChoicesOf(otherRecording).length === 1;
    logOpener.answerQuestions({ ...(hasOtherRole && { [otherRecording.recordingName]: { logRole: role === 'odometry' ? 'reference' : 'odometry' } }), [recordingName]: { logRole: role } });
  }, texts.openPlaceholder);
}

function questionHtml(logOpener: LogOpener, { answers }: ChosenFiles, question: FileQuestion, { logChoiceTexts: texts }: LogWords) {
  const { fileName, optionName, possibleAnswers } = question;
  if (optionName === 'columns') return columnsFormHtml(logOpener, question, answers[fileName]?.columnNames?.join(), texts);
  if (optionName !== 'timeUnit' && optionName !== 'lengthUnit' && optionName !== 'angleUnit') return nothing;
  const unitLabels: Record<string, string> = Object.fromEntries((possibleAnswers.length ? possibleAnswers : UNIT_NAMES[optionName]).map((unit) => [unit, texts.unitNames[unit as keyof typeof texts.unitNames]]));
  return html`<div id=${questionIdOf(question)}>
    ${radioGroupHtml(texts[optionName](fileName), questionIdOf(question), unitLabels, answers[fileName]?.[optionName] ?? '', (unit) => logOpener.answerQuestions({ [fileName]: { [optionName]: unit } }))}
  </div>`;
}

/** Returns a form with a `<select>` for each field, by which the user assigns a column to the field. */
function columnsFormHtml(logOpener: LogOpener, question: FileQuestion, answeredNames: string | undefined, texts: LogWords['logChoiceTexts']) {
  const { fileName, possibleAnswers: [chosenNames = ''], columnNames = [], proposedFields = chosenNames.split(',') } = question;
  const proposedNames = chosenNames.split(',');
  // Each column is offered twice: as it is, and with the opposite sign.
  const options = ['', '-'].flatMap((sign) => columnNames.map((headerCell, columnIndex) =>
    ({ sign, columnIndex, label: `${sign && `${MINUS_SIGN} `}${texts.columnLabel(columnIndex + 1, headerCell.trim().slice(0, MAX_CELL_LENGTH))}` })));
  const submitColumns = (event: Event) => {
    event.preventDefault();
    const newFields = columnNames.map(() => '-');
    for (const [field, optionIndex] of new FormData(event.target as HTMLFormElement)) {
      if (optionIndex !== '') newFields[options[Number(optionIndex)].columnIndex] = `${options[Number(optionIndex)].sign}${field}`;
    }
    // A column that keeps its field also keeps its name, because the name may contain a unit.
    const newNames = newFields.map((field, i) => ((field === proposedFields[i] && proposedNames[i]) || field));
    [question.possibleAnswers, question.proposedFields] = [[newNames.join()], newFields];
    logOpener.answerQuestions({ [fileName]: { columnNames: newNames } });
  };
  return keyed(question, html`<form id=${questionIdOf(question)} @submit=${submitColumns}>
    <fieldset>
      <legend>${texts.columnsLegend(fileName, chosenNames !== '' && chosenNames !== answeredNames)}</legend>
      <div class="choices">
        ${COLUMN_FIELDS.filter((field) => !field.startsWith('q') || columnNames.length >= MIN_QUATERNION_COLUMNS).map((field) => html`<label>
          ${texts.fieldNames[field]}
          <select name=${field} aria-label=${texts.fieldNames[field]} aria-describedby="refusal">
            <option value="">${texts.noColumnLabel}</option>
            ${options.slice(0, field === 't' ? columnNames.length : undefined).map(({ sign, columnIndex, label }, i) => html`<option value=${i} ?selected=${proposedFields[columnIndex] === `${sign}${field}`}>${label}</option>`)}
          </select>
        </label>`)}
        <button type="submit" part="button">${texts.readLabel}</button>
      </div>
    </fieldset>
  </form>`);
}

const questionIdOf = ({ fileName, optionName }: FileQuestion) => `log-${optionName}-${fileName.replaceAll(/[^\w-]/g, '_')}`;

/** Moves the focus to the first control that answers a question, unless a control for the question already has the focus. Returns false if there is no such control. */
export function focusChooser({ renderRoot }: AlphaCalibratorElement, question: FileQuestion): boolean {
  const { optionName, logRole = 'odometry' } = question;
  const selectors = { series: `#log-${logRole}`, frames: `#log-${logRole}`, roles: '[id^=log-role-]' } as Partial<Record<UserQuestion['optionName'], string>>;
  const chooserElement = renderRoot.querySelector<HTMLElement>(selectors[optionName] ?? `#${questionIdOf(question)}`);
  const firstControl = chooserElement?.matches('select') ? chooserElement : chooserElement?.querySelector<HTMLElement>('select, input');
  if (!firstControl) return false;
  if (!firstControl.closest('.choosers')?.contains((renderRoot as ShadowRoot).activeElement)) firstControl.focus();
  return true;
}

/** Size of the picture in CSS pixels, and margin that prevents lines at its edges from being cut. */
const [PICTURE_WIDTH, PICTURE_HEIGHT, PICTURE_MARGIN] = [220, 150, 4];

/** Maximum number of points of a drawn path. The picture has too few pixels to show more. */
const MAX_PATH_POINTS = 1500;

/** Returns the summary of the logs of each drive. The summary is shown during the fit, and later below the results. */
export function logSummaryHtml({ chosenFiles, texts, figure }: LogOpener) {
  // If the page has set another log in the meantime, no summary is shown.
  if (!chosenFiles?.loggedDrives || !texts || (chosenFiles.isFitted && chosenFiles.calibrationLog !== figure.log)) return nothing;
  const { loggedDrives } = chosenFiles;
  // The clock offset is known only after the fit. Until then it is taken as 0.
  const clockOffset = (chosenFiles.isFitted ? figure.viewModel.stats.systematicErrors.clockOffset.value : undefined) ?? 0;
  return html`<details class="found" open>
    <summary>${texts.logSummaryTexts.summaryTitle}</summary>
    ${guard([loggedDrives, texts, language, clockOffset], () => loggedDrives.map((drive, i) => html`<div class="drive">
      ${logTableHtml(drive, loggedDrives.length > 1 ? texts.logSummaryTexts.driveCaption(i + 1) : '', texts)}
      ${pathsPictureHtml(drive, clockOffset, texts)}
    </div>`))}
  </details>`;
}

function logTableHtml({ odometry, reference }: LoggedDrive, caption: string, { logChoiceTexts: choose, logSummaryTexts: found }: LogWords) {
  const logs = [odometry, reference];
  const tableRows = logs.map((driveLog) => summaryLinesOf(driveLog, found));
  const tableCellHtml = (cellLines: string[] = []) => html`<td>${cellLines.length ? cellLines.map((cellLine, i) => html`${i ? html`<br />` : nothing}${cellLine}`) : '—'}</td>`;
  const rowKeys = (Object.keys(found.rowLabels) as (keyof typeof found.rowLabels)[]).filter((label) => tableRows.some((tableRow) => tableRow[label]?.length));
  return html`<table>
    ${caption ? html`<caption>${caption}</caption>` : nothing}
    <thead>
      <tr><td></td>${LOG_ROLES.map((role, i) => html`<th scope="col">${choose.roleNames[role]}: ${logs[i].logName}</th>`)}</tr>
    </thead>
    <tbody>
      ${rowKeys.map((label) => html`<tr><th scope="row">${found.rowLabels[label]}</th>${tableRows.map((tableRow) => tableCellHtml(tableRow[label]))}</tr>`)}
    </tbody>
  </table>`;
}

/** Returns a picture of the paths by odometry and reference. If the logs have times in common, the odometry is aligned to the reference, whose times are later by `clockOffset`. */
function pathsPictureHtml({ odometry, reference }: LoggedDrive, clockOffset: number, { logSummaryTexts: found }: LogWords) {
  const [drivenPath, referencePath] = [odometry.motionData, reference.motionData].map((poseColumns) => pathOf(poseColumns, Math.ceil(poseColumns.t.length / MAX_PATH_POINTS)));
  const odometryPath = alignPath(drivenPath, referencePath, clockOffset);
  const allPoses = [...odometryPath.poses, ...referencePath.poses];
  const axisRanges = ([0, 1] as const).map((coordinateIndex) => [Math.min(...allPoses.map((pose) => pose[coordinateIndex])), Math.max(...allPoses.map((pose) => pose[coordinateIndex]))]);
  const [pathWidth, pathHeight] = axisRanges.map(([lowEnd, highEnd]) => highEnd - lowEnd);
  const pixelsPerMetre = Math.min((PICTURE_WIDTH - 2 * PICTURE_MARGIN) / Math.max(pathWidth, 0.1), (PICTURE_HEIGHT - 2 * PICTURE_MARGIN) / Math.max(pathHeight, 0.1));
  const pathDataOf = (path: TimedPath) => svgPathDataOf(path, ([x, y]) => [PICTURE_MARGIN + (x - axisRanges[0][0]) * pixelsPerMetre, PICTURE_HEIGHT - PICTURE_MARGIN - (y - axisRanges[1][0]) * pixelsPerMetre]);
  const captionText = found.pathsCaption(odometryPath !== drivenPath, formatFixed(pathWidth, 1), formatFixed(pathHeight, 1));
  return html`<figure class="paths small">
    <svg viewBox="0 0 ${PICTURE_WIDTH} ${PICTURE_HEIGHT}" role="img" aria-label=${captionText}>
      <g fill="none" stroke-width="1.25" stroke-linejoin="round">
        ${svg`<path stroke="var(--ink)" d=${pathDataOf(referencePath)} /><path stroke="var(--prior)" stroke-dasharray="4 2" d=${pathDataOf(odometryPath)} />`}
      </g>
    </svg>
    <figcaption>${captionText}</figcaption>
  </figure>`;
}
