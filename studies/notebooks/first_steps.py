# %% [markdown]
# # First steps
# A double pendulum, its motion, and how far it can be trusted.

# %%
import hbvm

hbvm.scenes()

# %%
run = hbvm.run("double_pendulum", until=20, error=True, picture=True)
run

# %% [markdown]
# The first line that counts is the verdict: how many digits are right. The arrays are float64.

# %%
run.t[:5], run["a.x"][:5], abs(run.energy_error).max()

# %%
run.plot()

# %% [markdown]
# Here the motion plays, beside its multipliers and errors.

# %%
run.animate()

# %% [markdown]
# The same with 50 digits. A number computes as a float does, and has all its digits in `text`, `exact` and `decimal`.

# %%
exact = hbvm.run("double_pendulum", "hbvm:4,2", step="1/16", until=2, precision=50)
exact.q["a.x"]

# %%
import mpmath

mpmath.mp.dps = 50
energy = exact["delta_H"].exact
print("the energy is off by", mpmath.nstr(max(abs(e) for e in energy), 3))

# %% [markdown]
# A scene of one's own. Numbers are exact: text, whole numbers, fractions.

# %%
scene = (
    hbvm.Scene(dimension=2, name="pendulum")
    .point("pivot", (0, 0))
    .body("bob", mass=1, position=("3/5", "-4/5"))
    .rod("pivot", "bob", 1)
    .effect("uniform_gravity", acceleration=(0, "-9.81"))
    .observe("tension", "tension(pivot, bob)")
)
swing = hbvm.run(scene, until=4)
print("the rod pulls with", swing["tension"].min(), "to", swing["tension"].max())
swing.plot()
