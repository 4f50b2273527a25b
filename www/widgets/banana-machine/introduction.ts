/** First sight of the figure: one robot drives, then ten, then the cloud grows while the ring asks to be dragged. */

import { Cloud } from '../../figure/cloud.ts';

/** Duration of the drive of one robot, and of that of all of them: ms. With the growth of the cloud it is less than four seconds. */
const DRIVE = 650;

/** Robots that drive. */
const ROBOTS = 10;

/** Key of the session's storage that tells that the reader has seen it. */
const SEEN = 'motion-widgets.introduced';

/** Returns whether this session has not had it; from now on it has. */
function isFirstSight() {
  try {
    const seen = sessionStorage.getItem(SEEN);
    sessionStorage.setItem(SEEN, 'yes');
    return seen === null;
  } catch {
    // A page without storage would show it again and again.
    return false;
  }
}

/** Cloud whose growth waits for the introduction. */
export class IntroducedCloud extends Cloud {
  /** Time at which the first robot started, ms. */
  #began: number | undefined;
  /** Robots drive; then the ring of the handle asks to be dragged, while the cloud grows. */
  #phase: 'none' | 'driving' | 'asking' = 'none';

  /** True while the ring asks to be dragged. */
  get asking() {
    return this.#phase === 'asking';
  }

  /** Robots on their way, and the share of it that they have behind them. */
  get driving(): { robots: number, share: number } | undefined {
    if (this.#phase !== 'driving') return undefined;
    const elapsed = performance.now() - (this.#began ?? performance.now());
    return { robots: elapsed < DRIVE ? 1 : ROBOTS, share: Math.min(1, (elapsed % DRIVE) / DRIVE) };
  }

  introduce(state: Parameters<Cloud['introduce']>[0]) {
    this.#phase = 'none';
    super.introduce(state);
    const { host } = this;
    const isAsked = host.presentation || Object.keys(host.kind.attributes).some((name) => host.hasAttribute(name));
    if (state || !this.playing || isAsked || host.settings.present.samples < ROBOTS || !isFirstSight()) return;
    this.#phase = 'driving';
    this.show(ROBOTS);
    for (const event of ['pointerdown', 'keydown']) addEventListener(event, this.skip, { capture: true });
  }

  /** Ends what is left of the introduction: the reader has seen it, or has something else in mind. */
  skip = () => {
    this.#phase = 'none';
    for (const event of ['pointerdown', 'keydown']) removeEventListener(event, this.skip, { capture: true });
    this.host.requestUpdate();
  };

  hostDisconnected() {
    this.skip();
  }

  grow() {
    if (this.#phase === 'driving') {
      // It begins where the reader sees it.
      this.#began ??= performance.now();
      if (performance.now() - this.#began < 2 * DRIVE) return;
      this.#phase = 'asking';
    }
    super.grow();
  }
}
