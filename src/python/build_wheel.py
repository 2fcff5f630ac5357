"""Builds the wheel of hbvm for pip, by CMake: `pip install src/python`. Nothing is fetched for it.

It takes what build/release has, if that was built for this Python. Else it builds in build/python. Another folder of a
build is named by `pip install --config-settings build=FOLDER src/python`.
"""
import base64
import hashlib
import pathlib
import re
import subprocess
import sysconfig
import sys
import zipfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
SUFFIX = sysconfig.get_config_var("EXT_SUFFIX")
METADATA = """Metadata-Version: 2.1
Name: hbvm
Version: {version}
Summary: Energy-conserving integration of constrained mechanics at any precision
License: MIT
Requires-Python: >=3.10
Requires-Dist: numpy
Requires-Dist: mpmath
Provides-Extra: plot
Requires-Dist: matplotlib ; extra == "plot"
Provides-Extra: pandas
Requires-Dist: pandas ; extra == "pandas"
Provides-Extra: progress
Requires-Dist: tqdm ; extra == "progress"
"""
WHEEL = """Wheel-Version: 1.0
Generator: hbvm
Root-Is-Purelib: false
Tag: {tag}
"""


def _run(*command):
    try:
        subprocess.run(command, check=True)
    except FileNotFoundError:
        sys.exit(f"{command[0]} is not installed: studies/setup.sh lists the packages that a build needs")


def _build(folder):
    """Builds the package, and returns its folder."""
    if not (folder / "python/hbvm" / f"_hbvm{SUFFIX}").exists():
        folder = SOURCE / "build/python"
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DHBVM_TESTS=OFF", "-DHBVM_PROGRAM=OFF", "-DHBVM_PYTHON=ON"]
        options.append(f"-DPython3_EXECUTABLE={sys.executable}")
        _run("cmake", "-G", "Ninja", "-S", str(SOURCE), "-B", str(folder), *options)
    _run("cmake", "--build", str(folder), "--target", "hbvm_python_package")
    built = folder / "python/hbvm"
    if not (built / f"_hbvm{SUFFIX}").exists():
        sys.exit(f"there is no module for {sys.executable}: install python3-dev and pybind11-dev")
    return built


def _version():
    return re.search(r"project\(hbvm VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]


def _tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _write(wheel, files):
    """The files, and a record of them as the last one."""
    record = ""
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record += f"{name},sha256={digest},{len(content)}\n"
            folder = name.split("/")[0]
        archive.writestr(f"{folder}/RECORD", record + f"{folder}/RECORD,,\n")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """What pip calls. Returns the name of the file."""
    folder = pathlib.Path((config_settings or {}).get("build", SOURCE / "build/release"))
    built, version, tag = _build(folder), _version(), _tag()
    names = [*sorted((SOURCE / "src/python/hbvm").glob("*.py*")), SOURCE / "src/python/hbvm/py.typed"]
    files = {f"hbvm/{path.name}": path.read_bytes() for path in names if path.is_file()}
    files[f"hbvm/_hbvm{SUFFIX}"] = (built / f"_hbvm{SUFFIX}").read_bytes()
    info = f"hbvm-{version}.dist-info"
    files[f"{info}/METADATA"] = METADATA.format(version=version).encode()
    files[f"{info}/WHEEL"] = WHEEL.format(tag=tag).encode()
    files[f"{info}/entry_points.txt"] = b"[pytest11]\nhbvm = hbvm.plugin\n"
    files[f"{info}/LICENSE"] = (SOURCE / "LICENSE").read_bytes()
    name = f"hbvm-{version}-{tag}.whl"
    _write(pathlib.Path(wheel_directory) / name, files)
    return name
