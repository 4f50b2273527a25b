/**
 * Fingers on what is set from left to right: one that goes up or down scrolls the page and sets nothing,
 * one that goes across or taps means it. There is one finger at a time.
 */

/** A finger that has moved less than this, CSS pixels, may be going anywhere. */
const SLOP = 8;

/** Where a finger came down of which it is not known yet what it wants. @type {{ clientX: number, clientY: number } | undefined} */
let down;

const forget = () => (down = undefined);

export const finger = {
  /** @param {PointerEvent} event */
  comes({ pointerType, clientX, clientY }) {
    down = pointerType === 'touch' ? { clientX, clientY } : undefined;
    // What it came down on may leave the page, and does not hear then that it goes.
    addEventListener('pointerup', forget);
    addEventListener('pointercancel', forget);
  },

  /** @param {PointerEvent} event */
  moves(event) {
    if (!down) return;
    const [across, along] = [Math.abs(event.clientX - down.clientX), Math.abs(event.clientY - down.clientY)];
    if (across > SLOP && across > along) down = undefined;
  },

  /** @returns {boolean} whether it only tapped */
  goes() {
    const tapped = down !== undefined;
    down = undefined;
    return tapped;
  },

  /** Whether it may still be on its way up or down the page. */
  get waits() {
    return down !== undefined;
  },
};
