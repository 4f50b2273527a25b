/**
 * One animation-frame loop for every figure of the page. It runs while some figure has asked for
 * a frame and the page is in sight, and stops when none has.
 */

export type Animated = { frame(elapsed: number): void };

/** Longest step that an animation is told of, milliseconds: a page left for a while does not leap. */
const LONGEST_STEP = 100;

const waiting: Set<Animated> = new Set();
let previous = 0;
/** Whether a frame is asked for, or will be when the page is in sight. */
let running = false;

/** Calls `animated.frame` at the next animation frame, once however often it is asked. */
export function wake(animated: Animated) {
  waiting.add(animated);
  if (running) return;
  running = true;
  previous = performance.now();
  request();
}

export function sleep(animated: Animated) {
  waiting.delete(animated);
}

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
      // The others' frames go on.
      reportError(error);
    }
  }
  running = waiting.size > 0;
  if (running) request();
}
