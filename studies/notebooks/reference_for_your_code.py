# %% [markdown]
# # A reference for your code
# The motion to as many digits as one likes, each found by two routes that share only the scene.

# %%
import hbvm

ref = hbvm.reference("kepler", at=[1, 2, "2*pi"], digits=40)
ref

# %% [markdown]
# After one period the planet is where it was.

# %%
start = hbvm.run("kepler", until=1).trajectory
abs(ref.q[-1]["planet.x"].exact - start["planet.x"].exact[0])

# %% [markdown]
# Any results can be held against the motion: arrays, a DataFrame, a CSV file. Here SciPy's place is taken by a few
# lines of our own.

# %%
import numpy as np


def leapfrog(h, end):
    q, p = np.array([start["planet.x"][0], start["planet.y"][0]]), np.array([start["planet.px"][0], start["planet.py"][0]])
    rows = [[0, *q, *p]]
    for n in range(round(end / h)):
        p = p - h / 2 * q / np.dot(q, q) ** 1.5
        q = q + h * p
        p = p - h / 2 * q / np.dot(q, q) ** 1.5
        rows.append([(n + 1) * h, *q, *p])
    return np.array(rows)


names = ["t", "planet.x", "planet.y", "planet.px", "planet.py"]
found = ref.against(leapfrog(1 / 64, 4), leapfrog(1 / 128, 4), columns=names, steps=["1/64", "1/128"])
found

# %%
print("the order between both:", round(found.orders[0], 2))

# %% [markdown]
# In a test the same is one line, and its message says which component was wrong, and when.

# %%
from hbvm.testing import assert_conserves, assert_digits

assert_digits(leapfrog(1 / 128, 4), "kepler", 2, columns=names)
try:
    assert_digits(leapfrog(1 / 128, 4), "kepler", 8, columns=names)
except AssertionError as message:
    print(message)
assert_conserves(leapfrog(1 / 128, 4), "kepler", within=1e-3, columns=names).files[0].log10_H_drift[-1]

# %%
import matplotlib.pyplot as plt

figure, axes = plt.subplots()
for file in found.files:
    for name, digits in zip(file.right_digits, (file.right_digits[name] for name in file.right_digits)):
        axes.plot([float(t) for t in file.t], digits, label=f"{name}, {file.name}")
axes.set(xlabel="t", ylabel="right digits")
axes.legend(fontsize=6)
