/** Introduction of the figure: one robot drives, then ten robots. Then the cloud grows while the ring at the end of the arc pulses. */

import { Cloud } from '../shared/cloud.ts';

/** Duration (ms) of each of two drives: first one robot alone, then all robots. Drives and growth of the cloud together take less than four seconds. */
const DRIVE_DURATION_MS = 650;

/** Number of robots that drive in the introduction. */
const DRIVING_ROBOT_COUNT = 10;

/** Key in the session's storage that marks the introduction as seen. */
const INTRODUCED_STORAGE_KEY = 'motion-widgets.introduced';

/** Returns true if the introduction was not shown in this session, and marks it as shown. */
function isFirstInSession() {
  try {
    const wasShown = sessionStorage.getItem(INTRODUCED_STORAGE_KEY) !== null;
    if (!wasShown) sessionStorage.setItem(INTRODUCED_STORAGE_KEY, 'yes');
    return !wasShown;
  } catch {
    // If the browser blocks storage, the introduction is skipped. Otherwise it would be shown again and again.
    return false;
  }
}

/** Cloud of samples that starts to grow when the robots of the introduction have driven. */
export class IntroducedCloud extends Cloud {
  /** Time at which the first robot started, ms. */
  #startTimeMs: number | undefined;
  /** Phase of the introduction: first robots drive (`driving`), then the handle pulses while the cloud grows (`asking`). */
  #introductionPhase: 'none' | 'driving' | 'asking' = 'none';

  /** True while the ring at the end of the arc pulses. The pulse invites the user to drag the ring. */
  get isAsking() {
    return this.#introductionPhase === 'asking';
  }

  /** Number of robots in the current drive of the introduction, and completed fraction of their paths. */
  get drivingProgress(): { robotCount: number, pathFraction: number } | undefined {
    if (this.#introductionPhase !== 'driving') return undefined;
    const elapsedMs = performance.now() - (this.#startTimeMs ?? performance.now());
    return { robotCount: elapsedMs < DRIVE_DURATION_MS ? 1 : DRIVING_ROBOT_COUNT, pathFraction: Math.min(1, (elapsedMs % DRIVE_DURATION_MS) / DRIVE_DURATION_MS) };
  }

  showOrGrow(state: Parameters<Cloud['showOrGrow']>[0]) {
    this.#introductionPhase = 'none';
    super.showOrGrow(state);
    const { figure } = this;
    const isConfigured = figure.presentation || Object.keys(figure.definition.attributes).some((attributeName) => figure.hasAttribute(attributeName));
    if (state || !this.playing || isConfigured || figure.settings.currentValues.samples < DRIVING_ROBOT_COUNT || !isFirstInSession()) return;
    this.#introductionPhase = 'driving';
    this.showSamples(DRIVING_ROBOT_COUNT);
    for (const eventType of ['pointerdown', 'keydown']) addEventListener(eventType, this.skipIntroduction, { capture: true });
  }

  /** Ends the introduction after its last phase, or when the user presses a pointer or key. */
  skipIntroduction = () => {
    this.#introductionPhase = 'none';
    for (const eventType of ['pointerdown', 'keydown']) removeEventListener(eventType, this.skipIntroduction, { capture: true });
    this.figure.requestUpdate();
  };

  hostDisconnected() {
    this.skipIntroduction();
  }

  addGrowthStep() {
    if (this.#introductionPhase === 'driving') {
      // The introduction starts when the figure is visible.
      this.#startTimeMs ??= performance.now();
      if (performance.now() - this.#startTimeMs < 2 * DRIVE_DURATION_MS) return;
      this.#introductionPhase = 'asking';
    }
    super.addGrowthStep();
  }
}
