"""The built tree, installed into a temporary prefix."""
import os
import pathlib
import shutil
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ["CLACKERS_BUILD"])
CMAKE = os.environ.get("CMAKE", "cmake")
CXX = os.environ.get("CXX", "c++")
CC = os.environ.get("CC", "cc")


def run(*command, **options):
    """Standard output of a command that must succeed."""
    words = [str(word) for word in command]
    done = subprocess.run(words, capture_output=True, text=True, **options)
    if done.returncode:
        raise AssertionError(f"{' '.join(words)}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


class Tree:
    """A temporary folder with the installed tree in `prefix`; `close()` removes both."""

    def __init__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="clackers-package-"))
        installed = self.folder / "first"
        run(CMAKE, "--install", BUILD, "--prefix", installed)
        # Elsewhere than it was installed to: nothing in it may know where it lies.
        self.prefix = self.folder / "moved here"
        installed.rename(self.prefix)
        self.lib = next(self.prefix.glob("lib*/**/libclackers.so")).parent

    def close(self):
        shutil.rmtree(self.folder)

    def environment(self):
        return {**os.environ, "PKG_CONFIG_PATH": str(self.lib / "pkgconfig"), "LD_LIBRARY_PATH": str(self.lib)}

    def configure(self, source, name, *options):
        """Configures `source` against the tree; the build folder."""
        build = self.folder / name
        run(CMAKE, "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}", *options)
        return build
