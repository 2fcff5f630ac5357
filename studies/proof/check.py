#!/usr/bin/env python3
"""Checks a proof without hbvm: python3 check.py FILE.proof

It needs Python 3.11 and mpmath. It knows scenes of point bodies, rods and uniform gravity, whose forces are
polynomials, so that the defect of a polynomial is found exactly. Of the file it takes the polynomials, the tubes and
the pieces. It finds the distances from the exact motion by itself, with interval arithmetic, and believes none of the
file's. The method is on the page beside this file.
"""
import re
import sys
import tomllib
from itertools import product

from mpmath import iv, mp

MORE = 4  # parts into which each piece is divided, as there are no derivatives in time here


def exact(text):
    """Mantissa and exponent: 1a3p-2c is 0x1a3 times 2^-0x2c."""
    m, e = text.split("p")
    return int(m, 16), int(e, 16)


def upper(x):
    """The upper end, as a number."""
    return mp.make_mpf(x._mpi_[1])


def middle(x):
    return mp.make_mpf(x.mid._mpi_[0])


def interval(pair):
    return iv.mpf(pair[0]) * iv.mpf(2) ** pair[1]


def number(value, constants):
    """A number of a scene, as 0.8, "2/3" or "sqrt(z0)"."""
    text = str(value)
    if not re.fullmatch(r"[0-9a-zA-Z_+*/(). -]+", text) or "__" in text:
        sys.exit(f"'{text}' is not understood here")
    numbers = re.sub(r"(?<![\w.])(\d+\.?\d*|\.\d+)(e-?\d+)?", r"iv.mpf('\g<0>')", text)
    return iv.mpf(eval(numbers, {"__builtins__": {}}, {"iv": iv, "sqrt": iv.sqrt, **constants}))


class Scene:
    """Masses, gravity, rods as pairs of places, each a body's first coordinate or a fixed position."""

    def __init__(self, text):
        scene = tomllib.loads(text)
        self.constants = {}
        for name, value in scene.get("constants", {}).items():
            self.constants[name] = number(value, self.constants)
        value = lambda x: number(x, self.constants)
        self.d = scene["dimension"]
        place = {p["name"]: [value(x) for x in p["position"]] for p in scene.get("point", [])}
        self.M, self.q0, self.v0, self.F = [], [], [], []
        for body in scene["body"]:
            place[body["name"]] = len(self.M)
            self.M += [value(body["mass"])] * self.d
            self.q0 += [value(x) for x in body["position"]]
            self.v0 += [value(x) for x in body.get("velocity", [0] * self.d)]
        self.F = [iv.mpf(0)] * len(self.M)
        for effect in scene.get("effect", []):
            if effect["kind"] != "uniform_gravity":
                sys.exit(f"effect '{effect['kind']}' is not known here")
            for j, mass in enumerate(self.M):
                self.F[j] += mass * value(effect["acceleration"][j % self.d])
        self.rods = []
        for rod in scene.get("constraint", []):
            if rod["kind"] != "rod":
                sys.exit(f"constraint '{rod['kind']}' is not known here")
            self.rods.append([place[name] for name in rod["between"]])

    def along(self, rod, q, of_point=lambda x: x, minus=lambda a, b: a - b):
        """The components of a rod's direction, with the coordinates that each is of."""
        def coordinate(end, c):
            return q[end + c] if isinstance(end, int) else of_point(end[c])
        a, b = rod
        for c in range(self.d):
            signed = [(end + c, sign) for end, sign in ((a, 1), (b, -1)) if isinstance(end, int)]
            yield minus(coordinate(a, c), coordinate(b, c)), signed


class Polynomials:
    """Those of a step: whole numbers times a power of two that they share."""

    def __init__(self, step):
        q = [[exact(x) for x in line.split()] for line in step["q"]]
        lam = [[exact(x) for x in line.split()] for line in step["lambda"]]
        self.low = min([e for line in q + lam for m, e in line if m] + [0])
        whole = lambda line: [m << (e - self.low) if m else 0 for m, e in line]
        self.q, self.lam = [whole(x) for x in q], [whole(x) for x in lam]
        self.unit, self.end = interval(exact(step["unit"])), interval(exact(step["end"]))

    def value(self, series, s, power=1):
        """At s, or on an interval of s; `power` is by how many of the shared powers it was multiplied."""
        sum_ = iv.mpf(0)
        for a in reversed(series):
            sum_ = sum_ * s + a
        return sum_ * iv.mpf(2) ** (self.low * power)

    def size(self, series, power=1):
        return self.value([abs(a) for a in series], self.end, power)


def derivative(a):
    return [n * x for n, x in enumerate(a)][1:]


def times(a, b):
    result = [0] * max(len(a) + len(b) - 1, 0)
    for i, x in enumerate(a):
        if x:
            for j, y in enumerate(b):
                result[i + j] += x * y
    return result


def plus(a, b, sign=1):
    n = max(len(a), len(b))
    return [(a[i] if i < len(a) else 0) + sign * (b[i] if i < len(b) else 0) for i in range(n)]


def defect(scene, x):
    """Bounds over the step of |e| in the metric M^-1, e = M q'' - F + sum lambda grad g, and of each g''."""
    m, h2 = len(scene.M), x.unit ** 2
    forces, bending = [[] for _ in range(m)], []
    for a, rod in enumerate(scene.rods):
        g = []
        point = lambda p: [whole_of(p, x.low)]
        for direction, signed in scene.along(rod, x.q, point, lambda a, b: plus(a, b, -1)):
            g = plus(g, times(direction, direction))
            for j, sign in signed:
                forces[j] = plus(forces[j], times(direction, x.lam[a]), 2 * sign)
        bending.append(x.size(derivative(derivative(g)), 2) / h2)
    total = iv.mpf(0)
    for j in range(m):
        acceleration = derivative(derivative(x.q[j]))
        one, two = iv.mpf(2) ** x.low, iv.mpf(2) ** (2 * x.low)
        size = iv.mpf(0)
        for n in reversed(range(max(len(acceleration), len(forces[j])))):
            e = scene.M[j] * (acceleration[n] if n < len(acceleration) else 0) * one / h2
            e += (forces[j][n] if n < len(forces[j]) else 0) * two - (scene.F[j] if n == 0 else 0)
            size = size * x.end + iv.mpf(upper(abs(e)))
        total += size ** 2 / scene.M[j]
    return iv.sqrt(total), bending


def whole_of(position, low):
    """A fixed point's coordinate as a multiple of 2^low, which it has to be."""
    if position.a != position.b:
        sys.exit("a fixed point that is no binary number is not known here")
    return int(mp.ldexp(upper(position), -low))


def solve(R, columns):
    """R^-1 times columns, by elimination."""
    n = len(R)
    rows = [list(R[i]) + list(columns[i]) for i in range(n)]
    for k in range(n):
        if 0 in rows[k][k]:
            sys.exit("the Gram matrix may be singular")
        for i in range(n):
            if i != k:
                factor = rows[i][k] / rows[k][k]
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    return [[a / rows[i][i] for a in rows[i][n:]] for i in range(n)]


def growth(scene, q, v, omega):
    """A bound of the logarithmic norm for all positions and velocities of a box, and R^-1."""
    m, nu = len(scene.M), len(scene.rods)
    G = [[iv.mpf(0)] * nu for _ in range(m)]
    H = [[[0] * m for _ in range(m)] for _ in range(nu)]
    for a, rod in enumerate(scene.rods):
        for direction, signed in scene.along(rod, q):
            for j, sign in signed:
                G[j][a] += 2 * sign * direction
            for (j, s), (k, t) in product(signed, signed):
                H[a][j][k] += 2 * s * t
    dot = lambda x, y: sum((a * b for a, b in zip(x, y)), iv.mpf(0))
    times_v = lambda a, w: [dot(H[a][j], w) for j in range(m)]
    R = [[sum((G[j][a] * G[j][b] / scene.M[j] for j in range(m)), iv.mpf(0)) for b in range(nu)] for a in range(nu)]
    rhs = [[dot(v, times_v(a, v)) + sum((G[j][a] * scene.F[j] / scene.M[j] for j in range(m)), iv.mpf(0))]
           for a in range(nu)]
    lam = [row[0] for row in solve(R, rhs)]
    inverse = solve(R, [[iv.mpf(int(a == b)) for b in range(nu)] for a in range(nu)])
    acceleration = [(scene.F[j] - dot(G[j], lam)) / scene.M[j] for j in range(m)]
    K = [[-sum((lam[a] * H[a][i][j] for a in range(nu)), iv.mpf(0)) for j in range(m)] for i in range(m)]
    C = [times_v(a, acceleration) for a in range(nu)]
    inner = [[sum((G[i][a] * K[i][j] / scene.M[i] for i in range(m)), iv.mpf(0)) + C[a][j] for j in range(m)]
             for a in range(nu)]
    by_q, by_v = solve(R, inner), solve(R, [[2 * x for x in times_v(a, v)] for a in range(nu)])
    root = [iv.sqrt(mass) for mass in scene.M]
    A = [[(K[i][j] - dot(G[i], [row[j] for row in by_q])) / root[i] / root[j] for j in range(m)] for i in range(m)]
    B = [[-dot(G[i], [row[j] for row in by_v]) / root[i] / root[j] for j in range(m)] for i in range(m)]
    S = [[iv.mpf(0)] * (2 * m) for _ in range(2 * m)]
    for i, j in product(range(m), range(m)):
        S[i][m + j] = S[m + j][i] = ((omega if i == j else 0) + A[j][i] / omega) / 2
        S[m + i][m + j] = (B[i][j] + B[j][i]) / 2
    return greatest_eigenvalue(S), inverse


def greatest_eigenvalue(S):
    """A bound mu: mu - S has a factorisation with positive pivots, for all numbers in the intervals."""
    n = len(S)
    centre = mp.matrix(n, n)
    for i, j in product(range(n), range(n)):
        centre[i, j] = middle(S[i][j])
    greatest = max(mp.eigsy(centre, eigvals_only=True))
    for attempt in range(60):
        bound = iv.mpf(greatest + mp.mpf(2) ** (attempt - 40))
        rows = [[(bound if i == j else 0) - S[i][j] for j in range(n)] for i in range(n)]
        for k in range(n):
            if not rows[k][k].a > 0:
                break
            for i in range(k + 1, n):
                factor = rows[i][k] / rows[k][k]
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
        else:
            return bound
    sys.exit("errors may grow without bound")


def length(scene, dq, dv, omega):
    squares = (mass * (a ** 2 + (omega * b) ** 2) for mass, a, b in zip(scene.M, dv, dq))
    return iv.mpf(iv.sqrt(sum(squares, iv.mpf(0))).b)


def passed(scene, x, step, r, omega, bits, until=None):
    """The distance at the end of the step, or at `until`, from what it is at the start."""
    e, bending = defect(scene, x)
    tube, wide = (interval(exact(t)) for t in step["tube"])
    velocities = [derivative(series) for series in x.q]
    start, iv.prec, mp.prec = iv.mpf(0), 64, 64  # bounds need few bits
    for end, rate in zip(step["ends"], step["omegas"]):
        end, rate = interval(exact(end)), interval(exact(rate))
        tube, wide = tube * max(1, (rate / wide).b), rate
        r, omega = r * max(1, (rate / omega).b), rate
        for i in range(MORE):
            first, last = start + (end - start) * i / MORE, start + (end - start) * (i + 1) / MORE
            if until is not None and last.b > until.a:
                last = until
            s = iv.mpf([first.a, last.b])
            widen = lambda x, by: x + iv.mpf([-1, 1]) * by
            q = [widen(x.value(x.q[j], s), tube / omega / iv.sqrt(mass)) for j, mass in enumerate(scene.M)]
            v = [widen(x.value(velocities[j], s) / x.unit, tube / iv.sqrt(mass)) for j, mass in enumerate(scene.M)]
            mu, inverse = growth(scene, q, v, omega)
            bent = sum((bending[a] * bending[b] * abs(inverse[a][b]) for a in range(len(bending))
                        for b in range(len(bending))), iv.mpf(0))
            time = (last - first) * x.unit
            factor = iv.exp(mu * time)
            r = iv.mpf((r * max(1, factor.b) + (e + iv.sqrt(bent)) * time * max(1, factor.b)).b)
            if not r.b < tube.a:
                sys.exit("the motion may leave the tube")
            if until is not None and last is until:
                iv.prec = mp.prec = bits
                return r, omega
        start = end
    iv.prec = mp.prec = bits
    return r, omega


def main(file):
    with open(file, "rb") as opened:
        proof = tomllib.load(opened)
    claim = tomllib.loads(proof["reference"])
    bits = iv.prec = mp.prec = int(proof["digits"] * 3.33) + 64
    scene = Scene(proof["scene"])
    times_ = [(number(state["t"], scene.constants), state) for state in claim["time"]]
    r = omega = before = None
    start = iv.mpf(0)
    for n, step in enumerate(proof["step"]):
        x = Polynomials(step)
        rate = interval(exact(step["before"][1]))
        at = lambda y, s: ([y.value(a, s) for a in y.q], [y.value(derivative(a), s) / y.unit for a in y.q])
        here, there = at(x, iv.mpf(0)), (scene.q0, scene.v0) if before is None else at(before, before.end)
        jump = length(scene, *([a - b for a, b in zip(u, w)] for u, w in zip(here, there)), rate)
        r = jump if before is None else iv.mpf((r * max(1, (rate / omega).b) + jump).b)
        omega = rate
        end = start + x.end * x.unit
        for t, state in times_:
            if start.b <= t.a and t.b < end.a:
                s = (t - start) / x.unit
                off, by = passed(scene, x, step, r, omega, bits, s)
                report(scene, claim, state, at(x, s), off, by)
        r, omega = passed(scene, x, step, r, omega, bits)
        print(f"step {n + 1} of {len(proof['step'])}: within {mp.nstr(upper(r), 3)}", file=sys.stderr)
        start, before = end, x


def report(scene, claim, state, found, r, omega):
    """Each printed number is within a unit of its last digit of all that the motion may be."""
    worst = mp.mpf(0)
    for key, values, reach in (("q", found[0], [r / omega / iv.sqrt(m) for m in scene.M]),
                               ("p", [m * v for m, v in zip(scene.M, found[1])], [r * iv.sqrt(m) for m in scene.M])):
        texts = [mp.mpf(x) for x in state[key]]
        unit = mp.mpf(10) ** (mp.floor(mp.log10(max(abs(x) for x in texts))) - claim["digits"])
        for text, value, by in zip(texts, values, reach):
            worst = max(worst, upper(abs(value - iv.mpf(text)) + by) / unit)
    if worst > 1:
        sys.exit(f"t = {state['t']}: a digit is wrong, by {mp.nstr(worst, 3)} units of the last")
    print(f"proved: q and p of {claim['scene']} at t = {state['t']} to {claim['digits']} digits, "
          f"each within {mp.nstr(worst, 3)} units of its last digit")


if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    main(sys.argv[1])
