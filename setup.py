"""Builds the Python package for `pip install .`: CMake compiles the extension module. See pyproject.toml."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
# Of all that setuptools makes on the way; ignored by git, and kept, so that a second build is short.
BUILD = "build/wheel"


def version():
    """That of the project in CMakeLists.txt."""
    return re.search(r"^project\(clackers VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]


class CMakeBuild(build_ext):
    """Compiles the module, the C++ modules that it needs and nothing else."""

    def build_extension(self, extension):
        folder = ROOT / BUILD / "cmake"
        options = {
            "CMAKE_BUILD_TYPE": "Release",
            # -O1 compiles faster than -O2 and runs some 5 % slower, since Eigen's operators are always inlined. GCC
            # collects garbage once it holds 400 MB.
            "CMAKE_CXX_FLAGS_RELEASE": "-O1 --param ggc-min-expand=1000 --param ggc-min-heapsize=400000 -DNDEBUG "
            + os.environ.get("CXXFLAGS", ""),
            # No name of a folder of this machine in the module.
            "CMAKE_CXX_FLAGS": f"-ffile-prefix-map={ROOT}=.",
            "CMAKE_MODULE_LINKER_FLAGS": "-s",
            "CLACKERS_TESTS": "OFF",
            "CLACKERS_INSTALL": "OFF",
            "CLACKERS_PYTHON": "ON",
            "Python3_EXECUTABLE": os.path.realpath(sys.executable),
        }
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        self.run_cmake("-S", ROOT, "-B", folder, *generator, *(f"-D{name}={value}" for name, value in options.items()))
        self.run_cmake("--build", folder, "--target", "clackers_python", "--parallel", compilers())
        built = next((folder / "python/clackers").glob("_core.*.so"))
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(built, target)

    @staticmethod
    def run_cmake(*arguments):
        if not shutil.which("cmake"):
            raise SystemExit("clackers: cmake is not there. Run scripts/setup python, which installs it.")
        with subprocess.Popen(["cmake", *map(str, arguments)], stdout=subprocess.PIPE, text=True) as run, terminal() as shown:
            for line in run.stdout:
                print(line, end="", flush=True)  # pip shows it with -v
                if done := re.match(r"\[(\d+)/(\d+)\]", line):
                    shown.write("\rclackers: {} of {} parts are compiled ".format(*done.groups()))
                    shown.flush()
            shown.write("\r" + 50 * " " + "\r")
        if run.returncode != 0:
            raise SystemExit(f"clackers: cmake {' '.join(map(str, arguments))} ended with status {run.returncode}.")


def compilers():
    """How many may run at once: each takes up to 2 GB."""
    memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    return max(1, min(os.cpu_count() or 1, memory // 2_000_000_000))


def terminal():
    """Where a person sees progress, since pip hides what a build prints; else nowhere."""
    try:
        return open("/dev/tty", "w")
    except OSError:
        return open(os.devnull, "w")


# Files that the package no longer has would stay among those of the wheel.
for copies in (ROOT / BUILD).glob("lib*"):
    shutil.rmtree(copies)
(ROOT / BUILD).mkdir(parents=True, exist_ok=True)
setup(
    version=version(),
    packages=["clackers"],
    package_dir={"clackers": "bindings/python/clackers"},
    package_data={"clackers": ["py.typed", "*.pyi"]},
    ext_modules=[Extension("clackers._core", [])],
    cmdclass={"build_ext": CMakeBuild},
    options={"build": {"build_base": BUILD}, "egg_info": {"egg_base": BUILD}},
    zip_safe=False,
)
