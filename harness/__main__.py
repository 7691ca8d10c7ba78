"""Entry point of `lightmeter` and of `python -m lightmeter`."""

import os
import sys

# Images are filtered in strips by two threads; a BLAS that starts threads of its own then fights them for the cores.
# It reads this when NumPy is first imported.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from lightmeter.cli import main

if __name__ == "__main__":
    sys.exit(main())
