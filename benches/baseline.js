/**
 * Banana Machine in plain JavaScript: the baseline of the benchmark. Typed arrays, common random numbers and two passes over the
 * cloud, as in the core. It leaves out the contours and the standard error of the skew, which the core computes.
 *
 * @module
 */

/**
 * @typedef {import('./scene.js').Command} Command
 * @typedef {import('./scene.js').Picture} Picture
 */

/** Names of the sums of the first pass, in order: x, y, length, lateral, turn, sine and cosine of the turn, and products. */
const SUM_NAMES = ['x', 'y', 'l', 'm', 't', 's', 'c', 'xx', 'xy', 'yy', 'xt', 'yt', 'tt', 'll', 'lm', 'mm', 'lt', 'mt'];

export class Baseline {
  /** @param {number[]} alphas @param {Float64Array} unitNoise three standard normal numbers for each sample */
  constructor(alphas, unitNoise) {
    this.alphas = alphas;
    this.samples = unitNoise.length / 3;
    this.unitNoise = unitNoise;
    /** Offsets of each sample from the noise-free motion: x, y, length of the arc, heading. */
    this.cloud = new Float64Array(4 * this.samples);
    this.counts = new Uint32Array(0);
    this.pixels = new Uint32Array(0);
  }

  /**
   * Computes statistics and the density picture for one event of the slider.
   *
   * @param {Command} command
   * @param {Picture} view
   * @param {Uint8Array} ramp
   */
  refresh({ v, omega, dt }, view, ramp) {
    const n = this.samples;
    const [a1, a2, a3, a4, a5, a6] = this.alphas;
    const [vv, ww] = [v * v, omega * omega];
    const stdDevs = [a1 * vv + a2 * ww, a3 * vv + a4 * ww, a5 * vv + a6 * ww].map(Math.sqrt);
    const halfTurn = 0.5 * omega * dt;
    const chordLength = halfTurn === 0 ? v * dt : (v * dt * Math.sin(halfTurn)) / halfTurn;
    const noiseFree = { x: chordLength * Math.cos(halfTurn), y: chordLength * Math.sin(halfTurn), l: v * dt, t: 2 * halfTurn };
    const sums = driveCloud(this.unitNoise, this.cloud, [v, omega, dt], stdDevs, noiseFree);
    const means = Object.fromEntries(SUM_NAMES.map((name, i) => [name, sums[i] / n]));
    const covarianceOf = (/** @type {string} */ a, /** @type {string} */ b) => (n / (n - 1)) * ((means[a + b] ?? means[b + a]) - means[a] * means[b]);
    const covarianceMatrixOf = (/** @type {string[]} */ names) => names.map((a) => names.map((b) => covarianceOf(a, b)));
    const heading = noiseFree.t + Math.atan2(means.s, means.c);
    const cartesian = { mean: [noiseFree.x + means.x, noiseFree.y + means.y, heading], cov: covarianceMatrixOf(['x', 'y', 't']) };
    const exponential = { mean: [noiseFree.l + means.l, means.m, noiseFree.t + means.t], cov: covarianceMatrixOf(['l', 'm', 't']) };

    const { columns, rows } = view;
    if (this.counts.length !== columns * rows) {
      this.counts = new Uint32Array(columns * rows);
      this.pixels = new Uint32Array(columns * rows);
    }
    this.counts.fill(0);
    const whiteningFactorsOf = (/** @type {number[][]} */ cov, /** @type {number} */ j) => {
      const l00 = Math.sqrt(cov[0][0]);
      const l10 = cov[0][j] / l00;
      const l11 = Math.sqrt(cov[j][j] - l10 * l10);
      // Two standard deviations get length 1.
      return [0.5 / l00, (-0.5 * l10) / (l00 * l11), 0.5 / l11];
    };
    const centre = [means.x, means.y, means.l, means.t];
    const normalization = [...centre, ...whiteningFactorsOf(cartesian.cov, 1), ...whiteningFactorsOf(exponential.cov, 2), Math.sin(heading), Math.cos(heading)];
    const [pixelsPerMetreX, pixelsPerMetreY] = [columns / (view.xMax - view.xMin), rows / (view.yMax - view.yMin)];
    const [inEllipse, inExponential, sumOfSquares, sumOfCubes, maxCount] = countCells(
      this.cloud, this.counts, normalization, [(noiseFree.x - view.xMin) * pixelsPerMetreX, pixelsPerMetreX, (view.yMax - noiseFree.y) * pixelsPerMetreY, pixelsPerMetreY, columns, rows],
    );
    this.#paint(ramp, maxCount);
    return {
      stats: {
        n,
        cartesian,
        exponential,
        crossTrackSkew: (sumOfCubes / n) / (sumOfSquares / n) ** 1.5,
        coverage: { ellipse: inEllipse / n, exponential: inExponential / n },
      },
      pixels: new Uint8ClampedArray(this.pixels.buffer),
    };
  }

  /** Paints the pixels by a table of the colours of all counts. @param {Uint8Array} ramp @param {number} maxCount */
  #paint(ramp, maxCount) {
    const { counts, pixels } = this;
    const colours = new Uint32Array(ramp.buffer, ramp.byteOffset, 256);
    const shadeOfCount = new Uint32Array(maxCount + 1);
    for (let count = 1; count <= maxCount; count++) shadeOfCount[count] = colours[Math.round(255 * Math.sqrt(count / maxCount))];
    for (let i = 0; i < counts.length; i++) pixels[i] = shadeOfCount[counts[i]];
  }
}

/**
 * Moves every sample and adds up its moments. This is the first pass.
 *
 * @param {Float64Array} noise
 * @param {Float64Array} cloud is filled
 * @param {number[]} command v, ω, Δt
 * @param {number[]} deviations standard deviations of v̂, ω̂, γ̂
 * @param {{ x: number, y: number, l: number, t: number }} origin noise-free motion
 * @returns {number[]} sums in the order of SUM_NAMES
 */
function driveCloud(noise, cloud, command, deviations, origin) {
  const [[v, omega, dt], [sdV, sdOmega, sdGamma], { x: x0, y: y0, l: l0, t: t0 }] = [command, deviations, origin];
  let x1 = 0, y1 = 0, l1 = 0, m1 = 0, t1 = 0, s1 = 0, c1 = 0;
  let xx = 0, xy = 0, yy = 0, xt = 0, yt = 0, tt = 0;
  let ll = 0, lm = 0, mm = 0, lt = 0, mt = 0;
  for (let i = 0, j = 0; i < noise.length; i += 3, j += 4) {
    const drivenLength = (v + sdV * noise[i]) * dt;
    const halfTurn = 0.5 * (omega + sdOmega * noise[i + 1]) * dt;
    const chordLength = halfTurn === 0 ? drivenLength : (drivenLength * Math.sin(halfTurn)) / halfTurn;
    const x = chordLength * Math.cos(halfTurn);
    const y = chordLength * Math.sin(halfTurn);
    let t = 2 * halfTurn + sdGamma * noise[i + 2] * dt - t0;
    if (t > Math.PI || t < -Math.PI) t -= 2 * Math.PI * Math.round(t / (2 * Math.PI));
    // l and m are exponential coordinates: the length along the arc and the lateral offset.
    const halfAngle = 0.5 * (t0 + t);
    const stretch = halfAngle === 0 ? 1 : halfAngle / Math.tan(halfAngle);
    const l = stretch * x + halfAngle * y - l0;
    const m = stretch * y - halfAngle * x;
    const dx = x - x0;
    const dy = y - y0;
    x1 += dx;
    y1 += dy;
    l1 += l;
    m1 += m;
    t1 += t;
    s1 += Math.sin(t);
    c1 += Math.cos(t);
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
    xt += dx * t;
    yt += dy * t;
    tt += t * t;
    ll += l * l;
    lm += l * m;
    mm += m * m;
    lt += l * t;
    mt += m * t;
    cloud[j] = dx;
    cloud[j + 1] = dy;
    cloud[j + 2] = l;
    cloud[j + 3] = t;
  }
  return [x1, y1, l1, m1, t1, s1, c1, xx, xy, yy, xt, yt, tt, ll, lm, mm, lt, mt];
}

/**
 * Counts the samples in both contours and in the cells of the picture, and adds up central moments across the mean heading. This is the
 * second pass.
 *
 * @param {Float64Array} cloud
 * @param {Uint32Array} counts are added to
 * @param {number[]} normalization centre, whitening of both ellipses, sine and cosine of the mean heading
 * @param {number[]} view offset and pixels a metre of both axes, columns and rows
 * @returns {number[]} samples inside each contour, sums of squares and cubes, largest count
 */
function countCells(cloud, counts, normalization, view) {
  const [cx, cy, cl, ct, e00, e10, e11, f00, f10, f11, sin, cos] = normalization;
  const [leftOffset, pixelsPerMetreX, topOffset, pixelsPerMetreY, columns, rows] = view;
  let inEllipse = 0, inExponential = 0, sumOfSquares = 0, sumOfCubes = 0, maxCount = 0;
  for (let j = 0; j < cloud.length; j += 4) {
    const x = cloud[j];
    const y = cloud[j + 1];
    const dx = x - cx;
    const dy = y - cy;
    const a = e00 * dx;
    const b = e10 * dx + e11 * dy;
    // A sum of 0 and 1 is faster than a branch that cannot be predicted.
    inEllipse += +(a * a + b * b <= 1);
    const dl = cloud[j + 2] - cl;
    const e = f00 * dl;
    const f = f10 * dl + f11 * (cloud[j + 3] - ct);
    inExponential += +(e * e + f * f <= 1);
    const z = cos * dy - sin * dx;
    sumOfSquares += z * z;
    sumOfCubes += z * z * z;
    const column = leftOffset + x * pixelsPerMetreX;
    const row = topOffset - y * pixelsPerMetreY;
    if (column >= 0 && row >= 0 && column < columns && row < rows) {
      const count = ++counts[(row | 0) * columns + (column | 0)];
      if (count > maxCount) maxCount = count;
    }
  }
  return [inEllipse, inExponential, sumOfSquares, sumOfCubes, maxCount];
}
