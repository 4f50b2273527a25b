// Functions of figures that need no DOM: conversion of attributes, printed numbers, the view of a picture, and the factor of a stretched axis.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { WORD_LIST_CONVERTER, propertiesOf, selectAttributes } from '../../www/figure/definition.ts';
import { PictureView } from '../../www/scene/view.ts';
import { settings } from '../../build/settings.js';
import { formatRounded } from '../../www/ui/format.ts';
import { formatScaleRatios } from '../../www/widgets/dead-reckoning/pictures.ts';

test('boolean attributes may be empty or "true", and lists may contain any white space', () => {
  const { conditioned } = selectAttributes(propertiesOf(settings['map-squeeze']));
  assert.deepEqual(['false', 'true', ''].map((attributeText) => conditioned.converter.fromAttribute(attributeText)), [false, true, true]);
  assert.deepEqual([' linearized\n  command ', ''].map((attributeText) => WORD_LIST_CONVERTER.fromAttribute(attributeText)), [['linearized', 'command'], []]);
});

test('numbers near 0 are rounded to 0', () => {
  assert.deepEqual([0, 1e-200, 0.47, 1234].map((number) => formatRounded(number, 2)), ['0', '0', '0.47', '1\u202f200']);
});

test('a view that was fitted to a tiny canvas zooms in after its canvas has grown; other views do not zoom in', () => {
  const pictureView = new PictureView();
  const fitViewTo = (/** @type {number} */ halfSize) => {
    pictureView.fitExtent({ xMin: -halfSize, xMax: halfSize, yMin: -halfSize, yMax: halfSize });
    pictureView.moveTowardsTarget(0, true);
    return pictureView.shownExtent.xMax - pictureView.shownExtent.xMin;
  };
  pictureView.setSize(100, 60);
  // In a tiny view a mark of some pixels is many metres long.
  assert.ok(fitViewTo(20) >= 40);
  pictureView.setSize(600, 400);
  assert.ok(fitViewTo(1) < 10);
  const [widthBefore, widthAfter] = [fitViewTo(2), fitViewTo(1)];
  assert.equal(widthAfter, widthBefore);
});

test('the stretched axis is labelled with its scale factor, unless both scales are almost equal', () => {
  assert.deepEqual(formatScaleRatios({ scaleX: 100, scaleY: 720 }), ['', '7.2']);
  assert.deepEqual(formatScaleRatios({ scaleX: 1230, scaleY: 100 }), ['10', '']);
  assert.deepEqual(formatScaleRatios({ scaleX: 100, scaleY: 104 }), ['', '']);
});
