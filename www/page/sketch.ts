/** Sketch of a cloud: the user draws the expected cloud, and the robots of the figure then appear below the drawing. */

import { deviation, extent } from 'd3-array';
import type { Figure } from '../page.ts';

/** Point in metres on the floor, or in pixels of the pad. */
export type Point = [x: number, y: number];

/** Scale of the drawing pad (pixels per metre), and position of the robot's start on it. */
const PIXELS_PER_METRE = 95;
const START_PIXEL = { x: 30, y: 150 };

/** Maximum number of robots drawn below a sketch, and length of a robot's heading line in pixels. */
const MAX_DRAWN_ROBOTS = 150;
const TICK_LENGTH = 9;

/** Smallest standard deviation that counts as a spread. */
const MIN_SPREAD = 1e-6;

const toPixel = ([x, y]: Point) => [START_PIXEL.x + PIXELS_PER_METRE * x, START_PIXEL.y - PIXELS_PER_METRE * y] as Point;

/** Returns a path through points in pixels. */
const pathDataOf = (points: Point[], isClosed: boolean = false) => (points.length ? `M${points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join('L')}${isClosed ? 'Z' : ''}` : '');

/** Returns points of the commanded arc, with an error of the turn rate in rad/s. */
function sampleCommandedArc({ v, omega, dt }: { v: number, omega: number, dt: number }, turnRateError: number = 0) {
  const turnRate = omega + turnRateError || 1e-9;
  return Array.from({ length: 25 }, (_, i) => {
    const turnSoFar = (turnRate * dt * i) / 24;
    return [(v / turnRate) * Math.sin(turnSoFar), (v / turnRate) * (1 - Math.cos(turnSoFar))] as Point;
  });
}

/** Outlines that can be chosen instead of drawn, by name. */
const SHAPE_OUTLINES: Record<string, (command: { v: number, omega: number, dt: number }) => Point[]> = {
  point: (command) => createEllipseAround(toPixel(sampleCommandedArc(command)[24]), 7, 7),
  band: (command) => {
    const bandEdgeOf = (speedFactor: number) => Array.from({ length: 13 }, (_, i) => toPixel(sampleCommandedArc({ ...command, v: command.v * speedFactor }, (i - 6) / 18)[24]));
    return [...bandEdgeOf(1.04), ...bandEdgeOf(0.96).reverse()];
  },
  ellipse: (command) => createEllipseAround(toPixel(sampleCommandedArc(command)[24]), 42, 26),
};

const createEllipseAround = ([x, y]: Point, radiusX: number, radiusY: number) =>
  Array.from({ length: 37 }, (_, i) => [x + radiusX * Math.cos((i * Math.PI) / 18), y + radiusY * Math.sin((i * Math.PI) / 18)] as Point);

/** Maximum width and height (pixels) of a drawing that counts as a point. */
const MAX_POINT_EXTENT = 25;

/** Returns 'point' for a drawing no larger than a point, otherwise 'drawing'. */
function shapeOf(points: Point[]): string {
  const isLargerThanPoint = [0, 1].some((axis) => {
    const [min, max] = extent(points, (point) => point[axis]) as [number, number];
    return max - min > MAX_POINT_EXTENT;
  });
  return isLargerThanPoint ? 'drawing' : 'point';
}

/**
 * Returns sentences on where the robots stop (`poses`: x, y, θ triples), and whether the expected shape is right. For a drawing, they say
 * which fraction of the robots stops inside the outline.
 */
function describeOutcome(poses: Float64Array, expectedShape: string, insideFraction: number) {
  const deviationAlong = (axis: number) => deviation(poses.filter((_, i) => i % 3 === axis)) ?? 0;
  const [positionStd, headingStd] = [Math.hypot(deviationAlong(0), deviationAlong(1)), deviationAlong(2)];
  const insideText = `${Math.round(100 * insideFraction)}\u00a0% of the robots stop inside your outline. `;
  const verdictText = positionStd > MIN_SPREAD && expectedShape === 'drawing' ? insideText : expectedShape === (positionStd > MIN_SPREAD ? 'band' : 'point') ? 'Right. ' : 'Not what you expected. ';
  if (positionStd > MIN_SPREAD) return `${verdictText}The robots spread over a curved band, by ${positionStd.toFixed(2)}\u00a0m (1σ), their headings by ${headingStd.toFixed(2)}\u00a0rad.`;
  if (headingStd > MIN_SPREAD) return `${verdictText}Every robot stops at the same point. Only the headings differ, by ${headingStd.toFixed(2)}\u00a0rad (1σ).`;
  return `${verdictText}Every robot stops at the same point, with the same heading. There is no cloud.`;
}

/** Prepares a form with a pad to draw on. `enterState` puts the figure into the state of the chosen radio button `case`. */
export function prepareSketch(form: HTMLFormElement, enterState: (values: Record<string, unknown>) => Promise<void>, figure: Figure) {
  const findSvgChild = (name: string) => form.querySelector(`svg .${name}`) as SVGElement;
  const drawingPad = form.querySelector('svg') as SVGSVGElement;
  const statusOutput = form.querySelector('[role=status]') as HTMLElement;
  const button = form.querySelector('button') as HTMLButtonElement;
  let drawnPoints: Point[] = [];

  const findCheckedInput = (name: string) => form.querySelector(`[name=${name}]:checked`) as HTMLInputElement | null;
  const getChosenCase = () => JSON.parse(findCheckedInput('case')?.value ?? '{}');
  const readCurrentCommand = () => ({ v: 1, omega: getChosenCase().omega ?? 0, dt: 2 });
  const showDrawing = (points: Point[]) => {
    drawnPoints = points;
    findSvgChild('drawn').setAttribute('d', pathDataOf(points, true));
    button.disabled = points.length < 2;
  };
  const resetDrawing = () => {
    const arcPixels = sampleCommandedArc(readCurrentCommand()).map(toPixel);
    findSvgChild('command').setAttribute('d', pathDataOf(arcPixels));
    for (const [name, coordinateIndex] of [['cx', 0], ['cy', 1]]) findSvgChild('end').setAttribute(String(name), String(arcPixels[24][Number(coordinateIndex)]));
    for (const name of ['robots', 'headings']) findSvgChild(name).setAttribute('d', '');
    statusOutput.textContent = '';
    const shapeInput = findCheckedInput('shape');
    if (shapeInput) shapeInput.checked = false;
    showDrawing([]);
  };
  const pointOfEvent = (event: PointerEvent) => {
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(drawingPad.getScreenCTM()?.inverse());
    return [x, y] as Point;
  };

  drawingPad.addEventListener('pointerdown', (event) => {
    const shapeInput = findCheckedInput('shape');
    if (shapeInput) shapeInput.checked = false;
    drawingPad.setPointerCapture(event.pointerId);
    showDrawing([pointOfEvent(event)]);
  });
  drawingPad.addEventListener('pointermove', (event) => {
    if (drawingPad.hasPointerCapture(event.pointerId)) showDrawing([...drawnPoints, pointOfEvent(event)]);
  });
  form.addEventListener('change', ({ target }) => {
    const { name, value } = target as HTMLInputElement;
    if (name === 'case') resetDrawing();
    else showDrawing(SHAPE_OUTLINES[value](readCurrentCommand()));
  });
  form.addEventListener('submit', async (event) => {
    event.preventDefault();
    await enterState(getChosenCase());
    const poses = figure.poses as Float64Array;
    const robotPoses = Array.from({ length: poses.length / 3 }, (_, i) => poses.subarray(3 * i, 3 * i + 3));
    const robotDots = robotPoses.slice(0, MAX_DRAWN_ROBOTS).map(([x, y, theta]) => {
      const [px, py] = toPixel([x, y]);
      return { dot: `M${px} ${py}h0`, tick: `M${px} ${py}l${TICK_LENGTH * Math.cos(theta)} ${-TICK_LENGTH * Math.sin(theta)}` };
    });
    findSvgChild('robots').setAttribute('d', robotDots.map(({ dot }) => dot).join(''));
    findSvgChild('headings').setAttribute('d', robotDots.map(({ tick }) => tick).join(''));
    const drawnOutline = findSvgChild('drawn') as SVGPathElement;
    const insideCount = robotPoses.filter(([x, y]) => drawnOutline.isPointInFill(new DOMPoint(...toPixel([x, y])))).length;
    form.classList.add('revealed');
    statusOutput.textContent = describeOutcome(poses, findCheckedInput('shape')?.value ?? shapeOf(drawnPoints), insideCount / robotPoses.length);
  });
  resetDrawing();
}
