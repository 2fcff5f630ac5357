# %% [markdown]
# # Verify an order beyond round-off
# In float64 a method of high order ends in round-off before its order is seen. With more digits it goes on.

# %%
import hbvm

in_double = hbvm.convergence("kepler", ["hbvm:6,3", "hbvm:8,4"], steps="1/4:1/128")
in_double

# %%
with_digits = hbvm.convergence("kepler", ["hbvm:6,3", "hbvm:8,4"], steps="1/4:1/128", precisions=[50])
with_digits

# %%
with_digits.plot()

# %% [markdown]
# The method may also be one's own, in Python: `step(q, p, h)` returns the next q and p. Here are two, by Störmer and
# Verlet, and by Runge and Kutta.

# %%
import numpy as np


def force(q):
    return -q / np.dot(q, q) ** 1.5


def verlet(q, p, h):
    p = p + h / 2 * force(q)
    q = q + h * p
    return q, p + h / 2 * force(q)


def runge_kutta(q, p, h):
    k1, l1 = p, force(q)
    k2, l2 = p + h / 2 * l1, force(q + h / 2 * k1)
    k3, l3 = p + h / 2 * l2, force(q + h / 2 * k2)
    k4, l4 = p + h * l3, force(q + h * k3)
    return q + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), p + h / 6 * (l1 + 2 * l2 + 2 * l3 + l4)


print(hbvm.verify_order(verlet, "kepler", order=2).message)
found = hbvm.verify_order(runge_kutta, "kepler", order=4)
found

# %%
found.plot()
