/** Overview next to an enlarged picture: the whole map, with a frame around the visible part. */

import { html, nothing } from 'lit';

/** Largest fraction of the map's area in a close view that has an overview. */
const MAX_SHOWN_FRACTION = 0.6;

/** Returns the overview, or nothing where the picture shows most of the map. */
export function overview(picture: import('./picture.ts').FloorPicture, { config, commanded }: import('./reading.ts').Reading) {
  const { xMin, yMin, xMax, yMax } = picture.mapped(config.start);
  const [width, height] = [xMax - xMin, yMax - yMin];
  const { extent } = picture.view;
  const shown = [extent.xMax - extent.xMin, extent.yMax - extent.yMin];
  if (!picture.close || shown[0] * shown[1] > MAX_SHOWN_FRACTION * width * height) return nothing;
  return html`<svg class="overview" viewBox=${`${xMin} ${-yMax} ${width} ${height}`} aria-hidden="true">
    <g transform="scale(1 -1)">
      <path class="walls" d=${picture.outline} />
      <polyline class="way" points=${[...commanded].join(' ')} />
      <rect x=${extent.xMin} y=${extent.yMin} width=${shown[0]} height=${shown[1]} />
    </g>
  </svg>`;
}
