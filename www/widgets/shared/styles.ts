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

/** For a picture that has figures beside it, and a key to its marks in a fold. */
export const besideStyles = css`
  /* The picture with the sentence below it, and beside it the figures and what is chosen. */
  @container (min-width: 38em) {
    .views {
      grid-template: 'stage aside' 'verdict verdict' / minmax(0, 1fr) 16em;
      column-gap: 1em;
    }

    .stage {
      grid-area: stage;
    }

    .verdict {
      grid-area: verdict;
    }

    .aside {
      grid-area: aside;
    }
  }

  .aside .buttons {
    gap: 0.35em;
    margin-bottom: 0.4em;
  }

  .about {
    color: var(--muted);
    margin: 0 0 0.7em;
  }

  .key {
    row-gap: 0.15em;
    margin: 0.5em 0 0.7em;
    padding: 0;
    list-style: none;
  }

  .key li {
    display: flex;
    align-items: center;
    gap: 0.6em;
  }

  .key svg {
    flex: none;
    width: 2.2em;
    height: 1.2em;
    fill: none;
  }
`;
