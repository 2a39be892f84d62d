"""Python packages for a script that needs them, gone when it ends."""

import os
import pathlib
import subprocess
import sys
import tempfile

VARIABLE = "LIGHTBENCH_THROW_AWAY"


def enter(requirements):
    """Runs the script again in an environment that has the packages; there, returns its folder."""
    if VARIABLE in os.environ:
        return pathlib.Path(os.environ[VARIABLE])
    with tempfile.TemporaryDirectory(prefix="lightbench-") as folder:
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        python = pathlib.Path(folder, "bin", "python")
        subprocess.run([python, "-m", "pip", "install", "--quiet", *requirements], check=True)
        sys.exit(subprocess.run([python, *sys.argv], env={**os.environ, VARIABLE: folder}).returncode)
