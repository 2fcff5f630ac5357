"""Three proofs are checked by studies/proof/check.py, and a claim with a wrong digit is not: check_test.py PROGRAM PROJECT"""
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import mpmath  # noqa: F401
    import tomllib  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

program, project = sys.argv[1], pathlib.Path(sys.argv[2])


def check(file):
    return subprocess.run([sys.executable, project / "studies/proof/check.py", file], capture_output=True, text=True)


with tempfile.TemporaryDirectory() as folder:
    for scene in ("simple_pendulum", "conical_pendulum", "double_pendulum"):
        file = pathlib.Path(folder) / f"{scene}.proof"
        subprocess.run([program, "reference", scene, "--until", "1/2", "--digits", "10", "--prove", "--out", file],
                       check=True, capture_output=True)
        found = check(file)
        assert found.returncode == 0, found.stderr
        assert f"proved: q and p of {scene} at t = 1/2 to 10 digits" in found.stdout, found.stdout
        print(found.stdout, end="")
    text = file.read_text()
    # The last digit but one of the first position that is claimed.
    wrong = re.sub(r'(q = \[\n\s+\\"[-0-9.e]*?)(\d)(\d\\")',
                   lambda m: m[1] + ("6" if m[2] == "5" else "5") + m[3], text, count=1)
    assert wrong != text
    file.write_text(wrong)
    found = check(file)
    assert found.returncode != 0 and "a digit is wrong" in found.stderr, found.stderr
