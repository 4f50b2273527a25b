/** Exports of the Alpha Calibrator: lines for nav2_params.yaml, and all results as JSON. */

import { html } from 'lit';
import { downloadFile } from '../../figure/export.ts';
import { words } from '../../messages/registry.ts';
import { button } from '../../ui/controls.ts';
import { NAV2_RULES, nav2Lines } from './lines.ts';
import { modelRuleOf, settingsFor } from './settings.ts';
import type { AlphaCalibratorElement as Figure } from './alpha-calibrator.ts';

/** Returns the lines for nav2_params.yaml; empty if Nav2 has no such model, or no α's are recommended. */
function yamlOf({ viewModel, logName, warnings }: Figure): string {
  const { fitted: config, stats, legs: { count } } = viewModel;
  const { model, rule, distance, angle, duration } = config;
  const date = new Date().toISOString().slice(0, 10);
  const fittedLog = { calibration: stats, count, model, rule, legs: duration > 0 ? { duration } : { distance, angle }, log: logName, warnings, date };
  return nav2Lines(fittedLog, words.calibrator.nav2).map((line) => `${line}\n`).join('');
}

/** Returns all results as JSON, with typed arrays as plain arrays. */
function jsonOf({ viewModel: { fitted, stats, legs, truth }, logName }: Figure) {
  const allResults = { log: logName, date: new Date().toISOString(), settings: fitted, ...stats, ...(truth && { truth }), legs };
  return JSON.stringify(allResults, (_, value) => (ArrayBuffer.isView(value) ? [...(value as Float64Array)] : value), 1);
}

/**
 * Returns the button that copies the lines. For α's of another rule than Nav2's, it is a button that fits Nav2's rule. `obstacle` is the
 * reason why the button is disabled; empty if it is enabled.
 */
export function copyButton(figure: Figure, obstacle: string) {
  const texts = words.calibrator.nav2;
  if (!NAV2_RULES.includes(modelRuleOf(figure.viewModel.fitted))) return button(texts.fit, () => figure.gesture.decide(settingsFor('nav2')), { disabled: obstacle !== '', title: obstacle || texts.fitTitle });
  const yaml = yamlOf(figure);
  return figure.copyMenu.button('nav2', texts.copy, () => yaml, { disabled: !yaml || obstacle !== '', title: obstacle || (yaml ? texts.label : texts.none) });
}

/** Returns the message of the button, which stands where it moves neither the button nor the table. */
export const copyMessage = (figure: Figure) => figure.copyMenu.messageHtml('nav2', yamlOf(figure));

/** Returns the lines, and the button that saves all results. `obstacle` is the reason why it is disabled, or empty. */
export function nav2ExportControls(figure: Figure, obstacle: string) {
  const texts = words.calibrator.nav2;
  const yaml = yamlOf(figure);
  const fileName = `${figure.localName}-${figure.viewModel.config.seed}.json`;
  return html`${yaml ? html`<textarea class="yaml" readonly rows=${yaml.split('\n').length} aria-label=${texts.label} .value=${yaml}></textarea>` : html`<p>${texts.none}</p>`}
    <div class="buttons">
      ${button(texts.json, () => downloadFile(fileName, new Blob([jsonOf(figure)], { type: 'application/json' })), { disabled: obstacle !== '', title: obstacle || undefined })}
    </div>`;
}
