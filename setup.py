"""Builds the extension module with CMake: setuptools alone, for Debian 12 has no scikit-build-core."""
import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        folder = pathlib.Path(self.build_temp).resolve()
        target = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DLOZENGE_BUILD_TESTS=OFF",
                        "-DLOZENGE_INSTALL=OFF", "-DLOZENGE_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(len(os.sched_getaffinity(0))))
        subprocess.run(["cmake", "--build", folder, "--target", "lozenge_python", "-j", jobs], check=True)
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(folder / "python" / "lozenge" / target.name), str(target))


setup(version=re.search(r"project\(lozenge VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1),
      ext_modules=[Extension("lozenge._lozenge", [])], cmdclass={"build_ext": CMakeBuild})
