/**
 * One animation-frame loop for every figure of the page. It runs while some figure has asked for
 * a frame and the page is in sight, and stops when none has.
 */

/** @typedef {{ frame(elapsed: number): void }} Animated */

/** Longest step that an animation is told of, milliseconds: a page left for a while does not leap. */
const LONGEST_STEP = 100;

/** @type {Set<Animated>} */
const waiting = new Set();
let previous = 0;
/** Whether a frame is asked for, or will be when the page is in sight. */
let running = false;

/** Calls `animated.frame` at the next animation frame, once however often it is asked. @param {Animated} animated */
export function wake(animated) {
  waiting.add(animated);
  if (running) return;
  running = true;
  previous = performance.now();
  request();
}

/** @param {Animated} animated */
export function sleep(animated) {
  waiting.delete(animated);
}

function request() {
  if (document.hidden) document.addEventListener('visibilitychange', request, { once: true });
  else requestAnimationFrame(run);
}

/** @param {number} now */
function run(now) {
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
