// Checks that run in every browser engine: results must be equal to the last bit, and the page must react to a user.

import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { REPOSITORY_ROOT } from '../../scripts/process.mjs';
import { settings } from '../../build/settings.js';
import { findDifferences } from '../digest/digest.js';
import { createSimulation, handlesByTag } from './figures.mjs';
import { simulationStateOf } from './inside.js';

/** @typedef {import('./browsers.mjs').BrowserSession} BrowserSession */

/** Number of pointer moves of a drag. */
const DRAG_STEPS = 8;

/** Maximum number of colours of a blank picture. Antialiased lines, text and a cloud have many more shades. */
const MAX_COLOURS_OF_BLANK = 16;

const readSource = (/** @type {string} */ repositoryPath) => readFileSync(join(REPOSITORY_ROOT, repositoryPath), 'utf8');

/** Page in one engine. `callInPage` calls functions of inside.js in that page. */
class BrowserPage {
  /** @param {string} engineName @param {BrowserSession} browserSession @param {string} pageUrl */
  constructor(engineName, browserSession, pageUrl) {
    this.name = engineName;
    this.session = browserSession;
    this.address = pageUrl;
  }

  /**
   * Calls a function of inside.js in the page.
   *
   * @template {keyof typeof import('./inside.js')} Name
   * @param {Name} functionName
   * @param {Parameters<typeof import('./inside.js')[Name]>[0]} [functionArgument]
   * @returns {Promise<Awaited<ReturnType<typeof import('./inside.js')[Name]>>>}
   */
  callInPage(functionName, functionArgument) {
    return this.session.callInPage(
      async ({ name, functionArgument }) => (await import(new URL('/tests/engines/inside.js', location.href).href))[name](functionArgument),
      { name: functionName, functionArgument },
    );
  }

  /** Loads the page again. @param {string} [widgetTag] tag of a figure to scroll to and wait for */
  async open(widgetTag) {
    await this.session.openPage(this.address);
    if (widgetTag !== undefined) await this.waitUntilSettled(widgetTag);
  }

  /** Waits until a figure has settled, and checks that no picture of the figure is blank. @param {string} widgetTag */
  async waitUntilSettled(widgetTag) {
    const { statisticsCount, requestedCount } = await this.callInPage('waitUntilSettled', widgetTag);
    assert.equal(statisticsCount, requestedCount, `The statistics are of ${statisticsCount} samples.`);
    for (const colourCount of await this.callInPage('colourCountsOf', widgetTag)) assert.ok(colourCount > MAX_COLOURS_OF_BLANK, `A picture has ${colourCount} colours.`);
  }

  /** Writes a screenshot to a file. @param {string} screenshotName part of the file name */
  async saveScreenshot(screenshotName) {
    const screenshotDirectory = join(REPOSITORY_ROOT, 'test-results/engines');
    mkdirSync(screenshotDirectory, { recursive: true });
    writeFileSync(join(screenshotDirectory, `${this.name}-${screenshotName}.png`), await this.session.takeScreenshot());
  }

  /** Returns the new messages of the console. @returns {Promise<string[]>} */
  async takeRecordedErrors() {
    const recordedMessages = await this.session.callInPage(() => /** @type {string[]} */ (/** @type {any} */ (globalThis).recordedErrors.splice(0)), null);
    return [...new Set(recordedMessages)];
  }
}

/**
 * Runs all checks in an engine.
 *
 * @param {string} name of the engine
 * @param {BrowserSession} browserSession
 * @param {string} pageUrl
 * @returns {Promise<{ passedCount: number, failedChecks: string[] }>}
 */
export async function runChecks(name, browserSession, pageUrl) {
  const page = new BrowserPage(name, browserSession, pageUrl);
  /** @type {string[]} */
  const failedChecks = [];
  let passedCount = 0;
  const runCheck = async (/** @type {string} */ checkName, /** @type {() => Promise<unknown>} */ checkFunction) => {
    try {
      await checkFunction();
      assert.deepEqual(await page.takeRecordedErrors(), [], 'The console has something to say.');
      passedCount++;
      console.log(`ok     ${name}: ${checkName}`);
    } catch (error) {
      failedChecks.push(`${name}: ${checkName}: ${error instanceof Error ? error.message : error}`);
      console.log(`FAILED ${failedChecks.at(-1)}`);
      await page.saveScreenshot('failed').catch(() => {});
    }
  };

  await runCheck('the digest', () => checkDigest(page));
  for (const widgetTag of Object.keys(settings)) {
    await runCheck(`${widgetTag} opens`, () => checkOpening(page, widgetTag));
    for (const figureHandle of handlesByTag[widgetTag] ?? []) {
      await runCheck(`${widgetTag} is dragged by its handle "${figureHandle.name}"`, () => checkDragging(page, widgetTag, figureHandle));
      await runCheck(`the handle "${figureHandle.name}" of ${widgetTag} follows the keyboard`, () => checkHandleKeys(page, widgetTag, figureHandle));
    }
    await runCheck(`sliders of ${widgetTag} follow the keyboard`, () => checkSliderKeys(page, widgetTag));
  }
  return { passedCount, failedChecks };
}

/** Compares hashes of the results of all configurations (the digest) with those in golden.txt. @param {BrowserPage} page */
async function checkDigest(page) {
  await page.open();
  assert.deepEqual(findDifferences(readSource('tests/digest/golden.txt'), await page.callInPage('computeWholeDigest')), []);
}

/**
 * Compares the results of a figure with those of a simulation of the same settings in Node, to the last bit.
 *
 * @param {BrowserPage} page
 * @param {string} widgetTag
 * @returns {Promise<{ simulation: any, resultHash: string }>} the simulation in Node
 */
async function compareWithNode(page, widgetTag) {
  const { config, resultHash } = await page.callInPage('stateOf', widgetTag);
  const simulation = await createSimulation(widgetTag, config);
  assert.equal(resultHash, (await simulationStateOf(simulation)).resultHash, `Node has other bits for ${JSON.stringify(config)}.`);
  return { simulation, resultHash };
}

/** Compares the state of a figure that has just opened with that of a simulation in Node. @type {(page: BrowserPage, widgetTag: string) => Promise<void>} */
async function checkOpening(page, widgetTag) {
  await page.open(widgetTag);
  await compareWithNode(page, widgetTag);
  await page.saveScreenshot(`${widgetTag}-opened`);
}

/**
 * Checks that a dragged handle moves to the pointer, to within a pixel.
 *
 * @param {BrowserPage} page
 * @param {string} widgetTag
 * @param {import('./figures.mjs').Handle} handle
 */
async function checkDragging(page, widgetTag, { name, targetPoint, positionOf }) {
  await page.open(widgetTag);
  const hashBefore = await page.callInPage('pictureHashOf', widgetTag);
  const handleMeasures = await page.callInPage('measureHandle', { widgetTag, handleName: name, targetPoint });
  // Pointer positions are whole pixels. A handle that is grabbed beside its centre keeps its offset from the pointer.
  const grabPoint = [Math.round(handleMeasures.handlePoint.x), Math.round(handleMeasures.handlePoint.y)];
  const dragVector = [handleMeasures.targetPoint.x - handleMeasures.handlePoint.x, handleMeasures.targetPoint.y - handleMeasures.handlePoint.y];
  const dragPointOf = (/** @type {number} */ dragFraction) => /** @type {[number, number]} */ (grabPoint.map((coordinate, i) => Math.round(coordinate + dragFraction * dragVector[i])));
  await page.session.dragAlong(Array.from({ length: DRAG_STEPS + 1 }, (_, i) => dragPointOf(i / DRAG_STEPS)));
  await page.waitUntilSettled(widgetTag);
  await page.saveScreenshot(`${widgetTag}-${name}-dragged`);
  const { simulation } = await compareWithNode(page, widgetTag);
  const [x, y] = positionOf(simulation, targetPoint);
  const pixelError = Math.hypot(x - targetPoint[0], y - targetPoint[1]) / handleMeasures.pixelSize;
  assert.ok(pixelError <= 1, `It is ${pixelError.toFixed(2)} pixels beside where it was dragged.`);
  assert.notEqual(await page.callInPage('pictureHashOf', widgetTag), hashBefore, 'The picture is as it was.');
}

/** Moves a handle by arrow keys, and checks its new position. @param {BrowserPage} page @param {string} widgetTag @param {import('./figures.mjs').Handle} handle */
async function checkHandleKeys(page, widgetTag, { name }) {
  await page.open(widgetTag);
  const { resultHash: hashBefore } = await page.callInPage('stateOf', widgetTag);
  assert.ok(await page.callInPage('focusElement', { widgetTag, selector: `.handle.${name}` }), 'It does not take the focus.');
  await page.session.pressKeys('ArrowUp', 'ArrowUp', 'ArrowLeft');
  await page.waitUntilSettled(widgetTag);
  const { resultHash } = await compareWithNode(page, widgetTag);
  assert.notEqual(resultHash, hashBefore, 'Nothing has moved.');
}

/** Moves each slider by keys, and compares the setting with the expected value. @type {(page: BrowserPage, widgetTag: string) => Promise<void>} */
async function checkSliderKeys(page, widgetTag) {
  await page.open(widgetTag);
  await page.callInPage('renderAfterInputs', widgetTag);
  const sliderStates = await page.callInPage('sliderStatesOf', widgetTag);
  assert.ok(sliderStates.length >= 2, `${sliderStates.length} sliders are to be seen.`);
  for (const { key } of sliderStates) {
    const readSlider = async () => (await page.callInPage('sliderStatesOf', widgetTag)).find((sliderState) => sliderState.key === key);
    const sliderBefore = await readSlider();
    assert.ok(sliderBefore && (await page.callInPage('focusElement', { widgetTag, selector: `#${key}` })), `${key} does not take the focus.`);
    await page.session.pressKeys('ArrowRight', 'ArrowRight', 'ArrowLeft');
    await page.waitUntilSettled(widgetTag);
    const sliderAfter = await readSlider();
    const expectedPosition = Math.min(sliderBefore.position + 2 * sliderBefore.step, sliderBefore.end) - sliderBefore.step;
    assert.ok(sliderAfter && Math.abs(sliderAfter.position - expectedPosition) < 1e-9, `The slider of ${key} was at ${sliderBefore.position} and is at ${sliderAfter?.position}.`);
    assert.ok((sliderAfter.value - sliderBefore.value) * (expectedPosition - sliderBefore.position) > 0, `${key} was ${sliderBefore.value} and is ${sliderAfter.value}.`);
  }
  await compareWithNode(page, widgetTag);
}
