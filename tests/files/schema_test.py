"""hbvm run --json against studies/run.schema.json, with all options that add to it; and what the schema refuses."""
import copy
import json
import subprocess
import sys

import jsonschema

program, schema_file = sys.argv[1:]
with open(schema_file) as file:
    schema = json.load(file)
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)

seen = set()


def printed(*arguments):
    run = subprocess.run([program, "run", *arguments, "--json"], stdout=subprocess.PIPE, check=True)
    result = json.loads(run.stdout)
    validator.validate(result)
    seen.update(result)
    return result


with open("passing.toml", "w") as file:
    file.write("""
dimension = 2
observables = ["energy", "angular_momentum"]
point = [{ name = "O", position = [0, 0] }]
body = [{ name = "a", mass = 1, position = [-16, "1/8"], velocity = [2, 0] }]
effect = [{ kind = "central_gravity", center = "O", strength = 1 }]
""")
steps = ["--step", "1/16", "--until", "1"]
with open("rounded.toml", "w") as file:
    file.write("""
dimension = 2
point = [{ name = "O", position = [0, 0] }]
body = [{ name = "a", mass = 1, position = ["0.70710678118654752", "-0.70710678118654752"], velocity = [0, 0] }]
constraint = [{ kind = "rod", between = ["O", "a"], length = 1 }]
effect = [{ kind = "uniform_gravity", acceleration = [0, -1] }]
""")
assert "moved" in printed("rounded.toml", "--method", "hbvm:3,2", *steps, "--precision", "mpfr:30")["start_settled"]
result = printed("double_pendulum", "--method", "hbvm:3,2", *steps)
with open("there.json", "w") as file:
    json.dump(result, file)
printed("double_pendulum", "--method", "hbvm:3,2", *steps, "--start", "there.json", "--reverse")
for precision in ["double", "quad", "mpfr:30"]:
    printed("charged_double_pendulum", "--method", "hbvm:auto,1", *steps, "--precision", precision, "--account",
            "--shadow", "--error", "--horizon")
passed = printed("passing.toml", "--method", "hbvm:auto,2", "--step", "1/4", "--until", "16", "--on-failure", "halve",
                 "--solver", "fixed-point", "--shadow", "--error")
assert passed["halved"]["steps"] > 0 and passed["chosen"]["raised"] and passed["observables"]
printed("kepler", "--method", "hbvm:1,1", *steps, "--on-failure", "halve", "--error")
printed("simple_pendulum", "--method", "rattle", *steps)
for scene in ["double_pendulum", "kepler"]:
    assert printed(scene, "--method", "hbvm:2,2", *steps, "--prove")["proved"]["steps"] == 16
with open("driven.toml", "w") as file:
    file.write("""
dimension = 2
point = [{ name = "O", position = ["sin(t)", 0] }]
body = [{ name = "a", mass = 1, position = [0, -1], velocity = [1, 0] }]
constraint = [{ kind = "rod", between = ["O", "a"], length = 1 }]
effect = [{ kind = "drag", linear = 1 }]
""")
assert list(printed("driven.toml", "--method", "hbvm:3,2", *steps)["work"]["by"]) == ["point 'O'", "effect 1 (drag)"]
moved = printed("double_pendulum", *steps, "--states", "--every", "8", "--observe", "a.vx")
assert [state["t"] for state in moved["states"]] == ["0", "0.5", "1"]

swung = printed("simple_pendulum", "--step", "1/4", "--until", "91/3", "--event", "swing: bob.x", "--at", "1/3", "--observe", "y=bob.y")
assert swung["events"][0]["observed"]["y"] == swung["events"][0]["q"][1]
assert swung["events"][0]["direction"] == "down" and len(swung["periods"]) == 2 and swung["at"] and swung["last_step"]

assert seen == set(schema["properties"]), seen ^ set(schema["properties"])


def described(node, place):
    """Every key says what it is."""
    for key, entry in node.get("properties", {}).items():
        assert entry.get("description"), place + "/" + key
    for key, entry in node.items():
        for child in entry if isinstance(entry, list) else [entry]:
            if isinstance(child, dict):
                described(child, place + "/" + key)


described(schema, "")


def refused(change):
    wrong = copy.deepcopy(result)
    change(wrong)
    assert not validator.is_valid(wrong), wrong


for key in schema["required"]:
    refused(lambda j: j.pop(key))
refused(lambda j: j.update(more=1))
refused(lambda j: j.update(t=1.0))
refused(lambda j: j["q"].append("1.5e"))
refused(lambda j: j["q"].append(1.5))
refused(lambda j: j["output"].pop("p"))
refused(lambda j: j.update(precision="half"))
