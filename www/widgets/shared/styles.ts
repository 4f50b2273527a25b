/** Styles that widgets share. */

import { css } from 'lit';

/** For a robot under the reader's hand: it is drawn, and its body's handle has no look of its own. */
export const poseHandleStyles = css`
  .handle.body::after {
    content: none;
  }

  .handle.turn {
    width: 1.75em;
    height: 1.75em;
  }

  .handle.turn::after {
    inset: 0.45em;
    border-width: 2.5px;
  }
`;
