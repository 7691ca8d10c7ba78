"""What OpenEXR prints by itself, caught instead of shown."""

import contextlib
import io
import os
import tempfile
import threading
from collections.abc import Callable, Iterator

_LOCK = threading.Lock()


@contextlib.contextmanager
def native_messages() -> Iterator[Callable[[], str]]:
    """Within the block what is printed is kept; the function given reads it.

    About a damaged file OpenEXR's C++ side writes to descriptor 2, and its Python side prints to `sys.stdout`,
    where it would end up in the middle of a `--json` document. Both belong to the whole process, so keep the
    block short. Without a standard error there is nothing to catch there.
    """
    printed = io.StringIO()
    with _LOCK, tempfile.TemporaryFile() as caught, contextlib.ExitStack() as stack:
        stack.enter_context(contextlib.redirect_stdout(printed))
        with contextlib.suppress(OSError):
            kept = os.dup(2)
            stack.callback(os.close, kept)
            os.dup2(caught.fileno(), 2)
            stack.callback(os.dup2, kept, 2)

        def read() -> str:
            caught.seek(0)
            return printed.getvalue() + caught.read(4096).decode("utf-8", "replace")

        yield read
