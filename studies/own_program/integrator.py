"""A small integrator of bodies on rods under uniform or central gravity, as one writes it for a class.

    python3 integrator.py METHOD SCENE STEP UNTIL OUT

METHOD is rk4, verlet (RATTLE where there are rods) or liar, an RK4 with a wrong weight.
"""
import math
import sys
import tomllib


def read_scene(path):
    with open(path, "rb") as file:
        scene = tomllib.load(file)
    names = {k: getattr(math, k) for k in ("sqrt", "sin", "cos", "pi")}
    for name, value in scene.get("constants", {}).items():
        names[name] = number(value, names)
    return scene, names


def number(value, names):
    """Numbers of a scene may be expressions, as "sqrt(3)/2"."""
    return eval(value.replace("^", "**"), {}, names) if isinstance(value, str) else float(value)


class System:
    """q and v are lists of vectors; forces and rods act on them."""

    def __init__(self, path):
        scene, names = read_scene(path)
        vector = lambda values: [number(x, names) for x in values]
        self.bodies = [body["name"] for body in scene["body"]]
        self.masses = [number(body["mass"], names) for body in scene["body"]]
        self.q = [vector(body["position"]) for body in scene["body"]]
        self.v = [vector(body["velocity"]) for body in scene["body"]]
        self.points = {point["name"]: vector(point["position"]) for point in scene.get("point", [])}
        self.rods = [rod["between"] for rod in scene.get("constraint", [])]
        self.effects = []
        for effect in scene["effect"]:
            if effect["kind"] == "uniform_gravity":
                self.effects.append(("uniform", vector(effect["acceleration"])))
            elif effect["kind"] == "central_gravity":
                self.effects.append(("central", self.points[effect["center"]], number(effect["strength"], names)))
            else:
                sys.exit(f"this program does not know the effect {effect['kind']}")

    def place(self, name, q):
        return q[self.bodies.index(name)] if name in self.bodies else self.points[name]

    def acceleration(self, q):
        total = [[0.0] * len(x) for x in q]
        for effect in self.effects:
            for i, x in enumerate(q):
                if effect[0] == "uniform":
                    pull = effect[1]
                else:
                    off = [a - b for a, b in zip(x, effect[1])]
                    pull = [-effect[2] * d / math.dist(x, effect[1]) ** 3 for d in off]
                total[i] = [a + b for a, b in zip(total[i], pull)]
        return total

    def rows(self, q):
        """For each rod, the bodies at its ends and the vector along it: its gradient is twice that, with signs."""
        result = []
        for a, b in self.rods:
            along = [x - y for x, y in zip(self.place(a, q), self.place(b, q))]
            result.append([(self.bodies.index(n), [s * x for x in along]) for n, s in ((a, 1), (b, -1))
                           if n in self.bodies])
        return result

    def pull(self, at, to, amounts, vectors):
        """vectors + M^-1 G(at)^T amounts, where amounts are such that G(to) of it is 0 when they are solved for."""
        result = [list(x) for x in vectors]
        for row, amount in zip(self.rows(at), amounts):
            for i, along in row:
                result[i] = [x + amount * d / self.masses[i] for x, d in zip(result[i], along)]
        return result

    def gram(self, left, right):
        return [[sum(dot(x, y) / self.masses[i] for i, x in a for j, y in b if i == j) for b in self.rows(right)]
                for a in self.rows(left)]

    def rates(self, q, v):
        return [sum(dot(along, v[i]) for i, along in row) for row in self.rows(q)]

    def on_rods(self, q, v):
        """The acceleration with the forces of the rods, by differentiating g twice."""
        free = self.acceleration(q)
        if not self.rods:
            return free
        turning = []
        for a, b in self.rods:
            speeds = [v[self.bodies.index(n)] if n in self.bodies else [0.0] * len(q[0]) for n in (a, b)]
            off = [x - y for x, y in zip(*speeds)]
            turning.append(dot(off, off))
        wanted = [-(r + t) for r, t in zip(self.rates(q, free), turning)]
        return self.pull(q, q, solve(self.gram(q, q), wanted), free)


def dot(x, y):
    return sum(a * b for a, b in zip(x, y))


def solve(matrix, right):
    """Gauss's elimination with pivots."""
    n = len(right)
    rows = [list(row) + [b] for row, b in zip(matrix, right)]
    for k in range(n):
        best = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[best] = rows[best], rows[k]
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (rows[k][n] - dot(rows[k][k + 1:n], x[k + 1:])) / rows[k][k]
    return x


def moved(x, h, y):
    return [[a + h * b for a, b in zip(u, w)] for u, w in zip(x, y)]


def rk4(system, q, v, h, weights=(1, 2, 2, 1)):
    sum_q, sum_v, kq, kv = q, v, v, system.on_rods(q, v)
    for part, weight in zip((0.5, 0.5, 1.0, None), weights):
        sum_q, sum_v = moved(sum_q, h * weight / 6, kq), moved(sum_v, h * weight / 6, kv)
        if part:
            at_q, at_v = moved(q, part * h, kq), moved(v, part * h, kv)
            kq, kv = at_v, system.on_rods(at_q, at_v)
    return sum_q, sum_v


def verlet(system, q, v, h):
    half = moved(v, h / 2, system.acceleration(q))
    new = moved(q, h, half)
    if system.rods:
        lengths = [math.dist(system.place(a, system.q), system.place(b, system.q)) for a, b in system.rods]
        for _ in range(50):
            off = [(math.dist(system.place(a, new), system.place(b, new)) ** 2 - l * l) / 2
                   for (a, b), l in zip(system.rods, lengths)]
            if max(map(abs, off)) < 1e-15:
                break
            change = system.pull(q, new, solve(system.gram(new, q), [-x for x in off]), [[0.0] * len(x) for x in q])
            new = moved(new, 1.0, change)
        half = [[(b - a) / h for a, b in zip(x, y)] for x, y in zip(q, new)]
    v = moved(half, h / 2, system.acceleration(new))
    if system.rods:
        v = system.pull(new, new, solve(system.gram(new, new), [-r for r in system.rates(new, v)]), v)
    return new, v


def main():
    if len(sys.argv) != 6:
        sys.exit(__doc__)
    method, scene, step, until, out = sys.argv[1:]
    system = System(scene)
    steps = round(float(until) / float(step))
    names = [f"{body}.{kind}{axis}" for kind in ("", "v") for body in system.bodies
             for axis in "xyz"[:len(system.q[0])]]
    q, v = system.q, system.v
    with open(out, "w") as file:
        print("t", *names, sep=",", file=file)
        for n in range(steps + 1):
            print(n * float(step), *(repr(x) for vectors in (q, v) for u in vectors for x in u), sep=",", file=file)
            if method == "verlet":
                q, v = verlet(system, q, v, float(step))
            else:
                q, v = rk4(system, q, v, float(step), (1, 2, 2, 1) if method == "rk4" else (1, 2, 2, 1.001))


if __name__ == "__main__":
    main()
