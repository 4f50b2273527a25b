/**
 * The Banana Machine as the best JavaScript that we could write: typed arrays, common random numbers, and two passes
 * over the cloud. The first transforms every draw and sums what needs no mean; the second takes what does.
 *
 * What was tried besides, and was slower, is in doc/benchmarks.md.
 *
 * @module
 */

import { Ellipse, exponentialOutline } from './contours.js';

/**
 * @typedef {import('./scene.js').Command} Command
 * @typedef {import('./scene.js').Picture} Picture
 * @typedef {{ mean: number[], cov: number[][] }} Moments
 */

/** Where the plain formulas leave their results: an array that is returned would cost the fast path, too. */
const far = new Float64Array(5);
/** Samples taken at a time, so that V8 keeps the code of the loops: that of one long loop goes with every event. */
const BLOCK = 1024;
/** Of the present block, the lateral exponential coordinates: of them there are only sums. */
const lateral = new Float64Array(BLOCK);
/** Half angles within which the polynomials hold and no heading wraps: together half a turn. */
const REACH = Math.PI / 4;
/** Below this the quotients of half angles are left to the plain formulas. */
const SMALL = 1e-6;

// sin and cos within an eighth of a turn, to rounding: the polynomials of Sun's fdlibm.
const S1 = -1.66666666666666324348e-1;
const S2 = 8.33333333332248946124e-3;
const S3 = -1.98412698298579493134e-4;
const S4 = 2.75573137070700676789e-6;
const S5 = -2.50507602534068634195e-8;
const S6 = 1.58969099521155010221e-10;
const C1 = 4.16666666666666019037e-2;
const C2 = -1.38888888888741095749e-3;
const C3 = 2.48015872894767294178e-5;
const C4 = -2.75573143513906633035e-7;
const C5 = 2.08757232129817482790e-9;
const C6 = -1.13596475577881948265e-11;

export class TypedMachine {
  /**
   * @param {number[]} alphas
   * @param {Float64Array} unitNoise of v̂, ω̂ and γ̂ of one sample after the other
   */
  constructor(alphas, unitNoise) {
    this.alphas = alphas;
    this.samples = unitNoise.length / 3;
    this.unitNoise = unitNoise;
    // About the end of the command: x, y, length along, turn, its sine and cosine of each sample.
    this.cloud = new Float64Array(6 * this.samples);
    this.counts = new Uint32Array(0);
    this.pixels = new Uint32Array(0);
    this.shades = new Uint32Array(0);
  }

  /**
   * One event of the slider.
   *
   * @param {Command} command
   * @param {Picture} view
   * @param {Uint8Array} ramp
   */
  refresh(command, view, ramp) {
    const figures = figuresOf(this.#transform(command), this.samples);
    const seen = this.#measure(figures, view);
    this.#paint(view, ramp, seen.most);
    const { cartesian, exponential, skew, ellipse } = figures;
    return {
      stats: {
        n: this.samples,
        cartesian,
        exponential,
        crossTrackSkew: skew,
        crossTrackSkewError: Math.sqrt(seen.influence) / this.samples,
        coverage: { ellipse: seen.inEllipse / this.samples, exponential: seen.inTilted / this.samples },
      },
      contours: { ellipse: ellipse.outline(), exponential: exponentialOutline(exponential.mean, exponential.cov) },
      pixels: new Uint8ClampedArray(this.pixels.buffer),
    };
  }

  /**
   * Where every draw leads, and sums about the end of the command.
   *
   * @param {Command} command
   */
  #transform({ v, omega, dt }) {
    const [a1, a2, a3, a4, a5, a6] = this.alphas;
    const [length, half] = [v * dt, 0.5 * omega * dt];
    const chord = half === 0 ? length : (length * Math.sin(half)) / half;
    const origin = { x0: chord * Math.cos(half), y0: chord * Math.sin(half), length, turn: 2 * half };
    const motion = Float64Array.of(
      length,
      dt * Math.sqrt(a1 * v * v + a2 * omega * omega),
      half,
      0.5 * dt * Math.sqrt(a3 * v * v + a4 * omega * omega),
      0.5 * dt * Math.sqrt(a5 * v * v + a6 * omega * omega),
      origin.x0,
      origin.y0,
    );
    const sums = new Float64Array(22);
    for (let from = 0; from < this.samples; from += BLOCK) {
      const to = Math.min(from + BLOCK, this.samples);
      transform(motion, this.unitNoise, this.cloud, from, to);
      accumulate(this.cloud, from, to, sums);
    }
    return { origin, sums };
  }

  /**
   * What the means have to be known for: shares inside the contours, influences on the skew, and the picture's counts.
   *
   * @param {ReturnType<typeof figuresOf>} figures
   * @param {Picture} view
   */
  #measure(figures, view) {
    const { columns, rows } = view;
    if (this.counts.length !== columns * rows) {
      this.counts = new Uint32Array(columns * rows);
      this.pixels = new Uint32Array(columns * rows);
    }
    this.counts.fill(0);
    const { origin, centre, heading, skew, sd, pull, ellipse, tilted } = figures;
    const perX = columns / (view.xMax - view.xMin);
    const perY = rows / (view.yMax - view.yMin);
    const drift = heading - origin.turn;
    const scales = Float64Array.of(
      centre[0],
      centre[1],
      // Whitened coordinates of both ellipses, in double their deviations.
      0.5 / ellipse.l00,
      (-0.5 * ellipse.l10) / (ellipse.l00 * ellipse.l11),
      0.5 / ellipse.l11,
      tilted.first - origin.length,
      tilted.second - origin.turn,
      0.5 / tilted.l00,
      (-0.5 * tilted.l10) / (tilted.l00 * tilted.l11),
      0.5 / tilted.l11,
      -Math.sin(heading) / sd,
      Math.cos(heading) / sd,
      skew,
      pull * Math.cos(drift),
      pull * Math.sin(drift),
      (origin.x0 - view.xMin) * perX,
      perX,
      (view.yMax - origin.y0) * perY,
      perY,
    );
    const seen = new Float64Array(4);
    for (let from = 0; from < this.samples; from += BLOCK) {
      measure(scales, columns, rows, this.cloud, this.counts, from, Math.min(from + BLOCK, this.samples), seen);
    }
    const [inEllipse, inTilted, influence, most] = seen;
    return { inEllipse, inTilted, influence, most };
  }

  /**
   * Counts to colours, by a table of all counts that there are.
   *
   * @param {Picture} view
   * @param {Uint8Array} ramp
   * @param {number} most
   */
  #paint(view, ramp, most) {
    const { counts, pixels } = this;
    const colours = new Uint32Array(ramp.buffer, ramp.byteOffset, 256);
    if (this.shades.length <= most) this.shades = new Uint32Array(2 * most + 1);
    const { shades } = this;
    for (let count = 1; count <= most; count++) shades[count] = colours[Math.round(255 * Math.sqrt(count / most))];
    for (let i = 0; i < counts.length; i++) pixels[i] = shades[counts[i]];
  }
}

/**
 * One block of the first pass.
 *
 * With half angles, h of the arc, g of the last turn, and q = v̂Δt·sin h/h, a robot ends at q·(cos h, sin h), and its
 * exponential coordinates are q·(h + g)/sin(h + g)·(cos g, −sin g): the sines of two small angles are all it takes.
 *
 * @param {Float64Array} motion
 * @param {Float64Array} unitNoise
 * @param {Float64Array} cloud is filled
 * @param {number} from
 * @param {number} to
 */
function transform(motion, unitNoise, cloud, from, to) {
  const length = motion[0];
  const lengthNoise = motion[1];
  const half = motion[2];
  const arcNoise = motion[3];
  const lastNoise = motion[4];
  const x0 = motion[5];
  const y0 = motion[6];
  const sinHalf = Math.sin(half);
  const cosHalf = Math.cos(half);
  for (let i = from; i < to; i++) {
    const a = arcNoise * unitNoise[3 * i + 1];
    const g = lastNoise * unitNoise[3 * i + 2];
    const driven = length + lengthNoise * unitNoise[3 * i];
    const u = a * a;
    const sinA = a + a * u * (S1 + u * (S2 + u * (S3 + u * (S4 + u * (S5 + u * S6)))));
    const cosA = 1 - 0.5 * u + u * u * (C1 + u * (C2 + u * (C3 + u * (C4 + u * (C5 + u * C6)))));
    const w = g * g;
    const sinG = g + g * w * (S1 + w * (S2 + w * (S3 + w * (S4 + w * (S5 + w * S6)))));
    const cosG = 1 - 0.5 * w + w * w * (C1 + w * (C2 + w * (C3 + w * (C4 + w * (C5 + w * C6)))));
    const h = half + a;
    const sinH = sinHalf * cosA + cosHalf * sinA;
    const cosH = cosHalf * cosA - sinHalf * sinA;
    const sinT = sinH * cosG + cosH * sinG;
    const divisor = h * sinT;
    let x, y, l, m, t, s, c;
    if (a < REACH && a > -REACH && g < REACH && g > -REACH && (divisor > SMALL || divisor < -SMALL)) {
      const q = (driven * sinH) / divisor;
      const chordOfArc = q * sinT;
      const stretch = q * (h + g);
      const sinE = sinA * cosG + cosA * sinG;
      const cosE = cosA * cosG - sinA * sinG;
      x = chordOfArc * cosH - x0;
      y = chordOfArc * sinH - y0;
      l = stretch * cosG - length;
      m = -stretch * sinG;
      t = 2 * (a + g);
      s = 2 * sinE * cosE;
      c = 1 - 2 * sinE * sinE;
    } else {
      plain(driven, half, a, g, far);
      x = far[0] - x0;
      y = far[1] - y0;
      l = far[2] - length;
      m = far[3];
      t = far[4];
      s = Math.sin(t);
      c = Math.cos(t);
    }
    cloud[6 * i] = x;
    cloud[6 * i + 1] = y;
    cloud[6 * i + 2] = l;
    cloud[6 * i + 3] = t;
    cloud[6 * i + 4] = s;
    cloud[6 * i + 5] = c;
    lateral[i - from] = m;
  }
}

/**
 * Their sums: a loop of its own, because one loop with as many sums besides runs out of registers.
 *
 * @param {Float64Array} cloud
 * @param {number} from
 * @param {number} to
 * @param {Float64Array} sums are added to
 */
function accumulate(cloud, from, to, sums) {
  let x1 = 0, y1 = 0, l1 = 0, m1 = 0, t1 = 0, s1 = 0, c1 = 0;
  let xx = 0, xy = 0, yy = 0, xt = 0, yt = 0, tt = 0;
  let ll = 0, lm = 0, mm = 0, lt = 0, mt = 0;
  let xxx = 0, xxy = 0, xyy = 0, yyy = 0;
  for (let i = from; i < to; i++) {
    const x = cloud[6 * i];
    const y = cloud[6 * i + 1];
    const l = cloud[6 * i + 2];
    const m = lateral[i - from];
    const t = cloud[6 * i + 3];
    const s = cloud[6 * i + 4];
    const c = cloud[6 * i + 5];
    const x2 = x * x;
    const y2 = y * y;
    x1 += x;
    y1 += y;
    l1 += l;
    m1 += m;
    t1 += t;
    s1 += s;
    c1 += c;
    xx += x2;
    xy += x * y;
    yy += y2;
    xt += x * t;
    yt += y * t;
    tt += t * t;
    ll += l * l;
    lm += l * m;
    mm += m * m;
    lt += l * t;
    mt += m * t;
    xxx += x2 * x;
    xxy += x2 * y;
    xyy += x * y2;
    yyy += y2 * y;
  }
  sums[0] += x1;
  sums[1] += y1;
  sums[2] += l1;
  sums[3] += m1;
  sums[4] += t1;
  sums[5] += s1;
  sums[6] += c1;
  sums[7] += xx;
  sums[8] += xy;
  sums[9] += yy;
  sums[10] += xt;
  sums[11] += yt;
  sums[12] += tt;
  sums[13] += ll;
  sums[14] += lm;
  sums[15] += mm;
  sums[16] += lt;
  sums[17] += mt;
  sums[18] += xxx;
  sums[19] += xxy;
  sums[20] += xyy;
  sums[21] += yyy;
}

/**
 * One block of the second pass.
 *
 * @param {Float64Array} scales
 * @param {number} columns
 * @param {number} rows
 * @param {Float64Array} cloud
 * @param {Uint32Array} counts
 * @param {number} from
 * @param {number} to
 * @param {Float64Array} seen
 */
function measure(scales, columns, rows, cloud, counts, from, to, seen) {
  const cx = scales[0];
  const cy = scales[1];
  const e00 = scales[2];
  const e10 = scales[3];
  const e11 = scales[4];
  const cl = scales[5];
  const ct = scales[6];
  const f00 = scales[7];
  const f10 = scales[8];
  const f11 = scales[9];
  const across0 = scales[10];
  const across1 = scales[11];
  const skew = scales[12];
  const pullSine = scales[13];
  const pullCosine = scales[14];
  const left = scales[15];
  const perX = scales[16];
  const top = scales[17];
  const perY = scales[18];
  let inEllipse = 0, inTilted = 0, influence = 0, most = seen[3];
  for (let i = from; i < to; i++) {
    const x = cloud[6 * i];
    const y = cloud[6 * i + 1];
    const dx = x - cx;
    const dy = y - cy;
    const a = e00 * dx;
    const b = e10 * dx + e11 * dy;
    // As sums of 0 and 1, not branches: which robots are inside cannot be predicted.
    inEllipse += +(a * a + b * b <= 1);
    const dl = cloud[6 * i + 2] - cl;
    const e = f00 * dl;
    const f = f10 * dl + f11 * (cloud[6 * i + 3] - ct);
    inTilted += +(e * e + f * f <= 1);
    const z = across0 * dx + across1 * dy;
    const z2 = z * z;
    const one = z * (z2 - 3) - skew * (1.5 * z2 - 0.5) + pullSine * cloud[6 * i + 4] - pullCosine * cloud[6 * i + 5];
    influence += one * one;
    const column = left + x * perX;
    const row = top - y * perY;
    if (column >= 0 && row >= 0 && column < columns && row < rows) {
      const count = ++counts[(row | 0) * columns + (column | 0)];
      if (count > most) most = count;
    }
  }
  seen[0] += inEllipse;
  seen[1] += inTilted;
  seen[2] += influence;
  seen[3] = most;
}

/**
 * The same for any angles at all, and slower.
 *
 * @param {number} driven length
 * @param {number} half of the commanded turn
 * @param {number} a half of the arc's excess
 * @param {number} g half of the last turn
 * @param {Float64Array} out x, y, along, lateral, and the turn's excess
 */
function plain(driven, half, a, g, out) {
  const h = half + a;
  const chord = h === 0 ? driven : (driven * Math.sin(h)) / h;
  const x = chord * Math.cos(h);
  const y = chord * Math.sin(h);
  const excess = 2 * (a + g);
  const t = excess - 2 * Math.PI * Math.round(excess / (2 * Math.PI));
  const turn = half + 0.5 * t;
  const diagonal = turn === 0 ? 1 : turn / Math.tan(turn);
  out[0] = x;
  out[1] = y;
  out[2] = diagonal * x + turn * y;
  out[3] = diagonal * y - turn * x;
  out[4] = t;
}

/**
 * @param {{ origin: { x0: number, y0: number, length: number, turn: number }, sums: Float64Array }} transformed
 * @param {number} n
 */
function figuresOf({ origin, sums }, n) {
  const averages = sums.map((sum) => sum / n);
  const [x, y, l, m, t, s, c, xx, xy, yy, xt, yt, tt, ll, lm, mm, lt, mt, xxx, xxy, xyy, yyy] = averages;
  const heading = origin.turn + Math.atan2(s, c);
  const overLess = n / (n - 1);
  const moments = (/** @type {number[]} */ mean, /** @type {number[]} */ [aa, ab, ac, bb, bc, cc]) => ({
    mean,
    cov: [[aa, ab, ac], [ab, bb, bc], [ac, bc, cc]].map((row) => row.map((value) => value * overLess)),
  });
  const [vxx, vxy, vyy, vtt] = [xx - x * x, xy - x * y, yy - y * y, tt - t * t];
  const cartesian = moments(
    [origin.x0 + x, origin.y0 + y, heading],
    [vxx, vxy, xt - x * t, vyy, yt - y * t, vtt],
  );
  const exponential = moments(
    [origin.length + l, m, origin.turn + t],
    [ll - l * l, lm - l * m, lt - l * t, mm - m * m, mt - m * t, vtt],
  );

  // Third central moments, then turned so that d = y·cos − x·sin is across the mean heading and a along it.
  const mxxx = xxx - 3 * x * xx + 2 * x * x * x;
  const mxxy = xxy - 2 * x * xy - y * xx + 2 * x * x * y;
  const mxyy = xyy - 2 * y * xy - x * yy + 2 * x * y * y;
  const myyy = yyy - 3 * y * yy + 2 * y * y * y;
  const [sin, cos] = [Math.sin(heading), Math.cos(heading)];
  const [s2, c2, sc] = [sin * sin, cos * cos, sin * cos];
  const dd = c2 * vyy - 2 * sc * vxy + s2 * vxx;
  const ad = sc * (vyy - vxx) + (c2 - s2) * vxy;
  const ddd = c2 * (cos * myyy - 3 * sin * mxyy) + s2 * (3 * cos * mxxy - sin * mxxx);
  const add = sc * (cos * myyy + sin * mxxx) + cos * (c2 - 2 * s2) * mxyy + sin * (s2 - 2 * c2) * mxxy;
  const sd = Math.sqrt(dd);
  const skew = ddd / (dd * sd);
  // How much the skew follows a turn of the mean heading.
  const pull = (3 * ((skew * ad) / dd - add / (dd * sd))) / Math.hypot(s, c);
  const pick = (/** @type {Moments} */ { mean, cov }, /** @type {number} */ j) =>
    new Ellipse(mean[0], mean[j], cov[0][0], cov[0][j], cov[j][j]);
  const [ellipse, tilted] = [pick(cartesian, 1), pick(exponential, 2)];
  return { origin, centre: [x, y], heading, cartesian, exponential, skew, sd, pull, ellipse, tilted };
}
