#!/usr/bin/env python3
"""Writes the reference tables beside this file, which the Rust tests read.

    pip install mpmath numpy && python3 generate.py

Nothing here shares a formula with src/: Jacobians come from the series of the adjoint action, moments from
quadrature at 40 digits, quantiles from the inverse error function. A column pair `name`, `name_lo` is one number, split into the
nearest double and what that double leaves over, so that a test can measure errors far below one unit in the last
place. The seed is fixed: running the script again gives the same files.
"""

import pathlib
import random
from itertools import product

import numpy as np
from mpmath import mp, mpf, matrix, cos, sin, sqrt, exp, log, erfinv, pi, quad

mp.dps = 40
HERE = pathlib.Path(__file__).parent
rng = random.Random(2005)


def columns(*values, rest_format="%.3e"):
    """High-precision numbers as two columns each, the nearest double and the rest."""
    return [cell for value in values for cell in (float(value), rest_format % float(value - mpf(float(value))))]


def write(name, header, rows):
    text = "\n".join([",".join(header)] + [",".join(map(str, row)) for row in rows]) + "\n"
    (HERE / name).write_text(text)
    print(f"{name}: {len(rows)} rows, {len(text)} bytes")


# ---------------------------------------------------------------------------------------------------- the group

def signed_log_uniform(low, high):
    exponent = rng.uniform(float(log(low, 10)), float(log(high, 10)))
    return rng.choice([-1.0, 1.0]) * 10.0**exponent


def twists():
    """Rotations log-uniform over 1e-12 .. π in equal strata, translations over seven decades, and the corners."""
    decades = float(log(pi, 10)) + 12.0
    count = 110
    for i in range(count):
        omega = rng.choice([-1.0, 1.0]) * 10.0 ** (-12.0 + decades * (i + rng.random()) / count)
        yield (signed_log_uniform(1e-4, 1e3), signed_log_uniform(1e-4, 1e3), omega)
    for omega in (0.0, 5e-324, -1e-300, 1e-160, 1.0, 3.141592653589793, -3.141592653589):
        yield (1.5, -0.75, omega)
    yield (0.0, 0.0, 0.0)
    yield (0.0, 0.0, 2.0)
    yield (1e3, 1e-3, -0.02)


def left_block(omega):
    """sin(ω)/ω and (1 − cos ω)/ω."""
    if omega == 0:
        return mpf(1), mpf(0)
    with mp.workdps(740 if abs(omega) < 1e-100 else 100):
        return sin(omega) / omega, (1 - cos(omega)) / omega


def small_adjoint(xi):
    """ad(ξ), for which ad(ξ) η is the Lie bracket [ξ, η]; twist order (v_x, v_y, ω)."""
    a, b, w = xi
    return matrix([[0, -w, b], [w, 0, -a], [0, 0, 0]])


def right_jacobian(xi):
    """Σ (−ad ξ)^k / (k+1)!, Solà et al. (arXiv:1812.01537) eq. 41 as a series."""
    ad = -small_adjoint(xi)
    term, total = mp.eye(3), mp.eye(3)
    for k in range(1, 90):
        term = term * ad / (k + 1)
        total += term
    return total


def group_tables():
    header = ["a", "b", "w"]
    for name in ("x", "y", "j00", "j01", "j02", "j12", "i00", "i01", "i02", "i12"):
        header += [name, name + "_lo"]
    rows, logs = [], []
    for floats in twists():
        a, b, w = map(mpf, floats)
        s, c = left_block(w)
        x, y = s * a - c * b, c * a + s * b
        jacobian = right_jacobian((a, b, w))
        inverse = jacobian**-1
        for m in (jacobian, inverse):
            assert abs(m[0, 0] - m[1, 1]) < 1e-30 and abs(m[0, 1] + m[1, 0]) < 1e-30
        entries = [m[e] for m in (jacobian, inverse) for e in ((0, 0), (0, 1), (0, 2), (1, 2))]
        rows.append([*floats, *columns(x, y, *entries)])

        # The logarithm of the *rounded* pose, whose exact value is another number than ξ.
        px, py = mpf(float(x)), mpf(float(y))
        det = s * s + c * c
        logs.append([float(px), float(py), floats[2], *columns((s * px + c * py) / det, (s * py - c * px) / det)])
    write("group.csv", header, rows)
    write("log.csv", ["x", "y", "w", "a", "a_lo", "b", "b_lo"], logs)


# ----------------------------------------------------------------------------------------------------- the noise

def quantile_table():
    points = [10.0**-k for k in (300, 20, 16, 12, 9, 6, 4, 3, 2)]
    points += [0.05 * k for k in range(1, 10)] + [0.425, 0.42499999, 0.4250001, 0.47575, 0.475]
    points += [0.5 - 10.0**-k for k in (2, 3, 4, 5, 6, 8, 10, 12, 14, 15)] + [0.5 - 2.0**-53, 0.5 - 2.0**-54]
    points += [rng.uniform(0.0, 0.5) for _ in range(40)] + [0.5 - 10.0 ** rng.uniform(-15, -1) for _ in range(20)]
    rows = []
    for q in sorted(points):
        with mp.workdps(360):
            # z with P(Z < z) = q + 1/2
            normal = sqrt(mpf(2)) * erfinv(2 * mpf(q))
            triangular = sqrt(mpf(6)) * (1 - sqrt(1 - 2 * mpf(q)))
        rows.append([q, *columns(normal, triangular)])
    write("quantile.csv", ["q", "normal", "normal_lo", "triangular", "triangular_lo"], rows)


# --------------------------------------------------------------------------------------------------- the moments

def expectation(kind, variance, f, singularity=mpf("inf")):
    """E f(Z) for a zero-mean Z of this kind and variance."""
    if variance == 0:
        return f(mpf(0))
    b = sqrt(variance)
    if kind == "normal":
        weight, ends = lambda z: exp(-z * z / 2) / sqrt(2 * pi), [-13, -9, -6, -3, -1, 0, 1, 3, 6, 9, 13]
    else:
        edge = sqrt(mpf(6))
        weight, ends = lambda z: (edge - abs(z)) / 6, [-edge, -edge / 2, 0, edge / 2, edge]
    if abs(singularity / b) < ends[-1]:
        ends = sorted(ends + [singularity / b])
    return quad(lambda z: weight(z) * f(b * z), ends)


def skewness(m1, m2, m3):
    """Skewness of a variable with these raw moments."""
    skew = (m3 - 3 * m1 * m2 + 2 * m1**3) / (m2 - m1 * m1) ** (mpf(3) / 2)
    return skew if abs(skew) > 1e-30 else mpf(0)      # quadrature noise around a true zero


def planar_moments(factor, variance, x_of, y_of, kind, angle_variance, heading, heading_variance):
    """Moments of (x, y) = r (X(φ), Y(φ)) and of the heading, with r = factor + noise and φ noisy, independently.

    The heading is `heading` + φ + further symmetric noise, of variance `heading_variance` in all, and is not wrapped.
    Third central moments of r vanish for both kinds of noise.
    """
    r1, r2, r3 = factor, factor**2 + variance, factor**3 + 3 * factor * variance
    mean = lambda f: expectation(kind, angle_variance, f)
    mx, my = r1 * mean(x_of), r1 * mean(y_of)
    sxx = r2 * mean(lambda t: x_of(t) ** 2) - mx * mx
    sxy = r2 * mean(lambda t: x_of(t) * y_of(t)) - mx * my
    syy = r2 * mean(lambda t: y_of(t) ** 2) - my * my
    sxt, syt = r1 * mean(lambda t: t * x_of(t)), r1 * mean(lambda t: t * y_of(t))
    cross = lambda t: y_of(t) * cos(heading) - x_of(t) * sin(heading)
    skew = skewness(r1 * mean(cross), r2 * mean(lambda t: cross(t) ** 2), r3 * mean(lambda t: cross(t) ** 3))
    moments = [mx, my, sxx, sxy, syy, sxt, syt, heading_variance, skew]
    return [value if abs(value) > 1e-30 else mpf(0) for value in moments]   # quadrature noise around a true zero


def velocity_moments(kind, alphas, v, omega, dt):
    v, omega, dt = mpf(v), mpf(omega), mpf(dt)
    a = [mpf(value) for value in alphas]
    sv, sw, sg = (a[i] * v * v + a[i + 1] * omega * omega for i in (0, 2, 4))
    # φ is the noise in the turned angle ω̂Δt; r is the driven distance.
    s = lambda t: left_block(omega * dt + t)[0]
    c = lambda t: left_block(omega * dt + t)[1]
    return planar_moments(v * dt, sv * dt * dt, s, c, kind, sw * dt * dt, omega * dt, (sw + sg) * dt * dt)


def odometry_moments(kind, alphas, rot1, trans, rot2):
    rot1, trans, rot2 = mpf(rot1), mpf(trans), mpf(rot2)
    a1, a2, a3, a4 = (mpf(value) for value in alphas)
    s1, st, s2 = a1 * rot1**2 + a2 * trans**2, a3 * trans**2 + a4 * (rot1**2 + rot2**2), a1 * rot2**2 + a2 * trans**2
    return planar_moments(trans, st, lambda t: cos(rot1 + t), lambda t: sin(rot1 + t), kind, s1, rot1 + rot2, s1 + s2)


CANONICAL = (0.02, 0.02, 0.02, 0.02, 0.0, 0.0)
OPENING = (0.05, 0.05, 0.05, 0.09, 0.01, 0.01)


def moments_table():
    velocity = [(k, CANONICAL, c) for k in ("normal", "triangular") for c in [(1.0, 0.5, 1.0), (1.0, -0.5, 1.0)]]
    velocity += [("normal", OPENING, c) for c in
                 [(1.0, 0.5, 1.0), (-1.0, 0.5, 1.0), (1.0, 0.0, 2.0), (1.0, 1.2, 1.4), (0.06, 1.5, 1.0), (1.0, 1e-7, 1.0)]]
    velocity += [("triangular", OPENING, (1.0, 0.5, 1.0)), ("triangular", OPENING, (-0.7, -1.1, 1.3)),
                 ("normal", (0.0, 0.0, 0.0, 0.2, 0.0, 0.01), (1.0, 0.8, 1.0)),
                 ("triangular", (0.5, 0.5, 0.5, 0.9, 0.1, 0.1), (1.0, 0.5, 1.5))]
    odometry = [(k, (0.05, 0.02, 0.01, 0.03), c) for k in ("normal", "triangular")
                for c in [(0.3, 1.0, 0.2), (-0.4, 0.8, 1.0), (0.0, 1.5, 0.0), (2.8, 0.5, -2.9)]]
    odometry += [("normal", (0.1, 0.2, 0.2, 0.1), (0.25, 1.0, 0.25)), ("normal", (0.0, 0.0, 0.0, 0.2), (0.5, 1.0, 0.5))]
    names = ["mx", "my", "sxx", "sxy", "syy", "sxt", "syt", "stt", "skew"]
    rows = [[k, *al, *c, *map(float, velocity_moments(k, al, *c))] for k, al, c in velocity]
    write("velocity_moments.csv", ["kind", "a1", "a2", "a3", "a4", "a5", "a6", "v", "omega", "dt"] + names, rows)
    rows = [[k, *al, *c, *map(float, odometry_moments(k, al, *c))] for k, al, c in odometry]
    write("odometry_moments.csv", ["kind", "a1", "a2", "a3", "a4", "rot1", "trans", "rot2"] + names, rows)


def pushed_skew(mean, cov):
    """Cross-track skew of exp(ξ), ξ ~ N(mean, cov): given ω the position is Gaussian, and ω is integrated out."""
    m, s = [mpf(v) for v in mean], [[mpf(v) for v in row] for row in cov]
    var_w = s[2][2]
    gain = [s[0][2] / var_w, s[1][2] / var_w] if var_w else [0, 0]
    rest = [[s[i][j] - gain[i] * s[j][2] for j in (0, 1)] for i in (0, 1)]

    def raw(order):
        def given(t):
            sn, cs = left_block(m[2] + t)
            # d = −x sin h + y cos h as a row acting on (ξ_x, ξ_y)
            p = [-sn * sin(m[2]) + cs * cos(m[2]), cs * sin(m[2]) + sn * cos(m[2])]
            mu = sum(p[i] * (m[i] + gain[i] * t) for i in (0, 1))
            var = sum(p[i] * p[j] * rest[i][j] for i in (0, 1) for j in (0, 1))
            return [mu, mu * mu + var, mu**3 + 3 * mu * var][order - 1]
        return expectation("normal", var_w, given)

    return skewness(raw(1), raw(2), raw(3))


def pushed_skew_table():
    diagonal = lambda a, b, c: ((a, 0.0, 0.0), (0.0, b, 0.0), (0.0, 0.0, c))
    cases = [((1.0, 0.0, 0.5), diagonal(0.025, 0.0, 0.025)), ((1.0, 0.0, 0.5), diagonal(0.0625, 0.0016, 0.085)),
             ((2.0, 0.0, 0.0), diagonal(0.05, 0.0, 0.05)), ((-1.0, 0.1, -1.2), diagonal(0.02, 0.01, 0.2)),
             ((1.0, 0.2, 0.9), ((0.09, 0.02, 0.03), (0.02, 0.05, -0.02), (0.03, -0.02, 0.12))),
             ((0.7, -0.3, -1.4), ((0.3, -0.1, 0.15), (-0.1, 0.2, 0.05), (0.15, 0.05, 0.5))),
             ((0.05, 0.0, 1.5), ((0.02, 0.001, -0.01), (0.001, 0.003, 0.002), (-0.01, 0.002, 0.15))),
             ((0.0, 0.0, 0.0), ((0.1, 0.0, 0.08), (0.0, 0.1, 0.0), (0.08, 0.0, 0.1))),
             ((1.0, 0.0, 0.0), diagonal(0.01, 0.02, 0.0))]
    rows = []
    for mean, cov in cases:
        flat = [cov[0][0], cov[0][1], cov[0][2], cov[1][1], cov[1][2], cov[2][2]]
        rows.append([*mean, *flat, float(pushed_skew(mean, cov))])
    write("pushed_skew.csv", ["a", "b", "w", "caa", "cab", "caw", "cbb", "cbw", "cww", "skew"], rows)


# ----------------------------------------------------------------------------------------------- likelihood gains

def sums(kind, end=6.6, step=0.2, parts=64):
    """Nodes and weights for E f(Z), Z of unit variance: trapezoidal for the normal noise, Simpson's rule for the triangle."""
    if kind == "normal":
        nodes = step * np.arange(-round(end / step), round(end / step) + 1)
        weights = np.exp(-0.5 * nodes**2)
    else:
        edge = np.sqrt(6.0)
        nodes = np.linspace(-edge, edge, 2 * parts + 1)
        weights = np.where(np.arange(2 * parts + 1) % 2, 4, 2) * (edge - abs(nodes))
    return nodes, weights / weights.sum()


def arc_end(s, turn):
    """The end of an arc as a complex number."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return s * np.where(abs(turn) > 1e-9, (np.exp(1j * turn) - 1) / (1j * turn), 1 + 0.5j * turn)


def polar(s, turn):
    end = arc_end(s, turn)
    return np.array([end.real, end.imag])


def exp_pose(x, y, turn):
    end = (x + 1j * y) * arc_end(1.0, turn)
    return np.array([end.real, end.imag, turn])


def jacobian(f, point, step=1e-5):
    """By central differences: the axes after those of the values are the components of f, and its arguments."""
    steps = step * np.eye(len(point)).reshape(len(point), len(point), *[1] * np.ndim(point[0]))
    return np.stack([(f(*(point + h)) - f(*(point - h))).T / (2 * step) for h in steps], axis=-1)


def outline_area(mean, cov, chords=128):
    """The area inside the widget's outline of N(mean, cov) in exponential coordinates: that of the great circle of the 2σ
    ellipsoid across the mean direction that leaves the place where it is. Loops count positively."""
    root, noisy = np.zeros((3, 3)), np.ix_(*[np.diag(cov) > 1e-20] * 2)
    root[noisy] = np.linalg.cholesky(cov[noisy])
    at = lambda u: mean + 2 * root @ u
    spread = 0.0
    for end in (*np.eye(3), *-np.eye(3)):
        idle = np.cross(*jacobian(lambda *u: exp_pose(*at(u))[:2], end)) / 4
        spread += np.outer(idle, idle)
    k = np.linalg.eigh(spread)[1][:, 2]
    aside = np.argmin(abs(k))
    first = np.eye(3)[aside] - k * k[aside]
    first /= np.linalg.norm(first)
    second = np.cross(first, k)
    rim = [at(np.cos(t) * first + np.sin(t) * second) for t in np.linspace(0, 2 * np.pi, chords + 1)]
    x, y, _ = exp_pose(*np.transpose(rim))
    areas = 0.5 * (x[:-1] * y[1:] - x[1:] * y[:-1])
    forward = np.array(rim[1:])[:, 0] >= 0
    return abs(areas[forward].sum()) + abs(areas[~forward].sum())


def likelihood_gains(kind, alphas, v, omega, dt):
    """Gain of pose and floor, and the ratio of areas, by their definitions: moments and mean logarithms by sums over all
    combinations of noises, Jacobians by differences, which leave about nine digits."""
    sv, sw, sg = (dt * np.sqrt(alphas[i] * v * v + alphas[i + 1] * omega * omega) for i in (0, 2, 4))
    # Three points have the first two moments of the length, and only those count.
    s, ws = v * dt + sv * np.sqrt(3) * np.array([-1, 0, 1]), np.array([1, 4, 1]) / 6
    moments = lambda weights, *values: (np.average(values, -1, weights), np.cov(values, aweights=weights, ddof=0))
    log_det = lambda matrices: np.log(abs(np.linalg.det(matrices)))

    # The arc to a place is the one of the nearest turn, which jumps half a circle off the command: finer steps.
    z, wz = sums(kind, 6.0, 0.001, 1000)
    turn, near = omega * dt + sw * z, omega * dt + np.remainder(sw * z + np.pi, 2 * np.pi) - np.pi
    stretch = np.divide(near, turn, out=np.ones_like(turn), where=abs(turn - near) > 1e-9)
    log_arc = wz @ log_det(jacobian(polar, np.array([stretch, near])))
    _, arc_cov = moments(np.outer(wz, ws).ravel(), np.outer(stretch, s).ravel(), np.repeat(near, 3))

    z, wz = sums(kind)
    turn = omega * dt + sw * z
    _, place_cov = moments(np.outer(wz, ws).ravel(), *polar(s, turn[:, None]).reshape(2, -1))

    g, wg = sums(kind) if sg else (np.zeros(1), np.ones(1))
    inside = (abs(np.add.outer(sw * z, sg * g)) <= 6 * np.hypot(sw, sg)) | (kind != "normal")
    theta, weight = np.add.outer(turn, sg * g)[inside], np.outer(wz, wg)[inside]
    end = arc_end(s, np.broadcast_to(turn[:, None], inside.shape)[inside][:, None]).ravel()
    xi, thetas, weights = end / np.repeat(arc_end(1.0, theta), 3), np.repeat(theta, 3), np.outer(weight, ws).ravel()
    _, flat_cov = moments(weights, end.real, end.imag, thetas)
    mean, bent_cov = moments(weights, xi.real, xi.imag, thetas)
    log_chart = np.average(log_det(jacobian(exp_pose, np.array([0.3 + 0 * theta, 0.2 + 0 * theta, theta]))), weights=weight)

    pose = (log_det(flat_cov) - log_det(bent_cov)) / 2 - log_chart if sg else np.inf
    # E ln|length|
    with mp.workdps(20):
        log_length = float(expectation(kind, mpf(sv) ** 2, lambda z: log(abs(v * dt + z)), -mpf(v * dt)))
    floor = (log_det(place_cov) - log_det(arc_cov)) / 2 - log_length - log_arc
    polygon = 64 * np.sin(2 * np.pi / 128)
    ellipse = polygon * 4 * np.sqrt(np.linalg.det(place_cov))
    return pose, floor, ellipse / outline_area(mean, bent_cov)


def gain_table():
    straight = (0.002, 0.002, 0.1, 0.1, 0.002, 0.002)
    # Lengths that are known to a fortieth: far from 0, their mean logarithm is that of a series.
    sure = (0.0005, 0.0005, 0.05, 0.09, 0.01, 0.01)
    commands = [(1.0, 0.5, 1.0), (1.0, 1.2, 1.4), (1.0, 0.0, 2.0), (0.06, 1.5, 1.0), (-0.7, -1.1, 1.3)]
    groups = [(OPENING, commands), (straight, commands[2:3]), (CANONICAL, commands[:1]), (sure, commands[:1])]
    cases = [(k, al, c) for al, group in groups for k in ("normal", "triangular") for c in group]
    rows = [[k, *al, *c, *("%.9g" % x for x in likelihood_gains(k, al, *c))] for k, al, c in cases]
    write("likelihood_gain.csv",
          ["kind", "a1", "a2", "a3", "a4", "a5", "a6", "v", "omega", "dt", "pose", "floor", "area_ratio"], rows)


# --------------------------------------------------------------------------------------------------- compounding

def fourth_order_terms(p, q):
    """Fourth-order part of Cov[log(exp(ξ) exp(η))], ξ ~ N(0, P), η ~ N(0, Q) independent.

    From log(exp ξ exp η) = ξ + η + [ξ,η]/2 + ([ξ,[ξ,η]] + [η,[η,ξ]])/12 + …, keeping the expectations that hold two
    ξ and two η. Each expectation is spelled out over the basis instead of in matrix identities.
    """
    basis = [matrix(e) for e in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    ad = [small_adjoint(e) for e in basis]
    out = mp.zeros(3)
    for i, j, k, l in product(range(3), repeat=4):
        weight = p[i, j] * q[k, l]
        if weight == 0:
            continue
        out += weight / 4 * (ad[i] * basis[k]) * (ad[j] * basis[l]).T
        # [ξ,[ξ,η]] ηᵀ and [η,[η,ξ]] ξᵀ with their transposes
        t = ad[i] * (ad[j] * basis[k]) * basis[l].T + ad[k] * (ad[l] * basis[i]) * basis[j].T
        out += weight / 12 * (t + t.T)
    return out


def compounding_table():
    dt, steps = mpf("0.2"), 20
    tau = (dt, mpf(0), dt / 2)
    sv = sw = mpf("0.02") + mpf("0.02") / 4
    sg = mpf("0.005") + mpf("0.005") / 4
    arc, after = mp.diag([dt**2 * sv, 0, dt**2 * sw]), mp.diag([0, 0, dt**2 * sg])
    ad = -small_adjoint(tau)
    transport = mp.expm(ad)      # Ad of exp(−τ)
    jacobian = right_jacobian(tau)
    turned = jacobian * arc * jacobian.T + after
    rows = []
    for name, noise, fourth in (("chapter", arc + after, False), ("first_order", turned, False),
                                ("fourth_order", turned, True), ("fourth_order_unturned", arc + after, True)):
        sigma = mp.zeros(3)
        for _ in range(steps):
            moved = transport * sigma * transport.T
            sigma = moved + noise + (fourth_order_terms(moved, noise) if fourth else mp.zeros(3))
        rows.append([name] + [float(sigma[i, j]) for i, j in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))])
    write("compounding.csv", ["order", "caa", "cab", "caw", "cbb", "cbw", "cww"], rows)


# ------------------------------------------------------------------------------------------------ twice the digits

def double_double_table():
    """Sine, cosine and sinc of doubles, each as two doubles: the nearest, and that of what it leaves."""
    ours = random.Random(1971)
    angles = [0.1, 0.5, 1.0, 1.5707963267948966, 3.141592653589793, 6.283185307179586, 6.0, 2.0**-30, 1e-300]
    angles += [10.0 ** ours.uniform(-14, 0.79) for _ in range(60)]
    rows = []
    with mp.workdps(60):
        for angle in [ours.choice([-1.0, 1.0]) * angle for angle in angles]:
            exact = mpf(angle)
            rows.append([angle, *columns(sin(exact), cos(exact), sin(exact) / exact, rest_format="%r")])
    write("double_double.csv", ["angle", "sin", "sin_lo", "cos", "cos_lo", "sinc", "sinc_lo"], rows)


if __name__ == "__main__":
    group_tables()
    quantile_table()
    moments_table()
    pushed_skew_table()
    compounding_table()
    gain_table()
    double_double_table()
