"""The build backend of pyproject.toml: setuptools, Debian's where no other is there.

pip builds in an environment of its own that hides Debian's packages. They are all that is needed, so
they are looked up behind those of the environment, and pip has nothing to download.
"""
import sys

sys.path.append("/usr/lib/python3/dist-packages")

try:
    import setuptools.build_meta
    import wheel  # noqa: F401
except ImportError as error:
    raise SystemExit(f"clackers: {error}. Run scripts/setup python, which installs python3-setuptools and python3-wheel.")

build_sdist = setuptools.build_meta.build_sdist
build_wheel = setuptools.build_meta.build_wheel
build_editable = setuptools.build_meta.build_editable
prepare_metadata_for_build_wheel = setuptools.build_meta.prepare_metadata_for_build_wheel
prepare_metadata_for_build_editable = setuptools.build_meta.prepare_metadata_for_build_editable


def get_requires_for_build_wheel(config_settings=None):
    """Nothing: what setuptools names here is Debian's wheel."""
    return []


get_requires_for_build_sdist = get_requires_for_build_editable = get_requires_for_build_wheel
