/** Sketch of a cloud: the reader draws the one expected, and the robots of the figure appear below the drawing. */

import { deviation } from 'd3-array';
import type { Figure } from '../page.ts';

/** Point in metres on the floor, or in pixels of the pad. */
export type Point = [x: number, y: number];

/** Scale of the pad, pixels per metre, and the robot's start in it. */
const SCALE = 95;
const START = { x: 30, y: 150 };

/** Robots drawn, and the length of their headings in pixels. */
const DRAWN = 150;
const TICK = 9;

/** Smallest standard deviation that counts as a spread. */
const NONE = 1e-6;

const pixel = ([x, y]: Point) => [START.x + SCALE * x, START.y - SCALE * y] as Point;

/** Returns a path through points in pixels. */
const pathOf = (points: Point[], closed: boolean = false) => (points.length ? `M${points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join('L')}${closed ? 'Z' : ''}` : '');

/** Returns points of the commanded arc, with an error of the turn rate in rad/s. */
function arcOf({ v, omega, dt }: { v: number, omega: number, dt: number }, rateError: number = 0) {
  const rate = omega + rateError || 1e-9;
  return Array.from({ length: 25 }, (_, i) => {
    const turn = (rate * dt * i) / 24;
    return [(v / rate) * Math.sin(turn), (v / rate) * (1 - Math.cos(turn))] as Point;
  });
}

/** Outlines that can be chosen instead of drawn, by name. */
const SHAPES: Record<string, (command: { v: number, omega: number, dt: number }) => Point[]> = {
  point: (command) => ringAround(pixel(arcOf(command)[24]), 7, 7),
  band: (command) => {
    const ends = (length: number) => Array.from({ length: 13 }, (_, i) => pixel(arcOf({ ...command, v: command.v * length }, (i - 6) / 18)[24]));
    return [...ends(1.04), ...ends(0.96).reverse()];
  },
  ellipse: (command) => ringAround(pixel(arcOf(command)[24]), 42, 26),
};

const ringAround = ([x, y]: Point, radiusX: number, radiusY: number) =>
  Array.from({ length: 37 }, (_, i) => [x + radiusX * Math.cos((i * Math.PI) / 18), y + radiusY * Math.sin((i * Math.PI) / 18)] as Point);

/** Maximum size in pixels of a drawing that stands for a point. */
const POINT_SIZE = 25;

const sizeAlong = (points: Point[], axis: number) => Math.max(...points.map((point) => point[axis])) - Math.min(...points.map((point) => point[axis]));

/** Returns the shape that a drawing stands for: a point, or any other. */
function shapeOf(points: Point[]): string {
  const isLong = [0, 1].some((axis) => sizeAlong(points, axis) > POINT_SIZE);
  return isLong ? 'drawing' : 'point';
}

/** Says where robots stop, by x, y, θ of one after the other, and whether the expected shape is right, which nobody can say of a drawn region. */
function outcomeOf(poses: Float64Array, expected: string) {
  const of = (axis: number) => deviation(poses.filter((_, i) => i % 3 === axis)) ?? 0;
  const [place, heading] = [Math.hypot(of(0), of(1)), of(2)];
  const verdict = place > NONE && expected === 'drawing' ? '' : expected === (place > NONE ? 'band' : 'point') ? 'Right. ' : 'Not what you expected. ';
  if (place > NONE) return `${verdict}The robots spread by ${place.toFixed(2)}\u00a0m (1σ), their headings by ${heading.toFixed(2)}\u00a0rad.`;
  if (heading > NONE) return `${verdict}Every robot stops at the same point. Only the headings differ, by ${heading.toFixed(2)}\u00a0rad (1σ).`;
  return `${verdict}Every robot stops at the same point, with the same heading. There is no cloud.`;
}

/** Prepares a form with a pad to draw on. `enter` puts the figure into the state of the chosen radio button `case`. */
export function prepareSketch(form: HTMLFormElement, enter: (values: Record<string, unknown>) => Promise<void>, figure: Figure) {
  const part = (name: string) => form.querySelector(`svg .${name}`) as SVGElement;
  const pad = form.querySelector('svg') as SVGSVGElement;
  const status = form.querySelector('[role=status]') as HTMLElement;
  const button = form.querySelector('button') as HTMLButtonElement;
  let drawn: Point[] = [];

  const chosen = (name: string) => form.querySelector(`[name=${name}]:checked`) as HTMLInputElement | null;
  const values = () => JSON.parse(chosen('case')?.value ?? '{}');
  const command = () => ({ v: 1, omega: values().omega ?? 0, dt: 2 });
  const draw = (points: Point[]) => {
    drawn = points;
    part('drawn').setAttribute('d', pathOf(points, true));
    button.disabled = points.length < 2;
  };
  const reset = () => {
    const arc = arcOf(command()).map(pixel);
    part('command').setAttribute('d', pathOf(arc));
    for (const [name, at] of [['cx', 0], ['cy', 1]]) part('end').setAttribute(String(name), String(arc[24][Number(at)]));
    for (const name of ['robots', 'headings']) part(name).setAttribute('d', '');
    status.textContent = '';
    const shape = chosen('shape');
    if (shape) shape.checked = false;
    draw([]);
  };
  const at = (event: PointerEvent) => {
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(pad.getScreenCTM()?.inverse());
    return [x, y] as Point;
  };

  pad.addEventListener('pointerdown', (event) => {
    const shape = chosen('shape');
    if (shape) shape.checked = false;
    pad.setPointerCapture(event.pointerId);
    draw([at(event)]);
  });
  pad.addEventListener('pointermove', (event) => {
    if (pad.hasPointerCapture(event.pointerId)) draw([...drawn, at(event)]);
  });
  form.addEventListener('change', ({ target }) => {
    const { name, value } = target as HTMLInputElement;
    if (name === 'case') reset();
    else draw(SHAPES[value](command()));
  });
  form.addEventListener('submit', async (event) => {
    event.preventDefault();
    await enter(values());
    const poses = figure.poses as Float64Array;
    const robots = Array.from({ length: Math.min(DRAWN, poses.length / 3) }, (_, i) => poses.subarray(3 * i, 3 * i + 3));
    const dots = robots.map(([x, y, theta]) => {
      const [px, py] = pixel([x, y]);
      return { dot: `M${px} ${py}h0`, tick: `M${px} ${py}l${TICK * Math.cos(theta)} ${-TICK * Math.sin(theta)}` };
    });
    part('robots').setAttribute('d', dots.map(({ dot }) => dot).join(''));
    part('headings').setAttribute('d', dots.map(({ tick }) => tick).join(''));
    status.textContent = outcomeOf(poses, chosen('shape')?.value ?? shapeOf(drawn));
  });
  reset();
}
