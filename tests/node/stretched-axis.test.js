// Factor that is shown with the name of an axis if its scale differs from that of the other axis.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { scaleRatioTexts } from '../../www/widgets/dead-reckoning/pictures.ts';

test('the stretched axis has the factor of the scales, and none that is not seen', () => {
  assert.deepEqual(scaleRatioTexts({ scaleX: 100, scaleY: 720 }), ['', '7.2']);
  assert.deepEqual(scaleRatioTexts({ scaleX: 1230, scaleY: 100 }), ['10', '']);
  assert.deepEqual(scaleRatioTexts({ scaleX: 100, scaleY: 104 }), ['', '']);
});
