# %% [markdown]
# # Chaos and the horizon
# A double pendulum that swings over forgets its start: an error grows tenfold again and again. So float64 sees no
# further than a horizon, and each further digit moves it by as much.

# %%
import hbvm

scene = (
    hbvm.Scene(dimension=2, name="raised", title="Double pendulum, released on a level with its pivot")
    .point("pivot", (0, 0))
    .body("a", position=(1, 0))
    .body("b", position=(2, 0))
    .rod("pivot", "a", 1)
    .rod("a", "b", 1)
    .effect("uniform_gravity", acceleration=(0, "-9.81"))
)
times = [10, 20, 30, 40, 50]
ref = hbvm.reference(scene, at=times, digits=40)
print(f"until t = {times[-1]} the motion magnifies an error of the start by 10^{ref.digits_lost:.1f}")

# %% [markdown]
# The same run in float64 and with more digits, beside the reference: how many digits are right?

# %%
import mpmath

digits_right = {}
for precision in ("double", 24, 32):
    run = hbvm.run(scene, "hbvm:16,16", step="1/64", until=times[-1], precision=precision)
    rows = [list(run.t).index(t) for t in times]
    digits_right[precision] = [
        -float(mpmath.log10(max(abs(run[name].exact[row] - q[name].exact) for name in q.names)))
        for row, q in zip(rows, ref.q)
    ]
    print(precision, [f"{digits:.1f}" for digits in digits_right[precision]])

# %%
import matplotlib.pyplot as plt

figure, axes = plt.subplots()
for precision, digits in digits_right.items():
    axes.plot(times, digits, marker="o", label=str(precision))
axes.set(xlabel="t", ylabel="right digits of q")
axes.legend(title="precision");

# %% [markdown]
# The energy does not see it. It is conserved to round-off, while the motion has become another one.

# %%
far = hbvm.run(scene, until=100, error=True, picture=True)
print("the energy is off by", float(far.e_H), "and the right digits are", max(0, min(far.error.digits)))
assert far.e_H < 1e-10 and min(far.error.digits) < 1
far

# %%
far.plot()
