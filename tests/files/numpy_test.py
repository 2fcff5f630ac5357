"""The CSV of a run in numpy: by place, and by the names of its first line."""
import json
import numpy as np

with open("double.json") as file:
    end = json.load(file)
expected = [float(end["t"])] + [float(x) for x in end["q"] + end["p"] + end["lambda"]]

table = np.loadtxt("double.csv", delimiter=",", skiprows=1)
assert table.shape == (17, 20), table.shape
assert table[-1, :11].tolist() == expected, table[-1]

named = np.genfromtxt("double.csv", delimiter=",", names=True, deletechars="")
assert named["t"].tolist() == [n / 16 for n in range(17)]
assert named["b.y"][-1] == float(end["q"][3])
assert named["output.b.py"].tolist() == table[:, 14].tolist()
assert named["lambda2"][-1] == float(end["lambda"][1])
assert named.dtype.names[-3:] == ("delta_H", "g", "hidden"), named.dtype.names
