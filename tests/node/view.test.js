// View of a picture when its canvas changes its size.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { View } from '../../www/scene/view.ts';

test('a view that was fitted to a tiny canvas zooms in on a larger one, and keeps its scale otherwise', () => {
  const view = new View();
  const fitTo = (/** @type {number} */ halfSize) => {
    view.fit({ xMin: -halfSize, xMax: halfSize, yMin: -halfSize, yMax: halfSize });
    view.ease(0, true);
    return view.extent.xMax - view.extent.xMin;
  };
  view.resize(100, 60);
  // A mark of some pixels needs many metres there.
  assert.ok(fitTo(20) >= 40);
  view.resize(600, 400);
  assert.ok(fitTo(1) < 10);
  const [widthBefore, widthAfter] = [fitTo(2), fitTo(1)];
  assert.equal(widthAfter, widthBefore);
});
