/** Animation-frame loop of all figures on the page. It runs while a figure has requested a frame and the page is visible. */

export type Animated = { frame(elapsed: number): void };

/** Longest reported time step, ms, so that animations do not jump after a pause. */
const LONGEST_STEP = 100;

const waiting: Set<Animated> = new Set();
let previous = 0;
/** True while a frame is requested, or waits for a visible page. */
let running = false;

/** Requests a call of `animated.frame` in the next animation frame. */
export function wake(animated: Animated) {
  waiting.add(animated);
  if (running) return;
  running = true;
  previous = performance.now();
  request();
}

export const sleep = (animated: Animated) => waiting.delete(animated);

function request() {
  if (document.hidden) document.addEventListener('visibilitychange', request, { once: true });
  else requestAnimationFrame(run);
}

function run(now: number) {
  const elapsed = Math.min(LONGEST_STEP, Math.max(0, now - previous));
  previous = now;
  const due = [...waiting];
  waiting.clear();
  for (const animated of due) {
    try {
      animated.frame(elapsed);
    } catch (error) {
      // An error of one figure does not stop the others.
      reportError(error);
    }
  }
  running = waiting.size > 0;
  if (running) request();
}
