"""The CSV of a run in pandas: as text with all digits, and as the doubles nearest to them."""
import json
import pandas as pd

for name in ["double", "mpfr"]:
    with open(name + ".json") as file:
        end = json.load(file)
    text = pd.read_csv(name + ".csv", dtype=str)
    assert text.shape == (17, 20), text.shape
    last = text.iloc[-1]
    assert [last["a.x"], last["a.y"], last["b.x"], last["b.y"]] == end["q"], last
    assert [last["a.px"], last["a.py"], last["b.px"], last["b.py"]] == end["p"], last
    assert [last["lambda1"], last["lambda2"]] == end["lambda"], last
    assert [last["output.lambda1"], last["output.lambda2"]] == end["output"]["lambda"], last

    numbers = pd.read_csv(name + ".csv", float_precision="round_trip")
    assert list(numbers.columns) == list(text.columns)
    assert all(kind.kind in "fi" for kind in numbers.dtypes), numbers.dtypes
    for column in numbers:
        assert numbers[column].tolist() == [float(x) for x in text[column]], column
assert max(len(x) for x in text["a.x"]) > 50
