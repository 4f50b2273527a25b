/**
 * The two 2σ contours, for both baselines: their cost does not depend on how many samples there are, and so there is
 * nothing to race in them. The formulas are those of src/stats/contour.rs.
 *
 * @module
 */

/**
 * @typedef {object} Figures what both baselines compute, as the core's `stats` has it
 * @property {number} n
 * @property {{ mean: number[], cov: number[][] }} cartesian
 * @property {{ mean: number[], cov: number[][] }} exponential
 * @property {number} crossTrackSkew
 * @property {number} crossTrackSkewError
 * @property {{ ellipse: number, exponential: number }} coverage
 */

/** @typedef {{ ellipse: Float64Array, exponential: Float64Array }} Outlines x, y pairs, the first repeated at the end */

const SEGMENTS = 128;
const SIGMAS = 2;

/** An ellipse of two coordinates: its centre, and L of L·Lᵀ, the covariance: [l00, l10, l11]. */
export class Ellipse {
  /**
   * @param {number} first mean
   * @param {number} second
   * @param {number} c00 covariance
   * @param {number} c01
   * @param {number} c11
   */
  constructor(first, second, c00, c01, c11) {
    this.first = first;
    this.second = second;
    this.l00 = Math.sqrt(c00);
    this.l10 = c01 / this.l00;
    this.l11 = Math.sqrt(c11 - this.l10 * this.l10);
  }

  /**
   * @param {number} first
   * @param {number} second
   */
  contains(first, second) {
    const a = (first - this.first) / this.l00;
    const b = (second - this.second - this.l10 * a) / this.l11;
    return a * a + b * b <= SIGMAS * SIGMAS;
  }

  outline() {
    const points = new Float64Array(2 * SEGMENTS + 2);
    for (let i = 0; i <= SEGMENTS; i++) {
      const [cos, sin] = direction(i);
      points[2 * i] = this.first + SIGMAS * this.l00 * cos;
      points[2 * i + 1] = this.second + SIGMAS * (this.l10 * cos + this.l11 * sin);
    }
    return points;
  }
}

/**
 * The outline on the floor of N(mean, cov) in exponential coordinates.
 *
 * @param {number[]} mean along, lateral, heading
 * @param {number[][]} cov
 */
export function exponentialOutline(mean, cov) {
  const root = cholesky(cov);
  const at = (/** @type {number[]} */ u) => mean.map((m, i) => m + SIGMAS * dot(root[i], u));
  const spread = [0, 1, 2].map(() => [0, 0, 0]);
  for (const axis of [0, 1, 2]) {
    for (const sign of [1, -1]) {
      const end = [0, 0, 0];
      end[axis] = sign;
      const [byX, byY] = positionJacobian(at(end)).map((row) => [0, 1, 2].map((j) => dot(row, root.map((r) => r[j]))));
      const idle = cross(byX, byY);
      idle.forEach((a, i) => idle.forEach((b, j) => (spread[i][j] += a * b)));
    }
  }
  const idle = principalDirection(spread);
  const least = idle.reduce((best, value, i) => (Math.abs(value) < Math.abs(idle[best]) ? i : best), 0);
  const first = normalized([0, 1, 2].map((i) => (i === least ? 1 : 0) - idle[i] * idle[least]));
  const second = cross(idle, first);
  const points = new Float64Array(2 * SEGMENTS + 2);
  for (let i = 0; i <= SEGMENTS; i++) {
    const [cos, sin] = direction(i);
    const [along, lateral, turn] = at(first.map((value, k) => value * cos + second[k] * sin));
    const [a, b] = chordFactors(turn);
    points[2 * i] = a * along - b * lateral;
    points[2 * i + 1] = b * along + a * lateral;
  }
  return points;
}

/** @param {number} i */
function direction(i) {
  const angle = (2 * Math.PI * (i % SEGMENTS)) / SEGMENTS;
  return [Math.cos(angle), Math.sin(angle)];
}

/**
 * sin φ/φ and (1 − cos φ)/φ.
 *
 * @param {number} turn
 */
function chordFactors(turn) {
  if (turn === 0) return [1, 0];
  const half = Math.sin(turn / 2);
  return [Math.sin(turn) / turn, (2 * half * half) / turn];
}

/**
 * The position of exp(ξ) by ξ, two rows of three.
 *
 * @param {number[]} twist
 */
function positionJacobian([along, lateral, turn]) {
  const [a, b] = chordFactors(turn);
  const small = Math.abs(turn) < 1e-4;
  const da = small ? -turn / 3 : (Math.cos(turn) - a) / turn;
  const db = small ? 0.5 : (Math.sin(turn) - b) / turn;
  return [
    [a, -b, da * along - db * lateral],
    [b, a, db * along + da * lateral],
  ];
}

/**
 * Lower triangular; a coordinate without variance left has a column of zeros.
 *
 * @param {number[][]} cov
 */
function cholesky(cov) {
  const root = cov.map(() => [0, 0, 0]);
  for (let j = 0; j < 3; j++) {
    const left = cov.map((row, i) => row[j] - dot(root[i], root[j]));
    if (left[j] <= 1e-12 * cov[j][j]) continue;
    for (let i = j; i < 3; i++) root[i][j] = left[i] / Math.sqrt(left[j]);
  }
  return root;
}

/**
 * By repeated squaring.
 *
 * @param {number[][]} matrix symmetric
 */
function principalDirection(matrix) {
  let power = matrix;
  for (let step = 0; step < 10; step++) {
    const size = Math.max(...power.flat().map(Math.abs));
    const scaled = power.map((row) => row.map((value) => value / size));
    power = scaled.map((row) => scaled.map((column) => dot(row, column)));
  }
  // Symmetric: rows stand for columns. Of equally long ones the last, as in the core.
  return normalized(power.reduce((best, row) => (dot(row, row) >= dot(best, best) ? row : best)));
}

/** @param {number[]} a @param {number[]} b */
function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** @param {number[]} a @param {number[]} b */
function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** @param {number[]} a */
function normalized(a) {
  const length = Math.sqrt(dot(a, a));
  return a.map((value) => value / length);
}
