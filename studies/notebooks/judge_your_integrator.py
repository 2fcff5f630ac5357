# %% [markdown]
# # Judge your own integrator
# A Runge-Kutta method is a few numbers, in which a typing error hides well. Here is Kutta's method with one.

# %%
import hbvm

A = [[0, 0, 0, 0], ["1/2", 0, 0, 0], [0, "1/2", 0, 0], [0, 0, 1, 0]]
right = hbvm.audit(A=A, b=["1/6", "1/3", "1/3", "1/6"], order=4)
wrong = hbvm.audit(A=A, b=["1/6", "1/3", "1/3", "0.16667"], order=4)
print(right.summary)
wrong

# %% [markdown]
# The audit says which entry it would be, if one alone is wrong.

# %%
for finding in wrong.findings:
    if finding.quantity == "order conditions":
        print(finding.reason)
assert right.holds and not wrong.holds

# %% [markdown]
# A method without a tableau is judged by its steps. Here is one whose second stage is at the wrong place.

# %%
import numpy as np


def force(q):
    return -q / np.dot(q, q) ** 1.5


def step(q, p, h, half=3):
    k1, l1 = p, force(q)
    k2, l2 = p + h / half * l1, force(q + h / half * k1)
    k3, l3 = p + h / 2 * l2, force(q + h / 2 * k2)
    k4, l4 = p + h * l3, force(q + h * k3)
    return q + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), p + h / 6 * (l1 + 2 * l2 + 2 * l3 + l4)


found = hbvm.verify_order(step, "kepler", order=4)
assert not found
found

# %%
found.plot()

# %% [markdown]
# How does it do beside others? The energy tells methods apart that have the same order.

# %%
beside = hbvm.compare("kepler", ["rk4", "verlet", "hbvm:auto,2"], step="1/16", until=50)
beside

# %%
beside.plot()
