"""What a C++ library prints by itself, caught instead of shown."""

import contextlib
import ctypes
import os
import tempfile
import threading
from collections.abc import Callable, Iterator

_LOCK = threading.Lock()


@contextlib.contextmanager
def native_messages() -> Iterator[Callable[[], str]]:
    """Within the block the process's standard output and error go to a file; the function given reads it.

    OpenEXR prints its own lines about a damaged file, some of them on standard output, where they would
    end up in the middle of a `--json` document. The descriptors belong to the whole process, so keep the
    block short. A descriptor that is closed is left alone.
    """
    with _LOCK, tempfile.TemporaryFile() as caught, contextlib.ExitStack() as stack:
        _flush()
        for descriptor in (1, 2):
            with contextlib.suppress(OSError):
                kept = os.dup(descriptor)
                stack.callback(os.close, kept)
                os.dup2(caught.fileno(), descriptor)
                stack.callback(os.dup2, kept, descriptor)
        # C's buffers must empty into the file before the descriptors are put back.
        stack.callback(_flush)

        def read() -> str:
            _flush()
            caught.seek(0)
            return caught.read(4096).decode("utf-8", "replace")

        yield read


def _flush() -> None:
    """Empty C's output buffers (Python's own are separate); where there is no C library to ask, do nothing."""
    with contextlib.suppress(OSError, AttributeError, TypeError):
        ctypes.CDLL(None).fflush(None)
