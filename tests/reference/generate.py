#!/usr/bin/env python3
"""Writes the reference tables beside this file, which the Rust tests read.

    pip install mpmath numpy && python3 generate.py

This script shares no formula with src/: Jacobians come from the series of the adjoint action, moments from
quadrature at 40 digits, quantiles from the inverse error function. The columns `name` and `name_lo` are one number: the
nearest double and the remainder. Tests can thus measure errors far below one unit in the last place. The seed is fixed,
so that the script always writes the same files.
"""

import pathlib
import random
from itertools import product

import numpy as np
from mpmath import mp, mpf, matrix, cos, sin, sqrt, exp, log, erfinv, pi, quad

mp.dps = 40
SCRIPT_DIRECTORY = pathlib.Path(__file__).parent
table_rng = random.Random(2005)


def split_into_columns(*values, rest_format="%.3e"):
    """Splits each high-precision number into two columns: the nearest double and the remainder."""
    return [cell for value in values for cell in (float(value), rest_format % float(value - mpf(float(value))))]


def write_table(name, header, rows):
    text = "\n".join([",".join(header)] + [",".join(map(str, row)) for row in rows]) + "\n"
    (SCRIPT_DIRECTORY / name).write_text(text)
    print(f"{name}: {len(rows)} rows, {len(text)} bytes")


def draw_signed_log_uniform(low, high):
    exponent = table_rng.uniform(float(log(low, 10)), float(log(high, 10)))
    return table_rng.choice([-1.0, 1.0]) * 10.0**exponent


def generate_twists():
    """Twists: rotations log-uniform over 1e-12 .. π in equal strata, translations over seven decades, and extreme cases."""
    decade_count = float(log(pi, 10)) + 12.0
    count = 110
    for i in range(count):
        omega = table_rng.choice([-1.0, 1.0]) * 10.0 ** (-12.0 + decade_count * (i + table_rng.random()) / count)
        yield (draw_signed_log_uniform(1e-4, 1e3), draw_signed_log_uniform(1e-4, 1e3), omega)
    for omega in (0.0, 5e-324, -1e-300, 1e-160, 1.0, 3.141592653589793, -3.141592653589):
        yield (1.5, -0.75, omega)
    yield (0.0, 0.0, 0.0)
    yield (0.0, 0.0, 2.0)
    yield (1e3, 1e-3, -0.02)


def sinc_and_versine_ratio(omega):
    """Returns sin(ω)/ω and (1 − cos ω)/ω."""
    if omega == 0:
        return mpf(1), mpf(0)
    with mp.workdps(740 if abs(omega) < 1e-100 else 100):
        return sin(omega) / omega, (1 - cos(omega)) / omega


def lie_bracket_matrix(xi):
    """Matrix ad(ξ), for which ad(ξ) η is the Lie bracket [ξ, η]. A twist is (v_x, v_y, ω)."""
    a, b, w = xi
    return matrix([[0, -w, b], [w, 0, -a], [0, 0, 0]])


def right_jacobian(xi):
    """Right Jacobian Σ (−ad ξ)^k / (k+1)! of SE(2), eq. 41 of Solà et al. (arXiv:1812.01537) as a series."""
    ad = -lie_bracket_matrix(xi)
    term, total = mp.eye(3), mp.eye(3)
    for k in range(1, 90):
        term = term * ad / (k + 1)
        total += term
    return total


def write_group_tables():
    header = ["a", "b", "w"]
    for name in ("x", "y", "j00", "j01", "j02", "j12", "i00", "i01", "i02", "i12"):
        header += [name, name + "_lo"]
    rows, log_rows = [], []
    for twist_floats in generate_twists():
        a, b, w = map(mpf, twist_floats)
        s, c = sinc_and_versine_ratio(w)
        x, y = s * a - c * b, c * a + s * b
        jacobian = right_jacobian((a, b, w))
        inverse_jacobian = jacobian**-1
        for m in (jacobian, inverse_jacobian):
            assert abs(m[0, 0] - m[1, 1]) < 1e-30 and abs(m[0, 1] + m[1, 0]) < 1e-30
        jacobian_entries = [m[e] for m in (jacobian, inverse_jacobian) for e in ((0, 0), (0, 1), (0, 2), (1, 2))]
        rows.append([*twist_floats, *split_into_columns(x, y, *jacobian_entries)])

        # The logarithm of the rounded pose differs from the twist ξ of the exact pose.
        px, py = mpf(float(x)), mpf(float(y))
        det = s * s + c * c
        log_rows.append([float(px), float(py), twist_floats[2], *split_into_columns((s * px + c * py) / det, (s * py - c * px) / det)])
    write_table("group.csv", header, rows)
    write_table("log.csv", ["x", "y", "w", "a", "a_lo", "b", "b_lo"], log_rows)


def write_quantile_table():
    probabilities = [10.0**-k for k in (300, 20, 16, 12, 9, 6, 4, 3, 2)]
    probabilities += [0.05 * k for k in range(1, 10)] + [0.425, 0.42499999, 0.4250001, 0.47575, 0.475]
    probabilities += [0.5 - 10.0**-k for k in (2, 3, 4, 5, 6, 8, 10, 12, 14, 15)] + [0.5 - 2.0**-53, 0.5 - 2.0**-54]
    probabilities += [table_rng.uniform(0.0, 0.5) for _ in range(40)] + [0.5 - 10.0 ** table_rng.uniform(-15, -1) for _ in range(20)]
    rows = []
    for q in sorted(probabilities):
        with mp.workdps(360):
            # z with P(Z < z) = q + 1/2
            normal = sqrt(mpf(2)) * erfinv(2 * mpf(q))
            triangular = sqrt(mpf(6)) * (1 - sqrt(1 - 2 * mpf(q)))
        rows.append([q, *split_into_columns(normal, triangular)])
    write_table("quantile.csv", ["q", "normal", "normal_lo", "triangular", "triangular_lo"], rows)


def expectation(kind, variance, f, singularity=mpf("inf")):
    """E f(Z) for zero-mean noise Z with a distribution (`kind`) and a variance."""
    if variance == 0:
        return f(mpf(0))
    b = sqrt(variance)
    if kind == "normal":
        noise_density, interval_ends = lambda z: exp(-z * z / 2) / sqrt(2 * pi), [-13, -9, -6, -3, -1, 0, 1, 3, 6, 9, 13]
    else:
        support_end = sqrt(mpf(6))
        noise_density, interval_ends = lambda z: (support_end - abs(z)) / 6, [-support_end, -support_end / 2, 0, support_end / 2, support_end]
    if abs(singularity / b) < interval_ends[-1]:
        interval_ends = sorted(interval_ends + [singularity / b])
    return quad(lambda z: noise_density(z) * f(b * z), interval_ends)


def skewness(m1, m2, m3):
    """Skewness of a variable with these raw moments."""
    skew = (m3 - 3 * m1 * m2 + 2 * m1**3) / (m2 - m1 * m1) ** (mpf(3) / 2)
    return skew if abs(skew) > 1e-30 else mpf(0)      # quadrature noise around a true zero


def motion_moments(mean_length, variance, x_of, y_of, kind, angle_variance, heading, heading_variance):
    """Moments of (x, y) = r (X(φ), Y(φ)) and of the heading. The length r = `mean_length` + noise and the angle φ are independent.

    The heading is `heading` + φ + further symmetric noise, and is not wrapped. Its total variance is `heading_variance`.
    Third central moments of r vanish for both kinds of noise.
    """
    r1, r2, r3 = mean_length, mean_length**2 + variance, mean_length**3 + 3 * mean_length * variance
    expected_value = lambda f: expectation(kind, angle_variance, f)
    mx, my = r1 * expected_value(x_of), r1 * expected_value(y_of)
    sxx = r2 * expected_value(lambda t: x_of(t) ** 2) - mx * mx
    sxy = r2 * expected_value(lambda t: x_of(t) * y_of(t)) - mx * my
    syy = r2 * expected_value(lambda t: y_of(t) ** 2) - my * my
    sxt, syt = r1 * expected_value(lambda t: t * x_of(t)), r1 * expected_value(lambda t: t * y_of(t))
    cross_track = lambda t: y_of(t) * cos(heading) - x_of(t) * sin(heading)
    skew = skewness(r1 * expected_value(cross_track), r2 * expected_value(lambda t: cross_track(t) ** 2), r3 * expected_value(lambda t: cross_track(t) ** 3))
    moments = [mx, my, sxx, sxy, syy, sxt, syt, heading_variance, skew]
    return [value if abs(value) > 1e-30 else mpf(0) for value in moments]   # quadrature noise around a true zero


def velocity_moments(kind, alphas, v, omega, dt):
    v, omega, dt = mpf(v), mpf(omega), mpf(dt)
    a = [mpf(value) for value in alphas]
    sv, sw, sg = (a[i] * v * v + a[i + 1] * omega * omega for i in (0, 2, 4))
    # φ is the noise in the turned angle ω̂Δt; r is the driven distance.
    s = lambda t: sinc_and_versine_ratio(omega * dt + t)[0]
    c = lambda t: sinc_and_versine_ratio(omega * dt + t)[1]
    return motion_moments(v * dt, sv * dt * dt, s, c, kind, sw * dt * dt, omega * dt, (sw + sg) * dt * dt)


def odometry_moments(kind, alphas, rot1, trans, rot2):
    rot1, trans, rot2 = mpf(rot1), mpf(trans), mpf(rot2)
    a1, a2, a3, a4 = (mpf(value) for value in alphas)
    s1, st, s2 = a1 * rot1**2 + a2 * trans**2, a3 * trans**2 + a4 * (rot1**2 + rot2**2), a1 * rot2**2 + a2 * trans**2
    return motion_moments(trans, st, lambda t: cos(rot1 + t), lambda t: sin(rot1 + t), kind, s1, rot1 + rot2, s1 + s2)


CANONICAL_ALPHAS = (0.02, 0.02, 0.02, 0.02, 0.0, 0.0)
OPENING_ALPHAS = (0.05, 0.05, 0.05, 0.09, 0.01, 0.01)


def write_moments_table():
    velocity_cases = [(k, CANONICAL_ALPHAS, c) for k in ("normal", "triangular") for c in [(1.0, 0.5, 1.0), (1.0, -0.5, 1.0)]]
    velocity_cases += [("normal", OPENING_ALPHAS, c) for c in
                 [(1.0, 0.5, 1.0), (-1.0, 0.5, 1.0), (1.0, 0.0, 2.0), (1.0, 1.2, 1.4), (0.06, 1.5, 1.0), (1.0, 1e-7, 1.0)]]
    velocity_cases += [("triangular", OPENING_ALPHAS, (1.0, 0.5, 1.0)), ("triangular", OPENING_ALPHAS, (-0.7, -1.1, 1.3)),
                 ("normal", (0.0, 0.0, 0.0, 0.2, 0.0, 0.01), (1.0, 0.8, 1.0)),
                 ("triangular", (0.5, 0.5, 0.5, 0.9, 0.1, 0.1), (1.0, 0.5, 1.5))]
    odometry_cases = [(k, (0.05, 0.02, 0.01, 0.03), c) for k in ("normal", "triangular")
                for c in [(0.3, 1.0, 0.2), (-0.4, 0.8, 1.0), (0.0, 1.5, 0.0), (2.8, 0.5, -2.9)]]
    odometry_cases += [("normal", (0.1, 0.2, 0.2, 0.1), (0.25, 1.0, 0.25)), ("normal", (0.0, 0.0, 0.0, 0.2), (0.5, 1.0, 0.5))]
    moment_names = ["mx", "my", "sxx", "sxy", "syy", "sxt", "syt", "stt", "skew"]
    rows = [[k, *al, *c, *map(float, velocity_moments(k, al, *c))] for k, al, c in velocity_cases]
    write_table("velocity_moments.csv", ["kind", "a1", "a2", "a3", "a4", "a5", "a6", "v", "omega", "dt"] + moment_names, rows)
    rows = [[k, *al, *c, *map(float, odometry_moments(k, al, *c))] for k, al, c in odometry_cases]
    write_table("odometry_moments.csv", ["kind", "a1", "a2", "a3", "a4", "rot1", "trans", "rot2"] + moment_names, rows)


def exponential_skew(mean, cov):
    """Cross-track skew of exp(ξ), ξ ~ N(mean, cov). Given ω the position is Gaussian; quadrature integrates over ω."""
    m, s = [mpf(v) for v in mean], [[mpf(v) for v in row] for row in cov]
    omega_variance = s[2][2]
    regression_gain = [s[0][2] / omega_variance, s[1][2] / omega_variance] if omega_variance else [0, 0]
    residual_cov = [[s[i][j] - regression_gain[i] * s[j][2] for j in (0, 1)] for i in (0, 1)]

    def raw_moment(order):
        def conditional_moment(t):
            sn, cs = sinc_and_versine_ratio(m[2] + t)
            # Row vector p for which the cross-track position −x sin h + y cos h is p · (ξ_x, ξ_y).
            p = [-sn * sin(m[2]) + cs * cos(m[2]), cs * sin(m[2]) + sn * cos(m[2])]
            mu = sum(p[i] * (m[i] + regression_gain[i] * t) for i in (0, 1))
            var = sum(p[i] * p[j] * residual_cov[i][j] for i in (0, 1) for j in (0, 1))
            return [mu, mu * mu + var, mu**3 + 3 * mu * var][order - 1]
        return expectation("normal", omega_variance, conditional_moment)

    return skewness(raw_moment(1), raw_moment(2), raw_moment(3))


def write_exponential_skew_table():
    diagonal_cov = lambda a, b, c: ((a, 0.0, 0.0), (0.0, b, 0.0), (0.0, 0.0, c))
    skew_cases = [((1.0, 0.0, 0.5), diagonal_cov(0.025, 0.0, 0.025)), ((1.0, 0.0, 0.5), diagonal_cov(0.0625, 0.0016, 0.085)),
             ((2.0, 0.0, 0.0), diagonal_cov(0.05, 0.0, 0.05)), ((-1.0, 0.1, -1.2), diagonal_cov(0.02, 0.01, 0.2)),
             ((1.0, 0.2, 0.9), ((0.09, 0.02, 0.03), (0.02, 0.05, -0.02), (0.03, -0.02, 0.12))),
             ((0.7, -0.3, -1.4), ((0.3, -0.1, 0.15), (-0.1, 0.2, 0.05), (0.15, 0.05, 0.5))),
             ((0.05, 0.0, 1.5), ((0.02, 0.001, -0.01), (0.001, 0.003, 0.002), (-0.01, 0.002, 0.15))),
             ((0.0, 0.0, 0.0), ((0.1, 0.0, 0.08), (0.0, 0.1, 0.0), (0.08, 0.0, 0.1))),
             ((1.0, 0.0, 0.0), diagonal_cov(0.01, 0.02, 0.0))]
    rows = []
    for mean, cov in skew_cases:
        cov_entries = [cov[0][0], cov[0][1], cov[0][2], cov[1][1], cov[1][2], cov[2][2]]
        rows.append([*mean, *cov_entries, float(exponential_skew(mean, cov))])
    write_table("pushed_skew.csv", ["a", "b", "w", "caa", "cab", "caw", "cbb", "cbw", "cww", "skew"], rows)


def quadrature_rule(kind, end=6.6, step=0.2, parts=64):
    """Nodes and weights for E f(Z), Z of unit variance: trapezoidal rule for normal noise, Simpson's rule for triangular noise."""
    if kind == "normal":
        nodes = step * np.arange(-round(end / step), round(end / step) + 1)
        weights = np.exp(-0.5 * nodes**2)
    else:
        support_end = np.sqrt(6.0)
        nodes = np.linspace(-support_end, support_end, 2 * parts + 1)
        weights = np.where(np.arange(2 * parts + 1) % 2, 4, 2) * (support_end - abs(nodes))
    return nodes, weights / weights.sum()


def arc_end(s, turn):
    """End of an arc with length s and a turn, as a complex number."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return s * np.where(abs(turn) > 1e-9, (np.exp(1j * turn) - 1) / (1j * turn), 1 + 0.5j * turn)


def arc_end_coordinates(s, turn):
    end = arc_end(s, turn)
    return np.array([end.real, end.imag])


def exp_pose(x, y, turn):
    end = (x + 1j * y) * arc_end(1.0, turn)
    return np.array([end.real, end.imag, turn])


def jacobian(f, point, step=1e-5):
    """Jacobian of f by central differences. The last two axes are the components of f and the arguments of f."""
    argument_steps = step * np.eye(len(point)).reshape(len(point), len(point), *[1] * np.ndim(point[0]))
    return np.stack([(f(*(point + h)) - f(*(point - h))).T / (2 * step) for h in argument_steps], axis=-1)


def exponential_outline_area(mean, cov, chords=128):
    """Area inside the outline that the widget draws of N(mean, cov) in exponential coordinates. The outline is the image of a
    great circle of the 2σ ellipsoid. The circle is perpendicular to the mean direction in which the position does not change.
    Loops of the outline count positively."""
    cov_root, noisy_axes = np.zeros((3, 3)), np.ix_(*[np.diag(cov) > 1e-20] * 2)
    cov_root[noisy_axes] = np.linalg.cholesky(cov[noisy_axes])
    twist_at = lambda u: mean + 2 * cov_root @ u
    null_direction_scatter = 0.0
    for end in (*np.eye(3), *-np.eye(3)):
        null_direction = np.cross(*jacobian(lambda *u: exp_pose(*twist_at(u))[:2], end)) / 4
        null_direction_scatter += np.outer(null_direction, null_direction)
    k = np.linalg.eigh(null_direction_scatter)[1][:, 2]
    least_parallel_axis = np.argmin(abs(k))
    circle_x = np.eye(3)[least_parallel_axis] - k * k[least_parallel_axis]
    circle_x /= np.linalg.norm(circle_x)
    circle_y = np.cross(circle_x, k)
    outline_twists = [twist_at(np.cos(t) * circle_x + np.sin(t) * circle_y) for t in np.linspace(0, 2 * np.pi, chords + 1)]
    x, y, _ = exp_pose(*np.transpose(outline_twists))
    triangle_areas = 0.5 * (x[:-1] * y[1:] - x[1:] * y[:-1])
    is_forward = np.array(outline_twists[1:])[:, 0] >= 0
    return abs(triangle_areas[is_forward].sum()) + abs(triangle_areas[~is_forward].sum())


def likelihood_gains(kind, alphas, v, omega, dt):
    """Likelihood gains of pose and position, and the ratio of the outlines' areas, by their definitions. Moments and mean logarithms are
    sums over all combinations of noises. Jacobians are differences with about nine correct digits."""
    sv, sw, sg = (dt * np.sqrt(alphas[i] * v * v + alphas[i + 1] * omega * omega) for i in (0, 2, 4))
    # Three points with weights suffice for the length, because only its first two moments matter.
    s, ws = v * dt + sv * np.sqrt(3) * np.array([-1, 0, 1]), np.array([1, 4, 1]) / 6
    weighted_moments = lambda weights, *values: (np.average(values, -1, weights), np.cov(values, aweights=weights, ddof=0))
    log_det = lambda matrices: np.log(abs(np.linalg.det(matrices)))

    # Each position is described by the arc whose turn is within ±π of the commanded turn. If the noise of the turn exceeds ±π, the arc's
    # turn jumps by 2π, so that the quadrature needs finer steps.
    z, wz = quadrature_rule(kind, 6.0, 0.001, 1000)
    turn, nearest_turn = omega * dt + sw * z, omega * dt + np.remainder(sw * z + np.pi, 2 * np.pi) - np.pi
    arc_length_ratio = np.divide(nearest_turn, turn, out=np.ones_like(turn), where=abs(turn - nearest_turn) > 1e-9)
    mean_log_arc_jacobian = wz @ log_det(jacobian(arc_end_coordinates, np.array([arc_length_ratio, nearest_turn])))
    _, arc_cov = weighted_moments(np.outer(wz, ws).ravel(), np.outer(arc_length_ratio, s).ravel(), np.repeat(nearest_turn, 3))

    z, wz = quadrature_rule(kind)
    turn = omega * dt + sw * z
    _, position_cov = weighted_moments(np.outer(wz, ws).ravel(), *arc_end_coordinates(s, turn[:, None]).reshape(2, -1))

    g, wg = quadrature_rule(kind) if sg else (np.zeros(1), np.ones(1))
    is_in_range = (abs(np.add.outer(sw * z, sg * g)) <= 6 * np.hypot(sw, sg)) | (kind != "normal")
    theta, weight = np.add.outer(turn, sg * g)[is_in_range], np.outer(wz, wg)[is_in_range]
    end = arc_end(s, np.broadcast_to(turn[:, None], is_in_range.shape)[is_in_range][:, None]).ravel()
    xi, thetas, weights = end / np.repeat(arc_end(1.0, theta), 3), np.repeat(theta, 3), np.outer(weight, ws).ravel()
    _, cartesian_cov = weighted_moments(weights, end.real, end.imag, thetas)
    mean, twist_cov = weighted_moments(weights, xi.real, xi.imag, thetas)
    mean_log_jacobian = np.average(log_det(jacobian(exp_pose, np.array([0.3 + 0 * theta, 0.2 + 0 * theta, theta]))), weights=weight)

    pose_gain = (log_det(cartesian_cov) - log_det(twist_cov)) / 2 - mean_log_jacobian if sg else np.inf
    # Mean logarithm of the length.
    with mp.workdps(20):
        mean_log_length = float(expectation(kind, mpf(sv) ** 2, lambda z: log(abs(v * dt + z)), -mpf(v * dt)))
    floor_gain = (log_det(position_cov) - log_det(arc_cov)) / 2 - mean_log_length - mean_log_arc_jacobian
    unit_polygon_area = 64 * np.sin(2 * np.pi / 128)
    ellipse_area = unit_polygon_area * 4 * np.sqrt(np.linalg.det(position_cov))
    return pose_gain, floor_gain, ellipse_area / exponential_outline_area(mean, twist_cov)


def write_gain_table():
    straight_alphas = (0.002, 0.002, 0.1, 0.1, 0.002, 0.002)
    # With these α's the length has a standard deviation of 1/40. Far from 0, the code computes its mean logarithm by a series.
    precise_length_alphas = (0.0005, 0.0005, 0.05, 0.09, 0.01, 0.01)
    commands = [(1.0, 0.5, 1.0), (1.0, 1.2, 1.4), (1.0, 0.0, 2.0), (0.06, 1.5, 1.0), (-0.7, -1.1, 1.3)]
    alphas_and_commands = [(OPENING_ALPHAS, commands), (straight_alphas, commands[2:3]), (CANONICAL_ALPHAS, commands[:1]), (precise_length_alphas, commands[:1])]
    gain_cases = [(k, al, c) for al, group in alphas_and_commands for k in ("normal", "triangular") for c in group]
    rows = [[k, *al, *c, *("%.9g" % x for x in likelihood_gains(k, al, *c))] for k, al, c in gain_cases]
    write_table("likelihood_gain.csv",
          ["kind", "a1", "a2", "a3", "a4", "a5", "a6", "v", "omega", "dt", "pose", "floor", "area_ratio"], rows)


def fourth_order_terms(p, q):
    """Fourth-order terms of Cov[log(exp(ξ) exp(η))] for independent ξ ~ N(0, P) and η ~ N(0, Q).

    The terms follow from log(exp ξ exp η) = ξ + η + [ξ,η]/2 + ([ξ,[ξ,η]] + [η,[η,ξ]])/12 + … They are the expectations with two
    factors ξ and two factors η. Each expectation is a sum over the basis, without matrix identities.
    """
    basis_twists = [matrix(e) for e in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    ad = [lie_bracket_matrix(e) for e in basis_twists]
    fourth_order_cov = mp.zeros(3)
    for i, j, k, l in product(range(3), repeat=4):
        weight = p[i, j] * q[k, l]
        if weight == 0:
            continue
        fourth_order_cov += weight / 4 * (ad[i] * basis_twists[k]) * (ad[j] * basis_twists[l]).T
        # Terms of [ξ,[ξ,η]] ηᵀ and of [η,[η,ξ]] ξᵀ. Their transposes are added below.
        t = ad[i] * (ad[j] * basis_twists[k]) * basis_twists[l].T + ad[k] * (ad[l] * basis_twists[i]) * basis_twists[j].T
        fourth_order_cov += weight / 12 * (t + t.T)
    return fourth_order_cov


def write_compounding_table():
    dt, steps = mpf("0.2"), 20
    tau = (dt, mpf(0), dt / 2)
    sv = sw = mpf("0.02") + mpf("0.02") / 4
    sg = mpf("0.005") + mpf("0.005") / 4
    arc_cov, last_turn_cov = mp.diag([dt**2 * sv, 0, dt**2 * sw]), mp.diag([0, 0, dt**2 * sg])
    ad = -lie_bracket_matrix(tau)
    inverse_adjoint = mp.expm(ad)      # Ad of exp(−τ)
    jacobian = right_jacobian(tau)
    transformed_noise = jacobian * arc_cov * jacobian.T + last_turn_cov
    rows = []
    for name, noise, has_fourth_order in (("chapter", arc_cov + last_turn_cov, False), ("first_order", transformed_noise, False),
                                ("fourth_order", transformed_noise, True), ("fourth_order_unturned", arc_cov + last_turn_cov, True)):
        sigma = mp.zeros(3)
        for _ in range(steps):
            transported_cov = inverse_adjoint * sigma * inverse_adjoint.T
            sigma = transported_cov + noise + (fourth_order_terms(transported_cov, noise) if has_fourth_order else mp.zeros(3))
        rows.append([name] + [float(sigma[i, j]) for i, j in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))])
    write_table("compounding.csv", ["order", "caa", "cab", "caw", "cbb", "cbw", "cww"], rows)


def write_double_double_table():
    """Sine, cosine and sinc of doubles. Each result is two doubles: the nearest double and the remainder."""
    angle_rng = random.Random(1971)
    angles = [0.1, 0.5, 1.0, 1.5707963267948966, 3.141592653589793, 6.283185307179586, 6.0, 2.0**-30, 1e-300]
    angles += [10.0 ** angle_rng.uniform(-14, 0.79) for _ in range(60)]
    rows = []
    with mp.workdps(60):
        for angle in [angle_rng.choice([-1.0, 1.0]) * angle for angle in angles]:
            exact = mpf(angle)
            rows.append([angle, *split_into_columns(sin(exact), cos(exact), sin(exact) / exact, rest_format="%r")])
    write_table("double_double.csv", ["angle", "sin", "sin_lo", "cos", "cos_lo", "sinc", "sinc_lo"], rows)


if __name__ == "__main__":
    write_group_tables()
    write_quantile_table()
    write_moments_table()
    write_exponential_skew_table()
    write_compounding_table()
    write_gain_table()
    write_double_double_table()
