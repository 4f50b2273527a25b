// Banana Machine in plain JavaScript, the baseline of the benchmark. Like the core it uses typed arrays, common random numbers and two
// passes over the cloud. It computes neither the contours nor the standard error of the skew.

/**
 * @typedef {import('./scene.js').Command} Command
 * @typedef {import('./scene.js').Picture} Picture
 */

/** Keys of the sums over all samples, in order: x, y, length, lateral offset, turn, sine and cosine of the turn, and products of these. */
const MEAN_KEYS = ['x', 'y', 'l', 'm', 't', 's', 'c', 'xx', 'xy', 'yy', 'xt', 'yt', 'tt', 'll', 'lm', 'mm', 'lt', 'mt'];

export class Baseline {
  /** @param {number[]} alphas @param {Float64Array} unitNoise three standard normal numbers for each sample */
  constructor(alphas, unitNoise) {
    this.alphas = alphas;
    this.samples = unitNoise.length / 3;
    this.unitNoise = unitNoise;
    /** Offsets of each sample from the noise-free motion: x, y, length of the arc, heading. */
    this.cloud = new Float64Array(4 * this.samples);
    this.cellCounts = new Uint32Array(0);
    this.pixels = new Uint32Array(0);
  }

  /**
   * Computes statistics and the density picture for one event of the slider.
   *
   * @param {Command} command
   * @param {Picture} pictureView
   * @param {Uint8Array} colourRamp
   */
  refresh({ v, omega, dt }, pictureView, colourRamp) {
    const n = this.samples;
    const [a1, a2, a3, a4, a5, a6] = this.alphas;
    const [vSquared, omegaSquared] = [v * v, omega * omega];
    const noiseStds = [a1 * vSquared + a2 * omegaSquared, a3 * vSquared + a4 * omegaSquared, a5 * vSquared + a6 * omegaSquared].map(Math.sqrt);
    const halfTurn = 0.5 * omega * dt;
    const chordLength = halfTurn === 0 ? v * dt : (v * dt * Math.sin(halfTurn)) / halfTurn;
    const noiseFree = { x: chordLength * Math.cos(halfTurn), y: chordLength * Math.sin(halfTurn), l: v * dt, t: 2 * halfTurn };
    const sampleSums = driveBaselineCloud(this.unitNoise, this.cloud, [v, omega, dt], noiseStds, noiseFree);
    const meanValues = Object.fromEntries(MEAN_KEYS.map((meanKey, i) => [meanKey, sampleSums[i] / n]));
    const covarianceOf = (/** @type {string} */ a, /** @type {string} */ b) => (n / (n - 1)) * ((meanValues[a + b] ?? meanValues[b + a]) - meanValues[a] * meanValues[b]);
    const covarianceMatrixOf = (/** @type {string[]} */ meanKeys) => meanKeys.map((a) => meanKeys.map((b) => covarianceOf(a, b)));
    const heading = noiseFree.t + Math.atan2(meanValues.s, meanValues.c);
    const cartesianMoments = { mean: [noiseFree.x + meanValues.x, noiseFree.y + meanValues.y, heading], cov: covarianceMatrixOf(['x', 'y', 't']) };
    const exponentialMoments = { mean: [noiseFree.l + meanValues.l, meanValues.m, noiseFree.t + meanValues.t], cov: covarianceMatrixOf(['l', 'm', 't']) };

    const { columnCount, rowCount } = pictureView;
    if (this.cellCounts.length !== columnCount * rowCount) {
      this.cellCounts = new Uint32Array(columnCount * rowCount);
      this.pixels = new Uint32Array(columnCount * rowCount);
    }
    this.cellCounts.fill(0);
    const whiteningFactorsOf = (/** @type {number[][]} */ covMatrix, /** @type {number} */ secondIndex) => {
      const cholesky00 = Math.sqrt(covMatrix[0][0]);
      const cholesky10 = covMatrix[0][secondIndex] / cholesky00;
      const cholesky11 = Math.sqrt(covMatrix[secondIndex][secondIndex] - cholesky10 * cholesky10);
      // The whitening factors map the 2σ ellipse to the unit circle.
      return [0.5 / cholesky00, (-0.5 * cholesky10) / (cholesky00 * cholesky11), 0.5 / cholesky11];
    };
    const cloudCentre = [meanValues.x, meanValues.y, meanValues.l, meanValues.t];
    const normalizers = [...cloudCentre, ...whiteningFactorsOf(cartesianMoments.cov, 1), ...whiteningFactorsOf(exponentialMoments.cov, 2), Math.sin(heading), Math.cos(heading)];
    const [pixelsPerMetreX, pixelsPerMetreY] = [columnCount / (pictureView.xMax - pictureView.xMin), rowCount / (pictureView.yMax - pictureView.yMin)];
    const [inEllipse, inExponential, sumOfSquares, sumOfCubes, maxCount] = countCells(
      this.cloud, this.cellCounts, normalizers, [(noiseFree.x - pictureView.xMin) * pixelsPerMetreX, pixelsPerMetreX, (pictureView.yMax - noiseFree.y) * pixelsPerMetreY, pixelsPerMetreY, columnCount, rowCount],
    );
    this.#paintPixels(colourRamp, maxCount);
    return {
      stats: {
        n,
        cartesian: cartesianMoments,
        exponential: exponentialMoments,
        crossTrackSkew: (sumOfCubes / n) / (sumOfSquares / n) ** 1.5,
        coverage: { ellipse: inEllipse / n, exponential: inExponential / n },
      },
      pixels: new Uint8ClampedArray(this.pixels.buffer),
    };
  }

  /** Paints each pixel in the colour for its number of samples. @param {Uint8Array} colourRamp @param {number} maxCount */
  #paintPixels(colourRamp, maxCount) {
    const { cellCounts, pixels } = this;
    const rampColours = new Uint32Array(colourRamp.buffer, colourRamp.byteOffset, 256);
    const colourOfCount = new Uint32Array(maxCount + 1);
    for (let sampleCount = 1; sampleCount <= maxCount; sampleCount++) colourOfCount[sampleCount] = rampColours[Math.round(255 * Math.sqrt(sampleCount / maxCount))];
    for (let i = 0; i < cellCounts.length; i++) pixels[i] = colourOfCount[cellCounts[i]];
  }
}

/**
 * First pass: computes the motion of every sample, and adds up the moments.
 *
 * @param {Float64Array} unitNoise
 * @param {Float64Array} cloudOffsets output: offsets of each sample
 * @param {number[]} commandVector v, ω, Δt
 * @param {number[]} noiseStds standard deviations of v̂, ω̂, γ̂
 * @param {{ x: number, y: number, l: number, t: number }} noiseFree noise-free motion
 * @returns {number[]} sums in the order of MEAN_KEYS
 */
function driveBaselineCloud(unitNoise, cloudOffsets, commandVector, noiseStds, noiseFree) {
  const [[v, omega, dt], [vStd, omegaStd, gammaStd], { x: noiseFreeX, y: noiseFreeY, l: noiseFreeLength, t: noiseFreeTurn }] = [commandVector, noiseStds, noiseFree];
  let sumX = 0, sumY = 0, sumLength = 0, sumLateral = 0, sumTurn = 0, sumSin = 0, sumCos = 0;
  let sumXX = 0, sumXY = 0, sumYY = 0, sumXTurn = 0, sumYTurn = 0, sumTurnTurn = 0;
  let sumLengthLength = 0, sumLengthLateral = 0, sumLateralLateral = 0, sumLengthTurn = 0, sumLateralTurn = 0;
  for (let i = 0, j = 0; i < unitNoise.length; i += 3, j += 4) {
    const drivenLength = (v + vStd * unitNoise[i]) * dt;
    const halfTurn = 0.5 * (omega + omegaStd * unitNoise[i + 1]) * dt;
    const chordLength = halfTurn === 0 ? drivenLength : (drivenLength * Math.sin(halfTurn)) / halfTurn;
    const x = chordLength * Math.cos(halfTurn);
    const y = chordLength * Math.sin(halfTurn);
    let turnOffset = 2 * halfTurn + gammaStd * unitNoise[i + 2] * dt - noiseFreeTurn;
    if (turnOffset > Math.PI || turnOffset < -Math.PI) turnOffset -= 2 * Math.PI * Math.round(turnOffset / (2 * Math.PI));
    // l and m are exponential coordinates. l is the length along the arc, and m is the lateral offset.
    const halfAngle = 0.5 * (noiseFreeTurn + turnOffset);
    const lengthPerChord = halfAngle === 0 ? 1 : halfAngle / Math.tan(halfAngle);
    const lengthOffset = lengthPerChord * x + halfAngle * y - noiseFreeLength;
    const lateralOffset = lengthPerChord * y - halfAngle * x;
    const dx = x - noiseFreeX;
    const dy = y - noiseFreeY;
    sumX += dx;
    sumY += dy;
    sumLength += lengthOffset;
    sumLateral += lateralOffset;
    sumTurn += turnOffset;
    sumSin += Math.sin(turnOffset);
    sumCos += Math.cos(turnOffset);
    sumXX += dx * dx;
    sumXY += dx * dy;
    sumYY += dy * dy;
    sumXTurn += dx * turnOffset;
    sumYTurn += dy * turnOffset;
    sumTurnTurn += turnOffset * turnOffset;
    sumLengthLength += lengthOffset * lengthOffset;
    sumLengthLateral += lengthOffset * lateralOffset;
    sumLateralLateral += lateralOffset * lateralOffset;
    sumLengthTurn += lengthOffset * turnOffset;
    sumLateralTurn += lateralOffset * turnOffset;
    cloudOffsets[j] = dx;
    cloudOffsets[j + 1] = dy;
    cloudOffsets[j + 2] = lengthOffset;
    cloudOffsets[j + 3] = turnOffset;
  }
  return [sumX, sumY, sumLength, sumLateral, sumTurn, sumSin, sumCos, sumXX, sumXY, sumYY, sumXTurn, sumYTurn, sumTurnTurn, sumLengthLength, sumLengthLateral, sumLateralLateral, sumLengthTurn, sumLateralTurn];
}

/**
 * Second pass: counts the samples in both contours and in the cells of the picture, and adds up central moments across the mean heading.
 *
 * @param {Float64Array} cloudOffsets
 * @param {Uint32Array} cellCounts numbers of samples in the cells, which the function increases
 * @param {number[]} normalizers centre, whitening of both ellipses, sine and cosine of the mean heading
 * @param {number[]} pixelTransform offset and pixels a metre of both axes, columns and rows
 * @returns {number[]} samples inside each contour, sums of squares and cubes, largest count
 */
function countCells(cloudOffsets, cellCounts, normalizers, pixelTransform) {
  const [meanX, meanY, meanLength, meanTurn, ellipse00, ellipse10, ellipse11, exponential00, exponential10, exponential11, sin, cos] = normalizers;
  const [xOriginPixels, pixelsPerMetreX, yOriginPixels, pixelsPerMetreY, columnCount, rowCount] = pixelTransform;
  let inEllipse = 0, inExponential = 0, sumOfSquares = 0, sumOfCubes = 0, maxCount = 0;
  for (let j = 0; j < cloudOffsets.length; j += 4) {
    const x = cloudOffsets[j];
    const y = cloudOffsets[j + 1];
    const dx = x - meanX;
    const dy = y - meanY;
    const a = ellipse00 * dx;
    const b = ellipse10 * dx + ellipse11 * dy;
    // Adding 0 or 1 is faster than a branch that cannot be predicted.
    inEllipse += +(a * a + b * b <= 1);
    const dLength = cloudOffsets[j + 2] - meanLength;
    const e = exponential00 * dLength;
    const f = exponential10 * dLength + exponential11 * (cloudOffsets[j + 3] - meanTurn);
    inExponential += +(e * e + f * f <= 1);
    const z = cos * dy - sin * dx;
    sumOfSquares += z * z;
    sumOfCubes += z * z * z;
    const pixelColumn = xOriginPixels + x * pixelsPerMetreX;
    const pixelRow = yOriginPixels - y * pixelsPerMetreY;
    if (pixelColumn >= 0 && pixelRow >= 0 && pixelColumn < columnCount && pixelRow < rowCount) {
      const cellCount = ++cellCounts[(pixelRow | 0) * columnCount + (pixelColumn | 0)];
      if (cellCount > maxCount) maxCount = cellCount;
    }
  }
  return [inEllipse, inExponential, sumOfSquares, sumOfCubes, maxCount];
}
