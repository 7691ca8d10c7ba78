"""Plugins for all tests: pytest wants them named in the topmost conftest."""

import os

# As the command line does it, and before NumPy is imported. Beside other workers OpenBLAS's threads wait for each other
# more than they compute: FLIP, which has threads of its own, took 5 to 20 times the CPU time.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

pytest_plugins = ["pytester"]
