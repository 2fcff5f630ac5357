# %% [markdown]
# # What digits cost
# The cheapest method, step and precision for so many right digits, as runs on this machine show.

# %%
import hbvm

plans = {digits: hbvm.cost("kepler", digits=digits, until=10) for digits in (6, 12, 24, 48)}
plans[24]

# %% [markdown]
# More digits ask for a higher order, and beyond 15 for more than float64.

# %%
for digits, plan in plans.items():
    print(f"{digits:3} digits: {plan.pick.method:14} step {plan.pick.step:6} {plan.pick.precision}")

# %%
import matplotlib.pyplot as plt

figure, axes = plt.subplots()
axes.semilogy(list(plans), [plan.measured.seconds for plan in plans.values()], marker="o")
axes.set(xlabel="right digits", ylabel="seconds")

# %% [markdown]
# Is it true? The pick has the digits that it promises.

# %%
pick = plans[24].pick
run = hbvm.run("kepler", pick.method, step=pick.step, until=10, precision=pick.precision)
ref = hbvm.reference("kepler", at=10, digits=40)
error = max(abs(a - b) for a, b in zip(run.q.exact, ref.q[0].exact))
assert error < 1e-23
error
